"""The paper's equations solved as printed (and corrected) against the closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rigapp_model.constraints import ALPHA, PHI1, PHI2, X3, Solution, solve_imperfect, solve_perfect
from rigapp_model.dynamics import MechanismMotion, inverse_dynamics
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(
    CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0), gravity=(1.0, -9.81), added_mass=2.0
)
ANGLES = np.deg2rad(np.arange(360.0))
SPEED = np.pi * (1.0 + 0.1 * np.sin(2.0 * ANGLES))
GROWTH = 0.2 * np.pi * np.cos(2.0 * ANGLES) * SPEED


def agree(solution: Solution, motion: MechanismMotion) -> None:
    force = 1e-12 * motion.force_magnitude.max()
    torque = 1e-12 * np.abs(motion.drive_torque).max()
    np.testing.assert_allclose(solution.force, motion.force, rtol=0, atol=force)
    np.testing.assert_allclose(solution.wrist_force, motion.wrist_force, rtol=0, atol=force)
    np.testing.assert_allclose(solution.guide_force, motion.guide_force, rtol=0, atol=force)
    np.testing.assert_allclose(solution.drive_torque, motion.drive_torque, rtol=0, atol=torque)
    for mine, other in (
        (solution.position, (motion.crank_position, motion.follower_position)),
        (solution.velocity, (motion.crank_velocity, motion.follower_velocity)),
        (
            solution.acceleration,
            (motion.crank_acceleration, motion.follower_centre_acceleration),
        ),
    ):
        for first, body in zip((0, 3), other, strict=True):
            np.testing.assert_allclose(mine[:, first : first + 2].T, body, rtol=0, atol=1e-12)
    np.testing.assert_allclose(solution.position[:, PHI2], motion.follower_angle, atol=1e-14)
    np.testing.assert_allclose(solution.position[:, X3], motion.slider_position, atol=1e-14)


@pytest.mark.parametrize("mechanism", [CASE_A, CASE_B])
def test_perfect_joint_at_constant_and_varying_speed(mechanism: Mechanism) -> None:
    agree(solve_perfect(mechanism, ANGLES, np.pi), inverse_dynamics(mechanism, ANGLES, np.pi))
    agree(
        solve_perfect(mechanism, ANGLES, SPEED, GROWTH),
        inverse_dynamics(mechanism, ANGLES, SPEED, GROWTH),
    )


@pytest.mark.parametrize("gap", [0.0, 0.1e-3, 1e-3, -0.5e-3])
def test_imperfect_joint_on_either_wall(gap: float) -> None:
    pin = 9.5e-3
    solution = solve_imperfect(CASE_B, pin, pin + gap, ANGLES, SPEED, GROWTH)
    agree(solution, inverse_dynamics(CASE_B, ANGLES, SPEED, GROWTH, gap))
    q = solution.position
    np.testing.assert_allclose(q[:, ALPHA], np.pi + q[:, PHI2] - q[:, PHI1], atol=1e-13)


def test_equal_radii_give_the_perfect_joint_back() -> None:
    perfect = solve_perfect(CASE_B, ANGLES, np.pi)
    imperfect = solve_imperfect(CASE_B, 9.5e-3, 9.5e-3, ANGLES, np.pi)
    peak = np.abs(perfect.force).max()
    np.testing.assert_allclose(imperfect.force, perfect.force, rtol=0, atol=1e-12 * peak)
    np.testing.assert_allclose(imperfect.position[:, :9], perfect.position, rtol=0, atol=1e-14)


def test_the_pin_rows_alone_are_not_the_pin_force() -> None:
    solution = solve_perfect(CASE_A, ANGLES, np.pi)
    rows = -solution.multipliers[:, 2:4].T
    error = np.hypot(*(rows - solution.force)).max() / np.hypot(*solution.force).max()
    assert 0.85 < error < 0.95


def test_refusals() -> None:
    with pytest.raises(ModelError, match="pin radius"):
        solve_imperfect(CASE_A, 0.0, 1e-2, ANGLES, np.pi)
    with pytest.raises(ModelError, match="angle"):
        solve_perfect(CASE_A, [0.0, np.nan], np.pi)
    with pytest.raises(ModelError, match=r"singular|without convergence"):
        solve_imperfect(CASE_A, 0.15, 0.01, ANGLES, np.pi)
