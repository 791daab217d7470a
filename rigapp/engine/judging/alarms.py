"""Alarm list after ISA-18.2: present and past alarms, and the operator's actions.

States of an alarm: *unacknowledged* and *acknowledged* while its condition holds; *returned* if
the condition ended before the acknowledgement; *latched* if it ended but must be reset; *shelved*
for a limited time, with a reason. Normal alarms are not on the list. Shelving hides the
annunciation only, not the action of limits and interlocks. *First out* is the first critical alarm
since the last reset, also if it or another one is raised again.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass

from rigapp.schema.alarms import Cause
from rigapp.schema.loglines import AlarmChange, What
from rigapp.schema.messages import Alarm, Ends, Severity
from rigapp.schema.states import Refused
from rigapp.texts import Sentence, joined

LONGEST_SHELF_S = 12 * 3600.0  # a shift, so that the next one has no hidden alarm

Changed = Callable[[Alarm, AlarmChange, str], None]
"""Called with each change: the alarm after it, the change, and its originator."""


@dataclass(slots=True)
class _Entry:
    cause: Cause
    raised_at: float
    revolution: int
    first_out: bool
    active: bool = True
    acknowledged: bool = False
    shelved_until: float = 0.0

    def state(self, now: float) -> str:
        if self.shelved_until > now:
            return "shelved"
        if self.active:
            return "acknowledged" if self.acknowledged else "unacknowledged"
        return "latched" if self.cause.kind.latched else "returned"

    def alarm(self, now: float) -> Alarm:
        cause, kind = self.cause, self.cause.kind
        return Alarm(
            key=cause.key,
            severity=kind.severity,
            title=cause.title,
            cause=cause.sentence,
            consequence=Sentence(kind.consequence),
            action=Sentence(kind.action),
            raised_at=self.raised_at,
            revolution=self.revolution,
            active=self.active,
            acknowledged=self.acknowledged,
            first_out=self.first_out,
            state=self.state(now),
            ends=kind.ends,
            value=cause.value,
        )


class AlarmBook:
    """Alarm list; thread-safe.

    clock: UTC seconds. on_change: called outside the lock, in the caller's thread. elapsed:
    monotonic seconds, for shelving.
    """

    def __init__(
        self,
        clock: Callable[[], float],
        on_change: Changed,
        elapsed: Callable[[], float] | None = None,
    ) -> None:
        self._clock = clock
        self._elapsed = elapsed or clock
        self._on_change = on_change
        self._entries: dict[str, _Entry] = {}
        self._lock = threading.Lock()
        self._first_out_assigned = False
        self._claimed = ""
        self._shelved = False

    def claim_first_out(self, cause: Cause) -> None:
        """Reserve first-out for this alarm, if it is not assigned, before it is raised.

        The end of a test commands the drive before it raises its alarm.
        """
        with self._lock:
            if cause.kind.latched and not self._first_out_assigned:
                self._first_out_assigned = True
                self._claimed = cause.key

    def raise_alarm(self, cause: Cause, revolution: int = 0) -> bool:
        """Raise an alarm, or update its text if it is active; return whether it is new."""
        now = self._elapsed()
        with self._lock:
            entry = self._entries.get(cause.key)
            if entry is not None and entry.active:
                entry.cause = cause
                return False
            free = not self._first_out_assigned or self._claimed == cause.key
            first = cause.kind.latched and free
            self._first_out_assigned |= first
            self._claimed = "" if first else self._claimed
            fresh = _Entry(cause, self._clock(), revolution, first)
            if entry is not None:
                fresh.first_out |= entry.first_out
                fresh.shelved_until = entry.shelved_until
            self._entries[cause.key] = fresh
            alarm = fresh.alarm(now)
        self._notify("raised", alarm, "engine", first_out=first)
        return True

    def clear(self, key: str) -> None:
        """Record the end of the condition of an alarm."""
        now = self._elapsed()
        with self._lock:
            entry = self._entries.get(key)
            if entry is None or not entry.active:
                return
            entry.active = False
            alarm = entry.alarm(now)
            if entry.acknowledged and not entry.cause.kind.latched and entry.shelved_until <= now:
                del self._entries[key]
        self._notify("cleared", alarm, "engine")

    def clear_ended_by(self, *ends: Ends) -> None:
        """Clear the alarms whose conditions end in one of these ways."""
        with self._lock:
            keys = [key for key, entry in self._entries.items() if entry.cause.kind.ends in ends]
        for key in keys:
            self.clear(key)

    def acknowledge(self, key: str, operator: str) -> Alarm:
        """Acknowledge an alarm; raise Refused for an unknown key."""
        now = self._elapsed()
        with self._lock:
            entry = self._find(key)
            entry.acknowledged = True
            alarm = entry.alarm(now)
            if not entry.active and not entry.cause.kind.latched:
                del self._entries[key]
        self._notify("acknowledged", alarm, operator)
        return alarm

    def shelve(self, key: str, reason: str, seconds: float, operator: str) -> Alarm:
        """Hide an alarm for a limited time, with a reason; raise Refused."""
        if not reason.strip():
            raise Refused("an alarm is shelved only with a reason; say why")
        if not 0 < seconds <= LONGEST_SHELF_S:
            raise Refused(
                "an alarm can be shelved for at most {:g} h, not {:g} h",
                LONGEST_SHELF_S / 3600,
                seconds / 3600,
            )
        now = self._elapsed()
        with self._lock:
            entry = self._find(key)
            entry.shelved_until = now + seconds
            self._shelved = True
            alarm = entry.alarm(now)
        self._notify("shelved", alarm, operator, reason=reason.strip(), seconds=seconds)
        return alarm

    def look(self) -> None:
        """Unshelve alarms after their time; to be called periodically."""
        if not self._shelved:
            return
        now = self._elapsed()
        with self._lock:
            expired = [
                (key, entry)
                for key, entry in self._entries.items()
                if 0.0 < entry.shelved_until <= now
            ]
            for key, entry in expired:
                entry.shelved_until = 0.0
                if entry.acknowledged and not entry.active and not entry.cause.kind.latched:
                    del self._entries[key]
            self._shelved = any(entry.shelved_until > 0.0 for entry in self._entries.values())
            unshelved = [entry.alarm(now) for _, entry in expired]
        for alarm in unshelved:
            self._notify("unshelved", alarm, "engine")

    def reset(self, operator: str) -> None:
        """Remove latched and returned alarms from the list.

        Raises Refused while one is active or not acknowledged.
        """
        now = self._elapsed()
        with self._lock:
            for entry in self._entries.values():
                title, kind = entry.cause.title, entry.cause.kind
                if kind.latched and entry.active:
                    raise Refused('"{}" is still active: {}', title, kind.action)
                if kind.latched and not entry.acknowledged:
                    raise Refused('"{}" is not acknowledged; do that first', title)
            cleared = [entry.alarm(now) for entry in self._entries.values() if not entry.active]
            self._entries = {k: e for k, e in self._entries.items() if e.active}
            self._first_out_assigned = False
            self._claimed = ""
        for alarm in cleared:
            self._notify("reset", alarm, operator)

    def blocking(self) -> Alarm | None:
        """Return a critical alarm that prevents a start, or None."""
        now = self._elapsed()
        with self._lock:
            for entry in self._entries.values():
                if entry.cause.kind.latched:
                    return entry.alarm(now)
        return None

    def is_active(self, key: str) -> bool:
        """Return whether an alarm is active."""
        with self._lock:
            entry = self._entries.get(key)
            return entry is not None and entry.active

    def alarms(self) -> tuple[Alarm, ...]:
        """Return the list: critical alarms first, oldest first."""
        now = self._elapsed()
        with self._lock:
            result = [entry.alarm(now) for entry in self._entries.values()]
        return tuple(
            sorted(result, key=lambda a: (a.severity is not Severity.CRITICAL, a.raised_at))
        )

    def _notify(
        self,
        what: What,
        alarm: Alarm,
        who: str,
        *,
        first_out: bool = False,
        reason: str = "",
        seconds: float = 0.0,
    ) -> None:
        raised = what == "raised"
        with self._lock:
            listed = what != "reset" and alarm.key in self._entries
        change = AlarmChange(
            what=what,
            title=alarm.title,
            listed=listed,
            active=alarm.active,
            acknowledged=alarm.acknowledged,
            first_out=first_out,
            cause=alarm.cause if raised else "",
            consequence=alarm.consequence if raised else "",
            action=alarm.action if raised else "",
            ends=alarm.ends if raised else Ends.SEEN,
            value=alarm.value if raised else None,
            reason=reason,
            seconds=seconds,
        )
        self._on_change(alarm, change, who)

    def _find(self, key: str) -> _Entry:
        entry = self._entries.get(key)
        if entry is None:
            known = joined(", ", self._entries) or "none"
            raise Refused('there is no alarm "{}"; on the list are: {}', key, known)
        return entry
