"""The 8-node quadrilateral of plane elasticity."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.errors import ModelError, require_finite, require_positive

Array = NDArray[np.float64]
Plane = Literal["strain", "stress"]

# Corners counter-clockwise from (-1, -1), then the mid-side nodes in the same order.
NODES = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [0, -1], [1, 0], [0, 1], [-1, 0]], float)


def elasticity(youngs_modulus: float, poissons_ratio: float, plane: Plane = "strain") -> Array:
    """Return the 3 x 3 matrix from strains (xx, yy, 2xy) to stresses, Pa.

    Raises ModelError for a modulus that is not positive, a Poisson's ratio outside [0, 0.5) or
    an unknown plane state.
    """
    require_positive("youngs_modulus", youngs_modulus, "Pa")
    require_finite("poissons_ratio", poissons_ratio)
    if not 0.0 <= poissons_ratio < 0.5:
        raise ModelError(
            "poissons_ratio", poissons_ratio, say("it must be at least 0 and below 0.5")
        )
    if plane not in ("strain", "stress"):
        raise ModelError("plane", plane, say("choose strain or stress"))
    nu = poissons_ratio / (1.0 - poissons_ratio) if plane == "strain" else poissons_ratio
    modulus = youngs_modulus / (1.0 - poissons_ratio**2) if plane == "strain" else youngs_modulus
    factor = modulus / (1.0 - nu * nu)
    return factor * np.array([[1.0, nu, 0.0], [nu, 1.0, 0.0], [0.0, 0.0, 0.5 * (1.0 - nu)]])


def shape_gradients(xi: float, eta: float) -> Array:
    """Return the derivatives of the eight shape functions by xi and eta, shape (2, 8)."""
    gradients = np.empty((2, 8))
    for a, (x, y) in enumerate(NODES):
        if a < 4:
            gradients[0, a] = 0.25 * x * (1.0 + y * eta) * (2.0 * x * xi + y * eta)
            gradients[1, a] = 0.25 * y * (1.0 + x * xi) * (2.0 * y * eta + x * xi)
        elif x == 0.0:
            gradients[0, a] = -xi * (1.0 + y * eta)
            gradients[1, a] = 0.5 * y * (1.0 - xi * xi)
        else:
            gradients[0, a] = 0.5 * x * (1.0 - eta * eta)
            gradients[1, a] = -eta * (1.0 + x * xi)
    return gradients


def _table(points: int) -> list[tuple[float, Array]]:
    """Return weight and shape gradients at each point of a Gauss rule."""
    points_1d, weights = np.polynomial.legendre.leggauss(points)
    rule = list(zip(points_1d, weights, strict=True))
    return [(wx * wy, shape_gradients(x, y)) for x, wx in rule for y, wy in rule]


# Poisson's ratio above which full integration locks in plane strain.
LOCKING_RATIO = 0.46
_TABLES = {points: _table(points) for points in (2, 3)}


def integration_points(poissons_ratio: float, plane: Plane = "strain") -> int:
    """Return the number of Gauss points per side: 3, or 2 where 3 would lock.

    For nearly incompressible plane strain, full integration gives pressures that alternate from
    node to node (24 % at a ratio of 0.499); below LOCKING_RATIO it is more accurate.
    """
    return 2 if plane == "strain" and poissons_ratio > LOCKING_RATIO else 3


def stiffness(corners: Array, matrix: Array, points: int = 3) -> Array:
    """Return element stiffness matrices per metre of width, shape (elements, 16, 16).

    corners: node positions (elements, 8, 2), in the order of NODES; matrix: from elasticity().
    Degrees of freedom: x and y of each node in turn. points: Gauss points per side, 3 (full) or
    2 (reduced). Raises ModelError for a folded element.
    """
    total = np.zeros((len(corners), 16, 16))
    strain = np.zeros((len(corners), 3, 16))
    for weight, gradients in _TABLES[points]:
        jacobian = gradients @ corners
        determinant = np.linalg.det(jacobian)
        if determinant.min() <= 0.0:
            raise ModelError(
                "mesh",
                "folded",
                say("an element has no area; the profile is too deep for the mesh"),
            )
        local = np.linalg.solve(jacobian, np.broadcast_to(gradients, (len(corners), 2, 8)))
        strain[:, 0, 0::2] = strain[:, 2, 1::2] = local[:, 0]
        strain[:, 1, 1::2] = strain[:, 2, 0::2] = local[:, 1]
        stress = matrix @ strain
        scale = (weight * determinant)[:, None, None]
        total += np.swapaxes(strain, 1, 2) @ (scale * stress)
    return total
