"""Dead-weight readings of the two-axis load cell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from calibration.arrays import Array, Whole
from calibration.taking.readings import numbers, read_table, series_and_steps, unused_columns

LOAD_CELL_COLUMNS = ("series", "step", "mass_kg", "pin_angle_deg", "signal_1", "signal_2")


@dataclass(frozen=True, slots=True)
class LoadCellReadings:
    """Dead-weight readings in the order taken; arrays of one length, angle in rad, mass in kg.

    unused: the columns of their table that nothing reads.
    """

    series: tuple[str, ...]
    step: Whole
    mass: Array
    angle: Array
    signal: Array
    unused: tuple[str, ...] = ()

    def __len__(self) -> int:
        """Return the number of readings."""
        return len(self.mass)


def parse_load_cell(text: str) -> LoadCellReadings:
    """Read the CSV columns ``LOAD_CELL_COLUMNS``; raise ReadingsError."""
    rows = read_table(text, LOAD_CELL_COLUMNS)
    return LoadCellReadings(
        *series_and_steps(rows),
        mass=numbers(rows, "mass_kg"),
        angle=np.radians(numbers(rows, "pin_angle_deg")),
        signal=np.column_stack((numbers(rows, "signal_1"), numbers(rows, "signal_2"))),
        unused=unused_columns(rows, LOAD_CELL_COLUMNS),
    )
