"""The correlation of the readings' noise, from their spread within bins.

A bin has two sums of squares of its groups of readings: about a straight line, and of steps from
group to group. White noise has the same variance in both; correlated noise has little variance in
the steps and, in a bin longer than its correlation, all of it about the line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import gammaln

from rigapp_model.identification.bins import GROUP, Bin
from rigapp_model.identification.errors import ProbeErrors

Array = NDArray[np.float64]

EXPECTED_FREEDOM = 4.0
"""Weight of the scatter stated by the record, in groups of readings."""
LENGTHS = 4.0 ** np.arange(1, 9)
"""Correlation lengths (decay by a factor of e), revolutions: from 4 to 65,536."""
SIZES = 2.0 ** np.arange(-1.0, 5.0)
"""Standard deviations of the correlated noise, in units of the spread of groups of readings."""
WHITE_SHARE = 0.5
"""Prior probability that there is no correlated noise."""
COUNTS = 5.0
"""Log of the ratio to the most probable colour, by the spread within bins, up to which others are
used."""
WILD_SHARE, WILD_RANGE = 0.01, 10.0
"""Fraction of bins with an unrelated spread, and the log of the range of that."""
HIDDEN = 0.25
"""Width of a bin, as a fraction of a swing's period, from which the swing adds to its spread."""
LEAST_WHITE = 1e-3
"""Least fraction of white noise in the variance of steps."""
GROUPS = np.unique(np.geomspace(3, 640, 14).astype(int))
"""Numbers of groups per bin in the table; interpolated between them."""
TWO_THIRDS = 2.0 / 3.0
"""Degrees of freedom per step between white groups (J. von Neumann, 1941)."""


@dataclass(frozen=True, slots=True, eq=False)
class ScatterWithin:
    """Spread of groups of readings in n bins with at least three groups.

    groups (n,): per bin; squares (n,): about their line, m^2 per group; wide (n,): revolutions per
    bin; step: variance of a group from steps, m^2; freedom: degrees of freedom of step; known:
    whether steps were recorded.
    """

    groups: Array
    squares: Array
    wide: Array
    step: float
    freedom: float
    known: bool


def spread_of(bins: Sequence[Bin], errors: ProbeErrors) -> ScatterWithin:
    """Return the spread within bins."""
    rows = np.array([(b.freedom + 2.0, b.squares, b.steps, b.count) for b in bins if b.freedom > 0])
    groups, squares, steps, wide = rows.reshape(-1, 4).T
    known = np.isfinite(steps)
    count = TWO_THIRDS * float((groups[known] - 1.0).sum())
    stated = EXPECTED_FREEDOM * errors.scatter**2 / GROUP
    step = stated + TWO_THIRDS * float(steps[known].sum()) / (2.0 * GROUP)
    freedom = EXPECTED_FREEDOM + count
    return ScatterWithin(groups, squares / GROUP, wide, step / freedom, freedom, bool(known.any()))


@dataclass(frozen=True, slots=True, eq=False)
class Colours:
    """C kinds of noise, (C,) each.

    scatter: of the white part of a reading, m; size, m, and length, revolutions: of the correlated
    part; log_weight (C, P): from the spread within bins, in combination with swings of P periods.
    """

    scatter: Array
    size: Array
    length: Array
    log_weight: Array


@cache
def _tables() -> tuple[Array, Array]:
    """Return the effect of correlated noise of unit size on squares about a line, (L, G) each.

    Their mean, and half their variance.
    """
    mean, half = (np.empty((LENGTHS.size, GROUPS.size)) for _ in range(2))
    for i, length in enumerate(LENGTHS):
        variance, next_covariance, decay = _group_moments(length)
        for k, count in enumerate(GROUPS):
            lag = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
            c = np.where(lag == 0, variance, next_covariance * decay ** np.maximum(lag - 1.0, 0.0))
            line = np.linalg.qr(np.stack([np.ones(count), np.arange(count) - 0.5 * count], axis=1))[
                0
            ]
            projected = c @ line
            inner = line.T @ projected
            mean[i, k] = np.trace(c) - np.trace(inner)
            half[i, k] = (c**2).sum() - 2.0 * (projected**2).sum() + (inner**2).sum()
    return mean, half


def _group_moments(length: float) -> tuple[float, float, float]:
    """Return variance of a group's mean, covariance with the next, and its decay per group."""
    wide = GROUP / length
    share = -np.expm1(-wide) / wide
    return 2.0 / wide * (1.0 - share), share**2, float(np.exp(-wide))


def colours_of(spread: ScatterWithin, period: Array) -> Colours:
    """Return the kinds of noise compatible with the spread within bins, white noise first.

    period (P,): of simultaneous swings, revolutions, 0 for none.
    """
    white = np.array([[0.0, LENGTHS[0]]])
    unit = float(np.sqrt(max(spread.step, spread.squares.sum() / max(spread.groups.sum(), 1.0))))
    grid = np.stack(np.meshgrid(unit * SIZES, LENGTHS, indexing="ij"), axis=-1).reshape(-1, 2)
    size, length = np.concatenate([white, grid]).T
    order = np.log2(length).round().astype(int) // 2 - 1
    groups = np.array([_group_moments(bins) for bins in LENGTHS])[order]
    step = size**2 * (groups[:, 0] - groups[:, 1])
    mean, half = (
        np.stack([np.interp(spread.groups, GROUPS, row) for row in table])[order]
        for table in _tables()
    )
    freedom = spread.groups - 2.0
    if spread.known or not spread.groups.size:
        white_variance = spread.step - step
    else:
        white_variance = (spread.squares.sum() - size**2 * mean.sum(axis=1)) / freedom.sum()
    level = np.maximum(white_variance, LEAST_WHITE * spread.step)
    expected = level[:, None] * freedom + size[:, None] ** 2 * mean
    variance = (
        level[:, None] ** 2 * freedom
        + 2.0 * level[:, None] * size[:, None] ** 2 * mean
        + size[:, None] ** 4 * half
    )
    log_likelihood = _log_gamma(spread.squares, expected, 2.0 * variance)
    # With a step or a swing within a bin its squares are arbitrary: uniform in the logarithm.
    wild = -np.log(np.maximum(spread.squares, 1e-6 * unit**2)) - np.log(WILD_RANGE)
    log_likelihood = np.logaddexp(log_likelihood + np.log1p(-WILD_SHARE), wild + np.log(WILD_SHARE))
    hidden = spread.wide > HIDDEN * np.where(period > 0.0, period, np.inf)[:, None]
    log_weight = log_likelihood @ ~hidden.T + (hidden @ wild)
    total = level + step
    log_weight += _log_gamma(
        np.full(1, spread.step), total[:, None], 2.0 * total[:, None] ** 2 / spread.freedom
    )
    log_weight -= np.log(grid.shape[0] / (1.0 - WHITE_SHARE))
    log_weight[0] += np.log(grid.shape[0] / (1.0 - WHITE_SHARE) * WHITE_SHARE)
    counts = (log_weight > log_weight.max(axis=0) - COUNTS).any(axis=1)
    counts[0] = True
    return Colours(np.sqrt(GROUP * level[counts]), size[counts], length[counts], log_weight[counts])


def _log_gamma(value: Array, mean: Array, variance: Array) -> Array:
    """Return the log density of a gamma distribution with this mean and variance."""
    shape, unit = mean**2 / variance, variance / mean
    value = np.maximum(value, 1e-6 * mean)
    return np.asarray(
        (shape - 1.0) * np.log(value) - value / unit - shape * np.log(unit) - gammaln(shape)
    )


def covariance(size: Array, length: Array, begin: Array, end: Array) -> Array:
    """Return the covariance (C, n, n), m^2, of means over bins due to correlated noise.

    size, length (C,): of the noise, m and revolutions; begin, end (n,): of the bins, revolutions.
    """
    length = length[:, None]
    wide = (end - begin) / length
    share = -np.expm1(-wide) / wide
    gap = np.maximum(np.maximum(begin[:, None] - end, begin - end[:, None]), 0.0)
    both = share[:, :, None] * share[:, None, :] * np.exp(-gap / length[:, :, None])
    own = np.arange(begin.size)
    both[:, own, own] = 2.0 / wide * (1.0 - share)
    return np.asarray(size[:, None, None] ** 2 * both)
