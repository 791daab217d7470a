"""Persson's closed form of conformal contact: a rigid pin in an infinite plate.

Exact without friction when the plate is incompressible in plane strain (Poisson's ratio 1/2), where
its tangential displacements do not couple with the pressure; elsewhere a close estimate.
With b = tan(half-angle / 2): E' c / F = (1 - ln(1 + b^2) - 2 b^4) / (pi b^2 (1 + b^2)).
Source: A. Persson, On the stress distribution of cylindrical elastic bodies in contact (1964), for
a pin without compliance of its own: the plate's mean expansion then counts twice as much beside its
other displacements as between equal bodies.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from model.errors import ModelError, require_not_negative, require_positive

Array = NDArray[np.float64]


def half_angle(force: float, clearance: float, modulus: float) -> float:
    """Return the contact's half-angle, rad; at most about 72 degrees, for no clearance.

    force: per metre of width, N/m; clearance: radial, m; modulus: plane strain, E / (1 - nu^2),
    Pa. Raises ModelError for numbers out of range.
    """
    require_positive("force", force, "N/m")
    require_not_negative("clearance", clearance, "m")
    require_positive("modulus", modulus, "Pa")
    wanted = np.pi * modulus * clearance / force
    square = brentq(lambda x: _ratio(x) - wanted, 1e-300, 1.0, xtol=1e-300, rtol=1e-14)
    return float(2.0 * np.arctan(np.sqrt(square)))


def force_of(half_angle: float, clearance: float, modulus: float) -> float:
    """Return the force per metre of width, N/m, that gives a half-angle in rad.

    Raises ModelError for an angle that no force reaches.
    """
    square = np.tan(0.5 * half_angle) ** 2
    if not (half_angle > 0.0 and _ratio(square) > 0.0):
        raise ModelError("half_angle", half_angle, "it must be between 0 and 1.26", "rad")
    return float(np.pi * modulus * clearance / _ratio(square))


def _ratio(square: float) -> float:
    """Return pi E' c / F for a squared tangent of half the half-angle."""
    return float((1.0 - np.log1p(square) - 2.0 * square**2) / (square * (1.0 + square)))


def pressure(angle: ArrayLike, half_angle: float, force: float, radius: float) -> Array:
    """Return the pressure at angles (rad) from the middle of the contact, Pa.

    force: per metre of width, N/m; radius: of the contact, m.
    """
    b2 = np.tan(0.5 * half_angle) ** 2
    y2 = np.tan(0.5 * np.asarray(angle, dtype=np.float64)) ** 2
    root = np.sqrt(np.clip(b2 - y2, 0.0, None))
    outer = np.sqrt(1.0 + b2)
    shape = 2.0 * root / (np.pi * outer * (1.0 + y2))
    shape += np.log((outer + root) / (outer - root)) / (2.0 * np.pi * b2 * (1.0 + b2))
    return np.where(y2 < b2, shape, 0.0) * force / radius
