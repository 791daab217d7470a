"""A calibration with live readings, without user interface: signals in, journal and record out.

The wizard and the terminal are thin interfaces of a ``LiveSession``: they show its instruction and
its verdict on the newest window, and pass on the operator's decisions. Each type has a session of
its own (``load_cell_session``, ``probe_session``).
"""

from __future__ import annotations

import math
import time
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from rigapp.calibrating.journal import Journal
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.training import Training
from rigapp.calibrating.wiring import wiring_of
from rigapp.config.calibration_settings import CalibrationFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.schema.channels import BASE
from rigapp.texts import say
from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.as_found import as_found
from rigapp_calibration.load_cell.characteristics import CREEP_TIMES
from rigapp_calibration.load_cell.daily import DailyCheck
from rigapp_calibration.records import MALFORMED, Record
from rigapp_calibration.taking.procedure import (
    Event,
    Method,
    Plan,
    Procedure,
    ProcedureError,
    Step,
    StepKind,
    TakenReading,
    begin,
    take_up,
)
from rigapp_calibration.taking.readings import Row
from rigapp_calibration.taking.signals import Readiness, SignalState, SignalWindow


@dataclass(frozen=True, slots=True)
class Rig:
    """Source of the readings: name of the rig, whether it is simulated, operator.

    file: the rig file, if known; test: the open test file, if any.
    """

    name: str
    simulated: bool
    operator: str = ""
    file: Path | None = None
    test: Path | None = None


@dataclass(frozen=True, slots=True)
class NumberTable:
    """Numbers of a result as a table. in_lines: how many of the result's lines hold the same."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    in_lines: int


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """The end of a calibration, or of a daily check.

    kind: of the record. result: as ``--json`` prints it and the record keeps it. lines: the same in
    words and numbers. check: the daily check, which makes no record. saved: the record, if any.
    as_found: result for the record in use until now, plain values and sentences.
    """

    kind: str
    result: Mapping[str, Any]
    lines: tuple[str, ...]
    table: NumberTable | None = None
    always_shown: bool = False
    check: DailyCheck | None = None
    saved: Path | None = None
    as_found: tuple[Mapping[str, Any], tuple[str, ...]] = ({}, ())

    def against(self, former: Record | None) -> Outcome:
        """Return it with the as-found result of a former record, where both can be compared."""
        if former is None or not self.makes_record or former.kind != self.kind:
            return self
        try:
            return replace(self, as_found=as_found(self.kind, former, self.result))
        except MALFORMED:
            return self  # an older record that lacks numbers cannot be compared

    @property
    def changed(self) -> bool:
        """Return whether the former record was off by more than is allowed."""
        return any(change["beyond"] for change in self.as_found[0].get("changes", ()))

    @property
    def accepted(self) -> bool:
        """Return whether nothing blocks it."""
        return bool(self.result["accepted"])

    @property
    def makes_record(self) -> bool:
        """Return whether it is to be saved as a record."""
        return self.accepted and self.check is None


@dataclass(frozen=True, slots=True, eq=False)
class ResidualsSoFar:
    """Residuals of the readings so far from their own fit, for a plot, and the same in words.

    curves: of the two axes or probes, each (x, residual); span: the ends of the x axis; reach:
    limit of the y axis, either way; in the units of the plot.
    """

    curves: tuple[tuple[Array, Array], tuple[Array, Array]]
    span: tuple[float, float]
    reach: float
    words: str


OTHER_KEYS = say("b takes the last one again, r rejects a series, n notes, q closes: ")
NO_CURVES = ((np.empty(0), np.empty(0)), (np.empty(0), np.empty(0)))

WindowType = TypeVar("WindowType", bound=SignalWindow)
PlanType = TypeVar("PlanType", bound=Plan)
FileType = TypeVar("FileType", bound=CalibrationFile)


class LiveSession(ABC, Generic[PlanType, WindowType, FileType]):
    """One calibration under way. Every event is in the journal before the state changes."""

    method: ClassVar[Method[Any]]
    columns: ClassVar[tuple[str, ...]]
    practice: ClassVar[Training]
    prompt: ClassVar[str] = say("Enter records, {}", OTHER_KEYS)
    refused: ClassVar[str] = say(
        "Nothing is saved. Go back, select a wrong reading, reject it with a reason, and"
        " repeat its series. All readings so far stay in the journal."
    )

    def __init__(
        self,
        file: FileType,
        rig: Rig,
        journal: Path,
        plan: PlanType | None,
        *,
        keep_waiting_times: bool = True,
    ) -> None:
        """Begin, or resume from the journal; raise UnusableInput.

        plan: of a new calibration; None to resume only. A journal with events is resumed, and must
        be of the same rig.
        """
        self.settings_file, self.rig = file, rig
        self._patient = keep_waiting_times
        self._since = math.nan
        self._preloaded = math.nan
        self.newest: WindowType | None = None
        self.check_settings()
        self.journal = Journal(journal)
        try:
            self.procedure: Procedure[PlanType] = self._open(plan)
        except (UnusableInput, ValueError) as error:
            self.journal.close()
            raise UnusableInput("{}: {}", journal, error) from error

    def _open(self, plan: PlanType | None) -> Procedure[PlanType]:
        events = self.journal.read()
        if events:
            first = events[0]
            if (first.get("rig"), first.get("simulated")) != (self.rig.name, self.rig.simulated):
                raise UnusableInput(
                    "these readings are from the rig {}, this is {}; name another journal.",
                    repr(first.get("rig")),
                    repr(self.rig.name),
                )
            return take_up(self.method, events)
        if plan is None:
            raise UnusableInput("there are no readings to continue; begin a calibration.")
        procedure = begin(self.method, plan)
        self._write({**procedure.events[0], **self._source()})
        return procedure

    def _source(self) -> dict[str, Any]:
        rig = self.rig
        return {"rig": rig.name, "simulated": rig.simulated, "operator": rig.operator}

    # --- subject ---------------------------------------------------------------------------------

    def check_settings(self) -> None:
        """Raise UnusableInput for settings that do not permit a calibration."""
        return

    @abstractmethod
    def window_of(self, view: Mapping[str, Any]) -> WindowType:
        """Return the window of the engine's answer to ``signals``; SI."""

    @abstractmethod
    def assess(self, window: WindowType, step: Step, since: float, wait: float) -> Readiness:
        """Evaluate a window for a step."""

    def place_of(self, window: WindowType) -> float | None:
        """Return the pin angle or probe of a step by the window; None where the window has none."""
        return None

    @abstractmethod
    def row(self, reading: TakenReading) -> tuple[str | float, ...]:
        """Return a reading by the columns of this calibration, in their units."""

    @abstractmethod
    def used_settings(self) -> FileType:
        """Return the settings with the values found while the readings were taken."""

    @abstractmethod
    def facts(self) -> dict[str, Any]:
        """Return the keys of the plan in the record."""

    @abstractmethod
    def fitted(self) -> Outcome:
        """Fit and check all readings."""

    # --- display ---------------------------------------------------------------------------------

    @abstractmethod
    def expected(self) -> float:
        """Return the expected value at the present step: N, m."""

    @abstractmethod
    def describe(self, reading: TakenReading) -> str:
        """Return the name of a reading that distinguishes it from the others."""

    @abstractmethod
    def cells(self, reading: TakenReading) -> tuple[str, ...]:
        """Return the load, angle or position of a reading, for a table."""

    @abstractmethod
    def live_words(self, readiness: Readiness) -> str:
        """Return the present signals in words."""

    def compared(self, readiness: Readiness) -> Readiness:
        """Return it, or a hint instead if the measured value is implausible."""
        return readiness

    @abstractmethod
    def recorded(self, readiness: Readiness) -> str:
        """Return the values to be recorded, in words."""

    @abstractmethod
    def residuals(self) -> ResidualsSoFar:
        """Fit the readings so far, for the plot."""

    def typed(self, answer: str) -> float | None:
        """Return the value that the operator read off, SI; raise ProcedureError for no number."""
        if answer:
            raise ProcedureError("Enter, b, r, n or q.")
        return None

    @property
    def reference_is_due(self) -> bool:
        """Return whether the step needs an angle reference instead of a reading."""
        procedure = self.procedure
        return not procedure.done and procedure.step.kind is StepKind.ANGLE_REFERENCE

    def look(self, window: WindowType) -> Readiness:
        """Evaluate the newest window for the step under way."""
        newest, procedure = window.newest, self.procedure
        if not procedure.done and not math.isnan(newest):
            before = -math.inf if self.newest is None else self.newest.newest
            if math.isnan(self._since) or newest < before:
                self._since = newest
                self._preloaded = self._preload_time(newest)
        self.newest = window
        if procedure.done:
            readiness = self.assess(window, procedure.steps[-1], math.nan, 0.0)
            return replace(readiness, state=SignalState.WAITING, words="all readings are taken")
        return self.assess(window, procedure.step, self._since, self._wait(procedure.step))

    def _wait(self, step: Step) -> float:
        """Return the seconds that a step waits after the last change."""
        if not self._patient:
            return 0.0
        return step.due - (self._since - self._preloaded) if step.due else step.wait

    def _preload_time(self, newest: float) -> float:
        """Return the device time of the last preload, whose UTC alone is in the journal."""
        started = (self.procedure.told("exercised") or {}).get("time")
        return math.nan if started is None else newest - (time.time() - float(started))

    @property
    def takes_itself(self) -> bool:
        """Return whether the step is read when due, without a command of the operator."""
        procedure = self.procedure
        return self._patient and not procedure.done and procedure.step.due > 0.0

    def changed_at(self, time_s: float) -> None:
        """Set the device time of the last change, known from a simulated operator."""
        self._since = time_s

    # --- actions of the operator -----------------------------------------------------------------

    def take(self, window: WindowType, at: float | None = None) -> None:
        """Take the step under way with a ready window; raise ProcedureError for any other.

        at: value that the operator has read (a micrometer), SI; without it, the step's.
        """
        readiness = self.look(window)
        if not readiness.ready:
            raise ProcedureError("it cannot be recorded now: {}", readiness.words)
        procedure, steadiness, place = self.procedure, readiness.steadiness, self.place_of(window)
        now, kind = round(time.time(), 3), procedure.step.kind
        match kind:
            case StepKind.SET_UP:
                after = procedure.set_up(place)
            case StepKind.PRELOAD:
                after = procedure.exercised(now)
            case StepKind.READING:
                hung = self._in_time(window.newest)
                after = procedure.record(
                    steadiness.mean, steadiness.spread, now, value=at, place=place, hung=hung
                )
            case _:
                raise ProcedureError("the angle reference is entered, not recorded")
        self.adopt(after)
        self._since = window.newest
        if kind is StepKind.PRELOAD:
            self._preloaded = window.newest

    def leave_out(self) -> None:
        """Skip the series under way; raise ProcedureError if it is required."""
        self.adopt(self.procedure.leave_out())

    def _in_time(self, newest: float) -> float:
        """Return the seconds since the preload, for a step due then; in training, as due.

        Begins the series again, and raises ProcedureError, where the step is long overdue.
        """
        due = self.procedure.step.due
        hung = round(newest - self._preloaded, 1) if due and self._patient else due
        if hung <= due * (1.0 + CREEP_TIMES):
            return hung
        self.adopt(self.procedure.again(say("read after {:.0f} s", hung)))
        raise ProcedureError(
            (
                "the load has hung for {:.0f} s instead of {:g} s: take it off, the creep begins"
                " again"
            ),
            hung,
            due,
        )

    def reject(self, index: int, reason: str) -> None:
        """Reject a reading (from 0) with a reason; its series is taken again."""
        self.adopt(self.procedure.reject(index, reason))

    def back(self, reason: str) -> None:
        """Go one step back: the newest reading is taken again."""
        self.adopt(self.procedure.back(reason))

    def note(self, text: str) -> None:
        """Add a remark beside the readings, for record and certificate."""
        self.adopt(self.procedure.note(text))

    def adopt(self, after: Procedure[PlanType]) -> None:
        """Change to the state after an event, once the event is in the journal."""
        self._write(after.events[-1])
        self.procedure = after

    def close(self) -> None:
        """Close the journal; it can be resumed. An empty one is deleted."""
        if len(self.procedure.events) == 1:
            self.journal.path.unlink(missing_ok=True)
        self.journal.close()

    # --- the end ---------------------------------------------------------------------------------

    def judge(self) -> Outcome:
        """Fit and check all readings; nothing is saved. Raises ProcedureError before the end."""
        if not self.procedure.done:
            raise ProcedureError("readings are missing: {}", self.procedure.progress)
        return self.fitted().against(self.former())

    def former(self) -> Record | None:
        """Return the record that the rig file names for this subject, None without one."""
        return None

    def save(self, outcome: Outcome, to: Path) -> Outcome:
        """Seal an accepted outcome in a record; raise UnusableInput."""
        if not outcome.makes_record:
            raise UnusableInput("a calibration that is refused is not saved.")
        refuse_existing(to)
        events = [dict(event) for event in self.procedure.events]
        taken = {**self._source(), **self.facts(), "events": events}
        if self.rig.file is not None:
            taken["wiring"] = wiring_of(read_rig(self.rig.file).record)
        text, settings = self.readings_csv(), self.used_settings()
        as_found = outcome.as_found[0]
        keep_record(to, outcome.kind, text, settings, outcome.result, taken, as_found)
        return replace(outcome, saved=to)

    def rows(self) -> list[Row]:
        """Return the valid readings, as ``read_table`` returns them from the record's CSV.

        The values are those of the CSV, so that the sealed readings give the same result again.
        """
        return [
            (line, dict(zip(self.columns, self.row(reading), strict=True)))
            for line, reading in enumerate(self.procedure.taken, 2)
            if not reading.rejected
        ]

    def readings_csv(self) -> str:
        """Return all readings as the CSV that is sealed, rejected ones as comments."""
        lines = [",".join(self.columns)]
        for reading in self.procedure.taken:
            row, reason = ",".join(map(str, self.row(reading))), " ".join(reading.rejected.split())
            lines.append(f"# rejected ({reason}): {row}" if reason else row)
        return "\n".join(lines) + "\n"

    def _write(self, event: Event) -> None:
        self.journal.append({**event, "written": round(time.time(), 3)})


def window_times(view: Mapping[str, Any]) -> dict[str, Any]:
    """Return the common part of every window in the engine's answer to ``signals``."""
    return {
        "time": np.array(view["end"], dtype=np.float64) / view["sample_rate_Hz"],
        "stands": bool(view["stands"]),
        "noise_share": 1.0 / math.sqrt(view["samples_per_mean"]),
    }


def two_signals(view: Mapping[str, Any], instrument: str) -> Array:
    """Return the two inputs of an instrument from the engine's answer (n, 2)."""
    rows = [view["signals"][name] for name in BASE.names_of(instrument)]
    return np.array(rows, dtype=np.float64).T
