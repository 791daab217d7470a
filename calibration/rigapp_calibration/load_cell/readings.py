"""Dead-weight readings of the two-axis load cell."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import compress

import numpy as np

from rigapp_calibration.arrays import Array, Marks, Whole
from rigapp_calibration.taking.readings import (
    ReadingsError,
    Rows,
    numbers,
    read_table,
    series_and_steps,
    unused_columns,
)

LOAD_CELL_COLUMNS = ("series", "step", "mass_kg", "pin_angle_deg", "signal_1", "signal_2")
HUNG_COLUMN = "hung_s"
"""Seconds that the load has hung, of the readings of the creep; empty, or left out, for others."""


@dataclass(frozen=True, slots=True)
class HungReadings:
    """Readings (k,) under a constant load: mass in kg, time under it in s, angle in rad."""

    mass: Array
    angle: Array
    signal: Array
    time: Array


@dataclass(frozen=True, slots=True)
class LoadCellReadings:
    """Dead-weight readings in the order taken; arrays of one length, angle in rad, mass in kg.

    unused: ignored columns of their table. hung: of the creep, beside the others;
    None where there are none.
    """

    series: tuple[str, ...]
    step: Whole
    mass: Array
    angle: Array
    signal: Array
    unused: tuple[str, ...] = ()
    hung: HungReadings | None = None

    def __len__(self) -> int:
        """Return the number of readings."""
        return len(self.mass)

    def only(self, kept: Marks) -> LoadCellReadings:
        """Return the selected readings."""
        return replace(
            self,
            series=tuple(compress(self.series, kept)),
            step=self.step[kept],
            mass=self.mass[kept],
            angle=self.angle[kept],
            signal=self.signal[kept],
        )


def parse_load_cell(text: str) -> LoadCellReadings:
    """Read the CSV columns ``LOAD_CELL_COLUMNS``, ``HUNG_COLUMN`` if there; raise ReadingsError."""
    return load_cell_table(read_table(text, LOAD_CELL_COLUMNS))


def load_cell_table(table: Rows) -> LoadCellReadings:
    """Return the readings of a table in SI; raise ReadingsError."""
    creep = [one for one in table if str(one[1].get(HUNG_COLUMN) or "").strip()]
    rows = [one for one in table if one not in creep]
    if not rows:
        raise ReadingsError(
            "every reading has a time in {}: all would be of the creep", HUNG_COLUMN
        )
    return LoadCellReadings(
        *series_and_steps(rows),
        *_loads(rows),
        unused=unused_columns(table, (*LOAD_CELL_COLUMNS, HUNG_COLUMN)),
        hung=HungReadings(*_loads(creep), numbers(creep, HUNG_COLUMN)) if creep else None,
    )


def _loads(rows: Rows) -> tuple[Array, Array, Array]:
    """Return mass, angle and signals."""
    return (
        numbers(rows, "mass_kg"),
        np.radians(numbers(rows, "pin_angle_deg")),
        np.column_stack((numbers(rows, "signal_1"), numbers(rows, "signal_2"))),
    )
