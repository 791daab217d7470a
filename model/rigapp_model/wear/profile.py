"""The worn profile over the angle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp_model.bushing.compliance import surface_angles
from rigapp_model.bushing.ring import Ring

Array = NDArray[np.float64]


def profile(surface: Array, ring: Ring) -> Array:
    """Return the radial depth at the angles of the unworn mesh, m: worn nodes have moved."""
    sectors = len(surface) // 2
    unworn = surface_angles(sectors)
    moved = np.angle((surface[:, 0] + 1j * surface[:, 1]) * np.exp(-1j * unworn))
    depth = np.hypot(surface[:, 0], surface[:, 1]) - ring.inner
    return np.interp(unworn, unworn + moved, depth, period=2.0 * np.pi).clip(min=0.0)
