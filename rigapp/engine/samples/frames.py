"""Turn vectors between the crank, follower and global frames; no other module does.

Angles in radians, counter-clockwise from +x. e1 points along the crank, n1 is e1 turned by +90
degrees; e2 points from the crank pin to the wrist, n2 is e2 turned by +90 degrees.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Vector = tuple[Array, Array]


def rotate(x: ArrayLike, y: ArrayLike, angle_rad: ArrayLike) -> Vector:
    """Turn vectors (x, y) counter-clockwise by an angle; shapes broadcast."""
    x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)
    cosine, sine = np.cos(angle_rad), np.sin(angle_rad)
    return cosine * x - sine * y, sine * x + cosine * y


def crank_to_global(along: ArrayLike, across: ArrayLike, crank_angle_rad: ArrayLike) -> Vector:
    """Return the global components of a vector given in the crank frame."""
    return rotate(along, across, crank_angle_rad)


def global_to_crank(x: ArrayLike, y: ArrayLike, crank_angle_rad: ArrayLike) -> Vector:
    """Return the crank-frame components of a vector given in the global frame."""
    return rotate(x, y, -np.asarray(crank_angle_rad, np.float64))


def follower_to_global(
    along: ArrayLike, across: ArrayLike, follower_angle_rad: ArrayLike
) -> Vector:
    """Return the global components of a vector given in the follower frame."""
    return rotate(along, across, follower_angle_rad)


def global_to_follower(x: ArrayLike, y: ArrayLike, follower_angle_rad: ArrayLike) -> Vector:
    """Return the follower-frame components of a vector given in the global frame."""
    return rotate(x, y, -np.asarray(follower_angle_rad, np.float64))


def crank_to_follower(
    along: ArrayLike,
    across: ArrayLike,
    crank_angle_rad: ArrayLike,
    follower_angle_rad: ArrayLike,
) -> Vector:
    """Return the follower-frame components of a vector given in the crank frame."""
    turn = np.asarray(crank_angle_rad, np.float64) - np.asarray(follower_angle_rad, np.float64)
    return rotate(along, across, turn)


def follower_angle(
    crank_angle_rad: ArrayLike, crank_radius_m: float, follower_length_m: float
) -> Array:
    """Return the angle of e2 for a slider on +x, perfect joint, in radians.

    Raises ValueError when the follower is not longer than the crank.
    """
    if follower_length_m <= crank_radius_m:
        raise ValueError(
            f"follower length {follower_length_m} m must exceed the crank radius {crank_radius_m} m"
        )
    return np.asarray(
        np.arcsin(-crank_radius_m / follower_length_m * np.sin(crank_angle_rad)), np.float64
    )
