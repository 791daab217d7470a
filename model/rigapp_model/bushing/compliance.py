"""Compliance of the bushing's inner surface: nodal displacements per unit nodal force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.bushing.element import Plane
from rigapp_model.bushing.sector import SectorMesh, surface_spectrum

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SurfaceCompliance:
    """Compliance between selected surface nodes, in polar components, per metre of width.

    ``nodes``: their indices on the ring, (N,); ``axis``: unit vectors (N, 2) in the radial
    direction of each node; ``polar``: (4, N, N), m^2/N, radial by radial, radial by tangential,
    tangential by radial, tangential by tangential: entry [1, i, j] is the radial displacement at
    i per tangential unit force at j. ``ends``: positions in ``nodes`` whose neighbour on the ring
    is not selected.
    """

    nodes: NDArray[np.int64]
    axis: Array
    polar: Array
    ends: NDArray[np.int64]


def surface_angles(sectors: int) -> Array:
    """Return the polar angles of the 2 x sectors surface nodes, rad, from -pi; 0 is a node.

    With an even number of sectors, the node at 0 is a corner node.
    """
    return np.pi * (np.arange(2 * sectors) - sectors) / sectors


def arc_ends(nodes: NDArray[np.int64], around: int) -> NDArray[np.int64]:
    """Return the positions in ``nodes`` whose neighbour on the ring is not in ``nodes``."""
    inside = np.isin(np.stack([nodes - 1, nodes + 1]) % around, nodes)
    return np.flatnonzero(~inside.all(axis=0))


def circular_compliance(
    inner: float,
    outer: float,
    youngs_modulus: float,
    poissons_ratio: float,
    plane: Plane = "strain",
    mesh: SectorMesh | None = None,
    nodes: NDArray[np.int64] | None = None,
) -> SurfaceCompliance:
    """Return the compliance of a circular bushing between surface nodes (all if None).

    Lengths in m, the modulus in Pa. Raises ModelError for impossible radii or materials.
    """
    mesh = mesh or SectorMesh()
    kernel = surface_spectrum(inner, outer, youngs_modulus, poissons_ratio, plane, mesh)
    sectors = mesh.sectors
    if nodes is None:
        nodes = np.arange(2 * sectors)
    angle = surface_angles(sectors)[nodes]
    # Node 0 is at -pi, which is a sector boundary for any number of sectors.
    sector, side = nodes // 2, nodes % 2
    distance = (sector[:, None] - sector[None, :]) % sectors
    polar = np.empty((4, len(nodes), len(nodes)))
    i, j = side[:, None], side[None, :]
    polar[0] = kernel[i, 0, j, 0, distance]
    polar[1] = kernel[i, 0, j, 1, distance]
    polar[2] = polar[1].T
    polar[3] = kernel[i, 1, j, 1, distance]
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return SurfaceCompliance(nodes, axis, polar, arc_ends(nodes, 2 * sectors))
