"""Forces for a life from pin and bushing as separate bodies (technique 3)."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from model.contact_law import WornProfile
from model.impact import ContactCycle, contact_cycle
from model.impact_system import clearance_system
from model.parameters import Parameters
from model.wear.front import Front
from model.wear.loads import CycleLoads, gathered

Array = NDArray[np.float64]

SAMPLES = 720
# With impacts no revolution is like the next: so many are taken together.
REVOLUTIONS_WITH_IMPACTS = 4
# The forces are computed anew whenever the wear has grown by this part of the clearance.
REFRESH = 0.1


class SeparateBodies:
    """Give the forces of a pin that is held by contact alone, on the worn profile.

    The integration of a revolution takes longer than the wear, so its forces are kept until the
    wear at the contact point has grown by a tenth of the clearance; ``coupling_error`` says what
    that can cost.
    """

    single = False

    def __init__(self, parameters: Parameters, speed: float) -> None:
        self._parameters = parameters
        self._speed = speed
        self._step = REFRESH * parameters.joint.clearance
        self._cycles: dict[int, ContactCycle] = {}
        self._loads: dict[int, CycleLoads] = {}
        self._since: dict[int, float] = {}

    def unworn(self, positions: int) -> CycleLoads:
        """Return the loads of the unworn joint, gathered from a densely sampled revolution."""
        if 0 not in self._loads:
            self._compute(0, None, 0.0)
        return gathered(self._loads[0], positions).pressing()

    def at(self, front: Front, cycles: float, positions: int) -> CycleLoads:
        """Return the loads on the worn surface as it was at the last refresh."""
        stage = int(self._depth(front) / self._step)
        if stage not in self._loads:
            self._compute(stage, front, cycles)
        return gathered(self._loads[stage], positions).pressing()

    def clearance(self, front: Front) -> float:
        """Return the clearance grown by the wear at the contact point, m."""
        return self._parameters.joint.clearance + self._depth(front)

    def coupling_error(self, cycles: float) -> float:
        """Return what keeping the forces between refreshes can change in the depth, m."""
        stages = [s for s in sorted(self._loads) if self._since[s] <= cycles]
        means = [self._loads[s].mean_force for s in stages]
        if len(means) < 2:
            return 0.0
        changes = [abs(b / a - 1.0) for a, b in pairwise(means)]
        changes.append(changes[-1])
        return float(sum(changes)) * self._step

    def notes(self, front: Front) -> Iterable[str]:
        """Say how much of the time pin and bushing touch, and what friction's ripple is worth."""
        least = min(c.contact_fraction for c in self._cycles.values())
        if least < 1.0 - 1e-12:
            yield (
                f"Pin and bushing touch only {least:.1%} of the time at the least; forces are "
                f"means of {REVOLUTIONS_WITH_IMPACTS} revolutions, which differ from one another."
            )
        if self._parameters.joint.friction_coefficient > 0.0:
            yield (
                "With friction the force ripples with a frequency that depends on how Coulomb's "
                "law is smoothed; it is no measurement of the real joint."
            )

    def _depth(self, front: Front) -> float:
        return front.depth_at_contact_point(self._parameters.joint.bushing_radius)

    def _compute(self, stage: int, front: Front | None, cycles: float) -> None:
        """Integrate a revolution on the worn surface and keep its loads."""
        p = self._parameters
        system = clearance_system(
            p.mechanism,
            p.joint,
            p.bushing.material,
            p.pin,
            self._speed,
            profile=None if front is None else _profile(front, p.joint.bushing_radius),
        )
        found = contact_cycle(system, SAMPLES)
        revolutions = 1
        if not found.contact_is_continuous:
            revolutions = REVOLUTIONS_WITH_IMPACTS
            found = contact_cycle(
                system, SAMPLES, revolutions, settling_revolutions=0, start=found.final_state
            )
        self._cycles[stage] = found
        self._loads[stage] = _loads(found, p.joint.pin_radius, revolutions)
        self._since[stage] = min(cycles, self._since.get(stage, cycles))


def _profile(front: Front, inner: float) -> WornProfile:
    """Return a front's depth over the angle from the initial contact point."""
    x, y = front.surface[:, 0], front.surface[:, 1]
    angle = np.arctan2(y, x)
    order = np.argsort(angle)
    return WornProfile(angle[order], np.maximum(np.hypot(x, y) - inner, 0.0)[order])


def _loads(cycle: ContactCycle, pin_radius: float, revolutions: int) -> CycleLoads:
    """Return the normal forces of the revolutions, sorted by crank angle, as one revolution."""
    size = np.where(cycle.touching, cycle.normal_force, 0.0)
    force = np.stack([np.cos(cycle.contact_angle), np.sin(cycle.contact_angle)]) * size
    rate = np.abs(cycle.motion.slip_rate(pin_radius))
    period = 2.0 * np.pi / np.mean(np.abs(cycle.motion.speed))
    slip = rate * period / len(rate)
    order = np.arange(len(size)).reshape(revolutions, -1).T.ravel()
    return CycleLoads(force.T[order], slip[order])
