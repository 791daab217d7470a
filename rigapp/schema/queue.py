"""One test of a queue, as stored on the disk and shown to every viewer."""

from __future__ import annotations

import enum

import msgspec


class ItemState(enum.StrEnum):
    """Progress of a test of the queue. STOPPED: it ended early, or could not begin."""

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    STOPPED = "stopped"


class QueuedTest(msgspec.Struct, frozen=True):
    """One test of a queue.

    number: identifies it to people, never reused. test: its test file. folder: for its recorded
    file; file: that file, empty until it began. sentence: how it ended.
    """

    number: int
    test: str
    folder: str
    state: ItemState = ItemState.WAITING
    file: str = ""
    sentence: str = ""
