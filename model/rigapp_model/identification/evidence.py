"""Likelihood of the bins of depth, with linear parameters marginalised in closed form.

Depth of bin i = (1 + e) D_i + b + a c(D_i) + noise_i. The sensitivity e, the reference b and the
modulus a are normal and common to all bins; the effect of the modulus is evaluated at the depth
predicted by the hypothesis, as at the measured one it would correlate with the noise. For the
noise see ``rigapp_model.identification.noise``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.noise import Noise

Array = NDArray[np.float64]

LN_TWO_PI = float(np.log(2.0 * np.pi))


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """Normal parameters of H hypotheses given the bins, for J kinds of noise.

    log_evidence (J, H): with the parameters integrated out; step (J, H, k): their mean relative to
    the point of linearisation; covariance (J, H, k, k); left (J, H, S): ``Noise.onward`` applied to
    the residual misfit; pulled (J, H, S, k): and to the slopes of each parameter.
    """

    log_evidence: Array
    step: Array
    covariance: Array
    left: Array
    pulled: Array


@dataclass(frozen=True, slots=True, eq=False)
class Linearised:
    """H hypotheses, linearised in k parameters with a normal prior.

    misfit (H, n): measured less predicted depth, m; columns (H, k, n): slopes; off (H, k): prior
    mean relative to the point of linearisation; precision (k, k): of the prior.
    """

    misfit: Array
    columns: Array
    off: Array
    precision: Array

    def along(self, noise: Noise) -> Array:
        """Return whitened slopes and misfit, (J, H, k + 1, n)."""
        rows = np.concatenate([self.columns, self.misfit[:, None]], axis=1)
        count, k, n = rows.shape
        return (rows.reshape(-1, n) @ noise.root).reshape(-1, count, k, n)

    def normal_equations(self, noise: Noise, along: Array) -> tuple[Array, Array, Array]:
        """Return matrix (J, H, k, k), right side (J, H, k), and squared misfit (J, H)."""
        k = self.columns.shape[1]
        product = along @ along.swapaxes(2, 3)
        pull = self.off @ self.precision
        square = product[:, :, k, k] + (pull * self.off).sum(axis=1)
        return product[:, :, :k, :k] + self.precision, product[:, :, :k, k] + pull, square


def best_step(noise: Noise, at: Linearised) -> Array:
    """Return the most probable parameters relative to the point of linearisation, (J, H, k)."""
    matrix, right, _ = at.normal_equations(noise, at.along(noise))
    return swept(matrix, right)[1]


def fitted(noise: Noise, at: Linearised) -> Fitted:
    """Marginalise the parameters in closed form."""
    k, n = at.columns.shape[1:]
    along = at.along(noise)
    matrix, right, square = at.normal_equations(noise, along)
    covariance, step, log_determinant = swept(matrix, right)
    log_evidence = -0.5 * (
        square
        - (right * step).sum(axis=2)
        + log_determinant
        - float(np.linalg.slogdet(at.precision)[1])
        + noise.log_determinant[:, None]
        + n * LN_TWO_PI
    )
    onward = (along @ noise.onward.swapaxes(1, 2)[:, None]).swapaxes(2, 3)
    pulled = onward[..., :k]
    left = onward[..., k] - (pulled @ step[..., None])[..., 0]
    return Fitted(np.asarray(log_evidence, dtype=np.float64), step, covariance, left, pulled)


def swept(matrix: Array, right: Array) -> tuple[Array, Array, Array]:
    """Return inverse, solution and log determinant of many small positive matrices.

    matrix (J, H, k, k), right (J, H, k). The sweep operator, column by column, is applied to all at
    once (J. H. Goodnight, Am. Stat. 33 (1979) 149-158), where LAPACK would be called for each.
    """
    k = matrix.shape[-1]
    tableau = np.ascontiguousarray(matrix.reshape(-1, k, k).transpose(1, 2, 0))
    log_determinant = np.zeros(tableau.shape[2])
    for i in range(k):
        pivot = tableau[i, i].copy()
        log_determinant += np.log(pivot)
        row = tableau[i] / pivot
        column = tableau[:, i].copy()
        tableau -= column[:, None] * row
        tableau[i], tableau[:, i] = row, -column / pivot
        tableau[i, i] = 1.0 / pivot
    inverse = tableau.transpose(2, 0, 1).reshape(matrix.shape)
    solution = (inverse @ right[..., None])[..., 0]
    return inverse, solution, log_determinant.reshape(matrix.shape[:-2])
