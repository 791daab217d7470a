"""Time integration of the slider-crank with a clearance joint, compiled, with impacts resolved.

Two coordinates: slider position x and follower angle; the crank turns at a prescribed speed. An
embedded Runge-Kutta pair (Dormand and Prince 5(4)) adapts the step; a step that ends a flight or a
contact is cut at the very moment, found on its cubic interpolant.
"""

from __future__ import annotations

import math

import numpy as np
from numba import boolean, float64, int64, types, void

from model.compiled import njit
from model.impact_laws import (
    FREE_POSITION,
    GRAVITY_X,
    GRAVITY_Y,
    HOLD,
    INERTIA,
    LENGTH,
    MASS,
    PAIR,
    RADIUS,
    SLIDER_MASS,
    SPEED,
    START_ANGLE,
    STATIC_MOMENT,
    STIFFNESS,
    TABLE,
    VECTOR,
    contact_force,
    penetration,
)

AT_CRANK, AT_WRIST = range(2)
DONE, TOO_MANY_STEPS, STEP_TOO_SMALL = range(3)
X, THETA, X_RATE, THETA_RATE = range(4)
"""Places in the state."""

FORCE_X, FORCE_Y, MOMENT, DEPTH, RATE, NORMAL_X, NORMAL_Y, NORMAL = range(4, 12)
X_GROWTH, THETA_GROWTH, TOUCHING = range(12, 15)
SAMPLE = 15
"""Columns of a sample: the state, the contact, the accelerations, whether in contact."""

IMPACT_TIME, IMPACT_SPEED = range(2)
TOUCH_TIME, STEPS, REJECTED, IMPACTS, LAST_IMPACT_SPEED, LAST_TOUCHING, LAST_TIME = range(7)
TALLY = 7

STATE = types.UniTuple(float64, 4)
RIGID = types.UniTuple(float64, 8)
ROWS = float64[:, ::1]
ROW = float64[::1]

A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
C = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
E = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])


@njit(RIGID(VECTOR, int64, float64, ROW), cache=True)
def joint_kinematics(p, location, time, y):  # type: ignore[no-untyped-def]
    """Return pin centre from bushing centre, its velocity, and the crank pin's place and e2."""
    angle = p[START_ANGLE] + p[SPEED] * time
    px, py = p[RADIUS] * math.cos(angle), p[RADIUS] * math.sin(angle)
    qx, qy = -py * p[SPEED], px * p[SPEED]
    c, s = math.cos(y[THETA]), math.sin(y[THETA])
    length, rate = p[LENGTH], y[THETA_RATE]
    dx, dy = px - y[X] + length * c, py + length * s
    ux, uy = qx - y[X_RATE] - length * s * rate, qy + length * c * rate
    if location == AT_WRIST:
        return -dx, -dy, -ux, -uy, px, py, c, s
    return dx, dy, ux, uy, px, py, c, s


@njit(HOLD(VECTOR, TABLE, int64[::1], float64, ROW, float64, boolean), cache=True)
def joint_contact(p, table, options, time, y, impact_speed, touching):  # type: ignore[no-untyped-def]
    """Return what ``contact_force`` returns for a state; without force in flight."""
    location, shape = options[0], options[1]
    dx, dy, ux, uy, _, _, c, s = joint_kinematics(p, location, time, y)
    if not touching:
        deep, nx, ny = penetration(p, table, shape, dx, dy, (c, s))
        return 0.0, 0.0, 0.0, deep, ux * nx + uy * ny, nx, ny, 0.0
    pin_rate = p[SPEED] if location == AT_CRANK else 0.0
    return contact_force(
        p, table, shape, (dx, dy, ux, uy), (c, s), (pin_rate, y[THETA_RATE]), impact_speed
    )


@njit(void(VECTOR, TABLE, int64[::1], float64, ROW, float64, boolean, ROW), cache=True)
def derivative(p, table, options, time, y, impact_speed, touching, out):  # type: ignore[no-untyped-def]
    """Write the state's rate of change into ``out``."""
    hold = joint_contact(p, table, options, time, y, impact_speed, touching)
    fx, fy, moment = hold[0], hold[1], hold[2]
    _, _, _, _, px, py, c, s = joint_kinematics(p, options[0], time, y)
    gx, gy, rate = p[GRAVITY_X], p[GRAVITY_Y], y[THETA_RATE]
    spring = -p[STIFFNESS] * (y[X] - p[FREE_POSITION])
    b, length = p[STATIC_MOMENT], p[LENGTH]
    out[X], out[THETA] = y[X_RATE], rate
    if options[0] == AT_CRANK:
        along = fx + spring + (p[MASS] + p[SLIDER_MASS]) * gx - b * c * rate * rate
        about = moment - length * (c * fy - s * fx) - b * (c * gy - s * gx)
        m11, m12, m22 = p[MASS] + p[SLIDER_MASS], b * s, p[INERTIA]
        det = m11 * m22 - m12 * m12
        out[X_RATE] = (along * m22 - about * m12) / det
        out[THETA_RATE] = (about * m11 - along * m12) / det
    else:
        ax, ay = -px * p[SPEED] * p[SPEED], -py * p[SPEED] * p[SPEED]
        about = moment + length * (c * fy - s * fx) + b * (c * (gy - ay) - s * (gx - ax))
        out[X_RATE] = (spring - fx) / p[SLIDER_MASS] + gx
        out[THETA_RATE] = about / p[INERTIA]


@njit(void(ROW, ROW, ROW, ROW, float64, float64, ROW), cache=True)
def interpolate(y0, f0, y1, f1, h, part, out):  # type: ignore[no-untyped-def]
    """Write the state at ``part`` (0 .. 1) of a step into ``out``: cubic Hermite."""
    rest = 1.0 - part
    for i in range(4):
        jump = y1[i] - y0[i]
        out[i] = (
            rest * y0[i]
            + part * y1[i]
            - part * rest * ((1.0 - 2.0 * part) * jump - h * (rest * f0[i] - part * f1[i]))
        )


@njit(float64(VECTOR, TABLE, int64[::1], float64, ROW), cache=True)
def depth_at(p, table, options, time, y):  # type: ignore[no-untyped-def]
    """Return the penetration of a state, negative for a gap."""
    dx, dy, _, _, _, _, c, s = joint_kinematics(p, options[0], time, y)
    return penetration(p, table, options[1], dx, dy, (c, s))[0]


@njit(PAIR(VECTOR, TABLE, int64[::1], float64, float64, ROWS, PAIR, float64), cache=True)
def find_crossing(p, table, options, time, h, ends, bracket, sign):  # type: ignore[no-untyped-def]
    """Return the part of a step at which the penetration changes sign, and the part just before.

    ends: rows y0, f0, y1, f1, then a scratch row. sign * penetration is <= 0 at bracket[0] and > 0
    at bracket[1]; bisection to the last bit that matters.
    """
    low, high = bracket
    for _ in range(60):
        middle = 0.5 * (low + high)
        interpolate(ends[0], ends[1], ends[2], ends[3], h, middle, ends[4])
        if sign * depth_at(p, table, options, time + middle * h, ends[4]) > 0.0:
            high = middle
        else:
            low = middle
        if high - low < 1e-13:
            break
    return high, low


@njit(float64(VECTOR, TABLE, int64[::1], float64, float64, ROWS, float64), cache=True)
def first_crossing(p, table, options, time, h, ends, sign):  # type: ignore[no-untyped-def]
    """Return the part of a step at which sign * penetration first rises above 0, else 2."""
    before = 0.0
    for quarter in range(1, 5):
        part = 0.25 * quarter
        interpolate(ends[0], ends[1], ends[2], ends[3], h, part, ends[4])
        if sign * depth_at(p, table, options, time + part * h, ends[4]) > 0.0:
            return find_crossing(p, table, options, time, h, ends, (before, part), sign)[0]
        before = part
    return 2.0


@njit(
    float64(
        VECTOR,
        TABLE,
        int64[::1],
        float64,
        float64,
        ROWS,
        ROWS,
        ROW,
        float64,
        boolean,
    ),
    cache=True,
)
def try_step(p, table, options, time, h, k, ends, scale, impact_speed, touching):  # type: ignore[no-untyped-def]
    """Take one Runge-Kutta step from ends[0] to ends[2]; return its error over the tolerance."""
    y0, stage = ends[0], ends[4]
    for i in range(1, 7):
        for n in range(4):
            total = 0.0
            for j in range(i):
                total += A[i, j] * k[j, n]
            stage[n] = y0[n] + h * total
        derivative(p, table, options, time + C[i] * h, stage, impact_speed, touching, k[i])
    error = 0.0
    for n in range(4):
        ends[2, n] = stage[n]
        ends[1, n] = k[0, n]
        ends[3, n] = k[6, n]
        total = 0.0
        for i in range(7):
            total += E[i] * k[i, n]
        error += (h * total / scale[n]) ** 2
    return math.sqrt(0.25 * error)


@njit(
    void(VECTOR, TABLE, int64[::1], float64, ROW, float64, boolean, ROW, ROW),
    cache=True,
)
def write_sample(p, table, options, time, y, impact_speed, touching, scratch, out):  # type: ignore[no-untyped-def]
    """Write one sample of the state, its contact and its accelerations."""
    hold = joint_contact(p, table, options, time, y, impact_speed, touching)
    derivative(p, table, options, time, y, impact_speed, touching, scratch)
    for n in range(4):
        out[n] = y[n]
    for n in range(8):
        out[4 + n] = hold[n]
    out[X_GROWTH], out[THETA_GROWTH] = scratch[X_RATE], scratch[THETA_RATE]
    out[TOUCHING] = 1.0 if touching else 0.0


@njit(
    int64(VECTOR, TABLE, int64[::1], ROW, ROW, VECTOR, VECTOR, int64, ROWS, ROWS, ROW),
    cache=True,
)
def integrate(p, table, options, y, start, control, times, most_steps, samples, impacts, tally):  # type: ignore[no-untyped-def]
    """Integrate to the last of ``times``, write samples, impacts and tallies; return a status.

    options: location, shape. y: the state, replaced by the last one. start: first time, impact
    speed of a contact that goes on, whether in contact. control: tolerances of the four states,
    longest step, floor of the impact speed, time from which contact is tallied.
    """
    scale, longest, floor, tally_from = control[:4].copy(), control[4], control[5], control[6]
    time, impact_speed, touching = start[0], max(start[1], floor), start[2] > 0.5
    end = times[-1]
    k, ends = np.empty((7, 4)), np.empty((5, 4))
    point, scratch = np.empty(4), np.empty(4)
    tally[:] = 0.0
    next_sample, status = 0, TOO_MANY_STEPS
    h = 1e-3 * longest
    ends[0, :] = y
    derivative(p, table, options, time, ends[0], impact_speed, touching, k[0])
    while next_sample < times.size and times[next_sample] <= time:
        write_sample(
            p, table, options, time, ends[0], impact_speed, touching, scratch, samples[next_sample]
        )
        next_sample += 1
    for _ in range(most_steps):
        if time >= end:
            status = DONE
            break
        h = min(h, longest, end - time)
        error = try_step(p, table, options, time, h, k, ends, scale, impact_speed, touching)
        if not error <= 1.0:
            tally[REJECTED] += 1
            h *= max(0.2, 0.9 * error**-0.2) if error < 1e30 else 0.2
            if h < 1e-14 * longest:
                status = STEP_TOO_SMALL
                break
            continue
        part = first_crossing(p, table, options, time, h, ends, -1.0 if touching else 1.0)
        cut = part <= 1.0
        taken = part * h if cut else h
        arrival = min(time + taken, end) if cut or taken < end - time else end
        while next_sample < times.size and times[next_sample] <= arrival:
            share = (times[next_sample] - time) / h
            interpolate(ends[0], ends[1], ends[2], ends[3], h, share, point)
            write_sample(
                p,
                table,
                options,
                times[next_sample],
                point,
                impact_speed,
                touching,
                scratch,
                samples[next_sample],
            )
            next_sample += 1
        tally[STEPS] += 1
        if touching:
            tally[TOUCH_TIME] += max(0.0, arrival - max(time, tally_from))
        if cut:
            interpolate(ends[0], ends[1], ends[2], ends[3], h, part, point)
            ends[0, :] = point
            time = arrival
            touching = not touching
            if touching:
                hold = joint_contact(p, table, options, time, point, 1.0, True)
                impact_speed = max(hold[4], floor)
                if time >= tally_from:
                    stored = int(tally[IMPACTS])
                    if stored < impacts.shape[0]:
                        impacts[stored, IMPACT_TIME] = time
                        impacts[stored, IMPACT_SPEED] = hold[4]
                    tally[IMPACTS] += 1
            derivative(p, table, options, time, point, impact_speed, touching, k[0])
        else:
            time = arrival
            ends[0, :] = ends[2]
            k[0, :] = k[6]
        growth = min(5.0, 0.9 * max(error, 1e-10) ** -0.2)
        h *= growth if growth > 0.2 else 0.2
    y[:] = ends[0]
    tally[LAST_IMPACT_SPEED], tally[LAST_TOUCHING] = impact_speed, 1.0 if touching else 0.0
    tally[LAST_TIME] = time
    return status
