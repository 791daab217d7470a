"""Small dense linear algebra for compiled loops: inner loops run along rows."""

from __future__ import annotations

import numpy as np

from rigapp_model.compiled import njit


@njit("float64(float64[:,::1], int64)", cache=True)
def factorise(a, n):  # type: ignore[no-untyped-def]
    """Replace the upper triangle of a[:n, :n] by U with U^T U = a; return the least pivot.

    Only the upper triangle is read. A pivot that is not positive ends the work and is returned:
    the matrix is not positive definite.
    """
    least = np.inf
    for first in range(0, n, 4):
        last = min(first + 4, n)
        for k in range(first, last):
            pivot = a[k, k]
            if not pivot > 0.0:
                return pivot
            least = min(least, pivot)
            scale = 1.0 / np.sqrt(pivot)
            for j in range(k, n):
                a[k, j] *= scale
            for i in range(k + 1, last):
                ratio = a[k, i]
                for j in range(i, n):
                    a[i, j] -= ratio * a[k, j]
        if last - first < 4:
            break
        # Four rows at a time, so that the rest of the matrix passes through the cache once.
        for i in range(last, n):
            r0, r1, r2, r3 = a[first, i], a[first + 1, i], a[first + 2, i], a[first + 3, i]
            for j in range(i, n):
                a[i, j] -= (r0 * a[first, j] + r1 * a[first + 1, j]) + (
                    r2 * a[first + 2, j] + r3 * a[first + 3, j]
                )
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


@njit("void(float64[:,::1], int64, float64[:,::1], float64[:,::1])", cache=True)
def invert(factor, n, lower, inverse):  # type: ignore[no-untyped-def]
    """Fill the upper triangle of inverse[:n, :n] with (U^T U)^-1; lower is room to work in.

    lower = U^-T row by row, then its transpose times itself; four rows at a time.
    """
    for i in range(n):
        for j in range(n):
            lower[i, j] = 0.0
        for j in range(i, n):
            inverse[i, j] = 0.0
    for i in range(n):
        scale = 1.0 / factor[i, i]
        whole = i - i % 4
        for k in range(0, whole, 4):
            r0, r1 = factor[k, i] * scale, factor[k + 1, i] * scale
            r2, r3 = factor[k + 2, i] * scale, factor[k + 3, i] * scale
            for j in range(k + 4):
                lower[i, j] -= (r0 * lower[k, j] + r1 * lower[k + 1, j]) + (
                    r2 * lower[k + 2, j] + r3 * lower[k + 3, j]
                )
        for k in range(whole, i):
            ratio = factor[k, i] * scale
            for j in range(k + 1):
                lower[i, j] -= ratio * lower[k, j]
        lower[i, i] = scale
    whole = n - n % 4
    for k in range(0, whole, 4):
        for i in range(k + 4):
            r0, r1, r2, r3 = lower[k, i], lower[k + 1, i], lower[k + 2, i], lower[k + 3, i]
            for j in range(i, k + 4):
                inverse[i, j] += (r0 * lower[k, j] + r1 * lower[k + 1, j]) + (
                    r2 * lower[k + 2, j] + r3 * lower[k + 3, j]
                )
    for k in range(whole, n):
        for i in range(k + 1):
            ratio = lower[k, i]
            for j in range(i, k + 1):
                inverse[i, j] += ratio * lower[k, j]
