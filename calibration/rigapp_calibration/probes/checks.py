"""Checks of micrometer readings that name the mistake: what went wrong, at which step."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from rigapp_calibration.arrays import Marks
from rigapp_calibration.probes.positions import RobustLine, falling, positions, robust_line
from rigapp_calibration.probes.readings import FEWEST_POSITIONS, ProbeReadings
from rigapp_calibration.probes.settings import ProbeSettings
from rigapp_calibration.problems import Problem, blocked, note
from rigapp_calibration.taking.readings import check_columns, check_steps, each_series, not_numbers

GOOD_POSITIONS = 11
"""With ten steps a bend of the line stands out from what single positions are off."""
LIMIT_OF_SPAN = 0.005
"""Part of the span that backlash and drift may be."""
NONLINEAR = 0.01
"""Part of the span that the line may bend: makers state linearities of 0.2 to 0.5 %."""
SENSITIVITY_OFF = 0.3
"""Relative: a target or a cable changes it by less; the next range of an amplifier by more."""
UNIT_OFF = 100.0
"""Ratio from which on the unit is wrong: millimetres for micrometres are a factor of 1000."""
SHORT_SPAN = 5e-6
"""Span (m) with which no probe changes by half a volt, unless millimetres are written."""
OTHER_MOVES = 0.3
"""Part of its own voltage that a crooked pair may show on the other probe."""


def unusable(readings: ProbeReadings, settings: ProbeSettings) -> Iterator[Problem]:
    """Yield what makes a fit senseless."""
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
        yield Problem(
            "too_few_positions",
            f"Only {count} micrometer positions; take at least {FEWEST_POSITIONS}, better"
            f" {GOOD_POSITIONS}, up and down.",
        )
        return
    numbering = list(check_steps(readings, readings.series))
    yield from numbering
    if blocked(numbering):
        return
    if settings.gap_at_zero and settings.gap_at_zero + float(readings.position.min()) <= 0.0:
        yield Problem(
            "gap",
            f"With a gap of {1e6 * settings.gap_at_zero:g} um at position 0 the target would touch"
            f" the probe at {1e6 * float(readings.position.min()):g} um; correct gap_at_zero_um.",
        )
    yield from _motion(readings, settings)


def _motion(readings: ProbeReadings, settings: ProbeSettings) -> Iterator[Problem]:
    moved = float(np.ptp(readings.signal))
    least = 0.02 * settings.range_volts
    if settings.nominal:
        least = 0.5 * float(np.ptp(readings.position)) / abs(settings.nominal)
    if readings.other is not None and float(np.ptp(readings.other)) > max(3.0 * moved, least):
        yield Problem(
            "wrong_probe",
            f"The other probe moved by {np.ptp(readings.other):.3f} V, this one by {moved:.3f} V:"
            " the target stands before the wrong probe, or the two plugs are exchanged.",
        )
    elif moved < 1e-4 * settings.range_volts:
        yield Problem(
            "probe_dead",
            "The voltage does not change with the position; is the probe connected and the target"
            " grounded?",
        )


def checks(readings: ProbeReadings, settings: ProbeSettings, line: RobustLine) -> Iterator[Problem]:
    """Yield what is wrong with the steps, the cause first; its consequences are left out."""
    found = list(_scale(readings, settings, line)) or [
        *_saturation(readings, settings),
        *_copies(readings),
    ]
    if not found:
        found = list(positions(readings, line))
    if not found:
        found = [*_monotonic(readings, line), *_systematic(readings, line)]
    yield from found
    if len(np.unique(readings.position)) < GOOD_POSITIONS:
        yield note(
            "few_positions",
            f"Fewer than {GOOD_POSITIONS} positions; linearity is known only roughly.",
        )
    if not np.any(falling(readings)):
        yield note(
            "one_direction",
            "No position was read both going out and coming back; backlash is unknown.",
        )


def _scale(readings: ProbeReadings, settings: ProbeSettings, line: RobustLine) -> Iterator[Problem]:
    """Yield what is wrong with all positions alike: unit, direction, sensitivity."""
    span, found = float(np.ptp(readings.position)), 1e6 / line.slope
    expected = settings.nominal
    ratio = found / (1e6 * expected) if expected else 1.0
    small = span < SHORT_SPAN and float(np.ptp(readings.signal)) > 0.5
    if abs(ratio) < 1.0 / UNIT_OFF or abs(ratio) > UNIT_OFF or (small and not expected):
        yield Problem(
            "unit",
            f"The positions span {1e6 * span:g} um and the sensitivity would be {found:.4g} um/V:"
            " positions are written in micrometres, not in millimetres (1 mm = 1000 um).",
        )
    elif ratio < 0.0:
        yield Problem(
            "direction_reversed",
            f"The sensitivity is {found:+.2f} um/V where {1e6 * (expected or 0.0):+.2f} is"
            " expected: the micrometer was turned the other way, or its scale counts the other"
            " way. Positive is along the axis of the follower (probe 1) or across it (probe 2).",
        )
    elif abs(ratio - 1.0) > SENSITIVITY_OFF:
        yield Problem(
            "wrong_sensitivity",
            f"The sensitivity is {found:.2f} um/V where {1e6 * (expected or 0.0):.2f} is expected:"
            " another range of the probe's electronics, or another micrometer screw?",
        )


def _saturation(readings: ProbeReadings, settings: ProbeSettings) -> Iterator[Problem]:
    saturated = np.flatnonzero(np.abs(readings.signal) >= 0.999 * settings.range_volts)
    if len(saturated):
        at = int(saturated[0])
        yield Problem(
            "saturated",
            f"The voltage reaches {readings.signal[at]:.2f} V at"
            f" {1e6 * readings.position[at]:.0f} um, the end of the range; move the probe or choose"
            " a larger range.",
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
            yield Problem(
                "copied_series",
                f"Series {name} repeats series {earlier} digit for digit; take it again.",
            )
            return


def _rough(values: tuple[float, ...]) -> Marks:
    """Tell which values are no round numbers: equal round numbers may be honest."""
    array = np.array(values)
    return np.asarray(np.abs(array * 1e3 - np.round(array * 1e3)) > 1e-6)


def _monotonic(readings: ProbeReadings, line: RobustLine) -> Iterator[Problem]:
    for first, second in pairwise(range(len(line.residual))):
        step = readings.position[second] - readings.position[first]
        seen = (readings.signal[second] - readings.signal[first]) / line.slope
        backward = step * seen < 0.0 and abs(seen) > 6.0 * line.noise / abs(line.slope)
        if backward and readings.series[first] == readings.series[second]:
            yield Problem(
                "not_monotonic",
                f"From step {readings.step[first]} to {readings.step[second]} of series"
                f" {readings.series[first]} the voltage went the wrong way.",
            )
            return


def _systematic(readings: ProbeReadings, line: RobustLine) -> Iterator[Problem]:
    """Yield backlash, drift, curvature and a moving other probe: what all readings show a little.

    Backlash is a step at the turning point, drift a ramp over the order taken, curvature a parabola
    over the position: one least-squares fit tells them apart.
    """
    span = float(np.ptp(readings.position))
    offset, drift, curve, rest = systematic(readings)
    noise = 8.0 * rest / math.sqrt(len(readings.position))
    limit = max(LIMIT_OF_SPAN * span, noise)
    um = 1e6
    if abs(drift) > limit:
        yield Problem(
            "drift",
            f"From the first to the last reading the voltage wanders by {um * drift:+.2f} um:"
            " let probe, electronics and micrometer warm up, and clamp everything.",
        )
    if abs(offset) > limit:
        yield Problem(
            "backlash",
            f"Coming back reads {um * offset:+.2f} um against going out: approach every position"
            " from one side.",
        )
    if abs(curve) > max(NONLINEAR * span, noise):
        yield Problem(
            "nonlinear",
            f"The voltage bends by {um * curve:+.2f} um over the span: stay inside the probe's"
            " linear range, and see that target and probe are parallel.",
        )
    if readings.other is not None:
        other = robust_line(readings.position, readings.other).slope
        if abs(other) > OTHER_MOVES * abs(line.slope):
            yield Problem(
                "crooked",
                f"The other probe shows {100.0 * abs(other / line.slope):.0f} % of the motion: the"
                " micrometer does not move along this probe's axis; set it up again.",
            )


def systematic(readings: ProbeReadings) -> tuple[float, float, float, float]:
    """Return backlash (falling less rising), drift over all readings, bending, and what is left.

    All in m; what is left is a standard deviation.
    """
    position = readings.position - readings.position.mean()
    half = 0.5 * float(np.ptp(readings.position))
    order = np.linspace(-0.5, 0.5, len(position))
    down = falling(readings).astype(np.float64)
    columns = [np.ones_like(position), position / half, order, (position / half) ** 2]
    if 0.0 < down.mean() < 1.0:
        columns.append(down)
    design = np.column_stack(columns)
    found = np.linalg.lstsq(design, readings.signal, rcond=None)[0]
    slope = found[1] / half
    rest = readings.signal - design @ found
    free = max(1, len(position) - design.shape[1])
    spread = math.sqrt(float(rest @ rest) / free) / abs(slope)
    offset = found[4] / slope if len(found) > 4 else 0.0
    return float(offset), float(found[2] / slope), float(found[3] / slope), spread
