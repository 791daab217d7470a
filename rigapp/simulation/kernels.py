"""The compiled plant's time stepping.

Classical Runge-Kutta of fourth order, fixed step. Dry friction keeps its sense within a step; a
step that would reverse the crank ends at rest, and the next one decides whether friction holds it.
A joint that may lose contact takes shorter steps of its own (``impacts``).
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math

import numpy as np
from numba import float64, int64, types, uint64
from numpy.typing import NDArray

from rigapp.simulation.impacts import crank_sense, loose_views, move, rates
from rigapp.simulation.layout import (
    ACCELERATION,
    ANGLE,
    AREA,
    CURRENT,
    DEPARTED_AT,
    DEPARTURES,
    DEPTH,
    EPOCH,
    FORCE,
    HEAD,
    HELD,
    INTEGRAL,
    LOSS,
    OUT_WARM,
    PHASE,
    RISE,
    SAMPLE,
    SPEED,
    STATES,
    TIME,
    TORQUE,
    WARM,
    WORK,
    Array,
    Constants,
    Drive,
)
from rigapp.simulation.mechanics import (
    CONSTANTS,
    DRIVE,
    POSITION,
    F,
    Numbers,
    bore,
    geometry,
    motion,
    motor,
    resting,
)
from rigapp.simulation.sensing import emit, views
from rigapp.simulation.wall import LASTS, ROW, SQUARE, TOP, WALL, Wall, renew, worn
from rigapp_model.compiled import njit

CREEP_BEGINS_S = 60.0
"""Creep is counted in decades of time after the first minute."""


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
    state[RISE] += k.heating_K_per_W * k.joint_friction * mean * slip / k.heating_time_s


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
    cooling = 1.0 - dt / k.heating_time_s
    slope = np.zeros(STATES)
    for step in range(steps):
        if wall_state[LASTS] <= 0.0 or state[FORCE] > wall_state[TOP]:
            renew(wall, bore(k), state[FORCE])
        start = step / steps
        loose = k.loose == 1.0 and k.bench == 0.0
        angle = state[ANGLE]
        speed = state[SPEED]
        depth = state[DEPTH]
        torque, rate, current = motor(k, d, angle, speed, state[INTEGRAL], start)
        seen_depth = depth
        if k.creep > 0.0 and counters[DEPARTURES] > 0:
            seen_depth += k.creep * np.log10(1.0 + (state[TIME] - state[WARM]) / CREEP_BEGINS_S)
        head = (counters[HEAD] + 1) % size
        position = geometry(k, angle, depth)
        if loose:
            sense, held = crank_sense(k, d, table, wall_state, state, start)
            contact = rates(k, d, table, wall_state, state, sense, held, start, slope)
            acceleration = slope[SPEED]
            force = math.hypot(contact[0], contact[1])
            view = loose_views(k, state, contact, seen_depth)
        else:
            sense, held = friction_sense(k, d, state, start)
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
            view = views(k, table, wall_state, position, seen_depth, fx, fy, sliding)
        ring[0, head], ring[1, head], ring[2, head], ring[3, head] = view
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
            warm = state[TIME] - state[WARM] if counters[DEPARTURES] > 0 else 0.0
            out[OUT_WARM, samples] = warm
            emit(k, state, ring, head, index, seed, delay_steps, out, samples)
            counters[SAMPLE] += 1
            samples += 1
        counters[PHASE] = (counters[PHASE] + 1) % steps_per_sample
        if loose:
            move(k, d, wall, state, dt, start, (step + 1.0) / steps)
        elif held == 1.0:
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
        state[RISE] *= cooling
        state[TIME] += dt
    return samples
