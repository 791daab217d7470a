"""The two-axis fit: signal = A force + quadratic terms + zero + drift, solved forward, inverted.

The errors are in the signals, so signals are fitted from forces and the result is inverted
(calibration by a forward model). Rows of the design are common to both axes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy import special

from rigapp.texts import say
from rigapp_calibration.arrays import Array

HUBER = 2.0
"""Residuals of more standard deviations of an axis lose weight: of good readings one in seven
(Rayleigh distribution), which costs little of their precision."""
LEAST_SHOWN = 0.08
"""Of the largest force: root mean square of f1 f2: 0.2 for eight even angles and five loads,
0.02 for four within two degrees of the axes."""
ITERATIONS = 30
"""The weights converge in about ten; more only if the readings contradict each other."""


@dataclass(frozen=True, slots=True)
class Terms:
    """Terms of the forward model besides A and the zero.

    own_zeros: without the zero, since each series' own was subtracted.
    """

    quadratic: bool = False
    drift: bool = False
    own_zeros: bool = False

    @property
    def count(self) -> int:
        """Return the coefficients per axis."""
        return 3 - self.own_zeros + 3 * self.quadratic + self.drift


@dataclass(frozen=True, slots=True)
class TwoAxisFit:
    """Result of a fit: coefficients (terms, 2), residuals.

    sensitivity: A (2, 2) signal per newton. matrix: its inverse, N per signal unit. zero: (2,)
    signal at no load, at the middle of the series. residual: (n, 2) in N. degrees: of freedom per
    axis. covariance (2 p, 2 p): of the coefficients, axis-major, as if all readings were
    independent (``scatter`` corrects this). rest: the zero, where the fit has none.
    """

    terms: Terms
    coefficients: Array
    covariance: Array
    residual: Array
    residual_signal: Array
    degrees: int
    rest: Array | None = None

    @property
    def sensitivity(self) -> Array:
        """Return A (2, 2): signal = A force."""
        return self.coefficients[:2].T.copy()

    @property
    def matrix(self) -> Array:
        """Return the matrix (2, 2): force = matrix (signal - zero), the linear part."""
        return np.asarray(np.linalg.inv(self.sensitivity), dtype=np.float64)

    @property
    def zero(self) -> Array:
        """Return the signals (2,) at no load."""
        return (self.coefficients[2] if self.rest is None else self.rest).copy()

    @property
    def quadratic(self) -> Array | None:
        """Return the coefficients (2, 3) of f1^2, f1 f2, f2^2, or None."""
        first = 3 - self.terms.own_zeros
        return self.coefficients[first : first + 3].T.copy() if self.terms.quadratic else None

    @property
    def residual_std(self) -> float:
        """Return the standard deviation of the residuals per axis, N."""
        return float(np.sqrt(np.sum(self.residual**2) / (2 * self.degrees)))

    def force(self, signal: Array) -> Array:
        """Return the forces (n, 2) of signals (n, 2); quadratic terms by Newton steps."""
        return forces(signal, self.matrix, self.zero, self.quadratic)


def forces(signal: Array, matrix: Array, zero: Array, quadratic: Array | None = None) -> Array:
    """Return the forces (n, 2) of signals (n, 2); quadratic terms (2, 3) by Newton steps.

    matrix: inverse of A. The forward model is signal = A f + quadratic (f1^2, f1 f2, f2^2) + zero.
    """
    reading = np.atleast_2d(signal) - zero
    force = np.asarray(reading @ matrix.T, dtype=np.float64)
    if quadratic is None:
        return force
    sensitivity = np.linalg.inv(matrix)
    for _ in range(8):
        x, y = force.T
        predicted = force @ sensitivity.T + squares(force) @ quadratic.T
        d1 = quadratic[:, 0, None] * 2 * x + quadratic[:, 1, None] * y
        d2 = quadratic[:, 1, None] * x + quadratic[:, 2, None] * 2 * y
        slope = sensitivity[None] + np.stack((d1.T, d2.T), axis=-1)
        force = force + np.linalg.solve(slope, (reading - predicted)[..., None])[..., 0]
    return force


def design(force: Array, terms: Terms) -> Array:
    """Return the design matrix (n, terms) of forces (n, 2) in the order taken."""
    columns = [force] if terms.own_zeros else [force, np.ones((len(force), 1))]
    if terms.quadratic:
        columns.append(squares(force))
    if terms.drift:
        columns.append(np.linspace(-0.5, 0.5, len(force))[:, None])
    return np.hstack(columns)


def fit(force: Array, signal: Array, terms: Terms, weights: Array | None = None) -> TwoAxisFit:
    """Fit signals (n, 2) from forces (n, 2) by (weighted) least squares.

    Raises numpy.linalg.LinAlgError when the forces do not span both axes.
    """
    rows = design(force, terms)
    scale = np.maximum(np.abs(rows).max(axis=0), 1e-300)
    root = np.ones(len(rows)) if weights is None else np.sqrt(weights)
    scaled = rows / scale * root[:, None]
    if np.linalg.matrix_rank(scaled, tol=1e-6 * math.sqrt(len(rows))) < terms.count:
        raise np.linalg.LinAlgError(say("the loads do not span both axes"))
    solution = np.linalg.lstsq(scaled, signal * root[:, None], rcond=None)[0]
    coefficients = solution / scale[:, None]
    remainder = signal - rows @ coefficients
    matrix = np.linalg.inv(coefficients[:2].T)
    degrees = len(rows) - terms.count
    weighted = remainder * root[:, None]
    bread = np.linalg.pinv(scaled.T @ scaled) / np.outer(scale, scale)
    return TwoAxisFit(
        terms=terms,
        coefficients=coefficients,
        covariance=np.kron(weighted.T @ weighted / degrees, bread),
        residual=remainder @ matrix.T,
        residual_signal=remainder,
        degrees=degrees,
    )


def robust_fit(force: Array, signal: Array, floor: float) -> tuple[TwoAxisFit, float]:
    """Fit robustly against single wrong readings; return the fit and the noise in N.

    ``floor`` (N): lower bound of the noise (resolution / sqrt(12)). Quadratic terms are
    used where the loads determine them: a cross term of a good cell is no wrong weight.
    """
    curved = Terms(quadratic=True)
    terms = curved if supported(force, curved) else Terms()
    found, scale = huber_fit(force, signal, floor, terms)
    return found, max(floor, scale)


def huber_fit(force: Array, signal: Array, floor: float, terms: Terms) -> tuple[TwoAxisFit, float]:
    """Fit with Huber weights on the residual's length; return the fit and its scale, N.

    ``floor``: lower bound of the scale for the weights, N.
    """
    rows = design(force, terms)
    found = fit(force, signal, terms)
    scale, length = 0.0, np.hypot(*found.residual.T)
    weights = np.ones(len(force))
    for _ in range(ITERATIONS):
        scale = float(np.median(length)) / 1.1774
        noise = max(floor, scale)
        before = weights
        weights = np.minimum(1.0, HUBER * noise / np.maximum(length, 1e-300)) ** 2
        weights = np.maximum(weights, 1e-6)
        if np.abs(weights - before).max() < 1e-4:
            break
        root = np.sqrt(weights)[:, None]
        size = np.maximum(np.abs(rows).max(axis=0), 1e-300)
        solution = np.linalg.lstsq(rows / size * root, signal * root, rcond=None)[0]
        coefficients = solution / size[:, None]
        remainder = signal - rows @ coefficients
        length = np.hypot(*(remainder @ np.linalg.inv(coefficients[:2].T).T).T)
    found = fit(force, signal, terms, weights)
    return found, scale


def choose_terms(force: Array, signal: Array, rest: Array) -> tuple[TwoAxisFit, str]:
    """Return the fit of loaded readings with the justified terms, and the reason in words.

    signal (n, 2): less the own zeros of each series; rest (2,): the signals at no load. Quadratic
    terms are added when they lower the corrected Akaike criterion by more than 10 and an F test
    rejects the smaller model at 97.5 % (the level of ASTM E74, annex A1). Never above degree 2: a
    cell of 200 counts cannot support it.
    """
    chosen = replace(fit(force, signal, Terms(own_zeros=True)), rest=rest)
    words = say("degree 1, zeros by series")
    curved = Terms(quadratic=True, own_zeros=True)
    if supported(force, curved):
        larger = replace(fit(force, signal, curved), rest=rest)
        gain = better_by(chosen, larger)
        if gain > 0.0:
            words = say(
                "{}, quadratic terms (corrected Akaike criterion lower by {:.0f})", words, gain
            )
            return larger, words
    return chosen, words


def better_by(smaller: TwoAxisFit, larger: TwoAxisFit) -> float:
    """Return by how much a larger model lowers Akaike's criterion, 0 if it is not justified."""
    gain = _akaike(smaller) - _akaike(larger)
    return gain if gain > 10.0 and _f_test(smaller, larger) > 0.975 else 0.0


def enough(force: Array, terms: Terms) -> bool:
    """Return whether there are enough readings for the terms."""
    return len(force) > 2 * terms.count + 4


def supported(force: Array, terms: Terms) -> bool:
    """Return whether there are enough readings for the terms, and they determine them.

    Each combination of the terms, in parts of the largest force, needs a minimum root mean
    square: angles set by hand near the axes show f1 f2 by a few hundredths.
    """
    loaded = force[np.hypot(*force.T) > 0.0]
    if not enough(force, terms) or not len(loaded):
        return False
    rows = design(loaded / np.hypot(*loaded.T).max(), terms)
    sizes = np.linalg.svd(rows / math.sqrt(len(rows)), compute_uv=False)
    return bool(sizes[-1] > LEAST_SHOWN)


def cubes(force: Array) -> Array:
    """Return the terms (n, 4) of third degree of forces (n, 2)."""
    x, y = force.T
    return np.column_stack((x**3, x * x * y, x * y * y, y**3))


def squares(force: Array) -> Array:
    """Return the terms (n, 3) of second degree of forces (n, 2)."""
    x, y = force.T
    return np.column_stack((x * x, x * y, y * y))


def _akaike(found: TwoAxisFit) -> float:
    n = 2 * len(found.residual)
    k = 2 * found.terms.count + 1
    mean_square = max(float(np.mean(found.residual**2)), 1e-12)
    return n * math.log(mean_square) + 2 * k + 2 * k * (k + 1) / max(n - k - 1, 1)


def _f_test(smaller: TwoAxisFit, larger: TwoAxisFit) -> float:
    more = 2 * (larger.terms.count - smaller.terms.count)
    rest = 2 * larger.degrees
    reduced = float(np.sum(smaller.residual**2))
    full = max(float(np.sum(larger.residual**2)), 1e-12)
    ratio = max(reduced - full, 0.0) / more / (full / rest)
    return float(special.fdtr(more, rest, ratio))


# Fit of the records of evaluations 1 and 2: one zero for all series, and its drift.
#
# Kept so that these records can be verified; not used for new fits.


def common_zero_fit(force: Array, signal: Array, drift: bool | None = None) -> TwoAxisFit:
    """Return the fit with the justified terms; drift: None lets the readings decide."""
    if drift is None:
        drift = _supported(force, Terms(drift=True))
    chosen = fit(force, signal, Terms(drift=drift))
    curved = Terms(quadratic=True, drift=drift)
    if _supported(force, curved):
        larger = fit(force, signal, curved)
        if better_by(chosen, larger) > 0.0:
            return larger
    return chosen


def _supported(force: Array, terms: Terms) -> bool:
    rows = design(force, terms)
    size = float(np.max(np.abs(force)))
    if terms.quadratic and np.max(np.abs(rows[:, 4])) < 0.02 * size * size:
        return False
    scaled = rows / np.maximum(np.abs(rows).max(axis=0), 1e-300)
    return enough(force, terms) and bool(np.linalg.cond(scaled) < 1e4)
