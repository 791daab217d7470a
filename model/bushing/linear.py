"""Small dense linear algebra for compiled loops: inner loops run along rows."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit("float64(float64[:,::1], int64)", cache=True)
def factorise(a, n):  # type: ignore[no-untyped-def]
    """Replace the upper triangle of a[:n, :n] by U with U^T U = a; return the least pivot.

    Only the upper triangle is read. A pivot that is not positive ends the work and is returned:
    the matrix is not positive definite.
    """
    least = np.inf
    for k in range(n):
        pivot = a[k, k]
        if not pivot > 0.0:
            return pivot
        least = min(least, pivot)
        scale = 1.0 / np.sqrt(pivot)
        for j in range(k, n):
            a[k, j] *= scale
        for i in range(k + 1, n):
            ratio = a[k, i]
            for j in range(i, n):
                a[i, j] -= ratio * a[k, j]
    return least


@njit("void(float64[:,::1], int64, float64[:,::1], int64)", cache=True)
def substitute(factor, n, rhs, rows):  # type: ignore[no-untyped-def]
    """Solve U^T U x = b in place for the vectors in rhs[:rows, :n]."""
    for c in range(rows):
        for i in range(n):
            value = rhs[c, i] / factor[i, i]
            rhs[c, i] = value
            for k in range(i + 1, n):
                rhs[c, k] -= value * factor[i, k]
        for i in range(n - 1, -1, -1):
            total = rhs[c, i]
            for k in range(i + 1, n):
                total -= factor[i, k] * rhs[c, k]
            rhs[c, i] = total / factor[i, i]
