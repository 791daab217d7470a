"""Posterior of a statement: a grid over ln K, with linear parameters marginalised."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr

from rigapp.texts import say
from rigapp_model.identification.errors import NotIdentifiable, Prior, ProbeErrors
from rigapp_model.identification.evidence import (
    LN_TWO_PI,
    Fitted,
    Linearised,
    best_step,
    fitted,
)
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.noise import DepthBins, Kinds, Noise
from rigapp_model.identification.statements import RUNNING_IN_PLACES, Hypotheses, Statement

Array = NDArray[np.float64]

GRID = 61
"""Points over ln K in the relevant range: two per standard deviation."""
RANGE = 5.0
"""Half width of the first grid, in standard deviations of the prior."""
NEGLIGIBLE = 18.0
"""Log of the ratio to the most probable (1e-8) beyond which nodes are omitted."""
FINE_ENOUGH = 24
"""Points of a grid within NEGLIGIBLE of the best that make sums over it exact to 1e-4."""


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """Hypotheses with their weights, and the normal parameters given each of them.

    breadth (H,): interval of ln K of each, over which ln r changes by slope (H,) times it;
    weight (H,); mean (H, 4) and covariance (H, 4, 4) of ln r relative to the hypothesis, e / u_e,
    b / u_b and the modulus a; left (H, S), pulled (H, S, 4), and spare (H, S, S): states of
    ``Noise`` given these, negative derivative with respect to them, and residual covariance;
    kinds: of noise, (H,); steps: see ``Noise``.
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
        """Return ln(K/K0) at a progress, (H,), and its breadth.

        The normal distribution within it is replaced by a uniform one of the same variance.
        """
        at = self.hypotheses
        ratio, slope = at.statement.ratio_now(self.log_ratio, progress, at.transition)
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
        """Return the heaviest nodes with a share of the weight, normalised again."""
        order = np.argsort(-self.weight)
        count = int(np.searchsorted(np.cumsum(self.weight[order]), share)) + 1
        return self.at(order[:count])

    def at(self, index: NDArray[np.int64]) -> Nodes:
        """Return the selected nodes, with weights normalised again."""
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
    """Inputs of a posterior without the noise."""

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
        """Return u_e including the error of the life, which has the same effect."""
        return float(np.hypot(self.errors.sensitivity, self.life.relative_error / np.sqrt(3.0)))

    def depth(self, hypotheses: Hypotheses) -> tuple[Array, Array]:
        """Return the depth of the bins for hypotheses, (H, n), m, and slopes by ln K and ln r."""
        return self.life.depth(self.readings.progress, hypotheses.scaled(self.readings.half))

    def linear(self, depth: Array) -> Array:
        """Return the slopes (H, 3, n), m, of the readings by e / u_e, b / u_b and a."""
        level = np.full_like(depth, self.errors.reference)
        return np.stack([self.sensitivity * depth, level, self.life.elastic_doubt(depth)], axis=1)

    def best_constant(self, constant: Statement) -> float:
        """Return ln(K/K0) of the best constant coefficient, with independent bins."""
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
class PosteriorInputs(IdentificationInputs):
    """Inputs of a posterior."""

    noise: Noise


def constant_posterior(inputs: PosteriorInputs, statement: Statement) -> tuple[float, Nodes]:
    """Return the log evidence of a constant K, and its nodes."""
    centre, spread = inputs.log_median, inputs.prior.spread
    low, high = centre - RANGE * spread, centre + RANGE * spread
    while True:
        grid = np.linspace(low, high, GRID)
        hypotheses = Hypotheses(statement, grid, np.zeros(GRID), np.ones(GRID))
        depth, _ = inputs.depth(hypotheses)
        misfit = inputs.readings.depth - depth
        fit = fitted(
            inputs.noise,
            Linearised(misfit, inputs.linear(depth), np.zeros((GRID, 3)), np.eye(3)),
        )
        log_density = -0.5 * (((grid - centre) / spread) ** 2 + LN_TWO_PI) - np.log(spread)
        log_post = fit.log_evidence + log_density + inputs.noise.kinds.log_prior[:, None]
        relevant = log_post > log_post.max() - NEGLIGIBLE
        inside = np.flatnonzero(relevant.any(axis=0))
        if inside.size >= FINE_ENOUGH:
            break
        low, high = grid[max(inside[0] - 1, 0)], grid[min(inside[-1] + 1, GRID - 1)]
    _check_computed(inputs, depth[:, -1], log_post)
    step = float(grid[1] - grid[0])
    log_weight = log_post + np.log(step)
    return relevant_nodes(
        inputs.noise, hypotheses, fit, log_weight, np.full(GRID, step), np.zeros(GRID)
    )


def relevant_nodes(
    noise: Noise, at: Hypotheses, fit: Fitted, log_weight: Array, breadth: Array, slope: Array
) -> tuple[float, Nodes]:
    """Return the log of the sum of weights (J, H), and the nodes that are not negligible."""
    total = float(np.logaddexp.reduce(log_weight, axis=None))
    which, node = np.nonzero(log_weight > log_weight.max() - NEGLIGIBLE)
    weight = np.exp(log_weight[which, node] - log_weight.max())
    missing = 4 - fit.step.shape[2]  # a constant coefficient has no ratio

    def padded(values: Array, axes: int) -> Array:
        selected = values[which, node]
        return np.pad(selected, [(0, 0)] * (selected.ndim - axes) + [(missing, 0)] * axes)

    return total, Nodes(
        at.at(node),
        breadth[node],
        slope[node],
        weight / weight.sum(),
        padded(fit.step, 1),
        padded(fit.covariance, 2),
        fit.left[which, node],
        padded(fit.pulled, 1),
        noise.spare[which],
        noise.kinds.at(which),
        noise.steps,
    )


def _check_computed(inputs: PosteriorInputs, depth: Array, log_post: Array) -> None:
    """Raise NotIdentifiable if a relevant part of the posterior is beyond the computed life.

    depth (H,): of the last bin for the hypotheses, m; log_post (J, H).
    """
    deepest = inputs.life.computed_depth
    share = np.exp(log_post - log_post.max()).sum(axis=0)
    if share[depth >= deepest].sum() > 1e-3 * share.sum():
        raise NotIdentifiable(
            say(
                "the model computes the life to a depth of {:.4g} um only, and {:.4g} um"
                " are measured: compute it further",
                1e6 * deepest,
                1e6 * inputs.readings.depth[-1],
            )
        )


# The posterior of running-in and of a change: a grid over the transition, and over ln K.
#
# The transition is a grid of cells in ln P; heavy cells are divided again. In each cell the best
# (ln K, ln r) is found by Gauss-Newton; around it ln K is a grid, and ln r is marginalised together
# with sensitivity and reference.

RUNNING_IN_CELLS = 4
"""Undivided cells per decade of running-in: the course changes little within one."""
BINS_A_CELL = 2
"""Bins per undivided cell of a change: within a bin the depth grows by a fifth only."""
PARTS = 4
DIVIDED = 2
"""Parts of a divided cell, and number of divisions."""
COUNTS = 10.0
"""Log of the ratio to the most probable cell or kind of noise up to which others are used."""
DIVIDED_FROM = 0.2
"""Share of the weight from which a cell is divided: with equal cells none is sharp."""
LARGEST_STEP = 0.7
"""Limit of a Gauss-Newton step: a factor of 2 of K or r."""
FIRST_STEPS, MORE_STEPS = 4, 2
"""Steps that converge to 1e-3 from a constant coefficient, and from the best of a near cell."""
BREADTH = 4.0
"""Half width of the grid over ln K about a cell's best, in standard deviations."""
LEAST_POINTS, MOST_POINTS, NODES = 7, 21, 100
"""Points of that grid, and in all cells together; 7 are exact to 1e-3 in sums over many cells."""


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Cells of the transition: lower and upper ln P, and the best coefficients there.

    All (C,): low, high; log_coefficient, log_ratio: the best ln(K/K0) and ln r; log_weight of the
    cell; covariance (C, 5, 5) of both with sensitivity, reference and modulus.
    """

    low: Array
    high: Array
    log_coefficient: Array
    log_ratio: Array
    log_weight: Array
    covariance: Array

    @property
    def transition(self) -> Array:
        """Return the middle of each cell, nominal cycles."""
        return np.exp(0.5 * (self.low + self.high))

    def at(self, index: NDArray[np.int64]) -> Cells:
        """Return the selected cells."""
        return Cells(*(getattr(self, field.name)[index] for field in fields(self)))

    @property
    def counting(self) -> Cells:
        """Return the cells that are not negligible (``COUNTS``)."""
        return self.at(np.flatnonzero(self.log_weight > self.log_weight.max() - COUNTS))

    def divided(self) -> Cells:
        """Return the parts of each cell, with the results of the undivided cell."""
        edges = np.linspace(self.low, self.high, PARTS + 1, axis=1)
        parts = self.at(np.repeat(np.arange(self.low.size), PARTS))
        return replace(parts, low=edges[:, :-1].ravel(), high=edges[:, 1:].ravel())

    def joined(self, other: Cells) -> Cells:
        """Return the cells of both."""
        pairs = ((getattr(self, field.name), getattr(other, field.name)) for field in fields(self))
        return Cells(*(np.concatenate(pair) for pair in pairs))


def alternative_posterior(
    inputs: PosteriorInputs, statement: Statement, start: float
) -> tuple[float, Nodes]:
    """Return the log evidence of a statement with two coefficients, and its nodes.

    start: initial ln(K/K0).
    """
    cells = _first_cells(inputs, statement, start)
    extent = float(cells.high[-1] - cells.low[0])
    first = inputs.noise.at(np.array([0]))
    cells, noise = _converged(inputs, statement, first, cells.counting, FIRST_STEPS)
    for _ in range(DIVIDED):
        share = np.exp(cells.log_weight - np.logaddexp.reduce(cells.log_weight))
        wide = share > DIVIDED_FROM
        if not wide.any():
            break
        parts = cells.at(np.flatnonzero(wide)).divided()
        parts, noise = _converged(inputs, statement, noise.at(np.array([0])), parts, MORE_STEPS)
        cells = cells.at(np.flatnonzero(~wide)).joined(parts).counting
    return _nodes(replace(inputs, noise=noise), statement, cells, extent)


def _first_cells(inputs: PosteriorInputs, statement: Statement, start: float) -> Cells:
    """Return cells of all possible transitions, at a constant coefficient."""
    progress = inputs.readings.progress
    if statement.anywhere:
        end = progress[-1] + inputs.readings.half[-1]
        edges = np.log(np.append(progress[:-1:BINS_A_CELL], end))
    else:
        low, high = np.log(RUNNING_IN_PLACES)
        count = round(float(high - low) / np.log(10.0) * RUNNING_IN_CELLS)
        edges = np.linspace(low, high, count + 1)
    size = edges.size - 1
    zero = np.zeros(size)
    return Cells(edges[:-1], edges[1:], np.full(size, start), zero, zero, np.zeros((size, 5, 5)))


def _converged(
    inputs: PosteriorInputs, statement: Statement, noise: Noise, cells: Cells, steps: int
) -> tuple[Cells, Noise]:
    """Return the cells with the best coefficients after Gauss-Newton ``steps``.

    Also the relevant kinds of noise, the most probable first; the cells are for that one.
    """
    at = Hypotheses(statement, cells.log_coefficient, cells.log_ratio, cells.transition)
    for _ in range(steps):
        step = np.clip(
            best_step(noise, _linearise_all(inputs, at))[0, :, :2], -LARGEST_STEP, LARGEST_STEP
        )
        at = replace(
            at,
            log_coefficient=at.log_coefficient + step[:, 0],
            log_ratio=at.log_ratio + step[:, 1],
        )
    fit = fitted(inputs.noise, _linearise_all(inputs, at))
    log_weight = (
        fit.log_evidence + np.log(cells.high - cells.low) + inputs.noise.kinds.log_prior[:, None]
    )
    if statement.falls:
        log_weight = log_weight + log_ndtr(at.log_ratio / np.sqrt(fit.covariance[..., 1, 1]))
    by_strength = log_weight.max(axis=1)
    order = np.argsort(-by_strength)
    order = order[by_strength[order] > by_strength.max() - COUNTS]
    best = int(order[0])
    return Cells(
        cells.low,
        cells.high,
        at.log_coefficient,
        at.log_ratio,
        log_weight[best],
        fit.covariance[best],
    ), inputs.noise.at(order)


def _linearise_all(inputs: PosteriorInputs, at: Hypotheses) -> Linearised:
    """Linearise hypotheses in ln K, ln r, e, b and a."""
    depth, slopes = inputs.depth(at)
    columns = np.concatenate([slopes.swapaxes(0, 1), inputs.linear(depth)], axis=1)
    off = np.zeros((depth.shape[0], 5))
    off[:, 0], off[:, 1] = inputs.log_median - at.log_coefficient, -at.log_ratio
    precision = np.eye(5)
    precision[:2, :2] = at.statement.precision(inputs.prior)
    return Linearised(inputs.readings.depth - depth, columns, off, precision)


def _nodes(
    inputs: PosteriorInputs, statement: Statement, cells: Cells, extent: float
) -> tuple[float, Nodes]:
    """Return the log evidence, and nodes in ln K about the best of each cell.

    extent: range of ln P of all cells together.
    """
    precision = statement.precision(inputs.prior)
    by_ratio = precision[1, 1]
    marginal_precision = precision[0, 0] - precision[0, 1] ** 2 / by_ratio
    size = np.sqrt(cells.covariance[:, 0, 0])
    count = int(np.clip(NODES // size.size, LEAST_POINTS, MOST_POINTS))
    points = np.linspace(-BREADTH, BREADTH, count)
    offsets = points * size[:, None]
    along = cells.covariance[:, 1, 0] / cells.covariance[:, 0, 0]
    at = Hypotheses(
        statement,
        (cells.log_coefficient[:, None] + offsets).ravel(),
        (cells.log_ratio[:, None] + offsets * along[:, None]).ravel(),
        np.repeat(cells.transition, count),
    )
    depth, slopes = inputs.depth(at)
    columns = np.concatenate([slopes[1][:, None], inputs.linear(depth)], axis=1)
    deviation = at.log_coefficient - inputs.log_median
    off = np.zeros((depth.shape[0], 4))
    off[:, 0] = -precision[0, 1] / by_ratio * deviation - at.log_ratio
    linear = Linearised(
        inputs.readings.depth - depth, columns, off, np.diag([by_ratio, 1.0, 1.0, 1.0])
    )
    fit = fitted(inputs.noise, linear)
    log_cell = np.log(size * (points[1] - points[0]) * (cells.high - cells.low) / extent)
    log_weight = (
        fit.log_evidence
        - 0.5 * (marginal_precision * deviation**2 + LN_TWO_PI - np.log(marginal_precision))
        + np.repeat(log_cell, count)
        + inputs.noise.kinds.log_prior[:, None]
    )
    if statement.falls:
        log_weight, fit = _falling(log_weight, at, fit)
    breadth = np.repeat(size * (points[1] - points[0]), count)
    return relevant_nodes(inputs.noise, at, fit, log_weight, breadth, np.repeat(along, count))


def _falling(log_weight: Array, at: Hypotheses, fit: Fitted) -> tuple[Array, Fitted]:
    """Truncate ln r at 0; return the log weights and the fit with the moments above 0."""
    size = np.sqrt(fit.covariance[..., 0, 0])
    above = (at.log_ratio + fit.step[..., 0]) / size
    log_share = log_ndtr(above)
    hazard = np.exp(-0.5 * (above**2 + LN_TWO_PI) - log_share)
    gain = fit.covariance[..., 0] / fit.covariance[..., :1, 0]
    shift = gain * (size * hazard)[..., None]
    reduction = size**2 * np.clip(hazard * (hazard + above), 0.0, 1.0)
    return log_weight + log_share + np.log(2.0), replace(
        fit,
        step=fit.step + shift,
        covariance=fit.covariance
        - gain[..., None] * gain[..., None, :] * reduction[..., None, None],
        left=fit.left - (fit.pulled @ shift[..., None])[..., 0],
    )
