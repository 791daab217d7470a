"""Small dense linear algebra for compiled loops."""

from __future__ import annotations

import numpy as np
from numba import njit


@njit("float64(float64[:,::1], int64)", cache=True)
def factorise(a, n):  # type: ignore[no-untyped-def]
    """Replace the lower triangle of a[:n, :n] by its Cholesky factor; return the least pivot.

    A pivot that is not positive ends the work and is returned: the matrix is not definite.
    """
    least = np.inf
    for j in range(n):
        pivot = a[j, j]
        for k in range(j):
            pivot -= a[j, k] * a[j, k]
        if not pivot > 0.0:
            return pivot
        least = min(least, pivot)
        root = np.sqrt(pivot)
        a[j, j] = root
        for i in range(j + 1, n):
            total = a[i, j]
            for k in range(j):
                total -= a[i, k] * a[j, k]
            a[i, j] = total / root
    return least


@njit("void(float64[:,::1], int64, float64[:,::1], int64)", cache=True)
def substitute(factor, n, rhs, columns):  # type: ignore[no-untyped-def]
    """Solve L L^T X = rhs[:n, :columns] in place."""
    for i in range(n):
        for k in range(i):
            ratio = factor[i, k]
            for c in range(columns):
                rhs[i, c] -= ratio * rhs[k, c]
        for c in range(columns):
            rhs[i, c] /= factor[i, i]
    for i in range(n - 1, -1, -1):
        for c in range(columns):
            rhs[i, c] /= factor[i, i]
        for k in range(i):
            ratio = factor[i, k]
            for c in range(columns):
                rhs[k, c] -= ratio * rhs[i, c]
