"""Long work in short pieces, between which keys, news and the state bar are handled."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, QTimer

Call = Callable[[], object]

TURN_MS = 10
"""Interval between two pieces: as long as an update by news, and too short to be noticed."""


class ChunkedTask(QTimer):
    """Make calls in order, each in a separate turn of the event loop."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.setInterval(TURN_MS)
        self._calls: deque[Call] = deque()
        self.timeout.connect(self._next)

    def then(self, calls: Iterable[Call]) -> None:
        """Append calls to the pending ones."""
        self._calls.extend(calls)
        if self._calls and not self.isActive():
            self.start()

    def instead(self, calls: Iterable[Call]) -> None:
        """Replace the pending calls."""
        self._calls.clear()
        self.then(calls)

    def _next(self) -> None:
        if self._calls:
            self._calls.popleft()()
        if not self._calls:
            self.stop()
