"""Micrometer readings of a capacitance probe."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp_calibration.arrays import Array, Whole
from rigapp_calibration.taking.readings import numbers, read_table, series_and_steps, unused_columns

FEWEST_POSITIONS = 5
"""Fewer do not tell a bend from a wrong position."""
PROBE_COLUMNS = ("series", "step", "position_um", "signal_V")
OTHER_COLUMN = "other_signal_V"
"""Voltage of the probe that must not move, taken with each reading by the program itself."""


@dataclass(frozen=True, slots=True)
class ProbeReadings:
    """Micrometer readings in the order taken; position in m, signal in V.

    other: voltage of the probe that is not calibrated, None where it was not read. unused: the
    columns of their table that nothing reads.
    """

    series: tuple[str, ...]
    step: Whole
    position: Array
    signal: Array
    other: Array | None = None
    unused: tuple[str, ...] = ()


def parse_probe(text: str) -> ProbeReadings:
    """Read the CSV columns ``PROBE_COLUMNS``, ``OTHER_COLUMN`` if there; raise ReadingsError."""
    rows = read_table(text, PROBE_COLUMNS)
    other = all(row.get(OTHER_COLUMN) not in (None, "") for _, row in rows)
    return ProbeReadings(
        *series_and_steps(rows),
        position=1e-6 * numbers(rows, "position_um"),
        signal=numbers(rows, "signal_V"),
        other=numbers(rows, OTHER_COLUMN) if other else None,
        unused=unused_columns(rows, (*PROBE_COLUMNS, OTHER_COLUMN)),
    )
