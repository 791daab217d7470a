"""A calibration in progress, as a pure state machine: events in, state out.

The wizard and the command line are thin faces of it. Every event is a small mapping that the caller
appends to a journal at once; replaying the journal gives the state back, so that a calibration can
be closed and taken up again. A reading can be rejected with a reason, never erased.

::

    set up --> step --record--> next step --record--> ... --record--> done
                ^                    |
                +------reject--------+     (the reading's series is taken again)

A subject adds its steps, its readings and its own events (``calibration.load_cell.procedure``,
``calibration.probes.procedure``).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, Protocol, Self, TypeVar

import numpy as np

from calibration.arrays import Array

Event = Mapping[str, Any]
Signals = Sequence[float] | Array


class ProcedureError(ValueError):
    """Say why an event is not possible now."""


class PlannedStep(Protocol):
    """One step of a plan. series: empty where nothing is read; number: of the reading in it."""

    @property
    def series(self) -> str:
        """Return the series that the reading belongs to."""

    @property
    def number(self) -> int:
        """Return the number of the reading in its series."""

    @property
    def set_up(self) -> float | None:
        """Return what must be set up for the step (an angle, a probe); None for none."""

    @property
    def effort(self) -> float:
        """Return the seconds that the step takes a technician."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TakenReading:
    """One reading as taken: number of its step, signals, their spread, when (UTC s).

    rejected: why it does not count, empty while it stands.
    """

    step: int
    signal: tuple[float, float]
    spread: float
    time: float
    rejected: str = ""


StepType = TypeVar("StepType", bound=PlannedStep)
ReadingType = TypeVar("ReadingType", bound=TakenReading)
ProcedureType = TypeVar("ProcedureType", bound="Procedure[Any, Any]")


@dataclass(frozen=True, slots=True, kw_only=True)
class Procedure(ABC, Generic[StepType, ReadingType]):
    """The state of a calibration: steps in the order taken, the present one, all readings."""

    steps: tuple[StepType, ...]
    position: int = 0
    taken: tuple[ReadingType, ...] = ()
    events: tuple[Event, ...] = field(default=(), repr=False)

    # --- what to do now --------------------------------------------------------------------------

    @property
    def done(self) -> bool:
        """Tell whether every step has been taken."""
        return self.position >= len(self.steps)

    @property
    def step(self) -> StepType:
        """Return the step to do now; raise ProcedureError when all are done."""
        if self.done:
            raise ProcedureError("every step of the plan has been taken")
        return self.steps[self.position]

    @property
    def instruction(self) -> str:
        """Return what the operator does now, as a technician would say it."""
        return "All readings are taken. Look at the result." if self.done else self.instruct()

    @abstractmethod
    def instruct(self) -> str:
        """Return what the operator does at the present step."""

    @property
    def progress(self) -> str:
        """Return where the calibration stands: step n of N, time left."""
        count = len(self.steps)
        left = duration_words(self.steps[self.position :])
        return f"step {min(self.position + 1, count)} of {count}, {left} left"

    @property
    def under_way(self) -> str:
        """Return the series that is begun but not complete, empty between two series."""
        series = "" if self.done else self.step.series
        begun = any(
            not one.rejected and self.steps[one.step].series == series for one in self.taken
        )
        return series if series and begun else ""

    # --- events ----------------------------------------------------------------------------------

    @abstractmethod
    def stands_for(self, step: StepType) -> bool:
        """Tell whether the rig is still set up for a step of a series that is taken again."""

    def reject(self, index: int, reason: str) -> Self:
        """Reject the reading number ``index`` (from 0) with a reason; its series is taken again.

        The other readings of the series are rejected with it, since their order counts. Between two
        series, and at the end, any series can be rejected; the others stand.
        """
        words = " ".join(reason.split())
        if not words:
            raise ProcedureError("a reading is rejected with a reason; write one")
        if not 0 <= index < len(self.taken):
            raise ProcedureError(f"there is no reading number {index + 1}")
        first = self.taken[index]
        if first.rejected:
            raise ProcedureError("this reading is rejected already")
        series = self.steps[first.step].series
        if self.under_way not in (series, ""):
            raise ProcedureError(
                f"series {self.under_way} is under way; finish it first, then reject and repeat"
                f" series {series}"
            )
        start = next(i for i, step in enumerate(self.steps) if step.series == series)
        wanted = self.steps[start].set_up
        if not self.stands_for(self.steps[start]):
            start = next(i for i, step in enumerate(self.steps) if step.set_up == wanted)
        taken = tuple(
            replace(one, rejected=words if one is first else f"series repeated: {words}")
            if self.steps[one.step].series == series and not one.rejected
            else one
            for one in self.taken
        )
        event = {"event": "reject", "index": index, "reason": words}
        return replace(self, position=start, taken=taken, events=(*self.events, event))

    def keep(self, reading: ReadingType, **told: Any) -> Self:
        """Take the reading of the present step; ``told``: what the event says of it besides."""
        step = self.step
        event = {
            "event": "record",
            "signal": list(reading.signal),
            "spread": reading.spread,
            "time": reading.time,
            "series": step.series,
            "step": step.number,
            **told,
        }
        return self.go_on(event, taken=(*self.taken, reading))

    def go_on(self, event: Event, **changes: Any) -> Self:
        """Return the state after an event: at the next step that is still to be done."""
        after = replace(self, events=(*self.events, event), **changes)
        standing = {one.step for one in after.taken if not one.rejected}
        position = self.position + 1
        while position < len(self.steps) and not after._wanted(position, standing):
            position += 1
        return replace(after, position=position)

    def _wanted(self, position: int, standing: set[int]) -> bool:
        """Tell whether a step is still to be done: no reading of it, or of its set-up, stands."""
        step = self.steps[position]
        if step.series:
            return position not in standing
        return any(
            later.series and later.set_up == step.set_up and index not in standing
            for index, later in enumerate(self.steps)
        )


def both_signals(values: Signals, *others: float) -> tuple[float, float]:
    """Return two signals as plain numbers; raise ProcedureError when one is no number."""
    signals = (float(values[0]), float(values[1]))
    if not np.isfinite([*signals, *others]).all():
        raise ProcedureError("the reading is not a number; check cable and amplifier")
    return signals


def time_needed(steps: Iterable[PlannedStep]) -> float:
    """Return the seconds that the steps take a technician."""
    return sum(step.effort for step in steps)


def duration_words(steps: Iterable[PlannedStep]) -> str:
    """Return the time that the steps take a technician, in words."""
    hours, minutes = divmod(math.ceil(time_needed(steps) / 60.0), 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min"


def replay(
    events: Iterable[Event],
    begin: Callable[[Event], ProcedureType],
    deeds: Mapping[str, Callable[[ProcedureType, Event], ProcedureType]],
) -> ProcedureType:
    """Return the procedure that a journal tells; raise ProcedureError where it makes no sense.

    begin: of the first event; deeds: what each further event does, by its name (``reject`` aside).
    """
    procedure: ProcedureType | None = None
    for number, event in enumerate(events, 1):
        try:
            kind = event["event"]
            if (procedure is None) is not (kind == "begin"):
                raise ProcedureError("a journal starts with begin")
            if procedure is None:
                procedure = begin(event)
            elif kind == "reject":
                procedure = procedure.reject(event["index"], event["reason"])
            elif kind in deeds:
                procedure = deeds[kind](procedure, event)
            else:
                raise ProcedureError(f"unknown event {kind!r}")
        except (KeyError, TypeError, ValueError) as error:
            raise ProcedureError(f"line {number} of the journal is not usable: {error}") from error
    if procedure is None:
        raise ProcedureError("the journal is empty")
    return procedure
