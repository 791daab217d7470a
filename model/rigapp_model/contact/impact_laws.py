"""Compiled contact force between pin and bushing: circles, a worn profile, elastic foundation.

Vectors are global or in the orientation of the follower frame, as stated; the bushing is part of
the follower.
"""

from __future__ import annotations

import math

from numba import float64, int64, types

from rigapp_model.compiled import UNCOUNTED, njit

RADIUS, LENGTH, MASS, INERTIA, STATIC_MOMENT, SLIDER_MASS = range(6)
STIFFNESS, FREE_POSITION, GRAVITY_X, GRAVITY_Y = range(6, 10)
PIN_RADIUS, CLEARANCE, CONTACT_STIFFNESS, HYSTERESIS, FRICTION = range(10, 15)
RAMP_START, RAMP_END, FOUNDATION, SPEED, START_ANGLE, LEAST_RADIUS = range(15, 21)
MOST_STEPS = 12  # Newton from the nearest node needs three or four
SAME_ANGLE = 1e-13  # rad: rounding
AT_CENTRE = 1e-15  # m: below it the direction of the pin is undefined, and is set
REFERENCE_LENGTH = 21
CURVE_BEGIN, CURVE_SPACING, CURVE = range(22, 25)
SEGMENTS = 96
PARAMETERS = CURVE + 4 * SEGMENTS
"""Indices of the parameter vector of the compiled functions.

CURVE is the first coefficient of the elastic curve's cubics, of log force over log depth; they are
used if the contact stiffness, that of a force K d^1.5, is 0.
"""

CIRCLE, PROFILE, ELASTIC_FOUNDATION = range(3)
NODE_X, NODE_Y, NODE_LENGTH, CUBIC, SQUARE, LINEAR, CONSTANT = range(7)
"""Columns of the profile table: surface nodes in the follower frame, then the radius spline."""

KERNEL = {**UNCOUNTED, "error_model": "numpy"}
"""Options of a compiled function: unchecked divisions; by 0 they lead to STEP_TOO_SMALL."""
INLINED = {**KERNEL, "forceinline": True}
"""Options of a function called in every stage of every step: its arrays alone are 20 arguments."""

TABLE = types.Array(float64, 2, "C", readonly=True)
VECTOR = types.Array(float64, 1, "C", readonly=True)
PAIR = types.UniTuple(float64, 2)
TRIPLE = types.UniTuple(float64, 3)
FOUR = types.UniTuple(float64, 4)
FIVE = types.UniTuple(float64, 5)
CONTACT_RESULT = types.UniTuple(float64, 9)


@njit(float64(float64, float64, float64), **INLINED)
def friction_ramp(speed: float, start: float, end: float) -> float:
    """Return the fraction of Coulomb friction at a sliding speed: odd, 0 .. 1 over a ramp."""
    size = abs(speed)
    if size <= start:
        return 0.0
    part = 1.0 if size >= end else (size - start) / (end - start)
    return math.copysign(part, speed)


@njit(float64(VECTOR, float64), **INLINED)
def elastic_force(p, deep):  # type: ignore[no-untyped-def]
    """Return the elastic force (N) at a positive penetration (m)."""
    if p[CONTACT_STIFFNESS] > 0.0:
        return p[CONTACT_STIFFNESS] * deep * math.sqrt(deep)
    width = p[CURVE_SPACING]
    along = math.log(deep) - p[CURVE_BEGIN]
    inside = min(max(along, 0.0), SEGMENTS * width)
    segment = min(int(inside / width), SEGMENTS - 1)
    offset = inside - segment * width
    at = CURVE + 4 * segment
    value = p[at + 3] + offset * (p[at + 2] + offset * (p[at + 1] + offset * p[at]))
    slope = p[at + 2] + offset * (2.0 * p[at + 1] + 3.0 * offset * p[at])
    return math.exp(value + slope * (along - inside))


@njit(TRIPLE(VECTOR, TABLE, float64, float64), **KERNEL)
def nearest_on_profile(p, table, dx, dy):  # type: ignore[no-untyped-def]
    """Return penetration and outward normal (follower frame) at the nearest point of the profile.

    dx, dy: pin centre from bushing centre in the follower frame. Newton on the squared distance
    to the spline, from the nearest node.
    """
    count = table.shape[0]
    best, least = 0, 1e300
    for j in range(count):
        ex, ey = table[j, NODE_X] - dx, table[j, NODE_Y] - dy
        squared = ex * ex + ey * ey
        if squared < least:
            best, least = j, squared
    step = 2.0 * math.pi / count
    shift = 0.0
    ex = ey = 0.0
    for _ in range(MOST_STEPS):
        j, s = best, shift
        if s < 0.0:
            j, s = (best - 1) % count, shift + step
        rho = table[j, CONSTANT] + s * (
            table[j, LINEAR] + s * (table[j, SQUARE] + s * table[j, CUBIC])
        )
        rho1 = table[j, LINEAR] + s * (2.0 * table[j, SQUARE] + 3.0 * s * table[j, CUBIC])
        rho2 = 2.0 * table[j, SQUARE] + 6.0 * s * table[j, CUBIC]
        angle = math.pi + best * step + shift
        c, sn = math.cos(angle), math.sin(angle)
        ex, ey = rho * c - dx, rho * sn - dy
        tx, ty = rho1 * c - rho * sn, rho1 * sn + rho * c
        slope = ex * tx + ey * ty
        second_derivative = (
            tx * tx
            + ty * ty
            + ex * ((rho2 - rho) * c - 2.0 * rho1 * sn)
            + ey * ((rho2 - rho) * sn + 2.0 * rho1 * c)
        )
        move = (
            -slope / second_derivative
            if second_derivative > 0.0
            else -math.copysign(0.25 * step, slope)
        )
        moved = min(step, max(-step, shift + move))
        if abs(moved - shift) < SAME_ANGLE:
            break
        shift = moved
    distance = math.sqrt(ex * ex + ey * ey)
    return p[PIN_RADIUS] - distance, ex / distance, ey / distance


@njit(TRIPLE(VECTOR, TABLE, int64, float64, float64, float64, PAIR), **INLINED)
def penetration(p, table, shape, dx, dy, excess, turn):  # type: ignore[no-untyped-def]
    """Return the deepest penetration (negative: gap) and the outward normal there, global.

    dx, dy: pin centre from bushing centre, global; excess: its square less that of the clearance,
    given separately as the difference would lose the digits of a small penetration; turn: cosine
    and sine of the follower's angle.
    """
    if shape == CIRCLE:
        distance = math.sqrt(dx * dx + dy * dy)
        if distance < AT_CENTRE:
            return -p[CLEARANCE], -turn[0], -turn[1]
        return excess / (distance + p[CLEARANCE]), dx / distance, dy / distance
    c, s = turn
    ax, ay = dx * c + dy * s, dy * c - dx * s
    if shape == PROFILE:
        deep, nx, ny = nearest_on_profile(p, table, ax, ay)
    else:
        best, least = 0, 1e300
        for j in range(table.shape[0]):
            ex, ey = table[j, NODE_X] - ax, table[j, NODE_Y] - ay
            squared = ex * ex + ey * ey
            if squared < least:
                best, least = j, squared
        distance = math.sqrt(least)
        deep = p[PIN_RADIUS] - distance
        nx, ny = (table[best, NODE_X] - ax) / distance, (table[best, NODE_Y] - ay) / distance
    return deep, nx * c - ny * s, nx * s + ny * c


@njit(FIVE(VECTOR, TABLE, float64, float64), **KERNEL)
def foundation_force(p, table, dx, dy):  # type: ignore[no-untyped-def]
    """Return elastic force on the bushing (x, y), two moments about its centre, penetration.

    Follower frame, without friction. The pressure at each node of the surface is the foundation
    modulus times its penetration. The first moment is that of the force; the second, times the
    ratio of tangential to normal force, that of friction. Only nodes within reach of the pin on a
    circle of the surface's least radius are used; 0 penetration if there is none.
    """
    fx = fy = moment = turned = 0.0
    radius, least = p[PIN_RADIUS], p[LEAST_RADIUS]
    reach = math.sqrt(dx * dx + dy * dy)
    if reach + radius <= least:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    cosine = (least * least + reach * reach - radius * radius) / (2.0 * least * reach)
    count = table.shape[0]
    step = 2.0 * math.pi / count
    half = math.acos(max(cosine, -1.0)) / step
    middle = (math.atan2(dy, dx) + math.pi) / step
    nearest = radius * radius
    for turned_j in range(math.ceil(middle - half), math.floor(middle + half) + 1):
        j = turned_j % count
        ex, ey = table[j, NODE_X] - dx, table[j, NODE_Y] - dy
        squared = ex * ex + ey * ey
        if squared < radius * radius:
            distance = math.sqrt(squared)
            load = p[FOUNDATION] * (radius - distance) * table[j, NODE_LENGTH] / distance
            fx += load * ex
            fy += load * ey
            moment += load * (table[j, NODE_X] * ey - table[j, NODE_Y] * ex)
            turned += load * (table[j, NODE_X] * ex + table[j, NODE_Y] * ey)
            nearest = min(nearest, squared)
    return fx, fy, moment, turned, radius - math.sqrt(nearest)


@njit(
    CONTACT_RESULT(
        VECTOR,
        TABLE,
        int64,
        FOUR,
        float64,
        PAIR,
        PAIR,
        float64,
    ),
    **INLINED,
)
def contact_force(p, table, shape, relative, excess, turn, rates, impact_speed):  # type: ignore[no-untyped-def]
    """Return the contact force on the bushing, and its components; all global.

    In order: force (x, y), its moment about the bushing centre, penetration, its rate, the normal
    (x, y), the normal force, the sliding speed of the pin's surface on the bushing's.
    relative: pin centre from bushing centre and its velocity, (dx, dy, ux, uy), global; excess:
    see ``penetration``; turn: cosine and sine of the follower's angle; rates: angular speeds of
    pin and follower. impact_speed: normal speed at the start of this contact, with its floor; the
    normal force is that of ``elastic_force`` times 1 + hysteresis d' / impact_speed, at least 0.
    """
    dx, dy, ux, uy = relative
    c, s = turn
    elastic = moment = turned = nx = ny = 0.0
    if shape == ELASTIC_FOUNDATION:
        gx, gy, moment, turned, deep = foundation_force(p, table, dx * c + dy * s, dy * c - dx * s)
        elastic = math.sqrt(gx * gx + gy * gy)
        if elastic > 0.0:
            nx, ny = (gx * c - gy * s) / elastic, (gx * s + gy * c) / elastic
        else:
            deep, nx, ny = penetration(p, table, shape, dx, dy, excess, turn)
    else:
        deep, nx, ny = penetration(p, table, shape, dx, dy, excess, turn)
        if deep > 0.0:
            elastic = elastic_force(p, deep)
    cx, cy = dx + p[PIN_RADIUS] * nx, dy + p[PIN_RADIUS] * ny
    vx, vy = ux + rates[1] * cy, uy - rates[1] * cx
    rate = vx * nx + vy * ny
    slip = -vx * ny + vy * nx + rates[0] * p[PIN_RADIUS]
    damping = 1.0 + p[HYSTERESIS] * rate / impact_speed
    if deep <= 0.0 or damping <= 0.0:
        return 0.0, 0.0, 0.0, deep, rate, nx, ny, 0.0, slip
    ratio = p[FRICTION] * friction_ramp(slip, p[RAMP_START], p[RAMP_END])
    normal = elastic * damping
    fx, fy = normal * (nx - ratio * ny), normal * (ny + ratio * nx)
    if shape == ELASTIC_FOUNDATION:
        return fx, fy, damping * (moment + ratio * turned), deep, rate, nx, ny, normal, slip
    return fx, fy, cx * fy - cy * fx, deep, rate, nx, ny, normal, slip
