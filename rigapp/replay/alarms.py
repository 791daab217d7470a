"""What a recorded log says of alarms and limits at any revolution, for a replay."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import msgspec
import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import LimitsSection
from rigapp.engine.judging.limits import RuleMonitor, changed_limits, least_margin
from rigapp.schema.loglines import (
    ALARM,
    LIMIT_CHANGED,
    AlarmChange,
    alarm_change,
    limit_change,
    severity_of,
)
from rigapp.schema.messages import NOT_STEADY, Alarm, Event


class RecordedAlarms:
    """Rebuild the alarm list and the limits as they were after a revolution."""

    def __init__(self, events: Sequence[Event], limits: LimitsSection | None) -> None:
        self._events = [e for e in events if e.kind in (ALARM, LIMIT_CHANGED)]
        self._revolutions = np.array([e.revolution for e in self._events], dtype=np.int64)
        self._first_limits = limits
        self._count = -1
        self._alarms: tuple[Alarm, ...] = ()
        self._limits = limits
        self._monitor: RuleMonitor | None = None

    def alarms(self, revolution: int) -> tuple[Alarm, ...]:
        """Return the alarms that were on the list when a revolution was the last one recorded."""
        self._go_to(revolution)
        return self._alarms

    def margin(self, revolution: int, values: Mapping[str, float]) -> tuple[float, str]:
        """Return the least distance to a limit in percent, and which; NaN where nothing is judged.

        values: the columns of the revolution's row.
        """
        self._go_to(revolution)
        judged = not int(values.get("quality", 0)) & NOT_STEADY
        if self._limits is None or self._monitor is None or not judged:
            return math.nan, ""
        worst, name = least_margin(self._monitor, self._limits, values)
        return (worst, name) if math.isfinite(worst) else (math.nan, "")

    def _go_to(self, revolution: int) -> None:
        count = int(np.searchsorted(self._revolutions, revolution, side="right"))
        if count == self._count:
            return
        self._count = count
        listed: dict[str, Alarm] = {}
        limits = self._first_limits
        for event in self._events[:count]:
            if event.kind == ALARM:
                _apply(listed, event)
            elif limits is not None:
                limits = _changed(limits, event)
        self._alarms = tuple(listed.values())
        self._limits = limits
        self._monitor = _monitor(limits)


def _apply(listed: dict[str, Alarm], event: Event) -> None:
    """Take one line of the log into the list of alarms, by key."""
    change = alarm_change(event)
    if change is None:
        return
    if not change.listed:
        listed.pop(event.key, None)
    elif change.what == "raised":
        before = listed.get(event.key)
        first_out = change.first_out or (before is not None and before.first_out)
        listed[event.key] = _raised(change, event, first_out)
    elif event.key in listed:
        listed[event.key] = msgspec.structs.replace(
            listed[event.key],
            active=change.active,
            acknowledged=change.acknowledged,
            state=event.after or listed[event.key].state,
        )


def _raised(change: AlarmChange, event: Event, first_out: bool) -> Alarm:
    return Alarm(
        key=event.key,
        severity=severity_of(event),
        title=change.title,
        cause=change.cause,
        consequence=change.consequence,
        action=change.action,
        raised_at=event.time,
        revolution=event.revolution,
        first_out=first_out,
        state=event.after or "unacknowledged",
        ends=change.ends,
        value=change.value,
    )


def _monitor(limits: LimitsSection | None) -> RuleMonitor | None:
    """Return the judge of rules; None when the log's changes do not make usable rules."""
    try:
        return RuleMonitor(limits.rule) if limits is not None else None
    except UnusableInput:
        return None


def _changed(limits: LimitsSection, event: Event) -> LimitsSection:
    change = limit_change(event)
    if change is None:
        return limits
    try:
        return changed_limits(limits, event.key, change.after)[1]
    except UnusableInput:
        return limits
