"""An uncertainty budget after the GUM: contributions, combined (JCGM 100), expanded (JCGM 101).

Normal contributions, and those estimated from scatter, combine to a t distribution with the
Welch-Satterthwaite degrees of freedom. Where bounded contributions (rectangular, two-point) are
added, the factor for 95 % is that of the convolved distributions: 1.96 would cover too little of
two branches and too much of an interval.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import GTC
import numpy as np
from GTC import reporting, type_a
from scipy import optimize

from rigapp_calibration.arrays import Array
from rigapp_calibration.coverage import COVERAGE, NORMAL_FACTOR

Evaluation = Literal["A", "B"]
Distribution = Literal["normal", "rectangular", "two-point"]
FINEST = 1e-3
"""Part of the combined uncertainty by which bounded parts are blurred: far below any known
uncertainty; it keeps the integral short."""
REACH = 6.0
"""Standard deviations of a normal part beyond which its characteristic function is 0 (1e-8)."""


@dataclass(frozen=True, slots=True)
class Contribution:
    """One line of the budget: name, standard uncertainty, degrees of freedom (without: known).

    evaluation: A from the scatter of these readings, B from elsewhere. distribution: two-point for
    a deviation of either sign that takes one of some values, ``points`` (one of two branches).
    averages: it belongs to one reading and falls with the root of their number.
    """

    name: str
    uncertainty: float
    degrees: float = math.inf
    evaluation: Evaluation = "B"
    distribution: Distribution = "normal"
    averages: bool = False
    points: tuple[float, ...] = ()

    @property
    def reach(self) -> tuple[float, ...]:
        """Return the half widths of a bounded contribution."""
        if self.distribution == "rectangular":
            return (math.sqrt(3.0) * self.uncertainty,)
        return self.points or (self.uncertainty,)


def at_most(name: str, size: float, evaluation: Evaluation = "B") -> Contribution:
    """Return the contribution of an error of at most ``size``, either way."""
    return Contribution(name, size / math.sqrt(3.0), math.inf, evaluation, "rectangular")


def straight_line(x: Array, y: Array) -> tuple[Any, Any]:
    """Return intercept and slope of the line through points as GTC's uncertain numbers.

    Their uncertainties are those of ordinary least squares, correlated, with n - 2 degrees of
    freedom: results of arithmetic with them carry their own uncertainty.
    """
    found = type_a.line_fit(x.tolist(), y.tolist()).a_b
    return found.a, found.b


@dataclass(frozen=True, slots=True)
class Budget:
    """The uncertainty at one value, in its unit: contributions, combined, coverage, expanded.

    degrees: effective degrees of freedom, infinite if nothing was estimated from few readings.
    """

    value: float
    contributions: tuple[Contribution, ...]
    combined: float
    degrees: float
    coverage_factor: float
    expanded: float

    def of_mean(self, readings: float) -> Budget:
        """Return the budget of a mean of readings (``inf``: only what does not average)."""
        return combine(self.value, self.contributions, readings)


def combine(value: float, lines: tuple[Contribution, ...], readings: float = 1.0) -> Budget:
    """Combine contributions to a mean of readings; the coverage factor gives 95 %."""
    total = GTC.constant(value)
    sizes = [
        line.uncertainty / math.sqrt(readings) if line.averages else line.uncertainty
        for line in lines
    ]
    for line, size in zip(lines, sizes, strict=True):
        total = total + GTC.ureal(0.0, size, df=max(line.degrees, 1.0), label=line.name)
    combined = float(GTC.uncertainty(total))
    degrees = float(GTC.dof(total)) if combined > 0.0 else math.inf
    factor = _factor(lines, sizes, combined)
    return Budget(value, lines, combined, degrees, factor, factor * combined)


def _factor(lines: Sequence[Contribution], sizes: Sequence[float], combined: float) -> float:
    """Return the ratio of expanded to combined uncertainty; sizes: of the contributions."""
    free, bounded = GTC.constant(0.0), []
    for line, size in zip(lines, sizes, strict=True):
        if line.distribution == "normal":
            free = free + GTC.ureal(0.0, size, df=max(line.degrees, 1.0))
        elif size > FINEST * combined:
            bounded.append(line)
    spread = float(GTC.uncertainty(free))
    own = float(reporting.k_factor(float(GTC.dof(free)) if spread > 0.0 else math.inf))
    if not bounded:
        return own
    # Widened so that the interval is right for a single such contribution.
    normal = max(spread * own / NORMAL_FACTOR, FINEST * combined)
    return _half_width(normal, bounded) / combined


def _half_width(normal: float, bounded: Sequence[Contribution]) -> float:
    """Return the half width that contains 95 % of a normal part and bounded parts.

    P(|x| < U) = 2/pi integral of sin(U t)/t times the characteristic function; by the trapezoidal
    rule, exact to the mass beyond half its period.
    """
    widest = sum(max(map(abs, one.reach)) for one in bounded) + REACH * normal
    step = math.pi / widest
    t = step * np.arange(1, 2 + int(REACH / normal / step))
    weight = np.exp(-0.5 * (normal * t) ** 2) / t
    for one in bounded:
        angles = np.outer(one.reach, t)
        even = one.distribution == "rectangular"
        weight *= np.mean(np.sinc(angles / math.pi) if even else np.cos(angles), axis=0)

    def missing(width: float) -> float:
        return step / math.pi * (width + 2.0 * float(weight @ np.sin(width * t))) - COVERAGE

    return float(optimize.brentq(missing, 0.0, widest, xtol=1e-6 * widest))
