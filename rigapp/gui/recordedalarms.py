"""What a recorded log says of alarms and limits at any revolution, for a replay."""

from __future__ import annotations

import inspect
import math
import re
from collections.abc import Mapping, Sequence
from functools import cache

import msgspec
import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import LimitsSection
from rigapp.engine import causes
from rigapp.engine.causes import Cause
from rigapp.engine.criteria import TITLES
from rigapp.engine.limits import RuleMonitor, changed_limits
from rigapp.engine.messages import Alarm, Event, Severity

_ALARM = re.compile(
    r"(?P<title>.+?): (?P<what>raised, first out|raised|cleared|acknowledged|reset|"
    r"no longer shelved|shelved for [^:]*:.*?)\. (?P<cause>.*)",
    re.DOTALL,
)
_LIMIT = re.compile(r"limit (\S+?) changed")
_RULE = re.compile(r"\S+ (above|below) limit")

RULE_ACTION = "Look at the trend of this quantity."
NOT_RECORDED = "The log does not tell."
DUMMIES = {"float": 0.0, "int": 1, "str": "", "bool": False}


class RecordedAlarms:
    """Rebuild the alarm list and the limits as they were after a revolution."""

    def __init__(self, events: Sequence[Event], limits: LimitsSection | None) -> None:
        self._events = [e for e in events if e.kind in ("alarm", "limit_changed")]
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
        """Return the least distance to a limit in percent, and which; NaN without limits.

        values: the columns of the revolution's row.
        """
        self._go_to(revolution)
        limits = self._limits
        if limits is None or self._monitor is None:
            return math.nan, ""
        worst, name = self._monitor.worst_margin(values)
        for value, limit, label in (
            (values["force_max"], limits.overload_N, "overload"),
            (abs(values["speed_max"]), limits.overspeed_rpm, "overspeed"),
        ):
            margin = 100.0 * (limit - value) / limit
            if margin < worst:
                worst, name = margin, label
        return (worst, name) if math.isfinite(worst) else (math.nan, "")

    def _go_to(self, revolution: int) -> None:
        count = int(np.searchsorted(self._revolutions, revolution, side="right"))
        if count == self._count:
            return
        self._count = count
        listed: dict[str, Alarm] = {}
        limits = self._first_limits
        for event in self._events[:count]:
            if event.kind == "alarm":
                _apply(listed, event)
            elif limits is not None:
                limits = _changed(limits, event)
        self._alarms = tuple(listed.values())
        self._limits = limits
        self._monitor = _monitor(limits)


def _apply(listed: dict[str, Alarm], event: Event) -> None:
    """Take one line of the log into the list of alarms, by title."""
    match = _ALARM.fullmatch(event.text)
    if match is None:
        return
    title, what = match["title"], match["what"]
    if what.startswith("raised"):
        listed[title] = _raised(title, match["cause"], event, first_out=what != "raised")
        return
    alarm = listed.get(title)
    if alarm is None:
        return
    changes = {"state": event.after or alarm.state}
    if what == "reset":
        del listed[title]
        return
    active = alarm.active and what != "cleared"
    acknowledged = alarm.acknowledged or what == "acknowledged"
    alarm = msgspec.structs.replace(alarm, active=active, acknowledged=acknowledged, **changes)
    listed[title] = alarm
    if acknowledged and not active and alarm.state not in ("latched", "shelved"):
        del listed[title]


def _raised(title: str, cause: str, event: Event, *, first_out: bool) -> Alarm:
    known = known_causes().get(title)
    if known is not None:
        severity, consequence, action = known.severity, known.consequence, known.action
    elif _RULE.fullmatch(title):
        severity = Severity.CRITICAL if " critical limit" in cause else Severity.WARNING
        consequence, action = NOT_RECORDED, RULE_ACTION
    else:
        critical = first_out or title.startswith("Stop criterion")
        severity = Severity.CRITICAL if critical else Severity.WARNING
        consequence, action = NOT_RECORDED, NOT_RECORDED
    return Alarm(
        key=title,
        severity=severity,
        title=title,
        cause=cause,
        consequence=consequence,
        action=action,
        raised_at=event.time,
        revolution=event.revolution,
        first_out=first_out,
        state=event.after or "unacknowledged",
    )


@cache
def known_causes() -> Mapping[str, Cause]:
    """Return the engine's causes by title, their words for details left empty."""
    found = {}
    for name, make in inspect.getmembers(causes, inspect.isfunction):
        parameters = inspect.signature(make).parameters.values()
        if name.startswith("_") or any(str(p.annotation) not in DUMMIES for p in parameters):
            continue
        arguments = {p.name: DUMMIES[str(p.annotation)] for p in parameters}
        # The stop criteria are the one closed list of names that a title is made of.
        names = sorted(TITLES) if make is causes.criterion_blind else ("",)
        for one in names:
            cause = make(**arguments | ({"name": one} if one else {}))
            if isinstance(cause, Cause):
                found[cause.title] = cause
    return found


def _monitor(limits: LimitsSection | None) -> RuleMonitor | None:
    """Return the judge of rules; None when the log's changes do not make usable rules."""
    try:
        return RuleMonitor(limits.rule) if limits is not None else None
    except UnusableInput:
        return None


def _changed(limits: LimitsSection, event: Event) -> LimitsSection:
    match = _LIMIT.match(event.text)
    if match is None:
        return limits
    try:
        return changed_limits(limits, match[1], float(event.after))[1]
    except (UnusableInput, ValueError):
        return limits
