"""Which whole cycles are kept: those of the schedule, and those around a trigger.

A trigger is an alarm that rises, a limit that is passed, or an operator's note. The last
revolutions stay in memory until no trigger can want them any more; wanted ones leave in the
order of the revolutions, none twice. As soon as the oldest one is wanted, it leaves at once: after
a trigger nothing waits.

Memory: ``before`` revolutions, at most ``RING_BYTES``; when fewer fit, the oldest leave early and
are counted in ``shortened``. Room in the file: ``triggered_cycles``; the last bursts of it are kept
for critical alarms. A trigger that has no room is counted in ``refused`` and changes nothing.
"""

from __future__ import annotations

import enum
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rigapp.config.recipe import CyclesSection

if TYPE_CHECKING:  # the window computes the size of a file, and must not load the kernels for it
    from rigapp.engine.values.calibrate import Measured


class Schedule:
    """The revolutions whose whole cycle is kept; the last one of a test always is."""

    def __init__(self, section: CyclesSection, revolutions: int) -> None:
        self._section = section
        self._last = revolutions
        self._wanted: frozenset[int] = frozenset()
        if section.schedule == "logarithmic":
            self._wanted = logarithmic(revolutions, section.per_decade)

    def keeps(self, revolution: int) -> bool:
        """Return whether revolution number ``revolution`` (the first is 1) is kept whole."""
        section = self._section
        if section.schedule == "none":
            return False
        if revolution == self._last:
            return True
        if section.schedule == "every":
            return revolution % section.every_revolutions == 0
        return revolution in self._wanted

    @property
    def any(self) -> bool:
        """Return whether any cycle is kept."""
        return self._section.schedule != "none"

    def planned(self) -> int:
        """Return the number of cycles kept of the whole test."""
        if self._section.schedule == "none":
            return 0
        if self._section.schedule == "every":
            full, rest = divmod(self._last, self._section.every_revolutions)
            return full + (1 if rest else 0)
        return len(self._wanted | {self._last})


def logarithmic(revolutions: int, per_decade: int) -> frozenset[int]:
    """Return revolution numbers spaced evenly in the logarithm: ``per_decade`` in each decade."""
    result: set[int] = set()
    step = 0
    while True:
        number = round(10 ** (step / per_decade))
        if number > revolutions:
            return frozenset(result)
        result.add(number)
        step += 1


RING_BYTES = 64 << 20
"""Memory for revolutions that a trigger may still want."""

FEWEST_BURSTS, MOST_BURSTS = 10, 100
REVOLUTIONS_A_BURST = 2000
"""Revolutions for which space for one burst is reserved, within the two bounds above."""

CRITICAL_BURSTS = 3
"""Bursts reserved for critical alarms."""


class RetentionReason(enum.StrEnum):
    """The reason why a whole cycle is in the file, as written in ``/entry/cycles/why``."""

    SCHEDULED = "scheduled"
    LAST = "last"
    BEFORE = "before"
    TRIGGER = "trigger"
    AFTER = "after"


TRIGGERED = frozenset({RetentionReason.BEFORE, RetentionReason.TRIGGER, RetentionReason.AFTER})


def triggered_cycles(section: CyclesSection, revolutions: int) -> int:
    """Return the cycles around triggers for which a file reserves room."""
    burst = _burst(section)
    bursts = min(MOST_BURSTS, max(FEWEST_BURSTS, revolutions // REVOLUTIONS_A_BURST))
    return min(bursts * burst, revolutions)


def waiting_cycles(section: CyclesSection, revolutions: int, cycle_bytes: int) -> int:
    """Return how many cycles of ``cycle_bytes`` are held in memory, and beside it in the file."""
    if not (_burst(section) or Schedule(section, revolutions).any):
        return 0
    return min(section.before_alarm + 1, max(1, RING_BYTES // cycle_bytes))


def _burst(section: CyclesSection) -> int:
    """Return the cycles that one trigger keeps at most; 0 when nothing is triggered."""
    if section.before_alarm == 0 and section.after_alarm == 0:
        return 0
    return section.before_alarm + 1 + section.after_alarm


@dataclass(slots=True, eq=False)
class RetainedCycle:
    """A revolution in memory; why: the reason to keep it, None without one."""

    number: int
    measured: Measured
    quality: int
    why: RetentionReason | None

    @property
    def size(self) -> int:
        """Return the bytes that it takes."""
        revolution = self.measured.revolution
        return revolution.values.nbytes + revolution.counts.nbytes + revolution.segments.nbytes


class History:
    """Choose the whole cycles of one test; its owner serialises the calls.

    used: triggered cycles that are in the file already (of a resumed test).
    """

    def __init__(
        self,
        section: CyclesSection,
        revolutions: int,
        used: int = 0,
        limit_bytes: int = RING_BYTES,
    ) -> None:
        self.planned = revolutions
        self._schedule = Schedule(section, revolutions)
        self._before, self._after = section.before_alarm, section.after_alarm
        self._burst = _burst(section)
        self._room = triggered_cycles(section, revolutions)
        self._used = used
        self._limit_bytes = limit_bytes
        self._ring: deque[RetainedCycle] = deque()
        self._bytes = 0
        self._due = False
        self._after_left = 0
        self._newest: RetainedCycle | None = None
        self._newest_left = True
        self.decided = 0
        self.refused = 0
        self.shortened = 0

    @property
    def bytes(self) -> int:
        """Return the bytes of the revolutions that wait."""
        return self._bytes

    def trigger(self, critical: bool = False) -> bool:
        """Store the next revolution and its neighbours; False when the file has no space left."""
        if self._burst == 0:
            return False
        if self._due:
            return True
        undecided = sum(cycle.why is None for cycle in self._ring)
        kept_back = 0 if critical else min(CRITICAL_BURSTS * self._burst, self._room // 2)
        if self._used + undecided + 1 + self._after > self._room - kept_back:
            self.refused += 1
            return False
        self._due = True
        return True

    def add(self, number: int, measured: Measured, quality: int = 0) -> list[RetainedCycle]:
        """Take the newest revolution; return those that are to be written now, in order."""
        why = RetentionReason.SCHEDULED if self._schedule.keeps(number) else None
        if self._due:
            self._mark_before()
            self._used += why is None
            why, self._after_left = RetentionReason.TRIGGER, self._after
        elif self._after_left > 0:
            self._after_left -= 1
            if why is None:
                why = RetentionReason.AFTER
                self._used += 1
        entry = RetainedCycle(number, measured, quality, why)
        self._newest, self._newest_left = entry, False
        self._ring.append(entry)
        self._bytes += entry.size
        leaving = list(self._leave())
        if not self._newest_left:
            entry.measured = measured.kept()
        return leaving

    def waiting(self) -> RetainedCycle | None:
        """Return the newest revolution while a trigger may want it, None once it has left."""
        newest = self._newest
        if newest is None or (self._newest_left and newest.why is not None):
            return None
        return newest if self._burst or self._schedule.any else None

    def close(self) -> list[RetainedCycle]:
        """End the test and return the rest to write, the last revolution among it."""
        if self._due:
            self._mark_before()
        newest = self._newest
        if newest is not None and newest.why is None and self._schedule.any:
            newest.why = RetentionReason.LAST
            if self._newest_left:
                self._ring.append(newest)
        leaving = [cycle for cycle in self._ring if cycle.why is not None]
        self._ring.clear()
        self._bytes = 0
        if newest is not None:
            self.decided = newest.number
        return leaving

    def _mark_before(self) -> None:
        self._due = False
        for cycle in self._ring:
            if cycle.why is None:
                cycle.why = RetentionReason.BEFORE
                self._used += 1

    def _leave(self) -> Iterator[RetainedCycle]:
        ring = self._ring
        while ring:
            full = self._bytes > self._limit_bytes and len(ring) > 1
            if ring[0].why is None and len(ring) <= self._before and not full:
                return
            self.shortened += full and ring[0].why is None and len(ring) <= self._before
            cycle = ring.popleft()
            self._bytes -= cycle.size
            self.decided = cycle.number
            self._newest_left |= cycle is self._newest
            if cycle.why is not None:
                yield cycle
