"""Transformation of plane vectors between frames."""

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
