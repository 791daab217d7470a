"""How often the window looks for news and draws: often in a test, next to never while it waits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QWidget

from rigapp.gui.window.watchdog import IDLE_PERIOD_S, PERIOD_S, Watchdog


@dataclass(frozen=True, slots=True)
class Rhythm:
    """How often something is done: looks for news, parts of a slow drawing, beats for stalls."""

    look_ms: int
    part_ms: int
    beat_s: float


IN_TEST = Rhythm(10, 25, PERIOD_S)
"""A revolution shall be on the screen 70 ms after its end."""

IDLE = Rhythm(250, 100, IDLE_PERIOD_S)
"""A window that waits shall cost next to nothing."""

STATE_EVERY = 10
"""Looks between two at the state bar when there are no news: its ages grow all the same."""

FAST_EVERY = 4
"""Parts of a slow drawing between two looks at the newest revolution, for what was chosen there."""

SLOW_EVERY = 20
"""Parts in which trends and tables are drawn in turns: in a test each of them twice a second."""


class Pulse:
    """Call for looks and parts of a drawing in the rhythm that is kept, and watch for stalls."""

    def __init__(
        self,
        look: Callable[[], None],
        draw_part: Callable[[], None],
        watchdog: Watchdog,
        on: QWidget,
    ) -> None:
        self.look, self._part, self._watchdog = QTimer(on), QTimer(on), watchdog
        self.look.timeout.connect(look)
        self._part.timeout.connect(draw_part)
        self.rhythm: Rhythm | None = None
        self.keep(IN_TEST)

    def keep(self, rhythm: Rhythm) -> None:
        """Keep a rhythm from now on."""
        if rhythm is not self.rhythm:  # a timer whose interval is set begins anew
            self.rhythm = rhythm
            self.look.setInterval(rhythm.look_ms)
            self._part.setInterval(rhythm.part_ms)
            self._watchdog.beat_every(rhythm.beat_s)

    def start(self) -> None:
        """Begin to call."""
        for one in (self.look, self._part, self._watchdog):
            one.start()

    def stop(self) -> None:
        """Call no more."""
        for one in (self.look, self._part, self._watchdog):
            one.stop()
