"""Run a study on Dask: on this computer's cores, or the workers of a scheduler."""

from __future__ import annotations

import csv
import importlib.util
import itertools
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import CancelledError
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput, from_extra
from rigapp.config.loading import read_document, read_parameter_file
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import keys_of
from rigapp.config.reading import read_text
from rigapp.config.toml import toml_tree
from rigapp.config.writing import whole_file
from rigapp.study.design import Design, Spread, StudyFile, StudyPoint, Varied, design_of
from rigapp.study.folder import POWER
from rigapp.study.journal import StudyIdentity, StudyJournal
from rigapp.study.kinds import KINDS, IdentifyRun, record_of
from rigapp.study.points import RUN, Batch, StudyRow, computed
from rigapp.study.sensitivity import RESOLVED, Indices
from rigapp.study.table import draw_study, sensitivities, write_tables
from rigapp.study.virtual import VirtualTest
from rigapp.texts import joined, say, sentence_of_error

SHARES = (0.5, 0.8, 0.9, 0.95)
"""Shares of the tests that detect the difference."""
FACTOR = "run.coefficient_factor"


def write_power(
    folder: Path, study: StudyFile, design: Design, rows: Mapping[int, StudyRow]
) -> list[Path]:
    """Write the revolutions after which shares of virtual tests detected each factor, if any."""
    if KINDS[study.kind].settings is not VirtualTest:
        return []
    path = folder / POWER
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["coefficient_factor", "share_of_tests", "revolutions", "tests"])
        for factor, seen in sorted(seen_by_factor(study, design, rows).items()):
            for share in SHARES:
                writer.writerow([factor, share, revolutions_until(seen, share), len(seen)])
    return [path]


def seen_by_factor(
    study: StudyFile, design: Design, rows: Mapping[int, StudyRow]
) -> dict[float, list[float]]:
    """Return the revolutions at which the tests of each factor detected it, or inf."""
    assert isinstance(study.run, VirtualTest)
    by_key: dict[float, list[float]] = {}
    for point in design.points:
        row = rows.get(point.number)
        if row is not None and not row.problem:
            factor = float(point.values.get(FACTOR, study.run.coefficient_factor))
            by_key.setdefault(factor, []).append(row.numbers.get("seen_revolution", math.inf))
    return by_key


def revolutions_until(seen: list[float], share: float) -> float:
    """Return the revolutions after which a share has detected it; inf: not in time."""
    ordered = np.sort(seen)
    return float(ordered[max(math.ceil(share * len(ordered)) - 1, 0)])


BATCH = 8
"""Points in a batch for a worker: tenths of a second, which is the loss if the worker dies."""
AHEAD = 3
"""Batches that wait at each worker, so that none is idle."""
LOST_WORKERS = 20
"""Workers that may die with a batch before it counts as the cause."""
CONNECT_S = 30
"""A running scheduler answers at once; one on a busy cluster takes seconds."""

Progress = Callable[[float, float], None]


@dataclass(frozen=True, slots=True)
class Study:
    """A study as read: its file, all its points, and its identity."""

    path: Path
    record: StudyFile
    design: Design
    identity: StudyIdentity
    template: Batch


@dataclass(frozen=True, slots=True)
class StudyEnd:
    """The end of a study: points in all, done, without a result; written files.

    noted: points whose results have notes. unresolved: a sentence for each result whose
    sensitivities need more points.
    """

    points: int
    done: int
    failed: int
    files: tuple[Path, ...]
    noted: int = 0
    unresolved: tuple[str, ...] = ()


def read_study(path: Path) -> Study:
    """Read a study file and its parameter file; raise UnusableInput naming file and key."""
    text = read_text(path)
    tree = toml_tree(text, path)
    try:
        record = read_document(path, record_of(str(tree.get("kind", "")))).record
        kind = KINDS[record.kind]
        parameters, tables = "", {}
        if kind.modelled:
            source = path.parent / record.parameters
            if not record.parameters:
                raise UnusableInput("parameters are missing; name the parameter file.")
            parameters = read_parameter_file(source).text
            tables = toml_tree(parameters, source)
        vary = {**record.vary, **_files(path, record)}
        _require_known(record, vary)
        design = design_of(vary, record.design)
        template = Batch(record.kind, tables, tree["run"], ())
    except UnusableInput as error:
        words = sentence_of_error(error)
        raise UnusableInput(words if str(path) in words else say("{}: {}", path, words)) from error
    return Study(path, record, design, StudyIdentity(text, parameters, version("rigapp")), template)


def _files(path: Path, record: StudyFile) -> dict[str, Varied]:
    """Return the recorded tests of ``identify`` as one more key that varies."""
    if not isinstance(record.run, IdentifyRun):
        return {}
    paths = sorted(
        {str(match) for pattern in record.run.files for match in _matching(path.parent, pattern)}
    )
    if not paths:
        raise UnusableInput("run.files = {}: there are no such files.", record.run.files)
    return {"run.file": [*paths]}


def _matching(folder: Path, pattern: str) -> Iterator[Path]:
    from glob import glob

    return (Path(name).resolve() for name in glob(str(folder / pattern), recursive=True))


def _require_known(record: StudyFile, vary: dict[str, Varied]) -> None:
    """Refuse unknown keys and invalid values before anything is computed."""
    kind = KINDS[record.kind]
    known = {f"{RUN}{key.path}": key for key in keys_of(kind.settings)}
    known |= {key.path: key for key in keys_of(ParameterFile)} if kind.modelled else {}
    for name, varied in vary.items():
        if name not in known:
            raise UnusableInput(
                "vary.{}: is not a known key; known here: {}.", name, joined(", ", sorted(known))
            )
        number = known[name].value_type in (float, int)
        values = [varied.low] if isinstance(varied, Spread) else varied
        wrong = [value for value in values if isinstance(value, str) is number]
        if wrong:
            wanted = "numbers" if number else "texts"
            raise UnusableInput("vary.{}: {}: give {}.", name, repr(wrong[0]), wanted)


def run_study(
    study: Study,
    folder: Path,
    scheduler: str = "",
    workers: int | None = None,
    progress: Progress | None = None,
    report: Callable[[str], None] = lambda words: None,
) -> StudyEnd:
    """Compute the points that are not stored yet and write the tables; return the result.

    scheduler: address of a Dask scheduler, else workers processes here, as many as there are cores
    when None. report: called with a sentence, as that of the dashboard. Raises UnusableInput. An
    interrupt (KeyboardInterrupt) leaves the stored points, with their tables.
    """
    with from_extra("studies", say("A study")):
        importlib.import_module("distributed")
    with StudyJournal(folder, study.identity) as journal:
        rows = dict(journal.rows)
        todo = [point for point in study.design.points if point.number not in rows]
        try:
            if todo:
                _compute(study, todo, journal, rows, scheduler, workers, progress, report)
        except KeyboardInterrupt:
            _written(study, folder, rows)
            raise
        files, known = _written(study, folder, rows)
    failed = sum(bool(row.problem) for row in rows.values())
    noted = sum(bool(row.notes) for row in rows.values())
    unresolved = tuple(_unresolved(study, known))
    return StudyEnd(len(study.design.points), len(rows), failed, files, noted, unresolved)


def _unresolved(study: Study, known: Mapping[str, Indices]) -> Iterator[str]:
    """Yield a sentence for each result whose sensitivities are wide."""
    keys = len(study.design.points[0].values) if study.design.points else 0
    for name, indices in known.items():
        base = indices.points_needed(study.design.blocks)
        if base:
            yield say(
                "The sensitivities of {} are not resolved: their limits are wider than ±{:.0f} %;"
                " give about {} points",
                name,
                100.0 * RESOLVED,
                base * (keys + 2),
            )


def _written(
    study: Study, folder: Path, rows: dict[int, StudyRow]
) -> tuple[tuple[Path, ...], dict[str, Indices]]:
    """Write tables and pictures of the stored points; return their paths, and the sensitivities."""
    record, design = study.record, study.design
    known = sensitivities(record, design, rows)
    files = (
        *write_tables(folder, record, design, study.identity, rows, known),
        *write_power(folder, record, design, rows),
        *draw_study(folder, record, design, rows, known),
    )
    return files, known


def _compute(
    study: Study,
    todo: Sequence[StudyPoint],
    journal: StudyJournal,
    rows: dict[int, StudyRow],
    scheduler: str,
    workers: int | None,
    progress: Progress | None,
    report: Callable[[str], None],
) -> None:
    """Distribute batches, a few ahead of each worker, and store each on arrival."""
    from distributed import as_completed

    total = len(study.design.points)
    with _client(scheduler, workers) as client:
        if client.dashboard_link and importlib.util.find_spec("bokeh") is not None:
            report(say("Dask's dashboard is at {}", client.dashboard_link))
        batches = iter(_batches(study, todo))

        def send(batch: Batch) -> Any:
            return client.submit(computed, batch, pure=False)

        cores = max(sum(client.nthreads().values()), 1)
        waiting = as_completed(send(batch) for batch in itertools.islice(batches, AHEAD * cores))
        for future in waiting:
            finished = _result(future)
            journal.append(finished)
            rows |= {row.number: row for row in finished}
            future.release()
            for batch in itertools.islice(batches, 1):
                waiting.add(send(batch))
            if progress is not None:
                progress(float(len(rows)), float(total))


def _result(future: Any) -> list[StudyRow]:
    """Return the rows of a batch; raise UnusableInput where scheduler or workers were lost."""
    from distributed import KilledWorker

    try:
        rows: list[StudyRow] = future.result()
    except (KilledWorker, CancelledError, OSError) as error:
        raise UnusableInput(
            "the workers were lost ‹{}›; finished points are saved, and the same command"
            " continues it.",
            repr(error),
        ) from error
    return rows


def _batches(study: Study, todo: Sequence[StudyPoint]) -> Iterator[Batch]:
    template = study.template
    for first in range(0, len(todo), BATCH):
        points = tuple(todo[first : first + BATCH])
        yield Batch(template.kind, template.parameters, template.run, points)


@contextmanager
def _client(scheduler: str, workers: int | None) -> Iterator[Any]:
    """Yield a client of a scheduler, or of processes of this computer, one thread each."""
    import dask
    from distributed import Client, LocalCluster

    with ExitStack() as ending:
        ending.enter_context(
            dask.config.set(
                {
                    "distributed.scheduler.allowed-failures": LOST_WORKERS,
                    "distributed.worker.preload": [],
                    "distributed.nanny.pre-spawn-environ": _ONE_THREAD,
                }
            )
        )
        if scheduler:
            yield ending.enter_context(_connected(scheduler))
            return
        # As ``-P`` of ``module_command``, for processes of multiprocessing: workers and tracker.
        os.environ["PYTHONSAFEPATH"] = "1"
        cluster = LocalCluster(
            n_workers=workers or os.cpu_count() or 1,
            threads_per_worker=1,
            processes=True,
            dashboard_address="127.0.0.1:0",
            silence_logs=50,
            # A client of a scheduler runs code as its user, and every account reaches loopback:
            # so this cluster has keys of its own.
            security=True,
        )
        ending.enter_context(cluster)
        yield ending.enter_context(Client(cluster))


_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
"""Each worker uses one core: threads of libraries would compete for them."""


def _connected(scheduler: str) -> Any:
    from distributed import Client

    try:
        return Client(scheduler, timeout=CONNECT_S)
    except (OSError, TimeoutError, ValueError) as error:
        raise UnusableInput(
            "--scheduler {}: no Dask scheduler answers there ‹{}›.", scheduler, error
        ) from error
