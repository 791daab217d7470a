"""A whole ring of any inner profile, by sparse factorisation."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from rigapp_model.bushing.compliance import SurfaceCompliance, arc_ends, surface_angles
from rigapp_model.bushing.element import Plane, elasticity, integration_points, stiffness
from rigapp_model.bushing.sector import SectorMesh
from rigapp_model.errors import ModelError

Array = NDArray[np.float64]


def ring_mesh(surface: Array, outer: float, mesh: SectorMesh) -> tuple[Array, NDArray[np.int64]]:
    """Return node positions (nodes, 2) and the elements' nodes (elements, 8) of a ring.

    surface: positions of the inner surface nodes (2 x sectors, 2), in the order of
    surface_angles(); every second one from the first is a corner. Nodes stand on straight lines
    from the surface to the rim, graded like the sector's; those on the rim come last.
    """
    around, layers = 2 * mesh.sectors, mesh.layers
    if surface.shape != (around, 2):
        raise ModelError("surface", surface.shape, f"give ({around}, 2) positions for this mesh")
    if float(np.hypot(surface[:, 0], surface[:, 1]).max()) >= outer:
        raise ModelError("profile", "through the wall", "the bushing is worn through")
    angle = surface_angles(mesh.sectors)
    rim = outer * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    share = mesh.radii(1.0, 2.0) - 1.0
    levels = np.empty(2 * layers + 1)
    levels[0::2] = share
    levels[1::2] = 0.5 * (share[:-1] + share[1:])
    full = surface[None] + levels[:, None, None] * (rim - surface)[None]
    number = np.full((2 * layers + 1, around), -1)
    used = np.ones(number.shape, dtype=bool)
    used[1::2, 1::2] = False
    number[used] = np.arange(used.sum())
    column = np.arange(0, around, 2)
    middle, after = column + 1, (column + 2) % around
    elements = [
        np.stack(
            [
                number[low, column],
                number[low + 2, column],
                number[low + 2, after],
                number[low, after],
                number[low + 1, column],
                number[low + 2, middle],
                number[low + 1, after],
                number[low, middle],
            ],
            axis=1,
        )
        for low in range(0, 2 * layers, 2)
    ]
    return full[used], np.concatenate(elements)


def general_compliance(
    surface: Array,
    outer: float,
    youngs_modulus: float,
    poissons_ratio: float,
    plane: Plane = "strain",
    mesh: SectorMesh | None = None,
    nodes: NDArray[np.int64] | None = None,
) -> SurfaceCompliance:
    """Compute the compliance between the given surface nodes of a ring of any inner profile.

    surface: (2 x sectors, 2) positions, m; the rim is a fixed circle of radius ``outer``. Agrees
    with circular_compliance() to rounding for a circle. Takes of the order of a second for
    180 x 8 elements. Raises ModelError when the profile reaches the rim or folds an element.
    """
    mesh = mesh or SectorMesh()
    points, elements = ring_mesh(surface, outer, mesh)
    free = 2 * (len(points) - 2 * mesh.sectors)
    dofs = (2 * elements[:, :, None] + np.arange(2)).reshape(len(elements), 16)
    matrix = elasticity(youngs_modulus, poissons_ratio, plane)
    blocks = stiffness(points[elements], matrix, integration_points(poissons_ratio, plane))
    rows = np.repeat(dofs, 16, axis=1).ravel()
    columns = np.tile(dofs, (1, 16)).ravel()
    inside = (rows < free) & (columns < free)
    system = csc_matrix(
        (blocks.ravel()[inside], (rows[inside], columns[inside])), shape=(free, free)
    )
    if nodes is None:
        nodes = np.arange(2 * mesh.sectors)
    angle = surface_angles(mesh.sectors)[nodes]
    cosine, sine = np.cos(angle), np.sin(angle)
    count = len(nodes)
    load = np.zeros((free, 2 * count))
    each = np.arange(count)
    load[2 * nodes, each], load[2 * nodes + 1, each] = cosine, sine
    load[2 * nodes, count + each], load[2 * nodes + 1, count + each] = -sine, cosine
    moved = splu(system, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(load)
    x, y = moved[2 * nodes], moved[2 * nodes + 1]
    radial = cosine[:, None] * x + sine[:, None] * y
    tangential = cosine[:, None] * y - sine[:, None] * x
    polar = np.stack(
        [radial[:, :count], radial[:, count:], tangential[:, :count], tangential[:, count:]]
    )
    axis = np.stack([cosine, sine], axis=1)
    return SurfaceCompliance(nodes, axis, polar, arc_ends(nodes, 2 * mesh.sectors))
