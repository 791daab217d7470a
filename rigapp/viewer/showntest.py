"""Follow one test at a time: history from its file, then live rows, gaps filled from the file."""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path

from rigapp.config.recipe import TestFile
from rigapp.presentation.translation import tr
from rigapp.schema.messages import NO_TEST, Event, Snapshot, Status
from rigapp.schema.states import ACTIVE
from rigapp.viewer.pyramid import KEPT, Pyramid
from rigapp.viewer.recording import (
    StoredRevolution,
    StoredTest,
    TripCycles,
    load_events,
    load_history,
    load_recording,
    load_revolution,
    load_trip,
)
from rigapp.viewer.series import LiveData, Loaded, Wanted
from rigapp.viewer.tasks import TaskWorker

log = logging.getLogger(__name__)

HELD_SNAPSHOTS = 600
"""Snapshots held while the file is read; dropped ones, the oldest, are read from the file later."""

ATTEMPTS = 3  # a file that is being written may be unreadable once
RETRY_S = 2.0  # between two attempts
LOG_EVERY_S = 2.0
"""Interval for reading the log from the file while it is shown."""

HistoryLoader = Callable[[Path, int], StoredTest]
RevolutionLoader = Callable[[Path, int], StoredRevolution]


class ShownTest:
    """Turn snapshots into the data of the present test."""

    def __init__(
        self,
        history: HistoryLoader = load_history,
        revolution: RevolutionLoader = load_revolution,
        clock: Callable[[], float] = time.monotonic,
        kept: int = KEPT,
    ) -> None:
        """Begin without a test; kept: newest rows that are held as they are."""
        self._history = history
        self._kept = kept
        self._revolution = revolution
        self._clock = clock
        self._worker = TaskWorker("gui-history", bound=8)
        self._file: str | None = None
        self._path: Path | None = None
        self._started_at = 0.0
        self._held: deque[Snapshot] | None = None
        self._attempts = 0
        self._again_at: float | None = None
        self._not_before = 0.0
        self._shown_rows: int | None = None
        self._reading = False
        self.data = LiveData(kept=kept)
        self.recipe: TestFile | None = None
        self.problem = ""
        self.events: list[Event] = []
        self.log_problem = ""
        self._log_at: float | None = 0.0
        self.trip: TripCycles | None = None
        self._trip_wanted, self._trip_is_read = True, False

    @property
    def settled(self) -> bool:
        """Return whether nothing of the present test is still to be read."""
        read = self._held is None and self._again_at is None and not self._trip_is_read
        looked_at = not self._reading and self.data.wanted() is None
        return self._file is not None and read and looked_at

    @property
    def path(self) -> Path | None:
        """Return the file of the present test."""
        return self._path

    def take(self, snapshot: Snapshot) -> bool:
        """Take a snapshot; return whether it belongs to another test than the last one."""
        status, test = snapshot.status, snapshot.status.test or NO_TEST
        changed = test.file != self._file
        if snapshot.recorded is None:
            changed = changed or test.started_at != self._started_at
        if changed:
            self._begin(status)
        self._shown_rows = snapshot.recorded
        self.data.take(snapshot)
        if snapshot.recorded is None:
            self.data.expect(test.committed)
        if self._held is not None:
            self._held.append(snapshot)
        elif self._wants_history():
            self._read(status, snapshot)
        self._look_for_trip(status)
        return changed

    def _look_for_trip(self, status: Status) -> None:
        """Read the revolution in which a test tripped, once its file is finished."""
        test = status.test or NO_TEST
        path = self.path
        if status.engine.state in ACTIVE:
            self.trip, self._trip_wanted = None, True
        elif self._trip_wanted and path is not None:
            accepted = self._worker.submit(
                lambda: load_trip(path),
                lambda trip: self._got_trip(path, test.revolution, trip),
                lambda error: self._got_trip(path, 0, None, f"{error}"),
            )
            self._trip_wanted, self._trip_is_read = not accepted, accepted

    def _got_trip(
        self, path: Path, reached: int, trip: TripCycles | None, problem: str = ""
    ) -> None:
        self._trip_is_read = False
        if problem:
            log.warning("The revolution of the trip in %s cannot be read: %s", path, problem)
        # A replay at an earlier row has not reached it.
        if path == self.path and trip is not None and trip.revolution <= reached + 1:
            self.trip = None if self._trip_wanted else trip

    def deliver(self) -> None:
        """Deliver finished results; request series that a panel has missed."""
        self._worker.deliver()
        names, data = self.data.wanted(), self.data
        if names is None or self._reading:
            return
        self._reading = self._worker.submit(
            lambda: data.read(names),
            lambda made: self._got_columns(data, made),
            lambda error: self._no_columns(data, names, error),
        )

    def _got_columns(self, data: LiveData, made: Loaded) -> None:
        self._reading = False
        data.put(made)

    def _no_columns(self, data: LiveData, names: Wanted, error: Exception) -> None:
        """Take columns that cannot be read as unknown, once."""
        self._reading = False
        log.error("Columns of %s cannot be read: %s", self._file, error)
        if data is self.data:
            self.problem = tr("Earlier cycles cannot be shown: {}", error)
        rows, predictions = ({name: Pyramid(0) for name in columns} for columns in names)
        data.put((rows, predictions))

    def ask_revolution(
        self,
        revolution: int,
        done: Callable[[StoredRevolution], None],
        failed: Callable[[Exception], None],
    ) -> None:
        """Read the saved cycle nearest to a revolution; the answer comes from ``deliver``."""
        path = self.path
        if path is None:
            failed(FileNotFoundError(tr("There is no test, so there is no stored revolution.")))
        elif not self._worker.submit(lambda: self._revolution(path, revolution), done, failed):
            failed(RuntimeError(tr("The file is still being read; try again.")))

    def follow_log(self) -> None:
        """Read the log again when it is due; called while it is shown."""
        path = self.path
        if path is None or self._log_at is None or self._clock() < self._log_at:
            return
        accepted = self._worker.submit(
            lambda: load_events(path),
            lambda events: self._got_log(path, events),
            lambda error: self._got_log(path, None, tr("The log cannot be read: {}", error)),
        )
        self._log_at = None if accepted else self._clock() + LOG_EVERY_S

    def _got_log(self, path: Path, events: list[Event] | None, problem: str = "") -> None:
        self._log_at = self._clock() + LOG_EVERY_S
        if path == self.path:
            self.events = events if events and len(events) != len(self.events) else self.events
            self.log_problem = problem

    def close(self) -> None:
        """End the reading thread."""
        self._worker.close()
        self.data.close()

    def _begin(self, status: Status) -> None:
        test = status.test or NO_TEST
        self._file, self._started_at = test.file, test.started_at
        self._path = Path(test.file) if test.file else None
        self._held = None
        self._attempts = 0
        self._again_at = self._clock() if test.file else None
        self.data.close()
        self.data = LiveData(test.planned, self._kept)
        self.recipe = None
        self.events, self.log_problem = [], ""
        self.trip, self._trip_wanted = None, True
        self.problem = ""

    def _wants_history(self) -> bool:
        if not self._file:
            return False
        now = self._clock()
        if self._again_at is not None:
            return now >= self._again_at
        return self.data.missing_from is not None and now >= self._not_before

    def _read(self, status: Status, snapshot: Snapshot) -> None:
        test = status.test or NO_TEST
        path, planned = Path(test.file), test.planned
        history = self._history if snapshot.recorded is None else load_recording
        self._again_at = None
        self._not_before = self._clock() + RETRY_S
        self._held = deque([snapshot], maxlen=HELD_SNAPSHOTS)
        accepted = self._worker.submit(
            lambda: history(path, planned),
            lambda history: self._loaded(path, history),
            lambda error: self._failed(path, error),
        )
        if not accepted:
            self._held = None
            self._again_at = self._clock() + RETRY_S

    def _loaded(self, path: Path, history: StoredTest) -> None:
        if path != self.path or self._held is None:
            history.data.close()
            return
        held, self._held = self._held, None
        if self._shown_rows is not None:
            self._replay(history.data, self._shown_rows)
        elif self.data.missing_from is not None:
            self._replace(history, held)
        self.recipe = history.recipe
        self._attempts = 0
        self.problem = ""

    def _replay(self, data: LiveData, rows: int) -> None:
        """Show a recorded test from its file, with the curves received meanwhile."""
        data.show(rows)
        data.cycle, data.prediction = self.data.cycle, self.data.prediction
        data.profile = self.data.profile
        self.data = data

    def _replace(self, history: StoredTest, held: deque[Snapshot]) -> None:
        data, newest = history.data, history.newest
        for snapshot in held:
            data.take(snapshot)
        data.cycle = data.cycle or self.data.cycle
        data.prediction = data.prediction or self.data.prediction
        if data.cycle is None and newest is not None:
            data.cycle, data.prediction = newest.cycle, newest.prediction
        self.data = data

    def _failed(self, path: Path, error: Exception) -> None:
        if path != self.path:
            return
        self._held = None
        self._attempts += 1
        if self._attempts < ATTEMPTS:
            self._again_at = self._clock() + RETRY_S
            return
        log.error("History of %s cannot be read: %s", path, error)
        self.problem = tr("Earlier cycles cannot be shown: {}", error)
        self.data.missing_from = None
