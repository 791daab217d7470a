"""Monitor the event loop: count noticeable stalls and log them once a minute."""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Callable

from PySide6.QtCore import QObject, Qt, QTimer

log = logging.getLogger(__name__)

STALL_S = 0.050  # a shorter pause is not noticed
PERIOD_S = 0.020  # less than half of a stall
IDLE_PERIOD_S = 0.100  # without a test: each beat wakes the processor
AGAIN_AFTER_S = 60.0
"""Minimum time between two log lines, which sum up the stalls."""


class Watchdog(QObject):
    """Beat 50 times a second on the GUI thread and measure the delay of each beat."""

    def __init__(
        self,
        parent: QObject | None = None,
        clock: Callable[[], float] = time.perf_counter,
        own_clock: Callable[[], float] = time.thread_time,
    ) -> None:
        """Make a watchdog; own_clock: processor time of the GUI thread."""
        super().__init__(parent)
        self._clock = clock
        self._own_clock = own_clock
        self._last: float | None = None
        self._last_own = 0.0
        self.stalls = 0
        self.worst_s = 0.0
        self._gathered: list[tuple[float, float]] = []
        self._logged_at = -math.inf
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self.beat)
        self.beat_every(PERIOD_S)

    def beat_every(self, period_s: float) -> None:
        """Set the period of beats; a stall is the additional delay."""
        self._period_s, self._last = period_s, None
        self._timer.setInterval(int(1000 * period_s))

    def start(self) -> None:
        """Start monitoring."""
        self._last = None
        self._timer.start()

    def stop(self) -> None:
        """Stop monitoring, and log the last stalls."""
        self._timer.stop()
        self._log()

    def beat(self) -> None:
        """Record one beat."""
        now, own = self._clock(), self._own_clock()
        if self._last is not None:
            stall = now - self._last - self._period_s
            self.worst_s = max(self.worst_s, stall)
            if stall > STALL_S:
                self.stalls += 1
                self._gathered.append((stall, own - self._last_own))
        if now - self._logged_at >= AGAIN_AFTER_S and self._log():
            self._logged_at = now
        self._last, self._last_own = now, own

    def _log(self) -> bool:
        """Log the gathered stalls in one line; False when there were none."""
        if not self._gathered:
            return False
        longest, own = max(self._gathered)
        log.warning(
            "The window stood still %s, %.0f ms the longest, %.0f ms of them its own work",
            "once" if len(self._gathered) == 1 else f"{len(self._gathered)} times",
            1000.0 * longest,
            1000.0 * own,
        )
        self._gathered.clear()
        return True
