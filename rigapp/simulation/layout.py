"""What the compiled plant shares: constants, what acts on the motor, where each state is kept."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import float64, types
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Constants(NamedTuple):
    """Hold everything that does not change while the plant runs; SI units.

    bench: 1 with the follower taken off, for calibration: the pin then carries a weight (N, towards
    -y) and the probes face micrometers (m); 0 with the mechanism together.
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
    hertz: float
    wear_coefficient: float
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
    index_angle: float
    encoder_direction: float
    bench: float
    weight: float
    micrometer_1: float
    micrometer_2: float


class Drive(NamedTuple):
    """Hold what acts on the motor during one call: mode, set-point at both ends, duty, supply.

    extra_friction_Nm: dry friction on the shaft beyond the bearing's (a jam).
    """

    mode: float
    speed_start: float
    speed_end: float
    duty: float
    supply: float
    extra_friction_Nm: float


OFF, VELOCITY, DUTY = 0.0, 1.0, 2.0

CONSTANTS = types.NamedUniTuple(float64, len(Constants._fields), Constants)
DRIVE = types.NamedUniTuple(float64, len(Drive._fields), Drive)

(ANGLE, SPEED, INTEGRAL, DEPTH, AREA, FORCE, TIME, TORQUE, CURRENT, WORK, LOSS, ACCELERATION) = (
    range(12)
)
STATES = 12
"""State vector: rad, rad/s, N m, m, m^2, N, s, N m, A, J, J, rad/s^2."""

SAMPLE, PHASE, HEAD = range(3)
COUNTERS = 3

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
) = range(11)
ROWS = 11
"""Rows of the output: revolutions, mV/V, mV/V, V, V, s, rad, rad/s, N, N, m."""
