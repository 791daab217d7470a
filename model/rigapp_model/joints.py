"""The joint of interest, perfect or imperfect in continuous contact (paper, section 3).

The third technique, pin and bushing as separate bodies, is ``rigapp_model.contact.impact``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import joined, say
from rigapp_model.dynamics import MechanismMotion, inverse_dynamics
from rigapp_model.errors import require_not_negative
from rigapp_model.parameters import Joint, Mechanism

Array = NDArray[np.float64]
Range = tuple[float, float]

HALF_STEP = 0.51  # of the angles' spacing: a cycle that ends this close to its begin is closed


@dataclass(frozen=True, slots=True)
class ContinuousContact:
    """Result of technique 2 for a cycle, and whether its assumption holds.

    ``wall``: +1 where the pin bears on the wall towards the crank (follower in tension), -1 on the
    other. ``compression``: crank angle ranges (rad, start to end, the end may exceed 2 pi) in which
    the follower is not in tension, so that the pin leaves the wall and the paper's second
    assumption fails. ``contact_angle``: position of the contact force on the bushing, in the
    follower frame from the assumed contact point, rad; 0 by the third assumption.
    """

    motion: MechanismMotion
    wall: Array
    clearance: float
    compression: tuple[Range, ...]
    contact_angle: Array

    @property
    def assumption_holds(self) -> bool:
        """Return whether the follower is in tension at all angles."""
        return not self.compression

    def sentence(self) -> str:
        """Return a message for the user if the assumption fails, else an empty text."""
        if self.assumption_holds:
            return ""
        if np.all(self.wall < 0.0):
            return say(
                "The assumption of tension does not hold: the follower is in"
                " compression at all crank angles. The pin bears on the wall away from"
                " the crank all the time; the same equations with minus the clearance"
                " were solved."
            )
        spans = joined(
            say(" and "),
            (
                say("{:.1f} to {:.1f} deg", np.degrees(start), np.degrees(end))
                for start, end in self.compression
            ),
        )
        return say(
            "Continuous contact does not hold: at crank angles {} the follower is in"
            " compression, the pin crosses to the other wall of the bushing and contact"
            " is lost on the way; use the contact joint, or a spring that keeps the"
            " follower in tension.",
            spans,
        )


def perfect_joint(
    mechanism: Mechanism,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike = 0.0,
    joint: Joint | None = None,
) -> MechanismMotion:
    """Compute technique 1: pin and bushing centres coincide (Eq. 4), with the joint's friction."""
    return inverse_dynamics(mechanism, angle, speed, acceleration, 0.0, joint)


def continuous_contact(
    mechanism: Mechanism,
    joint: Joint,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike = 0.0,
    clearance: float | None = None,
) -> ContinuousContact:
    """Compute technique 2: the pin always touches the bushing on the follower's axis (Eq. 12).

    angle: rad, shape (n,), in order; one revolution without its end point is treated as a cycle.
    clearance: R2 - R1 in m, by default that of the joint. Where the force along e2 is compressive
    the pin bears on the other wall: the same equations with -clearance. Raises ModelError.
    """
    gap = joint.clearance if clearance is None else clearance
    motion, wall, along = motion_on_walls(mechanism, joint, angle, speed, acceleration, gap)
    return ContinuousContact(
        motion=motion,
        wall=wall,
        clearance=gap,
        compression=_ranges_above_zero(np.atleast_1d(motion.angle), np.atleast_1d(along)),
        contact_angle=contact_direction(motion, joint.friction_coefficient),
    )


def motion_on_walls(
    mechanism: Mechanism,
    joint: Joint,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike,
    clearance: float,
) -> tuple[MechanismMotion, Array, Array]:
    """Return the motion of technique 2, the wall at each angle, and the force that determines it.

    That is the force along e2 (N) for a follower in tension. See ``continuous_contact``.
    """
    require_not_negative("clearance", clearance, "m")
    motion = inverse_dynamics(mechanism, angle, speed, acceleration, clearance, joint)
    along = motion.force_follower[0]
    wall = np.where(along > 0.0, -1.0, 1.0)
    if np.any(wall < 0.0):
        motion = inverse_dynamics(mechanism, angle, speed, acceleration, clearance * wall, joint)
    return motion, wall, along


def contact_direction(motion: MechanismMotion, friction_coefficient: float = 0.0) -> Array:
    """Return the direction of the contact on the bushing, rad from the point towards the crank.

    Counter-clockwise in the follower frame, -pi .. pi. Friction turns the force from the normal
    by atan(mu) in the direction of sliding.
    """
    along, across = motion.force_follower
    sliding = np.sign(motion.speed - motion.follower_speed)
    turned = np.arctan2(across, along) - sliding * np.arctan(friction_coefficient) - np.pi
    return np.asarray((turned + np.pi) % (2.0 * np.pi) - np.pi)


def _ranges_above_zero(angle: Array, value: Array) -> tuple[Range, ...]:
    """Return the angle ranges in which a cycle's value is above zero, with interpolated ends."""
    above = value > 0.0
    if not above.any():
        return ()
    step = angle[1] - angle[0] if len(angle) > 1 else 0.0
    turn = np.copysign(2.0 * np.pi, step)
    cyclic = len(angle) > 2 and abs(angle[-1] + step - angle[0] - turn) < HALF_STEP * abs(step)
    if above.all():
        return ((float(angle[0]), float(angle[0] + turn if cyclic else angle[-1])),)
    if cyclic:
        first = int(np.flatnonzero(~above)[0])
        order = np.r_[first : len(angle), 0 : first + 1]
        angle = np.r_[angle[first:], angle[: first + 1] + turn]
        value, above = value[order], above[order]
    edges = np.flatnonzero(np.diff(above.astype(np.int8)))
    at = angle[edges] + (angle[edges + 1] - angle[edges]) * (
        value[edges] / (value[edges] - value[edges + 1])
    )
    crossings = [float(a) for a in at]
    if above[0]:
        crossings.insert(0, float(angle[0]))
    if above[-1]:
        crossings.append(float(angle[-1]))
    ranges = zip(crossings[::2], crossings[1::2], strict=True)
    period = 2.0 * np.pi if cyclic else 0.0
    return tuple(
        (s - period, e - period) if period and min(s, e) >= period else (s, e) for s, e in ranges
    )
