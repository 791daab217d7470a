"""Periods of polling and drawing: short in a test, long while idle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QSocketNotifier, QTimer
from PySide6.QtWidgets import QWidget

from rigapp.gui.window.watchdog import IDLE_PERIOD_S, PERIOD_S, Watchdog


@dataclass(frozen=True, slots=True)
class Rhythm:
    """Periods of polling for news, of parts of the slow drawing, and of the watchdog's beats."""

    look_ms: int
    part_ms: int
    beat_s: float


IN_TEST = Rhythm(20, 25, PERIOD_S)
"""Rhythm in a test; news of the engine is drawn when it comes."""

IDLE = Rhythm(250, 100, IDLE_PERIOD_S)
"""Rhythm while idle, which uses little processor time; news waits for the next poll."""

STATE_EVERY = 10
"""Number of polls between two updates of the state bar without news, since its ages increase."""

FAST_EVERY = 4
"""Parts of the slow drawing between two drawings of the newest revolution, for its options."""

SLOW_EVERY = 20
"""Number of parts of the drawing of trends and tables: in a test each is drawn twice a second."""


class Pulse:
    """Timers for polling and for parts of the drawing in a rhythm, and the watchdog for stalls.

    In a test the engine's socket ends the waiting of the poll, so that no time is lost.
    """

    def __init__(
        self,
        look: Callable[[], None],
        draw_part: Callable[[], None],
        watchdog: Watchdog,
        on: QWidget,
    ) -> None:
        self.look, self._part, self._watchdog = QTimer(on), QTimer(on), watchdog
        self._look = look
        self.look.timeout.connect(look)
        self._part.timeout.connect(draw_part)
        self._notifier: QSocketNotifier | None = None
        self.rhythm: Rhythm | None = None
        self.keep(IN_TEST)

    def keep(self, rhythm: Rhythm) -> None:
        """Set the rhythm."""
        if rhythm is not self.rhythm:  # setting its interval restarts a timer
            self.rhythm = rhythm
            self.look.setInterval(rhythm.look_ms)
            self._part.setInterval(rhythm.part_ms)
            self._watchdog.beat_every(rhythm.beat_s)
            self._notify()

    def listen(self, handle: int | None) -> None:
        """Poll as soon as a handle becomes readable; None: only by the timer."""
        if handle == (None if self._notifier is None else int(self._notifier.socket())):
            return
        if self._notifier is not None:
            self._notifier.setEnabled(False)
            self._notifier.deleteLater()
            self._notifier = None
        if handle is not None:
            self._notifier = QSocketNotifier(handle, QSocketNotifier.Type.Read, self.look)
            self._notifier.activated.connect(lambda: self._look())
            self._notify()

    def _notify(self) -> None:
        if self._notifier is not None:
            self._notifier.setEnabled(self.rhythm is IN_TEST)

    def start(self) -> None:
        """Start the timers."""
        for timer in (self.look, self._part, self._watchdog):
            timer.start()

    def stop(self) -> None:
        """Stop the timers and forget the handle."""
        self.listen(None)
        for timer in (self.look, self._part, self._watchdog):
            timer.stop()
