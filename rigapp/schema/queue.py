"""One test of a queue, as the disk keeps it and every viewer sees it."""

from __future__ import annotations

import enum

import msgspec


class ItemState(enum.StrEnum):
    """How far a test of the queue is. STOPPED: it ended before its time, or could not begin."""

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    STOPPED = "stopped"


class QueuedTest(msgspec.Struct, frozen=True):
    """One test of a queue.

    number: by which people name it, never given twice. test: its test file. folder: where its file
    is made; file: that file, empty until it began. sentence: how it ended.
    """

    number: int
    test: str
    folder: str
    state: ItemState = ItemState.WAITING
    file: str = ""
    sentence: str = ""
