"""The correlation of the readings' noise, from their spread within bins.

A bin holds two sums of squares of its groups of readings: about a straight line, and of steps from
group to group. White noise has the same variance in both; correlated noise has little in the steps
and, in a bin that is longer than its correlation, all of it in the former.
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
"""Revolutions in which the correlation falls by e: from 4 to 65,536."""
SIZES = 2.0 ** np.arange(-1.0, 5.0)
"""Sizes of the correlated noise, in units of the spread of groups of readings."""
WHITE_SHARE = 0.5
"""Probability beforehand that there is no correlated noise at all."""
COUNTS = 5.0
"""Colours less probable than the best by exp of this, by the spread within bins, are left out."""
WILD_SHARE, WILD_RANGE = 0.01, 10.0
"""One bin in a hundred has a spread of its own, which may be anything within exp of the second."""
HIDDEN = 0.25
"""A swing is seen in the spread within bins that are wider than this part of its period."""
LEAST_WHITE = 1e-3
"""White noise has this share of the variance of steps at least."""
GROUPS = np.unique(np.geomspace(3, 640, 14).astype(int))
"""Numbers of groups in a bin for which a table is made; between them it is interpolated."""
TWO_THIRDS = 2.0 / 3.0
"""Degrees of freedom that each step between white groups counts as (J. von Neumann, 1941)."""


@dataclass(frozen=True, slots=True, eq=False)
class ScatterWithin:
    """The spread of groups of readings in n bins that have three groups at least.

    groups (n,): of each; squares (n,): about their line, m^2 a group; wide (n,): revolutions of
    each; step: variance of a group by steps, m^2, with ``freedom`` degrees; known: whether
    steps were gathered.
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

    scatter: of a reading's white part, m; size, m, and length, revolutions: of the correlated part;
    log_weight (C, P): by the spread within bins, beside swings of P periods.
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
        alone, near, fall = _of_groups(length)
        for k, count in enumerate(GROUPS):
            lag = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
            c = np.where(lag == 0, alone, near * fall ** np.maximum(lag - 1.0, 0.0))
            line = np.linalg.qr(np.stack([np.ones(count), np.arange(count) - 0.5 * count], axis=1))[
                0
            ]
            along = c @ line
            inner = line.T @ along
            mean[i, k] = np.trace(c) - np.trace(inner)
            half[i, k] = (c**2).sum() - 2.0 * (along**2).sum() + (inner**2).sum()
    return mean, half


def _of_groups(length: float) -> tuple[float, float, float]:
    """Return variance of a group's mean, covariance with the next one, and its fall with each."""
    wide = GROUP / length
    share = -np.expm1(-wide) / wide
    return 2.0 / wide * (1.0 - share), share**2, float(np.exp(-wide))


def colours_of(spread: ScatterWithin, period: Array) -> Colours:
    """Return the kinds of noise compatible with the spread within bins, white noise first.

    period (P,): of swings beside them, revolutions, 0 for none.
    """
    white = np.array([[0.0, LENGTHS[0]]])
    unit = float(np.sqrt(max(spread.step, spread.squares.sum() / max(spread.groups.sum(), 1.0))))
    grid = np.stack(np.meshgrid(unit * SIZES, LENGTHS, indexing="ij"), axis=-1).reshape(-1, 2)
    size, length = np.concatenate([white, grid]).T
    order = np.log2(length).round().astype(int) // 2 - 1
    groups = np.array([_of_groups(bins) for bins in LENGTHS])[order]
    step = size**2 * (groups[:, 0] - groups[:, 1])
    mean, half = (
        np.stack([np.interp(spread.groups, GROUPS, row) for row in table])[order]
        for table in _tables()
    )
    freedom = spread.groups - 2.0
    if spread.known or not spread.groups.size:
        rest = spread.step - step
    else:
        rest = (spread.squares.sum() - size**2 * mean.sum(axis=1)) / freedom.sum()
    level = np.maximum(rest, LEAST_WHITE * spread.step)
    expected = level[:, None] * freedom + size[:, None] ** 2 * mean
    variance = (
        level[:, None] ** 2 * freedom
        + 2.0 * level[:, None] * size[:, None] ** 2 * mean
        + size[:, None] ** 4 * half
    )
    log_likelihood = _log_gamma(spread.squares, expected, 2.0 * variance)
    # A step or a swing within a bin makes its squares anything: equal chance in each factor of e.
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
    """Return the logarithm of the density of a gamma distribution of some mean and variance."""
    shape, unit = mean**2 / variance, variance / mean
    value = np.maximum(value, 1e-6 * mean)
    return np.asarray(
        (shape - 1.0) * np.log(value) - value / unit - shape * np.log(unit) - gammaln(shape)
    )


def covariance(size: Array, length: Array, begin: Array, end: Array) -> Array:
    """Return the covariance (C, n, n), m^2, of means over bins by correlated noise.

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
