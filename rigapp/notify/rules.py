"""The rules from facts to messages: conditions are reported in pairs, other facts once.

Of every condition its begin and its end are reported once. One that recurs within
``recovered_after_s`` counts as not ended. Pure functions from state to state and
messages.
"""

from __future__ import annotations

import datetime
from collections.abc import Iterator, Mapping
from typing import assert_never

import msgspec

from rigapp.config.notify import NotifySection
from rigapp.notify.facts import DiskSeen, Fact, Farewell, Heartbeat, Silence
from rigapp.notify.message import (
    Level,
    Message,
    alarm_message,
    clock,
    finished_message,
    summary_message,
)
from rigapp.schema.messages import NO_TEST, Alarm, FinishReason, RunState, Severity, Status
from rigapp.schema.notices import AlarmChanged, Finished, StateChanged
from rigapp.schema.states import ACTIVE

FAR_AGAIN = 1.5
"""Factor of a criterion's near distance from which it is no longer near: a value
that fluctuates about a level is reported once."""

LATE_SUMMARY_S = 3600.0
"""Delay up to which a missed summary, as no engine ran, is made up."""

MOST_OPEN = 200
"""Maximum number of open conditions; beyond it the oldest are dropped, so that the state is
bounded."""

KNOWING = frozenset(RunState) - {RunState.IDLE, RunState.CONNECTING}
"""States in which an engine has checked its devices, so that its list of alarms is complete."""


class Raised(msgspec.Struct, frozen=True):
    """A reported condition whose end is not reported yet. over_at: time of the end, None before."""

    title: str
    level: Level
    over_at: float | None = None
    how: str = "Over"


class NotificationState(msgspec.Struct, frozen=True):
    """The state of one channel: open conditions by key, day and revolution of the last summary."""

    open: Mapping[str, Raised] = {}
    summary_on: str = ""
    summary_revolution: int = 0
    status: Status | None = None


Step = tuple[NotificationState, tuple[Message, ...]]


def update(way: NotifySection, state: NotificationState, fact: Fact) -> Step:
    """Return the state after a fact, and the messages that follow from it."""
    due: list[Message] = []
    for change in _changes(way, state, fact):
        if isinstance(change, Message):
            due.append(change)
        elif isinstance(change, _Begun):
            state, messages = _open_condition(state, change, fact.at)
            due += messages
        else:
            state = _end_condition(state, change, fact.at)
    if isinstance(fact.seen, Heartbeat):
        state = msgspec.structs.replace(state, status=fact.seen.status)
    return state, tuple(due)


def pass_time(
    way: NotifySection, state: NotificationState, now: float, local: datetime.datetime
) -> Step:
    """Return the state and the messages due; local: now, by the wall clock."""
    due = []
    for key, alarm in list(state.open.items()):
        if alarm.over_at is not None and not 0.0 <= now - alarm.over_at < way.recovered_after_s:
            text = f"{alarm.how} ({clock(alarm.over_at)})."
            due.append(Message(key, "recovered", alarm.level, alarm.title, text, now))
            state = _without(state, key)
    if "daily" in way.when and _summary_due(way, state, local):
        status = state.status
        if status is not None:
            revolution = (status.test or NO_TEST).revolution
            title, text = summary_message(status, revolution - state.summary_revolution)
            due.append(Message("daily", "told", "information", title, text, now))
            state = msgspec.structs.replace(
                state, summary_on=local.date().isoformat(), summary_revolution=revolution
            )
    return state, tuple(due)


class _Begun(msgspec.Struct, frozen=True):
    key: str
    level: Level
    title: str
    text: str


class _Ended(msgspec.Struct, frozen=True):
    key: str
    how: str = "Over"
    untold: bool = False


_Change = _Begun | _Ended | Message


def _changes(way: NotifySection, state: NotificationState, fact: Fact) -> Iterator[_Change]:
    seen = fact.seen
    match seen:
        case AlarmChanged():
            yield from _of_alarm(way, seen.alarm)
        case StateChanged():
            yield from _of_state(way, seen)
        case Finished():
            yield _Ended("criterion", untold=True)
            if "end" in way.when:
                title, text = finished_message(seen)
                intended = seen.status == "complete" or seen.reason is FinishReason.OPERATOR
                level: Level = "information" if intended else "critical"
                yield Message("end", "told", level, title, text, fact.at)
        case Heartbeat():
            yield from _of_status(way, state, seen.status)
        case DiskSeen():
            yield from _of_disk(way, seen)
        case Silence():
            yield from _of_silence(way, state, seen)
        case Farewell():
            pass
        case _:
            assert_never(seen)


def _of_alarm(way: NotifySection, alarm: Alarm) -> Iterator[_Change]:
    """Yield the changes by an alarm: a shelved one is hidden, but its end is still reported."""
    key = f"alarm:{alarm.key}"
    if not alarm.active:
        waits = (
            "; the alarm stays on the list until it is reset" if alarm.state == "latched" else ""
        )
        yield _Ended(key, f"Its condition is over{waits}")
    elif alarm.severity.value in way.when and alarm.state != "shelved":
        title, text = alarm_message(alarm)
        level: Level = "critical" if alarm.severity is Severity.CRITICAL else "warning"
        yield _Begun(key, level, title, text)


def _of_state(way: NotifySection, seen: StateChanged) -> Iterator[_Change]:
    if seen.state is RunState.PAUSED and not seen.resting and "pause" in way.when:
        reason = seen.reason.strip()
        why = f"Why: {reason}." if reason else "No reason was given."
        yield _Begun("pause", "warning", "Test paused", f"The spindle is at rest. {why}")
    elif seen.state is RunState.RUNNING:
        yield _Ended("pause", "The test runs again")
    elif seen.state not in ACTIVE:
        yield _Ended("pause", untold=True)


def _of_status(way: NotifySection, state: NotificationState, status: Status) -> Iterator[_Change]:
    yield _Ended("silence", "The engine is heard again")
    if status.engine.state in KNOWING:
        # Alarms that rose or cleared without a notice show in the list of the status.
        active = [alarm for alarm in status.alarms if alarm.active]
        listed = {f"alarm:{alarm.key}" for alarm in active}
        for alarm in active:
            yield from _of_alarm(way, alarm)
        for key in state.open:
            if key.startswith("alarm:") and key not in listed:
                yield _Ended(key, "The engine sees it no more")
    yield from _of_criterion(way, status)


def _of_criterion(way: NotifySection, status: Status) -> Iterator[_Change]:
    test = status.test or NO_TEST
    left = test.criterion_percent
    if status.engine.state not in ACTIVE or left is None:
        return
    if "criterion" in way.when and left <= way.near_percent:
        text = f"{left:.3g} % are left to: {test.criterion}. Revolution {test.revolution:,}."
        if test.expected_end_at > 0.0:
            text += f" Expected end: {clock(test.expected_end_at)}."
        yield _Begun("criterion", "information", "The end of the test is near", text)
    elif left > FAR_AGAIN * way.near_percent:
        yield _Ended("criterion", "The end is further away again")


def _of_disk(way: NotifySection, seen: DiskSeen) -> Iterator[_Change]:
    free_GB = seen.free_bytes / 1e9
    if "disk" in way.when and free_GB < way.disk_free_GB:
        text = f"{free_GB:.3g} GB are free in {seen.folder}; told below {way.disk_free_GB:g} GB."
        yield _Begun("disk", "warning", "Disk nearly full", text)
    elif free_GB > FAR_AGAIN * way.disk_free_GB:
        yield _Ended("disk", f"{free_GB:.3g} GB are free")


def _of_silence(way: NotifySection, state: NotificationState, seen: Silence) -> Iterator[_Change]:
    if "silence" not in way.when or not (seen.gone or seen.silent_s >= way.silent_after_s):
        return
    last, what = state.status, "The engine's process has ended without a word."
    if not seen.gone:
        what = f"The engine has given no sign of life for {seen.silent_s:.0f} s."
    if last is not None and last.test:
        test = last.test
        what += (
            f" It was {last.engine.state.value}, {test.title} at revolution {test.revolution:,}."
        )
    yield _Begun(
        "silence",
        "critical",
        "No sign of life",
        f"{what}\nThe drive's own watchdog stops the spindle when its engine is dead."
        "\nWhat to do: look at the rig before anything else.",
    )


def _open_condition(state: NotificationState, change: _Begun, at: float) -> Step:
    """Open a condition and report it; an open one stays open."""
    known = state.open.get(change.key)
    if known is not None:
        if known.over_at is None:
            return state, ()
        return _with(state, change.key, Raised(known.title, known.level)), ()
    while len(state.open) >= MOST_OPEN:
        state = _without(state, next(iter(state.open)))
    state = _with(state, change.key, Raised(change.title, change.level))
    return state, (Message(change.key, "raised", change.level, change.title, change.text, at),)


def _end_condition(state: NotificationState, change: _Ended, at: float) -> NotificationState:
    """Mark an open condition as over."""
    known = state.open.get(change.key)
    if known is None:
        return state
    if change.untold:
        return _without(state, change.key)
    if known.over_at is not None:
        return state
    over = msgspec.structs.replace(known, over_at=at, how=change.how)
    return _with(state, change.key, over)


def _with(state: NotificationState, key: str, condition: Raised) -> NotificationState:
    return msgspec.structs.replace(state, open={**state.open, key: condition})


def _without(state: NotificationState, key: str) -> NotificationState:
    left = {name: alarm for name, alarm in state.open.items() if name != key}
    return msgspec.structs.replace(state, open=left)


def _summary_due(way: NotifySection, state: NotificationState, local: datetime.datetime) -> bool:
    if state.summary_on >= local.date().isoformat():
        return False
    hour, minute = (int(part) for part in way.daily_at.split(":"))
    due = local.replace(hour=hour, minute=minute, second=0, microsecond=0)
    return 0.0 <= (local - due).total_seconds() < LATE_SUMMARY_S
