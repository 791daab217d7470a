"""Turn plane vectors from one frame into another."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def into_frame(vector: ArrayLike, cosine: ArrayLike, sine: ArrayLike) -> Array:
    """Return the components of a global vector (2, ...) along a frame's axes, shape (2, ...).

    cosine, sine: of the frame's angle from global x, counter-clockwise; shape (...) or a scalar.
    """
    x, y = np.asarray(vector, dtype=np.float64)
    turned = np.empty((2, *np.broadcast_shapes(np.shape(x), np.shape(cosine))))
    turned[0] = x * cosine + y * sine
    turned[1] = y * cosine - x * sine
    return turned


def out_of_frame(vector: ArrayLike, cosine: ArrayLike, sine: ArrayLike) -> Array:
    """Return the global components of a vector (2, ...) given along a frame's axes."""
    return into_frame(vector, cosine, -np.asarray(sine))


def crank_to_follower(
    vector: ArrayLike, crank_angle: ArrayLike, follower_angle: ArrayLike
) -> Array:
    """Return crank-frame components (2, ...) in the follower frame; angles in rad.

    The load cell measures in the crank frame, the probes in the follower frame.
    """
    turn = np.asarray(follower_angle) - np.asarray(crank_angle)
    return into_frame(vector, np.cos(turn), np.sin(turn))
