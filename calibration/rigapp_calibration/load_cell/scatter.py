"""Scatter of the readings of a calibration, separated so that nothing counts twice.

A residual consists of its branch (rising or falling: hysteresis and nonlinearity), of a part common
to its series (zero, gain, angle) and of noise, steps of the display included. The contribution of
noise to branch, zero and gain is subtracted.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import ACROSS, Array, Whole
from rigapp_calibration.load_cell.characteristics import Loads
from rigapp_calibration.load_cell.two_axis import Terms, TwoAxisFit, design, supported
from rigapp_calibration.load_cell.zeros import Zeros

FEWEST_LOADS = 3
"""Three shapes fit so few loads exactly; more are needed."""


@dataclass(frozen=True, slots=True, eq=False)
class Branches:
    """Deviations of the rising and the falling branch from the fit along the load.

    coefficients (b, 3), N, of 1, w and sin(pi w), w the load over the largest; covariance (b, 3, 3)
    by the noise; b is 2, or 1 of rising loads only. slope (3,): of the shapes at the rising loads.
    largest: load, N.
    """

    coefficients: Array
    covariance: Array
    slope: Array
    largest: float

    def points(self, load: float) -> tuple[float, ...]:
        """Return the deviations at a load, N, with the contribution of noise subtracted."""
        row = _shapes(np.array([min(load / self.largest, 1.0)]))[0]
        values = self.coefficients @ row
        noise = float(np.einsum("i,bij,j->", row, self.covariance, row))
        return tuple((_beyond(float(values @ values), noise) * values).tolist())

    def widest(self) -> float:
        """Return the largest hysteresis, N, noise subtracted; 0 without both branches."""
        if len(self.coefficients) < 2:
            return 0.0
        rows = _shapes(np.linspace(0.0, 1.0, 11))
        gap = rows @ (self.coefficients[1] - self.coefficients[0])
        noise = np.einsum("ni,ij,nj->n", rows, self.covariance.sum(axis=0), rows)
        return math.sqrt(max(0.0, float(np.max(gap**2 - noise))))

    def gain(self) -> float:
        """Return the difference of the rising branch's gain from the fit's, noise subtracted.

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
    average out, as steps of the display in means do.
    zero_between, gain_between: of series, beyond the noise. drift: half the change of the zero
    during the calibration, beyond the noise. zeros: of the unloaded readings. shown: the
    loads determine all terms of second degree; falling: loads were read from above as well, and
    are enough to show a loop.
    """

    found: TwoAxisFit
    zeros: Zeros
    scores: SeriesScores
    branches: Branches
    repeatability: float
    degrees: float
    steps: float
    zero_between: float
    gain_between: float
    drift: float
    shown: bool = True
    falling: bool = True

    @property
    def series(self) -> int:
        """Return the number of series."""
        return len(self.scores.scores)


def scatter(found: TwoAxisFit, force: Array, seen: Loads, zeros: Zeros, per_run: float) -> Scatter:
    """Split the residuals of a fit of loaded readings; force (n, 2) applied, N.

    per_run: number of zeros of a run.
    """
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
        zeros=zeros,
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
        zero_between=math.sqrt(max(0.0, zeros.scatter**2 - noise / per_run)),
        gain_between=_between(scores, 1, noise, slice(0, 1)) / largest if enough else 0.0,
        drift=zeros.drift,
        shown=supported(force, Terms(quadratic=True, own_zeros=True)),
        falling=bool(branches) and not seen.rising.all(),
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
    """Return residuals (n, 2) without the common part of the branches in all series, N.

    rows (n, p): the fit's, which has followed part of the branches.
    """
    if not branches:
        return residual
    basis = np.linalg.qr(rows)[0]
    common = np.zeros((len(branches) * shapes.shape[1], *residual.shape))
    for place, members in enumerate(branches):
        for power, shape in enumerate(shapes[members].T):
            common[place * shapes.shape[1] + power, members] = shape[:, None] * direction[members]
    left = (common - basis @ (basis.T @ common)).reshape(len(common), -1).T
    known = np.linalg.lstsq(left, residual.ravel(), rcond=1e-8)[0]
    return np.asarray(residual - (left @ known).reshape(residual.shape), np.float64)


def _comes_back(rest: Array, free: int, runs: Whole, load: Array) -> float:
    """Return the standard deviation common to readings at one load of one series, N.

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
    """Return the rows of the rising and of the falling branch, if they have loads enough."""
    sides = [np.flatnonzero(seen.rising), np.flatnonzero(~seen.rising)]
    return [
        rows for rows in sides if len(np.unique(np.round(seen.applied[rows], 3))) > FEWEST_LOADS
    ]


def _between(scores: SeriesScores, power: int, noise: float, axes: slice) -> float:
    """Return the standard deviation between series of a coefficient of w^power, beyond noise, N."""
    rows = scores.shape[:, power, :]
    means = np.einsum("jm,jma->ja", rows, scores.scores)[:, axes]
    own = noise * float(np.mean(np.sum(rows**2, axis=1)))
    return math.sqrt(max(0.0, float(np.mean(means**2)) - own))


def _beyond(square: float, noise: float) -> float:
    """Return the factor of a root after subtracting the noise's part of its square."""
    return math.sqrt(max(0.0, 1.0 - noise / square)) if square > 0.0 else 0.0


FULL_LEVERAGE = 1e-6
"""Part of a score that must be free, relative to the freest, to show an error; else the fit follows
it."""


@dataclass(frozen=True, slots=True, eq=False)
class SeriesScores:
    """Errors of p coefficients of two axes estimated from J series, by m scores each.

    scores (J, m, 2): of the residuals, along and across the load, leverage corrected. covariance
    (2 m, 2 m): of those of the errors. influence (J, 2 p, 2 m): of the scores on the coefficients,
    axis-major. spread (J 2 m, J 2 m): covariance of the residuals' scores that follows. shape
    (J, m, m): of the scores on the coefficients of the functions of the load, 1, w, w^2 ... of w,
    the load over the largest. rest (n, 2): what the scores leave of the residuals, with its degrees
    of freedom ``free``.
    """

    scores: Array
    covariance: Array
    influence: Array
    spread: Array
    shape: Array
    rest: Array
    free: int

    def coefficients(self) -> Array:
        """Return the covariance (2 p, 2 p) of the coefficients, axis-major."""
        return np.asarray(
            np.einsum("jus,st,jvt->uv", self.influence, self.covariance, self.influence), np.float64
        )

    def variance(self, combination: Array) -> tuple[float, float]:
        """Return the variance of a combination (2 p,) of coefficients, and its degrees of freedom.

        Degrees: 2 E^2 / Var of the variance, a quadratic form of the residuals' scores.
        """
        count = len(self.scores)
        weight = combination @ self.influence
        form = weight.T @ weight
        variance = max(0.0, float(np.sum(self.covariance * form)))  # -1e-18 by rounding
        size = len(form)
        shaped = self.spread.reshape(count, size, count, size) @ form
        expected = float(np.einsum("jsjs->", shaped))
        squared = float(np.einsum("jskt,ktjs->", shaped, shaped))
        return variance, expected**2 / squared if squared > 0.0 else 1.0


def series_scores(
    design: Array, residual: Array, load: Array, frame: Array, series: Whole, degree: int
) -> SeriesScores:
    """Return the scores of a fit of vectors (n, 2) by a common design (n, p).

    load (n,): along which errors of a series may grow, as polynomials of ``degree``. frame
    (n, 2, 2): columns along and across the load, the same within a series. Where a series has too
    few loads for these, every row counts as a series of its own.
    """
    powers = np.vander(load / max(float(np.abs(load).max()), 1e-300), degree + 1, increasing=True)
    members = [np.flatnonzero(series == one) for one in np.unique(series)]
    if any(np.linalg.matrix_rank(powers[rows], tol=1e-3) <= degree for rows in members):
        powers, members = powers[:, :1], [np.array([row]) for row in range(len(load))]
    bread = np.linalg.inv(design.T @ design)
    factors = [np.linalg.qr(powers[rows]) for rows in members]
    own = np.array([q.T @ design[rows] for (q, _), rows in zip(factors, members, strict=True)])
    turn = frame[[rows[0] for rows in members]]
    count, m, p = own.shape
    free = np.eye(count * m) - own.reshape(-1, p) @ bread @ own.reshape(-1, p).T
    blocks = free.reshape(count, m, count, m)
    raise_up = _power(blocks[np.arange(count), :, np.arange(count)], -0.5)
    projected = np.array(
        [q.T @ residual[rows] for (q, _), rows in zip(factors, members, strict=True)]
    )
    scores = raise_up @ projected @ turn
    made = np.einsum("jab,jbkc->jakc", raise_up, blocks).reshape(count * m, count * m)
    # Residuals' scores from errors' scores, both along and across the load of their series.
    made = np.einsum("jskt,jua,kub->jsaktb", made.reshape(count, m, count, m), turn, turn)
    made = made.reshape(count, 2 * m, count, 2 * m)
    influence = np.einsum("pq,jsq,jua->jupsa", bread, own, turn)
    flat = scores.reshape(count, 2 * m)
    covariance, spread = _set_right(flat.T @ flat / count, made)
    rest = residual.copy()
    for (q, _), rows, score in zip(factors, members, projected, strict=True):
        rest[rows] -= q @ score
    return SeriesScores(
        scores=scores,
        covariance=covariance,
        influence=influence.reshape(count, 2 * p, 2 * m),
        spread=spread,
        shape=np.array([np.linalg.inv(r) for _, r in factors]),
        rest=rest,
        free=2 * (len(load) - count * m),
    )


def _set_right(mean: Array, made: Array) -> tuple[Array, Array]:
    """Return the covariance (s, s) of one series' errors, and the resulting one of all scores.

    mean: mean square of the residuals' scores. made (J, s, J, s): how they follow from the errors'.
    """
    count, size = made.shape[:2]

    def follows(covariance: Array) -> Array:
        root = made @ _power(covariance, 0.5)
        flat = root.reshape(count * size, -1)
        return np.asarray(flat @ flat.T, np.float64)

    expected = np.einsum("jsjt->st", follows(mean).reshape(count, size, count, size)) / count
    raised = _power(mean, 0.5) @ _power(expected, -0.5)
    covariance = raised @ mean @ raised.T
    return covariance, follows(covariance)


def _power(matrix: Array, exponent: float) -> Array:
    """Return powers of symmetric matrices (..., s, s); a zero eigenvalue stays 0."""
    values, vectors = np.linalg.eigh(matrix)
    least = FULL_LEVERAGE * np.maximum(values[..., -1:], 0.0)
    powers = np.where(values > least, np.maximum(values, 1e-300) ** exponent, 0.0)
    return np.asarray(vectors * powers[..., None, :] @ np.swapaxes(vectors, -1, -2), np.float64)
