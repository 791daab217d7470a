"""Compiled equations of motion of the slider-crank with a clearance joint.

Two coordinates, slider position and follower angle, each relative to a reference: the motion with
continuous contact on the follower's axis (technique 2). So the large motion of the mechanism costs
neither accuracy nor steps, and a penetration of a millionth of the mechanism's size keeps its
digits. The crank turns at a prescribed speed.
"""

from __future__ import annotations

import math

from numba import boolean, float64, int64, types, void

from rigapp_model.compiled import njit
from rigapp_model.contact.impact_laws import (
    CONTACT_RESULT,
    FREE_POSITION,
    GRAVITY_X,
    GRAVITY_Y,
    INERTIA,
    INLINED,
    KERNEL,
    LENGTH,
    MASS,
    PAIR,
    PIN_RADIUS,
    RADIUS,
    REFERENCE_LENGTH,
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
X, THETA, X_RATE, THETA_RATE, SLID, WORK, WORK_X, WORK_Y = range(8)
"""Indices of the state: motion, then integrals over the contact.

These are the sliding distance (m), normal force times sliding distance (J), and that times the
direction of the pin's pressure, in the wear frame of ``rigapp_model.wear.loads``.
"""
COORDINATES, STATE = 4, 8
FORCE, DERIVATIVE = 8, 9
"""Index of the magnitude of the joint's force, N, after the derivatives of the state."""

SMALL_ANGLE = 0.01
"""Angle (rad) up to which the series is exact to rounding; faster than the functions."""

ROW = float64[::1]
COORDINATE_VALUES = types.UniTuple(float64, 4)
REFERENCE = types.UniTuple(float64, 9)
RATES = types.UniTuple(float64, 9)
JOINT_POSITION = types.UniTuple(float64, 7)


@njit(REFERENCE(VECTOR, float64), **INLINED)
def reference(p, time):  # type: ignore[no-untyped-def]
    """Return the reference motion at a time.

    Position of the crank pin (x, y); cosine and sine of the follower's angle, its speed and
    acceleration; slider position, velocity, acceleration.
    """
    angle = p[START_ANGLE] + p[SPEED] * time
    px, py = p[RADIUS] * math.cos(angle), p[RADIUS] * math.sin(angle)
    w, length = p[SPEED], p[REFERENCE_LENGTH]
    s = -py / length
    c = math.sqrt(1.0 - s * s)
    rate = -px * w / (length * c)
    growth = (s * rate * rate + py * w * w / length) / c
    rise = length * c
    fall = length * s
    velocity = -py * w - fall * rate
    acceleration = -px * w * w - rise * rate * rate - fall * growth
    return px, py, c, s, rate, growth, px + rise, velocity, acceleration


@njit(JOINT_POSITION(VECTOR, int64, REFERENCE, COORDINATE_VALUES), **INLINED)
def joint_position(p, location, ref, y):  # type: ignore[no-untyped-def]
    """Return the position of the pin in its bushing for a deviation from the reference.

    Pin centre from bushing centre (x, y), its velocity, |pin centre|^2 - clearance^2, and cosine
    and sine of the follower's angle.
    """
    _, _, c0, s0, rate0, _, _, _, _ = ref
    angle = y[THETA]
    squared = angle * angle
    if squared < SMALL_ANGLE**2:
        cosm1 = squared * (-1.0 / 2.0 + squared * (1.0 / 24.0 - squared / 720.0))
        sine = angle * (1.0 + squared * (-1.0 / 6.0 + squared * (1.0 / 120.0 - squared / 5040.0)))
    else:
        half = math.sin(0.5 * angle)
        cosm1, sine = -2.0 * half * half, 2.0 * half * math.cos(0.5 * angle)
    dc, ds = c0 * cosm1 - s0 * sine, s0 * cosm1 + c0 * sine
    c, s = c0 + dc, s0 + ds
    length, rate = p[LENGTH], y[THETA_RATE]
    offset = p[REFERENCE_LENGTH] - length
    ox, oy = offset * c0, offset * s0
    wx, wy = length * dc - y[X], length * ds
    dx, dy = wx - ox, wy - oy
    excess = wx * (wx - 2.0 * ox) + wy * (wy - 2.0 * oy)
    ux = -y[X_RATE] - length * (rate * s + rate0 * ds) + rate0 * oy
    uy = length * (rate * c + rate0 * dc) - rate0 * ox
    if location == AT_WRIST:
        return -dx, -dy, -ux, -uy, excess, c, s
    return dx, dy, ux, uy, excess, c, s


@njit(
    CONTACT_RESULT(VECTOR, TABLE, int64[::1], JOINT_POSITION, float64, float64, boolean), **INLINED
)
def contact_at(p, table, options, position, follower_rate, impact_speed, touching):  # type: ignore[no-untyped-def]
    """Return the result of ``contact_force`` for a position of the joint; no force in flight."""
    location, shape = options[0], options[1]
    dx, dy, ux, uy, excess, c, s = position
    if not touching:
        deep, nx, ny = penetration(p, table, shape, dx, dy, excess, (c, s))
        cx, cy = dx + p[PIN_RADIUS] * nx, dy + p[PIN_RADIUS] * ny
        rate = (ux + follower_rate * cy) * nx + (uy - follower_rate * cx) * ny
        return 0.0, 0.0, 0.0, deep, rate, nx, ny, 0.0, 0.0
    pin_rate = p[SPEED] if location == AT_CRANK else 0.0
    return contact_force(
        p, table, shape, (dx, dy, ux, uy), excess, (c, s), (pin_rate, follower_rate), impact_speed
    )


@njit(CONTACT_RESULT(VECTOR, TABLE, int64[::1], float64, ROW, float64, boolean), **KERNEL)
def joint_contact(p, table, options, time, y, impact_speed, touching):  # type: ignore[no-untyped-def]
    """Return the result of ``contact_force`` for a state; no force in flight."""
    ref = reference(p, time)
    position = joint_position(p, options[0], ref, (y[X], y[THETA], y[X_RATE], y[THETA_RATE]))
    rate = ref[4] + y[THETA_RATE]
    return contact_at(p, table, options, position, rate, impact_speed, touching)


@njit(PAIR(VECTOR, TABLE, int64[::1], REFERENCE, ROW), **KERNEL)
def depth_and_rate(p, table, options, ref, y):  # type: ignore[no-untyped-def]
    """Return the penetration of a state, negative for a gap, and its rate."""
    position = joint_position(p, options[0], ref, (y[X], y[THETA], y[X_RATE], y[THETA_RATE]))
    rate = ref[4] + y[THETA_RATE]
    contact = contact_at(p, table, options, position, rate, 1.0, False)
    return contact[3], contact[4]


@njit(RATES(VECTOR, TABLE, int64[::1], REFERENCE, COORDINATE_VALUES, float64, boolean), **INLINED)
def rates(p, table, options, ref, y, impact_speed, touching):  # type: ignore[no-untyped-def]
    """Return the derivative of the state, followed by the magnitude of the joint's force.

    ref: reference at the time of the state; y: its coordinates. The accelerations of slider and
    follower are relative to the reference.
    """
    px, py, _, _, rate0, growth0, position0, _, acceleration0 = ref
    position = joint_position(p, options[0], ref, y)
    c, s = position[5], position[6]
    rate = rate0 + y[THETA_RATE]
    fx = fy = moment = 0.0
    slid = work = work_x = work_y = force = 0.0
    if touching:
        contact = contact_at(p, table, options, position, rate, impact_speed, True)
        fx, fy, moment = contact[0], contact[1], contact[2]
        force = math.sqrt(fx * fx + fy * fy)
        nx, ny, normal, sliding = contact[5], contact[6], contact[7], abs(contact[8])
        # No sliding in contact where damping has reduced the force to 0.
        if normal > 0.0:
            slid, work = sliding, normal * sliding
            work_x = -normal * sliding * (nx * c + ny * s)
            work_y = -normal * sliding * (ny * c - nx * s)
    gx, gy = p[GRAVITY_X], p[GRAVITY_Y]
    spring = -p[STIFFNESS] * (position0 + y[X] - p[FREE_POSITION])
    b, length = p[STATIC_MOMENT], p[LENGTH]
    if options[0] == AT_CRANK:
        along = fx + spring + (p[MASS] + p[SLIDER_MASS]) * gx - b * c * rate * rate
        about = moment - length * (c * fy - s * fx) - b * (c * gy - s * gx)
        m11, m12, m22 = p[MASS] + p[SLIDER_MASS], b * s, p[INERTIA]
        det = m11 * m22 - m12 * m12
        x_growth = (along * m22 - about * m12) / det - acceleration0
        growth = (about * m11 - along * m12) / det - growth0
    else:
        ax, ay = -px * p[SPEED] * p[SPEED], -py * p[SPEED] * p[SPEED]
        about = moment + length * (c * fy - s * fx) + b * (c * (gy - ay) - s * (gx - ax))
        x_growth = (spring - fx) / p[SLIDER_MASS] + gx - acceleration0
        growth = about / p[INERTIA] - growth0
    return y[X_RATE], y[THETA_RATE], x_growth, growth, slid, work, work_x, work_y, force


@njit(void(VECTOR, TABLE, int64[::1], float64, ROW, float64, boolean, ROW), **KERNEL)
def derivative(p, table, options, time, y, impact_speed, touching, out):  # type: ignore[no-untyped-def]
    """Compute ``rates`` of a state at a time into ``out``."""
    coordinates = (y[X], y[THETA], y[X_RATE], y[THETA_RATE])
    rate = rates(p, table, options, reference(p, time), coordinates, impact_speed, touching)
    out[0], out[1], out[2], out[3], out[4], out[5], out[6], out[7], out[8] = rate
