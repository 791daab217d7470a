"""Sensors and time stepping of the compiled plant.

Classical Runge-Kutta of fourth order, fixed step. Dry friction keeps its sign within a step; a step
that would reverse the crank ends at rest, and the next one decides whether friction holds it. A
joint that may lose contact uses shorter steps (``impacts``).
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math

import numpy as np
from numba import float64, int64, types, uint64
from numpy.typing import NDArray

from rigapp.simulation.impacts import crank_friction, loose_views, move, rates
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
    OUT_ANGLE,
    OUT_BRIDGE_1,
    OUT_BRIDGE_2,
    OUT_DEPTH,
    OUT_FORCE_1,
    OUT_FORCE_2,
    OUT_PROBE_1,
    OUT_PROBE_2,
    OUT_RISE,
    OUT_SHAFT,
    OUT_SPEED,
    OUT_TIME,
    OUT_WARM,
    PHASE,
    RISE,
    ROWS,
    SAMPLE,
    SPEED,
    STANDARD_GRAVITY_M_S2,
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
from rigapp.simulation.wall import (
    APPROACH,
    HIGHEST_FORCE,
    ROW,
    SQUARE,
    VALID_SLIP,
    WALL,
    Wall,
    looked_up,
    renew,
    worn,
)
from rigapp_model.compiled import UNCOUNTED, njit

# The compiled plant's sensors: the terminals of bridges and probes, and their noise.
#
# Frames: the load cell sits in the pin, which is clamped to the crank, so it measures in the crank
# frame, and it measures the force ON THE PIN, which is -F. The probes are clamped to the follower.
# The pin touches the bushing in the direction of the normal force on the follower: with the
# follower in tension (F_e2 < 0) its centre is at -c along e2, c = running clearance + wear +
# elastic approach. In the mechanics the follower's length includes clearance and wear, not the
# approach, which is a hundred times smaller. Noise depends on seed, kind and sample number only,
# not on the grouping of samples. Sample numbers restart at every departure from rest, and drift
# begins with the first one: the time at rest before it does not change a test of the same seed.

U = types.uint64
FREE_NOISE = 100
"""First noise kind of the free inputs, after those of cell, probes and spikes."""
REST_FORCE = 0.05
"""Force in N below which the pin leaves the wall towards the bushing's centre."""


@njit(uint64(U, U, U), forceinline=True, **UNCOUNTED)
def random_bits(seed: np.uint64, kind: np.uint64, index: np.uint64) -> np.uint64:
    """Return 64 random bits that depend on seed, kind and index only (SplitMix64 finaliser)."""
    z = seed * np.uint64(0xD1342543DE82EF95) + kind * np.uint64(0xA0761D6478BD642F)
    z = z + (index + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z = z ^ (z >> np.uint64(31))
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    return z ^ (z >> np.uint64(31))


@njit(types.UniTuple(F, 2)(U, U, U), forceinline=True, **UNCOUNTED)
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


@njit(float64(float64[:, ::1], int64, int64, F), forceinline=True, **UNCOUNTED)
def delayed(ring: Array, row: int, head: int, steps: float) -> float:
    """Return the value ``steps`` steps ago, by cubic Lagrange interpolation of four points."""
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


@njit(
    types.UniTuple(F, 4)(CONSTANTS, SQUARE, ROW, POSITION, F, F, F, F),
    forceinline=True,
    **UNCOUNTED,
)
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

    F is the normal force rotated by the friction angle in the sliding direction; an eccentric pin
    adds its run-out, which rotates with the pin relative to the follower. On the bench the pin
    carries the weight only (its force on the pin is -F, so the sign is reversed) and the probes
    measure micrometers. position: from ``geometry``.
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


@njit(float64(F, F), forceinline=True, **UNCOUNTED)
def quantised(value: float, step: float) -> float:
    """Return the nearest multiple of step (the value itself for step 0)."""
    if step == 0.0:
        return value
    return math.floor(value / step + 0.5) * step


@njit(
    types.void(CONSTANTS, float64[::1], float64[:, ::1], int64, U, U, F, float64[:, ::1], int64),
    forceinline=True,
    **UNCOUNTED,
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
    """Write one sample: the terminals (analog signals delayed, encoder not) and the truth."""
    time = state[TIME]
    warm = time - state[WARM]
    noise_1, noise_2 = normal_pair(seed, np.uint64(1), index)
    noise_3, noise_4 = normal_pair(seed, np.uint64(2), index)
    angle = state[ANGLE]
    # The weight outboard of the gauges is no force of the follower; the delay of its signal is
    # neglected, which would change it by thousandths.
    # On the bench the crank's plane is vertical; in a test it is that of the mechanism.
    pull_x = k.pin_mass * (1.0 - k.bench) * k.gravity_x
    pull_y = k.pin_mass * ((1.0 - k.bench) * k.gravity_y - k.bench * STANDARD_GRAVITY_M_S2)
    sine, cosine = math.sin(angle), math.cos(angle)
    on_pin_1 = k.outboard * state[SPEED] ** 2 + pull_x * cosine + pull_y * sine
    on_pin_2 = pull_y * cosine - pull_x * sine
    on_pin_1 -= delayed(ring, 0, head, delay_steps)
    on_pin_2 -= delayed(ring, 1, head, delay_steps)
    bridge_1 = k.cell_11 * on_pin_1 + k.cell_12 * on_pin_2 + k.noise_1 * noise_1 + k.drift_1 * warm
    bridge_2 = k.cell_21 * on_pin_1 + k.cell_22 * on_pin_2 + k.noise_2 * noise_2 + k.drift_2 * warm
    along = delayed(ring, 2, head, delay_steps)
    across = delayed(ring, 3, head, delay_steps)
    probe_1 = k.see_11 * along + k.see_12 * across + k.probe_noise * noise_3
    probe_2 = k.see_21 * along + k.see_22 * across + k.probe_noise * noise_4
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
    out[OUT_RISE, column] = state[RISE]
    for row in range(ROWS, len(out)):
        out[row, column] = normal_pair(seed, np.uint64(FREE_NOISE + row), index)[0]


CREEP_BEGINS_S = 60.0
"""Creep is counted in decades of time after the first minute."""


@njit(types.UniTuple(F, 2)(CONSTANTS, DRIVE, float64[::1], F), forceinline=True, **UNCOUNTED)
def dry_friction(k: Constants, d: Drive, state: Array, fraction: float) -> tuple[float, float]:
    """Return (sign of dry friction, 1 if it holds the crank at rest else 0)."""
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


@njit(
    types.void(CONSTANTS, DRIVE, SQUARE, ROW, POSITION, float64[::1], F, F, F, F, F),
    forceinline=True,
    **UNCOUNTED,
)
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

    first: acceleration at its start; position: from ``geometry``. start and end: of the step in the
    chunk, 0 ... 1, to interpolate the set-point.
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
    """Advance by ``steps`` steps of dt; write the samples that are due and return their number.

    A sample is taken at the start of every steps_per_sample-th step. State, counters, ring and wall
    hold the complete state: with a constant command the result does not depend on the division of
    the steps into calls. ring: (4, size) past results of ``views``, newest at counters[HEAD].
    """
    samples = 0
    size = ring.shape[1]
    table, wall_state = wall.table, wall.state
    cooling = 1.0 - dt / k.heating_time_s
    slope = np.zeros(STATES)
    for step in range(steps):
        if wall_state[VALID_SLIP] <= 0.0 or state[FORCE] > wall_state[HIGHEST_FORCE]:
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
            sense, held = crank_friction(k, d, table, wall_state, state, start)
            contact = rates(k, d, table, wall_state, state, sense, held, start, slope)
            acceleration = slope[SPEED]
            force = math.hypot(contact[0], contact[1])
            view = loose_views(k, state, contact, seen_depth)
        else:
            sense, held = dry_friction(k, d, state, start)
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
