"""Readings of any calibration: a CSV table of series and steps."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, Protocol

import numpy as np

from rigapp.texts import SentenceError, joined, say
from rigapp_calibration.arrays import Array, Marks, Whole
from rigapp_calibration.problems import Problem, note, refusal

LARGEST = 1e12
"""Far above any quantity of these tables: a larger number has a wrong exponent or comma."""
LARGEST_STEP = 1_000_000_000
"""Limit up to which a step is a whole number in double precision and in int64."""


class ReadingsError(SentenceError, ValueError):
    """A column or line of the readings is unusable; the text names it and the remedy."""


class Stepwise(Protocol):
    """Readings of any kind: each belongs to a series and has a step number in it."""

    @property
    def series(self) -> tuple[str, ...]:
        """Return the series of each reading."""

    @property
    def step(self) -> Whole:
        """Return the step number of each reading."""


def place_of(readings: Stepwise, index: int) -> str:
    """Return the place of a reading, in words."""
    return say("series {}, step {}", readings.series[index], readings.step[index])


def each_series(names: Sequence[str]) -> Iterator[tuple[str, Marks]]:
    """Yield each series in the order taken: its name, and a mask (n,) of its readings."""
    for name in dict.fromkeys(names):
        yield name, np.array([one == name for one in names], dtype=np.bool_)


def not_numbers(readings: Stepwise, columns: Array) -> Iterator[Problem]:
    """Yield the reading with a value that is not a number; columns (n, any)."""
    bad = np.flatnonzero(~np.isfinite(columns).all(axis=1))
    if len(bad):
        more = say(" (and {} more)", len(bad) - 1) if len(bad) > 1 else ""
        words = say("The reading at {} is not a number{}", place_of(readings, int(bad[0])), more)
        yield refusal("not_a_number", "{}; take it again.", words)


FEWEST_OF_A_RUN = 3
"""Steps from the first number on that count as another run; fewer are a repeated number."""


def check_steps(readings: Stepwise, runs: Sequence[Hashable]) -> Iterator[Problem]:
    """Yield mistakes in the column ``step``: repeated, out of order, left out.

    runs (n): the run of each reading (a series, at one pin angle). Starting again at the first
    number makes another run.
    """
    steps = readings.step.tolist()
    twice = numbered_twice(runs, steps)
    if twice is not None:
        yield refusal(
            "duplicated_step",
            (
                "The step number of {} occurs twice in its series at this place; number each"
                " reading of a series in the order taken."
            ),
            place_of(readings, twice),
        )
        return
    left_out: list[str] = []
    for taken in _runs(runs, steps):
        strides = [(steps[after] - steps[before], after) for before, after in pairwise(taken)]
        backward = next((index for stride, index in strides if stride < 0), None)
        if backward is not None:
            yield refusal(
                "unordered_steps",
                (
                    "The step numbers decrease at {}; write the readings in the order taken"
                    " (sorted as text, 11 is before 2)."
                ),
                place_of(readings, backward),
            )
            return
        usual = min((stride for stride, _ in strides), default=1)
        left_out += [place_of(readings, index) for stride, index in strides if stride != usual]
    if left_out:
        more = say(" (and at {} more)", len(left_out) - 1) if len(left_out) > 1 else ""
        yield note(
            "missing_step",
            "A step number is left out before {}{}: a reading that does not count is"
            " better kept as a comment with its reason.",
            left_out[0],
            more,
        )


def numbered_twice(runs: Sequence[Hashable], steps: Sequence[int]) -> int | None:
    """Return the index of a reading whose step number is repeated in its run, or None.

    runs: see ``check_steps``.
    """
    for taken in _runs(runs, steps):
        seen: set[int] = set()
        for index in taken:
            if steps[index] in seen:
                return index
            seen.add(steps[index])
    return None


def _runs(runs: Sequence[Hashable], steps: Sequence[int]) -> Iterator[list[int]]:
    """Yield the indices of each run in the order taken; a restarted one is another."""
    members: dict[Hashable, list[int]] = {}
    for index, run in enumerate(runs):
        members.setdefault(run, []).append(index)
    for taken in members.values():
        numbers, start = [steps[index] for index in taken], 0
        opening = numbers[:FEWEST_OF_A_RUN]
        for place in range(1, len(taken)):
            again = numbers[place : place + FEWEST_OF_A_RUN] == opening
            if again and numbers[place - 1] != numbers[place]:
                yield taken[start:place]
                start = place
        yield taken[start:]


def check_columns(unused: tuple[str, ...]) -> Iterator[Problem]:
    """Yield a note on ignored columns of the table: one may be misspelt."""
    if unused:
        names = joined(", ", unused)
        yield note(
            "unused_columns",
            "The table has columns that are ignored: {}; is one of them misspelt?",
            names,
        )


Row = tuple[int, Mapping[str, Any]]
"""Number of the line in the file, and its fields by column: text, or as taken live."""
Rows = Sequence[Row]


def read_table(text: str, columns: Sequence[str]) -> list[Row]:
    """Return the readings of a CSV as (line, fields); comment lines and empty ones are left out.

    Raises ReadingsError for another separator than the comma, a missing column, a name twice, an
    empty field, a field too many, no reading at all.
    """
    lines = [
        (number, line)
        for number, line in enumerate(text.lstrip("\ufeff").splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise ReadingsError("the file is empty; columns {} are needed", joined(", ", columns))
    reader = csv.DictReader(io.StringIO("\n".join(line for _, line in lines)))
    names = [name.strip() for name in reader.fieldnames or ()]
    missing = [name for name in columns if name not in names]
    if missing:
        _refuse_other_separator(lines[0][1])
        raise ReadingsError(
            "column {} is missing; the header must name {}",
            joined(", ", missing),
            joined(", ", columns),
        )
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ReadingsError("the header names column {} twice; take one out", joined(", ", twice))
    reader.fieldnames = names
    rows: list[Row] = []
    for (number, _), row in zip(lines[1:], reader, strict=True):
        if None in row:
            extra = joined(", ", map(repr, row[None]))
            raise ReadingsError(
                "line {} has more fields than the header's {}: {} at its end; take out"
                " what is too much, and write decimal points, not commas",
                number,
                len(names),
                extra,
            )
        empty = [name for name in columns if row.get(name) in (None, "")]
        if empty:
            raise ReadingsError(
                "line {} has an empty field ({}); complete or remove it",
                number,
                joined(", ", empty),
            )
        rows.append((number, row))
    if not rows:
        raise ReadingsError("there is a header but no reading")
    return rows


SEPARATORS = {";": "semicolons", "\t": "tabs", "|": say("vertical bars")}
"""Separators of spreadsheets other than the comma, with their names."""


def _refuse_other_separator(header: str) -> None:
    """Raise ReadingsError if the header's fields are not separated by commas."""
    separator = max(SEPARATORS, key=header.count)
    if separator in header:
        raise ReadingsError(
            "the fields are separated by {}; separate them by commas, with decimal"
            " points (a spreadsheet does so when it saves as CSV in English)",
            SEPARATORS[separator],
        )


def unused_columns(rows: Rows, columns: Sequence[str]) -> tuple[str, ...]:
    """Return the other columns of a table; one without name and content is ignored."""
    names = [name for name in rows[0][1] if name not in columns]
    return tuple(
        name or say("one without a name")
        for name in names
        if name or any(row[name] for _, row in rows)
    )


def _step(line: int, row: Mapping[str, Any]) -> int:
    try:
        step = float(row["step"])
        if not (step.is_integer() and 0 <= step <= LARGEST_STEP):
            raise ValueError
        return int(step)
    except ValueError as error:
        raise ReadingsError(
            "line {}: step {} is not an integer from 0 on", line, repr(row["step"])
        ) from error


def numbers(rows: Rows, name: str) -> Array:
    """Return a column; NaN for infinite values and for text."""
    values = np.empty(len(rows))
    for index, (line, row) in enumerate(rows):
        try:
            value = float(row[name])
        except ValueError as error:
            raise ReadingsError(
                "line {}: {} {} is not a number", line, name, repr(row[name])
            ) from error
        if LARGEST < abs(value) < math.inf:
            raise ReadingsError(
                "line {}: {} {} is larger than any reading", line, name, repr(row[name])
            )
        values[index] = value if math.isfinite(value) else math.nan
    return values


def series_and_steps(rows: Rows) -> tuple[tuple[str, ...], Whole]:
    """Return the columns ``series`` and ``step``; raise ReadingsError."""
    series = tuple(row["series"].strip() for _, row in rows)
    return series, np.array([_step(line, row) for line, row in rows], dtype=np.int64)
