"""Read a test file for drawing, on worker threads.

Only single rows of a recorded test, and details finer than the held levels, come from its file on
the screen's own thread: milliseconds at any length.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import TestFile
from rigapp.presentation.translation import tr
from rigapp.schema.channels import BASE
from rigapp.schema.messages import Cycle, Event, Prediction
from rigapp.viewer.pyramid import KEPT, Pyramid
from rigapp.viewer.series import (
    PREDICTED,
    LiveData,
    Loaded,
    MeasuredCycle,
    PredictedCycle,
    SeriesTable,
    Wanted,
    measured_cycle,
    predicted_cycle,
    shown_profile,
)

if TYPE_CHECKING:  # the window must not load h5py before it reads a file
    from rigapp.storage import LargestForce, TestReader, TripCapture


log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class StoredRevolution:
    """One whole revolution of a file, with the model's where it is saved."""

    cycle: MeasuredCycle
    prediction: PredictedCycle | None


@dataclass(frozen=True, slots=True)
class TripCycles:
    """The revolution in which a test tripped, as far as it went.

    before: the last whole cycle saved before it; peak: its largest force. None where not known.
    """

    revolution: int
    cycle: MeasuredCycle | None
    before: MeasuredCycle | None
    peak: LargestForce | None


@dataclass(frozen=True, slots=True)
class StoredTest:
    """The content of a test's file at one moment.

    recipe: None when the test file inside cannot be read. newest: the newest saved cycle, None
    while there is none.
    """

    data: LiveData
    recipe: TestFile | None
    newest: StoredRevolution | None = None


class RecordedTable(SeriesTable):
    """The first rows of a stream of a file; series in use are read on a worker thread.

    A series that has not been read yet is empty and among ``wanted``. Single rows and details finer
    than the held levels come from the file at once: a few milliseconds at any length.
    """

    def __init__(self, reader: TestReader, stream: str, columns: tuple[str, ...]) -> None:
        from rigapp.storage import row_numbers

        super().__init__(columns, 0)
        self._reader = reader
        self._stream = stream
        self._stored = frozenset(reader.column_units(stream))
        self._read: dict[str, Pyramid] = {}
        self._single: dict[tuple[str, int, int], NDArray[np.floating]] = {}
        self.wanted: set[str] = set()
        self._x = row_numbers(reader, stream)
        self.show(0)

    def show(self, count: int) -> None:
        """Show the first ``count`` rows only."""
        if count != self._x.limit:
            self._single.clear()
        self._x.limit = count
        for series in self._read.values():
            series.limit = count

    def rows_up_to(self, revolution: float) -> int:
        """Return how many rows of the whole stream belong to revolutions up to this one."""
        shown, self._x.limit = self._x.limit, None
        result = self._x.searchsorted(revolution, "right")
        self._x.limit = shown
        return result

    def series(self, name: str) -> Pyramid:
        """Return one series, an empty one until it has been read; KeyError for an unknown name."""
        result = self._read.get(name)
        if result is None:
            result = super().series(name)
            self.wanted.add(name)
        return result

    def newest(self, name: str, count: int, stop: int | None = None) -> NDArray[np.floating]:
        """Return the last ``count`` values of a series, or fewer, of rows before ``stop``."""
        super().series(name)
        end = len(self) if stop is None else min(stop, len(self))
        key = (name, count, end)
        if key not in self._single:
            self._single[key] = self._fetch(name, max(end - count, 0), end)
        return self._single[key]

    def read(self, names: Sequence[str]) -> dict[str, Pyramid]:
        """Return whole series of the file; for a worker thread."""
        from rigapp.storage import blocks

        made = {name: Pyramid(0, KEPT) for name in names}
        for _, block in blocks(self._reader, names, self._stream):
            for name, series in made.items():
                series.extend(block[name])
        for name, series in made.items():
            series.settle()
            series.fetch = partial(self._fetch, name)
        return made

    def put(self, made: dict[str, Pyramid]) -> None:
        """Take series that have been read."""
        self._read |= made
        self.wanted -= made.keys()
        self.show(len(self))

    def _fetch(self, name: str, start: int, stop: int) -> NDArray[np.floating]:
        unknown = np.full(max(stop - start, 0), np.nan)
        if name not in self._stored:
            return unknown
        try:
            result = self._reader.column(name, start, stop, self._stream)
        except UnusableInput as error:  # a damaged part; all else is shown
            log.warning("%s", error)
            return unknown
        return np.asarray(result, dtype=np.float64)


class RecordedData(LiveData):
    """The data of a replay from a file; the panels only read."""

    def __init__(self, reader: TestReader) -> None:
        """Take an open file; it is closed with ``close``."""
        super().__init__()
        self._reader = reader
        units = BASE.units | reader.column_units()
        self.set_columns(units)
        self.rows: RecordedTable = RecordedTable(reader, "revolutions", tuple(units))
        self.predictions: RecordedTable = RecordedTable(reader, "prediction", PREDICTED)

    def show(self, count: int) -> None:
        """Show the first ``count`` rows, with the predictions up to there."""
        if count < len(self.rows):
            self.forget_newest()
        self.rows.show(count)
        until = self.rows.revolutions[-1] if count else -np.inf
        self.predictions.show(self.predictions.rows_up_to(until))

    def wanted(self) -> Wanted | None:
        """Return the columns of rows and predictions that have still to be read; None: none."""
        rows, predictions = (tuple(table.wanted) for table in (self.rows, self.predictions))
        return (rows, predictions) if rows or predictions else None

    def read(self, names: Wanted) -> Loaded:
        """Return whole columns of rows and predictions; for a worker thread."""
        return self.rows.read(names[0]), self.predictions.read(names[1])

    def put(self, made: Loaded) -> None:
        """Take columns that have been read."""
        self.rows.put(made[0])
        self.predictions.put(made[1])
        self.loaded += 1

    def close(self) -> None:
        """Close the file."""
        self._reader.close()


def load_history(path: Path, planned: int = 0, kept: int = KEPT) -> StoredTest:
    """Return the whole content of a test's file, with its levels of detail built.

    kept: newest rows that stay as they are. Raises UnusableInput when the file is not a readable
    test.
    """
    from rigapp.replay.messages import newest_messages, profile_message, recipe_of
    from rigapp.storage import blocks, open_test

    with open_test(path) as test:
        data, units = LiveData(max(planned, test.committed()), kept), test.column_units()
        for _, block in blocks(test, tuple(units)):
            data.load_rows(block, units)
        for _, block in blocks(test, tuple(test.column_units("prediction")), "prediction"):
            data.predictions.load(block)
        profiles = test.profiles()
        if len(profiles["revolution"]):
            data.profile = shown_profile(profile_message(profiles, -1))
        data.rows.settle()
        data.predictions.settle()
        saved = len(test.cycle_revolutions())
        newest = _unpacked(newest_messages(test, saved - 1)) if saved else None
        return StoredTest(data, recipe_of(test), newest)


def load_recording(path: Path, planned: int = 0) -> StoredTest:
    """Return a recorded test for a replay: its columns are read when they are used.

    Raises UnusableInput when the file is not a readable test.
    """
    from rigapp.replay.messages import recipe_of
    from rigapp.storage import open_test

    test = open_test(path)
    try:
        return StoredTest(RecordedData(test), recipe_of(test))
    except BaseException:
        test.close()
        raise


def load_revolution(path: Path, revolution: int) -> StoredRevolution:
    """Return the saved whole cycle nearest to a revolution.

    Raises UnusableInput when the file has none.
    """
    from rigapp.replay.messages import cycle_messages
    from rigapp.storage import open_test

    with open_test(path) as test:
        saved = test.cycle_revolutions()
        if len(saved) == 0:
            raise UnusableInput(tr("{}: no complete cycle is saved yet", path))
        return _unpacked(cycle_messages(test, int(np.argmin(np.abs(saved - revolution)))))


def _unpacked(messages: tuple[Cycle, Prediction | None]) -> StoredRevolution:
    cycle, prediction = messages
    return StoredRevolution(
        measured_cycle(cycle), predicted_cycle(prediction) if prediction is not None else None
    )


def load_trip(path: Path) -> TripCycles | None:
    """Return the revolution in which a test tripped, None for a test that did not.

    Raises UnusableInput when the file is not a readable test.
    """
    from rigapp.replay.messages import cycle_message
    from rigapp.storage import open_test, trip_of

    with open_test(path) as test:
        result = trip_of(test)
        if result is None:
            return None
        cycle, before = (
            measured_cycle(cycle_message(part)) if part is not None else None
            for part in (result.cycle, result.before)
        )
        return TripCycles(result.revolution, cycle, before, result.peak)


def load_capture(path: Path) -> TripCapture | None:
    """Return the seconds around the trip of a test, None without one; raise UnusableInput."""
    from rigapp.storage import open_test, trip_capture

    with open_test(path) as test:
        return trip_capture(test)


def load_events(path: Path) -> list[Event]:
    """Return the log of a test, in order."""
    from rigapp.storage import open_test

    with open_test(path) as test:
        return test.events()
