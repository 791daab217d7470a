"""State of the compiled functions that unwrap the counter: named indices of arrays."""

from __future__ import annotations

from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

Counts = NDArray[np.int64]
Floats = NDArray[np.float64]


class StateAt(IntEnum):
    """Indices of the state vector."""

    STARTED = 0
    PREVIOUS = 1
    POSITION = 2
    BASE = 3
    STEP = 4
    LOCKED = 5
    INSIDE = 6
    PENDING = 7
    PENDING_KEPT = 8
    PENDING_SAMPLE = 9
    PENDING_POSITION = 10
    RUN = 11
    KEPT = 12
    START_KEPT = 13
    SKIPPING = 14
    FLAGS = 15
    LOST = 16
    IDLE = 17
    ORDINAL = 18
    HIGH = 19
    JUMPED = 20
    JUMP_STEP = 21
    OTHER = 22
    OTHER_VALID = 23
    UNLOCKED_TURN = 24
    TRAVEL = 25
    TRAVEL_FIRST = 26
    BEFORE = 27
    SEEN = 28
    ODD = 29
    GAP = 30
    SKIPPED = 31
    OFF_INDEX = 32
    SKIPS = 33
    SIZE = 34


class ParameterAt(IntEnum):
    """Indices of the parameter vector."""

    COUNTS = 0
    DIRECTION = 1
    RESTARTS = 2
    MODULUS = 3
    TOLERANCE = 4
    MISSED_AFTER = 5
    IDLE_AFTER = 6
    CAPACITY = 7
    SIZE = 8


class EventAt(IntEnum):
    """Columns of an event."""

    KIND = 0
    KEPT = 1
    SAMPLE = 2
    BASE = 3
    ORDINAL = 4
    FLAGS = 5
    LOST = 6
    IDLE = 7
    END_POSITION = 8
    SKIPPED = 9
    SIZE = 10


CUT = 1
"""Event: a revolution ends before this sample and another begins with it."""
BEGIN = 2
"""Event: the first revolution begins with this sample; earlier samples are discarded."""
BREAK = 3
"""Event: time is not continuous before this sample."""


def new_state() -> tuple[Counts, Floats]:
    """Return the initial state of a counter, and its smoothed step (1,)."""
    return np.zeros(int(StateAt.SIZE), np.int64), np.zeros(1, np.float64)
