"""The queue of a rig: adding tests, and its thread: when a test ends, the next one begins."""

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

LOOK_S = 0.2
TRY_AGAIN_S = 2.0
"""A queue that could not be written is written again after it."""
SILENCE_S = 150.0
"""Beginning a test may take as long as its request."""
END_S = 20.0
"""The end of an engine waits no longer for a test that is just starting."""


def add_tests(store: QueueStore, rig: RigFile, tests: Sequence[Path], folder: Path) -> Queue:
    """Put tests at the end of a queue, and return it; raise UnusableInput, none is added then.

    Each can be read, and fits the rig.
    """
    for path in tests:
        check_fit(rig, read_test(path))
    paths = [str(path.resolve()) for path in tests]
    return store.change(lambda queue: added(queue, paths, str(folder.resolve())))


class RigQueue:
    """The queue of one rig, with the thread that works through it."""

    def __init__(self, rig: Path, hands: QueueActions, ends: Notices) -> None:
        """Continue the stored queue; an unusable one is reported, and stops no test."""
        self.store = QueueStore(kept_of(rig, "queues"), rig)
        self._worker = QueueWorker(self.store, hands)
        self._tell = hands.tell
        self._ends = ends
        self._unnoted: Finished | None = None
        self._thread = Worker("queue", self._heed, self._died, SILENCE_S)
        self.start, self.stop, self.view = self._worker.start, self._worker.stop, self._worker.view
        try:
            self._worker.take_up()
        except UnusableInput as error:
            self._tell(sentence_of_error(error))
        self._thread.start()

    def halt(self) -> None:
        """Begin no further test; ``close`` notes the ends."""
        self._thread.halt()

    def close(self) -> None:
        """Note how the engine's tests ended, and end the thread."""
        self._thread.halt()
        if not self._thread.join(END_S):
            log.warning("the queue did not end within %g s", END_S)
            return
        try:
            while self._unnoted is not None or self._heard(0.0):
                if self._unnoted is not None:
                    self._worker.note(self._unnoted)
                self._unnoted = None
        except UnusableInput as error:
            log.warning("how the last test ended is not noted in the queue: %s", error)

    def _heard(self, wait_s: float) -> bool:
        """Take the next notice, if there is one."""
        notice = self._ends.get(wait_s)
        if isinstance(notice, Finished):
            self._unnoted = notice
        return notice is not None

    def _heed(self) -> None:
        if self._unnoted is None:
            self._heard(LOOK_S)
        if self._unnoted is None or self._thread.halting:
            return
        try:
            self._worker.finished(self._unnoted)
        except UnusableInput as error:
            self._tell(sentence_of_error(error))
            self._thread.pause(TRY_AGAIN_S)
        else:
            self._unnoted = None

    def _died(self, worker: Worker, error: BaseException) -> None:
        self._tell(say("The queue failed ‹{}›.", repr(error)))
