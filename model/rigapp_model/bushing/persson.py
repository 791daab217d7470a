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
from scipy.optimize import brentq

from rigapp_model.errors import require_not_negative, require_positive


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


def _ratio(square: float) -> float:
    """Return pi E' c / F for a squared tangent of half the half-angle."""
    return float((1.0 - np.log1p(square) - 2.0 * square**2) / (square * (1.0 + square)))
