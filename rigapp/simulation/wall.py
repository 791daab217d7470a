"""Elasticity and wear of the bushing's wall in the simulated rig.

Elasticity is in closed form: in a ring whose rim is fixed a radial traction cos(n t) on the bore
moves the bore by a_n cos(n t); Navier's equations in plane strain have four powers of the radius
for each n, and four conditions at the two radii give a_n (no mesh of the wall, no finite elements).
The traction is piecewise linear between nodes on one half of the bore: contact and profile are
symmetric about the direction of the force, which in the follower frame varies by one or two
degrees. The pin is rigid.

Contact: pin and worn bore touch from the middle outwards, so a single elimination in that order
gives the contacts of all widths; the force determines which applies. Wear: Archard's law at every
node, implicit in time. Pressures are tabulated for LEVELS forces and are valid until the wear
reaches a small share of depth and approach; each includes the wear of that time, so that a step of
any length is stable.
"""

# mypy: disable-error-code="untyped-decorator, no-any-return"
from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import float64, int64, types
from numpy.typing import NDArray

from rigapp_model.compiled import UNCOUNTED, njit

Array = NDArray[np.float64]
F = types.float64

NODES = 100
FINEST = 0.1
"""Spacing of the first nodes as a fraction of the unworn contact's half-angle."""
LEAST_FORCE_N = 1e-3
"""Lower limit of the force for the contact width, which avoids a division by zero."""
ROUNDING = 1e-9
"""Relative tolerance at which a depth counts as reached."""
REACH_RAD = math.radians(88.0)
WAVES = 4.0
"""Highest wave number as a multiple of the highest that the nodes resolve."""
LEVELS = 6
FORCE_MARGIN = 1.2
"""Ratio of the highest tabulated force to the highest one so far."""
WEAR_SHARE = 0.01
"""A table is valid until the depth has grown by this share of depth and approach."""

HIGHEST_FORCE, VALID_SLIP = range(2)
"""State of a table: its highest force (N), slip (m) for which it remains valid."""
PEAK, APPROACH, AREA, SLID = range(4)
"""Columns of a table, one row per force: middle pressure (Pa), approach (m), area worn per slip and
wear coefficient (N/m), slip at this force since the table was computed (m)."""


class Wall(NamedTuple):
    """A wall: constant nodes and compliance, and its accumulated wear.

    angle, weight (NODES,): rad; compliance (NODES, NODES): m/Pa; worn (NODES,): radial depth, m;
    table (LEVELS + 1, 4), pressure (LEVELS + 1, NODES): per force, Pa; state: see HIGHEST_FORCE.
    """

    angle: Array
    weight: Array
    compliance: Array
    worn: Array
    table: Array
    pressure: Array
    state: Array


ROW, SQUARE = types.Array(float64, 1, "C"), types.Array(float64, 2, "C")
WALL = types.NamedTuple((ROW, ROW, SQUARE, ROW, SQUARE, SQUARE, ROW), Wall)


class Bore(NamedTuple):
    """Constants of the contact; SI units, K in m^2/N."""

    pin_radius: float
    bushing_radius: float
    width: float
    wear_coefficient: float


BORE = types.NamedUniTuple(float64, len(Bore._fields), Bore)


def unworn_wall(
    bore: Bore, outer_radius: float, modulus: float, poisson: float, typical_force: float
) -> Wall:
    """Return a new wall; typical_force (N): determines the spacing of the nodes."""
    angle = _nodes(FINEST * _first_half_angle(bore, modulus / (1.0 - poisson**2), typical_force))
    wall = Wall(
        angle=angle,
        weight=_hat(angle, np.zeros(1))[:, 0],
        compliance=_compliance(angle, bore.bushing_radius, outer_radius, modulus, poisson),
        worn=np.zeros(NODES),
        table=np.zeros((LEVELS + 1, 4)),
        pressure=np.zeros((LEVELS + 1, NODES)),
        state=np.zeros(2),
    )
    renew(wall, bore, typical_force)
    return wall


def _first_half_angle(bore: Bore, modulus: float, force: float) -> float:
    """Return the half-angle of Hertz's line contact of a rigid pin, rad, at most 1."""
    clearance = bore.bushing_radius - bore.pin_radius
    if clearance <= 0.0:
        return 1.0
    relative = bore.pin_radius * bore.bushing_radius / clearance
    half_width = math.sqrt(
        4.0 * relative * max(force, LEAST_FORCE_N) / (math.pi * bore.width * modulus)
    )
    return min(half_width / bore.pin_radius, 1.0)


def _nodes(first: float) -> Array:
    """Return angles from 0 to REACH_RAD with increasing spacing, beginning with ``first``."""
    low, high = 1e-9, 50.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        wide = REACH_RAD * math.sinh(middle / (NODES - 1)) / math.sinh(middle) > first
        low, high = (middle, high) if wide else (low, middle)
    share = np.linspace(0.0, 1.0, NODES)
    return np.asarray(REACH_RAD * np.sinh(high * share) / math.sinh(high))


def _hat(angle: Array, wave: Array) -> Array:
    """Return the integrals of each node's hat function times cos(n t), (NODES, waves)."""
    step = np.diff(angle)
    left, right = np.append(step[:1], step), np.append(step, step[-1:])
    n = np.maximum(wave, 1e-9)

    def double_integral(at: Array) -> Array:
        # (1 - cos) / n^2 without cancellation.
        return np.asarray(2.0 * (np.sin(0.5 * np.outer(at, n)) / n) ** 2)

    integral = (
        double_integral(angle - left) / left[:, None]
        + double_integral(angle + right) / right[:, None]
    )
    integral = integral - double_integral(angle) * (1.0 / left + 1.0 / right)[:, None]
    integral[0] *= 0.5
    return np.asarray(integral)


def _compliance(angle: Array, inner: float, outer: float, modulus: float, poisson: float) -> Array:
    """Return the outward motion (m) of the bore at each node per Pa at each and its mirror node."""
    waves = np.arange(0.0, math.ceil(WAVES * math.pi / (angle[1] - angle[0])) + 1.0)
    gives = np.array([wave_compliance(n, inner, outer, modulus, poisson) for n in waves])
    gives *= np.where(waves == 0.0, 1.0, 2.0) / math.pi
    return np.ascontiguousarray((np.cos(np.outer(angle, waves)) * gives) @ _hat(angle, waves).T)


def wave_compliance(n: float, inner: float, outer: float, modulus: float, poisson: float) -> float:
    """Return the motion (m) of the bore for a pressure of 1 Pa cos(n t); the rim is fixed.

    u_r = U r^x cos(n t), u_t = V r^x sin(n t). Two powers coincide at n = 1: the limit is used.
    """
    n = n + 1e-6 if n == 1.0 else n
    shear = modulus / (2.0 * (1.0 + poisson))
    lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson)
    k = lame + 2.0 * shear
    powers = np.array([n - 1.0, -n - 1.0, n + 1.0, 1.0 - n])
    v = np.array(
        [
            -1.0,
            1.0,
            -(k * (n + 2.0) - shear * n) / (k * n - shear * (n + 2.0)),
            -(k * (2.0 - n) + shear * n) / (k * n + shear * (2.0 - n)),
        ]
    )
    # Scale increasing powers to the rim, decreasing ones to the bore.
    grows = powers > 0.0
    ratio = np.power(inner / outer, np.abs(powers))
    bore, rim = np.where(grows, ratio, 1.0), np.where(grows, 1.0, ratio)
    stress = (k * powers + lame * (1.0 + n * v)) * bore / inner
    shearing = shear * (powers * v - n - v) * bore / inner
    solution = np.linalg.solve(np.array([stress, shearing, rim, rim * v]), [-1.0, 0.0, 0.0, 0.0])
    return float(solution @ bore)


@njit(types.void(WALL, BORE, SQUARE), **UNCOUNTED)
def shape(w: Wall, k: Bore, at: Array) -> None:
    """Write the pin's circle at each node when it touches in the middle: ``at`` (4, NODES).

    Rows: its overlap with the worn bore along the ray, m (0 or less); displacement there per
    displacement of the pin's centre; arc of the pin per radian of the bore, m; cosine of the angle
    between ray and normal.
    """
    away = k.bushing_radius - k.pin_radius + w.worn[0]
    for i in range(len(w.angle)):
        cosine = math.cos(w.angle[i])
        sine = away * math.sin(w.angle[i]) / k.pin_radius
        lean = math.sqrt(1.0 - sine * sine)
        at[0, i] = away * cosine + k.pin_radius * lean - k.bushing_radius - w.worn[i]
        at[1, i] = math.cos(w.angle[i] + math.asin(sine)) / lean
        at[2, i] = k.pin_radius + away * cosine / lean
        at[3, i] = lean


@njit(int64(WALL, BORE, F, F, SQUARE, SQUARE, SQUARE), **UNCOUNTED)
def eliminate(
    w: Wall, k: Bore, slip: float, force: float, at: Array, factors: Array, solved: Array
) -> int:
    """Factorise [compliance + wear] node by node, until the contact carries a force (N/m).

    Return the number of touching nodes; the first m rows and columns are the contact of m nodes.
    factors (NODES, NODES): lower (unit diagonal), upper; solved (5, NODES): both right-hand sides
    after elimination, and the forces (N/m) of a contact of this width for a displacement of the
    pin's centre by 1 m, and by 0; last, the factors for the next node.
    """
    slope, base = 0.0, 0.0
    for m in range(len(w.angle)):
        for j in range(m + 1):
            row = w.compliance[m, j] * at[2, j] * at[3, j] / k.bushing_radius
            column = w.compliance[j, m] * at[2, m] * at[3, m] / k.bushing_radius
            for i in range(j):
                row -= factors[m, i] * factors[i, j]
                column -= factors[j, i] * factors[i, m]
            if j < m:
                factors[m, j] = row / factors[j, j]
                factors[j, m] = column
            else:
                factors[m, m] = row + k.wear_coefficient * slip / at[3, m]
        step, room = at[1, m], at[0, m]
        carried = 2.0 * w.weight[m] * at[2, m] * at[1, m] * at[3, m]
        for j in range(m):
            step -= factors[m, j] * solved[0, j]
            room -= factors[m, j] * solved[1, j]
            carried -= solved[4, j] * factors[j, m]
        solved[0, m], solved[1, m], solved[4, m] = step, room, carried / factors[m, m]
        slope += solved[4, m] * step
        base += solved[4, m] * room
        solved[2, m], solved[3, m] = slope, base
        if m > 0 and room + (force - base) / slope * step <= 0.0:
            return m
    return len(w.angle)


@njit(types.void(WALL, BORE, F), cache=True)
def tabulate(w: Wall, k: Bore, slip: float) -> None:
    """Recompute the table for the worn wall; its pressures are valid for a further slip (m)."""
    count = len(w.angle)
    at, factors, solved = np.empty((4, count)), np.empty((count, count)), np.empty((5, count))
    shape(w, k, at)
    top = w.state[HIGHEST_FORCE] / k.width
    widest = eliminate(w, k, slip, top, at, factors, solved)
    for level in range(1, LEVELS + 1):
        force = top * (level / LEVELS) ** 2
        width, sunk = 0, 0.0
        while width < widest:
            deeper = (force - solved[3, width]) / solved[2, width]
            if width > 0 and solved[1, width] + deeper * solved[0, width] <= 0.0:
                break
            width, sunk = width + 1, deeper
        p = w.pressure[level]
        p[:] = 0.0
        approach, area = 0.0, 0.0
        for i in range(width - 1, -1, -1):
            value = solved[1, i] + sunk * solved[0, i]
            for j in range(i + 1, width):
                value -= factors[i, j] * p[j]
            p[i] = value / factors[i, i]
            approach += w.compliance[0, i] * p[i] * at[2, i] * at[3, i] / k.bushing_radius
            area += 2.0 * w.weight[i] * at[2, i] * p[i]
        w.table[level] = (p[0], approach, area, 0.0)


@njit(types.void(WALL, BORE, F), **UNCOUNTED)
def renew(w: Wall, k: Bore, force: float) -> None:
    """Apply the wear accumulated in the table, and compute a new one up to a force (N)."""
    away = k.bushing_radius - k.pin_radius + w.worn[0]
    for i in range(len(w.angle)):
        lean = math.sqrt(1.0 - (away * math.sin(w.angle[i]) / k.pin_radius) ** 2)
        for level in range(1, LEVELS + 1):
            w.worn[i] += k.wear_coefficient * w.table[level, SLID] * w.pressure[level, i] / lean
    if force > w.state[HIGHEST_FORCE]:
        w.state[HIGHEST_FORCE] = FORCE_MARGIN * force
        tabulate(w, k, 0.0)
    fastest = k.wear_coefficient * w.table[LEVELS, PEAK]
    w.state[VALID_SLIP] = math.inf
    if fastest > 0.0:
        w.state[VALID_SLIP] = WEAR_SHARE * (w.worn[0] + w.table[LEVELS, APPROACH]) / fastest
        tabulate(w, k, w.state[VALID_SLIP])


@njit(types.Tuple((int64, F))(ROW, F), forceinline=True, **UNCOUNTED)
def row_of(state: Array, force: float) -> tuple[int, float]:
    """Return the row of the table below a force (N) and the fraction of the way to the next."""
    share = LEVELS**2 * max(force, 0.0) / state[HIGHEST_FORCE]
    level = max(0, min(int(math.sqrt(share)), LEVELS - 1))
    return level, (share - level * level) / (2.0 * level + 1.0)


@njit(float64(SQUARE, ROW, F, int64), forceinline=True, **UNCOUNTED)
def looked_up(table: Array, state: Array, force: float, column: int) -> float:
    """Return a column of the table at a force, N."""
    level, part = row_of(state, force)
    return (1.0 - part) * table[level, column] + part * table[level + 1, column]


@njit(types.UniTuple(F, 2)(SQUARE, ROW, F, F, F), forceinline=True, **UNCOUNTED)
def worn(
    table: Array, state: Array, wear_coefficient: float, force: float, slip: float
) -> tuple[float, float]:
    """Return (growth of the depth in the middle, growth of the worn area), m and m^2, for a slip.

    wear_coefficient: m^2/N; force: N; slip: m. The profile follows in ``renew``, which is due when
    state[VALID_SLIP] is not above 0.
    """
    if force <= 0.0 or wear_coefficient == 0.0:
        return 0.0, 0.0
    level, part = row_of(state, force)
    low, high = (1.0 - part) * slip, part * slip
    table[level, SLID] += low
    table[level + 1, SLID] += high
    state[VALID_SLIP] -= slip
    deeper = low * table[level, PEAK] + high * table[level + 1, PEAK]
    area = low * table[level, AREA] + high * table[level + 1, AREA]
    return wear_coefficient * deeper, wear_coefficient * area


ANY_COEFFICIENT = 1e-12
"""Arbitrary wear coefficient, m^2/N: the profile at a depth does not depend on it."""


def worn_wall(wall: Wall, k: Bore, force: float, depth: float) -> tuple[Wall, float]:
    """Wear a new wall under a constant force (N) to a depth (m); return it and the worn area."""
    some = k._replace(wear_coefficient=ANY_COEFFICIENT)
    table, state = wall.table, wall.state
    renew(wall, some, force)
    area = 0.0
    while wall.worn[0] < depth * (1.0 - ROUNDING):
        left = (depth - float(wall.worn[0])) / ANY_COEFFICIENT
        slip = min(left / looked_up(table, state, force, PEAK), float(state[VALID_SLIP]))
        area += worn(table, state, ANY_COEFFICIENT, force, slip)[1]
        renew(wall, some, force)
    renew(wall, k, force)
    return wall, area
