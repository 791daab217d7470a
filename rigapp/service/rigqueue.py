"""The queue of a rig: add tests, and a thread that starts the next test when one ends."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from rigapp.checks.fit import check_fit
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_test
from rigapp.config.rig import RigFile
from rigapp.process.threads import Worker
from rigapp.queue.items import Queue, added
from rigapp.queue.store import QueueStore
from rigapp.queue.worker import QueueActions, QueueWorker
from rigapp.schema.notices import Finished, Notices
from rigapp.service.registry import kept_of
from rigapp.texts import say, sentence_of_error

log = logging.getLogger(__name__)

POLL_S = 0.2
TRY_AGAIN_S = 2.0
"""Time after which a failed write of the queue is repeated."""
SILENCE_S = 150.0
"""Longest time for starting a test, that of its request."""
END_S = 20.0
"""Longest wait, at the end of an engine, for a test that is starting."""


def add_tests(store: QueueStore, rig: RigFile, tests: Sequence[Path], folder: Path) -> Queue:
    """Append tests to a queue and return it; raises UnusableInput and then adds none.

    Each must be readable and fit the rig.
    """
    for path in tests:
        check_fit(rig, read_test(path))
    paths = [str(path.resolve()) for path in tests]
    return store.change(lambda queue: added(queue, paths, str(folder.resolve())))


class RigQueue:
    """The queue of one rig, with the thread that processes it."""

    def __init__(self, rig: Path, hands: QueueActions, ends: Notices) -> None:
        """Continue the stored queue; an unusable one is reported but stops no test."""
        self.store = QueueStore(kept_of(rig, "queues"), rig)
        self._worker = QueueWorker(self.store, hands)
        self._report = hands.tell
        self._ends = ends
        self._unnoted: Finished | None = None
        self._thread = Worker("queue", self._record_end, self._thread_failed, SILENCE_S)
        self.start, self.stop, self.view = self._worker.start, self._worker.stop, self._worker.view
        try:
            self._worker.take_up()
        except UnusableInput as error:
            self._report(sentence_of_error(error))
        self._thread.start()

    def halt(self) -> None:
        """Start no further test; ``close`` records the ends."""
        self._thread.halt()

    def close(self) -> None:
        """Record the ends of the engine's tests, and end the thread."""
        self._thread.halt()
        if not self._thread.join(END_S):
            log.warning("the queue did not end within %g s", END_S)
            return
        try:
            while self._unnoted is not None or self._record_notice(0.0):
                if self._unnoted is not None:
                    self._worker.note(self._unnoted)
                self._unnoted = None
        except UnusableInput as error:
            log.warning("how the last test ended is not noted in the queue: %s", error)

    def _record_notice(self, wait_s: float) -> bool:
        """Process the next notice; return whether there was one."""
        notice = self._ends.get(wait_s)
        if isinstance(notice, Finished):
            self._unnoted = notice
        return notice is not None

    def _record_end(self) -> None:
        if self._unnoted is None:
            self._record_notice(POLL_S)
        if self._unnoted is None or self._thread.halting:
            return
        try:
            self._worker.finished(self._unnoted)
        except UnusableInput as error:
            self._report(sentence_of_error(error))
            self._thread.pause(TRY_AGAIN_S)
        else:
            self._unnoted = None

    def _thread_failed(self, worker: Worker, error: BaseException) -> None:
        self._report(say("The queue failed ‹{}›.", repr(error)))
