"""The time for which this computer let a process run: the wall clock less its lateness.

On a computer that is overloaded, or stands still for a second, host and simulated devices are late
together; that is no reason for a watchdog to fire, nor for a device to count as silent.
"""

from __future__ import annotations

LONGEST_PASS_S = 0.05
"""No pass and no wait of a loop is longer unless the computer makes it so."""
LATENESS_S = 0.001
"""How late a process may be woken on a computer that has nothing else to do."""


class OwnTime:
    """Tell a loop's own time: what it ran or chose to wait since the last ``tick``.

    The time for which it stood in line for a processor, or the whole computer stood still, is left
    out, but for ``LATENESS_S`` a tick. Where nothing else runs it is the wall clock.
    """

    def __init__(self, now_s: float, ran_s: float) -> None:
        """Start with the wall clock; ran_s: processor time of this process so far."""
        self.time_s = now_s
        self._wall_s = now_s
        self._ran_s = ran_s

    def tick(self, now_s: float, ran_s: float, waited_s: float) -> float:
        """Return the own time; waited_s: wait that was asked for since the last call."""
        passed = max(0.0, now_s - self._wall_s)
        own = max(0.0, ran_s - self._ran_s) + waited_s + LATENESS_S
        self._wall_s, self._ran_s = now_s, ran_s
        self.time_s += min(passed, own, LONGEST_PASS_S)
        return self.time_s
