"""The likelihood of bins of depth: what is linear in them is marginalised in closed form.

Depth of bin i = (1 + e) D_i + b + a c_i + w_i + r_i. The sensitivity e, the reference b and the
modulus a are normal and common to all bins; w is a random walk in the logarithm of revolutions; r
is the scatter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.bins import Bin
from rigapp_model.identification.errors import CannotBeTold, ProbeErrors

Array = NDArray[np.float64]

EXPECTED_FREEDOM = 4.0
"""The scatter that the record states counts as much as so many groups of readings."""
LEAST_BINS = 4
"""Fewer cannot tell the reference, the sensitivity and the coefficient apart from their scatter."""
LN_TWO_PI = float(np.log(2.0 * np.pi))


@dataclass(frozen=True, slots=True, eq=False)
class DepthBins:
    """Hold the bins as arrays (n,): depth (m), progress, half its width, last revolution, noise.

    middle: revolution in the middle of the bin; walked, alone (n,): mean of ln n over it, and that
    of the smaller of two ln n; noise: standard uncertainty of each bin's mean by its scatter, m;
    scatter: of one reading, m.
    """

    depth: Array
    progress: Array
    half: Array
    revolution: Array
    middle: Array
    walked: Array
    alone: Array
    noise: Array
    scatter: float


def readings_of(bins: Sequence[Bin], errors: ProbeErrors) -> DepthBins:
    """Return the bins as arrays; raise CannotBeTold where they are too few."""
    if len(bins) < LEAST_BINS:
        raise CannotBeTold(
            f"the depth is known in {len(bins)} bins of revolutions so far, and {LEAST_BINS} are"
            " needed: wait"
        )
    rows = np.array(
        [(b.depth, b.progress, b.first, b.last, b.revolution, b.count, b.squares) for b in bins]
    )
    depth, progress, first, last, revolution, count, squares = rows.T
    freedom = EXPECTED_FREEDOM + sum(b.freedom for b in bins)
    scatter = float(np.sqrt((EXPECTED_FREEDOM * errors.scatter**2 + squares.sum()) / freedom))
    # Bins hold progress, which is as even within one as revolutions are.
    turn = revolution / np.maximum(last, 1e-300)
    walked, alone = _mean_logarithms(np.maximum(first * turn, 1.0), revolution)
    return DepthBins(
        depth,
        progress,
        0.5 * (last - first),
        revolution,
        progress * turn,
        walked,
        alone,
        scatter / np.sqrt(count),
        scatter,
    )


STRENGTHS = (1.0, 1.6, 2.5, 4.0, 6.3)
"""Strengths of the drift compared, in units of the record's lower bound: five to the decade."""
STRENGTH_DECAY = 2.0
"""Each next strength is less probable beforehand by exp of this: the record is believed."""
LEAST_DRIFT = 1e-9
"""A record without drift counts as one of so little, m: the table of strengths needs a unit."""


def _mean_logarithms(low: Array, high: Array) -> tuple[Array, Array]:
    """Return the means of ln u and of the smaller of two ln u, u evenly between low and high.

    What a random walk in ln n does to the mean of a bin: its covariance with what comes later, and
    its variance, which is less than that of any moment in the bin.
    """
    wide = np.maximum(high - low, 1e-6 * high)
    first, last = np.log(low), np.log(low + wide)
    high = low + wide
    mean = (high * last - low * first) / wide - 1.0
    once = high * last - low * first - wide  # of ln u
    by_u = 0.5 * (high**2 * last - low**2 * first) - 0.25 * (high**2 - low**2)  # of u ln u
    return mean, 2.0 * (high * once - by_u) / wide**2


@dataclass(frozen=True, slots=True, eq=False)
class Noise:
    """Hold scatter, modulus and drift of the bins for J strengths of the drift, m per root of ln n.

    They are independent along the same n directions, whatever the strength is.
    strength (J,); log_prior (J,): of each; basis (n, n): of the directions, in which scatter and
    modulus together are 1; share (J, n): precision along each; log_determinant (J,): of the
    covariance; onward (J, n): weights, along each direction, of what is left of the bins in drift
    and error by the modulus of the last one, which are called its drift from there on; spare (J,):
    variance of it that the bins leave, m^2.
    """

    strength: Array
    log_prior: Array
    basis: Array
    share: Array
    log_determinant: Array
    onward: Array
    spare: Array

    def at(self, index: NDArray[np.int64]) -> Noise:
        """Return the noise of some strengths only."""
        return Noise(
            self.strength[index],
            self.log_prior[index],
            self.basis,
            self.share[index],
            self.log_determinant[index],
            self.onward[index],
            self.spare[index],
        )


def noise_of(readings: DepthBins, drift: float, elastic: Array) -> Noise:
    """Return scatter, modulus and drift of the bins.

    drift: lower bound of its strength; elastic (n,): standard uncertainty of each bin by the
    modulus, m, which is small against the depth, so that the measured depth tells it.
    """
    strength = max(drift, LEAST_DRIFT) * np.array(STRENGTHS)
    log_prior = -STRENGTH_DECAY * np.arange(strength.size)
    walked = readings.walked
    walk = np.minimum(walked[:, None], walked)
    np.fill_diagonal(walk, readings.alone)
    ratio = elastic / readings.noise
    square = float(ratio @ ratio)
    # The root of (1 + ratio ratio^T)^-1, which makes scatter and modulus together 1.
    shrink = (1.0 / np.sqrt(1.0 + square) - 1.0) / max(square, 1e-300)
    whitened = (np.eye(ratio.size) + shrink * np.outer(ratio, ratio)) / readings.noise
    size, direction = np.linalg.eigh(whitened @ walk @ whitened.T)
    basis = whitened.T @ direction
    spread = 1.0 + strength[:, None] ** 2 * np.maximum(size, 0.0)
    last = strength[:, None] ** 2 * (walked @ basis) + elastic[-1] * (elastic @ basis)
    onward = last / spread
    return Noise(
        strength,
        log_prior - np.logaddexp.reduce(log_prior),
        basis,
        1.0 / spread,
        np.log(spread).sum(axis=1)
        + 2.0 * float(np.log(readings.noise).sum())
        + float(np.log1p(square)),
        onward,
        strength**2 * walked[-1] + elastic[-1] ** 2 - (last * onward).sum(axis=1),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """Hold normal parameters of H hypotheses given the bins, for J strengths of the drift.

    log_evidence (J, H): with all of them integrated out; step (J, H, k): their mean less where
    they were linearised; covariance (J, H, k, k); left (J, H): what ``Noise.onward`` makes of the
    remaining misfit, m; pulled (J, H, k): and of each parameter.
    """

    log_evidence: Array
    step: Array
    covariance: Array
    left: Array
    pulled: Array


@dataclass(frozen=True, slots=True, eq=False)
class Linearised:
    """Hold H hypotheses where they are linearised in k parameters, whose prior is normal.

    misfit (H, n): depth less what they say, m; columns (H, k, n): their slopes; off (H, k): the
    prior's mean less that place; precision (k, k): the prior's.
    """

    misfit: Array
    columns: Array
    off: Array
    precision: Array

    def along(self, noise: Noise) -> Array:
        """Return slopes and misfit, (H, k + 1, n), along the noise's directions."""
        return np.concatenate([self.columns, self.misfit[:, None]], axis=1) @ noise.basis

    def normal_equations(self, noise: Noise, along: Array) -> tuple[Array, Array, Array]:
        """Return matrix (J, H, k, k), right side (J, H, k), and square of the misfit (J, H)."""
        k = self.columns.shape[1]
        product = (along * noise.share[:, None, None]) @ along.swapaxes(1, 2)
        pull = self.off @ self.precision
        square = product[:, :, k, k] + (pull * self.off).sum(axis=1)
        return product[:, :, :k, :k] + self.precision, product[:, :, :k, k] + pull, square


def best_step(noise: Noise, at: Linearised) -> Array:
    """Return the most probable parameters less where they are linearised, (J, H, k)."""
    matrix, right, _ = at.normal_equations(noise, at.along(noise))
    return np.asarray(np.linalg.solve(matrix, right[..., None])[..., 0], dtype=np.float64)


def fitted(noise: Noise, at: Linearised) -> Fitted:
    """Integrate the parameters out, in closed form."""
    count, k, n = at.columns.shape
    along = at.along(noise)
    matrix, right, square = at.normal_equations(noise, along)
    covariance = np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    step = (covariance @ right[..., None])[..., 0]
    log_evidence = -0.5 * (
        square
        - (right * step).sum(axis=2)
        + np.linalg.slogdet(matrix)[1]
        - float(np.linalg.slogdet(at.precision)[1])
        + noise.log_determinant[:, None]
        + n * LN_TWO_PI
    )
    onward = (along.reshape(-1, n) @ noise.onward.T).T.reshape(-1, count, k + 1)
    pulled = onward[:, :, :k]
    left = onward[:, :, k] - (pulled * step).sum(axis=2)
    return Fitted(np.asarray(log_evidence, dtype=np.float64), step, covariance, left, pulled)
