"""Make the log of a test readable: alarms from raised to cleared, limits, changes, the course."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from rigapp.config.recipe import LimitsSection
from rigapp.schema.loglines import (
    ALARM,
    LIMIT_CHANGED,
    AlarmChange,
    alarm_change,
    newest_limits,
)
from rigapp.schema.messages import Event

CHANGES = ("note", LIMIT_CHANGED, "zero", "extended")
LEFT_OUT = (ALARM, *CHANGES)


@dataclass(frozen=True, slots=True)
class AlarmRecord:
    """One alarm from its beginning on. Times are UTC seconds, None when it did not happen."""

    title: str
    cause: str
    raised_at: float
    revolution: int
    cleared_at: float | None = None
    acknowledged: str = ""
    first_out: bool = False


@dataclass(frozen=True, slots=True)
class Limit:
    """One limit of the test. now: after the last change. quantity: a column, or empty."""

    name: str
    quantity: str
    above: bool
    unit: str
    start: float
    now: float
    action: str


def alarms_of(events: Sequence[Event], reason: str) -> list[AlarmRecord]:
    """Return the alarms in the order in which they were raised.

    The log says which one was first out; in older files, which do not, it is the one that gives the
    reason with which the test ended.
    """
    found: list[AlarmRecord] = []
    place: dict[str, int] = {}
    for event in events:
        change = alarm_change(event)
        if change is None:
            continue
        if change.what == "raised":
            place[event.key] = len(found)
            found.append(
                AlarmRecord(
                    change.title, change.cause, event.time, event.revolution,
                    first_out=change.first_out,
                )
            )  # fmt: skip
        elif event.key in place:
            found[place[event.key]] = _continued(found[place[event.key]], event, change)
    first = next((i for i, one in enumerate(found) if one.cause and one.cause in reason), None)
    if first is not None and not any(one.first_out for one in found):
        found[first] = replace(found[first], first_out=True)
    return found


def _continued(record: AlarmRecord, event: Event, change: AlarmChange) -> AlarmRecord:
    if change.what == "cleared":
        return replace(record, cleared_at=event.time)
    if change.what == "acknowledged":
        return replace(record, acknowledged=event.source)
    if change.what == "shelved":
        words = f"{change.words}, by {event.source}"
        return replace(record, acknowledged=f"{record.acknowledged}; {words}".lstrip("; "))
    return record


def changes_of(events: Iterable[Event]) -> list[Event]:
    """Return the operator's notes and everything that was changed, with before and after."""
    return [one for one in events if one.kind in CHANGES]


def course_of(events: Iterable[Event]) -> list[Event]:
    """Return what else happened: states, commands, gaps, stops."""
    return [one for one in events if one.kind not in LEFT_OUT]


def limits_of(test_text: str, events: Iterable[Event]) -> list[Limit]:
    """Return the limits of the test file (TOML), and what they were changed to."""
    try:
        document = tomllib.loads(test_text)
    except tomllib.TOMLDecodeError:
        return []
    section = document.get("limits", {})
    if "run" not in document or not isinstance(section, Mapping):
        return []
    defaults = LimitsSection()
    changed = newest_limits(events)
    fixed = (
        ("overload_N", "force_max", "N", "drive off"),
        ("overspeed_rpm", "speed_max", "rpm", "drive off"),
        ("stale_data_s", "", "s", "drive off"),
    )
    found = [
        Limit(name, quantity, True, unit, value, changed.get(name, value), action)
        for name, quantity, unit, action in fixed
        for value in _number(section.get(name, getattr(defaults, name)))
    ]
    rules = section.get("rule", ())
    for rule in rules if isinstance(rules, list) else ():
        found += _rule_limits(rule, changed)
    return found


def _rule_limits(rule: Any, changed: Mapping[str, float]) -> list[Limit]:
    if not isinstance(rule, Mapping):
        return []
    quantity = str(rule.get("quantity", ""))
    actions = {
        "warning": str(rule.get("action_warning", "warn")),
        "critical": str(rule.get("action_critical", "stop")),
    }
    found = []
    for level in ("warning_above", "critical_above", "warning_below", "critical_below"):
        name = f"{quantity}.{level}"
        given = _number(rule.get(level))
        if not given and name not in changed:
            continue
        start = given[0] if given else float("nan")
        severity, _, side = level.partition("_")
        action = actions[severity].replace("_", " ")
        found.append(
            Limit(name, quantity, side == "above", "", start, changed.get(name, start), action)
        )
    return found


def _number(value: Any) -> list[float]:
    try:
        return [float(value)] if value is not None else []
    except (TypeError, ValueError):
        return []
