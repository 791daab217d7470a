"""The plant's mechanics against reference tables, energy, and an independent integrator."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from rigapp.config.parameters import ParameterFile, SpringSection
from rigapp.config.rig import PlantSection, RigFile, SimulationSection
from rigapp.simulation import kernels, layout, mechanics
from rigapp.simulation.constants import Machine, plant_constants
from rigapp.simulation.layout import Constants, Drive
from rigapp.simulation.plant import Plant
from rigapp.simulation.wall import LEVELS
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.parameters import Joint, Mechanism, Spring

DATA = Path(__file__).parents[1] / "data"
SPEED = math.pi  # 30 rpm
RIGID = (np.zeros((LEVELS + 1, 4)), np.array([1.0, math.inf]))
"""Table and state of a wall that does not give way."""


def reference(case: str) -> dict[str, NDArray[np.float64]]:
    with (DATA / f"forces_case_{case}.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))[::10]
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def case_constants(rig: RigFile, parameters: ParameterFile, case: str) -> Constants:
    """Return the constants of the reference: no running clearance, case A without the spring."""
    joint = msgspec.structs.replace(parameters.joint, bushing_radius_mm=9.5)
    spring = SpringSection(525.0, 279.4 + 20.0 / 0.525) if case == "B" else None
    changed = msgspec.structs.replace(parameters, joint=joint, spring=spring)
    return plant_constants(changed, rig)


@pytest.mark.parametrize("case", ["A", "B"])
def test_inverse_dynamics_is_the_reference(
    perfect_rig: RigFile, parameters: ParameterFile, case: str
) -> None:
    table = reference(case)
    k = case_constants(perfect_rig, parameters, case)
    for row, degrees in enumerate(table["crank_angle_deg"]):
        b = mechanics.bodies(k, math.radians(degrees), 0.0)
        fx, fy = mechanics.reaction(k, b, 0.0, SPEED**2, 0.0)
        assert fx == pytest.approx(table["Fx[N]"][row], abs=1e-9)
        assert fy == pytest.approx(table["Fy[N]"][row], abs=1e-9)
        assert b[13] * SPEED**2 - b[14] == pytest.approx(table["T[N*m]"][row], abs=1e-10)


@pytest.mark.parametrize("case", ["A", "B"])
def test_running_plant_at_steady_speed_gives_the_reference_forces(
    perfect_rig: RigFile, parameters: ParameterFile, case: str
) -> None:
    table = reference(case)
    k = case_constants(perfect_rig, parameters, case)
    stiff = k._replace(proportional=3e2 * k.proportional, integral=3e3 * k.integral)
    plant = Plant(stiff, sample_rate_Hz=9600.0, angle_rad=0.0, longest_step_s=1e-5)
    command = Drive(layout.VELOCITY, SPEED, SPEED, 0.0, 1e6, 0.0)
    truth = plant.advance(int(5.0 / plant.step_s), command).truth
    last = truth.angle_rad > truth.angle_rad[-1] - 2.0 * math.pi
    angle = np.degrees(truth.angle_rad[last]) % 360.0
    order = np.argsort(angle)
    for column, force in (("F_e1[N]", truth.force_e1_N), ("F_n1[N]", truth.force_n1_N)):
        measured = np.interp(
            table["crank_angle_deg"], angle[order], force[last][order], period=360.0
        )
        np.testing.assert_allclose(measured, table[column], atol=0.02)


@given(
    angle=st.floats(-10.0, 10.0),
    speed=st.floats(-70.0, 70.0).filter(lambda w: abs(w) > 1e-3),
    torque=st.floats(-6.0, 6.0),
    depth_um=st.floats(0.0, 800.0),
    friction=st.floats(0.0, 0.3),
)
@settings(max_examples=200, deadline=None)
def test_plant_and_model_agree_on_one_instant(
    rig: RigFile,
    parameters: ParameterFile,
    angle: float,
    speed: float,
    torque: float,
    depth_um: float,
    friction: float,
) -> None:
    """The model is another program: its inverse dynamics must give back the plant's torque."""
    section = PlantSection(joint_friction_coefficient=friction)
    rough = msgspec.structs.replace(rig, simulation=SimulationSection(plant=section))
    k = plant_constants(parameters, rough)
    depth, sense = depth_um * 1e-6, math.copysign(1.0, speed)
    a, fx, fy, force, _ = mechanics.motion(k, angle, speed, depth, torque, sense, 50.0)
    # Two passes of the fixed point leave a relative error of (mu R1 / L)^2.
    a, fx, fy, force, _ = mechanics.motion(k, angle, speed, depth, torque, sense, force)
    m = parameters.mechanism
    mechanism = Mechanism(
        crank_radius=m.crank_radius_mm * 1e-3,
        crank_mass=m.crank_mass_kg,
        crank_inertia=m.crank_inertia_kg_m2,
        follower_length=m.follower_length_mm * 1e-3,
        follower_mass=m.follower_mass_kg,
        follower_inertia=m.follower_inertia_kg_m2,
        slider_mass=1.01 * m.slider_mass_kg,
        spring=Spring(0.985 * 525.0, 317.4952e-3),
    )
    joint = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3, friction)
    motion = inverse_dynamics(mechanism, angle, speed, a, 0.5e-3 + depth, joint)
    machine = Machine()
    bearing = sense * machine.bearing_torque_Nm + machine.bearing_viscous_Nm_s * speed
    wheels = machine.flywheel_kg_m2 + machine.rotor_kg_m2
    scale = 1.0 + float(motion.force_magnitude)
    assert float(motion.drive_torque) + wheels * a + bearing == pytest.approx(
        torque, abs=1e-6 * scale
    )
    assert fx == pytest.approx(float(motion.force[0]), abs=1e-5 * scale)
    assert fy == pytest.approx(float(motion.force[1]), abs=1e-5 * scale)
    e1, n1, _, _ = kernels.views(
        k, *RIGID, mechanics.geometry(k, angle, depth), depth, fx, fy, sense
    )
    assert (e1, n1) == pytest.approx(tuple(motion.force_crank), abs=1e-5 * scale)


def lagrange(k: Constants, angle: float, speed: float) -> float:
    """Return the free acceleration from the energies alone, by differences."""
    h = 1e-4

    def inertia(x: float) -> float:
        return 2.0 * mechanics.energy(k, x, 1.0, 0.0)[0]

    def potential(x: float) -> float:
        return mechanics.energy(k, x, 0.0, 0.0)[1]

    slope = (inertia(angle + h) - inertia(angle - h)) / (2.0 * h)
    pull = (potential(angle + h) - potential(angle - h)) / (2.0 * h)
    return -(0.5 * slope * speed**2 + pull) / inertia(angle)


def test_free_motion_is_that_of_an_independent_integrator(
    perfect_rig: RigFile, parameters: ParameterFile
) -> None:
    gravity = msgspec.structs.replace(parameters.mechanism, gravity_m_s2=(0.5, -9.81))
    changed = msgspec.structs.replace(parameters, mechanism=gravity)
    k = plant_constants(changed, perfect_rig, Machine(bearing_torque_Nm=0, bearing_viscous_Nm_s=0))
    plant = Plant(k, sample_rate_Hz=900.0, angle_rad=1.0)
    plant._state[layout.SPEED] = 12.0
    truth = plant.advance(1801, Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 0.0)).truth
    exact = solve_ivp(
        lambda _, y: (y[1], lagrange(k, y[0], y[1])), (0.0, 2.0), (1.0, 12.0), rtol=1e-9, atol=1e-9
    )
    assert truth.time_s[1800] == pytest.approx(2.0)
    assert truth.angle_rad[1800] == pytest.approx(exact.y[0][-1], abs=1e-5)
    assert truth.speed_rad_per_s[1800] == pytest.approx(exact.y[1][-1], abs=1e-5)


def test_energy_is_balanced_through_start_reversal_and_coasting(
    rig: RigFile, parameters: ParameterFile
) -> None:
    plant = Plant(plant_constants(parameters, rig))
    before = plant.state()
    for mode, start, end, steps in (
        (layout.VELOCITY, 0.0, 9.0, 900),
        (layout.VELOCITY, 9.0, 9.0, 1800),
        (layout.VELOCITY, 9.0, -9.0, 1800),
        (layout.VELOCITY, -9.0, -9.0, 900),
        (layout.OFF, 0.0, 0.0, 900),
    ):
        plant.advance(steps, Drive(mode, start, end, 0.0, 48.0, 0.0))
        now = plant.state()
        gained = (
            now.kinetic_energy_J
            + now.potential_energy_J
            - before.kinetic_energy_J
            - before.potential_energy_J
        )
        assert gained == pytest.approx(now.motor_work_J - now.friction_loss_J, abs=2e-3)
    assert now.friction_loss_J > 5.0


def test_power_balance_of_one_instant(rig: RigFile, parameters: ParameterFile) -> None:
    k = plant_constants(parameters, rig)
    for angle in np.linspace(0.1, 6.2, 13):
        speed, torque, h = 7.0, 2.0, 1e-6
        a, _, _, _, friction = mechanics.motion(k, angle, speed, 0.0, torque, 1.0, 60.0)
        later = sum(mechanics.energy(k, angle + speed * h, speed + a * h, 0.0))
        earlier = sum(mechanics.energy(k, angle - speed * h, speed - a * h, 0.0))
        assert (later - earlier) / (2 * h) == pytest.approx((torque - friction) * speed, abs=1e-6)


def test_friction_couple_belongs_to_the_joint_force(
    rig: RigFile, parameters: ParameterFile
) -> None:
    frictionless = SimulationSection(plant=PlantSection(joint_friction_coefficient=0.0))
    k = plant_constants(parameters, rig)
    smooth = plant_constants(parameters, msgspec.structs.replace(rig, simulation=frictionless))
    _, fx, fy, force, friction = mechanics.motion(k, 1.0, 3.0, 0.0, 1.0, 1.0, 50.0)
    _, fx0, fy0, _, bearing = mechanics.motion(smooth, 1.0, 3.0, 0.0, 1.0, 1.0, 50.0)
    b = mechanics.bodies(k, 1.0, 0.0)
    couple = 0.05 / math.hypot(1.0, 0.05) * 9.5e-3 * force
    assert friction - bearing == pytest.approx(couple * (1.0 - b[2]), rel=2e-3)
    # On the follower the couple turns with the pin: the force gets a part across the follower.
    across = -(fx - fx0) * b[0] + (fy - fy0) * b[1]
    assert across == pytest.approx(couple / (0.2032 + 0.5e-3), abs=2e-3)


def test_halving_the_step_changes_nothing_that_matters(
    rig: RigFile, parameters: ParameterFile
) -> None:
    k = plant_constants(parameters, rig)._replace(torque_limit=1000.0)
    ends = []
    for factor in (1, 8):
        plant = Plant(k, sample_rate_Hz=900.0, longest_step_s=1 / 900.0 / factor)
        plant.advance(1800 * factor, Drive(layout.VELOCITY, 0.0, 60.0, 0.0, 480.0, 0.0))
        command = Drive(layout.VELOCITY, 60.0, 60.0, 0.0, 480.0, 0.0)
        ends.append(plant.advance(900 * factor, command).truth)
    coarse, fine = ends
    assert np.abs(coarse.angle_rad - fine.angle_rad).max() < 5e-5
    force = np.hypot(fine.force_e1_N, fine.force_n1_N)
    assert np.abs(coarse.force_e1_N - fine.force_e1_N).max() < 1e-4 * force.max()
    assert np.abs(coarse.force_n1_N - fine.force_n1_N).max() < 1e-4 * force.max()
