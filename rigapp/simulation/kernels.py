"""The compiled plant: its constants and state, mechanics, sensing, time stepping.

Mechanics
---------
Generalised coordinate: the crank angle t. With sin p = -r sin t / l (p the follower's angle, l the
distance from crank pin to wrist) the velocity of every body is a coefficient (primed) times the
crank speed w, and Lagrange's equation is::

    J(t) a + J'(t) w^2 / 2 = Q          J = J0 + m2 (x2'^2 + y2'^2) + I2 p'^2 + m3 x3'^2
    Q = motor - bearing + Fs x3' + weight - M (1 - p')

The follower is longer by the running clearance c on the side of the pin (pin to centre of mass
L/2 + c), shorter when the spring keeps it in compression. M is the friction couple of the joint,
mu / sqrt(1 + mu^2) R1 |F|: the tangential force mu N acts at the pin's surface and |F|^2 =
N^2 (1 + mu^2). |F| depends on the acceleration: fixed-point iteration, contraction about mu R1 / L,
two passes. F then follows from the same instant's acceleration (Newton-Euler on slider, follower).

Sensing
-------
Frames: the load cell sits in the pin, which is clamped to the crank, so it measures in the crank
frame, and it measures the force ON THE PIN, which is -F. The probes are clamped to the follower.
The pin leans against the bushing in the direction of the normal force on the follower: with the
follower in tension (F_e2 < 0) its centre stands at -c along e2, c = running clearance + wear +
elastic approach. In the mechanics the follower's length has clearance and wear, not the approach,
which is a hundred times smaller.
Noise depends on seed, kind and sample number only, so it does not know how samples are grouped.
Samples count anew from every departure from rest, and the drift begins with the first one: how long
the rig stood before, which is up to whoever starts it, does not change a test of the same seed.

Time stepping
-------------
Classical Runge-Kutta of fourth order, fixed step. Dry friction keeps its sense within a step; a
step that would reverse the crank ends at rest, and the next one decides whether friction holds it.
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import float64, int64, types, uint64
from numpy.typing import NDArray

from model.compiled import njit
from rigapp.simulation.wall import (
    APPROACH,
    BORE,
    LASTS,
    ROW,
    SQUARE,
    TOP,
    WALL,
    Bore,
    Wall,
    looked_up,
    renew,
    worn,
)

Array = NDArray[np.float64]
Numbers = tuple[float, ...]

F = types.float64
U = types.uint64


class Constants(NamedTuple):
    """Hold everything that does not change while the plant runs; SI units.

    see: what each probe sees of the motion along and across the follower (its direction).
    bench: 1 with the follower taken off, for calibration: the pin then carries a weight (N, towards
    -y) and the probes face micrometers (m); 0 with the mechanism together. outboard: mass of the
    pin outboard of the gauges times its radius, kg m; its inertia presses the cell outward.
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
) = range(13)
STATES = 13
"""State vector: rad, rad/s, N m, m, m^2, N, s, N m, A, J, J, rad/s^2, s (when drift began)."""

SAMPLE, PHASE, HEAD, DEPARTURES, DEPARTED_AT, HELD = range(6)
COUNTERS = 6
EPOCH = 40
"""Bits of the noise's index that count samples; those above count departures."""

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


WANDER = 0.137
"""Turns of the slow wander of the speed a turn of the crank."""


POSITION = types.UniTuple(F, 9)


@njit(POSITION(CONSTANTS, F, F), cache=True)
def geometry(k: Constants, angle: float, depth: float) -> Numbers:
    """Return (sin t, cos t, sin p, cos p, p', p'', x3, x3', x3'')."""
    length = k.follower_length + k.lengthening_sign * (k.clearance + depth)
    r = k.crank_radius
    sin_t = math.sin(angle)
    cos_t = math.cos(angle)
    sin_p = -r * sin_t / length
    cos_p = math.sqrt(1.0 - sin_p * sin_p)
    p1 = -r * cos_t / (length * cos_p)
    p2 = (r * sin_t + length * sin_p * p1 * p1) / (length * cos_p)
    x3 = r * cos_t + length * cos_p
    x31 = -r * sin_t - length * sin_p * p1
    x32 = -r * cos_t - length * (cos_p * p1 * p1 + sin_p * p2)
    return sin_t, cos_t, sin_p, cos_p, p1, p2, x3, x31, x32


@njit(types.UniTuple(F, 15)(CONSTANTS, F, F), cache=True)
def bodies(k: Constants, angle: float, depth: float) -> Numbers:
    """Return the coefficients of one position.

    (sin p, cos p, p', p'', x3', x3'', x2', x2'', y2', y2'', arm, spring force, J, J'/2, Q of spring
    and weight); arm is the distance from pin to centre of mass.
    """
    sin_t, cos_t, sin_p, cos_p, p1, p2, x3, x31, x32 = geometry(k, angle, depth)
    arm = 0.5 * k.follower_length + k.lengthening_sign * (k.clearance + depth)
    r = k.crank_radius
    m2 = k.follower_mass
    m3 = k.slider_mass
    i2 = k.follower_inertia
    x21 = -r * sin_t - arm * sin_p * p1
    x22 = -r * cos_t - arm * (cos_p * p1 * p1 + sin_p * p2)
    y21 = r * cos_t + arm * cos_p * p1
    y22 = -r * sin_t + arm * (cos_p * p2 - sin_p * p1 * p1)
    inertia = k.crank_inertia + m2 * (x21 * x21 + y21 * y21) + i2 * p1 * p1 + m3 * x31 * x31
    half_slope = m2 * (x21 * x22 + y21 * y22) + i2 * p1 * p2 + m3 * x31 * x32
    spring = -k.stiffness * (x3 - k.free_position)
    along = k.gravity_x * (m2 * x21 + m3 * x31 - k.crank_first_moment * sin_t)
    across = k.gravity_y * (m2 * y21 + k.crank_first_moment * cos_t)
    pull = spring * x31 + along + across
    return (
        sin_p, cos_p, p1, p2, x31, x32, x21, x22, y21, y22, arm, spring, inertia, half_slope, pull,
    )  # fmt: skip


@njit(types.UniTuple(F, 2)(CONSTANTS, types.UniTuple(F, 15), F, F, F), cache=True)
def reaction(
    k: Constants, b: Numbers, acceleration: float, square: float, couple: float
) -> tuple[float, float]:
    """Return (Fx, Fy) on the follower by the pin for a crank acceleration and speed squared."""
    sin_p, cos_p, p1, p2, x31, x32, x21, x22, y21, y22, arm, spring, _, _, _ = b
    half = 0.5 * k.follower_length
    m2 = k.follower_mass
    inertial_x = m2 * (x21 * acceleration + x22 * square - k.gravity_x)
    inertial_y = m2 * (y21 * acceleration + y22 * square - k.gravity_y)
    wrist = k.slider_mass * (x31 * acceleration + x32 * square - k.gravity_x) - spring
    turning = k.follower_inertia * (p1 * acceleration + p2 * square)
    fx = inertial_x + wrist
    moment = arm * sin_p * fx + half * sin_p * wrist + half * cos_p * inertial_y + couple - turning
    return fx, moment / ((arm + half) * cos_p)


@njit(types.UniTuple(F, 5)(CONSTANTS, F, F, F, F, F, F), cache=True)
def motion(
    k: Constants,
    angle: float,
    speed: float,
    depth: float,
    torque: float,
    sense: float,
    force_guess: float,
) -> tuple[float, float, float, float, float]:
    """Return (acceleration, Fx, Fy, |F|, friction torque) while the crank turns or breaks away.

    sense is the sense of dry friction, +1 or -1, or 0 for none.
    """
    b = bodies(k, angle, depth)
    p1 = b[2]
    inertia = b[12]
    square = speed * speed
    free = torque + b[14] - b[13] * square
    lever = k.joint_friction * k.pin_radius
    bearing = sense * k.bearing_torque + k.bearing_viscous * speed
    force = force_guess
    acceleration = 0.0
    fx = 0.0
    fy = 0.0
    friction = 0.0
    for _ in range(2):
        couple = sense * lever * force
        friction = couple * (1.0 - p1) + bearing
        acceleration = (free - friction) / inertia
        fx, fy = reaction(k, b, acceleration, square, couple)
        force = math.sqrt(fx * fx + fy * fy)
    return acceleration, fx, fy, force, friction


@njit(types.UniTuple(F, 3)(CONSTANTS, F, F), cache=True)
def resting(k: Constants, angle: float, depth: float) -> tuple[float, float, float]:
    """Return (Fx, Fy, |F|) of the crank held at rest, no friction in the joint."""
    fx, fy = reaction(k, bodies(k, angle, depth), 0.0, 0.0, 0.0)
    return fx, fy, math.sqrt(fx * fx + fy * fy)


@njit(types.UniTuple(F, 2)(CONSTANTS, F, F, F), cache=True)
def energy(k: Constants, angle: float, speed: float, depth: float) -> tuple[float, float]:
    """Return (kinetic, potential) energy in J; potential: spring and weight."""
    b = bodies(k, angle, depth)
    sin_t, cos_t, sin_p, cos_p, _, _, x3, _, _ = geometry(k, angle, depth)
    stretch = x3 - k.free_position
    x2 = k.crank_radius * cos_t + b[10] * cos_p
    y2 = k.crank_radius * sin_t + b[10] * sin_p
    height_x = k.crank_first_moment * cos_t + k.follower_mass * x2 + k.slider_mass * x3
    height_y = k.crank_first_moment * sin_t + k.follower_mass * y2
    weight = k.gravity_x * height_x + k.gravity_y * height_y
    return 0.5 * b[12] * speed * speed, 0.5 * k.stiffness * stretch * stretch - weight


@njit(types.UniTuple(F, 3)(CONSTANTS, DRIVE, F, F, F, F), cache=True)
def motor(
    k: Constants, d: Drive, angle: float, speed: float, integral: float, fraction: float
) -> tuple[float, float, float]:
    """Return (torque, rate of the velocity loop's integrator, current).

    Velocity: PI on set-point minus measured speed; duty: voltage = duty times supply. The torque is
    bounded by the drive's current limit and by what the supply can push against the back-EMF.
    The measured speed is wrong by the ripple, twice a turn (an eccentric encoder disc), and by a
    fifth of it in a slow wander, so that a turn is never quite a whole number of samples.
    """
    if d.mode == OFF:
        return 0.0, 0.0, 0.0
    emf = k.torque_constant * speed
    highest = min(k.torque_limit, k.torque_constant * (d.supply - emf) / k.resistance)
    lowest = max(-k.torque_limit, k.torque_constant * (-d.supply - emf) / k.resistance)
    rate = 0.0
    if d.mode == VELOCITY:
        fault = math.sin(2.0 * angle) + 0.2 * math.sin(WANDER * angle)
        measured = speed * (1.0 + k.ripple * fault)
        error = d.speed_start + (d.speed_end - d.speed_start) * fraction - measured
        wanted = k.proportional * error + integral
        winding = (wanted > highest and error > 0.0) or (wanted < lowest and error < 0.0)
        rate = 0.0 if winding else k.integral * error
    else:
        wanted = k.torque_constant * (d.duty * d.supply - emf) / k.resistance
    torque = max(lowest, min(highest, wanted))
    return torque, rate, torque / k.torque_constant


@njit(BORE(CONSTANTS), cache=True)
def bore(k: Constants) -> Bore:
    """Return what the wall of the bushing needs to know of the joint."""
    return Bore(k.pin_radius, k.bushing_radius, k.width, k.wear_coefficient)


REST_FORCE = 0.05
"""Below about this force (N) the pin floats off the wall towards the bushing's centre."""


@njit(uint64(U, U, U), cache=True)
def random_bits(seed: np.uint64, kind: np.uint64, index: np.uint64) -> np.uint64:
    """Return 64 random bits that depend on seed, kind and index only (SplitMix64 finaliser)."""
    z = seed * np.uint64(0xD1342543DE82EF95) + kind * np.uint64(0xA0761D6478BD642F)
    z = z + (index + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z = z ^ (z >> np.uint64(31))
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    return z ^ (z >> np.uint64(31))


@njit(types.UniTuple(F, 2)(U, U, U), cache=True)
def normal_pair(seed: np.uint64, kind: np.uint64, index: np.uint64) -> tuple[float, float]:
    """Return two independent standard normal numbers (Box-Muller)."""
    bits = random_bits(seed, kind, index)
    scale = 1.0 / 4294967296.0
    u = (float(bits >> np.uint64(32)) + 0.5) * scale
    v = (float(bits & np.uint64(0xFFFFFFFF)) + 0.5) * scale
    radius = math.sqrt(-2.0 * math.log(u))
    return radius * math.cos(2.0 * math.pi * v), radius * math.sin(2.0 * math.pi * v)


@njit(types.float64[::1](U, U, int64, int64), cache=True)
def uniform(seed: np.uint64, kind: np.uint64, first: int, count: int) -> Array:
    """Return numbers in [0, 1) for samples first ... first + count - 1."""
    numbers = np.empty(count)
    for i in range(count):
        bits = random_bits(seed, kind, np.uint64(first + i))
        numbers[i] = float(bits >> np.uint64(11)) / 9007199254740992.0
    return numbers


@njit(float64(float64[:, ::1], int64, int64, F), cache=True)
def delayed(ring: Array, row: int, head: int, steps: float) -> float:
    """Return the value of ``steps`` steps ago: cubic Lagrange through the four nearest points."""
    if steps == 0.0:
        return ring[row, head]
    size = ring.shape[1]
    start = max(int(steps) - 1, 0)
    x = steps - start
    a = ring[row, (head - start) % size]
    b = ring[row, (head - start - 1) % size]
    c = ring[row, (head - start - 2) % size]
    d = ring[row, (head - start - 3) % size]
    return (
        -a * (x - 1.0) * (x - 2.0) * (x - 3.0) / 6.0
        + b * x * (x - 2.0) * (x - 3.0) / 2.0
        - c * x * (x - 1.0) * (x - 3.0) / 2.0
        + d * x * (x - 1.0) * (x - 2.0) / 6.0
    )


@njit(types.UniTuple(F, 4)(CONSTANTS, SQUARE, ROW, POSITION, F, F, F, F), cache=True)
def views(
    k: Constants,
    table: Array,
    wall_state: Array,
    position: Numbers,
    depth: float,
    fx: float,
    fy: float,
    sense: float,
) -> tuple[float, float, float, float]:
    """Return (F_e1, F_n1, pin along e2, pin along n2): N, N, m, m.

    F is the normal force turned by the friction angle in the sense of sliding; an eccentric pin
    adds its run-out, which turns with the pin against the follower. On the bench the pin carries
    the weight alone (its force on the pin is -F, so the sign turns) and the probes see micrometers.
    position: from ``geometry``.
    """
    sin_t, cos_t, sin_p, cos_p, _, _, _, _, _ = position
    if k.bench == 1.0:
        return k.weight * sin_t, k.weight * cos_t, k.micrometer_1, k.micrometer_2
    e1 = fx * cos_t + fy * sin_t
    n1 = -fx * sin_t + fy * cos_t
    e2 = fx * cos_p + fy * sin_p
    n2 = -fx * sin_p + fy * cos_p
    force = math.sqrt(e2 * e2 + n2 * n2 + REST_FORCE * REST_FORCE)
    lean = (k.clearance + depth + looked_up(table, wall_state, force, APPROACH)) / force
    cosine = math.sqrt(1.0 - k.joint_friction * k.joint_friction)
    sine = sense * k.joint_friction
    along = lean * (cosine * e2 + sine * n2) + k.run_out * (cos_t * cos_p + sin_t * sin_p)
    across = lean * (cosine * n2 - sine * e2) + k.run_out * (sin_t * cos_p - cos_t * sin_p)
    return e1, n1, along, across


@njit(float64(F, F), cache=True)
def quantised(value: float, step: float) -> float:
    """Return the nearest multiple of step (the value itself for step 0)."""
    if step == 0.0:
        return value
    return math.floor(value / step + 0.5) * step


@njit(
    types.void(CONSTANTS, float64[::1], float64[:, ::1], int64, U, U, F, float64[:, ::1], int64),
    cache=True,
)
def emit(
    k: Constants,
    state: Array,
    ring: Array,
    head: int,
    index: np.uint64,
    seed: np.uint64,
    delay_steps: float,
    out: Array,
    column: int,
) -> None:
    """Write one sample: the terminals (analog late by the delay, encoder not) and the truth."""
    time = state[TIME]
    warm = time - state[WARM]
    noise_1, noise_2 = normal_pair(seed, np.uint64(1), index)
    noise_3, noise_4 = normal_pair(seed, np.uint64(2), index)
    on_pin_1 = k.outboard * state[SPEED] ** 2 - delayed(ring, 0, head, delay_steps)
    on_pin_2 = -delayed(ring, 1, head, delay_steps)
    bridge_1 = k.cell_11 * on_pin_1 + k.cell_12 * on_pin_2 + k.noise_1 * noise_1 + k.drift_1 * warm
    bridge_2 = k.cell_21 * on_pin_1 + k.cell_22 * on_pin_2 + k.noise_2 * noise_2 + k.drift_2 * warm
    along = delayed(ring, 2, head, delay_steps)
    across = delayed(ring, 3, head, delay_steps)
    probe_1 = k.see_11 * along + k.see_12 * across + k.probe_noise * noise_3
    probe_2 = k.see_21 * along + k.see_22 * across + k.probe_noise * noise_4
    angle = state[ANGLE]
    out[OUT_SHAFT, column] = k.encoder_direction * (angle - k.index_angle) / (2.0 * math.pi)
    out[OUT_BRIDGE_1, column] = quantised(bridge_1, k.step_1) + k.zero_1
    out[OUT_BRIDGE_2, column] = quantised(bridge_2, k.step_2) + k.zero_2
    out[OUT_PROBE_1, column] = probe_1 * k.volts_per_metre_1 + k.offset_1
    out[OUT_PROBE_2, column] = probe_2 * k.volts_per_metre_2 + k.offset_2
    out[OUT_TIME, column] = time
    out[OUT_ANGLE, column] = angle
    out[OUT_SPEED, column] = state[SPEED]
    out[OUT_FORCE_1, column] = ring[0, head]
    out[OUT_FORCE_2, column] = ring[1, head]
    out[OUT_DEPTH, column] = state[DEPTH]


@njit(types.UniTuple(F, 2)(CONSTANTS, DRIVE, float64[::1], F), cache=True)
def friction_sense(k: Constants, d: Drive, state: Array, fraction: float) -> tuple[float, float]:
    """Return (sense of dry friction, 1 if it holds the crank at rest else 0)."""
    if state[SPEED] > 0.0:
        return 1.0, 0.0
    if state[SPEED] < 0.0:
        return -1.0, 0.0
    angle = state[ANGLE]
    depth = state[DEPTH]
    torque, _, _ = motor(k, d, angle, 0.0, state[INTEGRAL], fraction)
    force = state[FORCE]
    free, _, _, _, _ = motion(k, angle, 0.0, depth, torque, 0.0, force)
    sense = 1.0 if free > 0.0 else -1.0
    left = torque - sense * d.extra_friction_Nm
    slowed, _, _, _, _ = motion(k, angle, 0.0, depth, left, sense, force)
    return sense, (1.0 if slowed * sense <= 0.0 else 0.0)


@njit(types.void(CONSTANTS, DRIVE, SQUARE, ROW, POSITION, float64[::1], F, F, F, F, F), cache=True)
def turn(
    k: Constants,
    d: Drive,
    table: Array,
    wall_state: Array,
    position: Numbers,
    state: Array,
    dt: float,
    start: float,
    end: float,
    sense: float,
    first: float,
) -> None:
    """Advance the turning crank by one step.

    first is the acceleration at its start, position what ``geometry`` says of it.
    start and end are the step's place in the chunk, 0 ... 1, for the set-point between its ends.
    """
    half = 0.5 * dt
    middle = 0.5 * (start + end)
    angle = state[ANGLE]
    speed = state[SPEED]
    integral = state[INTEGRAL]
    depth = state[DEPTH]
    force = state[FORCE]
    extra = sense * d.extra_friction_Nm
    t1, i1, _ = motor(k, d, angle, speed, integral, start)
    _, _, _, n1, r1 = motion(k, angle, speed, depth, t1 - extra, sense, force)
    v2 = speed + half * first
    x2 = angle + half * speed
    t2, i2, _ = motor(k, d, x2, v2, integral + half * i1, middle)
    a2, _, _, n2, r2 = motion(k, x2, v2, depth, t2 - extra, sense, n1)
    v3 = speed + half * a2
    x3 = angle + half * v2
    t3, i3, _ = motor(k, d, x3, v3, integral + half * i2, middle)
    a3, _, _, n3, r3 = motion(k, x3, v3, depth, t3 - extra, sense, n2)
    v4 = speed + dt * a3
    x4 = angle + dt * v3
    t4, i4, _ = motor(k, d, x4, v4, integral + dt * i3, end)
    a4, _, _, n4, r4 = motion(k, x4, v4, depth, t4 - extra, sense, n3)
    sixth = dt / 6.0
    turned = sixth * (speed + 2.0 * v2 + 2.0 * v3 + v4)
    reached = speed + sixth * (first + 2.0 * a2 + 2.0 * a3 + a4)
    mean = (n1 + 2.0 * n2 + 2.0 * n3 + n4) / 6.0
    slip = k.pin_radius * abs(turned) * (1.0 - position[4] - 0.5 * turned * position[5])
    deeper, area = worn(table, wall_state, k.wear_coefficient, mean, slip)
    state[ANGLE] = angle + turned
    state[SPEED] = reached if reached * sense > 0.0 else 0.0
    state[INTEGRAL] = integral + sixth * (i1 + 2.0 * i2 + 2.0 * i3 + i4)
    state[WORK] += sixth * (t1 * speed + 2.0 * t2 * v2 + 2.0 * t3 * v3 + t4 * v4)
    lost = (r1 + extra) * speed + 2.0 * (r2 + extra) * v2 + 2.0 * (r3 + extra) * v3
    state[LOSS] += sixth * (lost + (r4 + extra) * v4)
    state[DEPTH] = depth + deeper
    state[AREA] += area


@njit(
    int64(
        CONSTANTS,
        DRIVE,
        WALL,
        float64[::1],
        int64[::1],
        float64[:, ::1],
        float64[:, ::1],
        int64,
        int64,
        F,
        F,
        uint64,
    ),
    cache=True,
)
def advance(
    k: Constants,
    d: Drive,
    wall: Wall,
    state: Array,
    counters: NDArray[np.int64],
    ring: Array,
    out: Array,
    steps: int,
    steps_per_sample: int,
    dt: float,
    delay_steps: float,
    seed: np.uint64,
) -> int:
    """Advance by ``steps`` steps of dt; write the samples that fall due and return their number.

    A sample is taken at the start of every steps_per_sample-th step. State, counters, ring and wall
    carry everything over: under a constant command the result does not depend on how the steps are
    cut into calls. ring: (4, size) past values of what ``views`` returns, newest at counters[HEAD].
    """
    samples = 0
    size = ring.shape[1]
    table, wall_state = wall.table, wall.state
    for step in range(steps):
        if wall_state[LASTS] <= 0.0 or state[FORCE] > wall_state[TOP]:
            renew(wall, bore(k), state[FORCE])
        start = step / steps
        sense, held = friction_sense(k, d, state, start)
        angle = state[ANGLE]
        speed = state[SPEED]
        depth = state[DEPTH]
        torque, rate, current = motor(k, d, angle, speed, state[INTEGRAL], start)
        if held == 1.0:
            acceleration = 0.0
            fx, fy, force = resting(k, angle, depth)
            sliding = 0.0
        else:
            left = torque - sense * d.extra_friction_Nm
            acceleration, fx, fy, force, _ = motion(
                k, angle, speed, depth, left, sense, state[FORCE]
            )
            sliding = sense
        position = geometry(k, angle, depth)
        head = (counters[HEAD] + 1) % size
        ring[0, head], ring[1, head], ring[2, head], ring[3, head] = views(
            k, table, wall_state, position, depth, fx, fy, sliding
        )
        counters[HEAD] = head
        state[TORQUE] = torque
        state[CURRENT] = current
        state[FORCE] = force
        state[ACCELERATION] = acceleration
        if counters[HELD] == 1 and held == 0.0:
            if counters[DEPARTURES] == 0:
                state[WARM] = state[TIME]
            counters[DEPARTURES] += 1
            counters[DEPARTED_AT] = counters[SAMPLE]
        counters[HELD] = int64(held)
        if counters[PHASE] == 0:
            index = np.uint64(counters[SAMPLE] - counters[DEPARTED_AT])
            index += np.uint64(counters[DEPARTURES] << EPOCH)
            emit(k, state, ring, head, index, seed, delay_steps, out, samples)
            counters[SAMPLE] += 1
            samples += 1
        counters[PHASE] = (counters[PHASE] + 1) % steps_per_sample
        if held == 1.0:
            state[INTEGRAL] += dt * rate
        else:
            turn(
                k,
                d,
                table,
                wall_state,
                position,
                state,
                dt,
                start,
                (step + 1.0) / steps,
                sense,
                acceleration,
            )
        state[TIME] += dt
    return samples
