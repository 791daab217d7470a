"""Wear coefficient during the test: readings in bins, a life computed ahead, their posterior.

All of it is a function of the revolutions so far, in their order, and of nothing else: a twin that
continues from a checkpoint gives the same numbers to the last bit.
"""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass, field, replace
from typing import Any

import msgspec
import numpy as np

from rigapp.schema.columns import WEAR_MODELS
from rigapp.schema.details import error_text
from rigapp.texts import say, sentence_of_error
from rigapp.twin.approach import MeanApproach
from rigapp.twin.link import IdentificationTarget
from rigapp.twin.measureddepth import MeasuredDepth
from rigapp.twin.predict import NOTHING
from rigapp.twin.tolerances import CLEARANCE
from rigapp_model.errors import ModelError
from rigapp_model.identification import (
    Bins,
    Consistency,
    Credible,
    DepthLife,
    NotIdentifiable,
    Prior,
    ProbeErrors,
    bins_of,
    consistency_of,
    depth_life,
    identify,
    probe_errors,
    remaining,
    weight,
)
from rigapp_model.identification.inference import Identification
from rigapp_model.identification.words import revolution_of
from rigapp_model.parameters import Parameters
from rigapp_model.wear.front import Front, touched
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.state import WearState, unworn_state

LIFE_ERROR = 0.01
"""Relative error of the computed life in depth: the difference of two independent methods for
elasticity and wear at an equal coefficient, the model's and the simulated rig's."""
LEAST_REFERENCE, NO_REFERENCE = 1e-8, 1.0
"""The zero of the depth is never better known than the first, m: the resolution of the probes. The
second is for an unknown one."""
MODULUS_DOUBT = 0.2
"""Relative standard uncertainty of the bushing's modulus: data sheets of polymers differ by it."""
MODULUS_SHARE = 0.65
"""Change of a reading at equal progress by a relative error of the modulus, as a part of that error
times the change of the approach: 0.5 to 0.8, less the larger the load, by lives of moduli a fifth
apart. Most of it is the wrongly removed approach, early on the computed life."""
CLEARANCE_SHARE = 0.4
"""Relative decrease of the coefficient at equal depth by a relative increase of the clearance: for
a rigid crescent 0.48 to 0.43 at 13 to 43 um, and 0.30 to 0.35 where the approach is removed from
the reading by the stated clearance."""
WIDTH = 1e-4
"""Standard tolerance of the bushing's width, m: turned polymers are within 0.2 mm."""
STEP_SHARE, FIRST_CYCLES = 0.05, 2.0
"""Step of the life as a part of its cycles, and the first step in cycles: halving changes no depth
by 1e-3. One step a revolution, so that none waits for it."""
AHEAD = 1.4
"""The life reaches further than depth, criterion and planned end by this factor."""
FIRST_REACH = 40e-6
"""Least depth of the computed life, m: within the limits of an early posterior."""
MM3_PER_NM = 1e9
REMAINING = tuple(f"remaining_revolutions{end}" for end in ("", "_low", "_high"))
NEVER = (math.nan, math.nan, math.nan)

log = logging.getLogger(__name__)


class IdentifiedRecord(msgspec.Struct, frozen=True):
    """The state of an ``Identifier``, with its fields; known: the columns that are held.

    A field that an older record may lack has a default; without ``ends``, the remaining life is
    unknown until the next bin closes.
    """

    sought: IdentificationTarget
    bins: dict[str, Any]
    consistency: dict[str, Any]
    progress: float
    revolution: float
    reference: float
    deepest: float
    steps: int
    ratio: float
    ends: tuple[float, float, float] = NEVER
    known: dict[str, float] = {}


@dataclass(slots=True)
class LifeAhead:
    """Wear a new bushing under one load, one step at a time, as far as requested."""

    parameters: Parameters
    loads: CycleLoads
    progress: list[float] = field(default_factory=lambda: [0.0])
    depth: list[float] = field(default_factory=lambda: [0.0])
    approach: list[float] = field(default_factory=list)
    failed: str = ""
    _state: WearState | None = None
    _life: DepthLife | None = None

    @property
    def steps(self) -> int:
        """Return the number of steps made."""
        return len(self.depth) - 1

    def step(self) -> None:
        """Make one more step, unless the model has no solution."""
        if self.failed:
            return
        try:
            if self._state is None:
                largest = float(self.loads.magnitude.max())
                self._state = unworn_state(_without_running_in(self.parameters), largest)
                problem, front = self._state.problem, self._state.front
                self.approach.append(self._mean_approach(touched(problem, front, self.loads)))
            state = self._state
            self._state = state.advance_by(self.loads, max(FIRST_CYCLES, STEP_SHARE * state.cycles))
            reached = self._state.depth_at_contact
            if reached <= self.depth[-1]:
                raise ModelError("loads", self.loads.mean_force, say("they wear no depth"), "N")
        except (ModelError, ValueError, ArithmeticError) as error:
            self.failed = error_text(error, say("the wear cannot be computed"))
            log.warning(
                say(
                    "The life is not computed beyond {:g} um: {}", 1e6 * self.depth[-1], self.failed
                )
            )
            return
        self.progress.append(self._state.cycles)
        self.depth.append(reached)
        self.approach.append(self._mean_approach(self._state.front))

    def _mean_approach(self, front: Front) -> float:
        """Return the elastic approach, m, its mean over the positions by the work done there."""
        assert self._state is not None
        assert front.pins is not None
        ring = self._state.problem.ring
        each = [ring.indentation(front.surface, pin) for pin in front.pins]
        return float(np.average(each, weights=self.loads.slip * self.loads.magnitude))

    def life(self) -> DepthLife | None:
        """Return the life so far; None while it is too short."""
        if self.steps < 3:
            return None
        if self._life is None or self._life.computed_depth < self.depth[-1]:
            approach = MeanApproach(np.array(self.depth), np.array(self.approach))
            gain = np.array([approach.gain(depth) for depth in self.depth])
            change = gain * (approach.means[0] - approach.means)
            self._life = depth_life(
                self.parameters.bushing.wear_coefficient,
                self.progress,
                self.depth,
                LIFE_ERROR,
                MODULUS_DOUBT * MODULUS_SHARE * change,
            )
        return self._life


def _without_running_in(parameters: Parameters) -> Parameters:
    """Return parameters whose wear depends on progress only: running-in is a statement here."""
    law = replace(parameters.bushing.law, excess=0.0)
    return replace(parameters, bushing=replace(parameters.bushing, law=law))


@dataclass(slots=True)
class Identifier:
    """Collect readings of the depth, and compute the posterior when a bin closes.

    progress: measured, nominal cycles by revolution ``revolution``; reference: standard
    uncertainty of the depth's zero, m; deepest: measured, m; ratio: K to the model's; ends: the
    revolution at which the criterion's depth is reached, with its limits; known: the columns, kept
    from bin to bin, but the remaining life counts down; refused: why the last bin gave no result.
    """

    parameters: Parameters
    sought: IdentificationTarget
    bins: Bins = field(default_factory=Bins)
    consistency: Consistency = field(default_factory=Consistency)
    ahead: LifeAhead | None = None
    progress: float = 0.0
    revolution: float = 0.0
    reference: float = NO_REFERENCE
    deepest: float = 0.0
    ratio: float = 1.0
    ends: tuple[float, float, float] = NEVER
    known: dict[str, float] = field(default_factory=lambda: dict(NOTHING))
    refused: str = ""
    _closed: list[Any] = field(default_factory=list)

    def take(
        self,
        revolution: int,
        loads: CycleLoads,
        reference: CycleLoads | None,
        depth: MeasuredDepth,
        warm: float = math.nan,
    ) -> None:
        """Process a revolution: its loads, the reference loads of progress, its measured depth.

        reference: None while there is none; revolutions count as one cycle each until then. warm:
        temperature, degC, NaN where it is not known.
        """
        since, self.revolution = revolution - self.revolution, float(revolution)
        if reference is None:
            self.progress += since
            return
        if self.ahead is None:
            self.ahead = LifeAhead(self.parameters, reference)
        self.progress += since * weight(loads, reference)
        if not math.isfinite(depth.depth) or not math.isfinite(depth.uncertainty):
            return
        self.deepest = max(self.deepest, depth.depth)
        if self._wanted(self.ahead):
            self.ahead.step()
        # The least so far: the larger uncertainty of a later depth is that of the elastic approach.
        self.reference = max(min(self.reference, 0.5 * depth.uncertainty), LEAST_REFERENCE)
        life = self.ahead.life()
        if life is not None:
            self._judge(life, depth.depth, warm)
        if self.bins.add(self.revolution, self.progress, depth.depth, warm) is not None:
            self._closed = self.bins.numbers()["closed"]
            self._renew(life)
        for name, end in zip(REMAINING, self.ends, strict=True):
            self.known[name] = math.nan if math.isnan(end) else max(end - self.revolution, 0.0)

    def _wanted(self, ahead: LifeAhead) -> bool:
        """Return whether the life must be computed further."""
        deep = AHEAD * max(self.deepest, self.sought.depth or 0.0, FIRST_REACH)
        far = AHEAD * self.ratio * self.sought.planned
        return ahead.depth[-1] < deep or ahead.progress[-1] < far

    def _judge(self, life: DepthLife, depth: float, warm: float) -> None:
        """Compare a reading with its expected value."""
        watch = self.consistency
        watch.add(self.revolution, self.progress, depth, life, warm)
        if watch.mean is None:
            return
        faster, slower = watch.sums
        self.known["wear_consistency"] = faster if faster >= slower else -slower
        departure = watch.departure
        self.known["wear_departure_revolution"] = math.nan if departure is None else departure.since

    def _renew(self, life: DepthLife | None) -> None:
        """Compute the posterior again after a bin is closed."""
        if life is None:
            return
        try:
            identified = identify(self.bins, life, self.errors(), self.prior())
        except (NotIdentifiable, ModelError) as refused:
            self.refused = sentence_of_error(refused)
            return
        self.refused = ""
        self.ratio = identified.coefficient.median / self.parameters.bushing.wear_coefficient
        self.consistency.renew(identified)
        self.known |= self._columns(identified, life)

    def _columns(self, identified: Identification, life: DepthLife) -> dict[str, float]:
        best = identified.best
        change = best.transition.median if best.transition is not None else math.nan
        changed = best.name == WEAR_MODELS[2]
        columns = {
            **_limited("wear_coefficient", identified.coefficient, MM3_PER_NM),
            "wear_model": float(WEAR_MODELS.index(best.name)),
            "wear_model_weight": best.weight,
            "wear_change_revolution": revolution_of(identified, change) if changed else math.nan,
        }
        self.ends = NEVER
        if self.sought.depth is not None:
            left = remaining(identified, life, self.sought.depth).revolutions
            if left is not None:
                now = identified.revolution
                self.ends = (now + left.median, now + left.low, now + left.high)
        return columns

    def errors(self) -> ProbeErrors:
        """Return the probes' errors by their record; raise NotIdentifiable without one."""
        drift = self.sought.drift_um
        per_root = None if drift is None else 1e-6 * drift / math.sqrt(math.log(10.0))
        joint = self.parameters.joint
        clearance = CLEARANCE_SHARE * CLEARANCE / max(joint.clearance, CLEARANCE)
        return probe_errors(
            self.sought.sensitivity,
            self.reference,
            per_root,
            load=self.sought.load,
            geometry=math.hypot(clearance, WIDTH / max(joint.bushing_width, WIDTH)),
        )

    def prior(self) -> Prior:
        """Return the prior; raise NotIdentifiable for a model that does not wear."""
        coefficient = self.parameters.bushing.wear_coefficient
        if coefficient <= 0.0:
            raise NotIdentifiable(
                say("model.bushing.wear_coefficient_mm3_per_Nm is 0: give its order of magnitude")
            )
        prior = self.sought.prior
        if prior is None:
            return Prior(coefficient)
        return Prior(prior.wear_coefficient_mm3_per_Nm / MM3_PER_NM, prior.spread_ln, prior.source)

    def possible(self) -> bool:
        """Return whether an identification is possible; log the reason where it is not."""
        try:
            self.errors()
            self.prior()
        except NotIdentifiable as refused:
            self.refused = sentence_of_error(refused)
            log.warning(say("The wear coefficient is not stated: {}.", self.refused))
        return not self.refused

    # --- checkpoint ------------------------------------------------------------------------------

    def packed(self) -> IdentifiedRecord:
        """Return the state."""
        open_bin = replace(self.bins, closed=[]).numbers()
        return IdentifiedRecord(
            self.sought,
            {**open_bin, "closed": self._closed},
            self.consistency.numbers(),
            self.progress,
            self.revolution,
            self.reference,
            self.deepest,
            self.ahead.steps if self.ahead is not None else 0,
            self.ratio,
            self.ends,
            self.known,
        )

    def restore(self, kept: IdentifiedRecord, reference: CycleLoads | None) -> None:
        """Continue from a state; the life is computed again as far as it had come."""
        self.bins, self.consistency = bins_of(kept.bins), consistency_of(kept.consistency)
        self._closed = kept.bins["closed"]
        self.progress, self.revolution = kept.progress, kept.revolution
        self.reference, self.deepest, self.ratio = kept.reference, kept.deepest, kept.ratio
        self.ends, self.known = kept.ends, {**NOTHING, **kept.known}
        if reference is not None:
            self.ahead = LifeAhead(self.parameters, reference)
            for _ in range(kept.steps):
                self.ahead.step()


def _limited(name: str, quantity: Credible, factor: float) -> dict[str, float]:
    """Return the columns of a quantity with its limits."""
    return {
        name: factor * quantity.median,
        f"{name}_low": factor * quantity.low,
        f"{name}_high": factor * quantity.high,
    }
