"""Compiled implicit wear step, coupled over all crank positions of a cycle.

All positions wear the same profile: the wear of one opens the gap of the others. With backward
Euler the step is one convex problem. For given touching sets and normals, the normal forces of
position k are lam_k = B_k Q_k (F_k + B_k^T (g_k + h)) - A_k^-1 (g_k + h) with B_k = A_k^-1 N_k and
Q_k = (N_k^T B_k)^-1, and the wear h on all nodes follows from sum s_k lam_k = h / D, where s_k is
the slip of the position, D = K dN / w. Sets, normals and pins are then revised.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.bushing.active_set import (
    CARRIED,
    NOT_SETTLED,
    ONE_SIDED,
    assemble,
    displace,
    list_touching,
    pin_move,
    place_pin,
    revise,
)
from rigapp_model.bushing.linear import factorise, invert, substitute
from rigapp_model.compiled import njit

_LIMIT = 40  # sweeps; usually 5 to 10 converge, changes of single nodes after _PATIENCE need more
# Sweeps after which each position changes its set one node at a time.
_PATIENCE = 25
# Sweeps without a change of the wear that end the iteration: the position of a weak force at the
# edge of the wear by strong ones may change for long, without effect.
_QUIET = 4
# Ratio of touching nodes to those at the start beyond which the sets diverge.
_GROWTH = 4


@njit(
    "boolean(float64[:,:,::1], float64[:,::1], float64[::1], int64[::1], int64, float64[:,::1],"
    " float64[:,::1], float64[:,::1], float64[:,::1])",
    cache=True,
    error_model="numpy",
)
def _invert(polar, frame, gap, nodes, count, rows, work, lower, inverse):  # type: ignore[no-untyped-def]
    """Compute the upper triangle of A^-1, and rows = A^-1 times the normals' x, y and the gap.

    Returns False if A is not positive definite. ``work``, ``lower``, ``inverse``: at least
    count x count.
    """
    assemble(polar, frame, nodes, count, work)
    for p in range(count):
        i = nodes[p]
        rows[0, p] = frame[i, 0]
        rows[1, p] = frame[i, 1]
        rows[2, p] = gap[i]
    if not factorise(work, count) > 0.0:
        return False
    substitute(work, count, rows, 3)
    invert(work, count, lower, inverse)
    return True


@njit(
    "void(float64[:,::1], int64[::1], int64, float64[:,::1], float64[:,::1])",
    cache=True,
    error_model="numpy",
)
def _pin_compliance(frame, nodes, count, rows, compliance):  # type: ignore[no-untyped-def]
    """Compute Q, the pin's move per unit force, (2, 2); NaN if the contact is one-sided."""
    stiffness = np.zeros((2, 2))
    for p in range(count):
        for u in range(2):
            for v in range(2):
                stiffness[u, v] += frame[nodes[p], u] * rows[v, p]
    for v in range(2):
        unit = np.zeros(2)
        unit[v] = 1.0
        compliance[:, v] = pin_move(stiffness, np.zeros((2, 2)), unit)


@njit(
    "void(float64[:,::1], int64[::1], int64, int64[::1], float64, float64[:,::1], float64[:,::1],"
    " float64[:,::1], float64[::1], float64[:,::1], float64[::1])",
    cache=True,
    error_model="numpy",
)
def _add_to_system(frame, nodes, count, row_of, slip, rows, inverse, q, force, system, pull):  # type: ignore[no-untyped-def]
    """Add one position's slip x T to the system and slip x b to its right-hand side."""
    t0, t1 = force[0], force[1]
    for p in range(count):
        t0 += frame[nodes[p], 0] * rows[2, p]
        t1 += frame[nodes[p], 1] * rows[2, p]
    u0 = q[0, 0] * t0 + q[0, 1] * t1
    u1 = q[1, 0] * t0 + q[1, 1] * t1
    for i in range(count):
        bx, by = rows[0, i], rows[1, i]
        row = row_of[nodes[i]]
        c0 = q[0, 0] * bx + q[0, 1] * by
        c1 = q[1, 0] * bx + q[1, 1] * by
        pull[row] += slip * (bx * u0 + by * u1 - rows[2, i])
        for j in range(i, count):
            system[row, row_of[nodes[j]]] += slip * (
                inverse[i, j] - c0 * rows[0, j] - c1 * rows[1, j]
            )


@njit(
    "float64[::1](int64[::1], int64, float64[:,::1], float64[::1], float64[:,::1], float64[:,::1],"
    " float64[:,::1], float64[::1], float64[::1])",
    cache=True,
    error_model="numpy",
)
def _normal_forces(nodes, count, frame, wear, rows, inverse, q, force, load):  # type: ignore[no-untyped-def]
    """Compute the normal forces of one position for a wear; return the pin's move, (2,)."""
    opened = np.zeros(count)
    for i in range(count):
        h = wear[nodes[i]]
        opened[i] += inverse[i, i] * h
        for j in range(i + 1, count):
            opened[i] += inverse[i, j] * wear[nodes[j]]
            opened[j] += inverse[i, j] * h
    t = force.copy()
    for p in range(count):
        for u in range(2):
            t[u] += frame[nodes[p], u] * (rows[2, p] + opened[p])
    move = np.zeros(2)
    for u in range(2):
        move[u] = q[u, 0] * t[0] + q[u, 1] * t[1]
    for p in range(count):
        load[p] = rows[0, p] * move[0] + rows[1, p] * move[1] - rows[2, p] - opened[p]
    return move


@njit("float64(float64[:,::1])", cache=True, error_model="numpy")
def _least_angle(axis):  # type: ignore[no-untyped-def]
    """Return the least angle between neighbouring nodes, rad."""
    least = np.pi
    for i in range(axis.shape[0] - 1):
        sine = axis[i, 0] * axis[i + 1, 1] - axis[i, 1] * axis[i + 1, 0]
        least = min(least, abs(sine))
    return least


@njit(
    "float64[::1](float64[::1], float64[::1], float64[::1], float64, float64)",
    cache=True,
    error_model="numpy",
)
def _bounded(move, force, pin, pin_radius, spacing):  # type: ignore[no-untyped-def]
    """Return the pin's move, limited to a few nodes across the force.

    Few touching nodes have little lateral stiffness, and a pin that overshoots touches nodes that
    remain in the set. When the contact advances by one node, the pin moves by its distance from
    the bushing's centre times the angle between nodes.
    """
    size = np.sqrt(force[0] ** 2 + force[1] ** 2)
    fx, fy = force[0] / size, force[1] / size
    along = move[0] * fx + move[1] * fy
    across = move[1] * fx - move[0] * fy
    reach = 0.1 * pin_radius
    sideways = min(3.0 * spacing * np.sqrt(pin[0] ** 2 + pin[1] ** 2) + abs(along), reach)
    along = min(max(along, -reach), reach)
    across = min(max(across, -sideways), sideways)
    bounded = np.empty(2)
    bounded[0] = along * fx - across * fy
    bounded[1] = along * fy + across * fx
    return bounded


@njit(
    "Tuple((int64, int64))(float64[:,::1], float64[:,::1], float64[:,:,::1], float64[::1],"
    " float64, float64[:,::1], float64[::1], float64, float64[:,::1], boolean[:,::1],"
    " float64[:,::1], float64[:,::1])",
    cache=True,
    error_model="numpy",
)
def wear_step(  # type: ignore[no-untyped-def]
    surface,
    axis,
    polar,
    resistance,
    pin_radius,
    forces,
    slips,
    tolerance,
    pins,
    touching,
    pressed,
    offset,
):
    """Advance all positions by one step; updates pins, touching, pressed and offset in place.

    surface (N, 2); resistance (N,): w / (K dN), force per unit of wear; forces (M, 2) per metre of
    width; slips (M,); tolerance: of the conditions, relative to the largest force and to the
    elastic displacement; pins (M, 2), touching and pressed (M, N): start, then result; offset
    (N, 2): wear as displacement of the nodes. Returns status and sweeps.
    """
    positions, n = touching.shape
    frames = np.empty((positions, n, 4))
    gaps = np.empty((positions, n))
    lists = np.empty((positions, n), dtype=np.int64)
    counts = np.zeros(positions, dtype=np.int64)
    row_of = np.empty(n, dtype=np.int64)
    wear = np.zeros(n)
    quiet = 0
    first_union = n
    spacing = _least_angle(axis)
    for k in range(positions):
        place_pin(surface, axis, pin_radius, pins[k], frames[k], gaps[k])
    for sweep in range(1, _LIMIT + 1):
        largest = 0
        for k in range(positions):
            counts[k] = list_touching(touching[k], gaps[k], lists[k])
            largest = max(largest, counts[k])
        union = 0
        for i in range(n):
            row_of[i] = -1
            for k in range(positions):
                if touching[k, i]:
                    row_of[i] = union
                    union += 1
                    break
        system = np.zeros((union, union))
        pull = np.zeros((1, union))
        for i in range(n):
            if row_of[i] >= 0:
                system[row_of[i], row_of[i]] = resistance[i]
        first_union = min(first_union, union)
        if union > _GROWTH * first_union + 100:
            return NOT_SETTLED, sweep
        rows = np.empty((positions, 3, largest))
        inverses = np.empty((positions, largest, largest))
        work = np.empty((largest, largest))
        lower = np.empty((largest, largest))
        turns = np.empty((positions, 2, 2))
        for k in range(positions):
            count = counts[k]
            frame, nodes = frames[k], lists[k]
            if not _invert(polar, frame, gaps[k], nodes, count, rows[k], work, lower, inverses[k]):
                return NOT_SETTLED, sweep
            _pin_compliance(frame, nodes, count, rows[k], turns[k])
            if not np.isfinite(turns[k, 0, 0]):
                return ONE_SIDED, sweep
            _add_to_system(
                frame,
                nodes,
                count,
                row_of,
                slips[k],
                rows[k],
                inverses[k],
                turns[k],
                forces[k],
                system,
                pull[0],
            )
        if not factorise(system, union) > 0.0:
            return NOT_SETTLED, sweep
        substitute(system, union, pull, 1)
        change = largest_wear = 0.0
        for i in range(n):
            value = pull[0, row_of[i]] if row_of[i] >= 0 else 0.0
            change = max(change, abs(value - wear[i]))
            largest_wear = max(largest_wear, value)
            wear[i] = value
        quiet = quiet + 1 if change <= tolerance * largest_wear else 0
        broken = 0
        travel = 0.0
        deepest = 0.0
        for k in range(positions):
            count = counts[k]
            frame, nodes = frames[k], lists[k]
            load = np.empty(count)
            move = _normal_forces(
                nodes, count, frame, wear, rows[k], inverses[k], turns[k], forces[k], load
            )
            travel = max(travel, np.sqrt(move[0] ** 2 + move[1] ** 2))
            pins[k] += _bounded(move, forces[k], pins[k], pin_radius, spacing)
            pressed[k, :] = 0.0
            for p in range(count):
                pressed[k, nodes[p]] = load[p]
            place_pin(surface, axis, pin_radius, pins[k], frame, gaps[k])
            reach = 0.0
            for p in range(count):
                reach = max(reach, abs(gaps[k, nodes[p]] + wear[nodes[p]]))
            deepest = max(deepest, reach)
            left = gaps[k] + wear
            displace(polar, frame, pressed[k], nodes, count, reach, left)
            broken += revise(left, touching[k], pressed[k], reach, tolerance, sweep > _PATIENCE)
        settled = broken == 0 and travel <= tolerance * deepest
        if settled or quiet >= _QUIET:
            offset[:] = 0.0
            for k in range(positions):
                for p in range(counts[k]):
                    i = lists[k, p]
                    pressed[k, i] = max(pressed[k, i], 0.0)
                    share = slips[k] * pressed[k, i] / resistance[i]
                    offset[i, 0] += share * frames[k, i, 0]
                    offset[i, 1] += share * frames[k, i, 1]
            return CARRIED, sweep
    return NOT_SETTLED, _LIMIT
