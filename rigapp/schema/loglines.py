"""Machine-readable lines of the log: alarms, limits and signals at rest, as typed records.

Each is an ``Event`` with subject ``key``, severity ``level``, and ``data`` for the
rest; its sentence is for people and is never parsed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final, Literal, TypeVar

import msgspec

from rigapp.schema.alarms import recorded_text
from rigapp.schema.messages import Alarm, Ends, Event, Severity
from rigapp.schema.wire import tree_of
from rigapp.texts import Sentence, say

ALARM = "alarm"
LIMIT_CHANGED = "limit_changed"
SPECIMEN = "specimen"
REST = "rest"
"""Kind of the event that holds the signals at rest before a start."""

WORDS: Final[dict[str, Sentence]] = {
    "cleared": say("cleared"),
    "acknowledged": say("acknowledged"),
    "reset": say("reset"),
    "unshelved": say("no longer shelved"),
}
What = Literal["raised", "cleared", "acknowledged", "shelved", "unshelved", "reset"]


@dataclass(frozen=True, slots=True)
class LogEntry:
    """An entry for the log: kind, text, person, values before and after."""

    kind: str
    text: str
    who: str
    before: str = ""
    after: str = ""


class AlarmChange(msgspec.Struct, frozen=True, omit_defaults=True):
    """Change of an alarm and its state afterwards.

    listed: whether it is still on the list of alarms. first_out: it became the first-out one.
    cause, consequence, action, ends and value belong to a raised alarm, reason and seconds to a
    shelved one.
    """

    what: What
    title: str
    listed: bool = True
    active: bool = True
    acknowledged: bool = False
    first_out: bool = False
    cause: str = ""
    consequence: str = ""
    action: str = ""
    ends: Ends = Ends.SEEN
    value: float | None = None
    reason: str = ""
    seconds: float = 0.0

    @property
    def words(self) -> str:
        """Return the change in words."""
        if self.what == "raised":
            return say("raised, first out") if self.first_out else say("raised")
        if self.what == "shelved":
            return say("shelved for {:g} s: {}", self.seconds, self.reason)
        return WORDS[self.what]


class LimitChange(msgspec.Struct, frozen=True):
    """Old and new value of a limit; before: None without an old one."""

    before: float | None
    after: float


class SpecimenWear(msgspec.Struct, frozen=True):
    """Wear of a specimen when a test of it was begun or resumed.

    file, revolution: of its last measurement. depth_um with its expanded uncertainty (k = 2).
    """

    file: str
    revolution: int
    depth_um: float
    uncertainty_um: float


class RestSignals(msgspec.Struct, frozen=True):
    """Signals of the load cell at rest, mV/V.

    noise: standard deviation of one sample. crank_angle_deg: position of the crank, which gives
    the load by spring and weight. None where unknown.
    """

    force_1_mV_per_V: float
    force_2_mV_per_V: float
    noise_1_mV_per_V: float | None = None
    noise_2_mV_per_V: float | None = None
    crank_angle_deg: float | None = None

    @property
    def pair(self) -> tuple[float, float]:
        """Return both signals."""
        return self.force_1_mV_per_V, self.force_2_mV_per_V

    @property
    def noise(self) -> tuple[float, float] | None:
        """Return the noise of both, None if unknown."""
        if self.noise_1_mV_per_V is None or self.noise_2_mV_per_V is None:
            return None
        return self.noise_1_mV_per_V, self.noise_2_mV_per_V


Record = TypeVar("Record", AlarmChange, LimitChange, RestSignals, SpecimenWear)


def alarm_line(time: float, revolution: int, who: str, alarm: Alarm, change: AlarmChange) -> Event:
    """Return the line about an alarm; ``alarm``: its state after the change."""
    text = say("{}: {}. {}", alarm.title, change.words, alarm.cause)
    return Event(
        time, revolution, ALARM, who, text, after=alarm.state,
        key=alarm.key, level=alarm.severity.value, data=tree_of(change),
    )  # fmt: skip


def alarm_change(event: Event) -> AlarmChange | None:
    """Return the alarm change of a line, None for other lines."""
    result = _record(event, ALARM, AlarmChange)
    if result is None:
        return None
    title, consequence, action = (
        recorded_text(text, event.key) for text in (result.title, result.consequence, result.action)
    )
    return msgspec.structs.replace(result, title=title, consequence=consequence, action=action)


def severity_of(event: Event) -> Severity:
    """Return the severity of the alarm of a line."""
    return Severity.CRITICAL if event.level == Severity.CRITICAL else Severity.WARNING


def limit_change(event: Event) -> LimitChange | None:
    """Return the limit change of a line, None for other lines."""
    result = _record(event, LIMIT_CHANGED, LimitChange)
    return result if result is not None and math.isfinite(result.after) else None


def newest_limits(events: Iterable[Event]) -> dict[str, float]:
    """Return the newest value of every changed limit, by its name."""
    changes = ((event.key, limit_change(event)) for event in events)
    return {name: change.after for name, change in changes if change is not None}


def rest_signals(event: Event) -> RestSignals | None:
    """Return the signals at rest of a line, None for other lines."""
    return _record(event, REST, RestSignals)


def specimen_wear(event: Event) -> SpecimenWear | None:
    """Return the wear of the specimen of a line, None for other lines."""
    return _record(event, SPECIMEN, SpecimenWear)


def _record(event: Event, kind: str, record: type[Record]) -> Record | None:
    if event.kind != kind or not event.data:
        return None
    try:
        return msgspec.convert(event.data, record)
    except msgspec.ValidationError:
        return None
