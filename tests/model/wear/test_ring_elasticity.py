"""The condensed ring against closed forms and against the same ring by sparse factorisation."""

from __future__ import annotations

import numpy as np
import pytest
from factorised_ring import general_compliance, ring_mesh

from rigapp_model.bushing.compliance import circular_compliance, surface_angles
from rigapp_model.bushing.contact import simpson_weights
from rigapp_model.bushing.element import NODES, elasticity, shape_gradients, stiffness
from rigapp_model.bushing.ring import Ring
from rigapp_model.bushing.sector import SectorMesh, suitable_mesh
from rigapp_model.errors import ModelError

E, NU, A, B = 500e6, 0.38, 0.010, 0.020


def lame_displacement(plane: str) -> float:
    """Return the inner surface's radial displacement by unit pressure, rim fixed (Lamé)."""
    e, nu = (E / (1 - NU**2), NU / (1 - NU)) if plane == "strain" else (E, NU)
    # u = c1 r + c2 / r with u(B) = 0 and radial stress -1 at A.
    matrix = np.array([[B, 1 / B], [e / (1 - nu), -e / (1 + nu) / A**2]])
    c1, c2 = np.linalg.solve(matrix, [0.0, -1.0])
    return float(c1 * A + c2 / A)


@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_uniform_pressure_moves_the_surface_as_lame_says(plane: str) -> None:
    mesh = SectorMesh(90, 8, 10.0)
    compliance = circular_compliance(A, B, E, NU, plane, mesh)
    angle = surface_angles(90)
    weights = simpson_weights(A * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    moved = compliance.polar[0] @ weights
    assert moved == pytest.approx(lame_displacement(plane), rel=2e-4)
    assert np.abs(compliance.polar[1].T @ weights).max() < 2e-4 * moved.max()


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("mesh", [SectorMesh(24, 4, 10.0), SectorMesh(31, 5, 3.0)])
@pytest.mark.parametrize("ratio", [0.3, 0.49])
def test_both_paths_agree(plane: str, mesh: SectorMesh, ratio: float) -> None:
    angle = surface_angles(mesh.sectors)
    circle = A * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    condensed = circular_compliance(A, B, E, ratio, plane, mesh)
    factorised = general_compliance(circle, B, E, ratio, plane, mesh)
    scale = np.abs(condensed.polar[0]).max()
    assert np.abs(condensed.polar - factorised.polar).max() < 1e-11 * scale


def test_worn_surface_is_softer_where_the_wall_is_thinner_by_little() -> None:
    mesh = SectorMesh(60, 6, 10.0)
    angle = surface_angles(60)
    depth = 0.3e-3 * np.clip(1.0 - np.abs(angle) / 0.5, 0.0, None)
    worn = (A + depth)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    plain = circular_compliance(A, B, E, NU, mesh=mesh)
    other = general_compliance(worn, B, E, NU, mesh=mesh)
    middle = 60
    assert other.polar[0, middle, middle] == pytest.approx(plain.polar[0, middle, middle], rel=0.05)
    assert other.polar[0, middle, middle] != pytest.approx(plain.polar[0, middle, middle], rel=1e-6)


def test_compliance_is_symmetric_and_definite() -> None:
    compliance = circular_compliance(A, B, E, NU, mesh=SectorMesh(24, 4, 10.0))
    rr, rt, tr, tt = compliance.polar
    whole = np.block([[rr, rt], [tr, tt]])
    assert np.allclose(whole, whole.T, rtol=0.0, atol=1e-13 * whole.max())
    assert np.linalg.eigvalsh(whole).min() > 0.0


def test_chosen_nodes_have_the_whole_rings_compliance() -> None:
    mesh = SectorMesh(30, 4, 10.0)
    nodes = np.array([0, 1, 2, 57, 58, 59, 20])
    part = circular_compliance(A, B, E, NU, mesh=mesh, nodes=nodes)
    whole = circular_compliance(A, B, E, NU, mesh=mesh)
    assert np.array_equal(part.polar, whole.polar[:, nodes][:, :, nodes])
    assert list(nodes[part.ends]) == [2, 57, 20]
    assert whole.ends.size == 0


def test_surface_nodes_between_corners_are_on_the_circle() -> None:
    angle = surface_angles(20)
    circle = A * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    points, elements = ring_mesh(circle, B, SectorMesh(20, 3, 5.0))
    inner = np.unique(elements[:20][:, [0, 3, 7]])
    outer = np.unique(elements[-20:][:, [1, 2, 5]])
    assert np.hypot(*points[inner].T) == pytest.approx(np.full(40, A), rel=1e-14)
    assert np.hypot(*points[outer].T) == pytest.approx(np.full(40, B), rel=1e-14)


def test_element_carries_constant_strain_exactly() -> None:
    corners = NODES * [0.5, 0.7] + 0.05 * NODES[:, ::-1] ** 2
    matrix = elasticity(E, NU, "strain")
    strain = np.array([[2e-3, 1e-3], [3e-3, -1e-3]])
    moved = (corners @ strain.T).ravel()
    stress = matrix @ [strain[0, 0], strain[1, 1], strain[0, 1] + strain[1, 0]]
    area = sum(
        abs(np.linalg.det(shape_gradients(x, y) @ corners))
        for x in (-(3**-0.5), 3**-0.5)
        for y in (-(3**-0.5), 3**-0.5)
    )
    energy = 0.5 * area * stress @ [strain[0, 0], strain[1, 1], strain[0, 1] + strain[1, 0]]
    found = stiffness(corners[None], matrix)[0]
    assert 0.5 * moved @ found @ moved == pytest.approx(energy, rel=1e-12)
    rigid = np.stack([np.ones(8), np.zeros(8)], axis=1).ravel()
    assert np.abs(found @ rigid).max() < 1e-10 * np.abs(found).max()


def test_layers_are_graded() -> None:
    steps = np.diff(SectorMesh(180, 8, 10.0).radii(A, B))
    assert steps[-1] / steps[0] == pytest.approx(10.0)
    assert steps.sum() == pytest.approx(B - A)
    for sectors in (60, 720, 5760):
        mesh = suitable_mesh(sectors, A, B)
        first = np.diff(mesh.radii(A, B))[0]
        assert first < 2.0 * 2.0 * np.pi * A / sectors or sectors > 5000


@pytest.mark.parametrize(
    ("make", "word"),
    [
        (lambda: SectorMesh(sectors=4), "sectors"),
        (lambda: SectorMesh(layers=0), "layers"),
        (lambda: SectorMesh(grading=0.5), "grading"),
        (lambda: SectorMesh().radii(0.02, 0.01), "bushing radius"),
        (lambda: elasticity(0.0, 0.3), "youngs modulus"),
        (lambda: elasticity(1e9, 0.5), "poissons ratio"),
        (lambda: elasticity(1e9, 0.3, "thick"), "plane"),  # type: ignore[arg-type]
        (lambda: Ring(0.01, 0.02, 0.011, E, NU), "radii"),
        (lambda: general_compliance(np.zeros((4, 2)), B, E, NU), "surface"),
        (
            lambda: general_compliance(Ring(0.03, 0.04, 0.02, E, NU).circle(180), B, E, NU),
            "profile",
        ),
    ],
)
def test_impossible_rings_are_refused_in_words(make, word: str) -> None:
    with pytest.raises(ModelError, match=word):
        make()
