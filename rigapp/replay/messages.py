"""Content of a recorded file as the messages that an engine sends."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.recipe import TestFile
from rigapp.schema.columns import (
    PREDICTED_CURVES,
    PROFILE_CURVES,
    profile_columns,
)
from rigapp.schema.messages import Cycle, Prediction, WornProfile
from rigapp.storage import StoredCycle, TestReader

PREDICTION_BACK = 5
"""Number of saved cycles searched backwards for a predicted curve."""


def cycle_message(stored: StoredCycle) -> Cycle:
    """Return the measured curves of a saved cycle."""
    curves = {curve.name: _bytes(stored.columns[curve.name]) for curve in stored.table.curves}
    return Cycle(stored.revolution, _bytes(stored.columns["angle"]), curves)


def cycle_messages(test: TestReader, index: int) -> tuple[Cycle, Prediction | None]:
    """Return saved cycle ``index`` and the predicted curves of the same revolution, if saved."""
    stored = test.cycle(index)
    cycle = cycle_message(stored)
    predicted = test.predicted_curve(stored.revolution)
    if predicted is None:
        return cycle, None
    force_1, force_2, force, *joint = (
        _bytes(predicted[name]) if name in predicted else b"" for name in PREDICTED_CURVES
    )
    sent = Prediction(stored.revolution, b"", force_1, force_2, force, None, b"", *joint)
    return cycle, sent


def newest_messages(test: TestReader, index: int) -> tuple[Cycle, Prediction | None]:
    """Return saved cycle ``index``, with the newest predicted curves saved up to there."""
    cycle, prediction = cycle_messages(test, index)
    earlier = index - 1
    while prediction is None and earlier >= max(0, index - PREDICTION_BACK):
        _, prediction = cycle_messages(test, earlier)
        earlier -= 1
    return cycle, prediction


def profile_message(columns: Mapping[str, NDArray[Any]], index: int) -> WornProfile:
    """Return profile ``index`` of a file's ``profiles()``."""
    values = [float(columns[column.name][index]) for column in profile_columns()]
    number, raw = int(columns["revolution"][index]), np.array(values, dtype="<f8").tobytes()
    measured, predicted, driven, uncertainty = (
        _bytes(columns[name][index]) for name in PROFILE_CURVES
    )
    return WornProfile(number, raw, measured, predicted, driven, uncertainty)


def recipe_of(test: TestReader) -> TestFile | None:
    """Return the test file that was copied into a recorded file, None when it cannot be read."""
    try:
        return parse_test(str(test.configuration()["test"]), test.path.name, recorded=True)
    except (UnusableInput, KeyError):
        return None


def _bytes(values: NDArray[Any]) -> bytes:
    return values.astype("<f4", copy=False).tobytes()
