"""A queue of tests as a value: what is added, begun, ended, and which one comes next."""

from __future__ import annotations

import enum
from pathlib import PurePath

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.schema.notices import Finished

MOST_LEFT = 200
"""Tests that are still to be done."""
MOST_DONE = 200
"""Of more the oldest are forgotten; their files stay."""


class ItemState(enum.StrEnum):
    """How far a test of the queue is. STOPPED: it ended before its time, or could not begin."""

    WAITING = "waiting"
    RUNNING = "running"
    DONE = "done"
    STOPPED = "stopped"


class Item(msgspec.Struct, frozen=True):
    """One test of a queue.

    number: by which people name it, never given twice. test: its test file. folder: where its file
    is made; file: that file, empty until it began. sentence: how it ended.
    """

    number: int
    test: str
    folder: str
    stage: ItemState = ItemState.WAITING
    file: str = ""
    sentence: str = ""


class Queue(msgspec.Struct, frozen=True):
    """The tests of one rig in their order. working: the next one begins when one is done."""

    rig: str = ""
    working: bool = False
    given: int = 0
    items: tuple[Item, ...] = ()

    @property
    def next(self) -> Item | None:
        """Return the test that is to be done next: the first that is not done."""
        return next((one for one in self.items if one.stage is not ItemState.DONE), None)

    @property
    def running(self) -> Item | None:
        """Return the test that runs."""
        return next((one for one in self.items if one.stage is ItemState.RUNNING), None)


def added(queue: Queue, tests: list[str], folder: str) -> Queue:
    """Return a queue with more tests at its end; raise UnusableInput where they are too many."""
    left = sum(one.stage is not ItemState.DONE for one in queue.items)
    if left + len(tests) > MOST_LEFT:
        raise UnusableInput(f"A queue holds {MOST_LEFT} tests at most; {left} are in it.")
    new = tuple(Item(number, test, folder) for number, test in enumerate(tests, queue.given + 1))
    return msgspec.structs.replace(
        queue, given=queue.given + len(tests), items=_bounded((*queue.items, *new))
    )


def removed(queue: Queue, numbers: list[int]) -> Queue:
    """Return a queue without some tests, whose files stay; raise UnusableInput."""
    known = {one.number: one for one in queue.items}
    for number in numbers:
        if number not in known:
            raise UnusableInput(f"The queue has no test {number}; look at rigapp queue list.")
        if known[number].stage is ItemState.RUNNING:
            raise UnusableInput(f"Test {number} runs; stop it first.")
    items = tuple(one for one in queue.items if one.number not in numbers)
    return msgspec.structs.replace(queue, items=items)


def at_work(queue: Queue) -> Queue:
    """Return a queue that takes one test after another."""
    return msgspec.structs.replace(queue, working=True)


def begun(queue: Queue, number: int, file: str) -> Queue:
    """Return a queue with this test running into a file; as it was where it does not work."""
    if not queue.working:
        return queue
    return _with(queue, number, stage=ItemState.RUNNING, file=file, sentence="")


def ended(queue: Queue, number: int, sentence: str, *, done: bool) -> Queue:
    """Return a queue after the end of a test; one that is not done ends the work."""
    queue = msgspec.structs.replace(queue, working=queue.working and done)
    stage = ItemState.DONE if done else ItemState.STOPPED
    queue = _with(queue, number, stage=stage, sentence=sentence)
    return msgspec.structs.replace(
        queue, working=queue.working and queue.next is not None, items=_bounded(queue.items)
    )


def halted(queue: Queue) -> Queue:
    """Return a queue that begins no other test; the one that runs goes on."""
    return msgspec.structs.replace(queue, working=False)


def after_finish(queue: Queue, finished: Finished) -> Queue:
    """Return a queue after the end of whatever test; one that is not in the queue changes nothing.

    A test of the queue that somebody went on with by hand is done by that as well.
    """
    for one in queue.items:
        if one.file == finished.file and one.stage is not ItemState.DONE:
            done = finished.status == "complete"
            return ended(queue, one.number, finished.sentence, done=done)
    return queue


def cut_off(queue: Queue) -> Queue:
    """Return a queue whose engine ended without a word: what ran is stopped, nothing works."""
    one = queue.running
    if one is not None:
        words = "the computer or the program ended while it ran"
        queue = ended(queue, one.number, words, done=False)
    return halted(queue)


def line(one: Item) -> str:
    """Return one line about a test for people."""
    name = PurePath(one.file or one.test).name
    return f"{one.number:>4}  {one.stage.value:<8} {name}  {one.sentence}".rstrip()


def _with(queue: Queue, number: int, **changes: object) -> Queue:
    items = tuple(
        msgspec.structs.replace(one, **changes) if one.number == number else one
        for one in queue.items
    )
    return msgspec.structs.replace(queue, items=items)


def _bounded(items: tuple[Item, ...]) -> tuple[Item, ...]:
    done = [one.number for one in items if one.stage is ItemState.DONE]
    forgotten = set(done[: max(0, len(done) - MOST_DONE)])
    return tuple(one for one in items if one.number not in forgotten)
