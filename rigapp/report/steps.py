"""The steps of a recorded test: which one each revolution belongs to."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.sequence import Sequence
from rigapp.storage import TestReader


def sequence_of(reader: TestReader) -> Sequence | None:
    """Return the steps of a file's test; None for a test without, or an unreadable one."""
    try:
        test = parse_test(str(reader.configuration()["test"]), "test", recorded=True)
        return Sequence(test.run) if test.run.step else None
    except (UnusableInput, KeyError, ZeroDivisionError):
        return None


def step_numbers(sequence: Sequence, revolutions: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the number of the step of each revolution, both of shape (n,)."""
    ends, loop = np.array(sequence.ends), sequence.loop
    rounds = np.maximum(0, -(-(revolutions - ends[-1]) // loop))
    places = np.searchsorted(ends, revolutions - rounds * loop)
    return np.asarray(places + 1, np.int64)
