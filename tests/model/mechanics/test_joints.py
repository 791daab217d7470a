"""Techniques 1 and 2, and what is said when continuous contact cannot hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.errors import ModelError
from rigapp_model.joints import _ranges_above_zero, continuous_contact, perfect_joint
from rigapp_model.parameters import Joint, Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
ANGLES = np.deg2rad(np.arange(0.0, 360.0, 0.5))


def test_the_outboard_spring_keeps_the_follower_in_tension() -> None:
    answer = continuous_contact(CASE_B, JOINT, ANGLES, np.pi)
    assert answer.assumption_holds
    assert answer.sentence() == ""
    assert answer.clearance == pytest.approx(0.5e-3)
    assert (answer.wall == 1.0).all()
    expected = inverse_dynamics(CASE_B, ANGLES, np.pi, clearance=0.5e-3)
    np.testing.assert_array_equal(answer.motion.force, expected.force)
    assert np.degrees(np.abs(answer.contact_angle).max()) < 1.5


def test_without_a_spring_the_other_wall_bears_and_the_program_says_so() -> None:
    answer = continuous_contact(CASE_A, JOINT, ANGLES, np.pi)
    assert not answer.assumption_holds
    along = answer.motion.force_follower[0]
    inside = np.zeros(len(ANGLES), dtype=bool)
    for start, end in answer.compression:
        inside |= (start < ANGLES) & (end > ANGLES)
    np.testing.assert_array_equal(inside, along > 0.0)
    np.testing.assert_array_equal(answer.wall < 0.0, along > 0.0)
    other = inverse_dynamics(CASE_A, ANGLES, np.pi, clearance=-0.5e-3)
    np.testing.assert_array_equal(answer.motion.force[:, inside], other.force[:, inside])
    sentence = answer.sentence()
    for start, end in answer.compression:
        assert f"{np.degrees(start):.1f} to {np.degrees(end):.1f} deg" in sentence
    assert "compression" in sentence


def test_the_ends_of_compression_are_zero_crossings() -> None:
    coarse = continuous_contact(CASE_A, JOINT, np.deg2rad(np.arange(0.0, 360.0, 5.0)), np.pi)
    for start, end in coarse.compression:
        for edge in (start, end):
            force = inverse_dynamics(CASE_A, edge, np.pi, clearance=0.5e-3).force_follower[0]
            assert abs(force) < 0.05


def test_friction_turns_the_contact_point_by_its_angle() -> None:
    smooth = continuous_contact(CASE_B, JOINT, ANGLES, np.pi)
    rough = continuous_contact(CASE_B, replace(JOINT, friction_coefficient=0.13), ANGLES, np.pi)
    shift = np.degrees(rough.contact_angle - smooth.contact_angle)
    assert np.mean(shift) == pytest.approx(-np.degrees(np.arctan(0.13)), abs=0.5)
    assert rough.motion.drive_torque.mean() > 0.0


def test_the_perfect_joint_has_no_clearance() -> None:
    motion = perfect_joint(CASE_B, ANGLES, np.pi, joint=JOINT)
    np.testing.assert_array_equal(motion.force, inverse_dynamics(CASE_B, ANGLES, np.pi).force)


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [(30.0, 90.0, (30.0, 90.0)), (300.0, 400.0, (300.0, 400.0)), (0.25, 359.75, (0.25, 359.75))],
)
def test_ranges_of_a_cycle(low: float, high: float, expected: tuple[float, float]) -> None:
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    away = np.abs((np.degrees(ANGLES) - middle + 180.0) % 360.0 - 180.0)
    for angles, value in ((ANGLES, half - away), (ANGLES[::-1], (half - away)[::-1])):
        ((start, end),) = _ranges_above_zero(angles, value)
        found = sorted(np.degrees([start, end]))
        assert (np.array(found) - expected) % 360.0 == pytest.approx([0.0, 0.0], abs=1e-9) or (
            found == pytest.approx(list(expected))
        )


def test_ranges_of_a_part_and_of_the_whole() -> None:
    part = np.deg2rad(np.arange(10.0, 50.0))
    degrees = [
        tuple(np.degrees(r))
        for r in _ranges_above_zero(part, np.abs(np.degrees(part) - 30.0) - 10.5)
    ]
    assert degrees == [pytest.approx((10.0, 19.5)), pytest.approx((40.5, 49.0))]
    ((start, end),) = _ranges_above_zero(ANGLES, np.ones_like(ANGLES))
    assert (start, end) == pytest.approx((0.0, 2.0 * np.pi))
    assert _ranges_above_zero(ANGLES, np.zeros_like(ANGLES)) == ()


def test_a_negative_clearance_is_refused() -> None:
    with pytest.raises(ModelError, match="clearance"):
        continuous_contact(CASE_B, JOINT, ANGLES, np.pi, clearance=-1e-4)


def test_compression_all_the_way_round_is_called_what_it_is() -> None:
    """An inboard spring presses the pin on the other wall; no contact is lost on the way."""
    spring = Spring(525.0, 0.127 - 20.0 / 525.0)
    inboard = replace(CASE_A, spring=spring)
    answer = continuous_contact(inboard, JOINT, ANGLES, np.pi)
    assert (answer.motion.force_follower[0] > 0.0).all()
    assert not answer.assumption_holds
    assert "compression at all crank angles" in answer.sentence()
    assert "lost" not in answer.sentence()
    expected = inverse_dynamics(inboard, ANGLES, np.pi, 0.0, -JOINT.clearance, JOINT)
    np.testing.assert_array_equal(answer.motion.force, expected.force)
