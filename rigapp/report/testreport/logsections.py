"""Sections of the log of a test: gaps, limits, alarms, changes and the course."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from rigapp.config.recipe import LimitsSection
from rigapp.config.rules import ALWAYS
from rigapp.presentation.numbers import grouped
from rigapp.presentation.times import duration
from rigapp.presentation.translation import Text as Words
from rigapp.presentation.translation import tr, translate
from rigapp.report.page.document import Block, Section, Table, Text
from rigapp.report.testreport.facts import Rows, span_of
from rigapp.report.testreport.formatting import UNKNOWN, counted, number, symbol, utc
from rigapp.schema.loglines import (
    ALARM,
    LIMIT_CHANGED,
    AlarmChange,
    alarm_change,
    newest_limits,
)
from rigapp.schema.messages import Event
from rigapp.storage import TestReader

CHANGES = ("note", LIMIT_CHANGED, "zero", "extended")
LEFT_OUT = (ALARM, *CHANGES)


@dataclass(frozen=True, slots=True)
class AlarmRecord:
    """One alarm with its changes. Times: UTC seconds, None for changes that did not occur."""

    title: str
    cause: str
    raised_at: float
    revolution: int
    cleared_at: float | None = None
    acknowledged: str = ""
    first_out: bool = False


@dataclass(frozen=True, slots=True)
class Limit:
    """One limit of the test. now: value after the last change. quantity: a column, or empty."""

    name: str
    quantity: str
    above: bool
    unit: str
    start: float
    now: float
    action: str


def alarms_of(events: Sequence[Event], reason: str) -> list[AlarmRecord]:
    """Return the alarms in the order in which they were raised.

    The first-out alarm is marked in the log; in older files without the mark it is the alarm named
    in the reason of the test's end.
    """
    result: list[AlarmRecord] = []
    index: dict[str, int] = {}
    for event in events:
        change = alarm_change(event)
        if change is None:
            continue
        if change.what == "raised":
            index[event.key] = len(result)
            result.append(
                AlarmRecord(
                    change.title, change.cause, event.time, event.revolution,
                    first_out=change.first_out,
                )
            )  # fmt: skip
        elif event.key in index:
            result[index[event.key]] = _continued(result[index[event.key]], event, change)
    first = next((i for i, a in enumerate(result) if a.cause and a.cause in reason), None)
    if first is not None and not any(alarm.first_out for alarm in result):
        result[first] = replace(result[first], first_out=True)
    return result


def _continued(record: AlarmRecord, event: Event, change: AlarmChange) -> AlarmRecord:
    if change.what == "cleared":
        return replace(record, cleared_at=event.time)
    if change.what == "acknowledged":
        return replace(record, acknowledged=event.source)
    if change.what == "shelved":
        words = f"{change.words}, by {event.source}"
        return replace(record, acknowledged=f"{record.acknowledged}; {words}".lstrip("; "))
    return record


def limits_of(test_text: str, events: Iterable[Event]) -> list[Limit]:
    """Return the limits of the test file (TOML), with their changes."""
    try:
        document = tomllib.loads(test_text)
    except tomllib.TOMLDecodeError:
        return []
    section = document.get("limits", {})
    if "run" not in document or not isinstance(section, Mapping):
        return []
    defaults = LimitsSection()
    changed = newest_limits(events)
    result = [
        Limit(
            name,
            next(iter(limit.columns), ""),
            True,
            limit.unit,
            value,
            changed.get(name, value),
            "drive off",
        )
        for name, limit in ALWAYS.items()
        for value in _number(section.get(name, getattr(defaults, name)))
    ]
    rules = section.get("rule", ())
    for rule in rules if isinstance(rules, list) else ():
        result += _rule_limits(rule, changed)
    return result


def _rule_limits(rule: Any, changed: Mapping[str, float]) -> list[Limit]:
    if not isinstance(rule, Mapping):
        return []
    quantity = str(rule.get("quantity", ""))
    actions = {
        "warning": str(rule.get("action_warning", "warn")),
        "critical": str(rule.get("action_critical", "stop")),
    }
    result = []
    for level in ("warning_above", "critical_above", "warning_below", "critical_below"):
        name = f"{quantity}.{level}"
        recorded = _number(rule.get(level))
        if not recorded and name not in changed:
            continue
        start = recorded[0] if recorded else float("nan")
        severity, _, side = level.partition("_")
        action = actions[severity].replace("_", " ")
        result.append(
            Limit(name, quantity, side == "above", "", start, changed.get(name, start), action)
        )
    return result


def _number(value: Any) -> list[float]:
    try:
        return [float(value)] if value is not None else []
    except (TypeError, ValueError):
        return []


SHOWN = 60
"""Maximum number of rows of a table; the rest is counted, and is in the file."""

KINDS: dict[str, Words] = {
    "note": "note",
    "limit_changed": "limit changed",
    "zero": "zero taken",
    "extended": "test extended",
}


def sections(
    reader: TestReader, events: Sequence[Event], rows: Rows | None, reason: str
) -> list[Section]:
    """Return the sections about gaps, limits, alarms, changes and the course of the test."""
    limits = limits_of(str(reader.configuration().get("test", "")), events)
    refused = reader.state("events_refused")
    course = [_course(events)]
    if refused:
        text = tr("The log was full: {} were not recorded.", counted(refused, "event"))
        course.insert(0, Text(text, strong=True))
    return [
        Section(tr("Gaps"), _gaps(events, rows)),
        Section(tr("Limits and alarms"), (*_limits(reader, limits), *_alarms(events, reason))),
        Section(tr("Notes and changes"), _changes(events)),
        Section(tr("Course of the test"), tuple(course)),
    ]


def _gaps(events: Sequence[Event], rows: Rows | None) -> tuple[Block, ...]:
    gaps = [event for event in events if event.kind == "gap"]
    recorded = rows.gaps if rows is not None else ()
    if not gaps and not recorded:
        return (Text(tr("None: every revolution follows the one before.")),)
    blocks: list[Block] = []
    if recorded:
        known = [gap.seconds for gap in recorded if math.isfinite(gap.seconds)]
        missing = sum(gap.missing for gap in recorded)
        text = tr(
            "{}, {} not recorded", counted(len(recorded), "gap"), counted(missing, "revolution")
        )
        blocks.append(
            Text(tr("{}, {} without data in all.", text, duration(sum(known), exact=True)))
        )
        table = tuple(
            (grouped(gap.revolution), grouped(gap.missing), grouped(gap.lost_samples),
             duration(gap.seconds, exact=True))
            for gap in recorded
        )  # fmt: skip
        header = (
            tr("before revolution"),
            tr("revolutions not recorded"),
            tr("samples lost"),
            tr("without data"),
        )
        blocks += _cut(tr("Where data are missing"), table, header)
    if gaps:
        gap_rows = tuple(
            (utc(event.time), grouped(event.revolution), translate(event.text)) for event in gaps
        )
        blocks += _cut(
            tr("What the log says"), gap_rows, (tr("time, UTC"), tr("after revolution"), tr("gap"))
        )
    return tuple(blocks)


def _limits(reader: TestReader, limits: Sequence[Limit]) -> list[Block]:
    if not limits:
        return [Text(tr("The file does not state the limits of the test."))]
    table = tuple(_limit_row(reader, limit) for limit in limits)
    header = (
        tr("limit"),
        tr("at the start"),
        tr("at the end"),
        tr("reached"),
        tr("unit"),
        tr("action"),
    )
    return [Table(tr("Limits"), table, header)]


def _limit_row(reader: TestReader, limit: Limit) -> tuple[str, ...]:
    span = span_of(reader, limit.quantity) if limit.quantity else None
    unit = limit.unit or (span[2] if span is not None else "")
    reached = "–"
    if span is not None:
        reached = number(span[1] if limit.above else span[0], unit)
    start, now = (f"{value:g}" if math.isfinite(value) else tr("none")
                  for value in (limit.start, limit.now))  # fmt: skip
    name = limit.name.replace("_", " ").replace(".", ", ").removesuffix(f" {unit}")
    return tr(name), start, now, reached, symbol(unit), tr(limit.action)


def _alarms(events: Sequence[Event], reason: str) -> list[Block]:
    result = alarms_of(events, reason)
    silent = [event for event in events if event.kind == "limit"]
    blocks: list[Block] = []
    if silent:
        blocks.append(
            Text(tr("Limits that act by a line in the log only: {}.", counted(len(silent), "line")))
        )
    if not result:
        return [*blocks, Text(tr("No alarm was raised."))]
    first = next((alarm for alarm in result if alarm.first_out), None)
    if first is not None:
        text = tr(
            "First out, the alarm that ended the test: {}. {}",
            translate(first.title),
            translate(first.cause),
        )
        blocks.append(Text(text, strong=True))
    header = (
        tr("raised, UTC"),
        tr("revolution"),
        tr("alarm"),
        tr("cause"),
        tr("cleared, UTC"),
        tr("acknowledged"),
    )
    table = tuple(_alarm_row(alarm) for alarm in result)
    return [*blocks, *_cut(tr("Alarms: {} raised", grouped(len(result))), table, header)]


def _alarm_row(alarm: AlarmRecord) -> tuple[str, ...]:
    title = (
        tr("{} (first out)", translate(alarm.title)) if alarm.first_out else translate(alarm.title)
    )
    cleared = utc(alarm.cleared_at) if alarm.cleared_at is not None else tr("not in the log")
    return (
        utc(alarm.raised_at),
        grouped(alarm.revolution),
        title,
        translate(alarm.cause),
        cleared,
        tr("by {}", alarm.acknowledged) if alarm.acknowledged else tr("no"),
    )


def _changes(events: Sequence[Event]) -> tuple[Block, ...]:
    changes = [event for event in events if event.kind in CHANGES]
    if not changes:
        return (Text(tr("No notes were written and no settings changed during the test.")),)
    header = (
        tr("time, UTC"),
        tr("revolution"),
        tr("what"),
        tr("by"),
        tr("text"),
        tr("before"),
        tr("after"),
    )
    table = tuple(
        (utc(event.time), grouped(event.revolution), tr(KINDS[event.kind]), event.source,
         translate(event.text),
         event.before or "–", event.after or "–")
        for event in changes
    )  # fmt: skip
    return tuple(_cut("", table, header, shown=5 * SHOWN))


def _course(events: Sequence[Event]) -> Block:
    course = [event for event in events if event.kind not in LEFT_OUT]
    if not course:
        return Text(tr("The log has no entries."))
    table = tuple(
        (utc(event.time), grouped(event.revolution), tr(event.kind.replace("_", " ")),
         tr(event.source), translate(event.text) or tr(UNKNOWN))
        for event in course
    )  # fmt: skip
    kept = table if len(table) <= SHOWN else table[: SHOWN // 2] + table[-SHOWN // 2 :]
    title = (
        ""
        if kept is table
        else tr("First and last {} of {} entries", SHOWN // 2, grouped(len(table)))
    )
    return Table(title, kept, (tr("time, UTC"), tr("revolution"), tr("what"), tr("by"), tr("text")))


def _cut(
    title: str, rows: tuple[tuple[str, ...], ...], header: tuple[str, ...], shown: int = SHOWN
) -> list[Block]:
    """Return a table, shortened if necessary, with a sentence about the omitted rows."""
    blocks: list[Block] = [Table(title, rows[:shown], header)]
    if len(rows) > shown:
        text = tr("{} more are left out here; they are in the file.", grouped(len(rows) - shown))
        blocks.append(Text(text))
    return blocks
