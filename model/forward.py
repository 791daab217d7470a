"""Forward dynamics: the crank's speed as a state, driven by a torque against a flywheel.

The drive torque of the closed form is affine in the crank's acceleration (without friction), so
that two evaluations give the reduced inertia and the load; the acceleration follows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from model.dynamics import Motion, inverse_dynamics
from model.errors import ModelError, require_finite, require_not_negative
from model.parameters import Joint, Mechanism

Array = NDArray[np.float64]
Torque = Callable[[float, float, float], float]
"""Drive torque on the crank (N m) from time (s), angle (rad) and speed (rad/s)."""

PASSES = 4


@dataclass(frozen=True, slots=True)
class DrivenMotion:
    """Hold a driven history: times (s), motion and forces at them, and the drive's torque (N m).

    ``motion.drive_torque`` is what the mechanism takes; ``torque`` also turns the flywheel.
    """

    time: Array
    motion: Motion
    torque: Array


def reduced_inertia(
    mechanism: Mechanism, angle: ArrayLike, flywheel_inertia: float = 0.0, clearance: float = 0.0
) -> Array:
    """Return the inertia of everything that moves, reduced to the crank, kg m^2."""
    moved = inverse_dynamics(mechanism, angle, 0.0, 1.0, clearance).drive_torque
    held = inverse_dynamics(mechanism, angle, 0.0, 0.0, clearance).drive_torque
    return np.asarray(moved - held + flywheel_inertia)


def crank_acceleration(
    mechanism: Mechanism,
    angle: ArrayLike,
    speed: ArrayLike,
    torque: ArrayLike,
    flywheel_inertia: float = 0.0,
    clearance: float = 0.0,
    contact: Joint | None = None,
) -> Array:
    """Return the crank's acceleration (rad/s^2) under a drive torque (N m).

    With friction the load depends on the acceleration through |F|: fixed-point passes, each of
    which gains a factor of about the friction radius over the follower length.
    """
    inertia = reduced_inertia(mechanism, angle, flywheel_inertia, clearance)
    drive = np.asarray(torque, dtype=np.float64)
    growth: Array = np.zeros(np.broadcast_shapes(np.shape(angle), np.shape(speed), drive.shape))
    rough = contact is not None and contact.friction_coefficient > 0.0
    for _ in range(PASSES if rough else 1):
        needed = inverse_dynamics(mechanism, angle, speed, growth, clearance, contact).drive_torque
        growth = np.asarray(growth + (drive - needed - flywheel_inertia * growth) / inertia)
    return np.asarray(growth)


def drive_crank(
    mechanism: Mechanism,
    torque: Torque,
    times: ArrayLike,
    angle: float = 0.0,
    speed: float = 0.0,
    flywheel_inertia: float = 0.0,
    clearance: float = 0.0,
    contact: Joint | None = None,
    tolerance: float = 1e-9,
) -> DrivenMotion:
    """Integrate the crank from ``angle`` and ``speed`` at times[0] and sample at ``times``.

    Raises ModelError when the integration fails. At standstill dry friction is not held: a drive
    weaker than the friction is outside this model.
    """
    moments = np.asarray(times, dtype=np.float64)
    require_not_negative("flywheel_inertia", flywheel_inertia, "kg m^2")
    require_finite("angle", angle, "rad")
    require_finite("speed", speed, "rad/s")
    if moments.ndim != 1 or len(moments) < 2 or not np.all(np.diff(moments) > 0.0):
        raise ModelError("times", moments.shape, "give at least two increasing times")

    def rate(time: float, state: Array) -> tuple[float, float]:
        drive = torque(time, state[0], state[1])
        growth = crank_acceleration(
            mechanism, state[0], state[1], drive, flywheel_inertia, clearance, contact
        )
        return state[1], float(growth)

    answer = solve_ivp(
        rate,
        (moments[0], moments[-1]),
        (angle, speed),
        method="DOP853",
        t_eval=moments,
        rtol=tolerance,
        atol=tolerance,
    )
    if not answer.success:
        raise ModelError("tolerance", tolerance, f"the integration stopped: {answer.message}")
    drive = np.array([torque(t, *state) for t, state in zip(moments, answer.y.T, strict=True)])
    turned, pace = answer.y
    growth = crank_acceleration(
        mechanism, turned, pace, drive, flywheel_inertia, clearance, contact
    )
    motion = inverse_dynamics(mechanism, turned, pace, growth, clearance, contact)
    return DrivenMotion(moments, motion, drive)
