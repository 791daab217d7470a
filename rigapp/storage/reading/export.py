"""Export a test's data as CSV, Parquet or .xlsx, a piece at a time."""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput, from_extra
from rigapp.config.writing import part_name
from rigapp.storage.filesystem.folder import move_into_place
from rigapp.storage.reading.reader import StoredCycle, TestReader, open_test
from rigapp.storage.structure.metadata import unit_suffix
from rigapp.texts import joined, say

ROWS_AT_A_TIME = 65536  # 18 MB of the columns of every rig
SAMPLES_AT_A_TIME = 1 << 18  # 16 MB of the columns of every rig
FORMATS = (".csv", ".parquet", ".xlsx")
FEWEST_POINTS = 8  # fewer cannot represent a revolution

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


@dataclass(frozen=True, slots=True)
class Dialect:
    """Decimal mark and separator of a CSV file.

    Raises UnusableInput where one number could be read as two.
    """

    separator: str = ","
    decimal: str = "."

    def __post_init__(self) -> None:
        if self.decimal not in DECIMALS:
            raise UnusableInput("--decimal {}: give . or a comma", repr(self.decimal))
        if self.separator not in SEPARATORS:
            raise UnusableInput(
                "--separator {}: give a comma, a semicolon or tab", repr(self.separator)
            )
        if self.separator == self.decimal:
            raise UnusableInput(
                'A comma cannot separate numbers that have one: add --separator ";"'
            )


DECIMALS = (".", ",")
SEPARATORS = (",", ";", "\t")
DEFAULT_DIALECT = Dialect()
"""Numbers with a point, separated by commas."""

MOST_EXCEL_ROWS = 1_048_576 - 1
"""Rows of an Excel sheet below its header."""


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
    dialect: Dialect = DEFAULT_DIALECT,
) -> int:
    """Write a test's statistics or saved cycles to a .csv, .parquet or .xlsx file; return its rows.

    steps: returns the step number of each revolution (n,), exported as a further column. points:
    number of crank angles to which each cycle is resampled by linear interpolation, without time
    and raw signals.

    Columns are named as in the file with the unit at the end (``force_max_N``, ``time_s``); a cycle
    row begins with its revolution. Parquet fields carry ``units`` and ``long_name`` as well; an
    .xlsx file has a sheet of units and one of the test's settings, and date and time of each
    revolution in UTC and local time. dialect: of a .csv file. progress(done, all) is called after
    each piece. The target appears when it is complete. Raises UnusableInput for an existing target,
    an unknown suffix, an unusable source, more rows than a sheet holds, and where the package that
    writes Parquet or .xlsx is not installed.
    """
    goal = Path(target)
    _refuse_target(goal)
    if points is not None and not (cycles and points >= FEWEST_POINTS):
        raise UnusableInput(
            "--points {}: give {} or more, for complete cycles (--cycles)", points, FEWEST_POINTS
        )
    with open_test(path) as reader:
        pieces, total = _cycle_pieces(reader, points) if cycles else _row_pieces(reader)
        fields = _fields(reader, cycles, on_grid=points is not None)
        if steps is not None:
            pieces, fields = _with_steps(pieces, steps), [*fields, STEP_FIELD]
        hidden = goal.parent / part_name(goal.name)
        about = {name: str(value) for name, value in reader.metadata().items()}
        ending = goal.suffix.lower()
        if ending != ".csv" and dialect != DEFAULT_DIALECT:
            raise UnusableInput("{}: --decimal and --separator are of .csv files", goal)
        if ending == ".xlsx":
            if total > MOST_EXCEL_ROWS:
                raise UnusableInput(
                    "{}: {} rows, and a sheet of Excel holds {}; export .csv or .parquet",
                    goal,
                    total,
                    MOST_EXCEL_ROWS,
                )
            about |= _settings(reader)
            if not cycles:
                pieces, fields = _with_clock(pieces), [*fields, *CLOCK_FIELDS]
        with (
            _finished_file(hidden, goal),
            contextlib.closing(_sink(hidden, goal, fields, about, dialect)) as sink,
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
            _named(column.name, column.unit): (column.name, column.unit, column.description)
            for column in columns
        }
    result = {"revolution": ("revolution", "1", "number of the revolution")}
    even = {"angle", *(curve.name for curve in reader.plan.table.curves)}
    for column in reader.plan.cycle_columns:
        if on_grid and column.name not in even:
            continue
        result[_named(column.name, column.unit)] = (column.name, column.unit, column.description)
    return result


def _named(name: str, unit: str) -> str:
    suffix = unit_suffix(unit)
    return name if name.endswith(suffix) else name + suffix


def _row_pieces(reader: TestReader) -> tuple[Iterator[Table], int]:
    total = reader.committed()

    def pieces() -> Iterator[Table]:
        for first in range(0, total, ROWS_AT_A_TIME):
            stop = min(total, first + ROWS_AT_A_TIME)
            names = [column.name for column in reader.plan.revolution_columns]
            yield {name: reader.column(name, first, stop) for name in names}

    return pieces(), total


def _cycle_pieces(reader: TestReader, points: int | None) -> tuple[Iterator[Table], int]:
    total = reader.committed("samples")
    types = {column.name: column.dtype for column in reader.plan.cycle_columns}
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
    return replace(stored, columns={name: v.astype(types[name]) for name, v in even.items()})


def _joined(tables: list[Table]) -> Table:
    return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}


def _fields(reader: TestReader, cycles: bool, on_grid: bool) -> list[_Field]:
    columns = reader.plan.cycle_columns if cycles else reader.plan.revolution_columns
    types = {"revolution": "<i8", **{column.name: column.dtype for column in columns}}
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


def _sink(
    hidden: Path,
    goal: Path,
    fields: Sequence[_Field],
    about: Mapping[str, str],
    dialect: Dialect,
) -> _Sink:
    if goal.suffix.lower() == ".csv":
        return _CsvSink(hidden, fields, dialect)
    if goal.suffix.lower() == ".xlsx":
        with from_extra("analysis", f"{goal}: .xlsx"):
            return _ExcelSink(hidden, fields, about)
    with from_extra("analysis", f"{goal}: Parquet"):
        return _ParquetSink(hidden, fields, about)


class _ParquetSink:
    """Write tables whose fields carry units and descriptions, with the test's metadata."""

    def __init__(self, path: Path, fields: Sequence[_Field], about: Mapping[str, str]) -> None:
        import pyarrow.parquet

        self._arrow = pyarrow
        types = [pyarrow.from_numpy_dtype(np.dtype(field.dtype)) for field in fields]
        about_fields = [{"units": field.unit, "long_name": field.description} for field in fields]
        self._schema = pyarrow.schema(
            [
                pyarrow.field(field.name, kind, metadata=words)
                for field, kind, words in zip(fields, types, about_fields, strict=True)
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
    """Write a header of names and then tables, each number in its shortest exact form."""

    def __init__(self, path: Path, fields: Sequence[_Field], dialect: Dialect) -> None:
        self._file = path.open("xb")
        self._dialect = dialect
        names = (field.name for field in fields)
        self._file.write(f"{dialect.separator.join(names)}\n".encode())

    def write(self, table: Table) -> None:
        between, decimal = (
            mark.encode() for mark in (self._dialect.separator, self._dialect.decimal)
        )
        rows = list(zip(*map(_cells, table.values()), strict=True))
        # A JSON encoder writes the same numbers, three times as fast as a loop.
        lines = msgspec.json.encode(rows)[2:-2].replace(b"],[", b"\n") + b"\n"
        if between != b",":
            lines = lines.replace(b",", between)
        self._file.write(lines if decimal == b"." else lines.replace(b".", decimal))

    def close(self) -> None:
        self._file.close()


_PLAIN = (1e-4, 1e15)
"""Range of magnitudes that both NumPy and JSON write without an exponent."""


def _cells(values: NDArray[Any]) -> list[Any]:
    """Return a column's values for the encoder: numbers, or texts where JSON would differ."""
    if values.dtype.kind in "iu":
        return values.tolist()
    if values.dtype == np.float64:
        size = np.abs(values)
        if np.all((size == 0.0) | ((size >= _PLAIN[0]) & (size < _PLAIN[1]))):
            return values.tolist()
    return [msgspec.Raw(text) for text in np.char.encode(values.astype(str), "ascii").tolist()]


class _ExcelSink:
    """Write a sheet of the data, one of the columns' units, one of the test's settings."""

    def __init__(self, path: Path, fields: Sequence[_Field], about: Mapping[str, str]) -> None:
        import xlsxwriter

        # Every cell is plain data: a text must not act as a formula or link.
        options = {
            "constant_memory": True, "strings_to_formulas": False, "strings_to_urls": False,
            "nan_inf_to_errors": False,
        }  # fmt: skip
        self._stream = path.open("xb")
        self._book = xlsxwriter.Workbook(self._stream, options)
        bold = self._book.add_format({"bold": True})
        self._clock = self._book.add_format({"num_format": "yyyy-mm-dd hh:mm:ss.000"})
        self._data = self._book.add_worksheet("Data")
        self._data.freeze_panes(1, 1)
        for column, field in enumerate(fields):
            self._data.write_string(0, column, field.name, bold)
        self._row = 1
        self._sheet("Units", ("column", "unit", "what it is"), bold, [
            (field.name, field.unit, field.description) for field in fields
        ])  # fmt: skip
        self._sheet("Settings", ("what", "value"), bold, list(about.items()))

    def _sheet(
        self, name: str, head: Sequence[str], bold: Any, rows: Sequence[Sequence[str]]
    ) -> None:
        sheet = self._book.add_worksheet(name)
        sheet.set_column(0, len(head) - 1, 40)
        for column, word in enumerate(head):
            sheet.write_string(0, column, word, bold)
        for number, row in enumerate(rows, 1):
            for column, word in enumerate(row):
                sheet.write_string(number, column, word[:LONGEST_CELL])

    def write(self, table: Table) -> None:
        for row in zip(*(values.tolist() for values in table.values()), strict=True):
            for column, value in enumerate(row):
                if isinstance(value, datetime):
                    self._data.write_datetime(self._row, column, value, self._clock)
                elif isinstance(value, str):
                    self._data.write_string(self._row, column, value)
                elif math.isfinite(value):
                    self._data.write_number(self._row, column, value)
            self._row += 1

    def close(self) -> None:
        self._book.close()
        self._stream.close()


LONGEST_CELL = 32_767
"""Maximum number of characters in an Excel cell."""

CLOCK_FIELDS = (
    _Field("date_time_UTC", "object", "1", "when the revolution ended, UTC"),
    _Field("date_time_local", "object", "1", "the same, as the clock of the exporting computer"),
)


def _with_clock(pieces: Iterator[Table]) -> Iterator[Table]:
    """Add date and time of each revolution in UTC and local time, to the millisecond."""
    for piece in pieces:
        moments = [
            datetime.fromtimestamp(time, UTC) if math.isfinite(time) else None
            for time in piece["host_time"].tolist()
        ]
        local = [moment and moment.astimezone() for moment in moments]
        # Excel has no time zones; the heading names the clock.
        yield piece | {
            field.name: np.array([t and t.replace(tzinfo=None) for t in times], dtype=object)
            for field, times in zip(CLOCK_FIELDS, (moments, local), strict=True)
        }


def _settings(reader: TestReader) -> dict[str, str]:
    """Return the settings of the rig and test files by name, one row of the sheet each."""
    result: dict[str, str] = {}
    for name, text in reader.configuration().items():
        for number, line in enumerate(str(text).splitlines(), 1):
            if line.strip():
                result[f"{name}, line {number}"] = line
    return result


def _refuse_target(goal: Path) -> None:
    if goal.suffix.lower() not in FORMATS:
        raise UnusableInput("{}: the file must end in {}", goal, joined(say(" or "), FORMATS))
    if os.path.lexists(goal):
        raise UnusableInput("{}: the file exists and is not overwritten; give another name", goal)
    if not goal.parent.is_dir():
        raise UnusableInput("{}: the folder {} does not exist; create it first", goal, goal.parent)


@contextlib.contextmanager
def _finished_file(hidden: Path, goal: Path) -> Iterator[None]:
    """Rename the hidden file to its final name when the block succeeds, else remove it."""
    try:
        yield
        move_into_place(hidden, goal)
    except FileExistsError as error:
        raise UnusableInput(
            "{}: the file exists and is not overwritten; give another name", goal
        ) from error
    except OSError as error:
        raise UnusableInput("{}: the file cannot be written ({})", goal, error.strerror) from error
    finally:
        hidden.unlink(missing_ok=True)
