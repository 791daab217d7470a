"""Plant with loss of contact: slider and follower move freely within the clearance.

Coordinates: crank angle t, slider x and follower angle p, each with its speed. The gap between pin
and bore follows from them, and determines the contact force::

    N = K(d) + 2 z K(d) sqrt(m / (2 E(d))) d'      0 if negative (tension)

d: penetration; K: elastic force of the simulator's own wall (``wall``: closed-form waves of a ring,
conformal, neither the model's elements nor one of its contact laws); E: its integral; m: effective
mass along the normal; z: damping. In y = sqrt(2 E / m), the speed v and a time scaled by y / d'
this is the oscillator v' = -y - 2 z v: the coefficient of restitution e is the same at any speed
and for any K(d) (Antypov and Elliott, EPL 94, 2011, 50004, for Hertz's law). The contact ends where
v' = 0 (Schwager and Poeschel, Granular Matter 9, 2007, 465)::

    e = exp(-2 z arccos(z) / sqrt(1 - z^2))        z < 1; hyperbolic beyond

Friction depends on the sliding speed of the surfaces. A worn bore is a circle that is deeper by the
wear on the usually loaded side, and unchanged on the other. Runge-Kutta steps are so short that the
phase of the stiffest contact advances by SWING; a step that would pass the moment of touching or
separation ends there, so that no impact gains energy.
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math

import numpy as np
from numba import types

from rigapp.simulation.layout import (
    ANGLE,
    AREA,
    DEPTH,
    FOLLOWER,
    FOLLOWER_SPEED,
    INTEGRAL,
    LOSS,
    RISE,
    SLIDER,
    SLIDER_SPEED,
    SPEED,
    STATES,
    WORK,
    Array,
    Constants,
    Drive,
)
from rigapp.simulation.mechanics import CONSTANTS, DRIVE, F, Numbers, bore, motor, resting
from rigapp.simulation.wall import (
    APPROACH,
    HIGHEST_FORCE,
    LEVELS,
    ROW,
    SQUARE,
    WALL,
    Wall,
    looked_up,
    renew,
    worn,
)
from rigapp.simulation.wall import AREA as WORN_AREA
from rigapp_model.compiled import UNCOUNTED, njit

SWING = 0.12
"""Phase of the stiffest contact per step, rad: the fourth order then loses 1e-7 of the speed."""
TOUCH_M = 1e-10
"""Penetration tolerance of touching; impacts penetrate at least a thousand times deeper."""
MOST_CUTS = 8
"""Maximum secant steps to the moment of touch; three suffice at usual speeds."""
SLIDING_M_PER_S = 1e-3
"""Sliding speed at which friction reaches 0.7 of its full value."""
REST_M_PER_S, REST_M_PER_S2 = 1e-6, 1e-3
"""Below both, slider and follower are at rest while the crank is stationary."""
AT_CENTRE_M = 1e-15


def damping_of(restitution: float) -> float:
    """Return z for a coefficient of restitution (above 0, at most 1)."""

    def returned(z: float) -> float:
        if z < 1.0:
            return math.exp(-2.0 * z * math.acos(z) / math.sqrt(1.0 - z * z))
        return (
            math.exp(-2.0 * z * math.acosh(z) / math.sqrt(z * z - 1.0))
            if z > 1.0
            else math.exp(-2.0)
        )

    low, high = 0.0, 2.0 / restitution
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if returned(middle) > restitution else (low, middle)
    return low


@njit(types.UniTuple(F, 2)(SQUARE, ROW, F), **UNCOUNTED)
def pressed(table: Array, wall_state: Array, depth: float) -> tuple[float, float]:
    """Return (elastic force, energy stored in it), N and J, of a penetration in m."""
    force, energy = 0.0, 0.0
    if depth <= 0.0:
        return force, energy
    for level in range(LEVELS):
        low, high = table[level, APPROACH], table[level + 1, APPROACH]
        bottom = wall_state[HIGHEST_FORCE] * (level / LEVELS) ** 2
        stiffness = (
            wall_state[HIGHEST_FORCE] * (2.0 * level + 1.0) / (LEVELS * LEVELS * (high - low))
        )
        # Extrapolate linearly beyond the highest force of the table.
        deeper = depth - low if level == LEVELS - 1 else min(depth, high) - low
        force = bottom + stiffness * deeper
        energy += (bottom + 0.5 * stiffness * deeper) * deeper
        if depth <= high:
            break
    return force, energy


TOUCHING = types.UniTuple(F, 12)


@njit(TOUCHING(CONSTANTS, SQUARE, ROW, ROW, F), **UNCOUNTED)
def touch(k: Constants, table: Array, wall_state: Array, state: Array, turns: float) -> Numbers:
    """Return the state of the joint at one moment; forces act on the follower by the pin.

    (Fx, Fy, normal force, elastic force, its energy, penetration, its rate, sliding speed,
    friction, normal x, normal y, mass along it). turns: 1, or 0 for a locked crank.
    """
    speed, slider_speed, turning = state[SPEED], state[SLIDER_SPEED], state[FOLLOWER_SPEED]
    sin_t, cos_t = math.sin(state[ANGLE]), math.cos(state[ANGLE])
    sin_p, cos_p = math.sin(state[FOLLOWER]), math.cos(state[FOLLOWER])
    r, half = k.crank_radius, 0.5 * k.follower_length
    # Circle of the worn bore: its radius grows, and its centre moves, by half the depth each.
    length = k.follower_length + 0.5 * k.lengthening_sign * state[DEPTH]
    dx = r * cos_t - state[SLIDER] + length * cos_p
    dy = r * sin_t + length * sin_p
    ux = -r * sin_t * speed - slider_speed - length * sin_p * turning
    uy = r * cos_t * speed + length * cos_p * turning
    distance = math.sqrt(dx * dx + dy * dy)
    nx, ny = -k.lengthening_sign * cos_p, -k.lengthening_sign * sin_p
    if distance > AT_CENTRE_M:
        nx, ny = dx / distance, dy / distance
    deep = distance - k.clearance - 0.5 * state[DEPTH]
    rate = ux * nx + uy * ny
    along = r * (ny * cos_t - nx * sin_t) * turns
    about = length * (cos_p * ny - sin_p * nx)
    a, b = k.follower_mass + k.slider_mass, k.follower_mass * half * sin_p
    c = k.follower_inertia + k.follower_mass * half * half
    moved = (c * nx * nx + 2.0 * b * nx * about + a * about * about) / (a * c - b * b)
    mass = 1.0 / (moved + along * along / k.crank_inertia)
    slip = ny * -ux + nx * uy + k.pin_radius * speed - (distance + k.pin_radius) * turning
    elastic, energy = pressed(table, wall_state, deep)
    normal = 0.0
    if elastic > 0.0:
        damper = 2.0 * k.impact_damping * elastic * math.sqrt(0.5 * mass / energy)
        normal = max(elastic + damper * rate, 0.0)
    sine = k.joint_friction
    full = normal * sine / math.sqrt(1.0 - sine * sine)
    rub = full * slip / math.sqrt(slip * slip + SLIDING_M_PER_S * SLIDING_M_PER_S)
    fx, fy = normal * nx - rub * ny, normal * ny + rub * nx
    return fx, fy, normal, elastic, energy, deep, rate, slip, rub, nx, ny, mass


@njit(F(CONSTANTS, ROW, TOUCHING), **UNCOUNTED)
def crank_load(k: Constants, state: Array, contact: Numbers) -> float:
    """Return the torque on the crank by the contact and by its weight, N m."""
    fx, fy, _, _, _, _, _, _, _, nx, ny, _ = contact
    sin_t, cos_t = math.sin(state[ANGLE]), math.cos(state[ANGLE])
    x, y = k.crank_radius * cos_t + k.pin_radius * nx, k.crank_radius * sin_t + k.pin_radius * ny
    weight = k.crank_first_moment * (k.gravity_y * cos_t - k.gravity_x * sin_t)
    return weight - x * fy + y * fx


@njit(types.UniTuple(F, 2)(CONSTANTS, DRIVE, SQUARE, ROW, ROW, F), **UNCOUNTED)
def crank_friction(
    k: Constants, d: Drive, table: Array, wall_state: Array, state: Array, fraction: float
) -> tuple[float, float]:
    """Return (sign of the bearing's friction, 1 if it holds the crank at rest else 0)."""
    if state[SPEED] != 0.0:
        return math.copysign(1.0, state[SPEED]), 0.0
    torque, _, _ = motor(k, d, state[ANGLE], 0.0, state[INTEGRAL], fraction)
    free = torque + crank_load(k, state, touch(k, table, wall_state, state, 0.0))
    held = 1.0 if abs(free) <= k.bearing_torque + d.extra_friction_Nm else 0.0
    return math.copysign(1.0, free), held


@njit(TOUCHING(CONSTANTS, DRIVE, SQUARE, ROW, ROW, F, F, F, ROW), **UNCOUNTED)
def rates(
    k: Constants,
    d: Drive,
    table: Array,
    wall_state: Array,
    state: Array,
    sense: float,
    held: float,
    fraction: float,
    out: Array,
) -> Numbers:
    """Write the rate of each state (0 for those without an equation of motion).

    Return the result of ``touch``.
    """
    contact = touch(k, table, wall_state, state, 1.0 - held)
    fx, fy, normal, elastic, _, _, rate, slip, rub, nx, ny, _ = contact
    speed, turning = state[SPEED], state[FOLLOWER_SPEED]
    torque, winding, _ = motor(k, d, state[ANGLE], speed, state[INTEGRAL], fraction)
    resisting = sense * (k.bearing_torque + d.extra_friction_Nm) + k.bearing_viscous * speed
    pull = torque + crank_load(k, state, contact) - resisting
    sin_p, cos_p = math.sin(state[FOLLOWER]), math.cos(state[FOLLOWER])
    m2, half = k.follower_mass, 0.5 * k.follower_length
    a, b = m2 + k.slider_mass, m2 * half * sin_p
    c = k.follower_inertia + m2 * half * half
    spring = -k.stiffness * (state[SLIDER] - k.free_position)
    on_slider = fx + spring + k.gravity_x * a - m2 * half * cos_p * turning * turning
    x = k.crank_radius * math.cos(state[ANGLE]) + k.pin_radius * nx - state[SLIDER]
    y = k.crank_radius * math.sin(state[ANGLE]) + k.pin_radius * ny
    weight = m2 * half * (k.gravity_x * sin_p - k.gravity_y * cos_p)
    on_follower = x * fy - y * fx + weight
    out[ANGLE] = speed
    out[SPEED] = 0.0 if held == 1.0 else pull / k.crank_inertia
    out[SLIDER] = state[SLIDER_SPEED]
    out[FOLLOWER] = turning
    out[SLIDER_SPEED] = (c * on_slider - b * on_follower) / (a * c - b * b)
    out[FOLLOWER_SPEED] = (a * on_follower - b * on_slider) / (a * c - b * b)
    out[INTEGRAL] = winding
    out[WORK] = torque * speed
    out[LOSS] = resisting * speed + rub * slip + (normal - elastic) * rate
    return contact


@njit(
    types.UniTuple(F, 3)(CONSTANTS, DRIVE, SQUARE, ROW, ROW, F, F, F, F, F, SQUARE, ROW),
    **UNCOUNTED,
)
def runge_kutta(
    k: Constants,
    d: Drive,
    table: Array,
    wall_state: Array,
    state: Array,
    sense: float,
    held: float,
    dt: float,
    start: float,
    end: float,
    slope: Array,
    reached: Array,
) -> tuple[float, float, float]:
    """Write the state after dt; return (mean force, slip, penetration at the end): N, m, m.

    start and end: position of the step in the chunk. slope: (4, STATES), overwritten.
    """
    force, slip = 0.0, 0.0
    for stage in range(4):
        part = 0.0 if stage == 0 else (1.0 if stage == 3 else 0.5)
        for i in range(STATES):
            reached[i] = state[i] + (part * dt * slope[stage - 1, i] if stage > 0 else 0.0)
        at = start + part * (end - start)
        rate = rates(k, d, table, wall_state, reached, sense, held, at, slope[stage])
        weight = 1.0 / 3.0 if 0 < stage < 3 else 1.0 / 6.0
        force += weight * math.hypot(rate[0], rate[1])
        slip += weight * dt * rate[7]
    for i in range(STATES):
        mean = slope[0, i] + 2.0 * slope[1, i] + 2.0 * slope[2, i] + slope[3, i]
        reached[i] = state[i] + dt / 6.0 * mean
    return force, abs(slip), touch(k, table, wall_state, reached, 1.0)[5]


@njit(types.void(CONSTANTS, WALL, ROW), **UNCOUNTED)
def extend_table(k: Constants, wall: Wall, state: Array) -> None:
    """Extend the wall's table to the force of the beginning impact.

    Changing the table under load would change the stored energy.
    """
    contact = touch(k, wall.table, wall.state, state, 1.0)
    if contact[6] > 0.0:
        energy = 0.5 * contact[11] * contact[6] * contact[6]
        _, stored = pressed(wall.table, wall.state, wall.table[LEVELS, APPROACH])
        if energy > stored:
            # The stored energy grows at least with the force to the power 3/2.
            renew(wall, bore(k), wall.state[HIGHEST_FORCE] * (energy / stored) ** (2.0 / 3.0))


@njit(types.void(CONSTANTS, WALL, ROW, F, F, types.boolean), **UNCOUNTED)
def wear(k: Constants, wall: Wall, state: Array, force: float, slip: float, inboard: bool) -> None:
    """Wear and heat the bushing by a force (N) over a sliding distance (m).

    inboard: the pin presses on the side of the bore towards the wrist. The depth is that of the
    usually loaded side; wear of the other side is added to the worn area only.
    """
    if force <= 0.0:
        return
    state[RISE] += k.heating_K_per_W * k.joint_friction * force * slip / k.heating_time_s
    if inboard == (k.lengthening_sign < 0.0):
        deeper, area = worn(wall.table, wall.state, k.wear_coefficient, force, slip)
        state[DEPTH] += deeper
    else:
        area = k.wear_coefficient * slip * looked_up(wall.table, wall.state, force, WORN_AREA)
    state[AREA] += area


@njit(types.void(CONSTANTS, DRIVE, WALL, ROW, F, F, F), cache=True)
def move(
    k: Constants, d: Drive, wall: Wall, state: Array, dt: float, start: float, end: float
) -> None:
    """Advance crank, slider and follower by one step of the plant; see ``kernels.turn``."""
    table, wall_state = wall.table, wall.state
    slope, reached = np.empty((4, STATES)), np.empty(STATES)
    slope[:] = 0.0
    contact = touch(k, table, wall_state, state, 1.0)
    rise = table[LEVELS, APPROACH] - table[LEVELS - 1, APPROACH]
    stiffest = wall_state[HIGHEST_FORCE] * (2.0 * LEVELS - 1.0) / (LEVELS * LEVELS * rise)
    steps = max(1.0, math.ceil(dt * math.sqrt(stiffest / contact[11]) / SWING))
    left, deep = dt, contact[5]
    while left > 1e-9 * dt:
        step = min(dt / steps, left)
        at = end - (end - start) * left / dt
        to = at + (end - start) * step / dt
        sense, held = crank_friction(k, d, table, wall_state, state, at)
        if held == 1.0 and state[SLIDER_SPEED] == 0.0 and state[FOLLOWER_SPEED] == 0.0:
            _, rate, _ = motor(k, d, state[ANGLE], 0.0, state[INTEGRAL], at)
            state[INTEGRAL] += step * rate
            left -= step
            continue
        force, slip, after = runge_kutta(
            k, d, table, wall_state, state, sense, held, step, at, to, slope, reached
        )
        cuts = 0
        beyond = -TOUCH_M if deep > 0.0 else TOUCH_M
        # A step ends where pin and bore touch or separate: the force has a kink or a jump there.
        while deep * beyond < 0.0 and after / beyond > 2.0 and cuts < MOST_CUTS:
            step *= (beyond - deep) / (after - deep)
            to = at + (end - start) * step / dt
            force, slip, after = runge_kutta(
                k, d, table, wall_state, state, sense, held, step, at, to, slope, reached
            )
            cuts += 1
        dx = reached[SLIDER] - k.crank_radius * math.cos(reached[ANGLE])
        wear(k, wall, reached, force, slip, dx < k.follower_length * math.cos(reached[FOLLOWER]))
        if reached[SPEED] * sense <= 0.0:
            reached[SPEED] = 0.0
        still = held == 1.0 and abs(slope[3, SLIDER_SPEED]) < REST_M_PER_S2
        still = still and abs(slope[3, FOLLOWER_SPEED]) * k.follower_length < REST_M_PER_S2
        still = still and abs(reached[SLIDER_SPEED]) < REST_M_PER_S
        if still and abs(reached[FOLLOWER_SPEED]) * k.follower_length < REST_M_PER_S:
            reached[SLIDER_SPEED], reached[FOLLOWER_SPEED] = 0.0, 0.0
        state[:] = reached
        if deep < 0.0 <= after:
            extend_table(k, wall, state)
        deep = after
        left -= step


@njit(types.UniTuple(F, 4)(CONSTANTS, ROW, TOUCHING, F), **UNCOUNTED)
def loose_views(
    k: Constants, state: Array, contact: Numbers, seen_depth: float
) -> tuple[float, float, float, float]:
    """Return (F_e1, F_n1, pin along e2, pin along n2), see ``kernels.views``.

    seen_depth: wear and creep, m; its excess over the wear acts on the loaded side.
    """
    fx, fy = contact[0], contact[1]
    sin_t, cos_t = math.sin(state[ANGLE]), math.cos(state[ANGLE])
    sin_p, cos_p = math.sin(state[FOLLOWER]), math.cos(state[FOLLOWER])
    dx = k.crank_radius * cos_t - state[SLIDER] + k.follower_length * cos_p
    dy = k.crank_radius * sin_t + k.follower_length * sin_p
    creep = seen_depth - state[DEPTH] if contact[2] > 0.0 else 0.0
    dx, dy = dx + creep * contact[9], dy + creep * contact[10]
    along = dx * cos_p + dy * sin_p + k.run_out * (cos_t * cos_p + sin_t * sin_p)
    across = dy * cos_p - dx * sin_p + k.run_out * (sin_t * cos_p - cos_t * sin_p)
    return fx * cos_t + fy * sin_t, fy * cos_t - fx * sin_t, along, across


@njit(types.void(CONSTANTS, SQUARE, ROW, ROW), **UNCOUNTED)
def settle(k: Constants, table: Array, wall_state: Array, state: Array) -> None:
    """Set slider and follower to where the resting pin presses on the wall, at zero speed."""
    fx, fy, force = resting(k, state[ANGLE], state[DEPTH])
    length = k.follower_length + 0.5 * k.lengthening_sign * state[DEPTH]
    reach = k.clearance + 0.5 * state[DEPTH] + looked_up(table, wall_state, force, APPROACH)
    x, y = k.crank_radius * math.cos(state[ANGLE]), k.crank_radius * math.sin(state[ANGLE])
    sine = -y / (length + k.lengthening_sign * reach)
    nx, ny = -k.lengthening_sign * math.sqrt(1.0 - sine * sine), -k.lengthening_sign * sine
    if force > 0.0:
        nx, ny = fx / force, fy / force
    state[FOLLOWER] = math.asin(-(y - reach * ny) / length)
    state[SLIDER] = x - reach * nx + length * math.cos(state[FOLLOWER])
    state[SLIDER_SPEED] = state[FOLLOWER_SPEED] = 0.0


@njit(types.UniTuple(F, 2)(CONSTANTS, SQUARE, ROW, ROW), **UNCOUNTED)
def loose_energy(
    k: Constants, table: Array, wall_state: Array, state: Array
) -> tuple[float, float]:
    """Return (kinetic, potential) energy in J; potential: spring, weight and deformed wall."""
    m2, half = k.follower_mass, 0.5 * k.follower_length
    sin_p, cos_p = math.sin(state[FOLLOWER]), math.cos(state[FOLLOWER])
    slider_speed, turning = state[SLIDER_SPEED], state[FOLLOWER_SPEED]
    x2 = slider_speed + half * sin_p * turning
    y2 = half * cos_p * turning
    kinetic = k.crank_inertia * state[SPEED] ** 2 + k.slider_mass * slider_speed**2
    kinetic += m2 * (x2 * x2 + y2 * y2) + k.follower_inertia * turning**2
    stretch = state[SLIDER] - k.free_position
    x = k.crank_first_moment * math.cos(state[ANGLE]) + m2 * (state[SLIDER] - half * cos_p)
    y = k.crank_first_moment * math.sin(state[ANGLE]) - m2 * half * sin_p
    weight = k.gravity_x * (x + k.slider_mass * state[SLIDER]) + k.gravity_y * y
    elastic = touch(k, table, wall_state, state, 1.0)[4]
    return 0.5 * kinetic, 0.5 * k.stiffness * stretch * stretch - weight + elastic
