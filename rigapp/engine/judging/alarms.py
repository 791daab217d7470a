"""The alarm list, after ISA-18.2: what is wrong now, what was, and what the operator did.

States of an alarm: *unacknowledged* and *acknowledged* while its condition holds; *returned* when
it went away before anyone acknowledged; *latched* when it went away but must be reset; *shelved*
for a limited time, with a reason. A normal alarm is not on the list. Shelving hides the
annunciation only: limits and interlocks act all the same. *First out* is the critical alarm that
came first since the last reset; it stays so, however often it or another one comes again.
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

LONGEST_SHELF_S = 12 * 3600.0  # a shift: the next one inherits no hidden alarm

Changed = Callable[[Alarm, AlarmChange, str], None]
"""Called with every change: the alarm after it, what happened, and who or what did it."""


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
    """Alarm list; any thread may call it.

    clock: UTC seconds. on_change: called outside the lock, in the caller's thread. elapsed: seconds
    that no change of the computer's clock shortens or lengthens, for shelving.
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
        self._first_out_given = False
        self._claimed = ""
        self._shelved = False

    def claim_first_out(self, cause: Cause) -> None:
        """Let this alarm be the first-out one, if none is yet, though another may be raised before.

        The code that ends a test commands the drive first and raises its alarm then.
        """
        with self._lock:
            if cause.kind.latched and not self._first_out_given:
                self._first_out_given = True
                self._claimed = cause.key

    def raise_alarm(self, cause: Cause, revolution: int = 0) -> bool:
        """Raise an alarm, or renew its words when it is active already; True when it is new."""
        now = self._elapsed()
        with self._lock:
            entry = self._entries.get(cause.key)
            if entry is not None and entry.active:
                entry.cause = cause
                return False
            free = not self._first_out_given or self._claimed == cause.key
            first = cause.kind.latched and free
            self._first_out_given |= first
            self._claimed = "" if first else self._claimed
            fresh = _Entry(cause, self._clock(), revolution, first)
            if entry is not None:
                fresh.first_out |= entry.first_out
                fresh.shelved_until = entry.shelved_until
            self._entries[cause.key] = fresh
            alarm = fresh.alarm(now)
        self._tell("raised", alarm, "engine", first_out=first)
        return True

    def clear(self, key: str) -> None:
        """Record that the condition of an alarm has gone."""
        now = self._elapsed()
        with self._lock:
            entry = self._entries.get(key)
            if entry is None or not entry.active:
                return
            entry.active = False
            alarm = entry.alarm(now)
            if entry.acknowledged and not entry.cause.kind.latched and entry.shelved_until <= now:
                del self._entries[key]
        self._tell("cleared", alarm, "engine")

    def clear_ended_by(self, *ends: Ends) -> None:
        """Clear the alarms whose conditions end in one of these ways."""
        with self._lock:
            keys = [key for key, entry in self._entries.items() if entry.cause.kind.ends in ends]
        for key in keys:
            self.clear(key)

    def acknowledge(self, key: str, operator: str) -> Alarm:
        """Acknowledge an alarm; raise Refused when there is none of that key."""
        now = self._elapsed()
        with self._lock:
            entry = self._find(key)
            entry.acknowledged = True
            alarm = entry.alarm(now)
            if not entry.active and not entry.cause.kind.latched:
                del self._entries[key]
        self._tell("acknowledged", alarm, operator)
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
        self._tell("shelved", alarm, operator, reason=reason.strip(), seconds=seconds)
        return alarm

    def look(self) -> None:
        """Show alarms again whose shelving is over; to be called now and then."""
        if not self._shelved:
            return
        now = self._elapsed()
        with self._lock:
            over = [
                (key, entry)
                for key, entry in self._entries.items()
                if 0.0 < entry.shelved_until <= now
            ]
            for key, entry in over:
                entry.shelved_until = 0.0
                if entry.acknowledged and not entry.active and not entry.cause.kind.latched:
                    del self._entries[key]
            self._shelved = any(entry.shelved_until > 0.0 for entry in self._entries.values())
            back = [entry.alarm(now) for _, entry in over]
        for alarm in back:
            self._tell("unshelved", alarm, "engine")

    def reset(self, operator: str) -> None:
        """Take latched and returned alarms off the list.

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
            self._first_out_given = False
            self._claimed = ""
        for alarm in cleared:
            self._tell("reset", alarm, operator)

    def blocking(self) -> Alarm | None:
        """Return a critical alarm that forbids a start, or None."""
        now = self._elapsed()
        with self._lock:
            for entry in self._entries.values():
                if entry.cause.kind.latched:
                    return entry.alarm(now)
        return None

    def is_active(self, key: str) -> bool:
        """Return whether the condition of an alarm holds."""
        with self._lock:
            entry = self._entries.get(key)
            return entry is not None and entry.active

    def alarms(self) -> tuple[Alarm, ...]:
        """Return the list: critical first, then the oldest first."""
        now = self._elapsed()
        with self._lock:
            result = [entry.alarm(now) for entry in self._entries.values()]
        return tuple(
            sorted(result, key=lambda a: (a.severity is not Severity.CRITICAL, a.raised_at))
        )

    def _tell(
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
