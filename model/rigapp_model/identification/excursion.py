"""What fine bins beside what was expected of them are: other wear, a step, or a swing not yet seen.

A sum of innovations rises by either. So the bins since it rose are compared with what was expected
before it did: their differences are a ramp from some bin on where the joint wears otherwise, and a
constant from some bin on where a probe was touched. They may also be a part of a slow swing, of
which too few periods have passed for anybody to know it. All amplitudes are normal beforehand, so
that the evidence of each is in closed form, with all that was uncertain before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.colour import covariance
from rigapp_model.identification.screening import BEYOND, RATIO, SHORTEST
from rigapp_model.identification.shapes import STEP, SWING, WITHIN

Array = NDArray[np.float64]

MOST = 64
"""So many bins are held; of more each second one is left out."""
CHANGE = 1.0
"""K changes by this factor and one, standard: a third of changes is by more than a factor of 2."""
TOLD = float(np.log(20.0))
"""Odds above which one of both is told."""

KNOWN_AFTER = 2.5
"""Periods after which a swing would have been seen in the bins."""
UNSEEN_SWING = 0.35
"""Chance beforehand of a swing of each period; more of it delays what is told of a change early."""


@dataclass(slots=True)
class Excursion:
    """Hold the bins since a sum was 0 last, and what was known then; a fixed number of numbers.

    mean, covariance: of all states then; begin: bins that came before it; bins: for each its first
    and last revolution, progress, difference to what was expected then (m), slope by ln K (m),
    variance of its own (m^2), and slopes by all states; stride: each such bin is kept.
    """

    mean: Array | None = None
    covariance: Array | None = None
    bins: list[list[float]] = field(default_factory=list)
    stride: int = 1
    seen: int = 0

    def begin(self, mean: Array, covariance: Array) -> None:
        """Begin anew with what is known now."""
        self.mean, self.covariance = mean.copy(), covariance.copy()
        self.bins, self.stride, self.seen = [], 1, 0

    def add(self, one: list[float]) -> None:
        """Take a bin."""
        self.seen += 1
        if self.seen % self.stride:
            return
        self.bins.append(one)
        if len(self.bins) > MOST:
            self.bins, self.stride = self.bins[1::2], 2 * self.stride

    def odds(
        self, drift: float, size: float, length: float, wander: float, swings: float = UNSEEN_SWING
    ) -> tuple[float, float, float]:
        """Return the logarithms of odds of other wear and of a step, each against all else.

        And the revolution from which on it is the more probable one of both. drift, size, length:
        of the noise, see ``Kinds``; wander: of a swing, m^2 a revolution; swings: chance beforehand
        of a swing of each period.
        """
        assert self.covariance is not None
        table = np.array(self.bins)
        first, last, progress, off, slope, own = table[:, :6].T
        rows = table[:, 6:]
        n = off.size
        middle = np.log(np.maximum(0.5 * (first + last), 1.0))
        walk = drift**2 * (np.minimum(middle[:, None], middle) - middle[0])
        walk += wander * (np.minimum(last[:, None], last) - first[0] + 1.0)
        noise = covariance(np.array([size]), np.array([length]), first - 1.0, last)[0]
        known = rows @ self.covariance @ rows.T
        lower = np.linalg.cholesky(np.diag(own) + walk + noise + known)
        start = np.append(progress[0] - (progress[-1] - progress[0]) / n, progress[:-1])
        ramps = CHANGE * slope * np.maximum(1.0 - start[:, None] / progress, 0.0)
        at = np.arange(n)
        after = STEP * (np.where(at == at[:, None], 0.5, at > at[:, None]))
        inside = STEP * WITHIN * np.eye(n)
        columns = np.concatenate([ramps, after, inside, off[None]])
        white = np.linalg.solve(lower, columns.T).T
        misfit = white[-1]
        ramp, one, two = white[:n], white[n : 2 * n], white[2 * n : -1]
        size_of = 1.0 + (ramp**2).sum(axis=1)
        wear = 0.5 * ((ramp @ misfit) ** 2 / size_of - np.log(size_of))
        aa, bb = 1.0 + (one**2).sum(axis=1), 1.0 + (two**2).sum(axis=1)
        ab, u, v = (one * two).sum(axis=1), one @ misfit, two @ misfit
        area = aa * bb - ab**2
        step = 0.5 * ((bb * u**2 - 2.0 * ab * u * v + aa * v**2) / area - np.log(area))
        by_wear, by_step = (float(np.logaddexp.reduce(x) - np.log(n)) for x in (wear, step))
        by_chance = float(np.logaddexp(_by_swing(lower, misfit, first, last) + np.log(swings), 0.0))
        since = first[int(np.argmax(wear if by_wear > by_step else step))]
        return (
            by_wear - float(np.logaddexp(by_step, by_chance)),
            by_step - float(np.logaddexp(by_wear, by_chance)),
            float(since),
        )

    def numbers(self) -> dict[str, Any]:
        """Return all that is kept as plain numbers, for a checkpoint."""
        return {
            "mean": None if self.mean is None else self.mean.tolist(),
            "covariance": None if self.covariance is None else self.covariance.tolist(),
            "bins": [list(one) for one in self.bins],
            "stride": self.stride,
            "seen": self.seen,
        }


def _by_swing(lower: Array, misfit: Array, first: Array, last: Array) -> float:
    """Return the logarithm of the evidence of a swing of which too few periods have passed.

    lower (n, n): root of the covariance of bins; misfit (n,): their differences by it.
    """
    count = int(np.ceil(np.log(max(BEYOND * last[-1] / SHORTEST, RATIO)) / np.log(RATIO)))
    periods = SHORTEST * RATIO ** np.arange(count + 1)
    unseen = periods[periods * KNOWN_AFTER > first[0]]
    if not unseen.size:
        return -np.inf
    turn = 2.0 * np.pi / unseen[:, None]
    middle, began = 0.5 * (first + last), first[0]
    flat = np.sinc((last - first) / unseen[:, None])
    sine = SWING * flat * np.sin(turn * (middle - began))
    cosine = SWING * (flat * np.cos(turn * (middle - began)) - 1.0)
    one, two = (np.linalg.solve(lower, part.T).T for part in (sine, cosine))
    aa, bb = 1.0 + (one**2).sum(axis=1), 1.0 + (two**2).sum(axis=1)
    ab, u, v = (one * two).sum(axis=1), one @ misfit, two @ misfit
    area = aa * bb - ab**2
    each = 0.5 * ((bb * u**2 - 2.0 * ab * u * v + aa * v**2) / area - np.log(area))
    return float(np.logaddexp.reduce(each))


def excursion_of(numbers: Mapping[str, Any]) -> Excursion:
    """Return the excursion of which ``numbers`` were kept."""
    mean, covariance_then = numbers["mean"], numbers["covariance"]
    return Excursion(
        None if mean is None else np.array(mean),
        None if covariance_then is None else np.array(covariance_then),
        [list(one) for one in numbers["bins"]],
        numbers["stride"],
        numbers["seen"],
    )
