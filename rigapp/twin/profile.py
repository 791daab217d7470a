"""The worn surface of the bushing as the pin's measured places tell it. Pure functions.

Whatever place the pin has been in is free of material: the worn surface is at least the envelope
of the pin's circle over all measured places of its centre, and where the pin bears it is that.
Where the pin's circle does not reach the bushing's first circle, nothing is known: NaN.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import PROFILE_ANGLES_DEG

Array = NDArray[np.float64]

ANGLES = np.radians(np.asarray(PROFILE_ANGLES_DEG))
"""Angles (rad) of every profile, -pi .. pi, 0 at the initial contact point (wear frame)."""
REACHED = 2e-7
"""A surface this near, m, is reached even if the uncertainty is smaller."""
DOUBTED = 2e-6
"""A surface further away than this, m, is not reached even if the uncertainty is larger."""


def swept(positions: Array, pin_radius: float, angles: Array = ANGLES) -> Array:
    """Return how far from the bushing's centre the pin's circle reaches at each angle, m.

    positions (2, n): of the pin's centre from the bushing's, m. The largest over all positions;
    -inf where no pin's circle is met.
    """
    ray = np.stack([np.cos(angles), np.sin(angles)])
    along = ray.T @ positions
    across = ray[0][:, None] * positions[1] - ray[1][:, None] * positions[0]
    square = pin_radius**2 - across**2
    reach = np.where(square >= 0.0, along + np.sqrt(np.maximum(square, 0.0)), -np.inf)
    return np.asarray(reach.max(axis=1, initial=-np.inf), dtype=np.float64)


def worn_depth(
    positions: Array,
    pin_radius: float,
    bushing_radius: float,
    uncertainty: Array | float = 0.0,
    angles: Array = ANGLES,
) -> Array:
    """Return the depth of wear at each angle, m, NaN where the pin never came to the surface.

    uncertainty: expanded, of the depth at each angle, m. A pin that misses the first circle by
    less than it has reached the surface, and the depth there is 0.
    """
    beyond = swept(positions, pin_radius, angles) - bushing_radius
    margin = np.clip(uncertainty, REACHED, DOUBTED)
    return np.where(beyond >= -margin, np.maximum(beyond, 0.0), np.nan)


def depth_uncertainty(radial: float, across: float, direction: float) -> Array:
    """Return the expanded uncertainty (k = 2) of the depth at each angle, m.

    radial, across: standard uncertainties of the pin's place along the direction of load and
    across it, m; direction: of the load, rad. A pin moved by u adds u cos(angle between) to the
    depth.
    """
    apart = ANGLES - direction
    return np.asarray(2.0 * np.hypot(radial * np.cos(apart), across * np.sin(apart)))


def on_angles(angle: Array, depth: Array) -> Array:
    """Return a profile of the model, (n,) depths at (n,) angles from -pi, at ``ANGLES``, m."""
    return np.asarray(np.interp(ANGLES, angle, depth, period=2.0 * np.pi), dtype=np.float64)
