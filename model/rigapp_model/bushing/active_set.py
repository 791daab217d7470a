"""Compiled kernels of the contact: active set, Cholesky, Schur system for the pin.

``frame`` (N, 4) holds for each surface node the unit normal from the pin centre, in global
components and in radial and tangential components at the node's own angle on the ring.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.bushing.linear import factorise, substitute
from rigapp_model.compiled import njit

CARRIED = 0
NOT_SETTLED = 1
ONE_SIDED = 2

_LIMIT = 200  # iterations; bounds the changes of single nodes after _PATIENCE
_SAFE = 0.3  # of the determinant without turning; with less the linearisation is not valid
_SINGULAR = 1e-15  # of the squared trace: stiffness in one direction only
_CLOSED = 1e-6  # of the largest gap: tolerance of gaps and overlaps
_BALANCED = 1e-6  # of the force: tolerance of its balance with the pressures
_LONGEST_STEP = 0.1  # of the pin's radius; a longer one moves nodes to other parts of its surface
_STILL = 1e-12  # of the pin's radius: rounding of a position
# Iterations after which the set changes one node at a time, which cannot cycle.
_PATIENCE = 30


@njit(
    "void(float64[:,::1], float64[:,::1], float64, float64[::1], float64[:,::1], float64[::1])",
    cache=True,
    error_model="numpy",
)
def place_pin(surface, axis, pin_radius, pin, frame, gap):  # type: ignore[no-untyped-def]
    """Fill the frame and the rigid gap of each node for a pin centre."""
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


@njit(
    "float64(float64[:,:,::1], float64[:,::1], int64, int64)",
    cache=True,
    error_model="numpy",
    inline="always",
)
def normal_compliance(polar, frame, i, j):  # type: ignore[no-untyped-def]
    """Return the normal displacement at node i per unit normal force at node j."""
    return frame[i, 2] * (polar[0, i, j] * frame[j, 2] + polar[1, i, j] * frame[j, 3]) + (
        frame[i, 3] * (polar[2, i, j] * frame[j, 2] + polar[3, i, j] * frame[j, 3])
    )


@njit(
    "void(float64[:,:,::1], float64[:,::1], int64[::1], int64, float64[:,::1])",
    cache=True,
    error_model="numpy",
)
def assemble(polar, frame, nodes, count, a):  # type: ignore[no-untyped-def]
    """Fill the upper triangle of a[:count, :count] with the normal compliance between nodes.

    Consecutive nodes, the usual case, are processed as slices, which the compiler vectorises.
    """
    radial, tangential = np.empty(count), np.empty(count)
    for p in range(count):
        radial[p], tangential[p] = frame[nodes[p], 2], frame[nodes[p], 3]
    follow = nodes[count - 1] - nodes[0] == count - 1
    for p in range(count):
        i = nodes[p]
        if not follow:
            for q in range(p, count):
                a[p, q] = normal_compliance(polar, frame, i, nodes[q])
            continue
        row, r, t, end = a[p, p:count], radial[p:count], tangential[p:count], i + count - p
        rr, rt = polar[0, i, i:end], polar[1, i, i:end]
        tr, tt = polar[2, i, i:end], polar[3, i, i:end]
        r0, t0 = radial[p], tangential[p]
        for q in range(row.size):
            row[q] = r0 * (rr[q] * r[q] + rt[q] * t[q]) + (t0 * (tr[q] * r[q] + tt[q] * t[q]))


@njit(
    "void(float64[:,:,::1], float64[:,::1], float64[::1], int64[::1], int64, float64,"
    " float64[::1])",
    cache=True,
    error_model="numpy",
)
def displace(polar, frame, pressed, nodes, count, reach, gap):  # type: ignore[no-untyped-def]
    """Add to the gap the normal displacement by the pressed nodes.

    Only from the first to the last node with a gap within reach; the others cannot touch.
    Rows are used for columns (reciprocity), so that the inner loop is contiguous in memory.
    """
    low, high = 0, gap.size
    while low < high and gap[low] > reach:
        low += 1
    while high > low and gap[high - 1] > reach:
        high -= 1
    # Slices, loops from 0 and one sum in each: the form that the compiler vectorises.
    radial = np.zeros(high - low)
    tangential = np.zeros(high - low)
    for p in range(count):
        j = nodes[p]
        r = pressed[j] * frame[j, 2]
        t = pressed[j] * frame[j, 3]
        by_r, by_t = polar[0, j, low:high], polar[2, j, low:high]
        for i in range(radial.size):
            radial[i] += by_r[i] * r + by_t[i] * t
        by_r, by_t = polar[1, j, low:high], polar[3, j, low:high]
        for i in range(radial.size):
            tangential[i] += by_r[i] * r + by_t[i] * t
    for i in range(low, high):
        gap[i] += frame[i, 2] * radial[i - low] + frame[i, 3] * tangential[i - low]


@njit("int64(boolean[::1], float64[::1], int64[::1])", cache=True, error_model="numpy")
def list_touching(touching, gap, nodes):  # type: ignore[no-untyped-def]
    """List the touching nodes; if fewer than two, mark the nearest ones as touching."""
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
    "int64(float64[::1], boolean[::1], float64[::1], float64, float64, boolean)",
    cache=True,
    error_model="numpy",
)
def revise(left, touching, pressed, reach, slack, single):  # type: ignore[no-untyped-def]
    """Remove nodes in tension, add overlapping ones; return the number of violated conditions.

    left: gap after displacement; reach: largest displacement; slack: tolerance of the count, as a
    fraction of the largest force or of the reach; single: change only the node with the largest
    violation.
    """
    largest = pressed.max()
    broken = 0
    worst = -1
    worst_size = 0.0
    for i in range(touching.size):
        if touching[i]:
            share = -pressed[i] / largest if largest > 0.0 else 1.0
        else:
            share = -left[i] / reach - 1e-9
        if share > 0.0:
            if share > slack:
                broken += 1
            if not single:
                touching[i] = not touching[i]
            elif share > worst_size:
                worst, worst_size = i, share
    if worst >= 0:
        touching[worst] = not touching[worst]
    return broken


@njit(
    "float64[:,::1](float64[:,::1], float64[::1], float64[::1], int64[::1], int64, float64)",
    cache=True,
    error_model="numpy",
)
def turning_stiffness(frame, gap, pressed, nodes, count, pin_radius):  # type: ignore[no-untyped-def]
    """Return the stiffness by rotation of the forces when the pin moves, (2, 2), N/m per metre.

    A normal rotates by the pin's tangential move over its distance; without this term the lateral
    position of the pin converges slowly.
    """
    turning = np.zeros((2, 2))
    for p in range(count):
        i = nodes[p]
        rate = max(pressed[i], 0.0) / (pin_radius + gap[i])
        for u in range(2):
            for v in range(2):
                turning[u, v] += rate * ((1.0 if u == v else 0.0) - frame[i, u] * frame[i, v])
    return turning


@njit("float64[::1](float64[:,::1], float64[:,::1], float64[::1])", cache=True, error_model="numpy")
def pin_move(stiffness, turning, pull):  # type: ignore[no-untyped-def]
    """Solve for the pin's move, (2,); with less or no rotation term where it is unstable.

    NaN if the stiffness is singular: all normals are then parallel.
    """
    move = np.empty(2)
    trace = stiffness[0, 0] + stiffness[1, 1]
    for share in (1.0, 0.5, 0.0):
        s00 = stiffness[0, 0] - share * turning[0, 0]
        s01 = stiffness[0, 1] - share * turning[0, 1]
        s11 = stiffness[1, 1] - share * turning[1, 1]
        determinant = s00 * s11 - s01 * s01
        plain = stiffness[0, 0] * stiffness[1, 1] - stiffness[0, 1] ** 2
        if determinant > _SAFE * plain and plain > _SINGULAR * trace * trace:
            move[0] = (s11 * pull[0] - s01 * pull[1]) / determinant
            move[1] = (s00 * pull[1] - s01 * pull[0]) / determinant
            return move
    move[:] = np.nan
    return move


@njit(
    "int64(float64[::1], boolean[::1], float64[::1], float64[::1], float64[:,::1], float64)",
    cache=True,
    error_model="numpy",
)
def verdict(force, touching, pressed, gap, frame, reach):  # type: ignore[no-untyped-def]
    """Return CARRIED if all conditions of contact hold, else NOT_SETTLED."""
    x, y = -force[0], -force[1]
    for i in range(touching.size):
        x += pressed[i] * frame[i, 0]
        y += pressed[i] * frame[i, 1]
        if pressed[i] < 0.0 or gap[i] < -_CLOSED * reach:
            return NOT_SETTLED
        if touching[i] and gap[i] > _CLOSED * reach:
            return NOT_SETTLED
    if x * x + y * y > _BALANCED**2 * (force[0] ** 2 + force[1] ** 2):
        return NOT_SETTLED
    return CARRIED


@njit(
    "Tuple((int64, int64))(float64[:,::1], float64[:,::1], float64[:,:,::1], float64[::1],"
    " float64, float64[::1], float64[::1], boolean[::1], float64[::1], float64[::1],"
    " float64[:,::1])",
    cache=True,
    error_model="numpy",
)
def solve(  # type: ignore[no-untyped-def]
    surface, axis, polar, extra, pin_radius, force, pin, touching, pressed, gap, frame
):
    """Solve one contact; updates pin, touching, pressed, gap and frame in place.

    Returns the status and the number of iterations. Each iteration solves gap = 0 on the touching
    nodes and the balance of forces, linearised in the pin's move, then revises the set, until set
    and pin no longer change. ``gap`` is then the gap after elastic displacement.
    """
    n = surface.shape[0]
    nodes = np.empty(n, dtype=np.int64)
    capacity = 0
    place_pin(surface, axis, pin_radius, pin, frame, gap)
    for iteration in range(1, _LIMIT + 1):
        count = list_touching(touching, gap, nodes)
        if count > capacity:
            capacity = count + 16
            a = np.empty((capacity, capacity))
            rows = np.empty((3, capacity))
        turning = turning_stiffness(frame, gap, pressed, nodes, count, pin_radius)
        assemble(polar, frame, nodes, count, a)
        for p in range(count):
            i = nodes[p]
            a[p, p] += extra[i]
            rows[0, p] = frame[i, 0]
            rows[1, p] = frame[i, 1]
            rows[2, p] = gap[i]
        if factorise(a, count) <= 0.0:
            return NOT_SETTLED, iteration
        substitute(a, count, rows, 3)
        stiffness = np.zeros((2, 2))
        pull = force.copy()
        for p in range(count):
            for u in range(2):
                for v in range(2):
                    stiffness[u, v] += frame[nodes[p], u] * rows[v, p]
                pull[u] += frame[nodes[p], u] * rows[2, p]
        move = pin_move(stiffness, turning, pull)
        length = np.sqrt(move[0] ** 2 + move[1] ** 2)
        if not np.isfinite(length):
            return ONE_SIDED, iteration
        pressed[:] = 0.0
        for p in range(count):
            value = rows[0, p] * move[0] + rows[1, p] * move[1] - rows[2, p]
            pressed[nodes[p]] = value
        step = min(1.0, _LONGEST_STEP * pin_radius / length) if length > 0.0 else 1.0
        pin += step * move
        place_pin(surface, axis, pin_radius, pin, frame, gap)
        reach = 0.0
        for p in range(count):
            reach = max(reach, abs(gap[nodes[p]]))
        settled = length <= _CLOSED * reach + _STILL * pin_radius
        displace(polar, frame, pressed, nodes, count, np.inf if settled else reach, gap)
        broken = revise(gap, touching, pressed, reach, 0.0, iteration > _PATIENCE)
        if broken == 0 and settled:
            for i in range(n):
                gap[i] += extra[i] * pressed[i]
            return verdict(force, touching, pressed, gap, frame, reach), iteration
        place_pin(surface, axis, pin_radius, pin, frame, gap)
    return NOT_SETTLED, _LIMIT
