"""Readings as taken, checked for what no fit could bear."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LOAD_CELL_COLUMNS = ("series", "step", "mass_kg", "pin_angle_deg", "signal_1", "signal_2")
PROBE_COLUMNS = ("series", "step", "position_um", "signal_V")
LARGEST = 1e12
LARGEST_STEP = 1_000_000_000
OTHER_COLUMN = "other_signal_V"
"""Voltage of the probe that must not move, taken with each reading by the program itself."""


class ReadingsError(ValueError):
    """Say which column or line of the readings cannot be used, and what to do."""


@dataclass(frozen=True, slots=True)
class LoadCellReadings:
    """Dead-weight readings in the order taken; arrays of one length, angle in rad, mass in kg."""

    series: tuple[str, ...]
    step: NDArray[np.int64]
    mass: Array
    angle: Array
    signal: Array

    def __len__(self) -> int:
        """Return the number of readings."""
        return len(self.mass)


@dataclass(frozen=True, slots=True)
class ProbeReadings:
    """Micrometer readings in the order taken; position in m, signal in V.

    other: voltage of the probe that is not calibrated, None where it was not read.
    """

    series: tuple[str, ...]
    step: NDArray[np.int64]
    position: Array
    signal: Array
    other: Array | None = None


def parse_load_cell(text: str) -> LoadCellReadings:
    """Read the CSV columns ``LOAD_CELL_COLUMNS``; raise ReadingsError."""
    rows = _table(text, LOAD_CELL_COLUMNS)
    return LoadCellReadings(
        series=tuple(row["series"].strip() for _, row in rows),
        step=np.array([_step(line, row) for line, row in rows], dtype=np.int64),
        mass=_numbers(rows, "mass_kg"),
        angle=np.radians(_numbers(rows, "pin_angle_deg")),
        signal=np.column_stack((_numbers(rows, "signal_1"), _numbers(rows, "signal_2"))),
    )


def parse_probe(text: str) -> ProbeReadings:
    """Read the CSV columns ``PROBE_COLUMNS``, ``OTHER_COLUMN`` if there; raise ReadingsError."""
    rows = _table(text, PROBE_COLUMNS)
    other = all(row.get(OTHER_COLUMN) not in (None, "") for _, row in rows)
    return ProbeReadings(
        series=tuple(row["series"].strip() for _, row in rows),
        step=np.array([_step(line, row) for line, row in rows], dtype=np.int64),
        position=1e-6 * _numbers(rows, "position_um"),
        signal=_numbers(rows, "signal_V"),
        other=_numbers(rows, OTHER_COLUMN) if other else None,
    )


FEWEST_OF_A_RUN = 3
"""So many steps from the first number on are another run, fewer are a number written twice."""


def numbered_twice(runs: Sequence[Hashable], steps: Sequence[int]) -> int | None:
    """Return the index of a reading whose step number its run has already, None when there is none.

    runs: what belongs together (a series, at one pin angle). A run that begins again at its first
    number and goes on is another one.
    """
    numbers: dict[Hashable, list[tuple[int, int]]] = {}
    for index, (run, step) in enumerate(zip(runs, steps, strict=True)):
        numbers.setdefault(run, []).append((step, index))
    for taken in numbers.values():
        seen: set[int] = set()
        for place, (step, index) in enumerate(taken):
            first, rest = taken[0][0], [one for one, _ in taken[place:]]
            again = step == first and place and taken[place - 1][0] != first
            if again and rest[:FEWEST_OF_A_RUN] == [one for one, _ in taken[:FEWEST_OF_A_RUN]]:
                seen.clear()
            elif step in seen:
                return index
            seen.add(step)
    return None


Row = tuple[int, dict[str, str]]


def _table(text: str, columns: tuple[str, ...]) -> list[Row]:
    lines = [
        (number, line)
        for number, line in enumerate(text.lstrip("\ufeff").splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise ReadingsError(f"the file is empty; columns {', '.join(columns)} are needed")
    reader = csv.DictReader(io.StringIO("\n".join(line for _, line in lines)))
    names = [name.strip() for name in reader.fieldnames or ()]
    missing = [name for name in columns if name not in names]
    if missing:
        raise ReadingsError(
            f"column {', '.join(missing)} is missing; the header must name {', '.join(columns)}"
        )
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ReadingsError(f"the header names column {', '.join(twice)} twice; take one out")
    reader.fieldnames = names
    rows = []
    for (number, _), row in zip(lines[1:], reader, strict=True):
        if None in row:
            raise ReadingsError(
                f"line {number} has more fields than the header's {len(names)}; take out what is"
                " too much, and write decimal points, not commas"
            )
        if any(row.get(name) in (None, "") for name in columns):
            raise ReadingsError(f"line {number} has an empty field; complete or remove it")
        rows.append((number, row))
    if not rows:
        raise ReadingsError("there is a header but no reading")
    return rows


def _step(line: int, row: dict[str, str]) -> int:
    try:
        step = float(row["step"])
        if not step.is_integer() or abs(step) > LARGEST_STEP:
            raise ValueError
        return int(step)
    except ValueError as error:
        raise ReadingsError(f"line {line}: step {row['step']!r} is not a whole number") from error


def _numbers(rows: list[Row], name: str) -> Array:
    """Return a column; NaN for what is written as infinite or as no number."""
    values = np.empty(len(rows))
    for index, (line, row) in enumerate(rows):
        try:
            value = float(row[name])
        except ValueError as error:
            raise ReadingsError(f"line {line}: {name} {row[name]!r} is not a number") from error
        if LARGEST < abs(value) < math.inf:
            raise ReadingsError(f"line {line}: {name} {row[name]!r} is larger than any reading")
        values[index] = value if math.isfinite(value) else math.nan
    return values
