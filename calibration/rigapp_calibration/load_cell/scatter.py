"""What the readings of a calibration scatter, taken apart so that nothing counts twice.

Each reading leaves the fit by the branch on which it lies (rising or falling: hysteresis, and what
a straight line does not follow), by what its whole series has in common (zero, gain, angle) and by
noise. Steps of the display are in the noise: they made the readings. What noise alone would show of
branch, zero and gain is taken off.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import ACROSS, Array, Whole
from rigapp_calibration.load_cell.characteristics import Loads
from rigapp_calibration.load_cell.two_axis import TwoAxisFit, design
from rigapp_calibration.taking.clustered import SeriesScores, series_scores

FEWEST_LOADS = 3
"""Loads that three shapes follow whatever they are; more tell something."""


@dataclass(frozen=True, slots=True, eq=False)
class Branches:
    """How the rising and the falling readings leave the fit along the load.

    coefficients (b, 3), N, of 1, w and sin(pi w), w the load over the largest; covariance (b, 3, 3)
    by the noise; b is 2, or 1 of rising loads only. slope (3,): of the shapes at the rising loads.
    largest: load, N.
    """

    coefficients: Array
    covariance: Array
    slope: Array
    largest: float

    def points(self, load: float) -> tuple[float, ...]:
        """Return the deviations at a load, N; what noise would show of them is taken off."""
        row = _shapes(np.array([min(load / self.largest, 1.0)]))[0]
        values = self.coefficients @ row
        noise = float(np.einsum("i,bij,j->", row, self.covariance, row))
        return tuple((_beyond(float(values @ values), noise) * values).tolist())

    def gain(self) -> float:
        """Return by how much the rising loads' own gain differs from the fit's, noise taken off.

        Rising loads are the reference (ISO 376); the fit lies between them and the falling ones.
        """
        if not len(self.coefficients):
            return 0.0
        value = float(self.coefficients[0] @ self.slope)
        noise = float(self.slope @ self.covariance[0] @ self.slope)
        return _beyond(value**2, noise) * abs(value) / self.largest


@dataclass(frozen=True, slots=True, eq=False)
class Scatter:
    """The parts. Standard deviations of one component, N; gain relative to the load.

    scores: of the fit's errors, series by series. repeatability: of one reading within its series,
    with its degrees of freedom. steps: part of it that comes back at the same load and does not
    average out, as steps of the display in means do. unloaded: part of the readings that are zeros.
    zero_between, gain_between: of series, beyond the noise. drift: half the change of the zero
    during the calibration, beyond the noise.
    """

    found: TwoAxisFit
    scores: SeriesScores
    branches: Branches
    repeatability: float
    degrees: float
    steps: float
    unloaded: float
    zero_between: float
    gain_between: float
    drift: float

    @property
    def series(self) -> int:
        """Return how many series tell."""
        return len(self.scores.scores)


def scatter(found: TwoAxisFit, force: Array, seen: Loads) -> Scatter:
    """Take the residuals of a fit apart; force (n, 2) applied, N."""
    across = seen.direction @ ACROSS
    largest, runs = float(seen.applied.max()), seen.runs()
    along = np.einsum("ni,ni->n", found.residual, seen.direction)
    shapes, branches = _shapes(seen.applied / largest), _branch_rows(seen)
    solved = [np.linalg.lstsq(shapes[rows], along[rows], rcond=None)[0] for rows in branches]
    rows = design(force, found.terms)
    scores = series_scores(
        rows,
        _without_branches(found.residual, rows, shapes, branches, seen.direction),
        seen.applied,
        np.stack((seen.direction, across), -1),
        runs,
        2 if found.terms.quadratic else 1,
    )
    free = scores.free - shapes.shape[1] * len(branches)
    enough = free > 0
    noise = float(np.sum(scores.rest**2)) / free if enough else found.residual_std**2
    return Scatter(
        found=found,
        scores=scores,
        branches=Branches(
            np.array(solved).reshape(-1, 3),
            noise
            * np.array([np.linalg.inv(shapes[r].T @ shapes[r]) for r in branches]).reshape(
                -1, 3, 3
            ),
            _slope(shapes[branches[0]]) if branches else np.zeros(3),
            largest,
        ),
        repeatability=math.sqrt(noise),
        degrees=float(free if enough else 2 * found.degrees),
        steps=_comes_back(scores.rest, free, runs, seen.applied),
        unloaded=float(np.mean(seen.applied == 0.0)),
        zero_between=_between(scores, 0, noise, slice(None)) if enough else 0.0,
        gain_between=_between(scores, 1, noise, slice(0, 1)) / largest if enough else 0.0,
        drift=_drift(found, scores),
    )


def _shapes(w: Array) -> Array:
    """Return 1, w and sin(pi w), (n, 3): a loop closes at the largest load, where it turns."""
    return np.column_stack((np.ones_like(w), w, np.sin(np.pi * w)))


def _slope(shapes: Array) -> Array:
    """Return the slopes (3,) through 0 of shapes (n, 3) over their second, w."""
    w = shapes[:, 1]
    return np.asarray(w @ shapes / (w @ w), np.float64)


def _without_branches(
    residual: Array, rows: Array, shapes: Array, branches: list[Whole], direction: Array
) -> Array:
    """Return residuals (n, 2) less what the branches leave in all series alike, N.

    rows (n, p): the fit's, which has followed part of the branches.
    """
    basis = np.linalg.qr(rows)[0]
    common = np.zeros((len(branches) * shapes.shape[1], *residual.shape))
    for place, members in enumerate(branches):
        for power, shape in enumerate(shapes[members].T):
            common[place * shapes.shape[1] + power, members] = shape[:, None] * direction[members]
    left = (common - basis @ (basis.T @ common)).reshape(len(common), -1).T
    known = np.linalg.lstsq(left, residual.ravel(), rcond=1e-8)[0]
    return np.asarray(residual - (left @ known).reshape(residual.shape), np.float64)


def _comes_back(rest: Array, free: int, runs: Whole, load: Array) -> float:
    """Return the standard deviation of what readings at one load of one series share, N.

    Analysis of variance: between loads against within them; 0 where no load is taken twice.
    """
    key = np.column_stack((runs, np.round(1e3 * load).astype(np.int64)))
    number = np.unique(key, axis=0, return_inverse=True)[1].reshape(-1)
    count = np.bincount(number)
    inside, between = 2 * (len(load) - len(count)), free - 2 * (len(load) - len(count))
    if inside < 1 or between < 1:
        return 0.0
    means = np.column_stack([np.bincount(number, one) / count for one in rest.T])
    pure = float(np.sum((rest - means[number]) ** 2))
    shared = (float(np.sum(rest**2)) - pure) / between - pure / inside
    return math.sqrt(max(0.0, shared) / float(np.mean(count)))


def _branch_rows(seen: Loads) -> list[Whole]:
    """Return the rows of the rising and of the falling branch, those with loads enough."""
    sides = [np.flatnonzero(seen.rising), np.flatnonzero(~seen.rising)]
    return [
        rows for rows in sides if len(np.unique(np.round(seen.applied[rows], 3))) > FEWEST_LOADS
    ]


def _between(scores: SeriesScores, power: int, noise: float, axes: slice) -> float:
    """Return the standard deviation between series of a coefficient of w^power, beyond noise, N."""
    rows = scores.shape[:, power, :]
    found = np.einsum("jm,jma->ja", rows, scores.scores)[:, axes]
    own = noise * float(np.mean(np.sum(rows**2, axis=1)))
    return math.sqrt(max(0.0, float(np.mean(found**2)) - own))


def _drift(found: TwoAxisFit, scores: SeriesScores) -> float:
    """Return half the change of the zero of one component, beyond its noise, N."""
    if not found.terms.drift:
        return 0.0
    p = found.terms.count
    place = [p - 1, 2 * p - 1]
    change = found.coefficients[-1] @ found.matrix.T
    own = float(np.trace(scores.coefficients()[np.ix_(place, place)]))
    return math.sqrt(max(0.0, float(change @ change) - own) / 2.0) / 2.0


def _beyond(square: float, noise: float) -> float:
    """Return the factor by which a root shrinks when the noise's part of its square goes."""
    return math.sqrt(max(0.0, 1.0 - noise / square)) if square > 0.0 else 0.0
