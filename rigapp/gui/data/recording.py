"""Read a test file for drawing; all of it runs on worker threads, never on the screen's."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import TestFile
from rigapp.gui.data.profiles import shown_profile
from rigapp.gui.data.series import (
    LiveData,
    MeasuredCycle,
    PredictedCycle,
    measured_cycle,
    predicted_cycle,
)
from rigapp.presentation.translation import tr
from rigapp.schema.messages import Cycle, Event, Prediction

if TYPE_CHECKING:  # the window shall not load the library of files before it reads one
    from rigapp.storage import LargestForce


@dataclass(frozen=True, slots=True)
class StoredRevolution:
    """Carry one whole revolution of a file, with the model's where it is saved."""

    cycle: MeasuredCycle
    prediction: PredictedCycle | None


@dataclass(frozen=True, slots=True)
class TripCycles:
    """Carry the revolution in which a test tripped, as far as it went.

    before: the last whole cycle saved before it; peak: its largest force. None where not known.
    """

    revolution: int
    cycle: MeasuredCycle | None
    before: MeasuredCycle | None
    peak: LargestForce | None


@dataclass(frozen=True, slots=True)
class StoredTest:
    """Carry what a file holds of a test at one moment.

    recipe: None when the test file inside cannot be read. newest: the newest saved cycle, None
    while there is none.
    """

    data: LiveData
    recipe: TestFile | None
    newest: StoredRevolution | None = None


def load_history(path: Path, planned: int = 0) -> StoredTest:
    """Return everything that a file holds of a test, with its levels of detail built.

    Raises UnusableInput when the file is not a readable test.
    """
    from rigapp.replay.messages import newest_messages, profile_message, recipe_of
    from rigapp.storage import open_test

    with open_test(path) as test:
        rows = test.rows()
        data = LiveData(max(planned, len(rows["revolution"])))
        data.load_rows(rows, test.column_units())
        predictions = test.predictions()
        if len(predictions["revolution"]):
            data.predictions.load(predictions)
        profiles = test.profiles()
        if len(profiles["revolution"]):
            data.profile = shown_profile(profile_message(profiles, -1))
        data.rows.settle()
        data.predictions.settle()
        saved = len(test.cycle_revolutions())
        newest = _unpacked(newest_messages(test, saved - 1)) if saved else None
        return StoredTest(data, recipe_of(test), newest)


def load_revolution(path: Path, revolution: int) -> StoredRevolution:
    """Return the saved whole cycle nearest to a revolution.

    Raises UnusableInput when the file has none.
    """
    from rigapp.replay.messages import cycle_messages
    from rigapp.storage import open_test

    with open_test(path) as test:
        saved = test.cycle_revolutions()
        if len(saved) == 0:
            raise UnusableInput(tr("{}: no whole cycle is saved yet", path))
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
        found = trip_of(test)
        if found is None:
            return None
        cycle, before = (
            measured_cycle(cycle_message(one)) if one is not None else None
            for one in (found.cycle, found.before)
        )
        return TripCycles(found.revolution, cycle, before, found.peak)


def load_events(path: Path) -> list[Event]:
    """Return the log of a test, in order."""
    from rigapp.storage import open_test

    with open_test(path) as test:
        return test.events()
