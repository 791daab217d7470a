"""How long this computer did not let the engine run, so that simulated devices are not blamed."""

from __future__ import annotations

import threading
from collections import deque

from rigapp.process.processclock import LONGEST_PASS_S, ProcessClock

TICKS_KEPT = 4096  # passes of the loop: minutes; older ones explain no lateness of now


class Lateness:
    """Add up the lateness of one thread's loop, as a sample of what the whole computer does.

    Any thread may ask; ``tick`` belongs to the loop.
    """

    def __init__(self, now_s: float, ran_s: float) -> None:
        """Begin without lateness; ran_s: processor time of the loop's thread so far."""
        self._own = ProcessClock(now_s, ran_s)
        self._ticks = deque([(now_s, 0.0)], TICKS_KEPT)
        self._begun_s = now_s
        self._lock = threading.Lock()

    def tick(self, now_s: float, ran_s: float, waited_s: float) -> None:
        """Take a pass of the loop; waited_s: wait that it asked for since the last one."""
        own_s = self._own.tick(now_s, ran_s, waited_s)
        with self._lock:
            self._ticks.append((now_s, now_s - own_s))

    def since(self, start_s: float, now_s: float) -> float:
        """Return the seconds of lateness between two times, the pass under way included."""
        with self._lock:
            last_s, total = self._ticks[-1]
            before_s, before = next(
                (tick for tick in reversed(self._ticks) if tick[0] <= start_s), self._ticks[0]
            )
        pending = max(0.0, now_s - max(last_s, start_s) - LONGEST_PASS_S)
        return min(total - before + pending, max(0.0, now_s - max(before_s, start_s)))
