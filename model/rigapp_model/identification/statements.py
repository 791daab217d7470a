"""Statements about a joint: its wear coefficient is constant, runs in, or changed once.

Each statement gives the progress at the life's coefficient K0:
q(P) = K/K0 (P + (r - 1) g(P)), where K is the last coefficient, r the ratio of the first one to it,
and g the progress at the first one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.errors import Prior

Array = NDArray[np.float64]

CHANGE_SPREAD = float(np.log(3.0))
"""Spread of ln r of a change: two in three are by less than a factor of 3."""
RUNNING_IN_SPREAD = float(np.log(5.0))
"""Spread of ln r of running-in, where r > 1: first coefficients of 5 times the last occur."""
RUNNING_IN_PLACES = (30.0, 3e4)
"""Range of the length of running-in, nominal cycles; uniform in its logarithm."""


@dataclass(frozen=True, slots=True)
class Statement:
    """Statement about the wear coefficient.

    name; first (P, half, transition): progress at the first coefficient, as the mean over a bin
    of that half width, transition in nominal cycles; spread: prior of ln r, 0 for none; falls:
    whether r > 1 by definition; anywhere: whether the transition is anywhere in the test, else
    within RUNNING_IN_PLACES; of_first: whether the prior of K applies to the first coefficient,
    else to the last; chance: prior probability.
    """

    name: str
    first: Callable[[Array, Array, Array], Array]
    spread: float = 0.0
    falls: bool = False
    anywhere: bool = False
    of_first: bool = False
    chance: float = 1.0

    def ratio_now(
        self, log_ratio: Array, progress: float, transition: Array
    ) -> tuple[Array, Array]:
        """Return ln of the present coefficient over K, (H,), and its slope by ln r.

        log_ratio, transition (H,); progress: nominal cycles.
        """
        if not self.falls:
            return np.zeros(transition.shape), np.zeros(transition.shape)
        remaining = np.exp(-progress / transition)
        first = np.exp(log_ratio)
        now = 1.0 + (first - 1.0) * remaining
        return np.log(now), first * remaining / now

    def precision(self, prior: Prior) -> Array:
        """Return the prior's precision of (ln K, ln r), (2, 2)."""
        k, r = prior.spread**-2, self.spread**-2
        if self.of_first:
            return np.array([[k, k], [k, k + r]])
        return np.array([[k, 0.0], [0.0, r]])


def _none(progress: Array, half: Array, transition: Array) -> Array:
    return np.zeros(np.broadcast_shapes(progress.shape, transition.shape))


def _running_in(progress: Array, half: Array, transition: Array) -> Array:
    return transition * -np.expm1(-progress / transition)


def _until(progress: Array, half: Array, transition: Array) -> Array:
    inside = np.maximum(half - np.abs(progress - transition), 0.0)
    return np.minimum(progress, transition) - inside**2 / np.maximum(4.0 * half, 1e-300)


CONSTANT, RUNNING_IN, CHANGE = "constant", "running-in", "change"

STATEMENTS = (
    Statement(CONSTANT, _none, chance=0.8),
    Statement(RUNNING_IN, _running_in, RUNNING_IN_SPREAD, falls=True, chance=0.1),
    Statement(CHANGE, _until, CHANGE_SPREAD, anywhere=True, of_first=True, chance=0.1),
)
"""The chances differ, as with equal ones the limits of a constant coefficient would be too wide:
readings that are as likely under each statement cannot exclude the others."""


@dataclass(frozen=True, slots=True, eq=False)
class Hypotheses:
    """H hypotheses of one statement, (H,): ln(K/K0), ln r, the transition (nominal cycles)."""

    statement: Statement
    log_coefficient: Array
    log_ratio: Array
    transition: Array

    def at(self, index: NDArray[np.int64]) -> Hypotheses:
        """Return the selected hypotheses."""
        return Hypotheses(
            self.statement,
            *(v[index] for v in (self.log_coefficient, self.log_ratio, self.transition)),
        )

    def scaled(self, half: Array) -> Callable[[Array], tuple[Array, Array]]:
        """Return the function to progress at K0, with slopes by ln K and ln r (see ``Scaled``).

        half (n,): half widths of the first n bins; later progress has no width.
        """
        coefficient = np.exp(self.log_coefficient)[:, None]
        ratio = np.exp(self.log_ratio)[:, None]

        def counted(progress: Array) -> tuple[Array, Array]:
            wide = half
            if half.size < progress.size:
                wide = np.pad(half, (0, progress.size - half.size))
            first = self.statement.first(progress, wide, self.transition[:, None])
            depth = coefficient * (progress + (ratio - 1.0) * first)
            return depth, np.stack([depth, coefficient * ratio * first])

        return counted
