"""Calibrate a capacitance probe from micrometer steps: V = V0 + S d, and what it is worth."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import GTC
import numpy as np
from GTC import reporting
from numpy.typing import NDArray

from calibration.cylinder import sensitivity_gain
from calibration.problems import Problem
from calibration.readings import ProbeReadings
from calibration.settings import ProbeSettings

Array = NDArray[np.float64]

FEWEST_POSITIONS = 5
GOOD_POSITIONS = 11


@dataclass(frozen=True, slots=True)
class ProbeCalibration:
    """The result: position = sensitivity (voltage - offset), m/V and V; None when refused early.

    linearity: largest residual over the range, best-fit line, per cent. residual_std in m.
    hysteresis: mean difference between falling and rising steps, m. gain: cylinder correction
    included in the sensitivity (1 without). expanded: uncertainty of one position, m.
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
    combined: float | None = None
    expanded: float | None = None
    coverage_factor: float | None = None
    residual: Array | None = None


def calibrate_probe(readings: ProbeReadings, settings: ProbeSettings) -> ProbeCalibration:
    """Fit, check and judge; a calibration with a blocking problem is not accepted."""
    problems = list(_unusable(readings))
    if problems:
        return ProbeCalibration(False, tuple(problems))
    slope, intercept, residual, noise = _line(readings)
    if slope == 0.0:
        flat = Problem("probe_dead", "The voltage does not change with the position.")
        return ProbeCalibration(False, (flat,))
    problems += _steps(readings, settings, slope, residual, noise)
    return _result(readings, settings, slope, intercept, residual, problems)


def _unusable(readings: ProbeReadings) -> Iterator[Problem]:
    columns = np.column_stack((readings.position, readings.signal))
    bad = np.flatnonzero(~np.isfinite(columns).all(axis=1))
    if len(bad):
        where = f"series {readings.series[bad[0]]}, step {readings.step[bad[0]]}"
        yield Problem("not_a_number", f"The reading at {where} is not a number; take it again.")
        return
    count = len(np.unique(readings.position))
    if count < FEWEST_POSITIONS:
        yield Problem(
            "too_few_positions",
            f"Only {count} micrometer positions; take at least {FEWEST_POSITIONS}, better"
            f" {GOOD_POSITIONS}, up and down.",
        )
    if len(readings.signal) and np.ptp(readings.signal) == 0.0:
        yield Problem(
            "probe_dead",
            "The voltage never changes; is the probe connected and the target grounded?",
        )


def _line(readings: ProbeReadings) -> tuple[float, float, Array, float]:
    """Return slope (V/m), intercept (V), residual (V) and noise (V) of a robust straight line."""
    position, signal = readings.position, readings.signal
    weights = np.ones(len(position))
    slope, intercept, noise = 0.0, 0.0, 0.0
    for _ in range(20):
        slope, intercept = np.polyfit(position, signal, 1, w=np.sqrt(weights))
        residual = signal - intercept - slope * position
        noise = max(1.4826 * float(np.median(np.abs(residual))), 1e-9)
        weights = np.minimum(1.0, 2.0 * noise / np.maximum(np.abs(residual), 1e-30)) ** 2
    return float(slope), float(intercept), signal - intercept - slope * position, noise


def _steps(
    readings: ProbeReadings, settings: ProbeSettings, slope: float, residual: Array, noise: float
) -> Iterator[Problem]:
    span = float(np.ptp(readings.position))
    saturated = np.abs(readings.signal) >= 0.999 * settings.range_volts
    if np.any(saturated):
        at = int(np.flatnonzero(saturated)[0])
        yield Problem(
            "saturated",
            f"The voltage reaches {readings.signal[at]:.2f} V at"
            f" {1e6 * readings.position[at]:.0f} um, the end of the range; move the probe or choose"
            " a larger range.",
        )
    off = np.abs(residual) > max(6.0 * noise, 0.01 * abs(slope) * span)
    if 0 < np.count_nonzero(off & ~saturated) <= 0.3 * len(residual):
        at = int(np.flatnonzero(off & ~saturated)[0])
        yield Problem(
            "wrong_position",
            f"At series {readings.series[at]}, step {readings.step[at]} the voltage belongs to"
            f" {1e6 * (readings.position[at] + residual[at] / slope):.1f} um, but"
            f" {1e6 * readings.position[at]:.1f} um is written; check the micrometer.",
        )
    for first, second in pairwise(range(len(residual))):
        step = readings.position[second] - readings.position[first]
        seen = (readings.signal[second] - readings.signal[first]) / slope
        backward = step * seen < 0.0 and abs(seen) > 6.0 * noise / abs(slope)
        if backward and readings.series[first] == readings.series[second]:
            yield Problem(
                "not_monotonic",
                f"From step {readings.step[first]} to {readings.step[second]} of series"
                f" {readings.series[first]} the voltage went the wrong way.",
            )
            break
    backlash = _hysteresis(readings, residual / slope)
    if backlash is None:
        yield Problem(
            "one_direction",
            "No position was read both going out and coming back; backlash is unknown.",
            blocks=False,
        )
    elif abs(backlash) > 0.005 * span:
        yield Problem(
            "backlash",
            f"Coming back reads {1e6 * backlash:+.2f} um against going out: approach every position"
            " from one side.",
        )
    if len(np.unique(readings.position)) < GOOD_POSITIONS:
        yield Problem(
            "few_positions",
            f"Fewer than {GOOD_POSITIONS} positions; linearity is known only roughly.",
            blocks=False,
        )


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
    readings: ProbeReadings,
    settings: ProbeSettings,
    slope: float,
    intercept: float,
    residual: Array,
    problems: list[Problem],
) -> ProbeCalibration:
    gain = 1.0
    if settings.target_radius and settings.sensor_radius and settings.gap_at_zero:
        middle = settings.gap_at_zero + float(np.mean(readings.position))
        gain = float(sensitivity_gain(middle, settings.sensor_radius, settings.target_radius))
    count = len(residual)
    slope_plain, intercept_plain = np.polyfit(readings.position, readings.signal, 1)
    plain = readings.signal - intercept_plain - slope_plain * readings.position
    std = math.sqrt(float(np.sum(plain**2)) / (count - 2)) / abs(slope_plain)
    spread = float(np.sqrt(np.sum((readings.position - readings.position.mean()) ** 2)))
    span = float(np.ptp(readings.position))
    slope_uncertainty = std / spread
    hysteresis = _hysteresis(readings, plain / slope_plain)
    total = (
        GTC.ureal(0.0, std, df=count - 2, label="residual of the line")
        + GTC.ureal(0.0, 0.5 * span * slope_uncertainty, df=count - 2, label="slope")
        + GTC.ureal(0.0, settings.micrometer_uncertainty, label="micrometer")
        + GTC.ureal(
            0.0, settings.resolution_volts / abs(slope_plain) / math.sqrt(12.0), label="resolution"
        )
        + GTC.ureal(0.0, abs(hysteresis or 0.0) / 2.0 / math.sqrt(3.0), label="backlash")
    )
    combined = float(GTC.uncertainty(total))
    factor = float(reporting.k_factor(float(GTC.dof(total))))
    return ProbeCalibration(
        accepted=not any(problem.blocks for problem in problems),
        problems=tuple(problems),
        sensitivity=float(1.0 / (slope_plain * gain)),
        offset=float(intercept_plain),
        sensitivity_uncertainty=float(slope_uncertainty / abs(slope_plain)),
        linearity=float(100.0 * np.max(np.abs(plain / slope_plain)) / span),
        residual_std=std,
        hysteresis=hysteresis,
        gain=gain,
        combined=combined,
        expanded=factor * combined,
        coverage_factor=factor,
        residual=plain / slope_plain,
    )
