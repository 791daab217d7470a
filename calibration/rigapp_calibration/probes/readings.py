"""Micrometer readings of a capacitance probe."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp_calibration.arrays import Array, Whole
from rigapp_calibration.taking.readings import (
    Rows,
    numbers,
    read_table,
    series_and_steps,
    unused_columns,
)

FEWEST_POSITIONS = 5
"""Fewer do not separate a curvature from a wrong position."""
PROBE_COLUMNS = ("series", "step", "position_um", "signal_V")
OTHER_COLUMN = "other_signal_V"
"""Voltage of the probe at rest, recorded with each reading by the program itself."""


@dataclass(frozen=True, slots=True)
class ProbeReadings:
    """Micrometer readings in the order taken; position in m, signal in V.

    other: voltage of the probe that is not calibrated, None where it was not read. unused: ignored
    columns of their table.
    """

    series: tuple[str, ...]
    step: Whole
    position: Array
    signal: Array
    other: Array | None = None
    unused: tuple[str, ...] = ()


def parse_probe(text: str) -> ProbeReadings:
    """Read the CSV columns ``PROBE_COLUMNS``, ``OTHER_COLUMN`` if there; raise ReadingsError."""
    return probe_table(read_table(text, PROBE_COLUMNS))


def probe_table(rows: Rows) -> ProbeReadings:
    """Return the readings of a table in SI; raise ReadingsError."""
    other = all(row.get(OTHER_COLUMN) not in (None, "") for _, row in rows)
    return ProbeReadings(
        *series_and_steps(rows),
        position=1e-6 * numbers(rows, "position_um"),
        signal=numbers(rows, "signal_V"),
        other=numbers(rows, OTHER_COLUMN) if other else None,
        unused=unused_columns(rows, (*PROBE_COLUMNS, OTHER_COLUMN)),
    )


@dataclass(frozen=True, slots=True)
class ProbeSettings:
    """Settings of a probe calibration; lengths in m.

    target_radius: of the cylindrical pin, None for a flat target. sensor_radius: of the guarded
    sensing area. gap_at_zero: gap at the micrometer's zero, needed for the cylinder correction.
    nominal: expected sensitivity, m/V with its sign, None when unknown. off_axis: motion of the pin
    across the probe's axis in use. direction: standard uncertainty (rad) of the direction in
    which the micrometer moves, against the follower's axis.
    """

    name: str
    range_volts: float
    micrometer_uncertainty: float
    resolution_volts: float = 0.0
    target_radius: float | None = None
    sensor_radius: float | None = None
    gap_at_zero: float | None = None
    nominal: float | None = None
    off_axis: float = 0.0
    direction: float = 0.0
