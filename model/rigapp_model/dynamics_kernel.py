"""Motion and forces of the slider-crank at every angle in one pass, compiled.

Numpy would pass over all angles once for each of the 130 operations, and start each anew.

A block of angles is solved in a small array whose rows are a known distance apart: only so does the
compiler know that no row overlaps another, and takes several angles at once.
"""

from __future__ import annotations

import math

import numpy as np
from numba import float64, types

from rigapp_model.compiled import njit

CRANK_RADIUS, FOLLOWER_LENGTH, CRANK_MASS, FOLLOWER_MASS, MOVING_MASS = range(5)
CRANK_INERTIA, FOLLOWER_INERTIA, STIFFNESS, FREE_POSITION = range(5, 9)
GRAVITY_X, GRAVITY_Y, FRICTION_RADIUS = range(9, 12)
CONSTANTS = 12
"""Places in the constants; the last is that of the friction circle, m, 0 without friction."""

ANGLE, SPEED, ACCELERATION, GAP, COSINE, SINE = range(6)
GIVEN = 6
"""Rows of what is given at each angle: the crank's motion, clearance, cosine and sine."""

(
    FOLLOWER_SINE,
    FOLLOWER_SPEED,
    FOLLOWER_ACCELERATION,
    SLIDER_POSITION,
    SLIDER_VELOCITY,
    SLIDER_ACCELERATION,
    SPRING_FORCE,
    GUIDE_FORCE,
    DRIVE_TORQUE,
    FRICTION_MOMENT,
) = range(10)
CRANK_POSITION, CRANK_VELOCITY, CRANK_ACCELERATION = range(10, 16, 2)
CENTRE_POSITION, CENTRE_VELOCITY, CENTRE_ACCELERATION = range(16, 22, 2)
FORCE, FORCE_CRANK, FORCE_FOLLOWER, WRIST_FORCE, BEARING_FORCE = range(22, 32, 2)
FOUND = 32
"""Rows of what is found; from ``CRANK_POSITION`` on each is the first of two, x and y."""

SPAN = 64  # angles of a block: its rows stay in the fastest cache
BLOCK = (FOUND + GIVEN) * SPAN

ROWS = float64[:, ::1]


@njit(
    types.boolean(types.Array(float64, 1, "C", readonly=True), ROWS, ROWS),
    cache=True,
    error_model="numpy",
)
def solve(constants, given, found):  # type: ignore[no-untyped-def]
    """Fill ``found`` (FOUND, n) at each angle of ``given`` (GIVEN, n); return whether it moves.

    It does not where the friction circle is larger than the follower's lever: the joint locks. A
    moment M turns the pin force into (fx, fy + M / lever), and M = s rho |F| with the radius rho of
    the circle and s the sense of sliding, so |F| is the positive root of a quadratic.
    """
    r, whole = constants[CRANK_RADIUS], constants[FOLLOWER_LENGTH]
    m1, m2, m3 = constants[CRANK_MASS], constants[FOLLOWER_MASS], constants[MOVING_MASS]
    turning = constants[CRANK_INERTIA] + 0.25 * m1 * r * r
    gx, gy, rho = constants[GRAVITY_X], constants[GRAVITY_Y], constants[FRICTION_RADIUS]
    stiffness, free = constants[STIFFNESS], constants[FREE_POSITION]
    inertia = constants[FOLLOWER_INERTIA]
    half, locked = 0.5 * whole, 0
    block = np.empty(BLOCK)
    count = given.shape[1]
    for begin in range(0, count, SPAN):
        size = min(SPAN, count - begin)
        for row in range(SPEED, GIVEN):
            for j in range(size):
                block[(FOUND + row) * SPAN + j] = given[row, begin + j]
        for j in range(size):
            rate = block[(FOUND + SPEED) * SPAN + j]
            growth = block[(FOUND + ACCELERATION) * SPAN + j]
            gap = block[(FOUND + GAP) * SPAN + j]
            c1, s1 = block[(FOUND + COSINE) * SPAN + j], block[(FOUND + SINE) * SPAN + j]
            length = whole + gap
            ratio = r / length
            s2 = -ratio * s1
            c2 = math.sqrt(1.0 - s2 * s2)
            rate2 = rate * rate
            w2 = -ratio * c1 * rate / c2
            w2w2 = w2 * w2
            al2 = (s2 * w2w2 + ratio * (s1 * rate2 - c1 * growth)) / c2

            crank_x, crank_y = 0.5 * r * c1, 0.5 * r * s1
            crank_ax = -crank_y * growth - crank_x * rate2
            crank_ay = crank_x * growth - crank_y * rate2
            arm_x, arm_y = half * c2, half * s2
            position = r * c1 + length * c2
            velocity = -r * s1 * rate - length * s2 * w2
            acceleration = -r * (s1 * growth + c1 * rate2) - length * (s2 * al2 + c2 * w2w2)
            centre_ax = acceleration - (-arm_y * al2 - arm_x * w2w2)
            centre_ay = -(arm_x * al2 - arm_y * w2w2)

            spring = -stiffness * (position - free)
            load_x, load_y = m2 * (centre_ax - gx), m2 * (centre_ay - gy)
            load_n2 = load_y * c2 - load_x * s2
            wrist_x = m3 * (acceleration - gx) - spring
            wrist_n2 = (-inertia * al2 - (half + gap) * load_n2) / length
            wrist_y = (wrist_n2 + wrist_x * s2) / c2
            fx, fy, lever = wrist_x + load_x, wrist_y + load_y, length * c2
            sliding = math.copysign(rho, rate - w2) if rate != w2 else 0.0
            q = sliding / lever
            remainder = 1.0 - q * q
            locked += 1 if remainder <= 0.0 else 0
            pressed = q * fy + math.sqrt((q * fy) ** 2 + remainder * (fx * fx + fy * fy))
            moment = sliding * pressed / remainder
            wrist_y += moment / lever
            fx, fy = wrist_x + load_x, wrist_y + load_y

            block[FOLLOWER_SINE * SPAN + j] = s2
            block[FOLLOWER_SPEED * SPAN + j] = w2
            block[FOLLOWER_ACCELERATION * SPAN + j] = al2
            block[SLIDER_POSITION * SPAN + j] = position
            block[SLIDER_VELOCITY * SPAN + j] = velocity
            block[SLIDER_ACCELERATION * SPAN + j] = acceleration
            block[SPRING_FORCE * SPAN + j] = spring
            block[GUIDE_FORCE * SPAN + j] = -wrist_y - m3 * gy
            block[DRIVE_TORQUE * SPAN + j] = (
                turning * growth
                + r * (c1 * fy - s1 * fx)
                - 0.5 * r * m1 * (c1 * gy - s1 * gx)
                + moment
            )
            block[FRICTION_MOMENT * SPAN + j] = moment
            block[CRANK_POSITION * SPAN + j], block[(CRANK_POSITION + 1) * SPAN + j] = (
                crank_x,
                crank_y,
            )
            block[CRANK_VELOCITY * SPAN + j] = -crank_y * rate
            block[(CRANK_VELOCITY + 1) * SPAN + j] = crank_x * rate
            block[CRANK_ACCELERATION * SPAN + j], block[(CRANK_ACCELERATION + 1) * SPAN + j] = (
                crank_ax,
                crank_ay,
            )
            block[CENTRE_POSITION * SPAN + j], block[(CENTRE_POSITION + 1) * SPAN + j] = (
                position - arm_x,
                -arm_y,
            )
            block[CENTRE_VELOCITY * SPAN + j] = velocity + arm_y * w2
            block[(CENTRE_VELOCITY + 1) * SPAN + j] = -arm_x * w2
            block[CENTRE_ACCELERATION * SPAN + j] = centre_ax
            block[(CENTRE_ACCELERATION + 1) * SPAN + j] = centre_ay
            block[FORCE * SPAN + j], block[(FORCE + 1) * SPAN + j] = fx, fy
            block[FORCE_CRANK * SPAN + j], block[(FORCE_CRANK + 1) * SPAN + j] = (
                fx * c1 + fy * s1,
                fy * c1 - fx * s1,
            )
            block[FORCE_FOLLOWER * SPAN + j] = fx * c2 + fy * s2
            block[(FORCE_FOLLOWER + 1) * SPAN + j] = fy * c2 - fx * s2
            block[WRIST_FORCE * SPAN + j], block[(WRIST_FORCE + 1) * SPAN + j] = wrist_x, wrist_y
            block[BEARING_FORCE * SPAN + j] = m1 * crank_ax + fx - m1 * gx
            block[(BEARING_FORCE + 1) * SPAN + j] = m1 * crank_ay + fy - m1 * gy
        for row in range(FOUND):
            found[row, begin : begin + size] = block[row * SPAN : row * SPAN + size]
    return locked == 0
