"""Compiled time integration of the slider-crank with a clearance joint and resolved impacts.

Adaptive steps by Dormand and Prince's method of order 8 with error estimates of orders 5 and 3
(Hairer, Norsett and Wanner, *Solving ordinary differential equations I*, section II.10;
coefficients from scipy). A step in which contact begins or ends is repeated up to that time, which
is found on the interpolant of order 7. The samples are from the same interpolant.
"""

from __future__ import annotations

import math

import numpy as np
from numba import boolean, float64, int64, types, void
from numpy.typing import NDArray
from scipy.integrate import DOP853

from rigapp_model.compiled import njit
from rigapp_model.contact.impact_laws import INLINED, KERNEL, TABLE, VECTOR
from rigapp_model.contact.impact_motion import (
    COORDINATES,
    DERIVATIVE,
    FORCE,
    REFERENCE,
    ROW,
    SLID,
    STATE,
    THETA,
    THETA_RATE,
    X_RATE,
    X,
    depth_and_rate,
    derivative,
    joint_contact,
    rates,
    reference,
)

Array = NDArray[np.float64]

DONE, UNFINISHED, STEP_TOO_SMALL = range(3)

FORCE_X, FORCE_Y, MOMENT, DEPTH, RATE, NORMAL_X, NORMAL_Y, NORMAL, SLIDING = range(8, 17)
X_GROWTH, THETA_GROWTH, TOUCHING = range(17, 20)
SAMPLE = 20
"""Columns of a sample: state, contact, accelerations, flag of contact."""

IMPACT_TIME, IMPACT_SPEED, IMPACT_PEAK = range(3)
IMPACT = 3
"""Columns of an impact: time, normal speed, greatest force of its contact."""

TIME, NEXT_STEP, IN_TOUCH, IMPACT_SPEED_NOW, NEXT_SAMPLE, PRESENT = range(6)
INTEGRATOR = 6
"""Indices of the integrator's state: time, next step, flag of contact, its impact speed, next
sample, row of the present contact in the impacts or -1."""

TOUCH_TIME, STEPS, REJECTED, IMPACTS, GREATEST = range(5)
TALLY = 5

SHORTEST, LONGEST_FLIGHT, LONGEST_CONTACT, FIRST_CONTACT, FLOOR, TALLY_FROM = range(4, 10)
CONTROL = 10
"""Indices of the control: tolerances of the states, step limits, impact speed, begin of tally."""

STAGES, ALL_STAGES = 12, 16
WITHIN = 11  # later stages up to STAGES are at the end of the step, and differ by its error
SAFETY, SHRINK, GROW, ORDER = 0.9, 0.2, 6.0, 0.125
"""Step size control: Hairer, Norsett, Wanner (1993), II.4, for a method of order 8."""
HOPELESS, HOPELESS_SHRINK = 1e30, 0.1
"""A step with a larger error, or NaN, is shortened by this factor instead."""
FLAWLESS = 1e-12
"""Least error used for the next step, as a fraction of the tolerance: avoids division by 0."""
ABOVE_STAGES = 0.25
"""Upper bound of a maximum between the stages of a step above them, as a fraction of their range.

The widest gap between stages is a fifth of a step, in which the phase of the contact's oscillation
changes by less than a radian: a cosine at half a radian is 0.12 below its maximum, and that of a
slower oscillation 0.04 of the range of a step.
"""
PEAK_ROUNDS, PEAK_PARTS = 3, 8
"""Refinements, and intervals of each, for a greatest force: 1/256 of a step, 1e-5 of a maximum."""
SAME_TIME = 1e-13
"""Resolution of a crossing, as a fraction of the step."""
ROWS = float64[:, ::1]
WORKSPACE = types.Tuple((ROWS, ROWS, ROWS, ROW, ROW))
A = np.zeros((ALL_STAGES, ALL_STAGES))
A[:STAGES, :STAGES] = DOP853.A
A[STAGES, :STAGES] = DOP853.B
A[STAGES + 1 :] = DOP853.A_EXTRA
C = np.concatenate([DOP853.C, [1.0], DOP853.C_EXTRA])
E3, E5, D = DOP853.E3.copy(), DOP853.E5.copy(), DOP853.D.copy()

BEGIN, END, STAGE = range(3)
"""Rows of a step's states: its begin, its end, and a stage between."""


def make_workspace() -> tuple[Array, Array, Array, Array, Array]:
    """Return the work arrays of a step: stages, states, interpolant, a state, a derivative.

    A row of the stages is a derivative, followed by the reference at its time.
    """
    stages, rate = np.empty((ALL_STAGES, 2 * DERIVATIVE)), np.empty(DERIVATIVE)
    return stages, np.empty((3, STATE)), np.empty((7, STATE)), np.empty(STATE), rate


@njit(REFERENCE(ROWS, int64), **INLINED)
def stage_reference(k, i):  # type: ignore[no-untyped-def]
    """Return the reference motion at the time of a stage."""
    return k[i, 9], k[i, 10], k[i, 11], k[i, 12], k[i, 13], k[i, 14], k[i, 15], k[i, 16], k[i, 17]


@njit(
    void(VECTOR, TABLE, int64[::1], float64, float64, ROWS, ROWS, float64, boolean, int64, int64),
    **KERNEL,
)
def evaluate(p, table, options, time, h, k, states, impact_speed, touching, first, last):  # type: ignore[no-untyped-def]
    """Compute the stages k[first] .. k[last - 1] of a step from the previous ones.

    The reference is computed for all stages first: it does not depend on the previous stage, so
    the processor overlaps them. Arguments are tuples, as rows of k would cost reference counts.
    """
    b0, b1, b2, b3 = states[BEGIN, 0], states[BEGIN, 1], states[BEGIN, 2], states[BEGIN, 3]
    y = b0, b1, b2, b3
    for i in range(first, last):
        prescribed = reference(p, time + C[i] * h)
        k[i, 9], k[i, 10], k[i, 11], k[i, 12], k[i, 13], k[i, 14], k[i, 15], k[i, 16], k[i, 17] = (
            prescribed
        )
    for i in range(first, last):
        s0 = s1 = s2 = s3 = 0.0
        for j in range(i):
            a = A[i, j]
            s0 += a * k[j, 0]
            s1 += a * k[j, 1]
            s2 += a * k[j, 2]
            s3 += a * k[j, 3]
        y = b0 + h * s0, b1 + h * s1, b2 + h * s2, b3 + h * s3
        ref = stage_reference(k, i)
        rate = rates(p, table, options, ref, y, impact_speed, touching)
        k[i, 0], k[i, 1], k[i, 2], k[i, 3], k[i, 4], k[i, 5], k[i, 6], k[i, 7], k[i, 8] = rate
    states[STAGE, 0], states[STAGE, 1], states[STAGE, 2], states[STAGE, 3] = y


@njit(
    float64(VECTOR, TABLE, int64[::1], float64, float64, ROWS, ROWS, VECTOR, float64, boolean),
    **KERNEL,
)
def try_step(p, table, options, time, h, k, states, scale, impact_speed, touching):  # type: ignore[no-untyped-def]
    """Compute a step from states[BEGIN] to states[END]; return its error over the tolerance.

    The contact integrals use the same quadrature, and have no part in the step control.
    """
    evaluate(p, table, options, time, h, k, states, impact_speed, touching, 1, STAGES + 1)
    for n in range(SLID, STATE):
        total = 0.0
        if touching:
            for i in range(STAGES):
                total += A[STAGES, i] * k[i, n]
        states[END, n] = states[BEGIN, n] + h * total
    fifth = third = 0.0
    for n in range(COORDINATES):
        states[END, n] = states[STAGE, n]
        e5 = e3 = 0.0
        for i in range(STAGES + 1):
            e5 += E5[i] * k[i, n]
            e3 += E3[i] * k[i, n]
        fifth += (e5 / scale[n]) ** 2
        third += (e3 / scale[n]) ** 2
    combined = fifth + 0.01 * third
    if combined == 0.0:
        return 0.0
    return abs(h) * fifth / math.sqrt(4.0 * combined)


@njit(
    void(VECTOR, TABLE, int64[::1], float64, float64, ROWS, ROWS, float64, boolean, ROWS), **KERNEL
)
def prepare_dense(p, table, options, time, h, k, states, impact_speed, touching, dense):  # type: ignore[no-untyped-def]
    """Compute the coefficients ``dense`` (7, 8) of the step's interpolant."""
    evaluate(p, table, options, time, h, k, states, impact_speed, touching, STAGES + 1, ALL_STAGES)
    for n in range(STATE):
        jump = states[END, n] - states[BEGIN, n]
        dense[0, n] = jump
        dense[1, n] = h * k[0, n] - jump
        dense[2, n] = 2.0 * jump - h * (k[STAGES, n] + k[0, n])
        for row in range(4):
            total = 0.0
            for i in range(ALL_STAGES):
                total += D[row, i] * k[i, n]
            dense[3 + row, n] = h * total


@njit(void(ROWS, ROWS, float64, ROW), **KERNEL)
def interpolate(states, dense, part, out):  # type: ignore[no-untyped-def]
    """Compute the state ``out`` at ``part`` (0 .. 1) of a step."""
    for n in range(STATE):
        value = 0.0
        for row in range(6, -1, -1):
            value = (value + dense[row, n]) * (part if row % 2 == 0 else 1.0 - part)
        out[n] = states[BEGIN, n] + value


@njit(boolean(float64, float64, float64, float64, float64), **KERNEL)
def may_cross(d0, r0, d1, r1, h):  # type: ignore[no-untyped-def]
    """Return whether a curve that begins below 0 exceeds 0 within a step or at its end.

    d0, r0 and d1, r1: values and rates at both ends of the cubic.
    """
    if d1 > 0.0:
        return True
    if r0 <= 0.0 or r1 >= 0.0:
        return False
    for quarter in range(1, 4):
        t = 0.25 * quarter
        remaining = 1.0 - t
        value = (
            (1.0 + 2.0 * t) * remaining * remaining * d0
            + t * remaining * remaining * h * r0
            + t * t * (3.0 - 2.0 * t) * d1
            - t * t * remaining * h * r1
        )
        if value > 0.0:
            return True
    return False


@njit(float64(VECTOR, TABLE, int64[::1], float64, float64, ROWS, ROWS, ROW, float64), **KERNEL)
def first_crossing(p, table, options, time, h, states, dense, point, sign):  # type: ignore[no-untyped-def]
    """Return the fraction of a step at which sign * penetration first exceeds 0, else 2."""
    low = 0.0
    for eighth in range(1, 9):
        high = 0.125 * eighth
        interpolate(states, dense, high, point)
        if sign * depth_and_rate(p, table, options, reference(p, time + high * h), point)[0] > 0.0:
            for _ in range(60):
                middle = 0.5 * (low + high)
                interpolate(states, dense, middle, point)
                ref = reference(p, time + middle * h)
                deep = depth_and_rate(p, table, options, ref, point)[0]
                if sign * deep > 0.0:
                    high = middle
                else:
                    low = middle
                if high - low < SAME_TIME:
                    break
            return high
        low = high
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
        ROWS,
        ROW,
        ROW,
        float64,
        boolean,
        float64,
    ),
    **KERNEL,
)
def greatest_force(  # type: ignore[no-untyped-def]
    p, table, options, time, h, k, states, dense, point, slope, impact_speed, ready, known
):
    """Return the greatest magnitude of the joint's force within a step in contact, N.

    If the stages indicate a maximum between the ends, it is searched on the interpolant, which
    ``dense`` already contains if ``ready``. slope: overwritten. known: the greatest force so far;
    the search is omitted if the stages exclude a greater one.
    """
    most = max(k[0, FORCE], k[STAGES, FORCE])
    between, least = 0.0, min(k[0, FORCE], k[STAGES, FORCE])
    for i in range(1, WITHIN):
        between, least = max(between, k[i, FORCE]), min(least, k[i, FORCE])
    if between <= most or between + ABOVE_STAGES * (between - least) < known:
        return most
    if not ready:
        prepare_dense(p, table, options, time, h, k, states, impact_speed, True, dense)
    middle, width = 0.5, 0.5
    for _ in range(PEAK_ROUNDS):
        begin = max(0.0, middle - width)
        spacing = (min(1.0, middle + width) - begin) / PEAK_PARTS
        for i in range(PEAK_PARTS + 1):
            part = begin + i * spacing
            interpolate(states, dense, part, point)
            derivative(p, table, options, time + part * h, point, impact_speed, True, slope)
            if slope[FORCE] > most:
                most, middle = slope[FORCE], part
        width = spacing
    return most


@njit(void(VECTOR, TABLE, int64[::1], float64, ROW, float64, boolean, ROW, ROW), **KERNEL)
def write_sample(p, table, options, time, y, impact_speed, touching, rates_out, out):  # type: ignore[no-untyped-def]
    """Write a sample: the absolute state, its contact and its accelerations.

    moving: work array of a derivative.
    """
    contact = joint_contact(p, table, options, time, y, impact_speed, touching)
    derivative(p, table, options, time, y, impact_speed, touching, rates_out)
    _, _, c, s, rate, growth, position, velocity, acceleration = reference(p, time)
    out[X], out[THETA] = position + y[X], math.atan2(s, c) + y[THETA]
    out[X_RATE], out[THETA_RATE] = velocity + y[X_RATE], rate + y[THETA_RATE]
    for n in range(SLID, STATE):
        out[n] = y[n]
    for n in range(9):
        out[FORCE_X + n] = contact[n]
    out[X_GROWTH], out[THETA_GROWTH] = (
        acceleration + rates_out[X_RATE],
        growth + rates_out[THETA_RATE],
    )
    out[TOUCHING] = 1.0 if touching else 0.0


@njit(void(VECTOR, float64, float64, ROW), **KERNEL)
def add_reference(p, time, sign, y):  # type: ignore[no-untyped-def]
    """Add ``sign`` times the reference motion to a state."""
    _, _, c, s, rate, _, position, velocity, _ = reference(p, time)
    y[X] += sign * position
    y[THETA] += sign * math.atan2(s, c)
    y[X_RATE] += sign * velocity
    y[THETA_RATE] += sign * rate


@njit(
    int64(VECTOR, TABLE, int64[::1], ROW, ROW, VECTOR, VECTOR, int64, ROWS, ROWS, ROW, WORKSPACE),
    **KERNEL,
)
def integrate(  # type: ignore[no-untyped-def]
    p, table, options, y, integrator, control, times, most_steps, samples, impacts, tally, workspace
):
    """Integrate to the last of ``times``, write samples, impacts and tallies; return a status.

    options: location, shape. y (relative to the reference, see ``add_reference``), integrator and
    tally are updated in place: after ``most_steps`` the status is UNFINISHED, and another call with
    the same arrays continues. workspace: see ``make_workspace``.
    """
    scale, floor, tally_from = control[:4], control[FLOOR], control[TALLY_FROM]
    time, h = integrator[TIME], integrator[NEXT_STEP]
    touching, impact_speed = integrator[IN_TOUCH] > 0.5, max(integrator[IMPACT_SPEED_NOW], floor)
    next_sample = int(integrator[NEXT_SAMPLE])
    end = times[-1]
    k, states, dense, point, slope = workspace
    present = int(integrator[PRESENT])
    for n in range(STATE):
        states[BEGIN, n] = y[n]
    derivative(p, table, options, time, y, impact_speed, touching, k[0])
    deep, rate = depth_and_rate(p, table, options, reference(p, time), y)
    while next_sample < times.size and times[next_sample] <= time:
        write_sample(
            p, table, options, time, y, impact_speed, touching, slope, samples[next_sample]
        )
        next_sample += 1
    status = UNFINISHED
    for _ in range(most_steps):
        if time >= end:
            status = DONE
            break
        h = min(h, control[LONGEST_CONTACT] if touching else control[LONGEST_FLIGHT], end - time)
        error = try_step(p, table, options, time, h, k, states, scale, impact_speed, touching)
        if not error <= 1.0:
            tally[REJECTED] += 1
            h *= max(SHRINK, SAFETY * error**-ORDER) if error < HOPELESS else HOPELESS_SHRINK
            if h < control[SHORTEST]:
                status = STEP_TOO_SMALL
                break
            continue
        arrival = end if h >= end - time else time + h
        sign = -1.0 if touching else 1.0
        end_depth, end_rate = depth_and_rate(
            p, table, options, stage_reference(k, STAGES), states[END]
        )
        crossed = False
        ready = False
        if may_cross(sign * deep, sign * rate, sign * end_depth, sign * end_rate, h):
            prepare_dense(p, table, options, time, h, k, states, impact_speed, touching, dense)
            part = first_crossing(p, table, options, time, h, states, dense, point, sign)
            crossed = part <= 1.0
            ready = not crossed or part == 1.0
            if not ready:
                h *= part
                arrival = time + h
                try_step(p, table, options, time, h, k, states, scale, impact_speed, touching)
                end_depth, end_rate = depth_and_rate(
                    p, table, options, stage_reference(k, STAGES), states[END]
                )
        while next_sample < times.size and times[next_sample] <= arrival:
            if not ready:
                prepare_dense(p, table, options, time, h, k, states, impact_speed, touching, dense)
                ready = True
            share = (times[next_sample] - time) / h
            interpolate(states, dense, share, point)
            write_sample(
                p,
                table,
                options,
                times[next_sample],
                point,
                impact_speed,
                touching,
                slope,
                samples[next_sample],
            )
            next_sample += 1
        tally[STEPS] += 1
        if touching:
            tally[TOUCH_TIME] += max(0.0, arrival - max(time, tally_from))
            if time >= tally_from:
                most = greatest_force(
                    p,
                    table,
                    options,
                    time,
                    h,
                    k,
                    states,
                    dense,
                    point,
                    slope,
                    impact_speed,
                    ready,
                    impacts[present, IMPACT_PEAK] if present >= 0 else tally[GREATEST],
                )
                tally[GREATEST] = max(tally[GREATEST], most)
                if present >= 0:
                    impacts[present, IMPACT_PEAK] = max(impacts[present, IMPACT_PEAK], most)
        time = arrival
        for n in range(STATE):
            states[BEGIN, n] = states[END, n]
        deep, rate = end_depth, end_rate
        h *= min(GROW, SAFETY * max(error, FLAWLESS) ** -ORDER)
        if crossed:
            touching = not touching
            present = -1
            if touching:
                h = min(h, control[FIRST_CONTACT])
                impact_speed = max(rate, floor)
                if time >= tally_from:
                    stored = int(tally[IMPACTS])
                    if stored < impacts.shape[0]:
                        impacts[stored, IMPACT_TIME] = time
                        impacts[stored, IMPACT_SPEED] = rate
                        impacts[stored, IMPACT_PEAK] = 0.0
                        present = stored
                    tally[IMPACTS] += 1
            derivative(p, table, options, time, states[BEGIN], impact_speed, touching, k[0])
        else:
            for n in range(DERIVATIVE):
                k[0, n] = k[STAGES, n]
    for n in range(STATE):
        y[n] = states[BEGIN, n]
    integrator[TIME], integrator[NEXT_STEP], integrator[NEXT_SAMPLE] = time, h, next_sample
    integrator[IN_TOUCH], integrator[IMPACT_SPEED_NOW] = 1.0 if touching else 0.0, impact_speed
    integrator[PRESENT] = present
    return status
