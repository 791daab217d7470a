"""What the engine's threads share: state, the test under way, alarms, and the way to end a test.

Lock order: the core's lock is never held while a device, a file or a viewer is called.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import msgspec

from rigapp.config.channels import channel_table
from rigapp.config.loading import Document
from rigapp.config.recipe import LimitsSection, TestFile
from rigapp.config.rig import RigFile
from rigapp.engine.drive.driving import SpindleControl
from rigapp.engine.drive.timing import Timing
from rigapp.engine.judging import causes
from rigapp.engine.judging.alarms import AlarmBook
from rigapp.engine.judging.causes import Cause
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.publish import (
    AlarmChanged,
    Committed,
    Finished,
    Publisher,
    StateChanged,
)
from rigapp.engine.recording.recorder import Recorder
from rigapp.schema.columns import prediction_columns
from rigapp.schema.loglines import AlarmChange, alarm_line
from rigapp.schema.messages import (
    Alarm,
    Ends,
    Event,
    FinishReason,
    Prediction,
    RunState,
    Severity,
)
from rigapp.schema.states import ACTIVE, Ending, Refused, Trigger, allowed, transition

log = logging.getLogger(__name__)

SLOW_DISK_S = 2.0
"""A commit that takes longer is told; it takes some milliseconds on a sound disk."""

CALM_COMMITS = 20
"""Quick commits in a row after which a disk counts as sound again."""

TRIGGERS = frozenset({"limit", "note"})
"""Kinds of events around which whole cycles are kept, beside every alarm that rises."""

NO_TRIGGERS = frozenset({"cycles_refused", "storage", "file_moved", "file_unsaved"})
"""Alarms that tell nothing of the joint, but of the file."""


@dataclass(slots=True, eq=False)
class Session:
    """One test under way, or the last one.

    steady_from: ordinal of the first whole revolution at the set speed, None while it changes.
    """

    test: Document[TestFile]
    path: Path
    run: TestRun
    recorder: Recorder
    limits: LimitsSection
    operator: str
    started_at: float
    deadline_s: float
    steady_from: int | None = None
    ending: Ending | None = None
    fault_sentence: str = ""
    off: bool = False
    stopping_since: float = 0.0
    stood: bool = False
    finished: bool = False
    outcome: Finished | None = None
    prediction: Prediction | None = None
    prediction_at: float = 0.0
    committed: int = -1
    cycles_refused: int = 0
    triggers_refused: int = 0
    finishing: threading.Lock = field(default_factory=threading.Lock)

    @property
    def target_rpm(self) -> float:
        """Return the set speed."""
        return self.test.record.run.speed_rpm


class Core:
    """The shared heart of the engine; any thread may call it."""

    def __init__(self, rig: Document[RigFile], timing: Timing) -> None:
        self.rig = rig
        self.timing = timing
        self.alarms = AlarmBook(time.time, self._alarm_changed, time.monotonic)
        self.table = channel_table(rig.record)
        self.publisher = Publisher(len(self.table.names), len(prediction_columns()))
        self.session: Session | None = None
        self.control: SpindleControl | None = None
        self.anchor = (time.monotonic_ns(), time.time())
        self._no_limits = LimitsSection()
        self._quick_commits = 0
        self.committing_since = 0.0
        self._state = RunState.IDLE
        self._reason = ""
        self.fault_code = FinishReason.DEVICE
        self._changed = threading.Condition()

    # --- state -----------------------------------------------------------------------------------

    @property
    def state(self) -> RunState:
        """Return the present state."""
        return self._state

    @property
    def reason(self) -> str:
        """Return the sentence that goes with the state."""
        return self._reason

    def fire(self, trigger: Trigger, reason: str = "") -> RunState:
        """Carry out a transition and tell everyone; raise Refused."""
        with self._changed:
            state = self._set(transition(self._state, trigger), reason)
        self._announce(state, reason)
        return state

    def fire_if(self, trigger: Trigger, reason: str = "", only: Iterable[RunState] = ()) -> bool:
        """Carry out a transition when it is possible (and the state is one of ``only``)."""
        with self._changed:
            if not allowed(self._state, trigger) or (only and self._state not in set(only)):
                return False
            state = self._set(transition(self._state, trigger), reason)
        self._announce(state, reason)
        return True

    def wait(self, until: Iterable[RunState], timeout_s: float) -> RunState:
        """Wait for one of some states; raise TimeoutError that names what it waited for."""
        wanted = frozenset(until)
        with self._changed:
            if not self._changed.wait_for(lambda: self._state in wanted, timeout_s):
                names = " or ".join(sorted(wanted))
                raise TimeoutError(
                    f"the engine is still {self._state.value} after {timeout_s:g} s of waiting "
                    f"for {names}"
                )
            return self._state

    def _set(self, state: RunState, reason: str) -> RunState:
        self._state = state
        self._reason = reason
        self._changed.notify_all()
        return state

    def _announce(self, state: RunState, reason: str) -> None:
        self.publisher.notice(StateChanged(state, reason))
        self.event("state", "engine", reason or f"the run is {state.value}", after=state.value)

    # --- events and alarms -----------------------------------------------------------------------

    @property
    def revolution(self) -> int:
        """Return the number of the last revolution recorded."""
        return self.session.run.number if self.session is not None else 0

    @property
    def limits(self) -> LimitsSection:
        """Return the limits in force: those of the test, or the defaults without one."""
        return self.session.limits if self.session is not None else self._no_limits

    def event(
        self,
        kind: str,
        source: str,
        text: str,
        before: str = "",
        after: str = "",
        *,
        key: str = "",
        level: str = "information",
        data: msgspec.Struct | None = None,
    ) -> bool:
        """Write to the log of the test under way and show it to every viewer.

        key: what the line is about. level: how bad it is. data: what programs read of it. False
        when the log has no room for it.
        """
        details = msgspec.to_builtins(data) if data is not None else {}
        return self._write(
            Event(
                time.time(), self.revolution, kind, source, text, before, after,
                key=key, level=level, data=details,
            )
        )  # fmt: skip

    def _write(self, event: Event) -> bool:
        _log(event)
        session, kept = self.session, True
        if session is not None:
            try:
                kept = session.recorder.event(event)
                if event.kind in TRIGGERS:
                    session.recorder.trigger(critical=False)
            except Exception as error:
                self.storage_failed(error)
        self.publisher.event(event)
        return kept

    def gap(self, text: str) -> None:
        """Write an interruption of the data to the log, and count it."""
        event = Event(time.time(), self.revolution, "gap", "engine", text, level="warning")
        _log(event)
        if self.session is not None:
            self.session.recorder.gap(event)
        self.publisher.event(event)

    def _alarm_changed(self, alarm: Alarm, change: AlarmChange, who: str) -> None:
        self.publisher.notice(AlarmChanged(alarm))
        raised = change.what == "raised"
        if raised and self.session is not None and alarm.key not in NO_TRIGGERS:
            self.session.recorder.trigger(critical=alarm.severity is Severity.CRITICAL)
        self._write(alarm_line(time.time(), self.revolution, who, alarm, change))

    def warn(self, cause: Cause) -> None:
        """Raise an alarm that does nothing else."""
        self.alarms.raise_alarm(cause, self.revolution)

    # --- ending a test ---------------------------------------------------------------------------

    def trip(self, ending: Ending, cause: Cause | None = None) -> bool:
        """End the test under way: the drive is commanded before this returns. True for the first.

        Without a test, a fault leads to the state fault and the power is taken off.
        """
        first, command = False, False
        announce: RunState | None = None
        with self._changed:
            session = self.session
            if self._state in ACTIVE and session is not None:
                first = session.ending is None
                if first:
                    session.ending = ending
                    session.stopping_since = time.monotonic()
                    announce = self._set(transition(self._state, Trigger.STOP), ending.sentence)
                elif session.ending is not None and ending.fault > session.ending.fault:
                    session.fault_sentence = session.fault_sentence or ending.sentence
                command = first or (ending.off and not session.off)
                session.off |= ending.off
            elif (
                ending.fault
                and self._state is not RunState.FAULT
                and allowed(self._state, Trigger.FAILED)
            ):
                announce = self._set(RunState.FAULT, ending.sentence)
                self.fault_code = ending.code
                command = True
        control = self.control
        if first and cause is not None:
            self.alarms.claim_first_out(cause)
        if command and control is not None:
            control.stop_now(off=ending.off or session is None or session.ending is None)
        if cause is not None:
            self.alarms.raise_alarm(cause, self.revolution)
        if announce is not None:
            self._announce(announce, ending.sentence)
        return first

    def storage_failed(self, error: BaseException) -> None:
        """End the test because its file cannot be written."""
        session = self.session
        name = str(session.path) if session is not None else "the file"
        sentence = str(error) if name in str(error) else f"{name}: {error}"
        if self.alarms.is_active("storage"):
            return
        self.trip(Ending(FinishReason.STORAGE, sentence), causes.storage_failed(sentence))

    def stood(self, witnesses: str, how: str) -> None:
        """Take note that the spindle stands; the file can be finished."""
        session = self.session
        if session is None or session.stood:
            return
        self.event("stopped", "drive", f"the spindle stands {how}; seen by {witnesses}")
        session.stood = True

    def will_not_stop(self, sentence: str) -> None:
        """Take note that the spindle could not be shown to stand."""
        session = self.session
        self.alarms.raise_alarm(causes.will_not_stop(sentence), self.revolution)
        if session is None or session.stood:
            return
        session.fault_sentence = session.fault_sentence or sentence
        session.stood = True

    # --- the file --------------------------------------------------------------------------------

    def place(self) -> None:
        """Put what waits in memory into the file, without making it safe."""
        session = self.session
        if session is None or session.finished:
            return
        try:
            session.recorder.place()
        except Exception as error:
            if not session.finished:
                self.storage_failed(error)

    def commit(self) -> None:
        """Make the rows so far safe and announce them."""
        session = self.session
        if session is None or session.finished:
            return
        self.committing_since = time.monotonic()
        try:
            safe = session.recorder.commit()
        except Exception as error:
            if not session.finished:
                self.storage_failed(error)
            return
        finally:
            took, self.committing_since = time.monotonic() - self.committing_since, 0.0
        self._look_at_disk(took)
        if safe != session.committed:
            session.committed = safe
            self.publisher.notice(Committed(safe))
        refused = session.recorder.cycles_refused
        if refused != session.cycles_refused:
            session.cycles_refused = refused
            self.warn(causes.cycles_refused(refused))
        triggers = session.recorder.triggers_refused
        if triggers and not session.triggers_refused:
            self.event(
                "cycles",
                "engine",
                "the room for whole cycles around alarms, limits and notes is used up: from here "
                "on only those of the schedule are kept, and those around critical alarms while "
                "room lasts",
            )
        session.triggers_refused = triggers

    def look_after_file(self) -> None:
        """Give the file of the test its name back when it was deleted, moved or replaced."""
        session = self.session
        if session is None or session.finished:
            return
        try:
            found = session.recorder.look_after(lambda what: self.warn(causes.file_moved(what)))
        except Exception as error:
            if not session.finished:
                self.storage_failed(error)
            return
        session.path = session.recorder.path
        if found is not None and not found.saved:
            self.warn(causes.file_unsaved(found.sentence))
            return
        self.alarms.clear("file_unsaved")
        if found is not None:
            self.warn(causes.file_moved(found.sentence))
        self.alarms.clear("file_moved")

    def disk_slow(self, seconds: float) -> None:
        """Warn of a disk that takes long over a commit."""
        self._quick_commits = 0
        self.warn(causes.disk_slow(seconds))

    def _look_at_disk(self, took: float) -> None:
        if took > SLOW_DISK_S:
            self.disk_slow(took)
            self.event("disk", "engine", f"the disk took {took:.1f} s over a commit")
            return
        self._quick_commits += 1
        if self._quick_commits == CALM_COMMITS:
            self.alarms.clear("disk_slow")

    @property
    def finish_due(self) -> bool:
        """Tell whether a test waits for its file to be finished."""
        session = self.session
        return session is not None and session.stood and not session.finished

    def finish(self) -> None:
        """Finish the file of a test whose spindle stands, and reach stopped or fault."""
        session = self.session
        if session is None or not session.stood:
            return
        with session.finishing:
            if session.finished:
                return
            ending = session.ending or Ending(FinishReason.INTERNAL, "the test ended by itself")
            then = session.fault_sentence
            if then and then not in ending.sentence:
                ending = replace(ending, sentence=f"{ending.sentence} Then: {then}")
            self.look_after_file()
            ending = self._close_file(session, ending)
            session.path = session.recorder.path
            fault = ending.fault or bool(then)
            sentence = ending.sentence
            rows = session.recorder.committed
            session.finished = True
            if rows != session.committed:
                session.committed = rows
                self.publisher.notice(Committed(rows))
            outcome = Finished(ending.code, sentence, ending.status, rows, str(session.path))
            session.outcome = outcome
        self.settle()
        self.fault_code = ending.code
        self.fire_if(Trigger.FAILED if fault else Trigger.ENDED, sentence)
        self.publisher.notice(outcome)

    def _close_file(self, session: Session, ending: Ending) -> Ending:
        recorder = session.recorder
        if ending.code is FinishReason.STORAGE:
            try:
                recorder.finish(ending.status, ending.code.value, ending.sentence)
            except Exception:
                recorder.abandon()
            return ending
        try:
            recorder.finish(ending.status, ending.code.value, ending.sentence)
        except Exception as error:
            recorder.abandon()
            sentence = f"{ending.sentence} The file could not be finished: {error}"
            self.alarms.raise_alarm(causes.storage_failed(sentence), self.revolution)
            return Ending(FinishReason.STORAGE, sentence)
        return ending

    def settle(self) -> None:
        """Clear alarms whose condition is over because the test is."""
        self.alarms.clear_ended_by(Ends.TEST)

    # --- time ------------------------------------------------------------------------------------

    def utc(self, host_time_ns: int, later_s: float) -> float:
        """Return UTC seconds of a monotonic time, less ``later_s`` in a rig in real time."""
        ns, seconds = self.anchor
        if self.rig.record.simulation is not None:
            later_s = 0.0
        return seconds + (host_time_ns - ns) * 1e-9 - later_s

    def anchor_time(self) -> float:
        """Tie the monotonic clock to UTC anew; return the seconds by which UTC has jumped."""
        now = (time.monotonic_ns(), time.time())
        jump = now[1] - self.utc(now[0], 0.0)
        self.anchor = now
        return jump

    def require(self, condition: bool, sentence: str) -> None:
        """Raise Refused unless a condition holds."""
        if not condition:
            raise Refused(sentence)


def _log(event: Event) -> None:
    """Repeat a line of the test's log in the program's, but for what drivers have logged there."""
    if event.kind != "device":
        log.info(
            "revolution %d, %s by %s: %s", event.revolution, event.kind, event.source, event.text
        )
