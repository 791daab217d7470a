"""Mechanics of the compiled plant: slider-crank with joint friction, and its motor.

Generalised coordinate: the crank angle t. With sin p = -r sin t / l (p the follower's angle, l the
distance from crank pin to wrist) the velocity of every body is a coefficient (primed) times the
crank speed w, and Lagrange's equation is::

    J(t) a + J'(t) w^2 / 2 = Q          J = J0 + m2 (x2'^2 + y2'^2) + I2 p'^2 + m3 x3'^2
    Q = motor - bearing + Fs x3' + weight - M (1 - p')

The follower is longer by the running clearance c on the side of the pin (pin to centre of mass
L/2 + c), shorter if the spring keeps it in compression. M is the friction couple of the joint,
mu / sqrt(1 + mu^2) R1 |F|: the tangential force mu N acts at the pin's surface and |F|^2 =
N^2 (1 + mu^2). |F| depends on the acceleration: fixed-point iteration, contraction about mu R1 / L,
two passes. F then follows from the same instant's acceleration (Newton-Euler on slider, follower).
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math

from numba import float64, types

from rigapp.simulation.layout import OFF, VELOCITY, Constants, Drive
from rigapp.simulation.wall import BORE, Bore
from rigapp_model.compiled import UNCOUNTED, njit

Numbers = tuple[float, ...]
F = types.float64
CONSTANTS = types.NamedUniTuple(float64, len(Constants._fields), Constants)
DRIVE = types.NamedUniTuple(float64, len(Drive._fields), Drive)

WANDER = 0.137
"""Cycles of the slow speed wander per crank turn."""


POSITION = types.UniTuple(F, 9)


@njit(POSITION(CONSTANTS, F, F), forceinline=True, **UNCOUNTED)
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


@njit(types.UniTuple(F, 15)(CONSTANTS, F, F), forceinline=True, **UNCOUNTED)
def bodies(k: Constants, angle: float, depth: float) -> Numbers:
    """Return the coefficients of Lagrange's equation at one position.

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


@njit(
    types.UniTuple(F, 2)(CONSTANTS, types.UniTuple(F, 15), F, F, F), forceinline=True, **UNCOUNTED
)
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


@njit(types.UniTuple(F, 5)(CONSTANTS, F, F, F, F, F, F), forceinline=True, **UNCOUNTED)
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

    sense: sign of dry friction, +1 or -1, or 0 for none.
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


@njit(types.UniTuple(F, 3)(CONSTANTS, F, F), **UNCOUNTED)
def resting(k: Constants, angle: float, depth: float) -> tuple[float, float, float]:
    """Return (Fx, Fy, |F|) of the crank held at rest, without joint friction."""
    fx, fy = reaction(k, bodies(k, angle, depth), 0.0, 0.0, 0.0)
    return fx, fy, math.sqrt(fx * fx + fy * fy)


@njit(types.UniTuple(F, 2)(CONSTANTS, F, F, F), **UNCOUNTED)
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


@njit(types.UniTuple(F, 3)(CONSTANTS, DRIVE, F, F, F, F), forceinline=True, **UNCOUNTED)
def motor(
    k: Constants, d: Drive, angle: float, speed: float, integral: float, fraction: float
) -> tuple[float, float, float]:
    """Return (torque, rate of the velocity loop's integrator, current).

    Velocity: PI on set-point minus measured speed; duty: voltage = duty times supply. The torque is
    limited by the drive's current limit and by the supply voltage minus the back-EMF. The measured
    speed has a ripple error, twice per turn (eccentric encoder disc), and a fifth of it as a slow
    wander, so that a turn is never exactly a whole number of samples.
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
        demand = k.proportional * error + integral
        winding = (demand > highest and error > 0.0) or (demand < lowest and error < 0.0)
        rate = 0.0 if winding else k.integral * error
    else:
        demand = k.torque_constant * (d.duty * d.supply - emf) / k.resistance
    torque = max(lowest, min(highest, demand))
    return torque, rate, torque / k.torque_constant


@njit(BORE(CONSTANTS), **UNCOUNTED)
def bore(k: Constants) -> Bore:
    """Return the constants of the joint for the bushing's wall."""
    return Bore(k.pin_radius, k.bushing_radius, k.width, k.wear_coefficient)
