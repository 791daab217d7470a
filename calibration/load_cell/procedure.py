"""A calibration in progress, as a pure state machine: events in, state out.

The wizard and the command line are thin faces of it. Every event is a small mapping that the caller
appends to a journal at once; replaying the journal gives the state back, so that a calibration can
be closed and taken up again. A reading can be rejected with a reason, never erased.

::

    step shown --record--> next step --record--> ... --record--> done
        ^                      |
        +-------back-----------+      (the reading of that step is rejected with a reason)
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from calibration.load_cell.pieces import Change, next_change
from calibration.load_cell.plans import PlanKind, Step, StepKind, make_plan, time_needed
from calibration.load_cell.readings import LoadCellReadings


class ProcedureError(ValueError):
    """Say why an event is not possible now."""


@dataclass(frozen=True, slots=True)
class Taken:
    """One reading as taken: which step, angle from the encoder (rad), signals, and when (UTC s)."""

    step: int
    mass: float
    angle: float
    signal: tuple[float, float]
    spread: float
    time: float
    rejected: str = ""


@dataclass(frozen=True, slots=True)
class Procedure:
    """The state of a calibration. pieces: the laboratory's weights, kg."""

    kind: PlanKind
    pieces: tuple[float, ...]
    heaviest: float
    steps: tuple[Step, ...]
    position: int = 0
    taken: tuple[Taken, ...] = ()
    hanging: tuple[float, ...] = ()
    angle_offset: float | None = None
    angle_uncertainty: float | None = None
    events: tuple[Mapping[str, Any], ...] = field(default=(), repr=False)

    # --- what to do now --------------------------------------------------------------------------

    @property
    def done(self) -> bool:
        """Tell whether every step has been taken."""
        return self.position >= len(self.steps)

    @property
    def step(self) -> Step:
        """Return the step to do now; raise ProcedureError when all are done."""
        if self.done:
            raise ProcedureError("every step of the plan has been taken")
        return self.steps[self.position]

    @property
    def change(self) -> Change:
        """Return what to hang or take off for the present step."""
        return next_change(self.step.mass, self.hanging, self.pieces)

    @property
    def instruction(self) -> str:
        """Return what the operator does now, as a technician would say it."""
        if self.done:
            return "All readings are taken. Look at the result."
        step = self.step
        if step.kind is StepKind.ANGLE_REFERENCE:
            return (
                "Lay the level on the flat of the crank, turn the crank until the bubble is in the"
                " middle, and enter the angle that the encoder shows. Then turn the level end for"
                " end and do it again: the mean is free of the level's own error."
            )
        degrees = np.degrees(step.angle)
        if step.kind is StepKind.TURN:
            return f"Take all weights off and turn the pin to {degrees:.0f} degrees."
        what = _change_words(self.change, step.mass)
        if step.kind is StepKind.PRELOAD:
            return f"{what} This only exercises the cell; nothing is read."
        return f"{what} Wait until it hangs still."

    @property
    def progress(self) -> str:
        """Return where the calibration stands: step n of N, time left."""
        left = time_needed(self.steps[self.position :]) / 60.0
        hours, minutes = divmod(round(left), 60)
        time_left = f"{hours} h {minutes} min" if hours else f"{minutes} min"
        return (
            f"step {min(self.position + 1, len(self.steps))} of {len(self.steps)}, {time_left} left"
        )

    # --- events ----------------------------------------------------------------------------------

    def reference(
        self, offset: float, uncertainty: float, shown: Sequence[float] = ()
    ) -> Procedure:
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
        return self._next(event, angle_offset=offset, angle_uncertainty=uncertainty)

    @property
    def shown(self) -> tuple[float, ...]:
        """Return what the encoder showed with the crank level, rad."""
        found = [one for one in self.events if one["event"] == "reference"]
        return tuple(found[-1].get("shown", ())) if found else ()

    def turned(self, angle: float) -> Procedure:
        """Take note that the pin stands at an angle (rad) near the step's; weights are off."""
        step = self._expect(StepKind.TURN)
        off = np.angle(np.exp(1j * (angle - step.angle)))
        if not np.isfinite(angle) or abs(off) > np.radians(5.0):
            raise ProcedureError(
                f"the encoder shows {np.degrees(angle):.1f} degrees; turn the pin to"
                f" {np.degrees(step.angle):.0f} degrees"
            )
        return self._next({"event": "turned", "angle": angle}, hanging=())

    def exercised(self) -> Procedure:
        """Take note that a preload has hung for its time."""
        self._expect(StepKind.PRELOAD)
        hanging = self.change.hanging
        return self._next({"event": "exercised"}, hanging=hanging)

    def record(
        self, angle: float, signal: Sequence[float], spread: float, time: float
    ) -> Procedure:
        """Take the reading of the present step; raise ProcedureError when it cannot be one."""
        step = self._expect(StepKind.READING)
        values = (float(signal[0]), float(signal[1]))
        if not np.isfinite([angle, *values]).all():
            raise ProcedureError("the reading is not a number; check cable and amplifier")
        change = self.change
        reading = Taken(self.position, change.mass, float(angle), values, float(spread), time)
        event = {
            "event": "record",
            "angle": float(angle),
            "signal": list(values),
            "spread": float(spread),
            "time": time,
            "series": step.series,
            "step": step.number,
            "mass": change.mass,
        }
        return self._next(event, taken=(*self.taken, reading), hanging=change.hanging)

    def reject(self, index: int, reason: str) -> Procedure:
        """Reject the reading number ``index`` (from 0) with a reason; its series is taken again.

        The other readings of the series are rejected with it, since their order counts. Between two
        series, and at the end, any series can be rejected; the others stand.
        """
        if not reason.strip():
            raise ProcedureError("a reading is rejected with a reason; write one")
        if not 0 <= index < len(self.taken):
            raise ProcedureError(f"there is no reading number {index + 1}")
        first = self.taken[index]
        if first.rejected:
            raise ProcedureError("this reading is rejected already")
        series = self.steps[first.step].series
        start = next(i for i, step in enumerate(self.steps) if step.series == series)
        if self.under_way not in (series, ""):
            raise ProcedureError(
                f"series {self.under_way} is under way; finish it first, then reject and repeat"
                f" series {series}"
            )
        if self.under_way != series:
            start = _first_of_angle(self.steps, start)
        words = reason.strip()
        taken = tuple(
            replace(one, rejected=words if one is first else f"series repeated: {words}")
            if self.steps[one.step].series == series and not one.rejected
            else one
            for one in self.taken
        )
        event = {"event": "reject", "index": index, "reason": words}
        return replace(self, position=start, taken=taken, hanging=(), events=(*self.events, event))

    def _expect(self, kind: StepKind) -> Step:
        if self.step.kind is not kind:
            raise ProcedureError(f"now comes: {self.step.kind}, not {kind}")
        return self.step

    @property
    def under_way(self) -> str:
        """Return the series that is begun but not complete, empty between two series."""
        if self.done:
            return ""
        series = self.step.series
        begun = any(
            not one.rejected and self.steps[one.step].series == series for one in self.taken
        )
        return series if series and begun else ""

    def _next(self, event: Mapping[str, Any], **changes: Any) -> Procedure:
        after = replace(self, position=self.position + 1, events=(*self.events, event), **changes)
        return replace(after, position=_skip_complete(after))

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


def _first_of_angle(steps: Sequence[Step], index: int) -> int:
    """Return the step at which the pin is turned to the angle of the step ``index``."""
    while index > 0 and steps[index].kind is not StepKind.TURN:
        index -= 1
    return index


def _skip_complete(procedure: Procedure) -> int:
    """Return the next step, past angles whose every reading stands already."""
    steps, position = procedure.steps, procedure.position
    standing = {one.step for one in procedure.taken if not one.rejected}
    while position < len(steps) and steps[position].kind is StepKind.TURN:
        end = position + 1
        while end < len(steps) and steps[end].kind is not StepKind.TURN:
            end += 1
        wanted = [i for i in range(position, end) if steps[i].kind is StepKind.READING]
        if not all(index in standing for index in wanted):
            break
        position = end
    return position


def begin(kind: PlanKind, heaviest: float, pieces: Sequence[float]) -> Procedure:
    """Begin a calibration up to ``heaviest`` (kg) with the laboratory's pieces (kg)."""
    steps = make_plan(kind, heaviest, pieces)
    event = {
        "event": "begin",
        "kind": kind.value,
        "heaviest": heaviest,
        "pieces": list(pieces),
    }
    return Procedure(kind, tuple(pieces), heaviest, steps, events=(event,))


def take_up(events: Iterable[Mapping[str, Any]]) -> Procedure:
    """Return the procedure that a journal tells; raise ProcedureError where it makes no sense."""
    procedure: Procedure | None = None
    for number, event in enumerate(events, 1):
        try:
            procedure = _apply(procedure, event)
        except (KeyError, TypeError, ValueError) as error:
            raise ProcedureError(f"line {number} of the journal is not usable: {error}") from error
    if procedure is None:
        raise ProcedureError("the journal is empty")
    return procedure


def _apply(procedure: Procedure | None, event: Mapping[str, Any]) -> Procedure:
    kind = event["event"]
    if procedure is None:
        if kind != "begin":
            raise ProcedureError("a journal starts with begin")
        return begin(PlanKind(event["kind"]), event["heaviest"], event["pieces"])
    if kind == "reference":
        shown = event.get("shown", ())
        return procedure.reference(event["offset"], event["uncertainty"], shown)
    if kind == "turned":
        return procedure.turned(event["angle"])
    if kind == "exercised":
        return procedure.exercised()
    if kind == "record":
        return procedure.record(event["angle"], event["signal"], event["spread"], event["time"])
    if kind == "reject":
        return procedure.reject(event["index"], event["reason"])
    raise ProcedureError(f"unknown event {kind!r}")


def _change_words(change: Change, mass: float) -> str:
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
