"""Capacitance probes against a cylindrical pin: correction of gap and sensitivity.

Round guarded sensing area of radius a, no fringe field, pin of radius R, gap d on the axis.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rigapp_calibration.arrays import Array


def apparent_gap(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return the gap that a flat-target calibration reads when the target is a cylinder, m."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(0.5 * d * (1.0 + np.sqrt(1.0 + q)), dtype=np.float64)


def sensitivity_gain(gap: ArrayLike, sensor_radius: float, target_radius: float) -> Array:
    """Return d(apparent gap)/d(gap): by how much the cylinder raises the sensitivity."""
    d = np.asarray(gap, dtype=np.float64)
    q = sensor_radius**2 / (2.0 * target_radius * d)
    return np.asarray(0.5 * (1.0 + (1.0 + 0.5 * q) / np.sqrt(1.0 + q)), dtype=np.float64)
