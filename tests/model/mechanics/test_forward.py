"""Inverse dynamics, run forward by a flywheel and a torque, keeps energy and momentum."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.integrate import solve_ivp

from rigapp_model.dynamics import MechanismMotion, inverse_dynamics
from rigapp_model.parameters import Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0), gravity=(0.0, -9.81))
FLYWHEEL = 0.0847
"""kg m^2."""


def kinetic(m: Mechanism, motion: MechanismMotion) -> np.ndarray:
    return 0.5 * (
        m.crank_inertia * motion.speed**2
        + m.follower_inertia * motion.follower_speed**2
        + m.crank_mass * np.sum(motion.crank_velocity**2, axis=0)
        + m.follower_mass * np.sum(motion.follower_velocity**2, axis=0)
        + m.moving_mass * motion.slider_velocity**2
    )


def reduced_inertia(mechanism: Mechanism, angle: object, clearance: float) -> np.ndarray:
    """Return the inertia of everything that moves, reduced to the crank, kg m^2."""
    moved = inverse_dynamics(mechanism, angle, 0.0, 1.0, clearance).drive_torque
    return moved - inverse_dynamics(mechanism, angle, 0.0, 0.0, clearance).drive_torque


def test_reduced_inertia_is_that_of_the_kinetic_energy() -> None:
    angles = np.linspace(0.0, 6.0, 50)
    motion = inverse_dynamics(CASE_A, angles, 2.0, clearance=1e-3)
    inertia = reduced_inertia(CASE_A, angles, 1e-3)
    np.testing.assert_allclose(0.5 * inertia * 4.0, kinetic(CASE_A, motion), rtol=1e-12)


def test_energy_is_kept_without_torque() -> None:
    def rate(_: float, state: np.ndarray) -> tuple[float, float]:
        load = inverse_dynamics(CASE_B, state[0], state[1], 0.0, 0.5e-3).drive_torque
        return state[1], float(-load / (reduced_inertia(CASE_B, state[0], 0.5e-3) + FLYWHEEL))

    run = solve_ivp(
        rate, (0.0, 3.0), (0.4, 12.0), "DOP853", np.linspace(0.0, 3.0, 301), rtol=1e-9, atol=1e-9
    )
    m, spring = inverse_dynamics(CASE_B, *run.y, 0.0, 0.5e-3), CASE_B.spring
    assert spring is not None
    energy = kinetic(CASE_B, m) + 0.5 * FLYWHEEL * m.speed**2
    energy += 0.5 * spring.stiffness * (m.slider_position - spring.free_position) ** 2
    energy += 9.81 * CASE_B.crank_mass * m.crank_position[1]
    energy += 9.81 * CASE_B.follower_mass * m.follower_position[1]
    assert np.ptp(energy) < 1e-7 * energy[0]
    assert np.ptp(m.speed) > 1.0
