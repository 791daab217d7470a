"""Play a recorded test as if it ran: the same snapshots, so that the same window shows it."""

from __future__ import annotations

import math
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.replay.alarms import RecordedAlarms
from rigapp.replay.messages import newest_messages, profile_message, recipe_of
from rigapp.schema.channels import BASE
from rigapp.schema.columns import by_name, prediction_columns
from rigapp.schema.messages import (
    Cycle,
    Prediction,
    Reply,
    RunState,
    Snapshot,
    Status,
    WornProfile,
)
from rigapp.service.client import merged
from rigapp.storage import TestReader, open_test

Floats = NDArray[np.float64]

PERIOD_S = 0.1  # as often as the screen draws trends
MOST_ROWS = 20_000
"""Rows in one snapshot: after a long leap the window takes them in steps that nobody feels."""


@dataclass(frozen=True, slots=True)
class Recording:
    """Carry a whole recorded test in memory, except its cycles; columns: name -> unit in a row."""

    columns: dict[str, str]
    rows: Floats
    predictions: Floats
    cycle_revolutions: NDArray[np.int64]
    rpm: float
    status: Status
    profiles: dict[str, NDArray[Any]]
    alarms: RecordedAlarms

    def row(self, place: int) -> dict[str, float]:
        """Return a revolution's values by column."""
        return dict(zip(self.columns, self.rows[place].tolist(), strict=True))

    def prediction(self, place: int) -> dict[str, float]:
        """Return a prediction's values by column."""
        return by_name(prediction_columns(), self.predictions[place])


class ReplayClient:
    """Answer as an engine does, from a file. Pause, resume, stop, speed and leaps work.

    A thread reads the file and keeps one snapshot ready, merged with what was not fetched yet.
    """

    is_replay = True

    def __init__(self, path: Path, *, speed: float = 10.0, at_end: bool = False) -> None:
        """Open a recorded test; raise UnusableInput. at_end: begin with everything shown."""
        self._path = path
        self._test = open_test(path)
        self._recording = read_recording(self._test)
        self._lock = threading.Lock()
        self._ready: Snapshot | None = None
        self._speed = speed
        self._row = float(len(self._recording.rows)) if at_end else 0.0
        self._most = len(self._recording.rows) if at_end else MOST_ROWS
        self._wanted: float | None = None
        self._sent = self._sent_predictions = 0
        self._shown_cycle = self._shown_profile = -1
        self._state = RunState.RUNNING
        self._reason = ""
        self._stop = threading.Event()
        self._takes = 0
        self._advance(0.0)
        self._prepare()
        self._thread = threading.Thread(target=self._play, name="gui-replay", daemon=True)
        self._thread.start()

    @property
    def last_recorded(self) -> int:
        """Return the last revolution of the test."""
        rows = self._recording.rows
        return int(rows[-1, 0]) if len(rows) else 0

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
        """Pause, resume, stop, change the speed, or go to a revolution; all else is refused."""
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
            self._wanted = self._row_of(float(arguments["revolution"]))
        elif verb == "status":
            return Reply(ok=True, result=self._status(self._sent).tree())
        else:
            return Reply(ok=False, sentence=f"This is a replay; {verb!r} needs a rig.")
        return Reply(ok=True)

    def close(self) -> None:
        """End the replay."""
        self._stop.set()
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
            except UnusableInput as error:  # a damaged cycle; rows and the other cycles go on
                self._reason = str(error)
            if self._stop.wait(PERIOD_S):
                return

    def _row_of(self, revolution: float) -> float:
        """Return how many rows there are up to a revolution."""
        return float(np.searchsorted(self._recording.rows[:, 0], revolution, side="right"))

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
            until = float(self._recording.rows[int(wanted) - 1, 0]) if wanted >= 1.0 else 0.0
            predictions = self._recording.predictions[:, 0]
            self._sent = int(wanted)
            self._sent_predictions = int(np.searchsorted(predictions, until, side="right"))
            self._takes += 1
            with self._lock:
                self._ready = None

    def _advance(self, elapsed_s: float) -> None:
        end = len(self._recording.rows)
        if self._state is RunState.RUNNING:
            self._row = min(end, self._row + self._speed * elapsed_s * self._recording.rpm / 60.0)
            if self._row >= end:
                self._state = RunState.STOPPED
                self._reason = f"end of the replay; the test: {self._recording.status.reason}"

    def _prepare(self) -> None:
        done = min(int(self._row), self._sent + self._most)
        rows = self._recording.rows[self._sent : done]
        until = float(self._recording.rows[done - 1, 0]) if done else 0.0
        stop = int(np.searchsorted(self._recording.predictions[:, 0], until, side="right"))
        predictions = self._recording.predictions[self._sent_predictions : stop]
        cycle, prediction = self._newest_cycle(until)
        snapshot = Snapshot(
            status=self._status(done),
            first_row=self._sent,
            rows=rows.tobytes(),
            predictions=predictions.tobytes(),
            cycle=cycle,
            prediction=prediction,
            profile=self._newest_profile(until),
            columns=self._recording.columns,
        )
        self._sent, self._sent_predictions = done, stop
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
        values = recording.row(done - 1) if done else {}
        revolution = int(values.get("revolution", 0))
        margin, limit = recording.alarms.margin(revolution, values) if values else (math.nan, "")
        shown = recording.prediction(self._sent_predictions - 1) if self._sent_predictions else {}
        left_s = (len(recording.rows) - done) * 60.0 / recording.rpm
        now = time.time()
        return msgspec.structs.replace(
            recording.status,
            state=self._state,
            reason=self._reason or f"replay × {self._speed:g}",
            revolution=revolution,
            worst_margin_percent=margin,
            worst_margin=limit,
            alarms=recording.alarms.alarms(revolution),
            committed=done,
            speed_rpm=values.get("speed", 0.0),
            started_at=float(self._takes),
            expected_end_at=now + (left_s / self._speed if self._speed else 0.0),
            host_time=now,
            twin_revolution=int(shown.get("revolution", -1)),
            residual_rms_N=shown.get("residual_rms", math.nan),
        )


def read_recording(test: TestReader) -> Recording:
    """Read what a replay needs of a recorded test."""
    metadata, summary = test.metadata(), test.summary()
    recipe = recipe_of(test)
    columns = BASE.units | test.column_units()
    rows = _matrix(test.rows(), list(columns))
    rpm = recipe.run.speed_rpm if recipe is not None else 60.0
    status = Status(
        RunState.RUNNING,
        summary["reason"] or summary["status"],
        metadata["rig"],
        f"Replay of {metadata['title']}",
        str(test.path),
        planned=metadata["planned_revolutions"],
        first_revolution=summary["first_revolution"] or 1,
        target_rpm=rpm,
        simulated=metadata["simulated"],
        operator=metadata["operator"],
    )
    predictions = _matrix(test.predictions(), [one.name for one in prediction_columns()])
    alarms = RecordedAlarms(test.events(), recipe.limits if recipe is not None else None)
    cycles = test.cycle_revolutions()
    return Recording(columns, rows, predictions, cycles, rpm, status, test.profiles(), alarms)


def _matrix(columns: dict[str, NDArray[Any]], names: list[str]) -> Floats:
    count = len(columns["revolution"])
    unknown = np.full(count, np.nan)
    return np.column_stack([columns.get(name, unknown) for name in names]).astype(np.float64)
