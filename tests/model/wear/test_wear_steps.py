"""Steps of wear: reference numbers, stability, coupling of positions, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rigapp_model.bushing.contact import ArcTooSmall, simpson_weights
from rigapp_model.bushing.ring import Ring
from rigapp_model.errors import ModelError
from rigapp_model.wear.archard import largest_explicit_step, rigid_wear
from rigapp_model.wear.explicit import UnstableStep, explicit_moments, extrapolation, stable_step
from rigapp_model.wear.front import (
    Front,
    WornThrough,
    contact_pressure,
    implicit_step,
    wear_problem,
    worn_area,
)
from rigapp_model.wear.loads import CycleLoads, constant_load, gathered, loads_of_cycle, swing

WIDTH, K = 0.0131, 5.05e-13
SLIP = 2.0 * np.pi * 0.0095
LIFE = 21377.0


def constant_problem(ring: Ring, sectors: int = 180):
    """Return problem and loads of the reference case: 110 N on 13.1 mm."""
    loads = constant_load(110.0, ring.pin_radius)
    return wear_problem(ring, sectors, WIDTH, K, loads, 1.2), loads


def explicit_limit(ring: Ring, sectors: int, wear_coefficient: float = K) -> float:
    """Return the most cycles of a stable explicit step in the reference case."""
    return stable_step(ring, sectors, wear_coefficient, constant_load(110.0, ring.pin_radius))


def implicit_depth(ring: Ring, sectors: int, steps: int) -> float:
    """Return the depth in mm after the reference life in equal implicit steps."""
    problem, loads = constant_problem(ring, sectors)
    front = problem.unworn()
    for _ in range(steps):
        front = implicit_step(problem, front, loads, LIFE / steps)
    return 1e3 * float(front.depth(ring.inner).max())


def test_one_step_over_the_whole_life_is_close_and_smooth(ring, wear_reference) -> None:
    problem, loads = constant_problem(ring)
    front = implicit_step(problem, problem.unworn(), loads, LIFE)
    depth = front.depth(ring.inner)
    assert 1e3 * depth.max() == pytest.approx(wear_reference[-1, 1], rel=0.02)
    assert 1e6 * worn_area(problem, front.surface) == pytest.approx(wear_reference[-1, 2], rel=0.03)
    half = depth[180:]
    worn = half > 0.0
    assert np.all(np.diff(half[worn]) < 0.0)
    bend = np.diff(half[: int(0.8 * worn.sum())], 2)
    assert bend.max() < 0.2 * np.abs(bend).mean()
    pressure = contact_pressure(problem, front)[0]
    assert pressure.max() < 1.2 * np.sort(pressure)[-20]


def test_implicit_steps_are_of_first_order_and_extrapolate(ring, wear_reference) -> None:
    reference = wear_reference[-1, 1]
    one, two, eleven = (implicit_depth(ring, 180, n) for n in (1, 2, 11))
    assert abs(one / reference - 1.0) < 0.020
    assert abs(two / reference - 1.0) < 0.011
    assert abs(eleven / reference - 1.0) < 0.0022
    assert 2.0 * two - one == pytest.approx(reference, rel=2e-3)
    three, six = implicit_depth(ring, 180, 3), implicit_depth(ring, 180, 6)
    assert 2.0 * six - three == pytest.approx(reference, rel=3e-4)


def test_finer_mesh_needs_no_smaller_steps(ring) -> None:
    errors = []
    for sectors in (90, 180, 360):
        two, four, many = (implicit_depth(ring, sectors, n) for n in (2, 4, 32))
        errors.append(abs(2.0 * four - two - many) / many)
    assert max(errors) < 1.5 * min(errors) + 1e-3
    limits = [explicit_limit(ring, n) for n in (90, 180, 360)]
    assert limits[0] == pytest.approx(2.0 * limits[1])
    assert limits[1] == pytest.approx(2.0 * limits[2])


def test_explicit_steps_agree_below_their_limit(ring, wear_reference) -> None:
    problem, loads = constant_problem(ring, 90)
    rows = wear_reference[:5, 0]
    moments = list(explicit_moments(problem, lambda *_: loads, rows, 1.0))[1:]
    depth = {m.cycles: 1e3 * m.front.depth(ring.inner).max() for m in moments}
    for row in wear_reference[:5]:
        assert depth[row[0]] == pytest.approx(row[1], rel=5e-3)
    assert sum(m.steps for m in moments) == 3000
    assert depth[1000] == pytest.approx(wear_reference[4, 1], rel=1e-3)


def test_explicit_extrapolation_rattles_beyond_its_limit_and_is_refused(ring) -> None:
    problem, loads = constant_problem(ring, 90)
    limit = explicit_limit(ring, 90)
    expected = largest_explicit_step(np.pi * 0.010 / 90, K, SLIP, 500e6 / (1.0 - 0.38**2))
    assert limit == pytest.approx(expected)
    assert extrapolation(ring, 90, K, loads, limit).step == limit
    with pytest.raises(UnstableStep, match=f"stable up to {limit:.4g} cycles"):
        extrapolation(ring, 90, K, loads, 1.001 * limit)

    def roughness(step: float) -> float:
        rows = np.array([40.0 * step])
        *_, last = explicit_moments(problem, lambda *_: loads, rows, step)
        pressure = contact_pressure(problem, last.front)[0]
        inside = np.flatnonzero(pressure > 0.0)[3:-3]
        return float(np.abs(np.diff(pressure[inside], 2)).mean() / pressure.max())

    calm, rattling = roughness(0.5 * limit), roughness(2.0 * limit)
    assert rattling > 5.0 * calm


@pytest.mark.parametrize(("wall", "ratio"), [(0.01, 0.38), (0.0005, 0.47), (0.0003, 0.49)])
@pytest.mark.parametrize("contact", ["finite-element", "winkler"])
def test_no_wave_on_the_mesh_grows_at_the_stability_limit(ring, wall, ratio, contact) -> None:
    chosen = replace(ring, outer=ring.inner + wall, poissons_ratio=ratio, contact=contact)
    for sectors in (60, 120):
        nodes = np.arange(2 * sectors)
        root = np.sqrt(simpson_weights(chosen.circle(sectors)))
        soft = chosen.compliance(chosen.mesh(sectors), nodes).polar[0]
        stiffest = 1.0 / np.linalg.eigvalsh(root[:, None] * 0.5 * (soft + soft.T) * root).min()
        # The wear of a step by the pressure of a wave is less than twice the wave: it cannot grow.
        worn = K * SLIP * explicit_limit(chosen, sectors) * stiffest
        assert 1.0 < worn < 2.0 * (1.0 + 1e-9)


def test_rigid_pin_follows_the_closed_form(ring, wear_reference) -> None:
    cycles = wear_reference[:, 0]
    found = rigid_wear(0.010, 0.0095, 110.0 / WIDTH, K, SLIP, cycles)
    assert 1e3 * found.depth == pytest.approx(wear_reference[:, 5], rel=5e-4)
    assert 1e6 * found.area == pytest.approx(wear_reference[:, 6], rel=5e-4)
    # A bushing 50 times as stiff hardly indents: the elastic computation tends to the same.
    stiff = replace(ring, youngs_modulus=25e9)
    problem, loads = constant_problem(stiff, 360)
    front = problem.unworn()
    for n in range(24):
        front = implicit_step(problem, front, loads, LIFE * ((n + 1) ** 2 - n**2) / 24**2)
    assert 1e3 * front.depth(0.010).max() == pytest.approx(wear_reference[-1, 5], rel=2e-3)
    assert 1e6 * worn_area(problem, front.surface) == pytest.approx(wear_reference[-1, 6], rel=2e-3)


def test_worn_volume_is_archards(ring) -> None:
    problem, loads = constant_problem(ring)
    front = implicit_step(problem, problem.unworn(), loads, 10.0)
    assert front.force is not None
    grown = worn_area(problem, front.surface)
    assert grown == pytest.approx(10.0 * K * SLIP * front.force.sum(), rel=5e-3)
    assert front.force.sum() > 110.0 / WIDTH


def test_equal_positions_wear_like_one(ring) -> None:
    problem, loads = constant_problem(ring)
    single = implicit_step(problem, problem.unworn(), loads, 5000.0)
    split = CycleLoads(np.repeat(loads.force, 3, axis=0), loads.slip.repeat(3) / 3.0)
    together = implicit_step(problem, problem.unworn(), split, 5000.0)
    assert together.depth(0.010) == pytest.approx(
        single.depth(0.010), abs=2e-4 * single.depth(0.010).max()
    )


def test_positions_share_one_profile_as_in_small_explicit_steps(ring) -> None:
    angle = np.radians([-25.0, 0.0, 25.0])
    size = np.array([[60.0], [110.0], [60.0]])
    loads = CycleLoads(
        size * np.stack([np.cos(angle), np.sin(angle)], axis=1), SLIP * np.ones(3) / 3
    )
    problem = wear_problem(ring, 90, WIDTH, K, loads, 1.4)
    *_, slow = explicit_moments(problem, lambda *_: loads, np.array([3000.0]), 5.0)
    runs = []
    for steps in (8, 16):
        front = problem.unworn()
        for _ in range(steps):
            front = implicit_step(problem, front, loads, 3000.0 / steps)
        runs.append(front.surface)
    depth = Front(2.0 * runs[1] - runs[0]).depth(0.010)
    expected = slow.front.depth(0.010)
    deep = expected > 0.3 * expected.max()
    assert depth[deep] == pytest.approx(expected[deep], rel=5e-3)
    assert depth == pytest.approx(depth[np.r_[0, len(depth) - 1 : 0 : -1]], abs=1e-3 * depth.max())


def test_a_bed_of_weak_and_strong_forces_settles(ring) -> None:
    rng = np.random.default_rng(3)
    angle = rng.uniform(-np.pi, np.pi, 60)
    size = 10.0 ** rng.uniform(-2.0, 2.0, 60)
    force = size[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    loads = CycleLoads(force, np.full(60, SLIP / 60))
    problem = wear_problem(ring, 90, WIDTH, K, loads, np.pi)
    front = implicit_step(problem, problem.unworn(), loads, 20000.0)
    grown = worn_area(problem, front.surface)
    assert grown > 0.95 * 20000.0 * K * float(loads.slip @ loads.magnitude) / WIDTH
    assert front.depth(0.010).min() > -1e-9


def test_no_wear_coefficient_no_wear(ring) -> None:
    problem, loads = constant_problem(ring)
    front = implicit_step(replace(problem, wear_coefficient=0.0), problem.unworn(), loads, 1e6)
    assert np.array_equal(front.surface, problem.unworn().surface)
    assert front.force is not None
    assert front.force.sum() > 110.0 / WIDTH


def test_wear_through_the_wall_and_out_of_the_arc_is_said(ring) -> None:
    problem, loads = constant_problem(ring)
    with pytest.raises(WornThrough, match="wall of 10 mm is worn through"):
        implicit_step(wear_problem(ring, 180, WIDTH, K, loads, np.pi), problem.unworn(), loads, 1e7)
    narrow = wear_problem(ring, 180, WIDTH, K, loads, 0.3)
    with pytest.raises(ArcTooSmall):
        implicit_step(narrow, narrow.unworn(), loads, LIFE)
    with pytest.raises(ArcTooSmall):
        list(explicit_moments(narrow, lambda *_: loads, np.array([LIFE]), 12.0))


def test_gathering_keeps_the_product_of_force_and_slip() -> None:
    rng = np.random.default_rng(1)
    loads = CycleLoads(rng.normal(5.0, 1.0, size=(3600, 2)), rng.uniform(0.5, 1.5, 3600))
    few = gathered(loads, 12)
    assert len(few.slip) == 12
    assert few.slip.sum() == pytest.approx(loads.slip.sum())
    assert few.slip @ few.magnitude == pytest.approx(loads.slip @ loads.magnitude)
    assert gathered(few, 20) is few


def test_pressing_force_is_against_the_force_on_the_follower_less_friction() -> None:
    plain = loads_of_cycle(np.array([[-30.0], [4.0]]), [0.1])
    assert plain.force == pytest.approx(np.array([[30.0, -4.0]]))
    mu = 0.2
    normal = np.array([30.0, -4.0])
    # Sliding counter-clockwise the pin drags the bushing along: its friction is to the left.
    whole = normal + mu * np.array([-normal[1], normal[0]])
    found = loads_of_cycle(-whole[:, None], [0.1], mu, 1.0)
    assert found.force[0] == pytest.approx(normal)


@pytest.mark.parametrize(
    ("make", "word"),
    [
        (lambda: CycleLoads(np.ones((3, 2)), np.ones(2)), "loads"),
        (lambda: CycleLoads(np.ones((1, 2)), -np.ones(1)), "slip"),
        (lambda: CycleLoads(np.full((1, 2), np.nan), np.ones(1)), "loads"),
        (lambda: constant_load(0.0, 0.0095), "force"),
        (lambda: largest_explicit_step(0.0, K, SLIP, 1e9), "node spacing"),
        (lambda: rigid_wear(0.01, 0.01, 1.0, K, SLIP, [1.0]), "clearance"),
    ],
)
def test_impossible_loads_are_refused(make, word: str) -> None:
    with pytest.raises(ModelError, match=word):
        make()


def test_gathered_parts_are_shorter_where_the_force_swings_fast() -> None:
    angle = 2.0 * np.pi * np.arange(720) / 720
    direction = np.where(angle < np.pi, 0.0, np.pi) + 0.5 * np.tanh((angle - np.pi) / 0.05)
    force = 10.0 * np.stack([np.cos(direction), np.sin(direction)], axis=1)
    dense = CycleLoads(force, np.full(720, 1e-4))
    for positions in (2, 12, 48, 719):
        found = gathered(dense, positions)
        assert len(found.slip) == positions
        assert found.slip.sum() == pytest.approx(dense.slip.sum())
        assert found.slip @ found.magnitude == pytest.approx(dense.slip @ dense.magnitude)
    assert gathered(dense, 48).slip.min() < 0.5 * gathered(dense, 48).slip.max()
    still = CycleLoads(np.tile([10.0, 0.0], (720, 1)), np.full(720, 1e-4))
    np.testing.assert_allclose(gathered(still, 12).slip, 60e-4)
    assert swing(still) == 0.0
    assert swing(dense) > 3.0
