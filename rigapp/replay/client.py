"""Play a recorded test as if it ran: with the same snapshots for the same window.

A snapshot of a replay holds the number of its rows in the file instead of the rows: the window
reads from the file what it draws, so that a seek over 10^7 rows costs as much as one over ten.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import LimitsSection
from rigapp.engine.judging.limits import RuleMonitor, changed_limits, least_margin
from rigapp.replay.messages import newest_messages, profile_message, recipe_of
from rigapp.schema.channels import BASE
from rigapp.schema.loglines import (
    ALARM,
    LIMIT_CHANGED,
    AlarmChange,
    alarm_change,
    limit_change,
    severity_of,
)
from rigapp.schema.messages import (
    NO_TEST,
    NOT_STEADY,
    Alarm,
    Cycle,
    EngineStatus,
    Event,
    Prediction,
    Reply,
    RigStatus,
    RunState,
    Snapshot,
    Status,
    TestStatus,
    WornProfile,
)
from rigapp.schema.rownumbers import RowNumbers
from rigapp.service.client import merged
from rigapp.storage import TestReader, logged_sentence, open_test, row_numbers
from rigapp.texts import say, sentence_of_error


class RecordedAlarms:
    """Rebuild the alarm list and the limits as they were after a revolution."""

    def __init__(self, events: Sequence[Event], limits: LimitsSection | None) -> None:
        self._events = [e for e in events if e.kind in (ALARM, LIMIT_CHANGED)]
        self._revolutions = np.array([e.revolution for e in self._events], dtype=np.int64)
        self._first_limits = limits
        self._count = -1
        self._alarms: tuple[Alarm, ...] = ()
        self._limits = limits
        self._monitor: RuleMonitor | None = None

    def alarms(self, revolution: int) -> tuple[Alarm, ...]:
        """Return the alarms on the list when a revolution was the last recorded one."""
        self._go_to(revolution)
        return self._alarms

    def margin(self, revolution: int, values: Mapping[str, float]) -> tuple[float, str]:
        """Return the least distance to a limit in percent, and its name; NaN without limits.

        values: the columns of the revolution's row.
        """
        self._go_to(revolution)
        evaluated = not int(values.get("quality", 0)) & NOT_STEADY
        if self._limits is None or self._monitor is None or not evaluated:
            return math.nan, ""
        worst, name = least_margin(self._monitor, self._limits, values)
        return (worst, name) if math.isfinite(worst) else (math.nan, "")

    def _go_to(self, revolution: int) -> None:
        count = int(np.searchsorted(self._revolutions, revolution, side="right"))
        if count == self._count:
            return
        self._count = count
        listed: dict[str, Alarm] = {}
        limits = self._first_limits
        for event in self._events[:count]:
            if event.kind == ALARM:
                _apply(listed, event)
            elif limits is not None:
                limits = _changed(limits, event)
        self._alarms = tuple(listed.values())
        self._limits = limits
        self._monitor = _monitor(limits)


def _apply(listed: dict[str, Alarm], event: Event) -> None:
    """Apply one line of the log to the list of alarms, by key."""
    change = alarm_change(event)
    if change is None:
        return
    if not change.listed:
        listed.pop(event.key, None)
    elif change.what == "raised":
        before = listed.get(event.key)
        first_out = change.first_out or (before is not None and before.first_out)
        listed[event.key] = _raised(change, event, first_out)
    elif event.key in listed:
        listed[event.key] = msgspec.structs.replace(
            listed[event.key],
            active=change.active,
            acknowledged=change.acknowledged,
            state=event.after or listed[event.key].state,
        )


def _raised(change: AlarmChange, event: Event, first_out: bool) -> Alarm:
    return Alarm(
        key=event.key,
        severity=severity_of(event),
        title=change.title,
        cause=change.cause,
        consequence=change.consequence,
        action=change.action,
        raised_at=event.time,
        revolution=event.revolution,
        first_out=first_out,
        state=event.after or "unacknowledged",
        ends=change.ends,
        value=change.value,
    )


def _monitor(limits: LimitsSection | None) -> RuleMonitor | None:
    """Return the monitor of rules; None when the log's changes do not make usable rules."""
    try:
        return RuleMonitor(limits.rule) if limits is not None else None
    except UnusableInput:
        return None


def _changed(limits: LimitsSection, event: Event) -> LimitsSection:
    change = limit_change(event)
    if change is None:
        return limits
    try:
        return changed_limits(limits, event.key, change.after)[1]
    except UnusableInput:
        return limits


PERIOD_S = 0.1  # as often as the screen draws trends
RESIDUAL = "residual_rms"


@dataclass(frozen=True, slots=True)
class Recording:
    """Data of a recorded test that a replay needs at once; columns: name -> unit in a row.

    rows, predictions: the revolution of each.
    """

    columns: dict[str, str]
    rows: RowNumbers
    predictions: RowNumbers
    cycle_revolutions: NDArray[np.int64]
    rpm: float
    status: Status
    profiles: dict[str, NDArray[Any]]
    alarms: RecordedAlarms


class ReplayClient:
    """Replay a recorded test with an engine's interface: pause, resume, stop, speed and seek.

    A thread reads the file and keeps one snapshot ready, with all data not fetched yet.
    """

    is_replay = True
    operator = ""

    def __init__(self, path: Path, *, speed: float = 10.0, at_end: bool = False) -> None:
        """Open a recorded test; raise UnusableInput. at_end: begin with everything shown."""
        self._path = path
        self._test = open_test(path)
        self._recording = read_recording(self._test)
        self._lock = threading.Lock()
        self._ready: Snapshot | None = None
        self._speed = speed
        self._row = float(len(self._recording.rows)) if at_end else 0.0
        self._wanted: float | None = None
        self._sent = self._predicted = 0
        self._shown_cycle = self._shown_profile = -1
        self._state = RunState.RUNNING
        self._reason = ""
        self._stop, self._wake = threading.Event(), threading.Event()
        self._takes = 0
        self._advance(0.0)
        self._prepare()
        self._thread = threading.Thread(target=self._play, name="gui-replay", daemon=True)
        self._thread.start()

    @property
    def last_recorded(self) -> int:
        """Return the last revolution of the test."""
        rows = self._recording.rows
        return int(rows[-1]) if len(rows) else 0

    def poll(self) -> Snapshot | None:
        """Return what is new since the last poll, or None; never waits."""
        if not self._lock.acquire(blocking=False):
            return None
        try:
            snapshot, self._ready = self._ready, None
        finally:
            self._lock.release()
        return snapshot

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 5.0
    ) -> Reply:
        """Pause, resume, stop, change the speed, or seek a revolution; all else is refused."""
        arguments = arguments or {}
        if verb == "pause":
            self._state = RunState.PAUSED
        elif verb == "resume":
            self._state = RunState.RUNNING
        elif verb == "stop":
            self._state = RunState.STOPPED
        elif verb == "replay":
            self._speed = max(0.0, float(arguments["speed"]))
        elif verb == "rewind":
            self._state, self._wanted = RunState.RUNNING, 0.0
        elif verb == "seek":
            rows = self._recording.rows
            self._wanted = float(rows.searchsorted(float(arguments["revolution"]), "right"))
            self._wake.set()
        elif verb == "status":
            return Reply(ok=True, result=self._status(self._sent).tree())
        else:
            return Reply(ok=False, sentence=say("This is a replay; {} needs a rig.", repr(verb)))
        return Reply(ok=True)

    def close(self) -> None:
        """End the replay."""
        self._stop.set()
        self._wake.set()
        self._thread.join(timeout=2.0)
        self._test.close()

    def _play(self) -> None:
        last = time.monotonic()
        while True:
            now = time.monotonic()
            self._leap()
            self._advance(now - last)
            last = now
            try:
                self._prepare()
            except UnusableInput as error:  # a damaged cycle; rows and the other cycles continue
                self._reason = sentence_of_error(error)
            self._wake.wait(PERIOD_S)
            self._wake.clear()
            if self._stop.is_set():
                return

    def _leap(self) -> None:
        wanted, self._wanted = self._wanted, None
        if wanted is None:
            return
        if self._state is RunState.STOPPED:
            self._state = RunState.PAUSED
        self._reason = ""
        self._row = wanted
        self._shown_cycle = self._shown_profile = -1
        if wanted < self._sent:
            self._takes += 1
            with self._lock:
                self._ready = None

    def _advance(self, elapsed_s: float) -> None:
        end = len(self._recording.rows)
        if self._state is RunState.RUNNING:
            self._row = min(end, self._row + self._speed * elapsed_s * self._recording.rpm / 60.0)
            if self._row >= end:
                self._state = RunState.STOPPED
                self._reason = say(
                    "end of the replay; the test: {}", self._recording.status.engine.reason
                )

    def _prepare(self) -> None:
        done = int(self._row)
        until = self._recording.rows[done - 1] if done else 0.0
        self._sent, self._predicted = done, self._recording.predictions.searchsorted(until, "right")
        cycle, prediction = self._newest_cycle(until)
        snapshot = Snapshot(
            status=self._status(done),
            first_row=done,
            rows=b"",
            predictions=b"",
            cycle=cycle,
            prediction=prediction,
            profile=self._newest_profile(until),
            columns=self._recording.columns,
            recorded=done,
        )
        with self._lock:
            self._ready = snapshot if self._ready is None else merged((self._ready, snapshot))

    def _newest_cycle(self, until: float) -> tuple[Cycle | None, Prediction | None]:
        index = int(np.searchsorted(self._recording.cycle_revolutions, until, side="right")) - 1
        if index < 0 or index == self._shown_cycle:
            return None, None
        self._shown_cycle = index
        return newest_messages(self._test, index)

    def _newest_profile(self, until: float) -> WornProfile | None:
        numbers = self._recording.profiles["revolution"]
        index = int(np.searchsorted(numbers, until, side="right")) - 1
        if index < 0 or index == self._shown_profile:
            return None
        self._shown_profile = index
        return profile_message(self._recording.profiles, index)

    def _status(self, done: int) -> Status:
        recording = self._recording
        values = self._values(done - 1) if done else {}
        revolution = int(values.get("revolution", 0))
        margin, limit = recording.alarms.margin(revolution, values) if values else (math.nan, "")
        left_s = (len(recording.rows) - done) * 60.0 / recording.rpm
        now = time.time()
        replace, status = msgspec.structs.replace, recording.status
        return Status(
            replace(
                status.engine,
                state=self._state,
                reason=self._reason or say("replay × {:g}", self._speed),
                host_time=now,
            ),
            replace(
                status.test or NO_TEST,
                revolution=revolution,
                committed=done,
                started_at=float(self._takes),
                expected_end_at=now + (left_s / self._speed if self._speed else 0.0),
                worst_margin_percent=margin,
                worst_margin=limit,
                twin_revolution=int(recording.predictions[self._predicted - 1])
                if self._predicted
                else -1,
                residual_rms_N=self._residual(),
            ),
            replace(status.rig, speed_rpm=values.get("speed", 0.0)),
            recording.alarms.alarms(revolution),
        )

    def _values(self, row: int) -> dict[str, float]:
        """Return a revolution's values by column, NaN for columns that the file lacks."""
        result = dict.fromkeys(self._recording.columns, math.nan)
        for name in self._test.column_units():
            result[name] = float(self._test.column(name, row, row + 1)[0])
        return result

    def _residual(self) -> float:
        """Return how far the newest prediction is from the measurement, N; NaN without one."""
        row = self._predicted - 1
        if row < 0 or RESIDUAL not in self._test.column_units("prediction"):
            return math.nan
        return float(self._test.column(RESIDUAL, row, row + 1, "prediction")[0])


def read_recording(test: TestReader) -> Recording:
    """Read what a replay needs of a recorded test."""
    metadata, summary, events = test.metadata(), test.summary(), test.events()
    recipe = recipe_of(test)
    columns = BASE.units | test.column_units()
    rows = row_numbers(test, "revolutions")
    rpm = recipe.run.speed_rpm if recipe is not None else 60.0
    status = Status(
        EngineStatus(
            RunState.RUNNING,
            logged_sentence(summary["reason"], events) or summary["status"],
            operator=metadata["operator"],
        ),
        TestStatus(
            title=say("Replay of {}", metadata["title"]),
            file=str(test.path),
            planned=metadata["planned_revolutions"],
            first_revolution=summary["first_revolution"] or 1,
            target_rpm=rpm,
        ),
        RigStatus(metadata["rig"], metadata["simulated"]),
    )
    predictions = row_numbers(test, "prediction")
    alarms = RecordedAlarms(events, recipe.limits if recipe is not None else None)
    cycles = test.cycle_revolutions()
    return Recording(columns, rows, predictions, cycles, rpm, status, test.profiles(), alarms)
