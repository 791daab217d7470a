"""Readings as taken, whatever is calibrated: a CSV table of series and steps."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Hashable, Iterator, Sequence
from typing import Protocol

import numpy as np

from calibration.arrays import Array, Whole
from calibration.problems import Problem

LARGEST = 1e12
"""No quantity of these tables comes near: a larger number is a slip of exponent or comma."""
LARGEST_STEP = 1_000_000_000
"""So that a step is surely a whole number in double precision and in int64."""


class ReadingsError(ValueError):
    """Say which column or line of the readings cannot be used, and what to do."""


class Stepwise(Protocol):
    """Readings of anything: each belongs to a series and has a step number in it."""

    @property
    def series(self) -> tuple[str, ...]:
        """Return the series of each reading."""

    @property
    def step(self) -> Whole:
        """Return the step number of each reading."""


def place_of(readings: Stepwise, index: int) -> str:
    """Return where a reading stands, in words."""
    return f"series {readings.series[index]}, step {readings.step[index]}"


def not_numbers(readings: Stepwise, columns: Array) -> Iterator[Problem]:
    """Yield which reading has a value that is no number; columns (n, any)."""
    bad = np.flatnonzero(~np.isfinite(columns).all(axis=1))
    if len(bad):
        more = f" (and {len(bad) - 1} more)" if len(bad) > 1 else ""
        words = f"The reading at {place_of(readings, int(bad[0]))} is not a number{more}"
        yield Problem("not_a_number", f"{words}; take it again.")


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
"""Number of the line in the file, and its fields by column."""


def read_table(text: str, columns: tuple[str, ...]) -> list[Row]:
    """Return the readings of a CSV as (line, fields); comment lines and empty ones are left out.

    Raises ReadingsError for a missing column, a name twice, an empty field, no reading at all.
    """
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


def numbers(rows: list[Row], name: str) -> Array:
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


def series_and_steps(rows: list[Row]) -> tuple[tuple[str, ...], Whole]:
    """Return the columns ``series`` and ``step``; raise ReadingsError."""
    series = tuple(row["series"].strip() for _, row in rows)
    return series, np.array([_step(line, row) for line, row in rows], dtype=np.int64)
