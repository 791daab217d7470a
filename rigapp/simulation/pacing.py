"""How fast the plant's time runs, and the devices': pure rules, told the wall clock.

Never slower than real time, so that a host which does not read loses data as with a real device.
Never faster than the chosen speed, nor than the host takes the data. Without a host that takes data
the plant runs in real time, since the drive's watchdog runs on the wall clock: whatever the speed,
a dead engine stops the spindle within its time-out and the coasting lasts as long as it would.

The devices' own time, on which the drive's watchdog runs, is that of their process (``owntime``).
"""

from __future__ import annotations

import math

LONGEST_CATCH_UP_S = 1.0  # what a host lost longer ago it would not get from a device either
BURST_S = 0.1  # shorter than any time-out of a host


class PlantPace:
    """Say how much plant time is due; ``speed`` times real time, or inf for as fast as taken."""

    def __init__(self, speed: float, now_s: float) -> None:
        self.speed = speed
        self._last = now_s
        self._must = 0.0
        self._may = 0.0

    @property
    def fast(self) -> bool:
        """Tell whether the speed is above real time at all."""
        return self.speed > 1.0

    def tick(self, now_s: float) -> None:
        """Let the wall clock advance to now."""
        passed = max(0.0, now_s - self._last)
        self._last = now_s
        self._must = min(self._must + passed * min(1.0, self.speed), LONGEST_CATCH_UP_S)
        if math.isinf(self.speed):
            self._may = math.inf
        else:
            burst = max(BURST_S * self.speed, self._must)
            self._may = min(self._may + passed * self.speed, burst)

    def due(self, chunk_s: float, *, taken: bool) -> bool:
        """Tell whether a chunk is due; taken: a host streams and has read what it got."""
        if self._must >= chunk_s:
            return True
        return self.fast and taken and self._may >= chunk_s

    def advanced(self, chunk_s: float) -> None:
        """Take note that the plant advanced."""
        self._must = max(0.0, self._must - chunk_s)
        self._may = max(0.0, self._may - chunk_s)

    def wait_s(self, chunk_s: float, *, may_be_taken: bool) -> float:
        """Return for how long nothing is due; 0 when only the host is waited for."""
        wait = (chunk_s - self._must) / min(1.0, self.speed)
        if self.fast and may_be_taken:
            fast_wait = 0.0 if math.isinf(self.speed) else (chunk_s - self._may) / self.speed
            wait = min(wait, fast_wait)
        return max(0.0, wait)
