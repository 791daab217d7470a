"""Sobol's indices: the share of each parameter in a result's variance, with limits.

First order by Saltelli (2010), total by Jansen (1999), limits by the bootstrap over base points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
RESAMPLES = 1000
LIMITS = (2.5, 97.5)
FEWEST = 4
RESOLVED = 0.1
"""Half the width of the limits up to which an index is resolved: the ranking is then known, except
for keys of about the same index."""


@dataclass(frozen=True, slots=True, eq=False)
class Indices:
    """First-order and total indices of each parameter (d,), each with 95 % limits."""

    first_order: Floats
    first_order_low: Floats
    first_order_high: Floats
    total: Floats
    total_low: Floats
    total_high: Floats

    def points_needed(self, base_points: int) -> int:
        """Return the number of base points that resolves every index; 0 if the present ones do."""
        ends = (
            (self.first_order_low, self.first_order_high),
            (self.total_low, self.total_high),
        )
        widest = 0.5 * max(float(np.nanmax(high - low, initial=0.0)) for low, high in ends)
        if widest <= RESOLVED:
            return 0
        return int(2 ** math.ceil(math.log2(base_points * (widest / RESOLVED) ** 2)))


INDICES = tuple(field.name for field in fields(Indices))


def indices_of(blocks: Floats, seed: int) -> Indices | None:
    """Return the indices of a result at Saltelli's points; None where it does not vary.

    blocks: (d + 2, n), its values at A, at B, and at A with each parameter from B. Base points at
    which a value is missing are left out.
    """
    known = blocks[:, np.isfinite(blocks).all(axis=0)]
    if known.shape[1] < FEWEST or np.ptp(known[:2]) == 0.0:
        return None
    first, total = _estimates(known)
    random, count = np.random.default_rng(seed), known.shape[1]
    # One at a time: all together take a thousand times the memory of the study.
    drawn = (_estimates(known[:, random.integers(0, count, count)]) for _ in range(RESAMPLES))
    limits = np.nanpercentile(np.array(list(drawn)), LIMITS, axis=0)
    (low, total_low), (high, total_high) = limits
    return Indices(first, low, high, total, total_low, total_high)


def _estimates(blocks: Floats) -> tuple[Floats, Floats]:
    """Return first-order and total indices (d,) of blocks (d + 2, n)."""
    a, b, mixed = blocks[0], blocks[1], blocks[2:]
    variance, mean = blocks[:2].var(), blocks[:2].mean()
    with np.errstate(divide="ignore", invalid="ignore"):
        # Centred: the mean of a result is not part of its variance, and only adds noise.
        first = ((b - mean) * (mixed - a)).mean(axis=-1) / variance
        total = 0.5 * ((a - mixed) ** 2).mean(axis=-1) / variance
    return first, total
