"""The same contact by a general finite element library, with nothing condensed.

Half a ring of 8-node quadrilaterals in scikit-fem, symmetry on the x axis, the whole sparse
system with the pin's displacement and the active contact conditions in every iteration.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import bmat, csr_matrix
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementQuadS2, ElementVector, MeshQuad, MeshQuad2, asm
from skfem.models.elasticity import lame_parameters, linear_elasticity


def assemble(inner, outer, youngs_modulus, poissons_ratio, half_sectors, levels):
    """Return stiffness and the surface's x, y dofs by angle, and the free dofs."""
    angle = np.linspace(0.0, np.pi, half_sectors + 1)
    flat = MeshQuad2.from_mesh(MeshQuad.init_tensor(levels, angle))
    radius, turn = flat.doflocs
    ring = MeshQuad2(np.stack([radius * np.cos(turn), radius * np.sin(turn)]), flat.t)
    basis = Basis(ring, ElementVector(ElementQuadS2()), intorder=5)
    stiffness = asm(linear_elasticity(*lame_parameters(youngs_modulus, poissons_ratio)), basis)
    x, y = basis.doflocs
    distance = np.hypot(x, y)
    rim = np.flatnonzero(np.isclose(distance, outer, rtol=1e-6))
    component = np.zeros(len(x), dtype=int)
    component[_second_components(basis)] = 1
    on_axis = np.flatnonzero(np.isclose(y, 0.0, atol=1e-9) & (component == 1))
    fixed = np.union1d(rim, on_axis)
    surface = np.flatnonzero(np.isclose(distance, inner, rtol=1e-6))
    pairs = []
    for c in (0, 1):
        mine = surface[component[surface] == c]
        pairs.append(mine[np.argsort(np.arctan2(y[mine], x[mine]))])
    return stiffness.tocsr(), pairs, np.setdiff1d(np.arange(len(x)), fixed), (x, y)


def _second_components(basis):
    """Return all dofs of the y component."""
    return np.unique(
        np.concatenate([basis.nodal_dofs[1::2].ravel(), basis.facet_dofs[1::2].ravel()])
    )


def solve_full(inner, outer, pin_radius, youngs_modulus, poissons_ratio, force, half, levels):
    """Return angles, nodal normal forces of the whole ring's half, and the pin's place on x."""
    stiffness, (along, across), free, (x, y) = assemble(
        inner, outer, youngs_modulus, poissons_ratio, half, levels
    )
    number = np.full(stiffness.shape[0], -1)
    number[free] = np.arange(len(free))
    stiffness = stiffness[free][:, free]
    px, py = x[along], y[along]
    angle = np.arctan2(py, px)
    pin = inner - pin_radius
    active = angle < 0.2
    for _ in range(60):
        nx, ny = px - pin, py.copy()
        size = np.hypot(nx, ny)
        nx, ny = nx / size, ny / size
        gap = size - pin_radius
        chosen = np.flatnonzero(active)
        rows, columns, values = [], [], []
        for k, node in enumerate(chosen):
            for dof, part in ((along[node], nx[node]), (across[node], ny[node])):
                if number[dof] >= 0:
                    rows.append(k)
                    columns.append(number[dof])
                    values.append(part)
        normals = csr_matrix((values, (rows, columns)), shape=(len(chosen), len(free)))
        pull = csr_matrix(nx[chosen][:, None])
        system = bmat(
            [[stiffness, -normals.T, None], [normals, None, -pull], [None, pull.T, None]],
            format="csc",
        )
        right = np.concatenate([np.zeros(len(free)), -gap[chosen], [0.5 * force]])
        answer = spsolve(system, right)
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
    nodal[0] *= 2.0
    return angle, nodal, pin
