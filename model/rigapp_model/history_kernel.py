"""Sums of the angle fit, compiled.

The linear algebra library would do them with threads that wait for each other: on a busy machine a
hundred times slower than the sums themselves.
"""

from __future__ import annotations

import math

import numpy as np
from numba import float64, types

from rigapp_model.compiled import njit

MATRIX = float64[:, ::1]
ROW = float64[::1]
READ_ROW = types.Array(float64, 1, "C", readonly=True)
DEPENDENT = 1e-14
"""Part of a column that must be left after the others, or it is taken as dependent on them."""


@njit(types.Tuple((MATRIX, ROW))(MATRIX, ROW), cache=True, fastmath={"reassoc"})
def normal_equations(design, values):  # type: ignore[no-untyped-def]
    """Return the Gram matrix of a design's rows (m, n) and their products with values (n,)."""
    count, size = design.shape
    gram, right = np.empty((count, count)), np.empty(count)
    for i in range(count):
        for j in range(i + 1):
            total = 0.0
            for k in range(size):
                total += design[i, k] * design[j, k]
            gram[i, j] = gram[j, i] = total
        total = 0.0
        for k in range(size):
            total += design[i, k] * values[k]
        right[i] = total
    return gram, right


@njit(MATRIX(MATRIX), cache=True)
def inverse(matrix):  # type: ignore[no-untyped-def]
    """Return the inverse of a symmetric, positive matrix; a dependent unknown gets zeros."""
    count = matrix.shape[0]
    work = matrix.copy()
    scale = np.empty(count)
    for i in range(count):
        scale[i] = 1.0 / math.sqrt(work[i, i]) if work[i, i] > 0.0 else 0.0
    for i in range(count):
        for j in range(count):
            work[i, j] *= scale[i] * scale[j]
    used = np.zeros(count)
    for k in range(count):
        pivot = work[k, k]
        if pivot < DEPENDENT:
            continue
        used[k] = 1.0
        for i in range(count):
            if i != k:
                factor = work[i, k] / pivot
                for j in range(count):
                    if j != k:
                        work[i, j] -= factor * work[k, j]
                work[i, k] = -factor
        for j in range(count):
            work[k, j] /= pivot
        work[k, k] = 1.0 / pivot
    for i in range(count):
        for j in range(count):
            work[i, j] *= scale[i] * scale[j] * used[i] * used[j]
    return work


@njit(MATRIX(READ_ROW, READ_ROW, READ_ROW, READ_ROW, READ_ROW), cache=True)
def evaluate(tau, phase, trend, cosines, sines):  # type: ignore[no-untyped-def]
    """Return the fit and its first two derivatives at tau (n,), shape (3, n).

    phase, trend: three coefficients of a polynomial; cosines, sines: of k times the phase.
    """
    out = np.empty((3, tau.size))
    gain = 2.0 * phase[2]
    for n in range(tau.size):
        t = tau[n]
        out[0, n] = trend[0] + t * (trend[1] + t * trend[2])
        out[1, n] = trend[1] + 2.0 * t * trend[2]
        out[2, n] = 2.0 * trend[2]
        if cosines.size == 0:
            continue
        angle = phase[0] + t * (phase[1] + t * phase[2])
        rate = phase[1] + gain * t
        c1, s1 = math.cos(angle), math.sin(angle)
        c, s = c1, s1
        wave = first = second = 0.0
        for k in range(cosines.size):
            order = k + 1.0
            along = cosines[k] * c + sines[k] * s
            wave += along
            first += order * (sines[k] * c - cosines[k] * s)
            second -= order * order * along
            c, s = c * c1 - s * s1, s * c1 + c * s1
        out[0, n] += wave
        out[1, n] += first * rate
        out[2, n] += second * rate * rate + first * gain
    return out
