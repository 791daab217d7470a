"""The control chart of the daily check: does the cell stay as it was calibrated?

A Shewhart chart of one value a day. Two kinds of limits: those of the calibration, the expanded
uncertainty about the value that it promises, and those of the history, three standard deviations
about its mean, the deviation taken from the moving ranges (mean range / 1.128), which a slow change
does not widen; more than three as long as the history is short and the deviation little known.
Runs are judged by the rules that are called Western Electric's.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy import special

from rigapp.texts import say
from rigapp_calibration.arrays import Array

ENOUGH = 8
"""Checks from which on the history has limits of its own."""
RANGE_FACTOR = 1.128
"""Mean range of two values of a normal distribution, in standard deviations."""
BEYOND = 0.00135
"""Part of a normal distribution beyond three standard deviations, on one side."""
RANGE_DEGREES = 0.62
"""Degrees of freedom of a mean moving range, each range counts as so much (Wheeler 1995)."""


@dataclass(frozen=True, slots=True)
class ChartFinding:
    """What a rule found of the last value. action: it asks for one, not for attention only."""

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
        """Return the limits of the history: those of the next value of so many."""
        if self.centre is None or self.sigma is None:
            return None
        half = limit_factor(len(self.values) - 1) * self.sigma
        return self.centre - half, self.centre + half


def limit_factor(count: int) -> float:
    """Return how many standard deviations, known from ``count`` values, a next one may be off."""
    spread = math.sqrt(1.0 + 1.0 / count)
    return -float(special.stdtrit(RANGE_DEGREES * (count - 1), BEYOND)) * spread


def chart(values: Sequence[float], promised: float, expanded: float | None) -> Chart:
    """Judge values in the order of time.

    expanded: U of one value about ``promised``; None when the calibration does not state it. The
    last value is what counts: a rule is told when it ends there.
    """
    array = np.asarray(values, np.float64)
    centre = sigma = None
    findings = [*_promise(array, promised, expanded)]
    if len(array) >= ENOUGH:
        # The last value is judged by the others.
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
                "The last check is {:+.5f} off what the calibration says, more than its"
                " uncertainty of {:.5f}: calibrate again.",
                values[-1] - promised,
                expanded,
            ),
        )


def _rules(z: Array) -> Iterator[ChartFinding]:
    """Judge values in standard deviations from the centre, by the first rule that holds."""
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
                    "{} of the last {} checks lie more than {:g} standard deviation{} {}"
                    " the mean: something begins to change; watch it.",
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
