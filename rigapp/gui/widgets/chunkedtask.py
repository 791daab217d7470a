"""Long work in short pieces: keys, news and the state bar come in between."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, QTimer

Call = Callable[[], object]

TURN_MS = 10
"""Between two pieces: as long as an update by news, and too short to be seen."""


class ChunkedTask(QTimer):
    """Make calls in their order, each in its own turn of the event loop."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.setInterval(TURN_MS)
        self._calls: deque[Call] = deque()
        self.timeout.connect(self._next)

    def then(self, calls: Iterable[Call]) -> None:
        """Make these calls after what is still to be made."""
        self._calls.extend(calls)
        if self._calls and not self.isActive():
            self.start()

    def instead(self, calls: Iterable[Call]) -> None:
        """Make these calls in place of what is still to be made."""
        self._calls.clear()
        self.then(calls)

    def _next(self) -> None:
        if self._calls:
            self._calls.popleft()()
        if not self._calls:
            self.stop()
