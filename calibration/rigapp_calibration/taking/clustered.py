"""The covariance of a linear fit of plane vectors whose errors belong together within series.

An error of a whole series (of its angle, of its zero, of a gain that is not the same at every
angle) is one error, however many readings the series has: not rows are independent, series are.
The residuals' scores are taken in the frame of each series' load, along and across, where all
series are alike; their covariance is the mean over the series, each corrected for its leverage
(CR2: Bell and McCaffrey, Survey Methodology 28, 2002), and so are its degrees of freedom, which are
Satterthwaite's for independent errors. Pooled in the frame of the load, few series tell enough.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array, Whole

FULL_LEVERAGE = 1e-6
"""Part of a score, of the freest, that must be free to tell an error; below, the fit follows it."""


@dataclass(frozen=True, slots=True, eq=False)
class SeriesScores:
    """What J series tell of the errors of p coefficients of two axes, by m scores each.

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
        found = float(np.sum(self.covariance * form))
        size = len(form)
        shaped = self.spread.reshape(count, size, count, size) @ form
        expected = float(np.einsum("jsjs->", shaped))
        squared = float(np.einsum("jskt,ktjs->", shaped, shaped))
        return found, expected**2 / squared if squared > 0.0 else 1.0


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
    found = np.array([q.T @ residual[rows] for (q, _), rows in zip(factors, members, strict=True)])
    scores = raise_up @ found @ turn
    made = np.einsum("jab,jbkc->jakc", raise_up, blocks).reshape(count * m, count * m)
    # Scores of residuals from scores of errors, both along and across the load of their series.
    made = np.einsum("jskt,jua,kub->jsaktb", made.reshape(count, m, count, m), turn, turn)
    made = made.reshape(count, 2 * m, count, 2 * m)
    influence = np.einsum("pq,jsq,jua->jupsa", bread, own, turn)
    flat = scores.reshape(count, 2 * m)
    covariance, spread = _set_right(flat.T @ flat / count, made)
    rest = residual.copy()
    for (q, _), rows, score in zip(factors, members, found, strict=True):
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
    """Return the covariance (s, s) of one series' errors, and that of all scores that follows.

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
    """Return powers of symmetric matrices (..., s, s); of what is 0, 0."""
    values, vectors = np.linalg.eigh(matrix)
    least = FULL_LEVERAGE * np.maximum(values[..., -1:], 0.0)
    powers = np.where(values > least, np.maximum(values, 1e-300) ** exponent, 0.0)
    return np.asarray(vectors * powers[..., None, :] @ np.swapaxes(vectors, -1, -2), np.float64)
