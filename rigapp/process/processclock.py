"""Clock of the time during which a process could run: the wall clock minus its lateness.

On an overloaded or stalled computer, host and simulated devices are late together; this must not
trip a watchdog, nor make a device count as silent.
"""

from __future__ import annotations

import threading
from collections import deque

LONGEST_PASS_S = 0.05
"""Maximum duration of a loop's pass or wait; a longer one is due to the computer."""
DEVICE_SHARE = 0.5
"""Minimum ratio of a simulated device's time to the wall clock's. A watchdog that is due fires
within twice its time on any busy computer: ``--speed max`` keeps it always busy, and a drive that
needs silence until then (``StopSequence.quiet``) gets it for that long."""
LATENESS_S = 0.001
"""Lateness of a wake-up on an idle computer."""


class ProcessClock:
    """Clock of a loop: the time during which it ran or chose to wait since the last ``tick``.

    The time of waiting for a processor, or of a stall of the whole computer, is excluded, except
    ``LATENESS_S`` per tick. On an idle computer it equals the wall clock. least_share: minimum
    ratio to the wall clock's time, unless a single pass is too long.
    """

    def __init__(self, now_s: float, ran_s: float, least_share: float = 0.0) -> None:
        """Start with the wall clock; ran_s: processor time of this process so far."""
        self.time_s = now_s
        self._least_share = least_share
        self._wall_s = now_s
        self._ran_s = ran_s

    def tick(self, now_s: float, ran_s: float, waited_s: float) -> float:
        """Return the loop's time; waited_s: wait requested since the last call."""
        passed = max(0.0, now_s - self._wall_s)
        own = max(0.0, ran_s - self._ran_s) + waited_s + LATENESS_S
        own = max(own, self._least_share * passed)
        self._wall_s, self._ran_s = now_s, ran_s
        self.time_s += min(passed, own, LONGEST_PASS_S)
        return self.time_s


TICKS_KEPT = 4096  # passes of the loop, some minutes; older ones do not explain present lateness


class Lateness:
    """Add up the lateness of one thread's loop, as a sample of the whole computer.

    Any thread may read it; ``tick`` belongs to the loop.
    """

    def __init__(self, now_s: float, ran_s: float) -> None:
        """Start without lateness; ran_s: processor time of the loop's thread so far."""
        self._own = ProcessClock(now_s, ran_s)
        self._ticks = deque([(now_s, 0.0)], TICKS_KEPT)
        self._begun_s = now_s
        self._lock = threading.Lock()

    def tick(self, now_s: float, ran_s: float, waited_s: float) -> None:
        """Record a pass of the loop; waited_s: wait requested since the last one."""
        own_s = self._own.tick(now_s, ran_s, waited_s)
        with self._lock:
            self._ticks.append((now_s, now_s - own_s))

    def since(self, start_s: float, now_s: float) -> float:
        """Return the seconds of lateness between two times, including the present pass."""
        with self._lock:
            last_s, total = self._ticks[-1]
            before_s, before = next(
                (tick for tick in reversed(self._ticks) if tick[0] <= start_s), self._ticks[0]
            )
        pending = max(0.0, now_s - max(last_s, start_s) - LONGEST_PASS_S)
        return min(total - before + pending, max(0.0, now_s - max(before_s, start_s)))
