"""Hand a test's data to other programs: CSV or Parquet, a piece at a time."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.storage.filesystem.folder import move_into_place
from rigapp.storage.reading.reader import StoredCycle, TestReader, open_test
from rigapp.storage.structure.metadata import unit_suffix

ROWS_AT_A_TIME = 65536  # 18 MB of the columns of every rig
SAMPLES_AT_A_TIME = 1 << 18  # 16 MB of the columns of every rig
FORMATS = (".csv", ".parquet")
STEP = "step"
FEWEST_POINTS = 8  # fewer say nothing of a revolution

Table = dict[str, NDArray[Any]]
Progress = Callable[[int, int], None]
Steps = Callable[[NDArray[np.int64]], NDArray[np.int64]]


class _Sink(Protocol):
    def write(self, table: Any) -> None: ...

    def close(self) -> None: ...


def export_test(
    path: str | os.PathLike[str],
    target: str | os.PathLike[str],
    cycles: bool = False,
    progress: Progress | None = None,
    points: int | None = None,
    steps: Steps | None = None,
) -> int:
    """Write a test's statistics, or its saved cycles, to a .csv or .parquet file; return its rows.

    steps: returns the number of the step of each revolution (n,); statistics and cycles have a
    column of it then. points: puts the cycles on so many crank angles each, by linear
    interpolation, without time and raw signals.

    Columns are named as in the file with the unit at the end (``force_max_N``, ``time_s``); a cycle
    row begins with its revolution. Parquet fields carry ``units`` and ``long_name`` as well.
    progress(done, all) is called after each piece. The target appears when it is whole. Raises
    UnusableInput for an existing target, an unknown ending, an unusable source.
    """
    goal = Path(target)
    _refuse_target(goal)
    if points is not None and not (cycles and points >= FEWEST_POINTS):
        raise UnusableInput(
            f"--points {points}: give {FEWEST_POINTS} or more, for whole cycles (--cycles)"
        )
    with open_test(path) as reader:
        pieces, total = _cycle_pieces(reader, points) if cycles else _row_pieces(reader)
        schema = _schema(reader, cycles, on_grid=points is not None)
        if steps is not None:
            pieces, schema = _with_steps(pieces, steps), _schema_with_steps(schema)
        hidden = goal.parent / f".{goal.name}.part-{os.getpid()}"
        with _finished_file(hidden, goal):
            return _write(hidden, goal.suffix.lower(), schema, pieces, total, progress)


def _with_steps(pieces: Iterator[Table], steps: Steps) -> Iterator[Table]:
    for piece in pieces:
        yield {**piece, STEP: steps(piece["revolution"].astype(np.int64))}


def _schema_with_steps(schema: Any) -> Any:
    import pyarrow

    about = {"units": "1", "long_name": "number of the step of the test"}
    return schema.append(pyarrow.field(STEP, pyarrow.int64(), metadata=about))


def export_columns(
    reader: TestReader, cycles: bool, on_grid: bool = False
) -> dict[str, tuple[str, str, str]]:
    """Return the exported columns by name: column in the file, unit, description."""
    if not cycles:
        columns = reader.plan.revolution_columns
        return {
            _named(one.name, one.unit): (one.name, one.unit, one.description) for one in columns
        }
    found = {"revolution": ("revolution", "1", "number of the revolution")}
    even = {"angle", *(one.name for one in reader.plan.table.curves)}
    for one in reader.plan.cycle_columns:
        if on_grid and one.name not in even:
            continue
        found[_named(one.name, one.unit)] = (one.name, one.unit, one.description)
    return found


def _named(name: str, unit: str) -> str:
    suffix = unit_suffix(unit)
    return name if name.endswith(suffix) else name + suffix


def _row_pieces(reader: TestReader) -> tuple[Iterator[Table], int]:
    total = reader.committed()

    def pieces() -> Iterator[Table]:
        for first in range(0, total, ROWS_AT_A_TIME):
            stop = min(total, first + ROWS_AT_A_TIME)
            names = [one.name for one in reader.plan.revolution_columns]
            yield {name: reader.column(name, first, stop) for name in names}

    return pieces(), total


def _cycle_pieces(reader: TestReader, points: int | None) -> tuple[Iterator[Table], int]:
    total = reader.committed("samples")
    types = {one.name: one.dtype for one in reader.plan.cycle_columns}
    if points is not None:
        total = points * reader.committed("cycles")

    def pieces() -> Iterator[Table]:
        waiting: list[Table] = []
        size = 0
        for stored in reader.cycles():
            if points is not None:
                stored = _on_grid(stored, points, types)
            count = len(next(iter(stored.columns.values())))
            waiting.append({"revolution": np.full(count, stored.revolution), **stored.columns})
            size += count
            if size >= SAMPLES_AT_A_TIME:
                yield _joined(waiting)
                waiting, size = [], 0
        if waiting:
            yield _joined(waiting)

    return pieces(), total


def _on_grid(stored: StoredCycle, points: int, types: Mapping[str, str]) -> StoredCycle:
    even = stored.resampled(points).columns
    return replace(stored, columns={name: one.astype(types[name]) for name, one in even.items()})


def _joined(tables: list[Table]) -> Table:
    return {name: np.concatenate([one[name] for one in tables]) for name in tables[0]}


def _schema(reader: TestReader, cycles: bool, on_grid: bool) -> Any:
    import pyarrow

    columns = reader.plan.cycle_columns if cycles else reader.plan.revolution_columns
    types = {"revolution": "<i8", **{one.name: one.dtype for one in columns}}
    fields = [
        pyarrow.field(
            name,
            pyarrow.from_numpy_dtype(np.dtype(types[source])),
            metadata={"units": unit, "long_name": description},
        )
        for name, (source, unit, description) in export_columns(reader, cycles, on_grid).items()
    ]
    about = {name: str(value) for name, value in reader.metadata().items()}
    return pyarrow.schema(fields, metadata=about)


def _write(
    hidden: Path,
    ending: str,
    schema: Any,
    pieces: Iterator[Table],
    total: int,
    progress: Progress | None,
) -> int:
    import pyarrow

    done = 0
    with contextlib.closing(_sink(hidden, ending, schema)) as sink:
        for piece in pieces:
            arrays = [pyarrow.array(values) for values in piece.values()]
            sink.write(pyarrow.Table.from_arrays(arrays, schema=schema))
            done += len(arrays[0])
            if progress is not None:
                progress(done, total)
    return done


def _sink(path: Path, ending: str, schema: Any) -> _Sink:
    if ending == ".parquet":
        import pyarrow.parquet

        return pyarrow.parquet.ParquetWriter(path, schema, compression="zstd")
    return _CsvSink(path, schema)


class _CsvSink:
    """Write a header of bare names and then tables."""

    def __init__(self, path: Path, schema: Any) -> None:
        import pyarrow.csv

        self._file = path.open("xb")
        self._file.write(",".join(schema.names).encode() + b"\n")
        options = pyarrow.csv.WriteOptions(include_header=False, quoting_style="none")
        self._writer = pyarrow.csv.CSVWriter(self._file, schema, write_options=options)

    def write(self, table: Any) -> None:
        self._writer.write(table)

    def close(self) -> None:
        self._writer.close()
        self._file.close()


def _refuse_target(goal: Path) -> None:
    if goal.suffix.lower() not in FORMATS:
        raise UnusableInput(f"{goal}: the file must end in {' or '.join(FORMATS)}")
    if os.path.lexists(goal):
        raise UnusableInput(f"{goal}: the file exists and is not overwritten; give another name")
    if not goal.parent.is_dir():
        raise UnusableInput(f"{goal}: the folder {goal.parent} does not exist; create it first")


@contextlib.contextmanager
def _finished_file(hidden: Path, goal: Path) -> Iterator[None]:
    """Give the hidden file its name when the block ends well, else remove it."""
    try:
        yield
        move_into_place(hidden, goal)
    except FileExistsError as error:
        raise UnusableInput(
            f"{goal}: the file exists and is not overwritten; give another name"
        ) from error
    except OSError as error:
        raise UnusableInput(f"{goal}: the file cannot be written ({error.strerror})") from error
    finally:
        hidden.unlink(missing_ok=True)
