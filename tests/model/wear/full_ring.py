"""The same contact by a general finite element library, with nothing condensed.

A whole ring of 8-node quadrilaterals in scikit-fem, the whole sparse system with the pin's
displacement and the active contact conditions in every iteration. The force is along x.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import bmat, csr_matrix
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementQuadS2, ElementVector, MeshQuad, MeshQuad2, asm
from skfem.models.elasticity import lame_parameters, linear_elasticity


def ring_mesh(sectors, levels):
    """Return a ring with curved elements: mid-side nodes on the circles."""
    angle = -np.pi + 2.0 * np.pi * np.arange(sectors) / sectors
    lines, around = len(levels), np.arange(sectors)
    points = np.array([[r * f(a) for a in angle for r in levels] for f in (np.cos, np.sin)])
    corner = (around[:, None] * lines + np.arange(lines - 1)).ravel()
    after = ((around[:, None] + 1) % sectors * lines + np.arange(lines - 1)).ravel()
    flat = MeshQuad(points, np.array([corner, corner + 1, after + 1, after]))
    curved = MeshQuad2.from_mesh(flat)
    radius = np.hypot(*flat.p)
    places = curved.doflocs.copy()
    for numbers, ends in (
        (flat.nvertices + np.arange(flat.nfacets), flat.facets),
        (flat.nvertices + flat.nfacets + np.arange(flat.nelements), flat.t),
    ):
        places[:, numbers] *= radius[ends].mean(axis=0) / np.hypot(*places[:, numbers])
    return MeshQuad2(places, curved.t)


def assemble(inner, outer, youngs_modulus, poissons_ratio, sectors, levels):
    """Return stiffness, the surface's x and y dofs by angle, free dofs, and dof positions."""
    basis = Basis(ring_mesh(sectors, levels), ElementVector(ElementQuadS2()), intorder=5)
    stiffness = asm(linear_elasticity(*lame_parameters(youngs_modulus, poissons_ratio)), basis)
    x, y = basis.doflocs
    second = np.concatenate([basis.nodal_dofs[1::2].ravel(), basis.facet_dofs[1::2].ravel()])
    component = np.zeros(len(x), dtype=int)
    component[second] = 1
    distance = np.hypot(x, y)
    rim = np.flatnonzero(np.isclose(distance, outer, rtol=1e-6))
    surface = np.flatnonzero(np.isclose(distance, inner, rtol=1e-6))
    pairs = []
    for c in (0, 1):
        mine = surface[component[surface] == c]
        turn = np.arctan2(y[mine], x[mine])
        turn[turn > np.pi - 1e-9] -= 2.0 * np.pi
        pairs.append(mine[np.argsort(turn)])
    return stiffness.tocsr(), pairs, np.setdiff1d(np.arange(len(x)), rim), (x, y)


def solve_full(inner, outer, pin_radius, youngs_modulus, poissons_ratio, force, sectors, levels):
    """Return angles and nodal normal forces of the surface, and the pin's place on x."""
    stiffness, (along, across), free, (x, y) = assemble(
        inner, outer, youngs_modulus, poissons_ratio, sectors, levels
    )
    number = np.full(stiffness.shape[0], -1)
    number[free] = np.arange(len(free))
    stiffness = stiffness[free][:, free]
    px, py = x[along], y[along]
    angle = np.arctan2(py, px)
    pin = inner - pin_radius
    active = np.abs(angle) < 0.2
    for _ in range(60):
        nx, ny = px - pin, py.copy()
        size = np.hypot(nx, ny)
        nx, ny = nx / size, ny / size
        gap = size - pin_radius
        chosen = np.flatnonzero(active)
        each = np.arange(len(chosen))
        normals = csr_matrix(
            (
                np.concatenate([nx[chosen], ny[chosen]]),
                (
                    np.concatenate([each, each]),
                    number[np.concatenate([along[chosen], across[chosen]])],
                ),
            ),
            shape=(len(chosen), len(free)),
        )
        pull = csr_matrix(nx[chosen][:, None])
        system = bmat(
            [[stiffness, -normals.T, None], [normals, None, -pull], [None, pull.T, None]],
            format="csc",
        )
        answer = spsolve(system, np.concatenate([np.zeros(len(free)), -gap[chosen], [force]]))
        moved, pressed, move = answer[: len(free)], answer[len(free) : -1], answer[-1]
        pin += move
        full = np.zeros(len(number))
        full[free] = moved
        left = np.hypot(px - pin, py) - pin_radius + nx * full[along] + ny * full[across]
        keep = active.copy()
        keep[chosen[pressed < 0.0]] = False
        keep |= ~active & (left < -1e-12)
        if np.array_equal(keep, active) and abs(move) < 1e-13:
            break
        active = keep
    else:
        raise AssertionError("the reference contact did not settle")
    nodal = np.zeros(len(angle))
    nodal[chosen] = pressed
    return angle, nodal, pin
