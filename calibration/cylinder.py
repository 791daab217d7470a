"""Capacitance probes against a cylindrical pin: correction of gap and sensitivity, off-axis motion.

Round guarded sensing area of radius a, no fringe field, pin of radius R, gap d on the axis.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def apparent_gap(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return the gap that a flat-target calibration reads when the target is a cylinder, m."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(0.5 * d * (1.0 + np.sqrt(1.0 + q)), dtype=np.float64)


def true_gap(apparent: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return the gap on the axis from the apparent one: the exact inverse, m."""
    d = np.asarray(apparent, dtype=np.float64)
    return np.asarray(d**2 / (d + sensor_radius**2 / (8.0 * target_radius)), dtype=np.float64)


def sensitivity_gain(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return d(apparent gap)/d(gap): by how much the cylinder raises the sensitivity."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(0.5 * (1.0 + (1.0 + 0.5 * q) / np.sqrt(1.0 + q)), dtype=np.float64)


def capacitance(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return the capacitance over the permittivity of the gap, m (parabolic pin surface)."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(4.0 * np.pi * target_radius * (np.sqrt(1.0 + q) - 1.0), dtype=np.float64)


def without_off_axis(probe_1: ArrayLike, probe_2: ArrayLike, radius: float) -> tuple[Array, Array]:
    """Return the pin's position (m) from two orthogonal probe readings (m).

    Motion y across a probe's axis moves the pin's nearest point away by y^2 / (2 R); both
    equations are solved together by fixed-point steps, which contract by |y| / R each.
    """
    one = np.asarray(probe_1, dtype=np.float64)
    two = np.asarray(probe_2, dtype=np.float64)
    x, y = one.copy(), two.copy()
    for _ in range(6):
        x, y = one - y**2 / (2.0 * radius), two - x**2 / (2.0 * radius)
    return x, y
