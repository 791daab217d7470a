"""Corrections of readings: quadratic terms of a load cell, tables, run-out of the probes.

The calibration's forward model of a cell is signal - zero = A f + Q (f1^2, f1 f2, f2^2), f on the
pin. With the linear joint force G = -inverse(A) (signal - zero) and F = -f it becomes

    F = G + B (F1^2, F1 F2, F2^2),    B = inverse(A) Q  (2, 3), 1/N,

which is solved by Newton's method from F = G; B is ``b`` below. ``STEPS`` steps are exact to
rounding if ``invertible`` holds; all forces in the engine are computed by these functions.
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import float64, types
from numpy.typing import NDArray

from rigapp.config.rig import ProbesSection
from rigapp_model.compiled import njit

Array = NDArray[np.float64]

STEPS = 5
LARGEST_SLOPE = 0.4
"""Largest relative change of the cell's slope by the quadratic terms with a unique inverse."""


def invertible(b: Array, largest: float) -> bool:
    """Return whether forces up to ``largest`` (N) follow uniquely from signals.

    The slope of B q(F) is at most 2 |B| |F|; below ``LARGEST_SLOPE`` the map is one to one.
    """
    return bool(2.0 * float(np.linalg.norm(b)) * largest <= LARGEST_SLOPE)


@njit(
    types.UniTuple(float64, 2)(float64, float64, float64[:, ::1]),
    cache=True,
    nogil=True,
    error_model="numpy",
)
def linearised(x: float, y: float, b: Array) -> tuple[float, float]:
    """Return the joint force (N) with the linear force (x, y)."""
    u, v = x, y
    for _ in range(STEPS):
        r1 = u - x - b[0, 0] * u * u - b[0, 1] * u * v - b[0, 2] * v * v
        r2 = v - y - b[1, 0] * u * u - b[1, 1] * u * v - b[1, 2] * v * v
        j11 = 1.0 - 2.0 * b[0, 0] * u - b[0, 1] * v
        j12 = -b[0, 1] * u - 2.0 * b[0, 2] * v
        j21 = -2.0 * b[1, 0] * u - b[1, 1] * v
        j22 = 1.0 - b[1, 1] * u - 2.0 * b[1, 2] * v
        scale = 1.0 / (j11 * j22 - j12 * j21)
        u -= scale * (j22 * r1 - j12 * r2)
        v -= scale * (j11 * r2 - j21 * r1)
    return u, v


@njit(
    "void(float64[::1], float64[::1], float64[::1], int64, float64[:, ::1])",
    cache=True,
    nogil=True,
    error_model="numpy",
)
def linearise_rows(first: Array, second: Array, total: Array, n: int, b: Array) -> None:
    """Replace linear joint forces first[:n], second[:n] by corrected ones; set total[:n] to |F|."""
    for i in range(n):
        x, y = linearised(first[i], second[i], b)
        first[i] = x
        second[i] = y
        total[i] = math.sqrt(x * x + y * y)


def linearised_forces(force: Array, b: Array) -> Array:
    """Return the corrected joint forces (2, samples) of linear ones (2, samples)."""
    if not b.any():
        return force
    first, second = np.array(force[0], np.float64), np.array(force[1], np.float64)
    linearise_rows(first, second, np.empty_like(first), len(first), b)
    return np.stack((first, second))


@njit("void(float64[::1], int64, float64[:, ::1])", cache=True, nogil=True, error_model="numpy")
def follow(x: Array, n: int, table: Array) -> None:
    """Replace signals x[:n] by the values of a table (2, points); no effect without points.

    Linear extrapolation from the first, or last, two points: a signal outside the calibrated range
    must not have the value at the end of the table.
    """
    points = table.shape[1]
    if points < 2:
        return
    for i in range(n):
        low, high = 0, points - 2
        while low < high:
            middle = (low + high + 1) // 2
            if x[i] >= table[0, middle]:
                low = middle
            else:
                high = middle - 1
        step = table[0, low + 1] - table[0, low]
        slope = (table[1, low + 1] - table[1, low]) / step
        x[i] = table[1, low] + slope * (x[i] - table[0, low])


# Corrections of the probes besides sensitivity and offset: run-out map and alignment.
#
# The map is that of each probe's readings, so it is subtracted first, at the crank angle of the
# sample (corrected for latency, as all signals); then the matrix transforms the pair to the
# follower's axes.


@dataclass(frozen=True, slots=True, eq=False)
class ProbeCorrection:
    """Correction of two probes. matrix (2, 2); table (2, counts of a turn), um; cos, sin (2, N).

    The table is the map at each count of the encoder, so that no sample needs a sine.
    """

    matrix: Array
    table: Array
    cosines: Array
    sines: Array

    def apply(self, counts: NDArray[np.int64], read: Array) -> Array:
        """Return the pin's position (2, n) in the follower frame from the probes' readings, um.

        counts (n,): of the encoder since its index.
        """
        return np.asarray(self.matrix @ (read - self.table[:, counts % self.table.shape[1]]))

    def at(self, angle_rad: float | None, index_angle_rad: float, read: Array) -> Array:
        """Return the same for one sample at a crank angle, without the map if that is unknown."""
        if angle_rad is None or not math.isfinite(angle_rad):
            return np.asarray(self.matrix @ read, np.float64)
        turn = self.table.shape[1]
        count = round((angle_rad - index_angle_rad) / (2.0 * math.pi) * turn) % turn
        return np.asarray(self.matrix @ (read - self.table[:, count]), np.float64)


def probe_correction(
    probes: ProbesSection, counts_per_revolution: int, index_angle_rad: float
) -> ProbeCorrection | None:
    """Return the correction from the rig's records, None without one."""
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
