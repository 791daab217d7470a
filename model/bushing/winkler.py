"""The bushing as a bed of springs (Winkler): quick, and 26 % low in early pressure.

An alternative to the elastic ring where only the end of life counts: there geometry, not
elasticity, decides the pressure.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from model.bushing.compliance import SurfaceCompliance, arc_ends, surface_angles
from model.bushing.ring import Ring
from model.bushing.sector import SectorMesh

Array = NDArray[np.float64]


def foundation_modulus(ring: Ring) -> float:
    """Return pressure per displacement, Pa/m: a layer on its rim that cannot move sideways.

    E (1 - nu) / ((1 + nu) (1 - 2 nu)) / thickness in plane strain; E / (1 - nu^2) / thickness in
    plane stress.
    """
    nu = ring.poissons_ratio
    if ring.plane == "stress":
        return ring.youngs_modulus / (1.0 - nu * nu) / ring.wall
    stiff = ring.youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu))
    return stiff / ring.wall


def winkler_compliance(
    ring: Ring, mesh: SectorMesh, weights: ArrayLike, nodes: NDArray[np.int64] | None = None
) -> SurfaceCompliance:
    """Return the compliance of the bed of springs between surface nodes (all if None).

    weights: the length of surface that each node stands for, (2 x sectors,), m. Tangentially the
    bed gives way like radially, so that the same springs act along any normal.
    """
    around = 2 * mesh.sectors
    if nodes is None:
        nodes = np.arange(around)
    angle = surface_angles(mesh.sectors)[nodes]
    polar = np.zeros((4, len(nodes), len(nodes)))
    each = np.arange(len(nodes))
    polar[0, each, each] = 1.0 / (foundation_modulus(ring) * np.asarray(weights)[nodes])
    polar[3] = polar[0]
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return SurfaceCompliance(nodes, axis, polar, arc_ends(nodes, around))
