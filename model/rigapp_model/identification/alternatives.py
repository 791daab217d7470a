"""The posterior of running-in and of a change: a grid over where it was, and over ln K.

Where it was is a grid of cells in ln P, each of which is divided again while it counts. In a cell
the best (ln K, ln r) is found by Gauss-Newton; about it ln K is a grid, ln r is integrated out with
sensitivity and reference.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr

from rigapp_model.identification.evidence import (
    LN_TWO_PI,
    Fitted,
    Linearised,
    best_step,
    fitted,
)
from rigapp_model.identification.noise import Noise
from rigapp_model.identification.posterior import Given, Nodes, kept
from rigapp_model.identification.statements import RUNNING_IN_PLACES, Hypotheses, Statement

Array = NDArray[np.float64]

RUNNING_IN_CELLS = 4
"""Cells to a decade of running-in before they are divided: its course changes little in one."""
BINS_A_CELL = 2
"""Of a change, before its cell is divided: within a bin the depth grows by a fifth only."""
PARTS = 4
DIVIDED = 2
"""Cells are divided into so many parts, so many times."""
COUNTS = 10.0
"""A cell counts while it is less probable than the best by no more than exp of this."""
DIVIDED_FROM = 0.2
"""A cell is divided when it holds this share of the weight: where all are alike, none is sharp."""
LARGEST_STEP = 0.7
"""Gauss-Newton changes K or r by a factor of 2 at most in a step."""
FIRST_STEPS, MORE_STEPS = 4, 2
"""So many steps from a constant coefficient, and from a near cell's best, settle to 1e-3."""
BREADTH = 4.0
"""The grid over ln K about a cell's best reaches so many standard deviations to either side."""
LEAST_POINTS, MOST_POINTS, NODES = 7, 21, 100
"""Points of that grid: about so many in all cells; 7 are exact to 1e-3 in sums over many cells."""


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Hold where something may have happened: lower and upper ln P of cells, and the best there.

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
    def place(self) -> Array:
        """Return the middle of each, nominal cycles."""
        return np.exp(0.5 * (self.low + self.high))

    def at(self, index: NDArray[np.int64]) -> Cells:
        """Return some of the cells."""
        return Cells(*(getattr(self, one.name)[index] for one in fields(self)))

    @property
    def counting(self) -> Cells:
        """Return those that count."""
        return self.at(np.flatnonzero(self.log_weight > self.log_weight.max() - COUNTS))

    def divided(self) -> Cells:
        """Return the parts of each cell, with what was found of the whole."""
        edges = np.linspace(self.low, self.high, PARTS + 1, axis=1)
        again = self.at(np.repeat(np.arange(self.low.size), PARTS))
        return replace(again, low=edges[:, :-1].ravel(), high=edges[:, 1:].ravel())

    def joined(self, other: Cells) -> Cells:
        """Return both."""
        pairs = ((getattr(self, one.name), getattr(other, one.name)) for one in fields(self))
        return Cells(*(np.concatenate(pair) for pair in pairs))


def alternative_posterior(given: Given, statement: Statement, start: float) -> tuple[float, Nodes]:
    """Return the logarithm of the evidence of a statement with two coefficients, and its nodes.

    start: ln(K/K0) to begin with.
    """
    cells = _first_cells(given, statement, start)
    whole = float(cells.high[-1] - cells.low[0])
    first = given.noise.at(np.array([0]))
    cells, noise = _settled(given, statement, first, cells.counting, FIRST_STEPS)
    for _ in range(DIVIDED):
        share = np.exp(cells.log_weight - np.logaddexp.reduce(cells.log_weight))
        wide = share > DIVIDED_FROM
        if not wide.any():
            break
        parts = cells.at(np.flatnonzero(wide)).divided()
        parts, noise = _settled(given, statement, noise.at(np.array([0])), parts, MORE_STEPS)
        cells = cells.at(np.flatnonzero(~wide)).joined(parts).counting
    return _nodes(replace(given, noise=noise), statement, cells, whole)


def _first_cells(given: Given, statement: Statement, start: float) -> Cells:
    """Return cells wherever something may have happened, at a constant coefficient."""
    progress = given.readings.progress
    if statement.anywhere:
        end = progress[-1] + given.readings.half[-1]
        edges = np.log(np.append(progress[:-1:BINS_A_CELL], end))
    else:
        low, high = np.log(RUNNING_IN_PLACES)
        count = round(float(high - low) / np.log(10.0) * RUNNING_IN_CELLS)
        edges = np.linspace(low, high, count + 1)
    size = edges.size - 1
    nothing = np.zeros(size)
    return Cells(
        edges[:-1], edges[1:], np.full(size, start), nothing, nothing, np.zeros((size, 5, 5))
    )


def _settled(
    given: Given, statement: Statement, noise: Noise, cells: Cells, steps: int
) -> tuple[Cells, Noise]:
    """Return the cells with the best coefficients after so many steps, for one kind of noise.

    And the kinds of noise that count, the most probable first: the cells are by that one.
    """
    at = Hypotheses(statement, cells.log_coefficient, cells.log_ratio, cells.place)
    for _ in range(steps):
        step = np.clip(
            best_step(noise, _all_four(given, at))[0, :, :2], -LARGEST_STEP, LARGEST_STEP
        )
        at = replace(
            at,
            log_coefficient=at.log_coefficient + step[:, 0],
            log_ratio=at.log_ratio + step[:, 1],
        )
    fit = fitted(given.noise, _all_four(given, at))
    log_weight = (
        fit.log_evidence + np.log(cells.high - cells.low) + given.noise.kinds.log_prior[:, None]
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
    ), given.noise.at(order)


def _all_four(given: Given, at: Hypotheses) -> Linearised:
    """Linearise some hypotheses in ln K, ln r, e, b and a."""
    depth, slopes = given.depth(at)
    columns = np.concatenate([slopes.swapaxes(0, 1), given.linear(depth)], axis=1)
    off = np.zeros((depth.shape[0], 5))
    off[:, 0], off[:, 1] = given.log_median - at.log_coefficient, -at.log_ratio
    precision = np.eye(5)
    precision[:2, :2] = at.statement.precision(given.prior)
    return Linearised(given.readings.depth - depth, columns, off, precision)


def _nodes(given: Given, statement: Statement, cells: Cells, whole: float) -> tuple[float, Nodes]:
    """Return the evidence, and nodes in ln K about the best of each cell.

    whole: ln P that all cells hold together.
    """
    precision = statement.precision(given.prior)
    by_ratio = precision[1, 1]
    alone = precision[0, 0] - precision[0, 1] ** 2 / by_ratio
    size = np.sqrt(cells.covariance[:, 0, 0])
    count = int(np.clip(NODES // size.size, LEAST_POINTS, MOST_POINTS))
    points = np.linspace(-BREADTH, BREADTH, count)
    moved = points * size[:, None]
    along = cells.covariance[:, 1, 0] / cells.covariance[:, 0, 0]
    at = Hypotheses(
        statement,
        (cells.log_coefficient[:, None] + moved).ravel(),
        (cells.log_ratio[:, None] + moved * along[:, None]).ravel(),
        np.repeat(cells.place, count),
    )
    depth, slopes = given.depth(at)
    columns = np.concatenate([slopes[1][:, None], given.linear(depth)], axis=1)
    away = at.log_coefficient - given.log_median
    off = np.zeros((depth.shape[0], 4))
    off[:, 0] = -precision[0, 1] / by_ratio * away - at.log_ratio
    linear = Linearised(
        given.readings.depth - depth, columns, off, np.diag([by_ratio, 1.0, 1.0, 1.0])
    )
    fit = fitted(given.noise, linear)
    log_cell = np.log(size * (points[1] - points[0]) * (cells.high - cells.low) / whole)
    log_weight = (
        fit.log_evidence
        - 0.5 * (alone * away**2 + LN_TWO_PI - np.log(alone))
        + np.repeat(log_cell, count)
        + given.noise.kinds.log_prior[:, None]
    )
    if statement.falls:
        log_weight, fit = _falling(log_weight, at, fit)
    breadth = np.repeat(size * (points[1] - points[0]), count)
    return kept(given.noise, at, fit, log_weight, breadth, np.repeat(along, count))


def _falling(log_weight: Array, at: Hypotheses, fit: Fitted) -> tuple[Array, Fitted]:
    """Cut ln r off below 0: the weight that is left above, and moments of what is."""
    size = np.sqrt(fit.covariance[..., 0, 0])
    above = (at.log_ratio + fit.step[..., 0]) / size
    log_share = log_ndtr(above)
    hazard = np.exp(-0.5 * (above**2 + LN_TWO_PI) - log_share)
    gain = fit.covariance[..., 0] / fit.covariance[..., :1, 0]
    shift = gain * (size * hazard)[..., None]
    lost = size**2 * np.clip(hazard * (hazard + above), 0.0, 1.0)
    return log_weight + log_share + np.log(2.0), replace(
        fit,
        step=fit.step + shift,
        covariance=fit.covariance - gain[..., None] * gain[..., None, :] * lost[..., None, None],
        left=fit.left - (fit.pulled @ shift[..., None])[..., 0],
    )
