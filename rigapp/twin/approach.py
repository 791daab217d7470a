"""The elastic approach of pin and bushing under a force, by depth of wear. Pure functions.

The probes measure wear and elastic approach together. As the contact conforms the approach falls:
their reading grows by less than the wear.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Approach:
    """The elastic approach (D, M), m, at depths (D,), m, and forces (M,), N; both rise.

    Between them straight lines; below the first depth and beyond the last that of the nearest,
    beyond the largest force in proportion to it.
    """

    depths: Array
    forces: Array
    table: Array

    def at(self, depth: float, force: Array) -> Array:
        """Return the approach at a depth (m) and some forces (n,), N: (n,), m."""
        row = float(np.interp(depth, self.depths, np.arange(self.depths.size)))
        low, up = self.table[int(row)], self.table[min(int(row) + 1, self.depths.size - 1)]
        return np.asarray(self._shares(force) @ (low + row % 1.0 * (up - low)))

    def mean(self, force: Array) -> MeanApproach:
        """Return the mean of ``at`` over forces (n,), N, weighted by the forces."""
        means = self.table @ (force @ self._shares(force) / force.sum())
        return MeanApproach(self.depths, np.asarray(means))

    def _shares(self, force: Array) -> Array:
        """Return the interpolation weights (n, M) of the table's forces for some forces."""
        above = np.minimum(np.searchsorted(self.forces, force), self.forces.size - 1)
        low = np.where(above > 0, self.forces[above - 1], 0.0)
        beyond = force > self.forces[-1]
        part = (force - low) / np.where(beyond, 1.0, self.forces[above] - low)
        shares = np.zeros((force.size, self.forces.size))
        each = np.arange(force.size)
        shares[each, above - 1] = np.where((above > 0) & ~beyond, 1.0 - part, 0.0)
        shares[each, above] = np.where(beyond, force / self.forces[-1], part)
        return shares


@dataclass(frozen=True, slots=True, eq=False)
class MeanApproach:
    """The mean elastic approach under some forces, means (D,), m, at depths (D,), m."""

    depths: Array
    means: Array

    def at(self, depth: float) -> float:
        """Return the mean approach at a depth (m), m."""
        return float(np.interp(depth, self.depths, self.means))

    def depth_of(self, beyond: float) -> float:
        """Return the depth (m) at which depth and approach together are ``beyond`` (m)."""
        seen = self.depths + self.means
        depth = float(np.interp(beyond, seen, self.depths))
        outside = min(beyond - float(seen[0]), 0.0) + max(beyond - float(seen[-1]), 0.0)
        return depth + outside

    def gain(self, depth: float) -> float:
        """Return the change of depth per change of the probes' reading, at a depth (m)."""
        step = 1e-7
        seen = self.at(depth + step) - self.at(depth - step)
        return 1.0 / max(1.0 + seen / (2.0 * step), 0.2)


RIGID = Approach(np.zeros(1), np.ones(1), np.zeros((1, 1)))
"""No approach at all."""
