"""Checks of micrometer readings that name the mistake and its step."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rigapp_calibration.arrays import Array, Marks
from rigapp_calibration.probes.readings import FEWEST_POSITIONS, ProbeReadings, ProbeSettings
from rigapp_calibration.problems import Problem, blocked, note, refusal
from rigapp_calibration.taking.readings import (
    check_columns,
    check_steps,
    each_series,
    not_numbers,
    place_of,
)

GOOD_POSITIONS = 11
"""With ten steps a curvature is distinguishable from errors of single positions."""
LIMIT_OF_SPAN = 0.005
"""Part of the span allowed for backlash and drift."""
NONLINEAR = 0.01
"""Part of the span allowed for curvature: makers state linearities of 0.2 to 0.5 %."""
SENSITIVITY_OFF = 0.3
"""Relative: a target or a cable changes it by less; the next range of an amplifier by more."""
UNIT_OFF = 100.0
"""Ratio from which the unit is wrong: millimetres for micrometres are a factor of 1000."""
SHORT_SPAN = 5e-6
"""Span (m) below which no probe changes by half a volt, unless millimetres are written."""
OTHER_MOVES = 0.3
"""Part of its own voltage that a misaligned pair may show on the other probe."""


def unusable(readings: ProbeReadings, settings: ProbeSettings) -> Iterator[Problem]:
    """Yield problems that make a fit useless."""
    columns = [readings.position, readings.signal]
    if readings.other is not None:
        columns.append(readings.other)
    yield from check_columns(readings.unused)
    odd = list(not_numbers(readings, np.column_stack(columns)))
    if odd:
        yield from odd
        return
    count = len(np.unique(readings.position))
    if count < FEWEST_POSITIONS:
        yield refusal(
            "too_few_positions",
            "Only {} micrometer positions; take at least {}, better {}, up and down.",
            count,
            FEWEST_POSITIONS,
            GOOD_POSITIONS,
        )
        return
    numbering = list(check_steps(readings, readings.series))
    yield from numbering
    if blocked(numbering):
        return
    if settings.gap_at_zero and settings.gap_at_zero + float(readings.position.min()) <= 0.0:
        yield refusal(
            "gap",
            "With a gap of {:g} um at position 0 the target would touch the probe at"
            " {:g} um; correct gap_at_zero_um.",
            1e6 * settings.gap_at_zero,
            1e6 * float(readings.position.min()),
        )
    yield from _motion(readings, settings)


def _motion(readings: ProbeReadings, settings: ProbeSettings) -> Iterator[Problem]:
    moved = float(np.ptp(readings.signal))
    least = 0.02 * settings.range_volts
    if settings.nominal:
        least = 0.5 * float(np.ptp(readings.position)) / abs(settings.nominal)
    if readings.other is not None and float(np.ptp(readings.other)) > max(3.0 * moved, least):
        yield refusal(
            "wrong_probe",
            (
                "The other probe moved by {:.3f} V, this one by {:.3f} V: the target is in front"
                " of the wrong probe, or the two plugs are exchanged."
            ),
            np.ptp(readings.other),
            moved,
        )
    elif moved < 1e-4 * settings.range_volts:
        yield refusal(
            "probe_dead",
            "The voltage does not change with the position; is the probe connected and"
            " the target grounded?",
        )


def checks(readings: ProbeReadings, settings: ProbeSettings, line: RobustLine) -> Iterator[Problem]:
    """Yield mistakes in the steps, the cause first; its consequences are left out."""
    problems = list(_scale(readings, settings, line)) or [
        *_saturation(readings, settings),
        *_copies(readings),
    ]
    if not problems:
        problems = list(positions(readings, line))
    if not problems:
        problems = [*_monotonic(readings, line), *_systematic(readings, line)]
    yield from problems
    if len(np.unique(readings.position)) < GOOD_POSITIONS:
        yield note(
            "few_positions",
            "Fewer than {} positions; linearity is known only roughly.",
            GOOD_POSITIONS,
        )
    if not np.any(falling(readings)):
        yield note(
            "one_direction",
            "No position was read both going out and coming back; backlash is unknown.",
        )


def _scale(readings: ProbeReadings, settings: ProbeSettings, line: RobustLine) -> Iterator[Problem]:
    """Yield mistakes common to all positions: unit, direction, sensitivity."""
    span, measured = float(np.ptp(readings.position)), 1e6 / line.slope
    expected = settings.nominal
    ratio = measured / (1e6 * expected) if expected else 1.0
    small = span < SHORT_SPAN and float(np.ptp(readings.signal)) > 0.5
    if abs(ratio) < 1.0 / UNIT_OFF or abs(ratio) > UNIT_OFF or (small and not expected):
        yield refusal(
            "unit",
            "The positions span {:g} um and the sensitivity would be {:.4g} um/V:"
            " positions are written in micrometres, not in millimetres (1 mm = 1000 um).",
            1e6 * span,
            measured,
        )
    elif ratio < 0.0:
        yield refusal(
            "direction_reversed",
            "The sensitivity is {:+.2f} um/V where {:+.2f} is expected: the micrometer"
            " was turned the other way, or its scale counts the other way. Positive is"
            " along the axis of the follower (probe 1) or across it (probe 2).",
            measured,
            1e6 * (expected or 0.0),
        )
    elif abs(ratio - 1.0) > SENSITIVITY_OFF:
        yield refusal(
            "wrong_sensitivity",
            "The sensitivity is {:.2f} um/V where {:.2f} is expected: another range of"
            " the probe's electronics, or another micrometer screw?",
            measured,
            1e6 * (expected or 0.0),
        )


def _saturation(readings: ProbeReadings, settings: ProbeSettings) -> Iterator[Problem]:
    saturated = np.flatnonzero(np.abs(readings.signal) >= 0.999 * settings.range_volts)
    if len(saturated):
        at = int(saturated[0])
        yield refusal(
            "saturated",
            "The voltage reaches {:.2f} V at {:.0f} um, the end of the range; move the"
            " probe or choose a larger range.",
            readings.signal[at],
            1e6 * readings.position[at],
        )


def _copies(readings: ProbeReadings) -> Iterator[Problem]:
    values = {
        name: tuple(readings.signal[members].tolist())
        for name, members in each_series(readings.series)
    }
    names = list(values)
    for name, earlier in ((b, a) for at, b in enumerate(names) for a in names[:at]):
        long = len(values[name]) >= FEWEST_POSITIONS and len(set(values[name])) > 3
        if long and values[name] == values[earlier] and np.any(_rough(values[name])):
            yield refusal(
                "copied_series",
                "Series {} repeats series {} digit for digit; take it again.",
                name,
                earlier,
            )
            return


def _rough(values: tuple[float, ...]) -> Marks:
    """Return which values are not round numbers: equal round numbers may be genuine."""
    array = np.array(values)
    return np.asarray(np.abs(array * 1e3 - np.round(array * 1e3)) > 1e-6)


def _monotonic(readings: ProbeReadings, line: RobustLine) -> Iterator[Problem]:
    for first, second in pairwise(range(len(line.residual))):
        step = readings.position[second] - readings.position[first]
        seen = (readings.signal[second] - readings.signal[first]) / line.slope
        backward = step * seen < 0.0 and abs(seen) > 6.0 * line.noise / abs(line.slope)
        if backward and readings.series[first] == readings.series[second]:
            yield refusal(
                "not_monotonic",
                "From step {} to {} of series {} the voltage went the wrong way.",
                readings.step[first],
                readings.step[second],
                readings.series[first],
            )
            return


def _systematic(readings: ProbeReadings, line: RobustLine) -> Iterator[Problem]:
    """Yield backlash, drift, curvature and a moving other probe: small effects on all readings.

    Backlash is a step at the turning point, drift a ramp over the order taken, curvature a parabola
    over the position: one least-squares fit separates them.
    """
    span = float(np.ptp(readings.position))
    offset, drift, curve, rest = systematic(readings)
    noise = 8.0 * rest / math.sqrt(len(readings.position))
    limit = max(LIMIT_OF_SPAN * span, noise)
    um = 1e6
    if abs(drift) > limit:
        yield refusal(
            "drift",
            "From the first to the last reading the voltage wanders by {:+.2f} um: let"
            " probe, electronics and micrometer warm up, and clamp everything.",
            um * drift,
        )
    if abs(offset) > limit:
        yield refusal(
            "backlash",
            (
                "Going back reads {:+.2f} um against going out: approach every position from one"
                " side."
            ),
            um * offset,
        )
    if abs(curve) > max(NONLINEAR * span, noise):
        yield refusal(
            "nonlinear",
            "The voltage bends by {:+.2f} um over the span: stay inside the probe's"
            " linear range, and see that target and probe are parallel.",
            um * curve,
        )
    if readings.other is not None:
        other = robust_line(readings.position, readings.other).slope
        if abs(other) > OTHER_MOVES * abs(line.slope):
            yield refusal(
                "crooked",
                "The other probe shows {:.0f} % of the motion: the micrometer does not"
                " move along this probe's axis; set it up again.",
                100.0 * abs(other / line.slope),
            )


def systematic(readings: ProbeReadings) -> tuple[float, float, float, float]:
    """Return backlash (falling less rising), drift over all readings, curvature, residual.

    All in m; the residual is a standard deviation.
    """
    position = readings.position - readings.position.mean()
    half = 0.5 * float(np.ptp(readings.position))
    order = np.linspace(-0.5, 0.5, len(position))
    down = falling(readings).astype(np.float64)
    columns = [np.ones_like(position), position / half, order, (position / half) ** 2]
    if 0.0 < down.mean() < 1.0:
        columns.append(down)
    design = np.column_stack(columns)
    solution = np.linalg.lstsq(design, readings.signal, rcond=None)[0]
    slope = solution[1] / half
    rest = readings.signal - design @ solution
    free = max(1, len(position) - design.shape[1])
    spread = math.sqrt(float(rest @ rest) / free) / abs(slope)
    offset = solution[4] / slope if len(solution) > 4 else 0.0
    return float(offset), float(solution[2] / slope), float(solution[3] / slope), spread


WRONG_POSITION = 0.01
"""Part of the span from which one reading counts as wrong."""


@dataclass(frozen=True, slots=True, eq=False)
class RobustLine:
    """A robust straight line through readings: slope (V/m), residual (V, n), noise (V)."""

    slope: float
    residual: Array
    noise: float


def robust_line(position: Array, signal: Array) -> RobustLine:
    """Fit a line robustly against a few wrong readings (iteratively reweighted least squares)."""
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
            yield refusal(
                "swapped_steps",
                (
                    "At {} and the step after it the voltages are exchanged: each belongs to the"
                    " position of the other reading."
                ),
                place_of(readings, after),
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
            yield refusal(
                "skipped_step",
                "From {} on every voltage belongs to the next position: a position was"
                " skipped. {:g} um is written, the voltage belongs to {:.0f} um.",
                place_of(readings, after),
                1e6 * readings.position[after],
                1e6 * readings.position[after] + um[after],
            )
        else:
            yield refusal(
                "repeated_step",
                "At {} the micrometer was not turned on: the voltage is that of the"
                " step before. {:g} um is written.",
                place_of(readings, after),
                1e6 * readings.position[after],
            )
        return


def _swapped(um: Array, step: float) -> bool:
    """Return whether of three residuals (um) the last two are one step up and one step down."""
    first, second = um[1] - um[0], um[2] - um[0]
    return bool(abs(first - step) < 0.3 * abs(step) and abs(second + step) < 0.3 * abs(step))


def _other_or_wrong(readings: ProbeReadings, um: Array, at: int) -> Problem:
    other = readings.other
    if other is not None:
        rest = robust_line(readings.position, other)
        moved = abs(rest.residual[at])
        own = abs(robust_line(readings.position, readings.signal).residual[at])
        if moved > max(6.0 * rest.noise, 0.3 * own):
            return refusal(
                "wrong_probe",
                "At {} the other probe moved by {:.3f} V and this one stayed behind:"
                " the wrong micrometer was turned.",
                place_of(readings, at),
                moved,
            )
    return _wrong(readings, um, at)


def _wrong(readings: ProbeReadings, um: Array, at: int) -> Problem:
    written = 1e6 * readings.position[at]
    return refusal(
        "wrong_position",
        "At {} the voltage belongs to {:.1f} um, but {:.1f} um is written; check the micrometer.",
        place_of(readings, at),
        written + um[at],
        written,
    )


def falling(readings: ProbeReadings) -> Marks:
    """Return which readings were taken in the falling direction, within their series.

    A position that is read twice in a row at the turning point belongs to both directions.
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
