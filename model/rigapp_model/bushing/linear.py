"""Small dense linear algebra for compiled loops: inner loops run along rows.

The rows are slices from the first element used, and the loops count from 0: if a loop begins
at a variable the compiler must allow for negative indices, and does not vectorise.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.compiled import njit


@njit("float64(float64[:,::1], int64)", cache=True, error_model="numpy")
def factorise(a, n):  # type: ignore[no-untyped-def]
    """Replace the upper triangle of a[:n, :n] by U with U^T U = a; return the smallest pivot.

    Only the upper triangle is read. Returns early with a pivot that is not positive: the matrix is
    not positive definite.
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
            row = a[k, k:n]
            for j in range(row.size):
                row[j] *= scale
            for i in range(k + 1, last):
                ratio = a[k, i]
                row, factor_row = a[i, i:n], a[k, i:n]
                for j in range(row.size):
                    row[j] -= ratio * factor_row[j]
        if last - first < 4:
            break
        # Four rows at a time: a quarter of the passes through the rest of the matrix.
        for i in range(last, n):
            r0, r1, r2, r3 = a[first, i], a[first + 1, i], a[first + 2, i], a[first + 3, i]
            row = a[i, i:n]
            a0, a1, a2, a3 = a[first, i:n], a[first + 1, i:n], a[first + 2, i:n], a[first + 3, i:n]
            for j in range(row.size):
                row[j] -= (r0 * a0[j] + r1 * a1[j]) + (r2 * a2[j] + r3 * a3[j])
    return least


@njit("void(float64[:,::1], int64, float64[:,::1], int64)", cache=True, error_model="numpy")
def substitute(factor, n, rhs, rows):  # type: ignore[no-untyped-def]
    """Solve U^T U x = b in place for the vectors in rhs[:rows, :n]."""
    for c in range(rows):
        for i in range(n):
            value = rhs[c, i] / factor[i, i]
            rhs[c, i] = value
            rest, row = rhs[c, i + 1 : n], factor[i, i + 1 : n]
            for k in range(rest.size):
                rest[k] -= value * row[k]
        for i in range(n - 1, -1, -1):
            total = rhs[c, i]
            rest, row = rhs[c, i + 1 : n], factor[i, i + 1 : n]
            for k in range(rest.size):
                total -= row[k] * rest[k]
            rhs[c, i] = total / factor[i, i]


@njit("void(float64[:,::1], int64, float64[:,::1], float64[:,::1])", cache=True)
def invert(factor, n, lower, inverse):  # type: ignore[no-untyped-def]
    """Fill the upper triangle of inverse[:n, :n] with (U^T U)^-1; lower is overwritten.

    Computes lower = U^-T row by row, then lower^T lower, four rows at a time.
    """
    for i in range(n):
        for j in range(n):
            lower[i, j] = 0.0
        for j in range(i, n):
            inverse[i, j] = 0.0
    for i in range(n):
        scale = 1.0 / factor[i, i]
        unrolled = i - i % 4
        row = lower[i]
        for k in range(0, unrolled, 4):
            r0, r1 = factor[k, i] * scale, factor[k + 1, i] * scale
            r2, r3 = factor[k + 2, i] * scale, factor[k + 3, i] * scale
            a0, a1, a2, a3 = lower[k], lower[k + 1], lower[k + 2], lower[k + 3]
            for j in range(k + 4):
                row[j] -= (r0 * a0[j] + r1 * a1[j]) + (r2 * a2[j] + r3 * a3[j])
        for k in range(unrolled, i):
            ratio = factor[k, i] * scale
            above = lower[k]
            for j in range(k + 1):
                row[j] -= ratio * above[j]
        lower[i, i] = scale
    unrolled = n - n % 4
    for k in range(0, unrolled, 4):
        for i in range(k + 4):
            r0, r1, r2, r3 = lower[k, i], lower[k + 1, i], lower[k + 2, i], lower[k + 3, i]
            row, end = inverse[i, i : k + 4], k + 4
            a0, a1 = lower[k, i:end], lower[k + 1, i:end]
            a2, a3 = lower[k + 2, i:end], lower[k + 3, i:end]
            for j in range(row.size):
                row[j] += (r0 * a0[j] + r1 * a1[j]) + (r2 * a2[j] + r3 * a3[j])
    for k in range(unrolled, n):
        for i in range(k + 1):
            ratio = lower[k, i]
            row, above = inverse[i, i : k + 1], lower[k, i : k + 1]
            for j in range(row.size):
                row[j] += ratio * above[j]
