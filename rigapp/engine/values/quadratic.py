"""Invert the quadratic terms of a calibrated load cell, sample by sample.

The calibration's forward model is signal - zero = A f + Q (f1^2, f1 f2, f2^2), f on the pin. With
the linear joint force G = -inverse(A) (signal - zero) and F = -f it becomes

    F = G + B (F1^2, F1 F2, F2^2),    B = inverse(A) Q  (2, 3), 1/N,

which Newton's method solves from F = G; B is ``b`` below. ``STEPS`` steps are exact to rounding
wherever ``invertible`` holds; every quantity of a force in the engine goes through here.
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math

import numpy as np
from numba import float64, types
from numpy.typing import NDArray

from rigapp_model.compiled import njit

Array = NDArray[np.float64]

STEPS = 5
LARGEST_SLOPE = 0.4
"""How far the quadratic terms may turn the slope of the cell before it cannot be inverted."""


def invertible(b: Array, largest: float) -> bool:
    """Tell whether forces up to ``largest`` (N) follow from signals without doubt.

    The slope of B q(F) is at most 2 |B| |F|; below ``LARGEST_SLOPE`` the map is one to one.
    """
    return bool(2.0 * float(np.linalg.norm(b)) * largest <= LARGEST_SLOPE)


@njit(
    types.UniTuple(float64, 2)(float64, float64, float64[:, ::1]),
    cache=True,
    nogil=True,
    error_model="numpy",
)
def linearised(x: float, y: float, b: Array) -> tuple[float, float]:
    """Return the joint force (N) whose linear image is (x, y)."""
    u, v = x, y
    for _ in range(STEPS):
        r1 = u - x - b[0, 0] * u * u - b[0, 1] * u * v - b[0, 2] * v * v
        r2 = v - y - b[1, 0] * u * u - b[1, 1] * u * v - b[1, 2] * v * v
        j11 = 1.0 - 2.0 * b[0, 0] * u - b[0, 1] * v
        j12 = -b[0, 1] * u - 2.0 * b[0, 2] * v
        j21 = -2.0 * b[1, 0] * u - b[1, 1] * v
        j22 = 1.0 - b[1, 1] * u - 2.0 * b[1, 2] * v
        scale = 1.0 / (j11 * j22 - j12 * j21)
        u -= scale * (j22 * r1 - j12 * r2)
        v -= scale * (j11 * r2 - j21 * r1)
    return u, v


@njit(
    "void(float64[::1], float64[::1], float64[::1], int64, float64[:, ::1])",
    cache=True,
    nogil=True,
    error_model="numpy",
)
def linearise_rows(first: Array, second: Array, total: Array, n: int, b: Array) -> None:
    """Replace linear joint forces first[:n], second[:n] by the true ones; total[:n] becomes |F|."""
    for i in range(n):
        x, y = linearised(first[i], second[i], b)
        first[i] = x
        second[i] = y
        total[i] = math.sqrt(x * x + y * y)


def linearised_forces(force: Array, b: Array) -> Array:
    """Return the joint forces (2, samples) of linear ones (2, samples)."""
    if not b.any():
        return force
    first, second = np.array(force[0], np.float64), np.array(force[1], np.float64)
    linearise_rows(first, second, np.empty_like(first), len(first), b)
    return np.stack((first, second))
