"""Data layout of the compiled plant: constants, drive command, state, output.

SI units.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STANDARD_GRAVITY_M_S2 = 9.80665


class Constants(NamedTuple):
    """The constants of the plant; SI units.

    see: direction of each probe, as components along and across the follower. bench: 1 with the
    follower removed, for calibration: the pin then carries a weight (N, towards -y) and the probes
    face micrometers (m); 0 with the mechanism assembled. outboard: mass of the pin outboard of the
    gauges times its radius, kg m; its inertia loads the cell outward. running_in, wear_change:
    dependence of K on the depth, see ``Plant.wear_coefficient``. heating: steady-state temperature
    rise of the bushing per friction power in the joint, and its time constant. pin_mass: kg,
    outboard of the gauges; its weight rotates relative to the cell. creep: m, of the bushing per
    decade of time. loose: 1 if the pin may leave the wall (``impacts``), with impact_damping; 0 if
    it always touches.
    """

    crank_radius: float
    follower_length: float
    lengthening_sign: float
    crank_inertia: float
    crank_first_moment: float
    follower_mass: float
    follower_inertia: float
    slider_mass: float
    gravity_x: float
    gravity_y: float
    stiffness: float
    free_position: float
    pin_radius: float
    bushing_radius: float
    clearance: float
    width: float
    outer_radius: float
    youngs_modulus: float
    poissons_ratio: float
    wear_coefficient: float
    running_in_factor: float
    running_in_depth: float
    wear_change_factor: float
    wear_change_depth: float
    joint_friction: float
    bearing_torque: float
    bearing_viscous: float
    torque_limit: float
    torque_constant: float
    resistance: float
    proportional: float
    integral: float
    ripple: float
    run_out: float
    probe_noise: float
    noise_1: float
    noise_2: float
    drift_1: float
    drift_2: float
    step_1: float
    step_2: float
    cell_11: float
    cell_12: float
    cell_21: float
    cell_22: float
    zero_1: float
    zero_2: float
    volts_per_metre_1: float
    volts_per_metre_2: float
    offset_1: float
    offset_2: float
    see_11: float
    see_12: float
    see_21: float
    see_22: float
    index_angle: float
    encoder_direction: float
    bench: float
    weight: float
    micrometer_1: float
    micrometer_2: float
    outboard: float
    heating_K_per_W: float
    heating_time_s: float
    pin_mass: float
    creep: float
    loose: float
    impact_damping: float


class Drive(NamedTuple):
    """Input of the motor during one call: mode, set-point at both ends, duty, supply.

    extra_friction_Nm: dry friction on the shaft in addition to the bearing's (a jam).
    """

    mode: float
    speed_start: float
    speed_end: float
    duty: float
    supply: float
    extra_friction_Nm: float


OFF, VELOCITY, DUTY = 0.0, 1.0, 2.0

(
    ANGLE,
    SPEED,
    INTEGRAL,
    DEPTH,
    AREA,
    FORCE,
    TIME,
    TORQUE,
    CURRENT,
    WORK,
    LOSS,
    ACCELERATION,
    WARM,
    RISE,
    SLIDER,
    SLIDER_SPEED,
    FOLLOWER,
    FOLLOWER_SPEED,
) = range(18)
STATES = 18
"""State vector: rad, rad/s, N m, m, m^2, N, s, N m, A, J, J, rad/s^2, s (start of the drift),
K (of the bushing above the room); of a joint that may lose contact: m, m/s, rad, rad/s."""

SAMPLE, PHASE, HEAD, DEPARTURES, DEPARTED_AT, HELD = range(6)
COUNTERS = 6
EPOCH = 40
"""Bits of the noise index for the sample number; the higher ones count departures."""

(
    OUT_SHAFT,
    OUT_BRIDGE_1,
    OUT_BRIDGE_2,
    OUT_PROBE_1,
    OUT_PROBE_2,
    OUT_TIME,
    OUT_ANGLE,
    OUT_SPEED,
    OUT_FORCE_1,
    OUT_FORCE_2,
    OUT_DEPTH,
    OUT_RISE,
    OUT_WARM,
) = range(13)
ROWS = 13
"""Rows of the output: revolutions, mV/V, mV/V, V, V, s, rad, rad/s, N, N, m, K, s since the first
departure from rest (0 before it); the following rows are standard normal noise, one per input."""
