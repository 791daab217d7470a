"""A dead-weight calibration in progress: angle reference, turns, preloads and readings.

::

    reference --> turn --> preload ... --> record ... --> turn --> ... --> done
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from calibration.load_cell.live import ANGLE_TOLERANCE
from calibration.load_cell.pieces import WeightChange, next_change
from calibration.load_cell.plans import LoadCellPlan, LoadCellStep, PlanKind, StepKind
from calibration.load_cell.readings import LoadCellReadings
from calibration.taking.procedure import (
    Event,
    Procedure,
    ProcedureError,
    Signals,
    TakenReading,
    both_signals,
    replay,
)


@dataclass(frozen=True, slots=True, kw_only=True)
class WeighedReading(TakenReading):
    """A reading with weights. mass: what hung, kg; angle: from the encoder, rad."""

    mass: float
    angle: float


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadCellProcedure(Procedure[LoadCellStep, WeighedReading]):
    """The state of a dead-weight calibration. hanging: the pieces that hang now, kg."""

    plan: LoadCellPlan
    hanging: tuple[float, ...] = ()
    angle_offset: float | None = None
    angle_uncertainty: float | None = None

    @property
    def change(self) -> WeightChange:
        """Return what to hang or take off for the present step."""
        return next_change(self.step.mass, self.hanging, self.plan.pieces)

    def instruct(self) -> str:
        """Return what the operator does at the present step."""
        step = self.step
        if step.kind is StepKind.ANGLE_REFERENCE:
            return (
                "Lay the level on the flat of the crank, turn the crank until the bubble is in the"
                " middle, and enter the angle that the encoder shows. Then turn the level end for"
                " end and do it again: the mean is free of the level's own error."
            )
        if step.kind is StepKind.TURN:
            return f"Take all weights off and turn the pin to {np.degrees(step.angle):.0f} degrees."
        what = _change_words(self.change, step.mass)
        if step.kind is StepKind.PRELOAD:
            return f"{what} This only exercises the cell; nothing is read."
        return f"{what} Wait until it hangs still."

    # --- events ----------------------------------------------------------------------------------

    def reference(self, offset: float, uncertainty: float, shown: Sequence[float] = ()) -> Self:
        """Take the result of the angle reference step, rad.

        shown: what the encoder showed, twice when the level was turned end for end.
        """
        self._expect(StepKind.ANGLE_REFERENCE)
        if not (np.isfinite(offset) and np.isfinite(uncertainty) and uncertainty >= 0.0):
            raise ProcedureError("the angle reference must be two finite numbers")
        event = {
            "event": "reference",
            "offset": offset,
            "uncertainty": uncertainty,
            "shown": [float(one) for one in shown],
        }
        return self.go_on(event, angle_offset=offset, angle_uncertainty=uncertainty)

    @property
    def shown(self) -> tuple[float, ...]:
        """Return what the encoder showed with the crank level, rad."""
        found = [one for one in self.events if one["event"] == "reference"]
        return tuple(found[-1].get("shown", ())) if found else ()

    def turned(self, angle: float) -> Self:
        """Take note that the pin stands at an angle (rad) near the step's; weights are off."""
        step = self._expect(StepKind.TURN)
        if not abs(math.remainder(angle - step.angle, 2.0 * math.pi)) <= ANGLE_TOLERANCE:
            raise ProcedureError(
                f"the encoder shows {np.degrees(angle):.1f} degrees; turn the pin to"
                f" {np.degrees(step.angle):.0f} degrees"
            )
        return self.go_on({"event": "turned", "angle": angle}, hanging=())

    def exercised(self) -> Self:
        """Take note that a preload has hung for its time."""
        self._expect(StepKind.PRELOAD)
        return self.go_on({"event": "exercised"}, hanging=self.change.hanging)

    def record(self, angle: float, signal: Signals, spread: float, time: float) -> Self:
        """Take the reading of the present step; raise ProcedureError when it cannot be one."""
        self._expect(StepKind.READING)
        signals, change = both_signals(signal, angle), self.change
        reading = WeighedReading(
            step=self.position,
            mass=change.mass,
            angle=float(angle),
            signal=signals,
            spread=float(spread),
            time=time,
        )
        after = self.keep(reading, angle=reading.angle, mass=reading.mass)
        return replace(after, hanging=change.hanging)

    def stands_for(self, step: LoadCellStep) -> bool:
        """Tell whether the pin still stands as the series left it."""
        return self.under_way == step.series

    def reject(self, index: int, reason: str) -> Self:
        """Reject a reading (from 0) with a reason; its series is taken again, all weights off."""
        return replace(Procedure.reject(self, index, reason), hanging=())

    def _expect(self, kind: StepKind) -> LoadCellStep:
        if self.step.kind is not kind:
            raise ProcedureError(f"now comes: {self.step.kind}, not {kind}")
        return self.step

    # --- results ---------------------------------------------------------------------------------

    def readings(self) -> LoadCellReadings:
        """Return the readings that stand, in the order taken."""
        kept = [one for one in self.taken if not one.rejected]
        steps = [self.steps[one.step] for one in kept]
        return LoadCellReadings(
            series=tuple(step.series for step in steps),
            step=np.array([step.number for step in steps], dtype=np.int64),
            mass=np.array([one.mass for one in kept]),
            angle=np.array([one.angle for one in kept]),
            signal=np.array([one.signal for one in kept]).reshape(-1, 2),
        )


def begin(plan: LoadCellPlan) -> LoadCellProcedure:
    """Begin a calibration."""
    event = {
        "event": "begin",
        "kind": plan.kind.value,
        "heaviest": plan.heaviest,
        "pieces": list(plan.pieces),
    }
    return LoadCellProcedure(plan=plan, steps=plan.steps(), events=(event,))


def take_up(events: Iterable[Event]) -> LoadCellProcedure:
    """Return the procedure that a journal tells; raise ProcedureError where it makes no sense."""
    return replay(
        events,
        lambda e: begin(LoadCellPlan(PlanKind(e["kind"]), e["heaviest"], tuple(e["pieces"]))),
        {
            "reference": lambda p, e: p.reference(
                e["offset"], e["uncertainty"], e.get("shown", ())
            ),
            "turned": lambda p, e: p.turned(e["angle"]),
            "exercised": lambda p, e: p.exercised(),
            "record": lambda p, e: p.record(e["angle"], e["signal"], e["spread"], e["time"]),
        },
    )


def _change_words(change: WeightChange, mass: float) -> str:
    def listed(pieces: Sequence[float]) -> str:
        return " + ".join(f"{piece:g} kg" for piece in pieces)

    if mass == 0.0:
        return "Take all weights off." if change.remove else "Nothing may hang on the pin."
    parts = []
    if change.remove:
        parts.append(f"take off {listed(change.remove)}")
    if change.add:
        parts.append(f"hang {listed(change.add)}")
    text = " and ".join(parts) or "change nothing"
    return f"{text[0].upper()}{text[1:]}: {change.mass:g} kg hang then."
