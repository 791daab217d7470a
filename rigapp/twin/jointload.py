"""Load and friction of the joint in a measured revolution. Pure functions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import JOINT_CURVES
from rigapp_model.dynamics import MechanismMotion
from rigapp_model.friction_circle import CellDoubt, Friction, friction_of
from rigapp_model.parameters import Parameters

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class JointLoad:
    """The curves of ``JOINT_CURVES`` (n,) in their units by name, and the friction."""

    curves: dict[str, Array]
    friction: Friction

    @property
    def values(self) -> dict[str, float]:
        """Return the columns of a revolution."""
        friction = self.friction
        return {
            "friction_coefficient": friction.coefficient,
            "friction_coefficient_uncertainty": friction.uncertainty,
        } | {f"{name}_max": float(curve.max()) for name, curve in self.curves.items()}


UNKNOWN = JointLoad({curve.name: np.full(1, np.nan) for curve in JOINT_CURVES}, Friction())


def joint_load(
    parameters: Parameters, force: Array, motion: MechanismMotion, cell: CellDoubt | None
) -> JointLoad:
    """Return the load of the joint in a revolution.

    force (2, n): measured, N, crank frame, at the angles of ``motion``; cell: uncertainty of the
    load cell, None where none is stated: then the friction stays unknown.
    """
    joint, mechanism = parameters.joint, parameters.mechanism
    pressure = 1e-6 * np.hypot(*force) / joint.projected_area
    speed = np.abs(motion.slip_rate(joint.pin_radius))
    names = (curve.name for curve in JOINT_CURVES)
    curves = dict(zip(names, (pressure, speed, pressure * speed), strict=True))
    if cell is None:
        return JointLoad(curves, Friction())
    across = motion.force_follower[1] - motion.friction_moment / mechanism.follower_length
    friction = friction_of(
        force,
        across,
        motion.angle - motion.follower_angle,
        np.sign(motion.speed - motion.follower_speed),
        joint.pin_radius / mechanism.follower_length,
        cell,
    )
    return JointLoad(curves, friction)
