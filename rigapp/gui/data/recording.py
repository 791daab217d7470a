"""Read a test file for drawing; all of it runs on worker threads, never on the screen's."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import TestFile
from rigapp.gui.data.profiles import profile_message, shown_profile
from rigapp.gui.data.series import LiveData, MeasuredCycle, PredictedCycle
from rigapp.schema.messages import Event

if TYPE_CHECKING:
    from rigapp.storage import TestReader

PREDICTION_BACK = 5
"""Saved cycles to go back for a predicted curve when the newest has none."""


@dataclass(frozen=True, slots=True)
class StoredRevolution:
    """Carry one whole revolution of a file, with the model's where it is saved."""

    cycle: MeasuredCycle
    prediction: PredictedCycle | None


@dataclass(frozen=True, slots=True)
class History:
    """Carry what a file holds of a test at one moment.

    cycle_revolutions: the revolutions whose whole cycle is saved. test: None when the test file
    inside cannot be read. newest: the newest saved cycle, None while there is none.
    """

    data: LiveData
    test: TestFile | None
    cycle_revolutions: NDArray[np.int64]
    newest: StoredRevolution | None = None


def load_history(path: Path, planned: int = 0) -> History:
    """Return everything that a file holds of a test, with its levels of detail built.

    Raises UnusableInput when the file is not a readable test.
    """
    from rigapp.storage import open_test

    with open_test(path) as test:
        rows = test.rows()
        data = LiveData(max(planned, len(rows["revolution"])))
        data.load_rows(rows)
        predictions = test.predictions()
        if len(predictions["revolution"]):
            data.predictions.load(predictions)
        profiles = test.profiles()
        if len(profiles["revolution"]):
            data.profile = shown_profile(profile_message(profiles, -1))
        data.rows.settle()
        data.predictions.settle()
        saved = test.cycle_revolutions()
        newest = newest_revolution(test, len(saved) - 1) if len(saved) else None
        return History(data, recipe_of(test), saved, newest)


def load_revolution(path: Path, revolution: int) -> StoredRevolution:
    """Return the saved whole cycle nearest to a revolution.

    Raises UnusableInput when the file has none.
    """
    from rigapp.storage import open_test

    with open_test(path) as test:
        saved = test.cycle_revolutions()
        if len(saved) == 0:
            raise UnusableInput(f"{path}: no whole cycle is saved yet")
        return stored_revolution(test, int(np.argmin(np.abs(saved - revolution))))


def stored_revolution(test: TestReader, index: int) -> StoredRevolution:
    """Return the saved cycle ``index`` with the prediction of the same revolution."""
    stored = test.cycle(index)
    names = ("force_1", "force_2", "force", "probe_1", "probe_2")
    cycle = MeasuredCycle(
        stored.revolution,
        stored.columns["angle"],
        {name: stored.columns[name] for name in names},
    )
    curves = test.predicted_curve(stored.revolution)
    if curves is None:
        return StoredRevolution(cycle, None)
    angle = np.asarray(curves.pop("angle"), dtype=np.float64)
    return StoredRevolution(cycle, PredictedCycle(stored.revolution, angle, curves))


def newest_revolution(test: TestReader, index: int) -> StoredRevolution:
    """Return saved cycle ``index``, with the newest prediction saved up to there."""
    stored = stored_revolution(test, index)
    prediction = stored.prediction
    earlier = index - 1
    while prediction is None and earlier >= max(0, index - PREDICTION_BACK):
        prediction = stored_revolution(test, earlier).prediction
        earlier -= 1
    return StoredRevolution(stored.cycle, prediction)


def load_events(path: Path) -> list[Event]:
    """Return the log of a test, in order."""
    from rigapp.storage import open_test

    with open_test(path) as test:
        return test.events()


def recipe_of(test: TestReader) -> TestFile | None:
    """Return the test file that was copied into a recorded file, None when it cannot be read."""
    from rigapp.config.loading import parse_test

    try:
        return parse_test(str(test.configuration()["test"]), test.path.name, recorded=True)
    except (UnusableInput, KeyError):
        return None
