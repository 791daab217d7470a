"""The posterior of a statement: an exact grid over ln K, with what is linear integrated out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from model.identification.errors import CannotBeTold, Prior, ProbeErrors
from model.identification.evidence import LN_TWO_PI, DepthBins, Fitted, Noise, fitted
from model.identification.life import DepthLife
from model.identification.statements import Hypotheses, Statement

Array = NDArray[np.float64]

GRID = 161
"""Points over ln K: 20 to a standard deviation at least, in a range that holds all that counts."""
RANGE = 5.0
"""The first grid reaches so many of the prior's standard deviations to either side."""
NEGLIGIBLE = 18.0
"""What is less probable than the best by exp of this (1e-8) is left out."""
FINE_ENOUGH = 20
"""So many points of a grid within NEGLIGIBLE of the best make sums over it exact to 1e-6."""


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """Hold hypotheses with their weights, and what is normal given each of them.

    weight (H,); mean (H, 3) and covariance (H, 3, 3) of ln r less that of the hypothesis, e / u_e
    and b / u_b; left (H,), m,
    pulled (H, 3), m, and spare (H,), m^2: the drift of the last bin given them, its dependence on
    them, and what variance is left of it; strength (H,) of the drift.
    """

    hypotheses: Hypotheses
    weight: Array
    mean: Array
    covariance: Array
    left: Array
    pulled: Array
    spare: Array
    strength: Array

    @property
    def log_ratio(self) -> Array:
        """Return the mean of ln r, (H,)."""
        return self.hypotheses.log_ratio + self.mean[:, 0]

    def heaviest(self, share: float) -> Nodes:
        """Return the heaviest nodes that hold a share of the weight; theirs sums up to 1 again."""
        order = np.argsort(-self.weight)
        count = int(np.searchsorted(np.cumsum(self.weight[order]), share)) + 1
        return self.at(order[:count])

    def at(self, index: NDArray[np.int64]) -> Nodes:
        """Return some of the nodes; their weights sum up to 1 again."""
        weight = self.weight[index]
        h = self.hypotheses
        return Nodes(
            Hypotheses(h.statement, h.log_coefficient[index], h.log_ratio[index], h.place[index]),
            weight / weight.sum(),
            self.mean[index],
            self.covariance[index],
            self.left[index],
            self.pulled[index],
            self.spare[index],
            self.strength[index],
        )


@dataclass(frozen=True, slots=True, eq=False)
class Given:
    """Hold what a posterior is made of."""

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
        """Return the slopes (H, 2, n), m, of the readings by e / u_e and b / u_b."""
        level = np.full_like(depth, self.errors.reference)
        return np.stack([self.sensitivity * depth, level], axis=1)


def constant_posterior(
    given: Given, statement: Statement, noises: Sequence[Noise], log_prior: Array
) -> tuple[float, Nodes]:
    """Return the logarithm of the evidence of a constant K, and its nodes.

    noises: by strength of the drift; log_prior: of the strengths.
    """
    centre, spread = given.log_median, given.prior.spread
    grid = np.linspace(centre - RANGE * spread, centre + RANGE * spread, GRID)
    while True:
        hypotheses = Hypotheses(statement, grid, np.zeros(GRID), np.ones(GRID))
        depth, _ = given.depth(hypotheses)
        columns = given.linear(depth)
        misfit = given.readings.depth - depth
        each = [fitted(one, misfit, columns, np.zeros((GRID, 2)), np.eye(2)) for one in noises]
        log_density = -0.5 * (((grid - centre) / spread) ** 2 + LN_TWO_PI) - np.log(spread)
        log_post = np.array([one.log_evidence for one in each]) + log_density + log_prior[:, None]
        counts = log_post > log_post.max() - NEGLIGIBLE
        inside = np.flatnonzero(counts.any(axis=0))
        if inside.size >= FINE_ENOUGH:
            break
        low, high = max(inside[0] - 1, 0), min(inside[-1] + 1, GRID - 1)
        grid = np.linspace(grid[low], grid[high], GRID)
    _refuse_beyond(given, depth[:, -1], log_post)
    log_weight = log_post + np.log(grid[1] - grid[0])
    return float(np.logaddexp.reduce(log_weight, axis=None)), _kept(
        hypotheses, noises, each, log_weight
    )


def _kept(
    hypotheses: Hypotheses, noises: Sequence[Noise], each: Sequence[Fitted], log_weight: Array
) -> Nodes:
    """Return the nodes that count, of grids by strength (J, H), their weights summing up to 1."""
    which, at = np.nonzero(log_weight > log_weight.max() - NEGLIGIBLE)
    weight = np.exp(log_weight[which, at] - log_weight.max())
    size = at.size
    mean, covariance, pulled = np.zeros((size, 3)), np.zeros((size, 3, 3)), np.zeros((size, 3))
    used = slice(3 - each[0].step.shape[1], 3)
    mean[:, used] = np.array([one.step for one in each])[which, at]
    covariance[:, used, used] = np.array([one.covariance for one in each])[which, at]
    pulled[:, used] = np.array([one.pulled for one in each])[which, at]
    return Nodes(
        Hypotheses(
            hypotheses.statement,
            hypotheses.log_coefficient[at],
            hypotheses.log_ratio[at],
            hypotheses.place[at],
        ),
        weight / weight.sum(),
        mean,
        covariance,
        np.array([one.left for one in each])[which, at],
        pulled,
        np.array([one.spare for one in noises])[which],
        np.array([one.strength for one in noises])[which],
    )


def _refuse_beyond(given: Given, depth: Array, log_post: Array) -> None:
    """Raise CannotBeTold where what counts of the posterior is not computed any more.

    depth (H,): of the last bin by the hypotheses, m; log_post (J, H).
    """
    reach = given.life.reach
    share = np.exp(log_post - log_post.max()).sum(axis=0)
    if share[depth >= reach].sum() > 1e-3 * share.sum():
        raise CannotBeTold(
            f"the model computes the life to a depth of {1e6 * reach:.4g} um only, and"
            f" {1e6 * given.readings.depth[-1]:.4g} um are measured: compute it further"
        )
