"""Calibrate a capacitance probe from micrometer steps: V = V0 + S d, and what it is worth."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.probes.checks import checks, unusable
from rigapp_calibration.probes.cylinder import apparent_gap, sensitivity_gain
from rigapp_calibration.probes.positions import robust_line
from rigapp_calibration.probes.readings import ProbeReadings
from rigapp_calibration.probes.settings import ProbeSettings
from rigapp_calibration.problems import Problem, blocked
from rigapp_calibration.taking.uncertainty import Budget, Contribution, at_most, combine


@dataclass(frozen=True, slots=True)
class ProbeCalibration:
    """The result: position = sensitivity (voltage - offset), m/V and V; None when refused early.

    linearity: largest residual over the range, best-fit line, per cent. residual_std in m.
    hysteresis: mean difference between falling and rising steps, m. gain: cylinder correction
    included in the sensitivity (1 without). budget: of one position, m.
    """

    accepted: bool
    problems: tuple[Problem, ...]
    sensitivity: float | None = None
    offset: float | None = None
    sensitivity_uncertainty: float | None = None
    linearity: float | None = None
    residual_std: float | None = None
    hysteresis: float | None = None
    gain: float = 1.0
    residual: Array | None = None
    budget: Budget | None = None

    @property
    def expanded(self) -> float | None:
        """Return the expanded uncertainty of one position, m."""
        return None if self.budget is None else self.budget.expanded

    @property
    def coverage_factor(self) -> float | None:
        """Return the coverage factor."""
        return None if self.budget is None else self.budget.coverage_factor


def calibrate_probe(readings: ProbeReadings, settings: ProbeSettings) -> ProbeCalibration:
    """Fit, check and judge; a calibration with a blocking problem is not accepted."""
    problems = list(unusable(readings, settings))
    if blocked(problems):
        return ProbeCalibration(False, tuple(problems))
    line = robust_line(readings.position, readings.signal)
    if line.slope == 0.0:
        flat = Problem("probe_dead", "The voltage does not change with the position.")
        return ProbeCalibration(False, (flat,))
    return _result(readings, settings, [*problems, *checks(readings, settings, line)])


def _hysteresis(readings: ProbeReadings, residual: Array) -> float | None:
    """Return the mean of falling less rising at common positions, m."""
    rising: dict[float, list[float]] = {}
    falling: dict[float, list[float]] = {}
    last: dict[str, float] = {}
    direction: dict[str, float] = {}
    for name, position, value in zip(readings.series, readings.position, residual, strict=True):
        if name in last and position != last[name]:
            direction[name] = position - last[name]
        last[name] = float(position)
        side = rising if direction.get(name, 1.0) > 0.0 else falling
        side.setdefault(round(float(position), 9), []).append(float(value))
    common = [p for p in set(rising) & set(falling) if p < max(rising)]
    if not common:
        return None
    return float(np.mean([np.mean(falling[p]) - np.mean(rising[p]) for p in common]))


def _result(
    readings: ProbeReadings, settings: ProbeSettings, problems: list[Problem]
) -> ProbeCalibration:
    count = len(readings.position)
    slope, intercept = np.polyfit(readings.position, readings.signal, 1)
    residual = readings.signal / slope - intercept / slope - readings.position
    std = math.sqrt(float(np.sum(residual**2)) / (count - 2))
    span = float(np.ptp(readings.position))
    gain, bending = _cylinder(readings, settings)
    spread = float(np.sqrt(np.sum((readings.position - readings.position.mean()) ** 2)))
    relative = std / spread
    hysteresis = _hysteresis(readings, residual)
    free = float(count - 2)
    lines = (
        Contribution("residual of the line", std, free, "A", averages=True),
        Contribution("slope", 0.5 * span * relative, free, "A"),
        Contribution("micrometer", settings.micrometer_uncertainty),
        at_most("resolution", 0.5 * settings.resolution_volts / abs(slope)),
        Contribution("backlash", abs(hysteresis or 0.0) / 2.0, math.inf, "A", "two-point"),
        at_most("cylindrical target, change of sensitivity", bending),
        at_most("motion across the axis", _off_axis(settings)),
        at_most("direction of the probe", settings.direction * settings.off_axis),
    )
    return ProbeCalibration(
        accepted=not blocked(problems),
        problems=tuple(problems),
        sensitivity=float(1.0 / (slope * gain)),
        offset=float(intercept),
        sensitivity_uncertainty=relative,
        linearity=float(100.0 * np.max(np.abs(residual)) / span),
        residual_std=std,
        hysteresis=hysteresis,
        gain=gain,
        residual=residual,
        budget=combine(0.0, lines),
    )


def _cylinder(readings: ProbeReadings, settings: ProbeSettings) -> tuple[float, float]:
    """Return the gain at the middle of the range and what its change over the range makes, m."""
    if not (settings.target_radius and settings.sensor_radius and settings.gap_at_zero):
        return 1.0, 0.0
    sensor, target = settings.sensor_radius, settings.target_radius
    gap = settings.gap_at_zero + np.unique(readings.position)
    middle = settings.gap_at_zero + float(np.mean(readings.position))
    gain = float(sensitivity_gain(middle, sensor, target))
    straight = apparent_gap(middle, sensor, target) + gain * (gap - middle)
    bending = np.abs(apparent_gap(gap, sensor, target) - straight).max() / gain
    return gain, float(bending)


def _off_axis(settings: ProbeSettings) -> float:
    """Return what a motion across the axis reads on a cylindrical pin, y^2 / (2 R), m."""
    if not settings.target_radius:
        return 0.0
    return settings.off_axis**2 / (2.0 * settings.target_radius)
