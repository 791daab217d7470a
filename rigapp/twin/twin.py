"""The twin: predicts each revolution and wears two bushings parallel to the real one.

One is worn by the predicted forces from the first cycle on, independent of measurements;
the other by the forces that the load cell measures. The probes measure the real one.
"""

from __future__ import annotations

import functools
import logging
import math
import operator
from dataclasses import dataclass, field, replace

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import PROFILES_PER_DECADE, in_order, profile_columns
from rigapp.schema.details import error_text
from rigapp.schema.messages import Prediction, WornProfile
from rigapp.texts import say
from rigapp.twin.agreement import AgreementBand
from rigapp.twin.ahead import BushingAhead, bushing_ahead
from rigapp.twin.approach import RIGID, Approach
from rigapp.twin.deviation import DeviationWatch
from rigapp.twin.identifying import Identifier
from rigapp.twin.jointload import joint_load
from rigapp.twin.measureddepth import (
    ELASTIC_DOUBT,
    FIRST_STEADY,
    NEW_REVOLUTIONS,
    MeasuredDepth,
    depth_uncertainty,
    measured_depth,
    on_angles,
    worn_depth,
)
from rigapp.twin.pinpath import (
    PathSum,
    Reference,
    centres,
    early_wear,
    path_of,
    reference_from_mean,
    reference_of,
)
from rigapp.twin.predict import (
    GRID,
    NOTHING,
    MeasuredRevolution,
    Wear,
    compare,
    measured_force,
    predict_force,
)
from rigapp_model.dynamics import MechanismMotion
from rigapp_model.errors import ModelError
from rigapp_model.frames import into_frame
from rigapp_model.friction_circle import CellDoubt
from rigapp_model.history_uncertainty import NOTHING_YET
from rigapp_model.parameters import Parameters
from rigapp_model.recurrent_motion import RecurrentMotion
from rigapp_model.wear.front import Front
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.state import WearState, unworn_state, worn_by

Array = NDArray[np.float64]

STEP_SHARE = 0.02
"""A bushing is worn further once this share of the cycles so far has been gathered."""
CATCH_UP_STEPS = 12
COUNTED = ("wear_change_revolution", "wear_departure_revolution")
"""Columns that name a revolution, counted by the bushing from when it was new."""
STILL_NEW = 20
"""A bushing first seen after this revolution is not new any more."""

log = logging.getLogger(__name__)


@dataclass(slots=True)
class TrackedBushing:
    """A bushing that wears with the test, by cycles gathered into steps."""

    state: WearState | None = None
    failed: str = ""

    def due(self, cycles: float) -> bool:
        """Return whether enough cycles are gathered for a step of wear."""
        done = self.state.cycles if self.state is not None else 0.0
        return not self.failed and cycles - done >= max(1.0, STEP_SHARE * done)

    def wear_to(self, cycles: float, loads: CycleLoads, parameters: Parameters) -> bool:
        """Wear to a number of cycles when enough are gathered.

        True when the bushing changed.
        """
        if not self.due(cycles):
            return False
        try:
            if self.state is None:
                largest = float(loads.magnitude.max())
                self.state = unworn_state(parameters, max(largest, 1e-3))
            # Begun from the surface alone, as after a checkpoint: both give the same numbers.
            bare = replace(self.state, front=Front(self.state.front.surface))
            self.state = _advanced(bare, loads, cycles)
        except (ModelError, ValueError, ArithmeticError) as error:
            self.failed = error_text(error, say("the wear cannot be computed"))
            log.warning("The twin's bushing is not worn on: %s", error)
        return True

    @property
    def depth(self) -> float:
        """Return the depth at the contact point, m; NaN when the model has no solution."""
        if self.failed:
            return float("nan")
        return self.state.depth_at_contact if self.state is not None else 0.0

    def profile(self) -> Array:
        """Return the depth (m) at the angles of a worn profile; NaN where the model fails."""
        if self.failed or self.state is None:
            return on_angles(np.array([-np.pi, 0.0]), np.full(2, np.nan if self.failed else 0.0))
        return on_angles(*self.state.profile())


def _advanced(state: WearState, loads: CycleLoads, cycles: float) -> WearState:
    """Wear to a number of cycles; a long way (a resumed test) in growing steps."""
    start = state.cycles
    if cycles - start <= max(10.0, 2.0 * STEP_SHARE * start):
        return state.advance_by(loads, cycles - start)
    stops = np.geomspace(max(start, 1.0), cycles, CATCH_UP_STEPS + 1)[1:]
    for stop in stops:
        if stop > state.cycles:
            state = state.advance_by(loads, float(stop - state.cycles))
    return state


@dataclass(slots=True)
class Twin:
    """Predict revolutions in the order in which they come; gaps in the numbers count as worn.

    new_position_um: mean reading of the probes in the new bushing, for a test whose first
    revolutions this twin has not had and of which no checkpoint is left. cell: uncertainty of the
    load cell, None where none is stated. identifier: of the wear coefficient, None where it cannot
    be identified. changed: whether the last revolution changed the checkpoint. before: revolutions
    that the bushing had made when this test began. recurrent: motion of the crank that recurs in
    each revolution.
    """

    parameters: Parameters
    joint: str
    new_position_um: tuple[float, float] | None = None
    cell: CellDoubt | None = None
    identifier: Identifier | None = None
    predicted: TrackedBushing = field(default_factory=TrackedBushing)
    driven: TrackedBushing = field(default_factory=TrackedBushing)
    reference: Reference | None = None
    newest: int = 0
    profiled: int = 0
    kept_profile: int = 0
    ahead: BushingAhead | None = None
    changed: bool = False
    before: int = 0
    recurrent: RecurrentMotion = NOTHING_YET
    agreement: AgreementBand = field(init=False)
    deviation: DeviationWatch = field(init=False)
    _last: MeasuredDepth = field(default_factory=MeasuredDepth)
    _first: dict[int, PathSum] = field(default_factory=dict)
    _path: PathSum | None = None

    def __post_init__(self) -> None:
        self.agreement = AgreementBand(self.parameters, self.joint, self.cell)
        self.deviation = DeviationWatch(self.parameters, self.joint, self.cell)

    def predict(self, measured: MeasuredRevolution) -> Prediction:
        """Predict a revolution, wear the bushings, compare."""
        depth = self.predicted.depth
        motion, doubt = predict_force(
            self.parameters, self.joint, measured, 0.0 if np.isnan(depth) else depth,
            self.recurrent,
        )  # fmt: skip
        self.recurrent = doubt.recurrent
        slip = motion.slip_increments(self.parameters.joint.pin_radius)
        made = measured.revolution + self.before
        cycles = float(made)
        in_crank = measured_force(measured)
        force = _in_follower(in_crank, motion)
        sliding = motion.slip_rate(self.parameters.joint.pin_radius)
        loads = worn_by(self.parameters, force, slip, sliding)
        changed = self.driven.wear_to(cycles, loads, self.parameters)
        if self.predicted.due(cycles):
            by_model = worn_by(self.parameters, motion.force_follower, slip, sliding)
            changed |= self.predicted.wear_to(cycles, by_model, self.parameters)
        path = _path(measured, motion)
        if self.ahead is None and (self.reference or measured.revolution >= FIRST_STEADY):
            self.ahead = bushing_ahead(self.parameters, force, slip)
        changed |= self._learn(measured.revolution, path)
        self._last = self._measured_depth(path)
        wear = Wear(
            self.predicted.depth, self.driven.depth, self._last.depth, self._last.uncertainty
        )
        self.newest = measured.revolution
        profile = self._profile(measured.revolution, path)
        self.changed = changed or profile is not None
        known = NOTHING
        if self.identifier is not None:
            usual = self.ahead.loads if self.ahead is not None else None
            self.identifier.take(made, loads, usual, self._last, measured.temperature)
            counted = {name: self.identifier.known[name] - self.before for name in COUNTED}
            self.changed, known = True, self.identifier.known | counted
        load = joint_load(self.parameters, in_crank, motion, self.cell)
        predicted = 0.0 if np.isnan(depth) else depth
        band = self.agreement.band(measured, motion, doubt, predicted)
        averaged = replace(doubt, curve=self.agreement.left_open)
        differs = self.deviation.take(
            in_crank, motion, 0.5 * doubt.lasting * averaged.curve, predicted, self.reference
        )
        prediction = compare(
            measured, motion, wear, averaged, load, band, {**known, **differs.columns}
        )
        return msgspec.structs.replace(prediction, profile=profile)

    def _learn(self, revolution: int, path: PathSum) -> bool:
        """Collect the new bushing's revolutions for the reference; return whether it changed."""
        if self.reference is not None:
            return False
        clearance = self.parameters.joint.clearance
        if self.new_position_um is not None:
            position = -1e-6 * np.array(self.new_position_um)
            self.reference = reference_from_mean(position, clearance, path)
            return True
        if not FIRST_STEADY <= revolution <= STILL_NEW:
            return False
        self._first[revolution] = path
        if len(self._first) < NEW_REVOLUTIONS:
            return False
        paths = list(self._first.values())
        approach = self._approach(0.0) or RIGID
        self.reference = reference_of(
            functools.reduce(operator.add, paths),
            clearance,
            early_wear(list(self._first), paths, approach),
            self.parameters.joint.friction_coefficient,
            approach,
        )
        self._first.clear()
        return self.reference is not None

    def _approach(self, depth: float) -> Approach | None:
        return self.ahead.upto(depth) if self.ahead is not None else None

    def _measured_depth(self, path: PathSum) -> MeasuredDepth:
        """Return the measured depth, with the approach computed far enough for it."""
        clearance = self.parameters.joint.clearance
        approach = self._approach(0.0)
        depth = measured_depth(path, self.reference, clearance, approach)
        if math.isfinite(depth.depth):
            further = self._approach(depth.depth)
            if further is not approach:
                depth = measured_depth(path, self.reference, clearance, further)
        return depth

    def _profile(self, revolution: int, path: PathSum) -> WornProfile | None:
        """Return a new worn profile when enough revolutions are gathered."""
        self._path = path if self._path is None else self._path + path
        keep = profile_is_due(self.kept_profile, revolution)
        waited = revolution - self.profiled
        if not keep and waited < max(1.0, STEP_SHARE * self.profiled):
            return None
        worn = self._worn(revolution, self._path, keep)
        self._path, self.profiled = None, revolution
        self.kept_profile = revolution if keep else self.kept_profile
        return worn

    def _worn(self, revolution: int, path: PathSum, keep: bool) -> WornProfile:
        joint, reference = self.parameters.joint, self.reference
        predicted, driven = self.predicted.profile(), self.driven.profile()
        measured, doubt = np.full_like(predicted, np.nan), np.full_like(predicted, np.nan)
        approach, change = math.nan, math.nan
        if reference is not None and path.filled.any():
            depth = self._last.depth if math.isfinite(self._last.depth) else 0.0
            elastic = self._approach(depth) or RIGID
            largest = np.hypot(*path.mean_force).max(keepdims=True)
            approach = float(elastic.at(depth, largest)[0])
            change = approach - reference.approach
            force = path.mean_force.sum(axis=1)
            radial = np.hypot(reference.radial, path.standard_error)
            radial = float(np.hypot(radial, ELASTIC_DOUBT * change))
            across = float(np.hypot(reference.across, path.standard_error))
            doubt = depth_uncertainty(radial, across, float(np.arctan2(force[1], force[0])))
            places = centres(path, reference, depth, elastic)
            measured = worn_depth(places, joint.pin_radius, joint.bushing_radius, doubt)
        centre = -1e6 * reference.centre if reference is not None else np.full(2, np.nan)
        run_out = 1e6 * np.hypot(*reference.run_out) if reference is not None else math.nan
        centred = reference is not None and reference.centred
        values = {
            "revolution": revolution,
            "revolutions": path.revolutions,
            "approach": 1e6 * approach,
            "approach_change": 1e6 * change,
            "centre_1": centre[0],
            "centre_2": centre[1],
            "run_out": run_out,
            "centred": centred,
        }
        measured, predicted, driven, doubt = (
            (1e3 * curve).astype("<f4") for curve in (measured, predicted, driven, doubt)
        )
        return WornProfile(
            revolution=revolution,
            values=in_order(profile_columns(), values).tobytes(),
            measured=measured.tobytes(),
            predicted=predicted.tobytes(),
            driven=driven.tobytes(),
            uncertainty=doubt.tobytes(),
            keep=keep,
        )


def profile_is_due(kept: int, revolution: int) -> bool:
    """Return whether a worn profile is to be kept now, after the one of revolution ``kept`` (or 0).

    PROFILES_PER_DECADE numbers in each decade, at equal distances in the logarithm.
    """

    def step(number: int) -> int:
        return math.floor(PROFILES_PER_DECADE * math.log10(number) + 1e-9)

    return kept <= 0 or (revolution > kept and step(revolution) > step(kept))


def _in_follower(force: Array, motion: MechanismMotion) -> Array:
    """Turn the measured force at ``GRID`` from the crank frame into the follower's."""
    turn = motion.follower_angle - GRID
    return np.asarray(into_frame(force, np.cos(turn), np.sin(turn)), dtype=np.float64)


def _path(measured: MeasuredRevolution, motion: MechanismMotion) -> PathSum:
    """Return the measured path of the pin in the wear frame."""
    angle = measured.angle
    lean = np.interp(angle, GRID, motion.follower_angle, period=2.0 * np.pi)
    turn = angle - lean
    force = into_frame(np.stack([measured.force_1, measured.force_2]), np.cos(turn), -np.sin(turn))
    position = np.stack([measured.probe_1, measured.probe_2])
    return path_of(angle, -position, -force, turn)
