"""The compiled part of the contact: active set, Cholesky, Schur system for the pin.

``frame`` (N, 4) holds for each surface node the unit normal from the pin centre, in global
components and in radial and tangential components of the node's own place on the ring.
"""

from __future__ import annotations

import numpy as np
from numba import njit

from model.bushing.linear import factorise, substitute

CARRIED = 0
NOT_SETTLED = 1
ONE_SIDED = 2

_LIMIT = 200
# After so many iterations the set changes one node at a time, which cannot cycle.
_PATIENCE = 30


@njit(
    "void(float64[:,::1], float64[:,::1], float64, float64[::1], float64[:,::1], float64[::1])",
    cache=True,
)
def place_pin(surface, axis, pin_radius, pin, frame, gap):  # type: ignore[no-untyped-def]
    """Fill the frame and the rigid gap of every node for a pin centre."""
    for i in range(surface.shape[0]):
        x = surface[i, 0] - pin[0]
        y = surface[i, 1] - pin[1]
        distance = np.sqrt(x * x + y * y)
        x /= distance
        y /= distance
        frame[i, 0] = x
        frame[i, 1] = y
        frame[i, 2] = x * axis[i, 0] + y * axis[i, 1]
        frame[i, 3] = y * axis[i, 0] - x * axis[i, 1]
        gap[i] = distance - pin_radius


@njit("float64(float64[:,:,::1], float64[:,::1], int64, int64)", cache=True, inline="always")
def normal_compliance(polar, frame, i, j):  # type: ignore[no-untyped-def]
    """Return the normal displacement at node i by a unit normal force at node j."""
    return frame[i, 2] * (
        polar[0, i, j] * frame[j, 2] + polar[1, i, j] * frame[j, 3]
    ) + frame[i, 3] * (polar[1, j, i] * frame[j, 2] + polar[2, i, j] * frame[j, 3])


@njit("int64(boolean[::1], float64[::1], int64[::1])", cache=True)
def list_touching(touching, gap, nodes):  # type: ignore[no-untyped-def]
    """List the touching nodes, the nearest ones made touching if there are fewer than two."""
    count = 0
    for i in range(touching.size):
        if touching[i]:
            nodes[count] = i
            count += 1
    if count >= 2:
        return count
    for _ in range(2 - count):
        best = -1
        for i in range(touching.size):
            if not touching[i] and (best < 0 or gap[i] < gap[best]):
                best = i
        touching[best] = True
    return list_touching(touching, gap, nodes)


@njit(
    "int64(float64[:,:,::1], float64[:,::1], float64[::1], boolean[::1], float64[::1],"
    " int64[::1], int64, float64, boolean)",
    cache=True,
)
def revise(polar, frame, gap, touching, pressed, nodes, count, reach, single):  # type: ignore[no-untyped-def]
    """Drop what pulls, add what overlaps; return how many conditions were broken.

    gap: with wear of an implicit step included for nodes that do not touch; reach: rigid gap up
    to which a node may overlap; single: change only the node that breaks its condition worst.
    """
    largest = 0.0
    for p in range(count):
        largest = max(largest, pressed[nodes[p]])
    broken = 0
    worst = -1
    worst_size = 0.0
    for i in range(touching.size):
        if touching[i]:
            share = -pressed[i] / largest if largest > 0.0 else 1.0
        elif gap[i] <= reach:
            left = gap[i]
            for p in range(count):
                left += pressed[nodes[p]] * normal_compliance(polar, frame, i, nodes[p])
            share = -left / reach - 1e-9
        else:
            continue
        if share > 0.0:
            broken += 1
            if not single:
                touching[i] = not touching[i]
            elif share > worst_size:
                worst, worst_size = i, share
    if worst >= 0:
        touching[worst] = not touching[worst]
    return broken


@njit(
    "Tuple((int64, int64))(float64[:,::1], float64[:,::1], float64[:,:,::1], float64[::1],"
    " float64, float64[::1], float64[::1], boolean[::1], float64[::1], float64[::1],"
    " float64[:,::1])",
    cache=True,
)
def solve(  # type: ignore[no-untyped-def]
    surface, axis, polar, extra, pin_radius, force, pin, touching, pressed, gap, frame
):
    """Solve one contact; pin, touching, pressed, gap and frame are changed in place.

    Returns the status and the number of iterations. Each iteration solves gap = 0 on the touching
    nodes together with the balance of forces, linear in the pin's move, then revises the set. It
    ends when set and pin stay. ``gap`` is then what is left after elastic displacement.
    """
    n = surface.shape[0]
    nodes = np.empty(n, dtype=np.int64)
    a = np.empty((n, n))
    columns = np.empty((n, 3))
    place_pin(surface, axis, pin_radius, pin, frame, gap)
    for iteration in range(1, _LIMIT + 1):
        count = list_touching(touching, gap, nodes)
        for p in range(count):
            i = nodes[p]
            for q in range(p + 1):
                a[p, q] = normal_compliance(polar, frame, i, nodes[q])
            a[p, p] += extra[i]
            columns[p, 0] = frame[i, 0]
            columns[p, 1] = frame[i, 1]
            columns[p, 2] = gap[i]
        if factorise(a, count) <= 0.0:
            return NOT_SETTLED, iteration
        substitute(a, count, columns, 3)
        s00 = s01 = s11 = 0.0
        t0, t1 = force[0], force[1]
        for p in range(count):
            x = frame[nodes[p], 0]
            y = frame[nodes[p], 1]
            s00 += x * columns[p, 0]
            s01 += x * columns[p, 1]
            s11 += y * columns[p, 1]
            t0 += x * columns[p, 2]
            t1 += y * columns[p, 2]
        determinant = s00 * s11 - s01 * s01
        if not determinant > 1e-15 * (s00 + s11) ** 2:
            return ONE_SIDED, iteration
        move_x = (s11 * t0 - s01 * t1) / determinant
        move_y = (s00 * t1 - s01 * t0) / determinant
        pressed[:] = 0.0
        for p in range(count):
            pressed[nodes[p]] = columns[p, 0] * move_x + columns[p, 1] * move_y - columns[p, 2]
        move = np.sqrt(move_x * move_x + move_y * move_y)
        step = min(1.0, 0.1 * pin_radius / move) if move > 0.0 else 1.0
        pin[0] += step * move_x
        pin[1] += step * move_y
        place_pin(surface, axis, pin_radius, pin, frame, gap)
        reach = 0.0
        for p in range(count):
            reach = max(reach, abs(gap[nodes[p]]))
        broken = revise(
            polar, frame, gap, touching, pressed, nodes, count, reach, iteration > _PATIENCE
        )
        if broken == 0 and step == 1.0 and move <= 1e-9 * reach + 1e-16:
            for i in range(n):
                for p in range(count):
                    gap[i] += pressed[nodes[p]] * normal_compliance(polar, frame, i, nodes[p])
                gap[i] += extra[i] * pressed[i]
            return CARRIED, iteration
    return NOT_SETTLED, _LIMIT
