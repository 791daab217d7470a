"""Reduce a long series to few points with all peaks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.rownumbers import RowNumbers

Floats = NDArray[np.float64]

BUCKETS = 900
"""Number of parts, more than the resolution of a printed page."""


def envelope(x: NDArray[np.generic] | RowNumbers, y: NDArray[np.generic]) -> tuple[Floats, Floats]:
    """Return the points of a polyline through y (n,) over the ascending x (n,).

    A long series is divided into BUCKETS parts, each drawn as a line from its smallest to its
    largest value; NaN is skipped unless a whole part is NaN.
    """
    n = min(len(x), len(y))
    ys = np.asarray(y[:n], np.float64)
    if n <= 2 * BUCKETS:
        return np.asarray(x[:n], np.float64), ys
    starts = np.linspace(0, n, BUCKETS, endpoint=False).astype(np.intp)
    low, high = np.fmin.reduceat(ys, starts), np.fmax.reduceat(ys, starts)
    ends = np.append(starts[1:], n) - 1
    middle = 0.5 * (np.asarray(x[starts], np.float64) + np.asarray(x[ends], np.float64))
    points = np.empty((BUCKETS, 2))
    points[:, 0], points[:, 1] = low, high
    points[1::2] = points[1::2, ::-1]
    return np.repeat(middle, 2), points.ravel()
