"""Daily check of the calibration in use by a hanging weight and the zero; its control chart."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import special
from scipy.special import stdtrit

from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.coverage import COVERAGE, NORMAL_FACTOR
from rigapp_calibration.load_cell.characteristics import loads
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.two_axis import forces
from rigapp_calibration.load_cell.weights import (
    pin_force,
    relative_force_uncertainty,
    weight_force,
)
from rigapp_calibration.taking.readings import each_series

WEIGHT_SHARE = 0.005
"""Part of the weight: half of what class 2 of ISO 376 allows between angles, and up and down."""
ZERO_SHARE = 0.01
"""Part of full scale: five times the effect of 20 K on a good cell. More is an overload or a
debonding gauge; less is zeroed before each test."""


@dataclass(frozen=True, slots=True)
class DailyCheck:
    """The result. deviation: (n, 2) N along and across the weight, zero of each series taken off.

    elements (2, 2): measured force = elements applied force, by least squares; the identity when
    the calibration in use is right. sensitivity: mean ratio of measured to applied force.
    cross_talk: mean share measured across. zero: (2,) mean zero less the calibration's, N. largest:
    the largest deviation, N. allowed, zero_allowed: N. weight: the heaviest one, N. expanded: U of
    what is evaluated, N: along the weight, across it, of the zero. rule: decision rule in words.
    turned: rad, common rotation of all forces if nothing else deviates; else 0.
    """

    passed: bool
    deviation: Array
    elements: Array
    sensitivity: float
    cross_talk: float
    zero: Array
    largest: float
    allowed: float
    zero_allowed: float
    sentence: str
    weight: float
    expanded: tuple[float, float, float]
    rule: str
    turned: float = 0.0


def daily_check(
    readings: LoadCellReadings,
    settings: LoadCellSettings,
    matrix: Array,
    zero: Array,
    quadratic: Array | None = None,
) -> DailyCheck:
    """Compare the forces by the calibration in use with the applied weights.

    The limit is one resolution of the cell, or half a percent of the weight if that is more; of the
    zero, one resolution or a percent of full scale. By the decision rule of JCGM 106, 8.3, U of the
    check is taken off it (guard band w = U), unless the settings say simple acceptance. Raises
    ValueError when a series has no zero, nothing hung, or the weight hung along one axis only.
    """
    weight = weight_force(readings.mass, settings.weights, settings.place)
    applied = pin_force(weight, readings.angle, settings.angle_offset)
    felt = forces(readings.signal, matrix, zero, quadratic)
    empty = readings.mass == 0.0
    rest = np.empty_like(felt)
    for name, members in each_series(readings.series):
        zeros = felt[members & empty]
        if not len(zeros):
            raise ValueError(say("series {} has no reading without weights", name))
        rest[members] = zeros.mean(axis=0)
    loaded = ~empty
    if not loaded.any():
        raise ValueError(say("no reading has a weight on it"))
    net, size = felt - rest, weight[loaded]
    seen = loads(readings, applied, net)
    along, parallel, crossed = (one[loaded] for one in (seen.direction, seen.along, seen.across))
    deviation = np.stack((parallel - size, crossed), axis=-1)
    if np.linalg.matrix_rank(along, tol=0.1) < 2:
        raise ValueError(say("the weight hung along one axis only; hang it at angles of both"))
    elements = np.linalg.lstsq(applied[loaded], net[loaded], rcond=None)[0].T
    zero = felt[empty].mean(axis=0)
    largest = float(np.abs(deviation).max())
    resolution = settings.cell.resolution
    allowed = max(resolution, WEIGHT_SHARE * float(size.max()))
    zero_allowed = max(resolution, ZERO_SHARE * settings.cell.full_scale)
    scatter = net[loaded] - applied[loaded] @ elements.T
    expanded = _expanded(scatter, rest, settings, float(size.max()))
    guard = np.array(expanded if settings.cell.guarded else (0.0, 0.0, 0.0))
    told = bool(np.all(np.abs(deviation) <= allowed - guard[:2]))
    turned = _turned(elements, deviation, size, allowed) if largest > allowed else 0.0
    at_rest = bool(np.abs(zero).max() <= zero_allowed - guard[2])
    return DailyCheck(
        passed=told and at_rest,
        deviation=deviation,
        elements=np.asarray(elements, np.float64),
        sensitivity=float((parallel / size).mean()),
        cross_talk=float((crossed / size).mean()),
        zero=zero,
        largest=largest,
        allowed=allowed,
        zero_allowed=zero_allowed,
        sentence=_sentence(elements, largest, allowed, turned, told, zero, zero_allowed, at_rest),
        weight=float(size.max()),
        expanded=expanded,
        rule=_rule(allowed, zero_allowed, expanded, guarded=settings.cell.guarded),
        turned=turned,
    )


def _turned(elements: Array, deviation: Array, size: Array, allowed: float) -> float:
    """Return the common rotation (rad) of all forces, 0 if it does not explain the deviations.

    deviation (n, 2): along and across loads of size (n,), N. A cell changes its gains or its
    cross-talk; a level error rotates each force alike and leaves nothing else.
    """
    turn = math.atan2(elements[1, 0] - elements[0, 1], elements[0, 0] + elements[1, 1])
    c, s = math.cos(turn), math.sin(turn)
    back = (deviation + np.stack((size, 0.0 * size), axis=-1)) @ np.array([[c, -s], [s, c]])
    left = np.abs(back - np.stack((size, 0.0 * size), axis=-1)).max()
    return turn if left <= allowed else 0.0


def _expanded(
    scatter: Array, rest: Array, settings: LoadCellSettings, weight: float
) -> tuple[float, float, float]:
    """Return U of a deviation along the weight and across it, and of the zero, N.

    Weights and gravity along, the pin's angle across; in all what the readings scatter by about
    their own fit, in which the steps of the display are.
    """
    degrees = max(scatter.size - 4, 1)
    noise = math.sqrt(float(np.sum(scatter**2)) / degrees)
    random = float(stdtrit(degrees, 0.5 + 0.5 * COVERAGE)) * noise
    force = NORMAL_FACTOR * relative_force_uncertainty(settings.weights, settings.place) * weight
    turned = NORMAL_FACTOR * settings.angle_uncertainty * weight
    zeros = np.unique(rest, axis=0)
    of_mean = 0.0
    if len(zeros) > 1:
        spread = float(zeros.std(axis=0, ddof=1).max())
        factor = float(stdtrit(len(zeros) - 1, 0.5 + 0.5 * COVERAGE))
        of_mean = factor * spread / math.sqrt(len(zeros))
    return math.hypot(force, random), math.hypot(turned, random), of_mean


def _rule(
    allowed: float, zero_allowed: float, expanded: tuple[float, float, float], *, guarded: bool
) -> str:
    """Return the decision rule in words."""
    along, across, zero = expanded
    words: str = say(
        "U of the check (95 %) is {:.2g} N along the weight, {:.2g} N across it and {:.2g} N of the"
        " zero.",
        along,
        across,
        zero,
    )
    if not guarded:
        return words + say(
            " Decision rule: simple acceptance (JCGM 106), passed up to {:.2f} N ({:.2f} N of the"
            " zero); a cell at the limit may as well be beyond it.",
            allowed,
            zero_allowed,
        )
    return words + say(
        " Decision rule: guard band w = U (JCGM 106), passed up to {:.2f} N along, {:.2f} N"
        " across and {:.2f} N of the zero; a cell that is passed is beyond {:.2f} N in at most 2.5"
        " of 100.",
        max(0.0, allowed - along),
        max(0.0, allowed - across),
        max(0.0, zero_allowed - zero),
        allowed,
    )


def _sentence(
    elements: Array,
    largest: float,
    allowed: float,
    turned: float,
    told: bool,
    zero: Array,
    zero_allowed: float,
    at_rest: bool,
) -> str:
    """Return whether the cell measures the weight, where not, and whether its zero holds."""
    words: str = say(
        "The cell reads the weight within {:.2f} N ({:.2f} N are allowed).", largest, allowed
    )
    if turned:
        words = say(
            "The cell is off by {:.2f} N, {:.2f} N are allowed: every force seems turned by {:+.2f}"
            " degrees, and nothing else is off. Suspect the pin angle: check level and encoder,"
            " take the angle reference again, and repeat the check.",
            largest,
            allowed,
            math.degrees(turned),
        )
    elif largest > allowed:
        off = elements - np.eye(2)
        row, of = divmod(int(np.abs(off).argmax()), 2)
        words = say(
            (
                "The cell is off by {:.2f} N, {:.2f} N are allowed: axis {} reads {:+.2f} % of"
                " the force along axis {}{}. Check the weight; if it was right, calibrate the"
                " load cell again."
            ),
            largest,
            allowed,
            row + 1,
            100.0 * float(off[row, of]),
            of + 1,
            say(" too much") if row == of else "",
        )
    elif not told:
        words = say(
            (
                "The cell reads the weight within {:.2f} N, {:.2f} N are allowed, but the"
                " uncertainty of the check is too large to decide. Repeat the check, with a"
                " heavier weight or a better angle."
            ),
            largest,
            allowed,
        )
    axis = int(np.abs(zero).argmax())
    if not at_rest:
        words += say(
            " The zero of axis {} is {:+.2f} N off that of the calibration, {:.2f}"
            " N are allowed: was the cell overloaded, or is a cable off? Zero it; if it"
            " moves again, have it checked.",
            axis + 1,
            float(zero[axis]),
            zero_allowed,
        )
    return words


# Control chart of the daily check: does the cell keep its calibration?
#
# A Shewhart chart of one value a day. Two kinds of limits: those of the calibration, the expanded
# uncertainty about the value that it promises, and those of the history, three standard deviations
# about its mean, the deviation taken from the moving ranges (mean range / 1.128), which a slow
# change does not widen; more than three as long as the history is short and the deviation little
# known. Runs are evaluated by the Western Electric rules.

ENOUGH = 8
"""Number of checks from which the history has its own limits."""
RANGE_FACTOR = 1.128
"""Mean range of two values of a normal distribution, in standard deviations."""
BEYOND = 0.00135
"""Part of a normal distribution beyond three standard deviations, on one side."""
RANGE_DEGREES = 0.62
"""Degrees of freedom of a mean moving range, per range (Wheeler 1995)."""


@dataclass(frozen=True, slots=True)
class ChartFinding:
    """What a rule detected in the last value. action: it requires action, not only attention."""

    code: str
    sentence: str
    action: bool = True


@dataclass(frozen=True, slots=True)
class Chart:
    """One chart; everything in the unit of the values.

    promised: what the calibration says; expanded: its U, or None. centre, sigma: of the history,
    None while it is short.
    """

    values: Array
    promised: float
    expanded: float | None
    centre: float | None = None
    sigma: float | None = None
    findings: tuple[ChartFinding, ...] = ()

    @property
    def limits(self) -> tuple[float, float] | None:
        """Return the limits of the history for the next value."""
        if self.centre is None or self.sigma is None:
            return None
        half = limit_factor(len(self.values) - 1) * self.sigma
        return self.centre - half, self.centre + half


def limit_factor(count: int) -> float:
    """Return the limit of a next value in standard deviations, estimated from ``count`` values."""
    spread = math.sqrt(1.0 + 1.0 / count)
    return -float(special.stdtrit(RANGE_DEGREES * (count - 1), BEYOND)) * spread


def chart(values: Sequence[float], promised: float, expanded: float | None) -> Chart:
    """Evaluate values in the order of time.

    expanded: U of one value about ``promised``; None when the calibration does not state it. Only
    rules that end at the last value are reported.
    """
    array = np.asarray(values, np.float64)
    centre = sigma = None
    findings = [*_promise(array, promised, expanded)]
    if len(array) >= ENOUGH:
        # The last value is compared with the others.
        before = array[:-1]
        centre = float(before.mean())
        sigma = max(float(np.abs(np.diff(before)).mean()) / RANGE_FACTOR, 1e-12)
        findings += _rules((array - centre) / sigma)
    findings += _trend(array)
    return Chart(array, promised, expanded, centre, sigma, tuple(findings))


def _promise(values: Array, promised: float, expanded: float | None) -> Iterator[ChartFinding]:
    if len(values) and expanded is not None and abs(values[-1] - promised) > expanded:
        yield ChartFinding(
            "beyond_uncertainty",
            say(
                (
                    "The last check is {:+.5f} off the calibration, more than its uncertainty of"
                    " {:.5f}: calibrate again."
                ),
                values[-1] - promised,
                expanded,
            ),
        )


def _rules(z: Array) -> Iterator[ChartFinding]:
    """Evaluate values in standard deviations from the centre; yield the first rule that holds."""
    side = float(np.sign(z[-1]))
    above = say("above") if side > 0 else say("below")
    if abs(z[-1]) > limit_factor(len(z) - 1):
        yield ChartFinding(
            "beyond_limits",
            say(
                "The last check lies {:.1f} standard deviations {} the mean of all before:"
                " repeat it; if it stays, look for the cause before testing.",
                abs(z[-1]),
                above,
            ),
        )
        return
    if len(z) >= 8 and np.all(side * z[-8:] > 0.0):
        yield ChartFinding(
            "shift",
            say(
                "Eight checks in a row lie {} the mean: the cell has shifted; plan a new"
                " calibration.",
                above,
            ),
        )
        return
    for code, window, count, bound in (("two_of_three", 3, 2, 2.0), ("four_of_five", 5, 4, 1.0)):
        if len(z) >= window and np.count_nonzero(side * z[-window:] > bound) >= count:
            yield ChartFinding(
                code,
                say(
                    (
                        "{} of the last {} checks lie more than {:g} standard deviation{} {} the"
                        " mean: the cell may be changing; watch it."
                    ),
                    count,
                    window,
                    bound,
                    "s" if bound > 1 else "",
                    above,
                ),
                action=False,
            )
            return


def _trend(values: Array) -> Iterator[ChartFinding]:
    steps = np.diff(values[-7:])
    if len(steps) == 6 and (np.all(steps > 0.0) or np.all(steps < 0.0)):
        way = say("rose") if steps[0] > 0.0 else say("fell")
        yield ChartFinding(
            "trend",
            say(
                "The value {} seven checks in a row, by {:.5f} in all: the cell drifts;"
                " plan a new calibration.",
                way,
                abs(float(steps.sum())),
            ),
        )
