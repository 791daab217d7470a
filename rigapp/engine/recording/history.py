"""Selection of the complete cycles to store: those of the schedule, and those around a trigger.

A trigger is a raised alarm, an exceeded limit, or an operator's note. The last revolutions are held
in memory until no later trigger can select them; selected ones are returned in the order of the
revolutions, each once. The oldest one is returned as soon as it is selected, so that nothing waits
after a trigger.

Memory: ``before`` revolutions, at most ``RING_BYTES``; if fewer fit, the oldest are dropped early
and counted in ``shortened``. Space in the file: ``triggered_cycles``; its last bursts are reserved
for critical alarms. A trigger without space is counted in ``refused`` and ignored.
"""

from __future__ import annotations

import enum
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rigapp.config.recipe import CyclesSection

if TYPE_CHECKING:  # the window uses this for the size of a file, without loading kernels
    from rigapp.engine.values.calibrate import Measured


class Schedule:
    """Revolutions whose complete cycle is stored; always includes the last one of a test."""

    def __init__(self, section: CyclesSection, revolutions: int) -> None:
        self._section = section
        self._last = revolutions
        self._wanted: frozenset[int] = frozenset()
        if section.schedule == "logarithmic":
            self._wanted = logarithmic(revolutions, section.per_decade)

    def keeps(self, revolution: int) -> bool:
        """Return whether the cycle of a revolution (the first is 1) is stored."""
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
        """Return whether any cycle is stored."""
        return self._section.schedule != "none"

    def planned(self) -> int:
        """Return the number of stored cycles of the test."""
        if self._section.schedule == "none":
            return 0
        if self._section.schedule == "every":
            full, rest = divmod(self._last, self._section.every_revolutions)
            return full + (1 if rest else 0)
        return len(self._wanted | {self._last})


def logarithmic(revolutions: int, per_decade: int) -> frozenset[int]:
    """Return logarithmically spaced revolution numbers, ``per_decade`` in each decade."""
    result: set[int] = set()
    step = 0
    while True:
        number = round(10 ** (step / per_decade))
        if number > revolutions:
            return frozenset(result)
        result.add(number)
        step += 1


RING_BYTES = 64 << 20
"""Memory for revolutions that a trigger may still select."""

FEWEST_BURSTS, MOST_BURSTS = 10, 100
REVOLUTIONS_A_BURST = 2000
"""Revolutions per burst for which space is reserved, within the two bounds above."""

CRITICAL_BURSTS = 3
"""Bursts that are reserved for critical alarms."""


class RetentionReason(enum.StrEnum):
    """Why a complete cycle is in the file, as in ``/entry/cycles/why``."""

    SCHEDULED = "scheduled"
    LAST = "last"
    BEFORE = "before"
    TRIGGER = "trigger"
    AFTER = "after"


TRIGGERED = frozenset({RetentionReason.BEFORE, RetentionReason.TRIGGER, RetentionReason.AFTER})


def triggered_cycles(section: CyclesSection, revolutions: int) -> int:
    """Return the number of cycles around triggers for which a file reserves space."""
    burst = _burst(section)
    bursts = min(MOST_BURSTS, max(FEWEST_BURSTS, revolutions // REVOLUTIONS_A_BURST))
    return min(bursts * burst, revolutions)


def waiting_cycles(section: CyclesSection, revolutions: int, cycle_bytes: int) -> int:
    """Return the number of cycles of ``cycle_bytes`` that wait in memory, and in the file."""
    if not (_burst(section) or Schedule(section, revolutions).any):
        return 0
    return min(section.before_alarm + 1, max(1, RING_BYTES // cycle_bytes))


def _burst(section: CyclesSection) -> int:
    """Return the largest number of cycles per trigger; 0 without triggers."""
    if section.before_alarm == 0 and section.after_alarm == 0:
        return 0
    return section.before_alarm + 1 + section.after_alarm


@dataclass(slots=True, eq=False)
class RetainedCycle:
    """A revolution in memory; why: the reason to store it, None so far."""

    number: int
    measured: Measured
    quality: int
    why: RetentionReason | None

    @property
    def size(self) -> int:
        """Return its size in bytes."""
        revolution = self.measured.revolution
        return revolution.values.nbytes + revolution.counts.nbytes + revolution.segments.nbytes


class History:
    """Selection of the complete cycles of one test; not thread-safe.

    used: triggered cycles already in the file (of a resumed test).
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
        """Return the size of the waiting revolutions in bytes."""
        return self._bytes

    def trigger(self, critical: bool = False) -> bool:
        """Select the next revolution and those around it; return False without space."""
        if self._burst == 0:
            return False
        if self._due:
            return True
        undecided = sum(cycle.why is None for cycle in self._ring)
        reserved = 0 if critical else min(CRITICAL_BURSTS * self._burst, self._room // 2)
        if self._used + undecided + 1 + self._after > self._room - reserved:
            self.refused += 1
            return False
        self._due = True
        return True

    def add(self, number: int, measured: Measured, quality: int = 0) -> list[RetainedCycle]:
        """Add the latest revolution; return those to be written now, in order."""
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
        """Return the latest revolution while a trigger may select it, else None."""
        newest = self._newest
        if newest is None or (self._newest_left and newest.why is not None):
            return None
        return newest if self._burst or self._schedule.any else None

    def close(self) -> list[RetainedCycle]:
        """End the test; return the remaining cycles to write, including the last revolution."""
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
