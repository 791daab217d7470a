"""Notice samples that went missing unseen: the device's clock falls behind the host's."""

from __future__ import annotations

import math

WINDOW_S = 2.0  # the least delay of so long is free of the jitter of single blocks
TOLERANCE_S = 0.2  # more is no jitter of a host: time was lost


class TimeWatch:
    """Compare device time with host time.

    A late reader delays a block, but the blocks after it come early: the smallest delay within a
    window tells nothing of it. A delay that stays is lost data. Only for a rig in real time.
    """

    def __init__(self, sample_rate_Hz: float) -> None:
        self._rate = sample_rate_Hz
        self._level = math.nan
        self._smallest = math.inf
        self._window_end = math.nan

    def restart(self) -> None:
        """Forget the past, after a known gap."""
        self._level = math.nan
        self._smallest = math.inf
        self._window_end = math.nan

    def add(self, end_sample: int, host_s: float) -> float:
        """Take the end of a block; return the seconds by which time has jumped, else 0."""
        delay = host_s - end_sample / self._rate
        if math.isnan(self._window_end):
            self._window_end = host_s + WINDOW_S
        self._smallest = min(self._smallest, delay)
        if host_s < self._window_end:
            return 0.0
        level, self._level = self._level, self._smallest
        self._smallest = math.inf
        self._window_end = host_s + WINDOW_S
        if math.isnan(level) or self._level - level < TOLERANCE_S:
            return 0.0
        return self._level - level
