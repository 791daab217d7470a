"""The friction circle: what is put into the joint comes out of the force across the follower."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rigapp_model.dynamics import MechanismMotion, inverse_dynamics
from rigapp_model.friction_circle import CellDoubt, Friction, friction_of
from rigapp_model.parameters import Joint, Mechanism, Spring

ANGLE = np.arange(360) * (2.0 * np.pi / 360)
MECHANISM = Mechanism(
    0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, spring=Spring(525.0, 0.3174952)
)
JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
DOUBT = CellDoubt(0.5, 1e-3)


def motion_with(mu: float, mechanism: Mechanism = MECHANISM) -> MechanismMotion:
    return inverse_dynamics(
        mechanism, ANGLE, np.pi, 0.0, 0.0, replace(JOINT, friction_coefficient=mu)
    )


def found(force: np.ndarray, doubt: CellDoubt = DOUBT) -> Friction:
    model = motion_with(0.0)
    return friction_of(
        force,
        model.force_follower[1],
        ANGLE - model.follower_angle,
        np.sign(model.speed - model.follower_speed),
        JOINT.pin_radius / MECHANISM.follower_length,
        doubt,
    )


@pytest.mark.parametrize("mu", [0.0, 0.05, 0.13, 0.4])
def test_the_coefficient_comes_back(mu: float) -> None:
    friction = found(motion_with(mu).force_crank, CellDoubt(0.0, 0.0))
    assert friction.coefficient == pytest.approx(mu, abs=1e-6)


def test_mass_and_spring_of_the_slider_do_not_look_like_friction() -> None:
    heavier = replace(MECHANISM, slider_mass=5.8, spring=Spring(480.0, 0.3174952))
    friction = found(motion_with(0.1, heavier).force_crank)
    assert friction.coefficient == pytest.approx(0.1, abs=2e-3)


def test_a_cell_turned_on_the_crank_looks_like_friction_and_is_within_the_uncertainty() -> None:
    turned = np.radians(0.1)
    force, c, s = motion_with(0.1).force_crank, np.cos(turned), np.sin(turned)
    seen = np.stack([c * force[0] - s * force[1], s * force[0] + c * force[1]])
    friction = found(seen, CellDoubt(0.5, turned))
    largest = turned * MECHANISM.follower_length / JOINT.pin_radius
    assert 0.3 * largest < abs(friction.coefficient - 0.1) < friction.uncertainty


def test_the_uncertainty_covers_what_it_says() -> None:
    rng = np.random.default_rng(4)
    force, inside = motion_with(0.08).force_crank, 0
    for _ in range(400):
        error = DOUBT.relative * rng.normal(size=(2, 2))
        zero = DOUBT.constant * rng.normal(size=(2, 1))
        friction = found(force + error @ force + zero + 0.7 * rng.normal(size=force.shape))
        inside += abs(friction.coefficient - 0.08) < friction.uncertainty
    assert 0.92 < inside / 400 < 0.985  # 0.954 by two standard deviations, +/- 3 of 400 draws


def test_without_force_nothing_is_said() -> None:
    friction = found(np.zeros((2, 360)))
    assert np.isnan(friction.coefficient)
    assert np.isnan(friction.uncertainty)
