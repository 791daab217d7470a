"""Hand a test's data to other programs: CSV or Parquet, a piece at a time."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.extras import from_extra
from rigapp.storage.filesystem.folder import move_into_place
from rigapp.storage.reading.reader import StoredCycle, TestReader, open_test
from rigapp.storage.structure.metadata import unit_suffix

ROWS_AT_A_TIME = 65536  # 18 MB of the columns of every rig
SAMPLES_AT_A_TIME = 1 << 18  # 16 MB of the columns of every rig
FORMATS = (".csv", ".parquet")
FEWEST_POINTS = 8  # fewer say nothing of a revolution

Table = dict[str, NDArray[Any]]
Progress = Callable[[int, int], None]
Steps = Callable[[NDArray[np.int64]], NDArray[np.int64]]


@dataclass(frozen=True, slots=True)
class _Field:
    """One exported column: name with its unit, type as NumPy names it, unit, description."""

    name: str
    dtype: str
    unit: str
    description: str


STEP_FIELD = _Field("step", "<i8", "1", "number of the step of the test")


class _Sink(Protocol):
    def write(self, table: Table) -> None: ...

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
    UnusableInput for an existing target, an unknown ending, an unusable source, and for Parquet
    where pyarrow is not installed.
    """
    goal = Path(target)
    _refuse_target(goal)
    if points is not None and not (cycles and points >= FEWEST_POINTS):
        raise UnusableInput(
            f"--points {points}: give {FEWEST_POINTS} or more, for whole cycles (--cycles)"
        )
    with open_test(path) as reader:
        pieces, total = _cycle_pieces(reader, points) if cycles else _row_pieces(reader)
        fields = _fields(reader, cycles, on_grid=points is not None)
        if steps is not None:
            pieces, fields = _with_steps(pieces, steps), [*fields, STEP_FIELD]
        hidden = goal.parent / f".{goal.name}.part-{os.getpid()}"
        about = {name: str(value) for name, value in reader.metadata().items()}
        with (
            _finished_file(hidden, goal),
            contextlib.closing(_sink(hidden, goal, fields, about)) as sink,
        ):
            return _write(sink, pieces, total, progress)


def _with_steps(pieces: Iterator[Table], steps: Steps) -> Iterator[Table]:
    for piece in pieces:
        yield {**piece, STEP_FIELD.name: steps(piece["revolution"].astype(np.int64))}


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


def _fields(reader: TestReader, cycles: bool, on_grid: bool) -> list[_Field]:
    columns = reader.plan.cycle_columns if cycles else reader.plan.revolution_columns
    types = {"revolution": "<i8", **{one.name: one.dtype for one in columns}}
    return [
        _Field(name, types[source], unit, description)
        for name, (source, unit, description) in export_columns(reader, cycles, on_grid).items()
    ]


def _write(sink: _Sink, pieces: Iterator[Table], total: int, progress: Progress | None) -> int:
    done = 0
    for piece in pieces:
        sink.write(piece)
        done += len(next(iter(piece.values())))
        if progress is not None:
            progress(done, total)
    return done


def _sink(hidden: Path, goal: Path, fields: Sequence[_Field], about: Mapping[str, str]) -> _Sink:
    if goal.suffix.lower() == ".csv":
        return _CsvSink(hidden, fields)
    with from_extra("analysis", f"{goal}: Parquet"):
        return _ParquetSink(hidden, fields, about)


class _ParquetSink:
    """Write tables whose fields carry units and descriptions; the file says of which test."""

    def __init__(self, path: Path, fields: Sequence[_Field], about: Mapping[str, str]) -> None:
        import pyarrow.parquet

        self._arrow = pyarrow
        types = [pyarrow.from_numpy_dtype(np.dtype(one.dtype)) for one in fields]
        about_fields = [{"units": one.unit, "long_name": one.description} for one in fields]
        self._schema = pyarrow.schema(
            [
                pyarrow.field(one.name, kind, metadata=words)
                for one, kind, words in zip(fields, types, about_fields, strict=True)
            ],
            metadata=about,
        )
        self._writer = pyarrow.parquet.ParquetWriter(path, self._schema, compression="zstd")

    def write(self, table: Table) -> None:
        arrays = [self._arrow.array(values) for values in table.values()]
        self._writer.write(self._arrow.Table.from_arrays(arrays, schema=self._schema))

    def close(self) -> None:
        self._writer.close()


class _CsvSink:
    """Write a header of bare names and then tables, each number as short as it reads back."""

    def __init__(self, path: Path, fields: Sequence[_Field]) -> None:
        self._file = path.open("x", encoding="ascii", newline="\n")
        self._file.write(",".join(one.name for one in fields) + "\n")

    def write(self, table: Table) -> None:
        columns = [values.astype(str).tolist() for values in table.values()]
        self._file.writelines(f"{','.join(row)}\n" for row in zip(*columns, strict=True))

    def close(self) -> None:
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
