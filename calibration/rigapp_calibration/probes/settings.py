"""What must be known of a probe beside its readings. SI."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class ProbeSettings:
    """Gather the settings of a probe calibration; lengths in m.

    target_radius: of the cylindrical pin, None for a flat target. sensor_radius: of the guarded
    sensing area. gap_at_zero: gap at the micrometer's zero, needed for the cylinder correction.
    nominal: expected sensitivity, m/V with its sign, None when unknown. off_axis: how far the pin
    moves across the probe's axis in use. direction: standard uncertainty (rad) of the direction in
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
