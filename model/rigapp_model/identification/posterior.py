"""The posterior of a statement: an exact grid over ln K, with what is linear integrated out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.identification.errors import NotIdentifiable, Prior, ProbeErrors
from rigapp_model.identification.evidence import (
    LN_TWO_PI,
    Fitted,
    Linearised,
    fitted,
)
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.noise import DepthBins, Kinds, Noise
from rigapp_model.identification.statements import Hypotheses, Statement

Array = NDArray[np.float64]

GRID = 61
"""Points over ln K in a range that holds all that counts: two to a standard deviation."""
RANGE = 5.0
"""The first grid reaches so many of the prior's standard deviations to either side."""
NEGLIGIBLE = 18.0
"""What is less probable than the best by exp of this (1e-8) is left out."""
FINE_ENOUGH = 24
"""So many points of a grid within NEGLIGIBLE of the best make sums over it exact to 1e-4."""


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """Hold hypotheses with their weights, and what is normal given each of them.

    breadth (H,): of ln K that each stands for, along which ln r changes by slope (H,) times it;
    weight (H,); mean (H, 4) and covariance (H, 4, 4) of ln r less that of the hypothesis, e / u_e,
    b / u_b and the modulus a; left (H, S), pulled (H, S, 4), and spare (H, S, S): the states of
    ``Noise`` given them, their dependence on them, and what covariance is left; kinds: of noise,
    (H,); steps: see ``Noise``.
    """

    hypotheses: Hypotheses
    breadth: Array
    slope: Array
    weight: Array
    mean: Array
    covariance: Array
    left: Array
    pulled: Array
    spare: Array
    kinds: Kinds
    steps: Array

    @property
    def log_ratio(self) -> Array:
        """Return the mean of ln r, (H,)."""
        return self.hypotheses.log_ratio + self.mean[:, 0]

    def now(self, progress: float) -> tuple[Array, Array]:
        """Return ln of the coefficient at a progress to K0, (H,), and its breadth.

        What is spread within it is normal: it is as broad as an even spread of the same variance.
        """
        at = self.hypotheses
        ratio, slope = at.statement.ratio_now(self.log_ratio, progress, at.place)
        along = self.breadth * (1.0 + slope * self.slope)
        breadth = np.sqrt(along**2 + 12.0 * slope**2 * self.covariance[:, 0, 0])
        return at.log_coefficient + ratio, breadth

    @property
    def log_moments(self) -> tuple[float, float]:
        """Return mean and standard deviation of ln(K/K0)."""
        values = self.hypotheses.log_coefficient
        mean = float(self.weight @ values)
        variance = self.weight @ ((values - mean) ** 2 + self.breadth**2 / 12.0)
        return mean, float(np.sqrt(variance))

    def heaviest(self, share: float) -> Nodes:
        """Return the heaviest nodes that hold a share of the weight; theirs sums up to 1 again."""
        order = np.argsort(-self.weight)
        count = int(np.searchsorted(np.cumsum(self.weight[order]), share)) + 1
        return self.at(order[:count])

    def at(self, index: NDArray[np.int64]) -> Nodes:
        """Return some of the nodes; their weights sum up to 1 again."""
        weight = self.weight[index]
        return Nodes(
            self.hypotheses.at(index),
            self.breadth[index],
            self.slope[index],
            weight / weight.sum(),
            self.mean[index],
            self.covariance[index],
            self.left[index],
            self.pulled[index],
            self.spare[index],
            self.kinds.at(index),
            self.steps,
        )


@dataclass(frozen=True, slots=True, eq=False)
class IdentificationInputs:
    """Hold what a posterior is made of, but for the noise."""

    readings: DepthBins
    life: DepthLife
    errors: ProbeErrors
    prior: Prior

    @property
    def log_median(self) -> float:
        """Return the prior's mean of ln(K/K0)."""
        return float(np.log(self.prior.coefficient / self.life.coefficient))

    @property
    def sensitivity(self) -> float:
        """Return u_e with the life's own error, which acts alike, as a standard uncertainty."""
        return float(np.hypot(self.errors.sensitivity, self.life.relative_error / np.sqrt(3.0)))

    def depth(self, hypotheses: Hypotheses) -> tuple[Array, Array]:
        """Return what hypotheses say of the bins, (H, n), m, and the slopes by ln K and ln r."""
        return self.life.depth(self.readings.progress, hypotheses.scaled(self.readings.half))

    def linear(self, depth: Array) -> Array:
        """Return the slopes (H, 3, n), m, of the readings by e / u_e, b / u_b and a."""
        level = np.full_like(depth, self.errors.reference)
        return np.stack([self.sensitivity * depth, level, self.life.elastic_doubt(depth)], axis=1)

    def best_constant(self, constant: Statement) -> float:
        """Return ln(K/K0) of the constant coefficient that fits best, all bins alike."""
        weight = 1.0 / np.hypot(self.readings.noise, 0.01 * self.readings.depth + 1e-6)
        start = np.full(1, self.log_median)
        for _ in range(12):
            at = Hypotheses(constant, start, np.zeros(1), np.ones(1))
            depth, slopes = self.depth(at)
            slope = weight * slopes[0, 0]
            misfit = slope @ (weight * (self.readings.depth - depth[0]))
            pull = (self.log_median - start) * self.prior.spread**-2
            step = (misfit + pull) / (slope @ slope + self.prior.spread**-2)
            start = start + np.clip(step, -1.0, 1.0)
        return float(start[0])


@dataclass(frozen=True, slots=True, eq=False)
class Given(IdentificationInputs):
    """Hold what a posterior is made of."""

    noise: Noise


def constant_posterior(given: Given, statement: Statement) -> tuple[float, Nodes]:
    """Return the logarithm of the evidence of a constant K, and its nodes."""
    centre, spread = given.log_median, given.prior.spread
    low, high = centre - RANGE * spread, centre + RANGE * spread
    while True:
        grid = np.linspace(low, high, GRID)
        hypotheses = Hypotheses(statement, grid, np.zeros(GRID), np.ones(GRID))
        depth, _ = given.depth(hypotheses)
        misfit = given.readings.depth - depth
        fit = fitted(
            given.noise,
            Linearised(misfit, given.linear(depth), np.zeros((GRID, 3)), np.eye(3)),
        )
        log_density = -0.5 * (((grid - centre) / spread) ** 2 + LN_TWO_PI) - np.log(spread)
        log_post = fit.log_evidence + log_density + given.noise.kinds.log_prior[:, None]
        counts = log_post > log_post.max() - NEGLIGIBLE
        inside = np.flatnonzero(counts.any(axis=0))
        if inside.size >= FINE_ENOUGH:
            break
        low, high = grid[max(inside[0] - 1, 0)], grid[min(inside[-1] + 1, GRID - 1)]
    _refuse_beyond(given, depth[:, -1], log_post)
    step = float(grid[1] - grid[0])
    log_weight = log_post + np.log(step)
    return kept(given.noise, hypotheses, fit, log_weight, np.full(GRID, step), np.zeros(GRID))


def kept(
    noise: Noise, at: Hypotheses, fit: Fitted, log_weight: Array, breadth: Array, slope: Array
) -> tuple[float, Nodes]:
    """Return the logarithm of the sum of weights (J, H), and nodes of those that count."""
    total = float(np.logaddexp.reduce(log_weight, axis=None))
    which, place = np.nonzero(log_weight > log_weight.max() - NEGLIGIBLE)
    weight = np.exp(log_weight[which, place] - log_weight.max())
    missing = 4 - fit.step.shape[2]  # a constant coefficient has no ratio

    def padded(values: Array, axes: int) -> Array:
        found = values[which, place]
        return np.pad(found, [(0, 0)] * (found.ndim - axes) + [(missing, 0)] * axes)

    return total, Nodes(
        at.at(place),
        breadth[place],
        slope[place],
        weight / weight.sum(),
        padded(fit.step, 1),
        padded(fit.covariance, 2),
        fit.left[which, place],
        padded(fit.pulled, 1),
        noise.spare[which],
        noise.kinds.at(which),
        noise.steps,
    )


def _refuse_beyond(given: Given, depth: Array, log_post: Array) -> None:
    """Raise NotIdentifiable where what counts of the posterior is not computed any more.

    depth (H,): of the last bin by the hypotheses, m; log_post (J, H).
    """
    reach = given.life.reach
    share = np.exp(log_post - log_post.max()).sum(axis=0)
    if share[depth >= reach].sum() > 1e-3 * share.sum():
        raise NotIdentifiable(
            say(
                "the model computes the life to a depth of {:.4g} um only, and {:.4g} um"
                " are measured: compute it further",
                1e6 * reach,
                1e6 * given.readings.depth[-1],
            )
        )
