"""Run the tests of a queue: begin the next when one is done, stop at the first that is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from rigapp.config.names import new_result
from rigapp.queue.items import Queue, after_finish, at_work, begun, cut_off, ended, halted, put_back
from rigapp.queue.store import QueueStore
from rigapp.schema.details import error_text
from rigapp.schema.notices import Finished
from rigapp.schema.queue import ItemState, QueuedTest
from rigapp.schema.states import Occupied, Refused
from rigapp.texts import say


class Begin(Protocol):
    """Begin a test, or resume it if its file exists."""

    def __call__(self, test: Path, file: Path, operator: str) -> Finished | None:
        """Return how it ended if nothing was left to do; raise one of the expected errors."""


@dataclass(frozen=True, slots=True)
class QueueActions:
    """Functions of the engine that a queue uses.

    expected: errors of ``begin`` that are a sentence for the operator. tell: reports that the queue
    has stopped, and with an empty text that this is over.
    """

    begin: Begin
    expected: tuple[type[Exception], ...]
    tell: Callable[[str], None]


class QueueWorker:
    """Run the tests of a queue in their order, one at a time."""

    def __init__(self, store: QueueStore, hands: QueueActions) -> None:
        self._store = store
        self._hands = hands
        self._operator = ""

    def take_up(self) -> None:
        """Report what the previous engine has left unfinished; nothing begins by itself."""
        left = self._store.read()
        if left.working or left.running is not None:
            left = self._store.change(cut_off)
            if left.next is not None and left.next.state is ItemState.WAITING:
                waiting = _waiting(left)
                self._hands.tell(say("the engine ended between two tests; {} more wait.", waiting))
        self._tell(left)

    def start(self, operator: str) -> Queue:
        """Begin the next test, and continue from there; return the queue.

        Raises Refused for an empty or running queue, and the errors of ``begin``.
        """
        before = self._store.read()
        if before.running is not None:
            raise Refused("test {} of the queue runs already", before.running.number)
        if before.next is None:
            raise Refused("no test waits in the queue; add one: rigapp queue add")
        self._operator = operator
        self._hands.tell("")
        self._store.change(at_work)
        self._run_next(self._begin(before.next))
        return self._store.read()

    def stop(self) -> Queue:
        """Begin no other test; the running one continues to its end."""
        return self._store.change(halted)

    def finished(self, notice: Finished) -> None:
        """Record the end of a test, and begin the next one if it was done."""
        before = self._store.read()
        now = self.note(notice)
        if now != before:
            self._run_next(now)

    def note(self, notice: Finished) -> Queue:
        """Record the end of a test without beginning another; return the queue."""
        return self._store.change(lambda queue: after_finish(queue, notice))

    def view(self) -> Queue:
        """Return the present queue, read again only after a change; empty if unreadable."""
        return self._store.view()

    def _run_next(self, now: Queue) -> None:
        """Begin tests until one runs, none is left, or one could not begin."""
        while now.working and now.running is None and now.next is not None:
            try:
                now = self._begin(now.next)
            except self._hands.expected:
                now = self._store.read()
        if now.running is None:
            self._tell(now)

    def _begin(self, test: QueuedTest) -> Queue:
        """Begin a test unless the queue was stopped meanwhile; return the queue."""
        file = test.file or str(new_result(Path(test.folder), Path(test.test).stem))
        now = self._store.change(lambda queue: begun(queue, test.number, file))
        if now.running is None:
            return now
        try:
            end = self._hands.begin(Path(test.test), Path(file), self._operator)
        except Occupied as error:
            self._store.change(lambda queue: put_back(queue, test))
            self._hands.tell(say("{}; then start the queue again.", error))
            raise
        except Exception as error:
            words = error_text(error, say("The test failed to start."))
            self._store.change(lambda queue: ended(queue, test.number, words, done=False))
            raise
        if end is None:
            return self._store.read()
        return self._store.change(lambda queue: after_finish(queue, end))

    def _tell(self, queue: Queue) -> None:
        test = queue.next
        if test is not None and test.state is ItemState.STOPPED:
            name = Path(test.test).name
            words = say(
                "test {}, {}: {} {} more wait.", test.number, name, test.sentence, _waiting(queue)
            )
            self._hands.tell(words)


def _waiting(queue: Queue) -> int:
    return sum(item.state is ItemState.WAITING for item in queue.items)
