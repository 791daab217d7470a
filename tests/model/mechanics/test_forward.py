"""Speed as a state: energy, momentum of the flywheel, and the way back by inverse dynamics."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.dynamics import Motion, inverse_dynamics
from model.errors import ModelError
from model.forward import crank_acceleration, drive_crank, reduced_inertia
from model.parameters import Joint, Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0), gravity=(0.0, -9.81))
JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13e-3, 0.13)
FLYWHEEL = 0.0847


def kinetic(m: Mechanism, motion: Motion) -> np.ndarray:
    return 0.5 * (
        m.crank_inertia * motion.speed**2
        + m.follower_inertia * motion.follower_speed**2
        + m.crank_mass * np.sum(motion.crank_velocity**2, axis=0)
        + m.follower_mass * np.sum(motion.follower_velocity**2, axis=0)
        + m.moving_mass * motion.slider_velocity**2
    )


def test_reduced_inertia_is_that_of_the_kinetic_energy() -> None:
    angles = np.linspace(0.0, 6.0, 50)
    motion = inverse_dynamics(CASE_A, angles, 2.0, clearance=1e-3)
    inertia = reduced_inertia(CASE_A, angles, FLYWHEEL, 1e-3)
    np.testing.assert_allclose(
        0.5 * (inertia - FLYWHEEL) * 4.0, kinetic(CASE_A, motion), rtol=1e-12
    )


def test_energy_is_kept_without_torque() -> None:
    run = drive_crank(
        CASE_B, lambda *_: 0.0, np.linspace(0.0, 3.0, 301), 0.4, 12.0, FLYWHEEL, 0.5e-3
    )
    m, spring = run.motion, CASE_B.spring
    assert spring is not None
    energy = kinetic(CASE_B, m) + 0.5 * FLYWHEEL * m.speed**2
    energy += 0.5 * spring.stiffness * (m.slider_position - spring.free_position) ** 2
    energy += 9.81 * CASE_B.crank_mass * m.crank_position[1]
    energy += 9.81 * CASE_B.follower_mass * m.follower_position[1]
    assert np.ptp(energy) < 1e-7 * energy[0]
    assert np.ptp(m.speed) > 1.0


def test_inverse_dynamics_gives_the_torque_back() -> None:
    angles, speeds = np.linspace(0.0, 6.0, 60), np.linspace(1.0, 9.0, 60)
    torque = 3.0 * np.sin(angles)
    growth = crank_acceleration(CASE_B, angles, speeds, torque, FLYWHEEL, 0.5e-3, JOINT)
    needed = inverse_dynamics(CASE_B, angles, speeds, growth, 0.5e-3, JOINT).drive_torque
    np.testing.assert_allclose(needed + FLYWHEEL * growth, torque, atol=1e-9)


def test_a_governed_drive_ripples_with_the_load() -> None:
    run = drive_crank(
        CASE_B,
        lambda _t, _a, w: 5.0 * (np.pi - w),
        np.linspace(0.0, 3.0, 1501),
        speed=np.pi,
        flywheel_inertia=FLYWHEEL,
        contact=JOINT,
        tolerance=1e-7,
    )
    late = run.motion.speed[500:]
    assert late.mean() == pytest.approx(np.pi, rel=0.2)
    assert 0.01 < np.ptp(late) / np.pi < 0.8
    np.testing.assert_allclose(
        run.torque, run.motion.drive_torque + FLYWHEEL * run.motion.acceleration, atol=1e-6
    )


def test_refusals() -> None:
    with pytest.raises(ModelError, match="flywheel"):
        drive_crank(CASE_A, lambda *_: 0.0, [0.0, 1.0], flywheel_inertia=-1.0)
    with pytest.raises(ModelError, match="increasing"):
        drive_crank(CASE_A, lambda *_: 0.0, [0.0, 0.0])
