"""Work off the screen's thread: bounded, named, results delivered to the screen's thread."""

from __future__ import annotations

import logging
import queue
import threading
from collections.abc import Callable
from functools import partial
from typing import Any

log = logging.getLogger(__name__)

Done = Callable[[Any], None]
Failed = Callable[[Exception], None]


class TaskWorker:
    """Run calls one after another on a thread of its own.

    At most ``bound`` calls wait; a further one is refused, so that nothing piles up behind a call
    that hangs. Results are delivered by ``deliver``, on the thread that calls it.
    """

    def __init__(self, name: str, bound: int = 16) -> None:
        self._calls: queue.Queue[tuple[Callable[[], Any], Done, Failed] | None] = queue.Queue(bound)
        self._results: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._waiting = 0
        self._thread = threading.Thread(target=self._work, name=name, daemon=True)
        self._thread.start()

    def submit(self, call: Callable[[], Any], done: Done, failed: Failed) -> bool:
        """Queue a call; return False when the queue is full."""
        try:
            self._calls.put_nowait((call, done, failed))
        except queue.Full:
            return False
        self._waiting += 1
        return True

    @property
    def idle(self) -> bool:
        """Return whether every call so far has ended and its result was delivered."""
        return self._waiting == 0

    @property
    def ended(self) -> bool:
        """Return whether its thread has ended, so that no call runs any more."""
        return not self._thread.is_alive()

    def deliver(self) -> None:
        """Deliver the finished results."""
        for _ in range(self._results.qsize()):
            result = self._results.get_nowait()
            self._waiting -= 1
            result()

    def close(self, timeout_s: float = 2.0) -> None:
        """End the thread after the present call; a call that hangs is left to the daemon thread."""
        try:
            self._calls.put_nowait(None)
        except queue.Full:
            log.warning("Thread %s still has %d calls", self._thread.name, self._calls.qsize())
            return
        self._thread.join(timeout_s)

    def _work(self) -> None:
        while (item := self._calls.get()) is not None:
            call, done, failed = item
            try:
                result = call()
            except Exception as error:
                self._results.put(partial(failed, error))
            else:
                self._results.put(partial(done, result))
