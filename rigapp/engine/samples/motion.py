"""Recent motion of the crank, for interlocks, pauses and stops."""

from __future__ import annotations

import threading
from collections import deque

import msgspec

STANDING_COUNTS = 2
"""Largest change of the count of a stationary crank: an edge of the encoder may dither."""

ENOUGH_COUNTS = 64
"""Counts from which the quantisation of a speed is 1.6 % or less."""

BLOCKS_KEPT = 4096
"""Stored blocks: with the smallest, longer than LONGEST_S and the longest standstill check."""

LEAST_PACE_S = 0.05
"""Shortest time for the pace of a simulated rig; longer than a block."""

LONGEST_S = 0.4  # longest window of a speed; a slower response is useless for an interlock


class Point(msgspec.Struct, frozen=True, gc=False):
    """End of a block; a Struct, which is created in a tenth of the time of a dataclass.

    sample: device sample index. count: counts turned, in the rig's direction. phase: counts from
    the index, None before the index is known.
    """

    sample: int
    count: int
    host_s: float
    phase: int | None


class MotionWindow:
    """Ends of the last blocks; the processing thread writes, any thread reads."""

    def __init__(
        self, counts_per_revolution: int, sample_rate_Hz: float, index_angle_deg: float
    ) -> None:
        self._turn = counts_per_revolution
        self._rate = sample_rate_Hz
        self._index_deg = index_angle_deg
        self._points: deque[Point] = deque(maxlen=BLOCKS_KEPT)
        self._pace = 1.0
        self._speed_before_gap_rpm: float | None = None
        self._lock = threading.Lock()

    def add(self, first: Point | None, last: Point, keep_s: float = 2.0) -> None:
        """Add the ends of a block; drop points older than keep_s of host and device time."""
        with self._lock:
            if first is not None and not self._points:
                self._points.append(first)
            if self._points and last.sample <= self._points[-1].sample:
                self._points.clear()
            self._points.append(last)
            points = self._points
            while (
                len(points) > 2
                and last.host_s - points[1].host_s > keep_s
                and last.sample - points[1].sample > keep_s * self._rate
            ):
                points.popleft()

    def gap(self) -> None:
        """Discard the points before missing samples, as there is no speed across a gap.

        The previous speed is returned until the samples after the gap suffice for one.
        """
        speed, pace = self.speed_rpm(), self.pace()
        with self._lock:
            self._speed_before_gap_rpm, self._pace = speed, pace
            self._points.clear()

    def newest(self) -> Point | None:
        """Return the end of the latest block."""
        with self._lock:
            return self._points[-1] if self._points else None

    def turns(self) -> tuple[float, float] | None:
        """Return the turns counted up to the latest sample, and its device time in seconds."""
        last = self.newest()
        return None if last is None else (last.count / self._turn, last.sample / self._rate)

    def turns_at(self, host_s: float) -> float | None:
        """Return the turns counted up to a host time, None before later data are received."""
        with self._lock:
            later: Point | None = None
            for point in reversed(self._points):
                if point.host_s <= host_s:
                    if later is None:
                        return None
                    share = (host_s - point.host_s) / (later.host_s - point.host_s)
                    return (point.count + share * (later.count - point.count)) / self._turn
                later = point
        return None

    def speed_rpm(self, window_s: float = 0.05) -> float:
        """Return the mean speed over the last window_s of device time, at least one block.

        For a slow crank the window is extended, up to LONGEST_S, until it has ENOUGH_COUNTS.
        """
        with self._lock:
            if len(self._points) < 2:
                return self._speed_before_gap_rpm or 0.0
            last = self._points[-1]
            first = self._back(window_s)
            if self._speed_before_gap_rpm is not None:
                if last.sample - first.sample < window_s * self._rate:
                    return self._speed_before_gap_rpm
                self._speed_before_gap_rpm = None
        turned = (last.count - first.count) / self._turn
        return 60.0 * turned * self._rate / (last.sample - first.sample)

    def counts_in(self, samples: float, window_s: float) -> float:
        """Return the counts in a number of samples at the mean speed of the last window_s."""
        return abs(self.speed_rpm(window_s)) / 60.0 * self._turn * samples / self._rate

    def standing(self, window_s: float) -> bool:
        """Return whether the count has not changed for window_s of device time."""
        with self._lock:
            if not self._points:
                return False
            last = self._points[-1]
            low = high = last.count
            for point in reversed(self._points):
                low, high = min(low, point.count), max(high, point.count)
                if high - low > STANDING_COUNTS:
                    return False
                if last.sample - point.sample >= window_s * self._rate:
                    return True
        return False

    def pace(self) -> float:
        """Return device time over host time: 1 except for a simulated rig."""
        with self._lock:
            if len(self._points) < 2:
                return self._pace
            first, last = self._points[0], self._points[-1]
        elapsed = last.host_s - first.host_s
        if elapsed <= LEAST_PACE_S:
            return self._pace
        return (last.sample - first.sample) / self._rate / elapsed

    def angle_deg(self, now_s: float) -> float | None:
        """Return the crank angle at a host time, extrapolated; None if unknown."""
        pace = self.pace()
        speed = self.speed_rpm()
        last = self.newest()
        if last is None or last.phase is None:
            return None
        ahead = speed * 6.0 * pace * max(0.0, now_s - last.host_s)
        return (self._index_deg + 360.0 * last.phase / self._turn + ahead) % 360.0

    def _back(self, window_s: float) -> Point:
        last = self._points[-1]
        for point in reversed(self._points):
            elapsed = last.sample - point.sample
            enough = abs(last.count - point.count) >= ENOUGH_COUNTS
            if elapsed >= LONGEST_S * self._rate or (elapsed >= window_s * self._rate and enough):
                return point
        return self._points[0]
