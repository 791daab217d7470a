"""What is done to the probes' readings beyond sensitivity and offset: run-out map and alignment.

The map belongs to what each probe reads, so it comes off first, at the crank angle of the sample
(latency corrected, as all signals); then the matrix turns the pair into the follower's axes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.config.rig import ProbesSection

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ProbeCorrection:
    """Correct the pair of probes. matrix (2, 2); table (2, counts of a turn), um; cos, sin (2, N).

    The table is the map at every count of the encoder, so that no sample needs a sine.
    """

    matrix: Array
    table: Array
    cosines: Array
    sines: Array

    def apply(self, counts: NDArray[np.int64], read: Array) -> Array:
        """Return the pin's position (2, n) in the follower frame from what the probes read, um.

        counts (n,): of the encoder since its index.
        """
        return np.asarray(self.matrix @ (read - self.table[:, counts % self.table.shape[1]]))

    def at(self, angle_rad: float | None, index_angle_rad: float, read: Array) -> Array:
        """Return the same for one sample at a crank angle, without the map while it is unknown."""
        if angle_rad is None or not math.isfinite(angle_rad):
            return np.asarray(self.matrix @ read, np.float64)
        turn = self.table.shape[1]
        count = round((angle_rad - index_angle_rad) / (2.0 * math.pi) * turn) % turn
        return np.asarray(self.matrix @ (read - self.table[:, count]), np.float64)


def probe_correction(
    probes: ProbesSection, counts_per_revolution: int, index_angle_rad: float
) -> ProbeCorrection | None:
    """Return what the rig's records ask for, None for nothing."""
    cosines = np.array(probes.run_out_cos_um, np.float64).reshape(2, -1)
    sines = np.array(probes.run_out_sin_um, np.float64).reshape(2, -1)
    matrix = np.array(probes.alignment, np.float64)
    if cosines.size == 0 and np.array_equal(matrix, np.eye(2)):
        return None
    angle = index_angle_rad + np.arange(counts_per_revolution) * (
        2 * math.pi / counts_per_revolution
    )
    orders = np.arange(1, cosines.shape[1] + 1)
    multiples = np.outer(orders, angle)
    table = cosines @ np.cos(multiples) + sines @ np.sin(multiples)
    return ProbeCorrection(matrix, np.asarray(table, np.float64), cosines, sines)
