"""State shared by the engine's threads: run state, active test, alarms; and the end of a test.

Lock order: no device, file or viewer is called while the core's lock is held.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import msgspec

from rigapp.config.channels import channel_table
from rigapp.config.loading import Document
from rigapp.config.recipe import LimitsSection
from rigapp.config.rig import RigFile
from rigapp.engine.activetest import ActiveTest
from rigapp.engine.drive.driving import RestApproach, SpindleControl
from rigapp.engine.drive.timing import Timing
from rigapp.engine.judging.alarms import AlarmBook
from rigapp.engine.judging.testrun import Row
from rigapp.engine.publish import Publisher
from rigapp.engine.recording.recorder import cycle_message, measured_history
from rigapp.process.awake import StayAwake
from rigapp.schema.alarms import Cause, kind_of, make_alarm
from rigapp.schema.details import error_text
from rigapp.schema.loglines import AlarmChange, alarm_line
from rigapp.schema.messages import (
    Alarm,
    Ends,
    Event,
    FinishReason,
    Flag,
    RevolutionMeasured,
    RunState,
    Severity,
)
from rigapp.schema.notices import AlarmChanged, Committed, Finished, StateChanged
from rigapp.schema.states import ACTIVE, Ending, Refused, Trigger, allowed, transition
from rigapp.schema.wire import tree_of
from rigapp.texts import joined, say

log = logging.getLogger(__name__)

SLOW_DISK_S = 2.0
"""Duration from which a commit is reported; it takes some milliseconds on a healthy disk."""

CALM_COMMITS = 20
"""Consecutive fast commits after which the alarm of a slow disk is cleared."""

BETWEEN_STEPS = ACTIVE - {RunState.STOPPING}
"""States of a change of step."""

TRIGGERS = frozenset({"limit", "note"})
"""Kinds of events, besides raised alarms, around which complete cycles are stored."""

NO_FILE = say("No revolution was made, so no file is left.")
"""Reported at the end of a test that failed at its start."""

TOGETHER_NS = 10_000_000
"""Longest time between reading two clocks at once: the accuracy of the relation to UTC."""

UNTRUE = Flag.PAUSED | Flag.PARTIAL | Flag.TIME_JUMP
"""Revolutions with one of these flags are not passed to the prediction."""


class Core:
    """State shared by the engine's threads; thread-safe.

    on_measured: called with each valid revolution; must not block. awake: see ``Engine``.
    """

    def __init__(
        self,
        rig: Document[RigFile],
        timing: Timing,
        on_measured: Callable[[RevolutionMeasured], None] | None = None,
        awake: StayAwake | None = None,
    ) -> None:
        self.rig = rig
        self.awake = awake
        self.timing = timing
        self.alarms = AlarmBook(time.time, self._alarm_changed, time.monotonic)
        self.table = channel_table(rig.record)
        self.publisher = Publisher(self.table.units)
        self.test: ActiveTest | None = None
        self._on_measured = on_measured
        self.control: SpindleControl | None = None
        self.anchor = _both_clocks()
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
        """Return the reason of the present state, as text."""
        return self._reason

    def fire(self, trigger: Trigger, reason: str = "") -> RunState:
        """Perform a transition and publish it; raise Refused."""
        with self._changed:
            state = self._set(transition(self._state, trigger), reason)
        self._announce(state, reason)
        return state

    def fire_if(self, trigger: Trigger, reason: str = "", only: Iterable[RunState] = ()) -> bool:
        """Perform a transition if it is possible (and the state is one of ``only``)."""
        with self._changed:
            if not allowed(self._state, trigger) or (only and self._state not in set(only)):
                return False
            state = self._set(transition(self._state, trigger), reason)
        self._announce(state, reason)
        return True

    def wait(self, until: Iterable[RunState], timeout_s: float) -> RunState:
        """Wait for one of the states; raise TimeoutError, which names them."""
        states = frozenset(until)
        with self._changed:
            if not self._changed.wait_for(lambda: self._state in states, timeout_s):
                names = joined(say(" or "), sorted(states))
                raise TimeoutError(
                    say(
                        "the engine is still {} after {:g} s of waiting for {}",
                        self._state,
                        timeout_s,
                        names,
                    )
                )
            return self._state

    def _set(self, state: RunState, reason: str) -> RunState:
        self._state = state
        self._reason = reason
        self._changed.notify_all()
        return state

    def republish(self, reason: str) -> None:
        """Publish the state again, with another reason."""
        self._announce(self._state, reason)

    def _announce(self, state: RunState, reason: str) -> None:
        resting = self.test is not None and self.test.resting is not None
        self.publisher.notice(StateChanged(state, reason, resting))
        if self.test is None or self.test.logs_steps or state not in BETWEEN_STEPS:
            self.event("state", "engine", reason or say("the run is {}", state), after=state.value)

    # --- events and alarms -----------------------------------------------------------------------

    @property
    def revolution(self) -> int:
        """Return the number of the last revolution recorded."""
        return self.test.run.number if self.test is not None else 0

    @property
    def limits(self) -> LimitsSection:
        """Return the present limits: those of the test, or the defaults without one."""
        return self.test.limits if self.test is not None else self._no_limits

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
        """Write to the log of the active test and to that of the program.

        key: subject of the line. level: its severity. data: its machine-readable content. Returns
        False if the log is full.
        """
        details = tree_of(data) if data is not None else {}
        return self._write(
            Event(
                time.time(), self.revolution, kind, source, text, before, after,
                key=key, level=level, data=details,
            )
        )  # fmt: skip

    def _write(self, event: Event) -> bool:
        _log(event)
        test, logged = self.test, True
        if test is not None:
            try:
                logged = test.recorder.event(event)
                if event.kind in TRIGGERS:
                    test.recorder.trigger(critical=False)
            except Exception as error:
                self.storage_failed(error)
        return logged

    def note_limit(self, cause: Cause) -> None:
        """Log an exceeded limit, without any other action."""
        level = cause.kind.severity.value
        self.event("limit", "limits", cause.sentence, key=cause.key, level=level)

    def _alarm_changed(self, alarm: Alarm, change: AlarmChange, who: str) -> None:
        self.publisher.notice(AlarmChanged(alarm))
        kind = kind_of(alarm.key)
        if (
            change.what == "raised"
            and self.test is not None
            and (kind is None or kind.keeps_cycles)
        ):
            self.test.recorder.trigger(critical=alarm.severity is Severity.CRITICAL)
        self._write(alarm_line(time.time(), self.revolution, who, alarm, change))

    def warn(self, cause: Cause) -> None:
        """Raise an alarm without any other action."""
        self.alarms.raise_alarm(cause, self.revolution)

    def act_on(self, cause: Cause, off: bool = False) -> None:
        """Raise an alarm and perform the action of its kind; off: always with power off."""
        kind = cause.kind
        if kind.stop is None:
            self.warn(cause)
        else:
            self.trip(Ending(kind.stop, cause.sentence, off or kind.off), cause)

    # --- ending a test ---------------------------------------------------------------------------

    def trip(self, ending: Ending, cause: Cause | None = None) -> bool:
        """End the active test; return True for its first end.

        The drive is commanded before this returns. Without a test, a fault leads to the state fault
        and power off.
        """
        first = command = under_way = False
        approach: RestApproach | None = None
        announce: RunState | None = None
        with self._changed:
            test = self.test
            if self._state in ACTIVE and test is not None:
                under_way, first = True, test.ending is None
                command = test.end(ending)
                if first:
                    approach = test.approach if ending.regular else None
                    announce = self._set(transition(self._state, Trigger.STOP), ending.sentence)
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
            control.stop_now(off=ending.off or not under_way, approach=approach)
        if cause is not None:
            self.warn(cause)
        if announce is not None:
            self._announce(announce, ending.sentence)
        return first

    def storage_failed(self, error: BaseException) -> None:
        """End the test because its file cannot be written."""
        name = str(self.test.path) if self.test is not None else say("the file")
        if not self.alarms.is_active("storage"):
            why = error_text(error, say("it cannot be written"))
            sentence = why if name in why else say("{}: {}", name, why)
            self.act_on(make_alarm("storage", sentence=sentence))

    def reached_standstill(self, witnesses: str, how: str) -> None:
        """Record that the spindle is stationary; the file can be finished."""
        if self.test is not None and not self.test.reached_standstill:
            how = say("the spindle is stationary {}; confirmed by {}", how, witnesses)
            self.event("stopped", "drive", how)
            self.test.reached_standstill = True

    def stop_without_effect(self, drive: str) -> None:
        """Warn that the crank still turns although the drive has confirmed the power-off."""
        sentence = say(
            "{} confirmed the power-off, but the crank still turns. Its watchdog will stop it.",
            drive,
        )
        self.warn(make_alarm("will_not_stop", sentence=sentence))
        if self.test is not None and not self.test.reached_standstill:
            self.test.fault_sentence = self.test.fault_sentence or sentence

    def stop_unseen(self, drive: str) -> None:
        """Warn that the standstill of the spindle is reported by the drive only."""
        cause = make_alarm("stop_unseen", drive=drive)
        self.warn(cause)
        if self.test is not None and not self.test.reached_standstill:
            self.test.fault_sentence = self.test.fault_sentence or cause.sentence

    def will_not_stop(self, sentence: str) -> None:
        """End a stop without a confirmed standstill of the spindle."""
        self.warn(make_alarm("will_not_stop", sentence=sentence))
        if self.test is not None and not self.test.reached_standstill:
            self.test.fault_sentence = self.test.fault_sentence or sentence
            self.test.reached_standstill = True

    # --- the file --------------------------------------------------------------------------------

    @contextmanager
    def _filing(self) -> Iterator[ActiveTest | None]:
        """Yield the test with an open file, or None; a failure inside the block ends the test."""
        test = self.test
        if test is None or test.finished:
            yield None
            return
        try:
            yield test
        except Exception as error:
            if not test.finished:
                self.storage_failed(error)

    def record(self, row: Row) -> None:
        """Store an evaluated revolution of the active test, then publish it."""
        stored = None
        with self._filing() as test:
            if test is not None:
                self._store(test, row)
            stored = test
        if stored is None:
            return
        self.publisher.row(row.values, lambda: cycle_message(row.number, row.measured))
        if self._on_measured is None or row.measured.revolution.flags & UNTRUE:
            return
        try:
            self._on_measured(measured_history(row.number, row.measured, row.named))
        except Exception as error:
            self.event("twin", "engine", say("the prediction was not requested ‹{}›", repr(error)))
            self._on_measured = None

    def _store(self, test: ActiveTest, row: Row) -> None:
        """Write a row, and an interruption of the data before it, if any."""
        revolution = row.measured.revolution
        test.recorder.row(row.number, row.values, row.measured)
        test.revolution_at = time.monotonic()
        if revolution.flags & Flag.GAP_BEFORE:
            lost = revolution.lost_samples
            self._gap(
                test, say("samples are missing before revolution {}: {} lost", row.number, lost)
            )

    def gap(self, text: str) -> None:
        """Write an interruption of the data to the file, and count it."""
        with self._filing() as test:
            if test is not None:
                self._gap(test, text)

    def _gap(self, test: ActiveTest, text: str) -> None:
        event = Event(time.time(), self.revolution, "gap", "engine", text, level="warning")
        _log(event)
        test.recorder.gap(event)

    def place(self) -> None:
        """Write queued data to the file, without a commit."""
        with self._filing() as test:
            if test is not None:
                test.recorder.place()

    def commit(self) -> None:
        """Commit the rows so far and publish their number."""
        with self._filing() as test:
            if test is None:
                return
            self.committing_since = time.monotonic()
            try:
                committed = test.recorder.commit()
            finally:
                duration_s, self.committing_since = time.monotonic() - self.committing_since, 0.0
            self._check_disk(duration_s)
            self._publish_committed(test, committed)
            refused = test.recorder.cycles_refused
            if refused != test.cycles_refused:
                test.cycles_refused = refused
                self.warn(make_alarm("cycles_refused", number=refused))
            triggers = test.recorder.triggers_refused
            if triggers and not test.triggers_refused:
                self.event(
                    "cycles",
                    "engine",
                    say(
                        "Reserved space for triggered cycles is full. Only scheduled cycles"
                        " and those around critical alarms are stored from here on"
                    ),
                )
            test.triggers_refused = triggers

    def _publish_committed(self, test: ActiveTest, rows: int) -> None:
        if rows != test.committed:
            test.committed = rows
            self.publisher.notice(Committed(rows))

    def restore_file(self) -> None:
        """Restore the path of the test's file if it was deleted, moved or replaced."""
        with self._filing() as test:
            if test is None:
                return
            report = test.recorder.watch_path(self._file_moved)
            test.path = test.recorder.path
            if report is not None and not report.saved:
                self.warn(make_alarm("file_unsaved", sentence=report.sentence))
                return
            self.alarms.clear("file_unsaved")
            if report is not None:
                self._file_moved(report.sentence)
            self.alarms.clear("file_moved")

    def _file_moved(self, sentence: str) -> None:
        self.warn(make_alarm("file_moved", sentence=sentence))

    def disk_slow(self, seconds: float) -> None:
        """Warn of a slow commit."""
        self._quick_commits = 0
        self.warn(make_alarm("disk_slow", seconds=seconds))

    def _check_disk(self, duration_s: float) -> None:
        if duration_s > SLOW_DISK_S:
            self.disk_slow(duration_s)
            self.event("disk", "engine", say("the disk took {:.1f} s over a commit", duration_s))
            return
        self._quick_commits += 1
        if self._quick_commits == CALM_COMMITS:
            self.alarms.clear("disk_slow")

    @property
    def finish_due(self) -> bool:
        """Return whether the file of a test can be finished."""
        return self.test is not None and self.test.reached_standstill and not self.test.finished

    def finish(self) -> None:
        """Finish the file of a test with a stationary spindle; set the state stopped or fault."""
        test = self.test
        if test is None or not test.reached_standstill:
            return
        with test.finishing:
            if test.finished:
                return
            ending = test.ending or Ending(FinishReason.INTERNAL, say("the test ended by itself"))
            then = test.fault_sentence
            if then and then not in ending.sentence:
                ending = replace(ending, sentence=say("{} Then: {}", ending.sentence, then))
            self.restore_file()
            ending = self._close_file(test, ending)
            test.path = test.recorder.path
            fault, rows = ending.fault or bool(then), test.recorder.committed
            test.finished = True
            self._publish_committed(test, rows)
            outcome = Finished(ending.code, ending.sentence, ending.status, rows, str(test.path))
            test.outcome = outcome
        self.settle()
        self.sleep_again()
        self.fault_code = ending.code
        self.fire_if(Trigger.FAILED if fault else Trigger.ENDED, ending.sentence)
        self.publisher.notice(outcome)

    def _close_file(self, test: ActiveTest, ending: Ending) -> Ending:
        """Finish a file and return the end of the test, which is of the file if that fails.

        A file created by this start is deleted after a fault before the first complete revolution.
        """
        recorder, keep_empty = test.recorder, not (test.fresh and ending.fault)
        try:
            file_exists = recorder.finish(
                ending.status, ending.code.value, ending.sentence, keep_empty=keep_empty
            )
        except Exception as error:
            recorder.abandon()
            if ending.code is FinishReason.STORAGE:
                return ending
            sentence = say("{} The file could not be finished ‹{}›.", ending.sentence, error)
            self.warn(make_alarm("storage", sentence=sentence))
            return Ending(FinishReason.STORAGE, sentence)
        if file_exists:
            return ending
        return replace(ending, sentence=say("{} {}", ending.sentence, NO_FILE))

    def sleep_again(self) -> None:
        """Allow the computer to sleep again."""
        if self.awake is not None:
            self.awake.end()

    def settle(self) -> None:
        """Clear alarms whose condition ends with the test."""
        self.alarms.clear_ended_by(Ends.TEST)

    # --- time ------------------------------------------------------------------------------------

    def utc(self, host_time_ns: int, later_s: float) -> float:
        """Return UTC seconds of a monotonic time, less ``later_s`` in a rig in real time."""
        ns, seconds = self.anchor
        if self.rig.record.simulated_samples:
            later_s = 0.0
        return seconds + (host_time_ns - ns) * 1e-9 - later_s

    def clock_jump(self) -> float:
        """Return the jump of UTC since it was related to the monotonic clock, s."""
        ns, seconds = _both_clocks()
        return seconds - self.utc(ns, 0.0)

    def anchor_time(self) -> None:
        """Relate the monotonic clock to UTC again."""
        self.anchor = _both_clocks()

    def require(self, condition: bool, sentence: str) -> None:
        """Raise Refused unless a condition holds."""
        if not condition:
            raise Refused(sentence)


def _both_clocks() -> tuple[int, float]:
    """Return the monotonic clock in ns and UTC in s, read at once.

    Retried if the program was suspended in between, which would look like a change of the clock.
    """
    while True:
        ns, seconds = time.monotonic_ns(), time.time()
        if time.monotonic_ns() - ns < TOGETHER_NS:
            return ns, seconds


def _log(event: Event) -> None:
    """Copy a line of the test's log to the program's, except for those logged by drivers."""
    if event.kind != "device":
        log.info(
            "revolution %d, %s by %s: %s", event.revolution, event.kind, event.source, event.text
        )
