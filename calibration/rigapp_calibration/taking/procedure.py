"""A calibration in progress, as a pure state machine: events in, state out.

The wizard and the command line are thin interfaces to it. Every event is a small mapping that the
caller appends to a journal at once; replaying the journal restores the state, so that a calibration
can be closed and resumed. A reading can be rejected with a reason, never erased.

::

    reference --> set up --> preload ... --> record ... --> set up --> ... --> done
                    ^                          |
                    +----------reject----------+     (the reading's series is taken again)

The calibration type is data: the steps of a plan, and a ``Method`` that names them in the journal
(``rigapp_calibration.load_cell.plans``, ``rigapp_calibration.probes.plans``).
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, Protocol, Self, TypeVar

import numpy as np

from rigapp.texts import SentenceError, joined, say
from rigapp_calibration.arrays import Array, Whole

Event = Mapping[str, Any]
Signals = Sequence[float] | Array


class ProcedureError(SentenceError, ValueError):
    """An event is not possible now; the text gives the reason."""


class StepKind(enum.StrEnum):
    """The operator's action in a step."""

    ANGLE_REFERENCE = "angle reference"
    SET_UP = "setting up"
    PRELOAD = "preload"
    READING = "reading"


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a plan: the action, and its words.

    set_up: place of the step (the pin's angle in rad, a probe), None for none. value: to be set
    (kg, m); pieces: weights that make it. series, number: name the reading in the record,
    empty where nothing is read. wait: s, after the last change; handling: s that a technician
    needs. falling: the value is reached from above. due: s after the last preload at which it is
    read, 0 where that does not matter. optional: its series can be left out.
    """

    kind: StepKind
    words: str
    set_up: float | None = None
    value: float = 0.0
    pieces: tuple[float, ...] = ()
    series: str = ""
    number: int = 0
    wait: float = 0.0
    handling: float = 0.0
    falling: bool = False
    due: float = 0.0
    optional: bool = False


class Plan(Protocol):
    """Steps of a calibration."""

    def steps(self) -> tuple[Step, ...]:
        """Return the steps in the order taken; raise ValueError for an impossible plan."""


PlanType = TypeVar("PlanType", bound=Plan)


@dataclass(frozen=True, slots=True)
class Method(Generic[PlanType]):
    """How a journal records a calibration, and what prevents a step.

    told: writes a plan to the first event; plan: reads it, raising ProcedureError for a foreign
    one. set_up, place, value: names of the event of a set-up, of what was set up, and of what was
    set. wrongly: why a step is impossible with the present set-up, else empty. afresh: a
    complete series that is repeated begins with its set-up, even if that is unchanged.
    """

    told: Callable[[PlanType], Event]
    plan: Callable[[Event], PlanType]
    set_up: str
    place: str
    value: str
    wrongly: Callable[[float, Step], str]
    afresh: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class TakenReading:
    """One reading as taken: number of its step, signals, their spread, when (UTC s).

    value, place: what was set (kg, m), and at what it was set up (rad, a probe). hung: s since the
    preload, of a step that is due then. rejected: the reason, empty while it is valid.
    """

    step: int
    value: float
    place: float
    signal: tuple[float, float]
    spread: float
    time: float
    hung: float = 0.0
    rejected: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Procedure(Generic[PlanType]):
    """The state of a calibration: steps in the order taken, the present one, all readings.

    left_out: the series that the operator skipped.
    """

    method: Method[PlanType] = field(repr=False)
    plan: PlanType
    steps: tuple[Step, ...]
    position: int = 0
    taken: tuple[TakenReading, ...] = ()
    left_out: frozenset[str] = frozenset()
    events: tuple[Event, ...] = field(default=(), repr=False)

    # --- what to do now --------------------------------------------------------------------------

    @property
    def done(self) -> bool:
        """Return whether every step has been taken."""
        return self.position >= len(self.steps)

    @property
    def step(self) -> Step:
        """Return the step to do now; raise ProcedureError when all are done."""
        if self.done:
            raise ProcedureError("every step of the plan is done")
        return self.steps[self.position]

    @property
    def instruction(self) -> str:
        """Return the instruction for the present step, in a technician's words."""
        return say("All readings are taken. Look at the result.") if self.done else self.step.words

    @property
    def progress(self) -> str:
        """Return the progress: step n of N, time left."""
        count = len(self.steps)
        left = duration_words(self.steps[self.position :])
        return say("step {} of {}, {} left", min(self.position + 1, count), count, left)

    @property
    def under_way(self) -> str:
        """Return the series that is begun but not complete, empty between two series."""
        series = "" if self.done else self.step.series
        begun = any(
            not one.rejected and self.steps[one.step].series == series for one in self.taken
        )
        return series if series and begun else ""

    def told(self, name: str) -> Event | None:
        """Return the newest event of a name."""
        return next((one for one in reversed(self.events) if one["event"] == name), None)

    def standing(self, *, of: Callable[[Step], bool]) -> list[tuple[Step, TakenReading]]:
        """Return the valid readings of selected steps, in the order taken."""
        pairs = ((self.steps[one.step], one) for one in self.taken if not one.rejected)
        return [(step, one) for step, one in pairs if of(step)]

    def columns(
        self, *, of: Callable[[Step], bool]
    ) -> tuple[tuple[str, ...], Whole, Array, Array, Array]:
        """Return series, step (n,), value, place and signals (n, 2) of the valid readings."""
        kept = self.standing(of=of)
        return (
            tuple(step.series for step, _ in kept),
            np.array([step.number for step, _ in kept], dtype=np.int64),
            np.array([one.value for _, one in kept], dtype=np.float64),
            np.array([one.place for _, one in kept], dtype=np.float64),
            np.array([one.signal for _, one in kept], dtype=np.float64).reshape(-1, 2),
        )

    # --- events ----------------------------------------------------------------------------------

    def _expect(self, kind: StepKind) -> Step:
        if self.step.kind is not kind:
            raise ProcedureError(
                "the next step is {}, not {}: {}", self.step.kind, kind, self.step.words
            )
        return self.step

    def reference(self, offset: float, uncertainty: float, shown: Sequence[float] = ()) -> Self:
        """Record the result of the angle reference step, rad.

        shown: encoder readings, two when the level was turned end for end.
        """
        self._expect(StepKind.ANGLE_REFERENCE)
        if not (np.isfinite(offset) and np.isfinite(uncertainty) and uncertainty >= 0.0):
            raise ProcedureError("the angle reference must be two finite numbers")
        listed = [float(one) for one in shown]
        told = {"offset": offset, "uncertainty": uncertainty, "shown": listed}
        return self._after_event({"event": "reference", **told})

    def set_up(self, place: float | None = None) -> Self:
        """Record that the set-up is complete: at a place, or at the step's own."""
        step = self._expect(StepKind.SET_UP)
        at = step.set_up if place is None else place
        wrong = "" if at is None else self.method.wrongly(at, step)
        if wrong:
            raise ProcedureError(wrong)
        return self._after_event({"event": self.method.set_up, self.method.place: at})

    def exercised(self, time: float | None = None) -> Self:
        """Record that a preload has hung for its time, with its end (UTC s)."""
        self._expect(StepKind.PRELOAD)
        return self._after_event({"event": "exercised", **({} if time is None else {"time": time})})

    def leave_out(self) -> Self:
        """Skip the series under way; its readings do not count."""
        if not self.step.optional:
            raise ProcedureError("this step cannot be left out")
        series = self.step.series
        after = self._rejected(series, say("left out"))
        event = {"event": say("left out"), "series": series}
        return after._after_event(event, left_out=self.left_out | {series})

    def again(self, reason: str) -> Self:
        """Restart the series under way; its readings do not count."""
        series = self.step.series
        start = next(i for i, step in enumerate(self.steps) if step.series == series)
        event = {"event": "again", "reason": reason}
        return replace(self._rejected(series, reason), position=start, events=(*self.events, event))

    def record(
        self,
        signal: Signals,
        spread: float,
        time: float,
        *,
        value: float | None = None,
        place: float | None = None,
        hung: float = 0.0,
    ) -> Self:
        """Record the reading of the present step; raise ProcedureError when it is not possible.

        value, place: as set, instead of the step's. hung: s since the preload.
        """
        step = self._expect(StepKind.READING)
        reading = TakenReading(
            step=self.position,
            value=float(step.value if value is None else value),
            place=float((step.set_up or 0.0) if place is None else place),
            signal=(float(signal[0]), float(signal[1])),
            spread=float(spread),
            time=time,
            hung=float(hung),
        )
        if not np.isfinite([*reading.signal, reading.value, reading.place]).all():
            names = [
                say("signal {}", n) for n, one in enumerate(reading.signal, 1) if one - one != 0.0
            ]
            culprit = say(": {}", joined(say(" and "), names)) if names else ""
            raise ProcedureError(
                "the reading is not a number{}; check cable and amplifier", culprit
            )
        event = {
            "event": "record",
            "signal": list(reading.signal),
            "spread": reading.spread,
            "time": reading.time,
            "series": step.series,
            "step": step.number,
            self.method.value: reading.value,
            self.method.place: reading.place,
            **({"hung": reading.hung} if step.due else {}),
        }
        return self._after_event(event, taken=(*self.taken, reading))

    def reject(self, index: int, reason: str) -> Self:
        """Reject the reading number ``index`` (from 0) with a reason; its series is taken again.

        The other readings of the series are rejected with it, since their order counts. Between two
        series, and at the end, any series can be rejected; the others stay valid.
        """
        words = " ".join(reason.split())
        if not words:
            raise ProcedureError("rejecting a reading needs a reason; enter one")
        if not 0 <= index < len(self.taken):
            raise ProcedureError("there is no reading number {}", index + 1)
        first = self.taken[index]
        if first.rejected:
            raise ProcedureError("this reading is rejected already")
        series = self.steps[first.step].series
        if self.under_way not in (series, ""):
            raise ProcedureError(
                "series {} is not finished; finish it first, then reject and repeat series {}",
                self.under_way,
                series,
            )
        start = next(i for i, step in enumerate(self.steps) if step.series == series)
        wanted = self.steps[start].set_up
        if not self._still_set_up(self.steps[start]):
            start = next(i for i, step in enumerate(self.steps) if step.set_up == wanted)
        taken = self._rejected(series, say("series repeated: {}", words)).taken
        taken = (*taken[:index], replace(first, rejected=words), *taken[index + 1 :])
        event = {"event": "reject", "index": index, "reason": words}
        return replace(self, position=start, taken=taken, events=(*self.events, event))

    def back(self, reason: str) -> Self:
        """Repeat the newest valid reading, with a reason; the others of its series stay.

        Each call goes one step further back, but not past a set-up: its load is gone.
        """
        words = " ".join(reason.split())
        if not words:
            raise ProcedureError("a reading is taken again with a reason; write one")
        before = next(one["event"] for one in reversed(self.events) if one["event"] != "note")
        index = next((i for i, one in reversed([*enumerate(self.taken)]) if not one.rejected), -1)
        last, newest = (self.taken[i].step if self.taken else 0 for i in (index, -1))
        alike = self.steps[last].series == self.steps[newest].series
        if index < 0 or before not in ("record", "back") or not alike:
            raise ProcedureError("there is no reading just before; reject one of the table")
        again = replace(self.taken[index], rejected=words)
        taken = (*self.taken[:index], again, *self.taken[index + 1 :])
        event = {"event": "back", "reason": words}
        return replace(self, position=last, taken=taken, events=(*self.events, event))

    def note(self, text: str) -> Self:
        """Record a remark of the operator beside the readings; it changes no step."""
        words = " ".join(text.split())
        if not words:
            raise ProcedureError("the note is empty; write what was noticed")
        return replace(self, events=(*self.events, {"event": "note", "text": words}))

    def _rejected(self, series: str, words: str) -> Self:
        """Return the state without valid readings of a series."""
        taken = tuple(
            replace(one, rejected=words)
            if self.steps[one.step].series == series and not one.rejected
            else one
            for one in self.taken
        )
        return replace(self, taken=taken)

    def _still_set_up(self, step: Step) -> bool:
        """Return whether the rig is still set up for a step of a repeated series."""
        if self.method.afresh:
            return self.under_way == step.series
        told = self.told(self.method.set_up)
        return told is not None and bool(told[self.method.place] == step.set_up)

    def _after_event(self, event: Event, **changes: Any) -> Self:
        """Return the state after an event, at the next open step."""
        after = replace(self, events=(*self.events, event), **changes)
        standing = {one.step for one in after.taken if not one.rejected}
        position = self.position + 1
        while position < len(self.steps) and not after._is_open(position, standing):
            position += 1
        return replace(after, position=position)

    def _is_open(self, position: int, standing: set[int]) -> bool:
        """Return whether a step is open: it, or the series it serves, has no valid reading.

        A preload with a series serves that one, other steps serve all at their set-up.
        """
        step = self.steps[position]
        if step.series in self.left_out:
            return False
        if step.kind is StepKind.READING:
            return position not in standing
        return any(
            later.kind is StepKind.READING
            and later.series not in self.left_out
            and (later.series == step.series if step.series else later.set_up == step.set_up)
            and index not in standing
            for index, later in enumerate(self.steps)
        )


def time_needed(steps: Iterable[Step]) -> float:
    """Return the seconds that a technician needs for the steps."""
    return sum(step.wait + step.handling for step in steps)


def duration_words(steps: Iterable[Step]) -> str:
    """Return the time that a technician needs for the steps, in words."""
    hours, minutes = divmod(math.ceil(time_needed(steps) / 60.0), 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"


def begin(method: Method[PlanType], plan: PlanType) -> Procedure[PlanType]:
    """Begin a calibration; raise ValueError for an impossible plan."""
    event = {"event": "begin", **method.told(plan)}
    return Procedure(method=method, plan=plan, steps=plan.steps(), events=(event,))


def take_up(method: Method[PlanType], events: Iterable[Event]) -> Procedure[PlanType]:
    """Restore a procedure from its journal; raise ProcedureError for an inconsistent one."""
    procedure: Procedure[PlanType] | None = None
    for number, event in enumerate(events, 1):
        try:
            if (procedure is None) is not (event["event"] == "begin"):
                raise ProcedureError('a journal begins with the event "begin"')
            if procedure is None:
                procedure = begin(method, method.plan(event))
            else:
                procedure = _after(procedure, event)
        except (KeyError, TypeError, ValueError) as error:
            raise ProcedureError(
                "line {} of the journal is not usable ‹{}›", number, repr(error)
            ) from error
    if procedure is None:
        raise ProcedureError("the journal is empty")
    return procedure


def _after(procedure: Procedure[PlanType], event: Event) -> Procedure[PlanType]:
    """Return the procedure after an event of its journal."""
    method, kind = procedure.method, event["event"]
    if kind == "reject":
        return procedure.reject(event["index"], event["reason"])
    if kind == "reference":
        return procedure.reference(event["offset"], event["uncertainty"], event.get("shown", ()))
    if kind == method.set_up:
        return procedure.set_up(event[method.place])
    if kind == "exercised":
        return procedure.exercised(event.get("time"))
    if kind == "again":
        return procedure.again(event["reason"])
    if kind == "back":
        return procedure.back(event["reason"])
    if kind == "note":
        return procedure.note(event["text"])
    if kind == "left out":
        return procedure.leave_out()
    if kind == "record":
        value, place = event.get(method.value), event.get(method.place)
        return procedure.record(
            event["signal"],
            event["spread"],
            event["time"],
            value=value,
            place=place,
            hung=event.get("hung", 0.0),
        )
    raise ProcedureError("unknown event {}", repr(kind))
