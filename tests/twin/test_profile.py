"""The worn profile from the probes: known surfaces come back, run-out goes, the unseen is NaN."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.twin.approach import RIGID, Approach
from rigapp.twin.measureddepth import (
    ANGLES,
    MeasuredDepth,
    depth_uncertainty,
    measured_depth,
    swept,
    worn_depth,
)
from rigapp.twin.pinpath import (
    PathSum,
    Reference,
    centres,
    early_wear,
    path_of,
    reference_from_mean,
    reference_of,
)

R1, R2 = 9.5e-3, 10e-3
CLEARANCE = R2 - R1
NOISE = np.random.default_rng(7)


def path(
    depth: float,
    *,
    swing_deg: float = 0.3,
    lean_deg: float = 0.0,
    run_out: complex = 0.0,
    zero: complex = 0.0,
    noise: float = 0.0,
    force_error_deg: float = 0.0,
) -> PathSum:
    """One revolution of a pin that bears at CLEARANCE + depth under 30 .. 90 N."""
    angle = np.linspace(0.0, 2.0 * np.pi, 960, endpoint=False)
    follower = -np.arcsin(0.375 * np.sin(angle))
    turn = angle - follower
    normal = np.exp(1j * np.radians(swing_deg * np.sin(angle) + lean_deg))
    place = (CLEARANCE + depth) * normal + run_out * np.exp(1j * turn) + zero
    place = place + noise * (NOISE.normal(size=960) + 1j * NOISE.normal(size=960))
    wrong = np.exp(1j * np.radians(force_error_deg * np.sin(2.0 * turn)))
    force = (60.0 - 30.0 * np.cos(angle)) * np.exp(1j * np.radians(swing_deg * np.sin(angle)))
    force = force * wrong
    return path_of(
        angle, np.stack([place.real, place.imag]), np.stack([force.real, force.imag]), turn
    )


def many(depth: float, revolutions: int, **details: float | complex) -> PathSum:
    found = path(depth, **details)  # type: ignore[arg-type]
    for _ in range(revolutions - 1):
        found = found + path(depth, **details)  # type: ignore[arg-type]
    return found


def depth_of(path: PathSum, reference: Reference, approach: Approach = RIGID) -> MeasuredDepth:
    return measured_depth(path, reference, CLEARANCE, approach)


def truth(depth: float, lean_deg: float = 0.0) -> np.ndarray:
    """The pin's circle sunk in by depth, beyond the bushing's first circle."""
    away = CLEARANCE + depth
    angle = ANGLES - np.radians(lean_deg)
    root = np.sqrt(R1**2 - (away * np.sin(angle)) ** 2)
    return np.maximum(away * np.cos(angle) + root - R2, 0.0)


def test_one_place_of_the_pin_gives_its_own_circle_and_nothing_beyond() -> None:
    depth = worn_depth(np.array([[CLEARANCE + 2e-4], [0.0]]), R1, R2)
    expected = truth(2e-4)
    seen = np.isfinite(depth)
    np.testing.assert_allclose(depth[seen], expected[seen], atol=1e-12)
    assert (expected[~seen] == 0.0).all()
    assert depth[180] == pytest.approx(2e-4, abs=1e-12)
    assert np.isnan(depth[0])
    assert np.isnan(depth[-1])


def test_many_places_give_the_envelope() -> None:
    directions = np.radians(np.linspace(-20.0, 20.0, 41))
    away = CLEARANCE + 1e-4
    depth = worn_depth(away * np.stack([np.cos(directions), np.sin(directions)]), R1, R2)
    inside = np.abs(np.degrees(ANGLES)) <= 20.0 + 1e-9
    np.testing.assert_allclose(depth[inside], 1e-4, atol=2e-8)


def test_a_pin_that_floats_in_the_clearance_shows_nothing() -> None:
    assert np.isnan(worn_depth(np.array([[1e-4], [0.0]]), R1, R2)).all()
    assert (swept(np.zeros((2, 0)), R1) == -np.inf).all()


def test_run_out_and_a_load_cell_that_leans_leave_the_profile_alone() -> None:
    crooked = {"run_out": 3e-6 - 2e-6j, "force_error_deg": 0.9, "lean_deg": -2.9, "noise": 2e-7}
    crooked["swing_deg"] = 0.0
    new = reference_of(many(0.0, 5, **crooked), CLEARANCE)
    assert new is not None
    assert new.centred
    np.testing.assert_allclose(new.run_out, [3e-6, -2e-6], atol=1e-7)
    worn = many(2.5e-4, 6, **crooked)
    positions = centres(worn, new)
    assert depth_of(worn, new).depth == pytest.approx(2.5e-4, abs=2e-7)
    doubt = depth_uncertainty(new.radial, new.across, np.radians(-2.9))
    depth = worn_depth(positions, R1, R2, doubt)
    seen = np.isfinite(depth)
    error = np.abs(depth - truth(2.5e-4, -2.9))[seen]
    assert error.max() < 6e-7
    assert (error <= doubt[seen] + 3e-7).all()
    assert depth_uncertainty(1e-6, 0.0, 0.0)[180] == pytest.approx(2e-6)


@settings(max_examples=25, deadline=None)
@given(
    zero=st.complex_numbers(max_magnitude=4e-4, allow_nan=False),
    run_out=st.complex_numbers(max_magnitude=1e-5, allow_nan=False),
    swing=st.floats(0.0, 20.0),
    depth=st.floats(1e-6, 4e-4),
)
def test_any_zero_of_the_probes_and_any_run_out(
    zero: complex, run_out: complex, swing: float, depth: float
) -> None:
    new = reference_of(path(0.0, zero=zero, run_out=run_out, swing_deg=swing), CLEARANCE)
    assert new is not None
    worn = path(depth, zero=zero, run_out=run_out, swing_deg=swing)
    positions = centres(worn, new)
    if not new.centred:
        expected = (CLEARANCE + depth) * np.exp(
            1j * np.radians(swing * np.sin(np.radians(1.5 + 3.0 * np.arange(120))))
        )
        np.testing.assert_allclose(positions[0], expected.real, atol=1e-6)
        np.testing.assert_allclose(positions[1], expected.imag, atol=1e-6)
    assert depth_of(worn, new).depth == pytest.approx(depth, rel=0.1, abs=4e-6)


def test_wear_of_the_first_revolutions_is_told_from_their_trend() -> None:
    numbers = [3, 4, 5, 6, 7]
    paths = [path(2e-6 * n, run_out=3e-6) for n in numbers]
    assert early_wear(numbers, paths) == pytest.approx(10e-6, rel=0.02)
    assert early_wear([4], paths[:1]) == 0.0


def test_only_the_mean_of_the_new_bushing_is_known() -> None:
    worn = path(1e-4, run_out=3e-6)
    found = reference_from_mean(np.array([CLEARANCE, 0.0]), CLEARANCE, worn)
    np.testing.assert_allclose(found.run_out, [3e-6, 0.0], atol=1e-7)
    assert depth_of(worn, found).depth == pytest.approx(1e-4, abs=2e-7)


FALLING = Approach(
    np.array([0.0, 1e-5, 2e-4]),
    np.array([30.0, 60.0, 90.0]),
    1e-6 * np.array([[8.0, 12.0, 16.0], [4.0, 7.0, 10.0], [2.0, 4.0, 6.0]]),
)


def elastic(depth: float) -> PathSum:
    """A revolution without swing: the pin further along x by the approach at each force."""
    found = path(depth, swing_deg=0.0)
    position = found.position.copy()
    position[0] += FALLING.at(depth, np.hypot(*found.mean_force)) * found.count
    return replace(found, position=position)


@pytest.mark.parametrize("depth", [0.0, 3e-6, 1e-5, 1e-4])
def test_the_fall_of_the_elastic_approach_is_not_taken_for_less_wear(depth: float) -> None:
    new = reference_of(elastic(0.0), CLEARANCE, approach=FALLING)
    assert new is not None
    assert new.approach == pytest.approx(16e-6, rel=0.01)
    worn = elastic(depth)
    found = depth_of(worn, new, FALLING)
    assert found.depth == pytest.approx(depth, abs=2e-8)
    assert depth_of(worn, new).depth == pytest.approx(
        depth + FALLING.mean(worn.mean_force[0]).at(depth)
    )
    positions = centres(worn, new, depth, FALLING)
    np.testing.assert_allclose(np.hypot(*positions), CLEARANCE + depth, atol=2e-8)
    # The change of the approach is part of the uncertainty.
    change = FALLING.mean(worn.mean_force[0]).at(0.0) - FALLING.mean(worn.mean_force[0]).at(depth)
    assert found.uncertainty >= 0.399 * change
    # A reference from before that knew no approach holds that of the new bushing.
    old = reference_of(elastic(0.0), CLEARANCE)
    assert old is not None
    told = depth_of(worn, replace(old, elastic=False), FALLING)
    assert told.depth == pytest.approx(depth, abs=1.5e-6)


def test_the_approach_of_any_force() -> None:
    force = np.array([0.0, 15.0, 45.0, 90.0, 180.0])
    np.testing.assert_allclose(FALLING.at(0.0, force), 1e-6 * np.array([0, 4, 10, 16, 32]))
    np.testing.assert_allclose(FALLING.at(5e-6, force[2:3]), [1e-6 * 7.75])
    for depth in (-2e-6, 0.0, 4e-6, 1e-4, 5e-4):
        seen = depth + FALLING.mean(force[:4]).at(depth)
        assert FALLING.mean(force[:4]).depth_of(seen) == pytest.approx(depth, abs=1e-12)


def test_an_approach_that_nobody_knows_leaves_no_uncertainty() -> None:
    new = reference_of(path(0.0), CLEARANCE)
    assert new is not None
    found = measured_depth(path(1e-4), new, CLEARANCE, None)
    assert found.depth == pytest.approx(1e-4, abs=2e-7)
    assert np.isnan(found.uncertainty)


def test_too_little_tells_nothing() -> None:
    silent = path(0.0)
    one = path_of(np.array([0.1]), np.zeros((2, 1)), np.ones((2, 1)), np.array([0.1]))
    assert reference_of(one, CLEARANCE) is None
    lost = path_of(
        np.linspace(0.0, 6.0, 50), np.full((2, 50), np.nan), np.ones((2, 50)), np.zeros(50)
    )
    assert not lost.filled.any()
    new = reference_of(silent, CLEARANCE)
    assert new is not None
    assert np.isnan(depth_of(lost, new).depth)
    assert np.isnan(measured_depth(silent, None, CLEARANCE, RIGID).depth)
    assert (silent + lost).revolutions == 2
