"""Carry out requests beside each other, each lane with a bounded number of threads of its own.

The threads are daemons: one that hangs on a device or a file never keeps the process from ending.
"""

from __future__ import annotations

import threading
from collections.abc import Callable

from rigapp.schema.verbs import Lane, verb_of

UNDER_WAY = {Lane.SAFETY: 4, Lane.LOOK: 16, Lane.WORK: 16}
"""Requests that are carried out at once: of each safety verb, and of each other lane."""


class Lanes:
    """Give each request a thread while its lane has one left."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._under_way: dict[str, int] = {}

    @property
    def busy(self) -> bool:
        """Tell whether a request is under way."""
        with self._lock:
            return any(self._under_way.values())

    def submit(self, verb: str, job: Callable[[], None]) -> str:
        """Begin a job of a verb; return why it cannot be begun, "" when it was."""
        lane = verb_of(verb).lane
        name = verb if lane is Lane.SAFETY else lane.value
        bound = UNDER_WAY[lane]
        with self._lock:
            if self._under_way.get(name, 0) >= bound:
                return f"The engine is busy with {bound} requests of this kind; ask again."
            self._under_way[name] = self._under_way.get(name, 0) + 1
        thread = threading.Thread(
            target=self._carry_out, args=(name, job), name=f"request {verb[:32]}", daemon=True
        )
        try:
            thread.start()
        except RuntimeError as error:
            self._leave(name)
            return f"The engine has no room for this request now ‹{error}›; ask again."
        return ""

    def _carry_out(self, name: str, job: Callable[[], None]) -> None:
        try:
            job()
        finally:
            self._leave(name)

    def _leave(self, name: str) -> None:
        with self._lock:
            self._under_way[name] -= 1
