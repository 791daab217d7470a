"""Watch the event loop: every stall that an operator could feel is logged with its length."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, QTimer

log = logging.getLogger(__name__)

STALL_S = 0.050
PERIOD_S = 0.020


class Watchdog(QObject):
    """Beat every 20 ms on the screen's thread and note how late a beat comes."""

    def __init__(
        self,
        parent: QObject | None = None,
        clock: Callable[[], float] = time.perf_counter,
        own_clock: Callable[[], float] = time.thread_time,
    ) -> None:
        """Make a watchdog; own_clock: processor time of the screen's thread."""
        super().__init__(parent)
        self._clock = clock
        self._own_clock = own_clock
        self._last: float | None = None
        self._last_own = 0.0
        self.stalls = 0
        self.worst_s = 0.0
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(int(1000 * PERIOD_S))
        self._timer.timeout.connect(self.beat)

    def start(self) -> None:
        """Begin to watch."""
        self._last = None
        self._timer.start()

    def stop(self) -> None:
        """Stop watching."""
        self._timer.stop()

    def beat(self) -> None:
        """Note one beat."""
        now, own = self._clock(), self._own_clock()
        if self._last is not None:
            stall = now - self._last - PERIOD_S
            self.worst_s = max(self.worst_s, stall)
            if stall > STALL_S:
                self.stalls += 1
                log.warning(
                    "The window stood still for %.0f ms, %.0f ms of them its own work",
                    1000.0 * stall,
                    1000.0 * (own - self._last_own),
                )
        self._last, self._last_own = now, own
