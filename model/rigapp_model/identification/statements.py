"""What may be true of a joint: its wear coefficient is constant, runs in, or changed at one time.

Each statement says what progress counts at the life's coefficient K0:
q(P) = K/K0 (P + (r - 1) g(P)), where K is the last coefficient, r the first one's ratio to it, and
g the progress that was made at the first one. So one code serves all of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.errors import Prior

Array = NDArray[np.float64]

CHANGE_SPREAD = float(np.log(3.0))
"""Spread of ln r of a change: two in three change K by less than a factor of 3."""
RUNNING_IN_SPREAD = float(np.log(5.0))
"""Spread of ln r of running-in, which only falls: first coefficients of 5 times the last occur."""
RUNNING_IN_PLACES = (30.0, 3e4)
"""Running-in takes so many nominal cycles at least and at most; equal chance in each decade."""


@dataclass(frozen=True, slots=True)
class Statement:
    """Hold what one statement says.

    name; first (P, half, place): progress made at the first coefficient, the mean over a bin of
    that half width, place in nominal cycles; spread: of ln r beforehand, 0 for none; falls: whether
    r is above 1 by definition; anywhere: whether the place may be anywhere in what was tested, else
    within RUNNING_IN_PLACES; of_first: whether the prior of K is that of the first coefficient,
    else of the last; chance: probability beforehand.
    """

    name: str
    first: Callable[[Array, Array, Array], Array]
    spread: float = 0.0
    falls: bool = False
    anywhere: bool = False
    of_first: bool = False
    chance: float = 1.0

    def ratio_now(self, log_ratio: Array, progress: float, place: Array) -> tuple[Array, Array]:
        """Return ln of the coefficient now to K, (H,), and its slope by ln r.

        log_ratio, place (H,); progress: nominal cycles.
        """
        if not self.falls:
            return np.zeros(place.shape), np.zeros(place.shape)
        left = np.exp(-progress / place)
        first = np.exp(log_ratio)
        now = 1.0 + (first - 1.0) * left
        return np.log(now), first * left / now

    def precision(self, prior: Prior) -> Array:
        """Return the prior's precision of (ln K, ln r), (2, 2)."""
        k, r = prior.spread**-2, self.spread**-2
        if self.of_first:
            return np.array([[k, k], [k, k + r]])
        return np.array([[k, 0.0], [0.0, r]])


def _none(progress: Array, half: Array, place: Array) -> Array:
    return np.zeros(np.broadcast_shapes(progress.shape, place.shape))


def _running_in(progress: Array, half: Array, place: Array) -> Array:
    return place * -np.expm1(-progress / place)


def _until(progress: Array, half: Array, place: Array) -> Array:
    inside = np.maximum(half - np.abs(progress - place), 0.0)
    return np.minimum(progress, place) - inside**2 / np.maximum(4.0 * half, 1e-300)


CONSTANT, RUNNING_IN, CHANGE = "constant", "running-in", "change"

STATEMENTS = (
    Statement(CONSTANT, _none, chance=0.8),
    Statement(RUNNING_IN, _running_in, RUNNING_IN_SPREAD, falls=True, chance=0.1),
    Statement(CHANGE, _until, CHANGE_SPREAD, anywhere=True, of_first=True, chance=0.1),
)
"""Were all alike, limits of a constant coefficient would hold it far more often than they say:
readings that are as likely by each cannot take away what the others leave possible."""


@dataclass(frozen=True, slots=True, eq=False)
class Hypotheses:
    """Hold H hypotheses of one statement, (H,) each: ln(K/K0), ln r, the place (nominal cycles)."""

    statement: Statement
    log_coefficient: Array
    log_ratio: Array
    place: Array

    def at(self, index: NDArray[np.int64]) -> Hypotheses:
        """Return some of them."""
        return Hypotheses(
            self.statement, self.log_coefficient[index], self.log_ratio[index], self.place[index]
        )

    def scaled(self, half: Array) -> Callable[[Array], tuple[Array, Array]]:
        """Return what progress counts at K0, with its slopes by ln K and ln r (see ``Scaled``).

        half (n,): half widths of the first n bins asked for; others are single moments.
        """
        coefficient = np.exp(self.log_coefficient)[:, None]
        ratio = np.exp(self.log_ratio)[:, None]

        def counted(progress: Array) -> tuple[Array, Array]:
            wide = half
            if half.size < progress.size:
                wide = np.pad(half, (0, progress.size - half.size))
            first = self.statement.first(progress, wide, self.place[:, None])
            found = coefficient * (progress + (ratio - 1.0) * first)
            return found, np.stack([found, coefficient * ratio * first])

        return counted
