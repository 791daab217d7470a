"""Is the micrometer where is written? A robust line through the readings, and what leaves it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array, Marks
from rigapp_calibration.probes.readings import ProbeReadings
from rigapp_calibration.problems import Problem
from rigapp_calibration.taking.readings import place_of

WRONG_POSITION = 0.01
"""Part of the span from which one reading counts as wrong."""


@dataclass(frozen=True, slots=True, eq=False)
class RobustLine:
    """A robust straight line through readings: slope (V/m), residual (V, n), noise (V)."""

    slope: float
    residual: Array
    noise: float


def robust_line(position: Array, signal: Array) -> RobustLine:
    """Fit a line that a few wrong readings do not bend (iteratively reweighted least squares)."""
    weights = np.ones(len(position))
    slope, noise = 0.0, 0.0
    for _ in range(20):
        slope, intercept = np.polyfit(position, signal, 1, w=np.sqrt(weights))
        residual = signal - intercept - slope * position
        noise = max(1.4826 * float(np.median(np.abs(residual))), 1e-9)
        weights = np.minimum(1.0, 2.0 * noise / np.maximum(np.abs(residual), 1e-30)) ** 2
    residual = signal - intercept - slope * position
    return RobustLine(float(slope), residual, noise)


def positions(readings: ProbeReadings, line: RobustLine) -> Iterator[Problem]:
    """Yield a wrong, a skipped or a repeated position, or a wrong probe moved at one step."""
    um = 1e6 * line.residual / line.slope
    span = 1e6 * float(np.ptp(readings.position))
    jumps = np.diff(um)
    noise = 1.4826 * float(np.median(np.abs(jumps))) / math.sqrt(2.0)
    limit = max(6.0 * noise, WRONG_POSITION * span)
    down = falling(readings)
    for at in np.flatnonzero(np.abs(jumps) > limit):
        before, after = int(at), int(at) + 1
        alone = after + 1 == len(um) or abs(um[after + 1] - um[after]) > 0.5 * abs(jumps[at])
        if readings.series[before] != readings.series[after]:
            if alone:
                yield _wrong(readings, um, after)
                return
            continue
        turns = down[before] != down[after]
        if turns and not alone:
            continue
        step = 1e6 * (readings.position[after] - readings.position[before])
        if after + 1 < len(um) and _swapped(um[before : after + 2], step):
            yield Problem(
                "swapped_steps",
                f"At {place_of(readings, after)} and the step after it each voltage belongs to the"
                " other one's position: the two readings were exchanged.",
            )
            return
        goes_back = after + 1 < len(um) and (
            readings.series[after + 1] != readings.series[after]
            or abs(um[after + 1] - um[before]) < 0.5 * abs(jumps[at])
        )
        if goes_back or step == 0.0 or not 0.5 < abs(jumps[at] / step) < 1.5:
            wrong = after if abs(um[after]) >= abs(um[before]) else before
            yield _other_or_wrong(readings, um, wrong)
        elif jumps[at] / step > 0.0:
            yield Problem(
                "skipped_step",
                f"From {place_of(readings, after)} on every voltage belongs to the next position: a"
                f" position was skipped. {1e6 * readings.position[after]:g} um is written, the"
                f" voltage belongs to {1e6 * readings.position[after] + um[after]:.0f} um.",
            )
        else:
            yield Problem(
                "repeated_step",
                f"At {place_of(readings, after)} the micrometer was not turned on: the voltage is"
                f" that of the step before. {1e6 * readings.position[after]:g} um is written.",
            )
        return


def _swapped(um: Array, step: float) -> bool:
    """Tell whether of three residuals (um) the last two are one step up and one step down."""
    first, second = um[1] - um[0], um[2] - um[0]
    return bool(abs(first - step) < 0.3 * abs(step) and abs(second + step) < 0.3 * abs(step))


def _other_or_wrong(readings: ProbeReadings, um: Array, at: int) -> Problem:
    other = readings.other
    if other is not None:
        rest = robust_line(readings.position, other)
        moved = abs(rest.residual[at])
        own = abs(robust_line(readings.position, readings.signal).residual[at])
        if moved > max(6.0 * rest.noise, 0.3 * own):
            return Problem(
                "wrong_probe",
                f"At {place_of(readings, at)} the other probe moved by {moved:.3f} V and this one"
                " stayed behind: the wrong micrometer was turned.",
            )
    return _wrong(readings, um, at)


def _wrong(readings: ProbeReadings, um: Array, at: int) -> Problem:
    written = 1e6 * readings.position[at]
    return Problem(
        "wrong_position",
        f"At {place_of(readings, at)} the voltage belongs to {written + um[at]:.1f} um, but"
        f" {written:.1f} um is written; check the micrometer.",
    )


def falling(readings: ProbeReadings) -> Marks:
    """Tell which readings were reached coming back, within their series.

    A position that is read twice in a row at the turning point belongs to both ways.
    """
    count = len(readings.position)
    result = np.zeros(count, dtype=np.bool_)
    for index in range(1, count):
        if readings.series[index] != readings.series[index - 1]:
            continue
        step = readings.position[index] - readings.position[index - 1]
        if step == 0.0 and index + 1 < count:
            step = readings.position[index + 1] - readings.position[index]
        result[index] = step < 0.0
    return result
