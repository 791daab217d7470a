"""A queue of tests as a value, with functions to add, begin and end tests."""

from __future__ import annotations

from pathlib import PurePath

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.schema.notices import Finished
from rigapp.schema.queue import ItemState, QueuedTest
from rigapp.texts import say

MOST_LEFT = 100
"""Maximum number of open tests."""
MOST_DONE = 20
"""Maximum number of finished tests in the list; older ones are dropped, their files stay."""


class Queue(msgspec.Struct, frozen=True):
    """The tests of one rig in their order. working: the next one begins when one is done."""

    rig: str = ""
    working: bool = False
    given: int = 0
    items: tuple[QueuedTest, ...] = ()

    @property
    def next(self) -> QueuedTest | None:
        """Return the next test: the first that is not done."""
        return next((item for item in self.items if item.state is not ItemState.DONE), None)

    @property
    def running(self) -> QueuedTest | None:
        """Return the running test."""
        return next((item for item in self.items if item.state is ItemState.RUNNING), None)


def added(queue: Queue, tests: list[str], folder: str) -> Queue:
    """Return a queue with more tests at its end; raise UnusableInput for too many."""
    left = sum(item.state is not ItemState.DONE for item in queue.items)
    if left + len(tests) > MOST_LEFT:
        raise UnusableInput("A queue holds {} tests at most; {} are in it.", MOST_LEFT, left)
    new = tuple(
        QueuedTest(number, test, folder) for number, test in enumerate(tests, queue.given + 1)
    )
    return msgspec.structs.replace(
        queue, given=queue.given + len(tests), items=_bounded((*queue.items, *new))
    )


def removed(queue: Queue, numbers: list[int]) -> Queue:
    """Return a queue without some tests, whose files stay; raise UnusableInput."""
    known = {item.number: item for item in queue.items}
    for number in numbers:
        if number not in known:
            raise UnusableInput("The queue has no test {}; look at rigapp queue list.", number)
        if known[number].state is ItemState.RUNNING:
            raise UnusableInput("Test {} runs; stop it first.", number)
    items = tuple(item for item in queue.items if item.number not in numbers)
    return msgspec.structs.replace(queue, items=items)


def at_work(queue: Queue) -> Queue:
    """Return a queue that runs one test after another."""
    return msgspec.structs.replace(queue, working=True)


def begun(queue: Queue, number: int, file: str) -> Queue:
    """Return a queue with this test running into a file; unchanged if the queue is paused."""
    if not queue.working:
        return queue
    return _with(queue, number, state=ItemState.RUNNING, file=file, sentence="")


def ended(queue: Queue, number: int, sentence: str, *, done: bool) -> Queue:
    """Return a queue after the end of a test; one that is not done pauses the queue."""
    queue = msgspec.structs.replace(queue, working=queue.working and done)
    state = ItemState.DONE if done else ItemState.STOPPED
    queue = _with(queue, number, state=state, sentence=sentence)
    return msgspec.structs.replace(
        queue, working=queue.working and queue.next is not None, items=_bounded(queue.items)
    )


def put_back(queue: Queue, test: QueuedTest) -> Queue:
    """Return a queue whose test could not begin, as before; the queue is paused."""
    items = tuple(test if other.number == test.number else other for other in queue.items)
    return msgspec.structs.replace(queue, items=items, working=False)


def halted(queue: Queue) -> Queue:
    """Return a paused queue; the running test continues."""
    return msgspec.structs.replace(queue, working=False)


def after_finish(queue: Queue, finished: Finished) -> Queue:
    """Return a queue after the end of any test; one that is not in the queue changes nothing.

    A test of the queue that was resumed manually counts as well.
    """
    for item in queue.items:
        if item.file == finished.file and item.state is not ItemState.DONE:
            done = finished.status == "complete"
            return ended(queue, item.number, finished.sentence, done=done)
    return queue


def cut_off(queue: Queue) -> Queue:
    """Return a queue whose engine died: the running test is stopped, the queue paused."""
    test = queue.running
    if test is not None:
        words = say("the computer or the program stopped during the test")
        queue = ended(queue, test.number, words, done=False)
    return halted(queue)


def line(test: QueuedTest) -> str:
    """Return one line about a test for people."""
    name = PurePath(test.file or test.test).name
    return say(
        "{}  {} {}  {}", f"{test.number:>4}", f"{test.state.value:<8}", name, test.sentence
    ).rstrip()


def _with(queue: Queue, number: int, **changes: object) -> Queue:
    items = tuple(
        msgspec.structs.replace(item, **changes) if item.number == number else item
        for item in queue.items
    )
    return msgspec.structs.replace(queue, items=items)


def _bounded(items: tuple[QueuedTest, ...]) -> tuple[QueuedTest, ...]:
    done = [item.number for item in items if item.state is ItemState.DONE]
    forgotten = set(done[: max(0, len(done) - MOST_DONE)])
    return tuple(item for item in items if item.number not in forgotten)
