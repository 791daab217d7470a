"""Read a study's folder back for display, without Dask and xarray."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.study.sensitivity import INDICES, Indices
from rigapp.texts import Sentence, say, sentence_of_error

if TYPE_CHECKING:
    import h5py

Floats = NDArray[np.float64]

ROWS, IDENTITY = "rows.jsonl", "study.json"
TABLE, CSV, POWER = "table.nc", "table.csv", "power.csv"
NOT_COMPUTED = say("not computed yet")
"""The problem of a point that is not computed yet."""
SENSITIVITY = "sensitivity_"
"""Prefix of the indices among the columns of the table."""


@dataclass(frozen=True, slots=True, eq=False)
class StudyColumn:
    """A parameter or a result at each point, (n,), NaN where there is none.

    texts: where the values are texts, all of them; ``values`` are then their indices.
    """

    name: str
    unit: str
    words: str
    values: Floats
    texts: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class PowerRow:
    """The revolutions after which a share of tests has detected a factor, or inf."""

    factor: float
    share: float
    revolutions: float
    tests: int


@dataclass(frozen=True, slots=True, eq=False)
class StudyResults:
    """The results of a study. changed: time, seconds since 1970. reason: why there is no table.

    problems: of each point why it has no result, "" where it has. notes: remarks on its result.
    sensitivities: by result, each index of the parameters in their order.
    """

    folder: Path
    changed: float
    kind: str = ""
    parameters: tuple[StudyColumn, ...] = ()
    results: tuple[StudyColumn, ...] = ()
    problems: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    sensitivities: Mapping[str, Indices] | None = None
    power: tuple[PowerRow, ...] = ()
    reason: str = ""

    @property
    def waiting(self) -> int:
        """Return the number of points not computed yet."""
        return self.problems.count(NOT_COMPUTED)

    @property
    def noted(self) -> tuple[tuple[int, str], ...]:
        """Return the points with notes on their result, each with them."""
        return tuple((number, text) for number, text in enumerate(self.notes) if text)

    @property
    def failed(self) -> tuple[tuple[int, str], ...]:
        """Return the points without a result, each with the reason."""
        problems = enumerate(self.problems)
        return tuple((number, why) for number, why in problems if why not in ("", NOT_COMPUTED))


def studies_in(folder: Path) -> tuple[StudyResults, ...]:
    """Return the studies of a folder and of those in it, that of the newest change first.

    One that cannot be read, or has no table yet, has a reason. Raises OSError for no such folder.
    """
    folders = [folder, *(path for path in folder.iterdir() if path.is_dir())]
    studies = [study_results(path) for path in folders if (path / IDENTITY).is_file()]
    return tuple(sorted(studies, key=lambda study: study.changed, reverse=True))


def points_done(folder: Path) -> int:
    """Return the number of stored points of a study, 0 for no study."""
    rows = folder / ROWS
    return rows.read_bytes().count(b"\n") if rows.exists() else 0


def study_results(folder: Path) -> StudyResults:
    """Return the results in a study's folder; ``reason`` says why they cannot be read."""
    newest = next((name for name in (TABLE, ROWS, IDENTITY) if (folder / name).exists()), "")
    changed = (folder / newest).stat().st_mtime
    if newest != TABLE:
        reason = say(
            "The study has no table yet: it is running, or was interrupted. Finished points"
            " are saved; the same command continues it."
        )
        return StudyResults(folder, changed, reason=reason)
    try:
        return _results(folder, changed)
    except UnusableInput as error:
        return StudyResults(folder, changed, reason=sentence_of_error(error))


def _results(folder: Path, changed: float) -> StudyResults:
    from rigapp.storage import (
        open_for_reading,  # with h5py a tenth of the window's start
    )

    path = folder / TABLE
    try:
        with open_for_reading(path) as file:
            return StudyResults(
                folder,
                changed,
                _text(file.attrs["title"]).removeprefix("study: "),
                _columns(file, "parameter"),
                _columns(file, "result"),
                tuple(map(str, file["problem"].asstr()[...])),
                tuple(map(str, file["notes"].asstr()[...])) if "notes" in file else (),
                _sensitivities(file),
                _power(folder / POWER),
            )
    except (OSError, KeyError, ValueError, TypeError, AttributeError) as error:
        raise UnusableInput("{}: is not the table of a study ‹{}›.", path, error) from error


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _columns(file: h5py.File, role: str) -> tuple[StudyColumn, ...]:
    """Return the columns of a role, in the order of their sensitivities where these are known."""
    names = [name for name, data in file.items() if _text(data.attrs.get("role", "")) == role]
    order = [str(key) for key in file[role].asstr()[...]] if role in file else []
    names.sort(key=lambda name: order.index(name) if name in order else len(order))
    return tuple(_column(name, file[name]) for name in names)


def _column(name: str, data: h5py.Dataset) -> StudyColumn:
    unit, words = (_text(data.attrs.get(attribute, "")) for attribute in ("units", "long_name"))
    if data.dtype.kind not in "OS":  # not texts
        return StudyColumn(name, unit, Sentence(words), data[...].astype(np.float64))
    texts, places = np.unique(data.asstr()[...].astype(str), return_inverse=True)
    return StudyColumn(
        name, unit, Sentence(words), places.astype(np.float64), tuple(map(str, texts))
    )


def _sensitivities(file: h5py.File) -> dict[str, Indices]:
    if f"{SENSITIVITY}total" not in file:
        return {}
    read = {name: file[f"{SENSITIVITY}{name}"][...] for name in INDICES}
    names = file["result"].asstr()[...]
    return {
        str(result): Indices(**{name: values[at] for name, values in read.items()})
        for at, result in enumerate(names)
    }


def _power(path: Path) -> tuple[PowerRow, ...]:
    if not path.exists():
        return ()
    with path.open(newline="", encoding="utf-8") as file:
        return tuple(
            PowerRow(
                float(row["coefficient_factor"]),
                float(row["share_of_tests"]),
                float(row["revolutions"]),
                int(row["tests"]),
            )
            for row in csv.DictReader(file)
        )
