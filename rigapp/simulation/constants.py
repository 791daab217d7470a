"""Compute the constants of the plant from the mechanism and the rig file."""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib import resources

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import PlantSection, RigFile
from rigapp.simulation.impacts import damping_of
from rigapp.simulation.layout import Constants


@dataclass(frozen=True, slots=True)
class Machine:
    """Constants missing in paper and rig file: spindle, motor, velocity loop [assumed].

    The torque constant gives 800 rpm at 48 V without load; the velocity loop is critically damped.
    """

    flywheel_kg_m2: float = 0.0847
    rotor_kg_m2: float = 0.002
    bearing_torque_Nm: float = 0.25
    bearing_viscous_Nm_s: float = 0.002
    torque_constant_Nm_per_A: float = 0.573
    resistance_ohm: float = 0.5
    bandwidth_Hz: float = 20.0
    supply_V: float = 48.0


def packaged_parameters() -> ParameterFile:
    """Return the built-in mechanism: the paper's values as examples/quick.toml has them."""
    text = resources.files("rigapp.simulation").joinpath("mechanism.toml").read_text("utf-8")
    return msgspec.toml.decode(text, type=ParameterFile)


def plant_section(rig: RigFile) -> PlantSection:
    """Return [simulation.plant], or its defaults if the rig file has none."""
    return rig.simulation.plant if rig.simulation is not None else PlantSection()


def seed_of(rig: RigFile) -> int:
    """Return the seed of the simulated rig's noise."""
    return rig.simulation.seed if rig.simulation is not None else 1


def plant_constants(
    parameters: ParameterFile, rig: RigFile, machine: Machine | None = None
) -> Constants:
    """Return the plant's constants in SI units; raise UnusableInput for an impossible mechanism."""
    machine = Machine() if machine is None else machine
    plant = plant_section(rig)
    m = parameters.mechanism
    joint = parameters.joint
    radius = m.crank_radius_mm * 1e-3
    length = m.follower_length_mm * 1e-3
    bushing_radius = joint.bushing_radius_mm * 1e-3 + plant.clearance_error_um * 1e-6
    clearance = bushing_radius - joint.pin_radius_mm * 1e-3
    stiffness, free = _spring(parameters, plant, radius + length)
    sign = _lengthening_sign(stiffness, free, length)
    _check(radius, length + sign * clearance, clearance)
    crank = m.crank_inertia_kg_m2 + 0.25 * m.crank_mass_kg * radius**2
    inertia = machine.flywheel_kg_m2 + machine.rotor_kg_m2 + crank
    slider = (m.slider_mass_kg + m.added_mass_kg) * plant.slider_mass_factor
    rate = 2.0 * math.pi * machine.bandwidth_Hz
    follower = m.follower_mass_kg * plant.follower_mass_factor
    mean_inertia = inertia + 0.5 * (follower + slider) * radius**2
    friction = plant.joint_friction_coefficient
    cell = _cell(rig, plant)
    believed = np.linalg.norm(np.linalg.inv(_matrix(rig)), axis=1)
    zero = rig.load_cell.zero_mV_per_V
    volts = _volts_per_metre(rig, plant)
    see_1, see_2 = (math.radians(angle) for angle in plant.probe_misalignment_deg)
    constants = Constants(
        crank_radius=radius,
        follower_length=length,
        lengthening_sign=sign,
        crank_inertia=inertia,
        crank_first_moment=0.5 * m.crank_mass_kg * radius,
        follower_mass=follower,
        follower_inertia=m.follower_inertia_kg_m2 * plant.follower_mass_factor,
        slider_mass=slider,
        gravity_x=m.gravity_m_s2[0],
        gravity_y=m.gravity_m_s2[1],
        stiffness=stiffness,
        free_position=free,
        pin_radius=joint.pin_radius_mm * 1e-3,
        bushing_radius=bushing_radius,
        clearance=clearance,
        width=joint.bushing_width_mm * 1e-3,
        outer_radius=joint.bushing_outer_radius_mm * 1e-3,
        youngs_modulus=parameters.bushing.youngs_modulus_MPa * 1e6,
        poissons_ratio=parameters.bushing.poissons_ratio,
        wear_coefficient=parameters.bushing.wear_coefficient_mm3_per_Nm
        * 1e-9
        * plant.wear_coefficient_factor,
        running_in_factor=plant.running_in_factor,
        running_in_depth=plant.running_in_depth_um * 1e-6,
        wear_change_factor=plant.wear_change_factor,
        wear_change_depth=plant.wear_change_depth_um * 1e-6,
        joint_friction=friction / math.sqrt(1.0 + friction**2),
        bearing_torque=machine.bearing_torque_Nm,
        bearing_viscous=machine.bearing_viscous_Nm_s,
        torque_limit=plant.motor_torque_limit_Nm,
        torque_constant=machine.torque_constant_Nm_per_A,
        resistance=machine.resistance_ohm,
        proportional=rate * mean_inertia,
        integral=0.25 * rate**2 * mean_inertia,
        ripple=plant.speed_ripple_percent / 100.0,
        run_out=plant.pin_run_out_um * 1e-6,
        probe_noise=plant.probe_noise_um * 1e-6,
        noise_1=plant.force_noise_N * believed[0],
        noise_2=plant.force_noise_N * believed[1],
        drift_1=plant.force_drift_N_per_hour / 3600.0 * believed[0],
        drift_2=plant.force_drift_N_per_hour / 3600.0 * believed[1],
        step_1=plant.force_resolution_N * believed[0],
        step_2=plant.force_resolution_N * believed[1],
        cell_11=cell[0, 0],
        cell_12=cell[0, 1],
        cell_21=cell[1, 0],
        cell_22=cell[1, 1],
        zero_1=zero[0],
        zero_2=zero[1],
        volts_per_metre_1=volts[0],
        volts_per_metre_2=volts[1],
        offset_1=rig.probes.offset_V[0],
        offset_2=rig.probes.offset_V[1],
        see_11=math.cos(see_1),
        see_12=math.sin(see_1),
        see_21=-math.sin(see_2),
        see_22=math.cos(see_2),
        index_angle=math.radians(rig.encoder.index_angle_deg),
        encoder_direction=rig.encoder.direction,
        bench=0.0,
        weight=0.0,
        micrometer_1=0.0,
        micrometer_2=0.0,
        outboard=plant.outboard_mass_factor
        * rig.load_cell.outboard_mass_kg
        * rig.load_cell.outboard_radius_mm
        * 1e-3,
        heating_K_per_W=plant.bushing_heating_K_per_W,
        heating_time_s=plant.bushing_time_constant_s,
        pin_mass=plant.pin_mass_kg,
        creep=plant.bushing_creep_um_per_decade * 1e-6,
        loose=0.0 if plant.restitution is None else 1.0,
        impact_damping=0.0 if plant.restitution is None else damping_of(plant.restitution),
    )
    return Constants(*map(float, constants))


def _spring(
    parameters: ParameterFile, plant: PlantSection, outermost: float
) -> tuple[float, float]:
    """Return stiffness and free position; without a spring, stiffness 0."""
    if parameters.spring is None:
        return 0.0, outermost
    stiffness = parameters.spring.stiffness_N_per_m * plant.spring_stiffness_factor
    return stiffness, parameters.spring.free_position_mm * 1e-3


def _lengthening_sign(stiffness: float, free_position: float, middle: float) -> float:
    """Return +1 if the spring (or no spring) keeps the follower in tension, -1 in compression.

    In tension the pin touches the wall away from the wrist: the follower is effectively longer by
    c. In compression it touches the other wall: the same equations with -c.
    """
    return -1.0 if stiffness > 0.0 and free_position < middle else 1.0


def _check(radius: float, length: float, clearance: float) -> None:
    if clearance < 0.0:
        raise UnusableInput(
            "joint.bushing_radius_mm is smaller than joint.pin_radius_mm; the pin does not fit."
        )
    if not 0.0 < radius < length:
        raise UnusableInput(
            "mechanism.follower_length_mm must be greater than"
            " mechanism.crank_radius_mm (both above 0), or the crank cannot turn."
        )


def _volts_per_metre(rig: RigFile, plant: PlantSection) -> list[float]:
    """Return the probes' true sensitivities: the rig file's with the plant's errors."""
    pairs = zip(rig.probes.sensitivity_um_per_V, plant.probe_sensitivity_error_percent, strict=True)
    return [1e6 / (believed * (1.0 + error / 100.0)) for believed, error in pairs]


def _matrix(rig: RigFile) -> NDArray[np.float64]:
    return np.array(rig.load_cell.matrix_N_per_mV_per_V, dtype=np.float64)


def _cell(rig: RigFile, plant: PlantSection) -> NDArray[np.float64]:
    """Return the true cell, mV/V per N on the pin: the rig file's matrix with cross-talk x.

    True force = (I + X) matrix signal with X = [[0, x], [x, 0]], so that with the uncorrected
    matrix component 1 reads too low by x times component 2, and the reverse; with a gain error,
    both read too high by it.
    """
    x = plant.cross_talk_percent / 100.0
    true = np.array([[1.0, x], [x, 1.0]]) @ _matrix(rig)
    gain = 1.0 + plant.cell_gain_error_percent / 100.0
    return np.asarray(gain * np.linalg.inv(true), dtype=np.float64)
