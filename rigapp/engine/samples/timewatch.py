"""Notice samples that went missing unseen: device and encoder fall behind host and drive."""

from __future__ import annotations

import math

WINDOW_S = 2.0  # the least delay of so long is free of the jitter of single blocks
SHORT_S = 0.3
"""After a jump of the count, which late samples do not show, so much is enough: three answers of
the drive, or fifteen blocks. The first level is taken so, too: one too high hides a gap for a
window, and invents none."""


class LagWatch:
    """Notice a lag that has grown for good.

    A late reader delays a block, but the blocks after it come early: the smallest lag within a
    window is free of it. A lag that stays is lost data. level: the smallest lag of the last window.
    """

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Forget the past; what comes next is the level."""
        self.level = math.nan
        self.look_again()

    def look_again(self) -> None:
        """Begin a short window with the next lag."""
        self._smallest = math.inf
        self._window_end = math.nan
        self._window_s = SHORT_S

    def add(self, lag: float, host_s: float) -> float:
        """Take a lag; return by how much it has grown at the end of a window, else NaN."""
        if math.isnan(self._window_end):
            self._window_end = host_s + self._window_s
        self._smallest = min(self._smallest, lag)
        if host_s < self._window_end:
            return math.nan
        level, self.level = self.level, self._smallest
        self._smallest = math.inf
        self._window_s = WINDOW_S
        self._window_end = host_s + WINDOW_S
        return self.level - level
