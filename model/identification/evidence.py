"""The likelihood of bins of depth: what is linear in them is marginalised in closed form.

Depth of bin i = (1 + e) D_i + b + w_i + r_i. The sensitivity e and the reference b are normal and
common to all bins; w is a random walk in the logarithm of revolutions; r is the scatter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from model.identification.bins import Bin
from model.identification.errors import CannotBeTold, ProbeErrors

Array = NDArray[np.float64]

EXPECTED_FREEDOM = 4.0
"""The scatter that the record states counts as much as so many groups of readings."""
LEAST_BINS = 4
"""Fewer cannot tell the reference, the sensitivity and the coefficient apart from their scatter."""
LN_TWO_PI = float(np.log(2.0 * np.pi))


@dataclass(frozen=True, slots=True, eq=False)
class DepthBins:
    """Hold the bins as arrays (n,): depth (m), progress, half its width, revolution, noise.

    noise: standard uncertainty of each bin's mean by its scatter, m; scatter: of one reading, m.
    """

    depth: Array
    progress: Array
    half: Array
    revolution: Array
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
    return DepthBins(
        depth, progress, 0.5 * (last - first), revolution, scatter / np.sqrt(count), scatter
    )


@dataclass(frozen=True, slots=True, eq=False)
class Noise:
    """Hold scatter and drift of the bins for one strength of the drift, m per root of ln n.

    precision (n, n): inverse of their covariance; log_determinant: of that covariance;
    onward (n,): weights of what is left of the bins in the drift of the last one; spare: variance
    of that drift which the bins leave, m^2.
    """

    strength: float
    precision: Array
    log_determinant: float
    onward: Array
    spare: float


def noise_of(readings: DepthBins, strength: float) -> Noise:
    """Return scatter and drift of the bins."""
    walked = np.log(np.maximum(readings.revolution, 1.0))
    walk = strength**2 * np.minimum(walked[:, None], walked[None, :])
    factor = cho_factor(walk + np.diag(readings.noise**2), lower=True)
    precision = cho_solve(factor, np.eye(walked.size))
    onward = precision @ walk[-1]
    return Noise(
        strength,
        0.5 * (precision + precision.T),
        2.0 * float(np.log(np.diag(factor[0])).sum()),
        onward,
        float(walk[-1, -1] - walk[-1] @ onward),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """Hold normal parameters of H hypotheses given the bins.

    log_evidence (H,): with all of them integrated out; step (H, k): their mean less where they
    were linearised; covariance (H, k, k); left (H,): what ``Noise.onward`` makes of the remaining
    misfit, m; pulled (H, k): and of each parameter.
    """

    log_evidence: Array
    step: Array
    covariance: Array
    left: Array
    pulled: Array


def fitted(noise: Noise, misfit: Array, columns: Array, off: Array, precision: Array) -> Fitted:
    """Integrate normal parameters out, in closed form.

    misfit (H, n): depth less what the hypotheses say where they are linearised, m; columns
    (H, k, n): their slopes; off (H, k): the prior's mean less that place; precision (k, k): the
    prior's.
    """
    weighted = columns @ noise.precision
    matrix = weighted @ columns.swapaxes(1, 2) + precision
    pull = off @ precision
    right = (weighted @ misfit[:, :, None])[:, :, 0] + pull
    covariance = np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    step = (covariance @ right[:, :, None])[:, :, 0]
    square = ((misfit @ noise.precision) * misfit).sum(axis=1) + (pull * off).sum(axis=1)
    log_evidence = -0.5 * (
        square
        - (right * step).sum(axis=1)
        + np.linalg.slogdet(matrix)[1]
        - float(np.linalg.slogdet(precision)[1])
        + noise.log_determinant
        + misfit.shape[1] * LN_TWO_PI
    )
    pulled = columns @ noise.onward
    left = misfit @ noise.onward - (pulled * step).sum(axis=1)
    return Fitted(np.asarray(log_evidence, dtype=np.float64), step, covariance, left, pulled)
