"""The display of a value, in window and page alike: by its alarms and its age."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Final, Protocol, TypeVar

from rigapp.presentation.times import duration
from rigapp.presentation.translation import Text, tr
from rigapp.schema.alarms import quantity_of
from rigapp.schema.channels import STATISTICS, Kind
from rigapp.schema.messages import NO_TEST, Alarm, Severity
from rigapp.schema.states import ACTIVE
from rigapp.viewer.channels import FreeValue, title_of, value_text
from rigapp.viewer.news import News

OLD_AFTER_S: Final = 2.0
"""Devices send ten times a second or more; a person may reach into the rig because of a value."""


class Level(enum.IntEnum):
    """The distance of a value from normal; only abnormal values are coloured."""

    NORMAL = 0
    WARNING = 1
    CRITICAL = 2


MARKS: Final = {Level.NORMAL: "", Level.WARNING: "▲ ", Level.CRITICAL: "◆ "}
"""The shape at a value, so that nothing depends on colour alone."""

_LEVELS: Final = {Severity.WARNING: Level.WARNING, Severity.CRITICAL: Level.CRITICAL}


class Renewed(enum.Enum):
    """The source that renews a value: each message of the engine, sample, and so on."""

    STATUS = enum.auto()
    SAMPLE = enum.auto()
    REVOLUTION = enum.auto()
    PREDICTION = enum.auto()


@dataclass(frozen=True, slots=True)
class Age:
    """The age of a value; seconds: None where it is not known. due_s: time until it is renewed."""

    seconds: float | None = None
    due_s: float = 0.0

    @property
    def old(self) -> bool:
        """Return whether a value of this age is shown as old."""
        return self.seconds is not None and self.seconds > OLD_AFTER_S + self.due_s

    @property
    def text(self) -> str:
        """Return the age in words, nothing where it is not known."""
        return "" if self.seconds is None else tr("{} old", duration(self.seconds))

    def and_before(self, seconds: float | None) -> Age:
        """Return the age of a value that was old already when it was received."""
        if seconds is None or not math.isfinite(seconds):
            return self
        return replace(self, seconds=(self.seconds or 0.0) + max(seconds, 0.0))


UNKNOWN_AGE: Final = Age()


class Shown(Protocol):
    """A value with one line below it."""

    @property
    def value(self) -> Text:
        """Return the value, a dash where there is none."""
        ...

    @property
    def detail(self) -> Text:
        """Return the line."""
        ...

    @property
    def old(self) -> bool:
        """Return whether it is shown as old."""
        ...


AnyShown = TypeVar("AnyShown", bound=Shown)


def age_of(news: News, renewed: Renewed) -> Age:
    """Return the age of a value, growing while the engine is silent; a recorded one has none."""
    status = news.status
    if status is None or news.is_replay:
        return UNKNOWN_AGE
    if renewed is Renewed.STATUS:
        return Age(news.silence_s)
    if renewed is Renewed.SAMPLE:
        return Age(news.data_age_s)
    test = status.test or NO_TEST
    seconds = test.revolution_age_s if renewed is Renewed.REVOLUTION else test.twin_age_s
    if seconds is None:
        # Of an older engine: a revolution is no newer than the samples.
        return Age(news.data_age_s)
    # A silent engine renews nothing.
    due_s = _revolution_s(news) if news.silence_s <= OLD_AFTER_S else 0.0
    return Age(seconds + news.silence_s, due_s)


def _revolution_s(news: News) -> float:
    """Return the time of a revolution by the wall clock, 0 where none is under way."""
    status = news.status
    test = status.test if status is not None else None
    if status is None or status.engine.state not in ACTIVE or not test or test.target_rpm <= 0.0:
        return 0.0
    return 60.0 / test.target_rpm / (status.rig.simulated_speed or 1.0)


def aged(value: AnyShown, age: Age) -> AnyShown:
    """Return a value for display at an age: an old one shows its age."""
    if not age.old or value.value == "–":
        return value
    detail = f"{age.text}, {tr(value.detail)}" if value.detail else age.text
    return replace(value, detail=detail, short=age.text, old=True)  # type: ignore[type-var]


def standing(alarms: Iterable[Alarm]) -> list[Alarm]:
    """Return the alarms that colour their quantity: they hold, or wait for the reset."""
    return [
        alarm for alarm in alarms if alarm.state in ("unacknowledged", "acknowledged", "latched")
    ]


def level_of(alarms: Iterable[Alarm], *quantities: str) -> Level:
    """Return the worst level of the present alarms about any of some quantities.

    quantities: columns or channels. An alarm about a channel is about all of its statistics.
    """
    about = ((alarm, quantity_of(alarm.key)) for alarm in standing(alarms))
    return max(
        (
            _LEVELS[alarm.severity]
            for alarm, subject in about
            if subject
            and any(
                quantity == subject or quantity.startswith(f"{subject}_") for quantity in quantities
            )
        ),
        default=Level.NORMAL,
    )


def free_values(news: News) -> list[FreeValue]:
    """Return the newest values of free channels: live where there is a view, else of a column."""
    status, rows = news.status, news.data.rows
    live = {view.name: view for view in status.rig.channels} if status is not None else {}
    alarms = status.alarms if status is not None else ()
    result = []
    for channel in news.data.channels.free:
        slow, view = channel.kind is Kind.SLOW, live.get(channel.name)
        if view is not None:
            value = view.value
            age = age_of(news, Renewed.STATUS if slow else Renewed.SAMPLE).and_before(view.age_s)
        else:
            value = rows.last(channel.name if slow else f"{channel.name}_mean")
            age = age_of(news, Renewed.REVOLUTION)
            age = age.and_before(rows.last(f"{channel.name}_age") if slow else None)
        text, level = value_text(value, channel.unit), quantity_level(alarms, channel.name)
        shown = FreeValue(channel.name, title_of(channel), text, "", level)
        # A slow one always shows its age: its device sets the pace.
        if slow:
            result.append(replace(shown, detail=age.text, short=age.text, old=age.old))
        else:
            result.append(aged(shown, age))
    return result


def quantity_level(alarms: Iterable[Alarm], channel: str) -> Level:
    """Return the worst level of the alarms about a channel or any of its statistics."""
    return level_of(alarms, channel, *(f"{channel}_{statistic}" for statistic in STATISTICS))


def level_of_limit(alarms: Iterable[Alarm], key: str) -> Level:
    """Return the level of the alarm of one limit, by its key or its part before a colon."""
    return max(
        (_LEVELS[a.severity] for a in standing(alarms) if f"{a.key}:".startswith(f"{key}:")),
        default=Level.NORMAL,
    )
