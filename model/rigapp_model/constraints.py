"""The paper's equations: constraints, Newton, accelerations and Lagrange multipliers.

Solves Eqs 4-7 (perfect joint, nine unknowns) and 8-12 (imperfect joint, ten unknowns) for all
crank angles at once. Reference for the closed form of ``rigapp_model.dynamics``; tens of times
slower.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.errors import ModelError, require_positive
from rigapp_model.parameters import Mechanism

Array = NDArray[np.float64]

X1, Y1, PHI1, X2, Y2, PHI2, X3, Y3, PHI3, ALPHA = range(10)
"""Indices of the unknowns in q (paper, Eq. 5; alpha follows for the imperfect joint)."""

STALLED = 1e-12  # near a singular Jacobian, steps stop shrinking at the level of rounding
ENOUGH_ITERATIONS = 8  # by then Newton has converged to rounding
MOST_ITERATIONS = 30  # Newton needs about 5; with 30 it does not converge
TOLERANCE = 1e-14  # of the unknowns: rounding, so that the reference adds no error of its own

System = Callable[[Array, Array], tuple[Array, Array, Array]]
"""From q and qd, (n, unknowns) each: constraint values, Jacobian, (Phi_q qd)_q qd."""


@dataclass(frozen=True, slots=True)
class Solution:
    """Solution of a cycle, one row per angle: q, its derivatives, multipliers and forces.

    ``force`` (2, n) is F on the follower by the pin, ``wrist_force`` (2, n) on the slider by the
    follower, ``guide_force`` (n) on the slider by its guide, ``drive_torque`` (n) on the crank.
    """

    position: Array
    velocity: Array
    acceleration: Array
    multipliers: Array
    force: Array
    wrist_force: Array
    guide_force: Array
    drive_torque: Array
    iterations: int


def solve_perfect(
    mechanism: Mechanism, angle: ArrayLike, speed: ArrayLike, acceleration: ArrayLike = 0.0
) -> Solution:
    """Solve Eqs 4-7 for the perfect joint at crank angles (n,); raise ModelError if Newton fails.

    Rows 5 and 6 constrain the slider relative to the crank and not to the follower, so the pin
    force is the sum of the multipliers of rows 3-4 and of rows 5-6.
    """
    crank, rate, growth = _cycle(angle, speed, acceleration)
    start = np.zeros((len(crank), 9))
    start[:, PHI1] = crank
    _initial_guess(mechanism, start, 0.0)
    solution = _solve(mechanism, _perfect_joint(mechanism, crank), start, rate, growth)
    q, qd, qdd, multipliers, iterations = solution
    wrist = -multipliers[:, 4:6].T
    return Solution(
        position=q,
        velocity=qd,
        acceleration=qdd,
        multipliers=multipliers,
        force=-multipliers[:, 2:4].T + wrist,
        wrist_force=wrist,
        guide_force=-multipliers[:, 6],
        drive_torque=-multipliers[:, 8],
        iterations=iterations,
    )


def solve_imperfect(
    mechanism: Mechanism,
    pin_radius: float,
    bushing_radius: float,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike = 0.0,
) -> Solution:
    """Solve Eq. 12 for the imperfect joint in continuous contact, at crank angles (n,).

    Newton starts on the branch alpha = pi + phi2 - phi1, the only physical one of Eq. 11.
    Exchange the two radii for contact on the wall away from the crank. Raises ModelError if Newton
    fails or converges to the other branch.
    """
    require_positive("pin_radius", pin_radius, "m")
    require_positive("bushing_radius", bushing_radius, "m")
    crank, rate, growth = _cycle(angle, speed, acceleration)
    start = np.zeros((len(crank), 10))
    start[:, PHI1] = crank
    start[:, ALPHA] = np.pi - crank
    _initial_guess(mechanism, start, bushing_radius - pin_radius)
    system = _imperfect_joint(mechanism, pin_radius, bushing_radius, crank)
    q, qd, qdd, multipliers, iterations = _solve(mechanism, system, start, rate, growth)
    if np.any(np.cos(q[:, PHI1] - q[:, PHI2] + q[:, ALPHA]) > 0.0):
        raise ModelError("alpha", say("on the wrong branch"), say("check the lengths and radii"))
    wrist = multipliers[:, 5:7].T
    return Solution(
        position=q,
        velocity=qd,
        acceleration=qdd,
        multipliers=multipliers,
        force=multipliers[:, 2:4].T + wrist,
        wrist_force=wrist,
        guide_force=-multipliers[:, 7],
        drive_torque=-multipliers[:, 9],
        iterations=iterations,
    )


def _cycle(angle: ArrayLike, speed: ArrayLike, growth: ArrayLike) -> tuple[Array, Array, Array]:
    """Return angle, speed and acceleration as float64 arrays (n,)."""
    arrays = [np.atleast_1d(np.asarray(a, dtype=np.float64)) for a in (angle, speed, growth)]
    for name, array in zip(("angle", "speed", "acceleration"), arrays, strict=True):
        if array.ndim != 1 or not np.isfinite(array).all():
            raise ModelError(
                name, say("not a row of finite numbers"), say("give an array of shape (n,)")
            )
    crank, rate, gain = np.broadcast_arrays(*arrays)
    return crank, rate, gain


def _initial_guess(mechanism: Mechanism, start: Array, gap: float) -> None:
    """Set the initial guess in place: the follower parallel to the slider's guide."""
    r, length = mechanism.crank_radius, mechanism.follower_length
    c, s = np.cos(start[:, PHI1]), np.sin(start[:, PHI1])
    start[:, X1], start[:, Y1] = 0.5 * r * c, 0.5 * r * s
    start[:, X2], start[:, Y2] = r * c + 0.5 * length + gap, r * s
    start[:, X3] = r * c + length + gap


def _perfect_joint(mechanism: Mechanism, crank: Array) -> System:
    """Return Eq. 4 with its Jacobian and quadratic velocity terms."""
    l1, l2 = 0.5 * mechanism.crank_radius, 0.5 * mechanism.follower_length

    def system(q: Array, qd: Array) -> tuple[Array, Array, Array]:
        n = len(q)
        c1, s1, c2, s2 = (f(q[:, i]) for i in (PHI1, PHI2) for f in (np.cos, np.sin))
        phi = np.empty((n, 9))
        jacobian = np.zeros((n, 9, 9))
        gamma = np.zeros((n, 9))
        for row, (x, along1, along2) in enumerate(((X1, 1, 0), (X2, 2, 1), (X3, 2, 2))):
            a, b = along1 * l1, along2 * l2
            for axis, (u1, u2) in enumerate(((c1, c2), (s1, s2))):
                i, v1, v2 = 2 * row + axis, (-s1, c1)[axis], (-s2, c2)[axis]
                phi[:, i] = q[:, x + axis] - a * u1 - b * u2
                jacobian[:, i, x + axis] = 1.0
                jacobian[:, i, PHI1] = -a * v1
                jacobian[:, i, PHI2] = -b * v2
                gamma[:, i] = a * u1 * qd[:, PHI1] ** 2 + b * u2 * qd[:, PHI2] ** 2
        for i, column in ((6, Y3), (7, PHI3), (8, PHI1)):
            phi[:, i] = q[:, column]
            jacobian[:, i, column] = 1.0
        phi[:, 8] -= crank
        return phi, jacobian, gamma

    return system


def _imperfect_joint(
    mechanism: Mechanism, pin_radius: float, bushing_radius: float, crank: Array
) -> System:
    """Return Eq. 12 with its Jacobian and quadratic velocity terms."""
    l1, l2 = 0.5 * mechanism.crank_radius, 0.5 * mechanism.follower_length
    r1, r2 = pin_radius, bushing_radius

    def system(q: Array, qd: Array) -> tuple[Array, Array, Array]:
        n = len(q)
        c1, s1, c2, s2 = (f(q[:, i]) for i in (PHI1, PHI2) for f in (np.cos, np.sin))
        contact = q[:, PHI1] + q[:, ALPHA]
        cc, sc = np.cos(contact), np.sin(contact)
        contact_rate = qd[:, PHI1] + qd[:, ALPHA]
        phi = np.empty((n, 10))
        jacobian = np.zeros((n, 10, 10))
        gamma = np.zeros((n, 10))
        for axis, (u1, v1) in enumerate(((c1, -s1), (s1, c1))):
            phi[:, axis] = q[:, X1 + axis] - l1 * u1
            jacobian[:, axis, X1 + axis] = 1.0
            jacobian[:, axis, PHI1] = -l1 * v1
            gamma[:, axis] = l1 * u1 * qd[:, PHI1] ** 2
        terms = ((c1, -s1, cc, -sc, c2, -s2), (s1, c1, sc, cc, s2, c2))
        for first, x, arm in ((2, X2, r2 + l2), (5, X3, r2 + 2.0 * l2)):
            for axis, (u1, v1, uc, vc, u2, v2) in enumerate(terms):
                i = first + axis
                phi[:, i] = -q[:, x + axis] + 2.0 * l1 * u1 + r1 * uc + arm * u2
                jacobian[:, i, x + axis] = -1.0
                jacobian[:, i, PHI1] = 2.0 * l1 * v1 + r1 * vc
                jacobian[:, i, ALPHA] = r1 * vc
                jacobian[:, i, PHI2] = arm * v2
                gamma[:, i] = (
                    -2.0 * l1 * u1 * qd[:, PHI1] ** 2
                    - r1 * uc * contact_rate**2
                    - arm * u2 * qd[:, PHI2] ** 2
                )
        twist = contact - q[:, PHI2]
        phi[:, 4] = r1 * r2 * np.sin(twist)
        slope = r1 * r2 * np.cos(twist)
        jacobian[:, 4, PHI1] = jacobian[:, 4, ALPHA] = slope
        jacobian[:, 4, PHI2] = -slope
        gamma[:, 4] = -phi[:, 4] * (contact_rate - qd[:, PHI2]) ** 2
        for i, column in ((7, Y3), (8, PHI3), (9, PHI1)):
            phi[:, i] = q[:, column]
            jacobian[:, i, column] = 1.0
        phi[:, 9] -= crank
        return phi, jacobian, gamma

    return system


def _solve(
    mechanism: Mechanism, system: System, q: Array, rate: Array, growth: Array
) -> tuple[Array, Array, Array, Array, int]:
    """Return q, qd (Eq. 6), qdd (Eq. 7 with its inverse Jacobian), multipliers, iterations."""
    zero_rates = np.zeros_like(q)
    size = mechanism.crank_radius + mechanism.follower_length
    for iterations in range(1, MOST_ITERATIONS + 1):
        values, jacobian, _ = system(q, zero_rates)
        step = _linear(jacobian, values)
        q = q - step
        if np.abs(step).max() <= TOLERANCE * max(size, 1.0):
            break
        if np.abs(step).max() <= STALLED and iterations > ENOUGH_ITERATIONS:
            break
    else:
        raise ModelError(
            "Newton", say("without convergence"), say("check that the crank can turn freely")
        )
    drive = np.zeros_like(q)
    drive[:, -1] = rate
    _, jacobian, _ = system(q, zero_rates)
    qd = _linear(jacobian, drive)
    _, _, gamma = system(q, qd)
    drive[:, -1] = growth
    qdd = _linear(jacobian, drive - gamma)
    return q, qd, qdd, _multipliers(mechanism, jacobian, q, qdd), iterations


def _multipliers(mechanism: Mechanism, jacobian: Array, q: Array, qdd: Array) -> Array:
    """Return the multipliers of M qdd + Phi_q^T lambda = Q."""
    mass = np.zeros(q.shape[1])
    mass[[X1, Y1]] = mechanism.crank_mass
    mass[[X2, Y2]] = mechanism.follower_mass
    mass[[X3, Y3]] = mechanism.moving_mass
    mass[PHI1], mass[PHI2] = mechanism.crank_inertia, mechanism.follower_inertia
    applied = np.zeros_like(q)
    for x in (X1, X2, X3):
        applied[:, x] = mass[x] * mechanism.gravity[0]
        applied[:, x + 1] = mass[x] * mechanism.gravity[1]
    if mechanism.spring is not None:
        spring = mechanism.spring
        applied[:, X3] -= spring.stiffness * (q[:, X3] - spring.free_position)
    return _linear(np.swapaxes(jacobian, 1, 2), applied - mass * qdd)


def _linear(matrices: Array, rights: Array) -> Array:
    """Solve one small linear system per angle."""
    try:
        solution = np.linalg.solve(matrices, rights[..., None])[..., 0]
    except np.linalg.LinAlgError as problem:
        raise ModelError(
            "Jacobian", "singular", say("the mechanism is at a dead point")
        ) from problem
    return np.asarray(solution, dtype=np.float64)
