"""Forces of a life with pin and bushing as separate bodies (technique 3)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.contact.ensemble import BatchMeans, Mean, revolutions_of
from rigapp_model.contact.impact import ContactCycle, contact_cycle
from rigapp_model.contact.impact_system import clearance_system
from rigapp_model.contact_law import ContactModel, WornSurface
from rigapp_model.parameters import Joint, Parameters
from rigapp_model.wear.coefficient import switched
from rigapp_model.wear.front import Front
from rigapp_model.wear.loads import CycleLoads, gathered
from rigapp_model.wear.plan import SAMPLING_COVERAGE

Array = NDArray[np.float64]

SAMPLES = 720  # per revolution without impacts, where forces are smooth: half a degree
# With impacts revolutions differ and impacts are short: many revolutions, with dense samples.
SAMPLES_WITH_IMPACTS = 3600
FEWEST_REVOLUTIONS, MOST_REVOLUTIONS = 32, 128
# Directions to which revolutions with impacts are reduced.
DIRECTIONS = 1440
# Share of the tolerance for the sampling error of the forces.
SAMPLING_SHARE = 0.3
# Parts of the revolutions that are compared for the sampling error.
PARTS = 8
# Increase of the wear, relative to the clearance, after which the forces are recomputed.
REFRESH = 0.1


class SeparateBodies:
    """Forces of a pin held by contact only, on the worn profile.

    The integration of a revolution takes longer than the wear step, so its forces are reused until
    the wear at the contact point has grown by a tenth of the clearance; ``coupling_error`` bounds
    the effect. If contact is lost, the forces are means over many revolutions, and ``samples`` are
    parts of these for the uncertainty.
    """

    single = False

    def __init__(
        self,
        parameters: Parameters,
        speed: float,
        tolerance: float,
        alive: Callable[[], None] = lambda: None,
    ) -> None:
        self._parameters = parameters
        self._speed = speed
        self._tolerance = tolerance
        self._alive = alive
        self._step = REFRESH * parameters.joint.clearance
        self._stages: dict[int, _Stage] = {}

    def unworn(self, positions: int) -> CycleLoads:
        """Return the loads of the unworn joint, merged from densely sampled revolutions."""
        return gathered(self._unworn().loads, positions).pressing()

    def samples(self, positions: int) -> Sequence[CycleLoads]:
        """Return the unworn joint's loads by parts of its revolutions; empty if all are equal."""
        return [gathered(part, positions).pressing() for part in self._unworn().parts]

    def at(self, front: Front, cycles: float, positions: int) -> CycleLoads:
        """Return the loads on the worn surface at the last refresh."""
        number = int(self._depth(front) / self._step)
        if number not in self._stages:
            self._stages[number] = self._computed(front, cycles)
        stage = self._stages[number]
        if cycles < stage.since:
            stage = self._stages[number] = replace(stage, since=cycles)
        return gathered(stage.loads, positions).pressing()

    def clearance(self, front: Front) -> float:
        """Return the clearance including the wear at the contact point, m."""
        return self._parameters.joint.clearance + self._depth(front)

    def coupling_error(self, cycles: float) -> float:
        """Return a bound of the depth's error due to forces reused between refreshes, m."""
        stages = [self._stages[n] for n in sorted(self._stages)]
        means = [stage.loads.mean_force for stage in stages if stage.since <= cycles]
        if len(means) < 2:
            return 0.0
        changes = [abs(b / a - 1.0) for a, b in pairwise(means)]
        changes.append(changes[-1])
        return float(sum(changes)) * self._step

    def notes(self, front: Front) -> Iterable[str]:
        """Return messages on the time in contact, and on the ripple of friction."""
        stage = min(self._stages.values(), key=lambda stage: stage.contact_fraction)
        if stage.contact_fraction < 1.0 - 1e-12:
            yield (
                say(
                    "Pin and bushing touch only {:.1%} of the time at the least; forces are"
                    " means of {} revolutions, which differ from one another.",
                    stage.contact_fraction,
                    stage.revolutions,
                )
            )
        joint = self._parameters.joint
        yield from filter(None, [ContactModel(joint.contact_law, joint.restitution).sentence()])
        if joint.friction_coefficient > 0.0:
            yield (
                say(
                    "With friction the force ripples with a frequency that depends on how"
                    " Coulomb's law is smoothed; it is no measurement of the real joint."
                )
            )

    def _depth(self, front: Front) -> float:
        return front.depth_at_contact_point(self._parameters.joint.bushing_radius)

    def _unworn(self) -> _Stage:
        if 0 not in self._stages:
            self._stages[0] = self._computed(None, 0.0)
        return self._stages[0]

    def _computed(self, front: Front | None, cycles: float) -> _Stage:
        """Integrate revolutions on a worn surface: one, or enough for the tolerance."""
        p = self._parameters
        system = clearance_system(
            p.mechanism,
            p.joint,
            p.bushing.material,
            p.pin,
            self._speed,
            profile=None if front is None else _profile(front, p.joint.bushing_radius),
        )
        steady = contact_cycle(system, SAMPLES, progress=lambda part: self._alive())
        if steady.contact_is_continuous:
            return _Stage(_loads(steady, p), (), 1.0, 1, cycles)
        revolutions, work, touch = [], BatchMeans(), BatchMeans()
        for cycle in revolutions_of(system, SAMPLES_WITH_IMPACTS, alive=self._alive):
            revolutions.append(_loads(cycle, p))
            work.add(_work(revolutions[-1]))
            touch.add(cycle.contact_fraction)
            if self._is_accurate(len(revolutions), work.result()):
                break
        parts = [_mean_revolution(revolutions[part::PARTS]) for part in range(PARTS)]
        return _Stage(
            _mean_revolution(revolutions),
            tuple(parts),
            float(touch.result().value),
            len(revolutions),
            cycles,
        )

    def _is_accurate(self, revolutions: int, work: Mean) -> bool:
        """Return whether the largest work is known to the tolerance, or the limit is reached."""
        if revolutions < FEWEST_REVOLUTIONS or revolutions % PARTS:
            return False
        most = int(np.argmax(work.value))
        allowed = SAMPLING_SHARE * self._tolerance / SAMPLING_COVERAGE * work.value[most]
        return bool(work.standard_error[most] <= allowed) or revolutions >= MOST_REVOLUTIONS


@dataclass(frozen=True, slots=True)
class _Stage:
    """Loads on one worn surface, by parts of the revolutions, and the cycle of their refresh."""

    loads: CycleLoads
    parts: tuple[CycleLoads, ...]
    contact_fraction: float
    revolutions: int
    since: float


def _profile(front: Front, inner: float) -> WornSurface:
    """Return a front's depth over the angle from the initial contact point."""
    x, y = front.surface[:, 0], front.surface[:, 1]
    angle = np.arctan2(y, x)
    order = np.argsort(angle)
    return WornSurface(angle[order], np.maximum(np.hypot(x, y) - inner, 0.0)[order])


def _loads(cycle: ContactCycle, parameters: Parameters) -> CycleLoads:
    """Return the normal forces of a revolution on the bushing, over the sliding distance.

    Between two samples it is the mean force over the slip, in its mean direction, so that the
    integrals of even the shortest impact are exact.
    """
    joint = parameters.joint
    length = np.hypot(cycle.pressed[0], cycle.pressed[1])
    loaded = (length > 0.0) & (cycle.slip > 0.0)
    size = cycle.work[loaded] / cycle.slip[loaded]
    force = np.zeros((len(cycle.slip), 2))
    force[loaded] = (cycle.pressed[:, loaded] / length[loaded] * size).T
    period = 2.0 * np.pi / np.mean(np.abs(cycle.motion.speed))
    rate = cycle.slip * len(cycle.slip) / period
    loads = CycleLoads(force, cycle.slip, _idle(cycle.slip, joint))
    return switched(loads, rate, joint, parameters.bushing.law)


def _idle(slip: Array, joint: Joint) -> float:
    """Return the circumference less the sliding distance in contact, m.

    So ``mean_force`` is the constant force with the same wear over the circumference.
    """
    return 2.0 * np.pi * joint.pin_radius - float(slip.sum())


def _work(revolution: CycleLoads) -> Array:
    """Return force times slip per 10 degrees of the force's direction, J."""
    work = revolution.magnitude * revolution.wearing
    return np.histogram(revolution.direction, 36, (-np.pi, np.pi), weights=work)[0]


def _mean_revolution(revolutions: Sequence[CycleLoads]) -> CycleLoads:
    """Return the mean of revolutions, merged by direction, as they differ at equal crank angles."""
    force = np.concatenate([r.force for r in revolutions])
    slip = np.concatenate([r.slip for r in revolutions]) / len(revolutions)
    rates = [r.rate for r in revolutions if r.rate is not None]
    idle = float(np.mean([r.idle for r in revolutions]))
    merged = CycleLoads(force, slip, idle, np.concatenate(rates) if rates else None)
    return gathered(merged.pressing().by_direction(), DIRECTIONS)
