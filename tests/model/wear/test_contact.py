"""One contact: reference numbers, closed form, the conditions of contact, and refusals."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp_model.bushing.compliance import circular_compliance, surface_angles
from rigapp_model.bushing.contact import ContactError, simpson_weights, solve_contact
from rigapp_model.bushing.linear import factorise, invert, substitute
from rigapp_model.bushing.ring import (
    Ring,
    arc_nodes,
    persson_half_angle,
    pressure_distribution,
    sectors_at_least,
    winkler_compliance,
)
from rigapp_model.bushing.sector import SectorMesh

FORCE = 110.0 / 0.0131


def force_of(half_angle: float, clearance: float, modulus: float) -> float:
    """Return the force per metre of width, N/m, that gives a half-angle in rad (Persson)."""
    b2 = np.tan(0.5 * half_angle) ** 2
    share = np.pi * b2 * (1.0 + b2) / (1.0 - np.log1p(b2) - 2.0 * b2**2)
    return float(modulus * clearance * share)


def persson_pressure(angle: np.ndarray, half_angle: float, force: float, radius: float):
    """Return Persson's pressure (Pa) at angles (rad) from the middle; force in N/m, radius in m."""
    b2 = np.tan(0.5 * half_angle) ** 2
    y2 = np.tan(0.5 * angle) ** 2
    root = np.sqrt(np.clip(b2 - y2, 0.0, None))
    outer = np.sqrt(1.0 + b2)
    shape = 2.0 * root / (np.pi * outer * (1.0 + y2))
    shape += np.log((outer + root) / (outer - root)) / (2.0 * np.pi * b2 * (1.0 + b2))
    return np.where(y2 < b2, shape, 0.0) * force / radius


def test_pressure_agrees_with_the_reference(ring, pressure_reference) -> None:
    angle, exact = np.radians(pressure_reference[:, 0]), 1e6 * pressure_reference[:, 1]
    found = pressure_distribution(ring, (FORCE, 0.0))
    pressure = np.interp(angle, found.angle, found.pressure)
    assert pressure[0] == pytest.approx(exact[0], rel=3e-3)
    inside = angle <= 0.85 * found.half_angle
    assert pressure[inside] == pytest.approx(exact[inside], rel=1e-2)
    assert found.pin[0] == pytest.approx(0.519386e-3, abs=1e-7)
    assert found.contact.force.sum() == pytest.approx(8435.910, rel=1e-4)
    assert np.degrees(found.half_angle) == pytest.approx(10.3, abs=0.3)


def test_coarse_mesh_keeps_the_peak(ring, pressure_reference) -> None:
    found = pressure_distribution(ring, (FORCE, 0.0), sectors=180)
    assert found.pressure.max() == pytest.approx(1e6 * pressure_reference[0, 1], rel=3e-3)


@pytest.mark.sampled
@pytest.mark.parametrize("degrees", [15.0, 30.0, 50.0])
def test_incompressible_plate_follows_persson(degrees: float) -> None:
    ratio, inner, clearance = 0.49999, 0.01, 1e-7
    wanted = np.radians(degrees)
    modulus = 1e9 / (1.0 - ratio**2)
    force = force_of(wanted, clearance, modulus)
    mesh = SectorMesh(1440, 80, 1e8)
    nodes = arc_nodes(1440, 0.0, 1.3 * wanted)
    compliance = circular_compliance(inner, 1e4 * inner, 1e9, ratio, mesh=mesh, nodes=nodes)
    angle = surface_angles(1440)
    circle = inner * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    found = solve_contact(compliance, circle[nodes], inner - clearance, (force, 0.0))
    pressure = found.force / simpson_weights(circle)[nodes]
    exact = persson_pressure(angle[nodes], wanted, force, inner)
    # Simpson's weights make corners and mid-side nodes differ by a little: their mean counts.
    smooth = np.convolve(pressure, [0.25, 0.5, 0.25], mode="same")
    middle = np.abs(angle[nodes]) < 0.8 * wanted
    assert smooth[middle] == pytest.approx(exact[middle], rel=1e-4)


def test_persson_is_in_balance_and_narrow_contacts_are_hertzian() -> None:
    for degrees in (5.0, 40.0, 70.0):
        half = np.radians(degrees)
        angle = np.linspace(-half, half, 20001)
        pressure = persson_pressure(angle, half, 3.0, 0.5)
        assert np.trapezoid(0.5 * pressure * np.cos(angle), angle) == pytest.approx(3.0, rel=1e-5)
    force, clearance, modulus, radius = 1.0, 1e-4, 1e9, 0.01
    hertz = np.sqrt(4.0 * force * radius**2 / clearance / (np.pi * modulus)) / radius
    assert persson_half_angle(force, clearance, modulus) == pytest.approx(hertz, rel=1e-3)
    half = persson_half_angle(1e5, clearance, modulus)
    assert force_of(half, clearance, modulus) == pytest.approx(1e5, rel=1e-9)
    assert persson_half_angle(1.0, 0.0, modulus) == pytest.approx(1.26, abs=0.01)


@settings(max_examples=40, deadline=None)
@given(
    force=st.floats(1.0, 3e5),
    direction=st.floats(-np.pi, np.pi),
    clearance=st.floats(1e-6, 2e-3),
    ratio=st.floats(0.0, 0.49),
)
def test_conditions_of_contact_hold(force, direction, clearance, ratio) -> None:
    ring = Ring(0.010, 0.018, 0.010 - clearance, 2e9, ratio)
    load = force * np.array([np.cos(direction), np.sin(direction)])
    found = pressure_distribution(ring, load)
    contact = found.contact
    surface = ring.circle(len(found.angle) // 2)[found.nodes]
    away = surface - contact.pin
    normal = away / np.hypot(*away.T)[:, None]
    assert contact.force.min() >= 0.0
    assert contact.force @ normal == pytest.approx(load, abs=1e-6 * force)
    sunk = ring.indentation(surface, contact.pin)
    assert contact.gap.min() >= -1e-6 * sunk
    assert np.abs(contact.gap[contact.force > 0.0]).max() <= 1e-6 * sunk
    assert contact.force.sum() >= force * (1.0 - 1e-9)


def test_solution_turns_with_the_force(ring) -> None:
    along = pressure_distribution(ring, (FORCE, 0.0), sectors=180)
    for quarter in range(1, 4):
        turn = 0.5 * np.pi * quarter
        load = FORCE * np.array([np.cos(turn), np.sin(turn)])
        found = pressure_distribution(ring, load, sectors=180)
        assert np.roll(found.pressure, -90 * quarter) == pytest.approx(
            along.pressure, abs=1e-6 * along.pressure.max()
        )


def test_warm_start_changes_nothing(ring) -> None:
    mesh = SectorMesh()
    compliance = circular_compliance(ring.inner, ring.outer, 500e6, 0.38, mesh=mesh)
    circle = ring.circle(180)
    cold = solve_contact(compliance, circle, ring.pin_radius, (FORCE, 500.0))
    other = solve_contact(compliance, circle, ring.pin_radius, (0.5 * FORCE, -2000.0))
    warm = solve_contact(compliance, circle, ring.pin_radius, (FORCE, 500.0), start=other)
    assert warm.force == pytest.approx(cold.force, abs=1e-7 * FORCE)
    assert np.array_equal(other.touching, other.force > 0.0)


def test_without_clearance_half_the_bushing_carries() -> None:
    neat = Ring(0.010, 0.020, 0.010, 500e6, 0.38)
    found = pressure_distribution(neat, (FORCE, 0.0))
    assert np.degrees(found.half_angle) == pytest.approx(86.0, abs=5.0)


def test_winkler_is_a_quarter_low_in_early_pressure(ring) -> None:
    circle = ring.circle(360)
    bed = winkler_compliance(ring.foundation_modulus, ring.mesh(360), simpson_weights(circle))
    found = solve_contact(bed, circle, ring.pin_radius, (FORCE, 0.0))
    peak = float((found.force / simpson_weights(circle)).max())
    assert peak / 2.9432e6 == pytest.approx(0.74, abs=0.01)


def test_weights_are_simpsons_on_the_current_arc() -> None:
    circle = Ring(0.01, 0.02, 0.0095, 1e9, 0.3).circle(90)
    weights = simpson_weights(circle)
    step = 2.0 * 0.01 * np.sin(np.pi / 180)
    assert weights[0::2] == pytest.approx(np.full(90, 2.0 / 3.0 * step))
    assert weights[1::2] == pytest.approx(np.full(90, 4.0 / 3.0 * step))
    assert simpson_weights(1.5 * circle) == pytest.approx(1.5 * weights)


@pytest.mark.parametrize(
    ("force", "words"),
    [
        ((0.0, 0.0), "finite force above 0"),
        ((np.nan, 0.0), "finite force above 0"),
        ((1e7, 0.0), "go through the wall of 10 mm"),
        ((4e6, 0.0), "beyond linear elasticity|found no balance"),
    ],
)
def test_loads_that_cannot_be_carried_are_refused_in_words(ring, force, words: str) -> None:
    with pytest.raises(ContactError, match=words):
        pressure_distribution(ring, force)


def test_contact_beyond_the_arc_is_refused(ring) -> None:
    nodes = arc_nodes(180, 0.0, np.radians(6.0))
    compliance = circular_compliance(ring.inner, ring.outer, 500e6, 0.38, nodes=nodes)
    with pytest.raises(ContactError, match="beyond the arc"):
        solve_contact(compliance, ring.circle(180)[nodes], ring.pin_radius, (FORCE, 0.0))
    with pytest.raises(ContactError):
        solve_contact(compliance, ring.circle(180)[nodes], ring.pin_radius, (-FORCE, 0.0))


def test_sectors_to_choose_from_are_increasing() -> None:
    chosen = [sectors_at_least(n) for n in (1, 60, 61, 180, 1000, 1e6)]
    assert chosen == sorted(chosen)
    assert all(n % 2 == 0 for n in chosen)
    assert chosen[1] == 60
    assert chosen[2] > 60


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5, 8, 11, 40])
def test_small_linear_algebra_is_that_of_a_library(size: int) -> None:
    rng = np.random.default_rng(size)
    root = rng.normal(size=(size, size))
    matrix = root @ root.T + np.eye(size)
    room = np.full((size + 3, size + 3), np.nan)
    room[:size, :size] = matrix
    assert factorise(room, size) > 0.0
    assert np.triu(room[:size, :size]) == pytest.approx(np.linalg.cholesky(matrix).T)
    rhs = rng.normal(size=(2, size + 3))
    expected = np.linalg.solve(matrix, rhs[:, :size].T).T
    substitute(room, size, rhs, 2)
    assert rhs[:, :size] == pytest.approx(expected)
    lower, inverse = np.full((2, size + 1, size + 1), np.nan)
    invert(room, size, lower, inverse)
    exact = np.linalg.inv(matrix)
    assert np.triu(inverse[:size, :size]) == pytest.approx(np.triu(exact))
    matrix[-1, -1] = -1.0
    assert not factorise(matrix, size) > 0.0
