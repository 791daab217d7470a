"""Notice samples that went missing unseen: device and encoder fall behind host and drive."""

from __future__ import annotations

import math

WINDOW_S = 2.0  # the least delay of so long is free of the jitter of single blocks
TOLERANCE_S = 0.2  # more is no jitter of a host: time was lost


class LagWatch:
    """Notice a lag that has grown for good.

    A late reader delays a block, but the blocks after it come early: the smallest lag within a
    window is free of it. A lag that stays is lost data.
    """

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Forget the past, after a known gap."""
        self._level = math.nan
        self._smallest = math.inf
        self._window_end = math.nan

    def add(self, lag: float, host_s: float, tolerance: float) -> float:
        """Take a lag; return by how much it has grown for good, 0 within the tolerance."""
        if math.isnan(self._window_end):
            self._window_end = host_s + WINDOW_S
        self._smallest = min(self._smallest, lag)
        if host_s < self._window_end:
            return 0.0
        level, self._level = self._level, self._smallest
        self._smallest = math.inf
        self._window_end = host_s + WINDOW_S
        if math.isnan(level) or self._level - level < tolerance:
            return 0.0
        return self._level - level


class TimeWatch(LagWatch):
    """Compare device time with host time. Only for a rig in real time."""

    def __init__(self, sample_rate_Hz: float) -> None:
        super().__init__()
        self._rate = sample_rate_Hz

    def end(self, end_sample: int, host_s: float) -> float:
        """Take the end of a block; return the seconds by which time has jumped, else 0."""
        return self.add(host_s - end_sample / self._rate, host_s, TOLERANCE_S)
