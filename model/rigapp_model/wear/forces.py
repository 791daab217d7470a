"""Sources of the forces of a life: a joint by constraints, or a constant force.

Pin and bushing as separate bodies are in ``impact_forces``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

import numpy as np

from rigapp_model.joints import continuous_contact, motion_on_walls
from rigapp_model.parameters import ARCHARD, Joint, Parameters, WearLaw
from rigapp_model.wear.coefficient import switched
from rigapp_model.wear.front import Front
from rigapp_model.wear.loads import (
    WIDE_SWING,
    CycleLoads,
    constant_load,
    gathered,
    loads_of_cycle,
    swing,
)

DENSE = 1440
"""Crank angles that are merged into positions if the force's direction varies widely."""


class ForceSource(Protocol):
    """Source of the loads of a revolution for a worn surface."""

    @property
    def single(self) -> bool:
        """Whether the force is the same at all crank positions."""

    def unworn(self, positions: int) -> CycleLoads:
        """Return the loads of the unworn joint at this number of positions."""

    def samples(self, positions: int) -> Sequence[CycleLoads]:
        """Return the loads of the unworn joint by parts of a sample; empty without sampling."""

    def at(self, front: Front, cycles: float, positions: int) -> CycleLoads:
        """Return the loads on a worn surface after ``cycles``."""

    def clearance(self, front: Front) -> float:
        """Return R2 - R1 in the mechanism, m."""

    def coupling_error(self, cycles: float) -> float:
        """Return a bound of the depth's error due to forces reused while the surface wears, m."""

    def notes(self, front: Front) -> Iterable[str]:
        """Return messages on the assumptions of the technique and whether they hold."""


def constant_source(
    force: float, joint: Joint, speed: float = 0.0, law: WearLaw = ARCHARD
) -> ForceSource:
    """Return the source of one constant force along the follower, N; speed: of the crank, rad/s."""
    return ConstantForce(force, joint, speed, law)


class ConstantForce:
    """Constant force along the follower."""

    def __init__(self, force: float, joint: Joint, speed: float, law: WearLaw) -> None:
        load = constant_load(force, joint.pin_radius)
        self._loads = switched(load, joint.pin_radius * speed, joint, law)
        self._joint = joint

    single = True

    def unworn(self, positions: int) -> CycleLoads:
        """Return the constant load."""
        return self._loads

    def at(self, front: Front, cycles: float, positions: int) -> CycleLoads:
        """Return the constant load."""
        return self._loads

    def samples(self, positions: int) -> Sequence[CycleLoads]:
        """Return nothing."""
        return ()

    def clearance(self, front: Front) -> float:
        """Return the initial clearance: no mechanism is involved."""
        return self._joint.clearance

    def coupling_error(self, cycles: float) -> float:
        """Return 0: the force does not depend on the wear."""
        return 0.0

    def notes(self, front: Front) -> Iterable[str]:
        """Return nothing."""
        return ()


class Constrained:
    """Forces of a joint by constraints: techniques 1 and 2.

    ``clearance``: of the new joint in the kinematics, m; 0: perfect joint. With ``follows_wear`` it
    increases by the wear depth at the contact point (paper, section 4.2).
    """

    single = False

    def __init__(
        self, parameters: Parameters, speed: float, clearance: float, follows_wear: bool
    ) -> None:
        self._parameters = parameters
        self._speed = speed
        self._new = clearance
        self._follows = follows_wear
        self._known: dict[int, CycleLoads] = {}
        self._wide: bool | None = None

    def unworn(self, positions: int) -> CycleLoads:
        """Return the loads at equal crank angles of the unworn joint."""
        if positions not in self._known:
            self._known[positions] = self._sampled(positions, self._new)
        return self._known[positions]

    def at(self, front: Front, cycles: float, positions: int) -> CycleLoads:
        """Return the loads at equal crank angles with the clearance of the worn surface."""
        if not self._follows:
            return self.unworn(positions)
        return self._sampled(positions, self.clearance(front))

    def samples(self, positions: int) -> Sequence[CycleLoads]:
        """Return nothing."""
        return ()

    def clearance(self, front: Front) -> float:
        """Return the clearance, with ``follows_wear`` including the depth at the contact point."""
        joint = self._parameters.joint
        if not self._follows:
            return self._new
        return self._new + front.depth_at_contact_point(joint.bushing_radius)

    def coupling_error(self, cycles: float) -> float:
        """Return 0: forces follow the wear in each step, so this is part of the steps' error."""
        return 0.0

    def notes(self, front: Front) -> Iterable[str]:
        """Return a message if continuous contact does not hold."""
        if self._new == 0.0 and not self._follows:
            return ()
        angle = 2.0 * np.pi * np.arange(360) / 360
        joint = self._parameters.joint
        contact = continuous_contact(
            self._parameters.mechanism, joint, angle, self._speed, 0.0, self.clearance(front)
        )
        return () if contact.assumption_holds else (contact.sentence(),)

    def _loads(self, positions: int, gap: float) -> CycleLoads:
        mechanism, joint = self._parameters.mechanism, self._parameters.joint
        angle = 2.0 * np.pi * np.arange(positions) / positions
        motion, _, _ = motion_on_walls(mechanism, joint, angle, self._speed, 0.0, gap)
        rate = motion.slip_rate(joint.pin_radius)
        weight = np.abs(rate)
        slip = 2.0 * np.pi * joint.pin_radius * weight / weight.sum()
        loads = loads_of_cycle(motion.force_follower, slip, joint.friction_coefficient, rate)
        return switched(loads, rate, joint, self._parameters.bushing.law)

    def _sampled(self, positions: int, gap: float) -> CycleLoads:
        """Return the loads at equal crank angles, or merged if their direction varies widely.

        A force of nearly constant direction needs few crank angles, best at equal steps, unless the
        wear coefficient changes abruptly between them.
        """
        if self._wide is None:
            dense = self._loads(DENSE, gap)
            self._wide = swing(dense) > WIDE_SWING or dense.rate is not None
        if self._wide:
            return gathered(self._loads(DENSE, gap), positions)
        return self._loads(positions, gap)
