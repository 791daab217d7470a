"""Noise of the bins of depth: scatter, correlated noise, and slow drift.

Noise of bin i = w_i + c_i + r_i: w is a random walk in the logarithm of revolutions; c an
autoregressive process (G. E. Uhlenbeck, L. S. Ornstein, Phys. Rev. 36 (1930) 823-841) with a size
and a correlation length; r is white. Their strengths are unknown: a table of them is compared by
the marginal likelihood of the bins and of the spread of readings within bins.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.identification.bins import Bin
from rigapp_model.identification.colour import ScatterWithin, colours_of, covariance, spread_of
from rigapp_model.identification.errors import NotIdentifiable, ProbeErrors
from rigapp_model.identification.shapes import Moments, shapes

Array = NDArray[np.float64]

EXPECTED_FREEDOM = 4.0
"""Weight of the scatter stated by the record, in groups of readings."""
LEAST_BINS = 4
"""Fewest bins that separate reference, sensitivity and coefficient from the scatter."""


@dataclass(frozen=True, slots=True, eq=False)
class DepthBins:
    """Bins as arrays (n,): depth (m), progress, half its width, last revolution, noise.

    begin: revolutions before the bin; middle: its middle revolution; walked, alone (n,): mean of
    ln n over it, and of the smaller of two ln n; noise: standard uncertainty of each bin's mean due
    to its scatter, m, if white; scatter: of one reading, m; spread: of groups of readings within
    the bins; warm (n,): temperature relative to the first bin, K, 0 if unknown; warm_zero: of the
    first bin, degC, None unless all are known.
    """

    depth: Array
    progress: Array
    half: Array
    revolution: Array
    begin: Array
    middle: Array
    walked: Array
    alone: Array
    noise: Array
    scatter: float
    spread: ScatterWithin
    warm: Array
    warm_zero: float | None

    @property
    def moments(self) -> Moments:
        """Return the argument of ``shapes``."""
        return Moments(self.begin, self.revolution, self.warm)


def readings_of(bins: Sequence[Bin], errors: ProbeErrors) -> DepthBins:
    """Return the bins as arrays; raise NotIdentifiable if there are too few."""
    if len(bins) < LEAST_BINS:
        raise NotIdentifiable(
            say(
                "the depth is known in {} bins of revolutions so far, and {} are needed: wait",
                len(bins),
                LEAST_BINS,
            )
        )
    rows = np.array(
        [(b.depth, b.progress, b.first, b.last, b.revolution, b.count, b.squares) for b in bins]
    )
    depth, progress, first, last, revolution, count, squares = rows.T
    freedom = EXPECTED_FREEDOM + sum(b.freedom for b in bins)
    scatter = float(np.sqrt((EXPECTED_FREEDOM * errors.scatter**2 + squares.sum()) / freedom))
    # Within a bin, progress is proportional to revolutions.
    turn = revolution / np.maximum(last, 1e-300)
    low = np.minimum(np.maximum(first * turn, 1.0), revolution)
    walked, alone = _mean_logarithms(low, revolution)
    warm = np.array([b.warm for b in bins], dtype=np.float64)
    warm_zero = float(warm[0]) if np.isfinite(warm).all() else None
    return DepthBins(
        depth,
        progress,
        0.5 * (last - first),
        revolution,
        low - 1.0,
        progress * turn,
        walked,
        alone,
        scatter / np.sqrt(count),
        scatter,
        spread_of(bins, errors),
        np.zeros(warm.size) if warm_zero is None else warm - warm_zero,
        warm_zero,
    )


STRENGTHS = (1.0, 2.5, 6.3)
"""Strengths of the drift that are compared, in units of the record's lower bound."""
STRENGTH_DECAY = 4.0
"""Log ratio of the prior probabilities of consecutive strengths: confidence in the record."""
CREEP_SHARE = 0.2
"""Prior probability that bushing or probes creep in addition to the record's drift."""
LEAST_KIND = 8.5
"""Log of the ratio to the most probable kind, by the spread within bins, up to which others are
used."""
LEAST_DRIFT = 1e-9
"""Drift of a record without one, m: the unit of the table of strengths."""


def _mean_logarithms(low: Array, high: Array) -> tuple[Array, Array]:
    """Return the means of ln u and of the smaller of two ln u, u uniform between low and high.

    For the mean of a random walk in ln n over a bin, these are its covariance with later bins and
    its variance.
    """
    wide = np.maximum(high - low, 1e-6 * high)
    first, last = np.log(low), np.log(low + wide)
    high = low + wide
    mean = (high * last - low * first) / wide - 1.0
    once = high * last - low * first - wide  # of ln u
    by_u = 0.5 * (high**2 * last - low**2 * first) - 0.25 * (high**2 - low**2)  # of u ln u
    return mean, 2.0 * (high * once - by_u) / wide**2


@dataclass(frozen=True, slots=True, eq=False)
class Kinds:
    """J kinds of noise, (J,) each.

    strength: of the drift, m per root of ln n; creeps: 1 with creep, else 0; scatter, size, length:
    see ``Colours``; period: of a slow swing, revolutions, 0 for none; jump (J, 2): first and last
    revolution of a bin with a step instead of a swing, 0 for none; log_prior: including the
    evidence of the spread within bins.
    """

    strength: Array
    creeps: Array
    scatter: Array
    size: Array
    length: Array
    period: Array
    jump: Array
    log_prior: Array

    def at(self, index: NDArray[np.int64]) -> Kinds:
        """Return the selected kinds."""
        return Kinds(*(getattr(self, field.name)[index] for field in fields(self)))


@dataclass(frozen=True, slots=True, eq=False)
class Noise:
    """Covariance of n bins for J kinds of noise.

    steps (s, 2): first and last revolution of bins with a step in all kinds; root (J, n, n): of the
    inverse covariance; log_determinant (J,): of the covariance; onward (J, S, n): weights of
    whitened bins in S states, which are the drift of the last bin, the correlated noise at its end
    and the amplitudes of ``shapes``; spare (J, S, S): their covariance given the bins.
    """

    kinds: Kinds
    steps: Array
    root: Array
    log_determinant: Array
    onward: Array
    spare: Array

    def at(self, index: NDArray[np.int64]) -> Noise:
        """Return the selected kinds of noise."""
        return Noise(
            self.kinds.at(index),
            self.steps,
            self.root[index],
            self.log_determinant[index],
            self.onward[index],
            self.spare[index],
        )


def possible_kinds(readings: DepthBins, drift: float, period: Array) -> tuple[Kinds, Array]:
    """Return kinds of noise without a swing, and their log weights (J, P) with swings.

    drift: lower bound of its strength; period (P,): of the swings, revolutions, the first one 0.
    """
    colours = colours_of(readings.spread, period)
    # Creep together with a drift above the record's would be two explanations of one effect.
    strengths = max(drift, LEAST_DRIFT) * np.array([*STRENGTHS, STRENGTHS[0]])
    creeps = np.arange(strengths.size) == len(STRENGTHS)
    of_drift = np.where(creeps, 0.0, -STRENGTH_DECAY * np.arange(strengths.size))
    of_drift += np.log(np.where(creeps, CREEP_SHARE, 1.0 - CREEP_SHARE))
    each = np.repeat(np.arange(colours.size.size), strengths.size)
    which = np.tile(np.arange(strengths.size), colours.size.size)
    log_weight = colours.log_weight[each] + of_drift[which, None]
    log_weight -= np.logaddexp.reduce(log_weight[:, 0])
    counts = (log_weight > log_weight.max(axis=0) - LEAST_KIND).any(axis=1)
    each, which, log_weight = each[counts], which[counts], log_weight[counts]
    return Kinds(
        strengths[which],
        creeps[which].astype(np.float64),
        colours.scatter[each],
        colours.size[each],
        colours.length[each],
        np.zeros(each.size),
        np.zeros((each.size, 2)),
        log_weight[:, 0],
    ), log_weight


def covariance_of(readings: DepthBins, kinds: Kinds) -> Array:
    """Return the covariance (J, n, n) of the bins, m^2, without shapes."""
    walk = np.minimum(readings.walked[:, None], readings.walked)
    np.fill_diagonal(walk, readings.alone)
    total = covariance(kinds.size, kinds.length, readings.begin, readings.revolution)
    total += kinds.strength[:, None, None] ** 2 * walk
    index = np.arange(walk.shape[0])
    total[:, index, index] += kinds.scatter[:, None] ** 2 * (readings.noise / readings.scatter) ** 2
    return total


def noise_of(readings: DepthBins, kinds: Kinds, steps: Array) -> Noise:
    """Return the ``Noise`` of the bins for these kinds, with steps in bins (s, 2)."""
    columns = shapes(kinds.period, kinds.jump, kinds.creeps, steps, readings.moments)
    total = covariance_of(readings, kinds) + columns.swapaxes(1, 2) @ columns
    lower = np.linalg.cholesky(total)
    root = np.linalg.inv(lower).swapaxes(1, 2)
    strength, size = kinds.strength, kinds.size
    end_correlation = _end_correlation(kinds.length, readings)
    rows = np.concatenate(
        [
            (strength[:, None] ** 2 * readings.walked)[:, None],
            (size[:, None] ** 2 * end_correlation)[:, None],
            columns,
        ],
        axis=1,
    )
    onward = rows @ root
    prior = np.zeros((strength.size, rows.shape[1], rows.shape[1]))
    index = np.arange(2, rows.shape[1])
    prior[:, 0, 0], prior[:, 1, 1] = strength**2 * readings.walked[-1], size**2
    prior[:, index, index] = 1.0
    return Noise(
        kinds,
        steps,
        root,
        2.0 * np.log(np.diagonal(lower, axis1=1, axis2=2)).sum(axis=1),
        onward,
        prior - onward @ onward.swapaxes(1, 2),
    )


def _end_correlation(length: Array, readings: DepthBins) -> Array:
    """Return the correlation (J, n) of bin means with the noise at the end of the last bin."""
    wide = (readings.revolution - readings.begin) / length[:, None]
    after = (readings.revolution[-1] - readings.revolution) / length[:, None]
    return np.asarray(np.exp(-after) * -np.expm1(-wide) / wide)
