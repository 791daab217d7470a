"""Moments of a test that are marked in its trends: notes, steps, and raised alarms."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rigapp.schema.loglines import alarm_change, severity_of
from rigapp.schema.messages import Event, Severity

MOST = 200
"""Maximum number of moments: more lines cannot be distinguished."""


@dataclass(frozen=True, slots=True)
class MarkedMoment:
    """An event at a revolution; severity: of an alarm, None of a note."""

    revolution: int
    words: str
    severity: Severity | None = None


def moments(events: Iterable[Event]) -> tuple[MarkedMoment, ...]:
    """Return the newest moments of a log, in its order; a recurring alarm counts once."""
    result: dict[tuple[int, str], MarkedMoment] = {}
    for event in events:
        change = alarm_change(event)
        if change is not None and change.what == "raised":
            moment = MarkedMoment(event.revolution, change.title, severity_of(event))
        elif event.kind == "note":
            moment = MarkedMoment(event.revolution, event.text)
        elif event.kind == "step" and event.after:
            moment = MarkedMoment(event.revolution, event.after)
        else:
            continue
        result.setdefault((moment.revolution, moment.words), moment)
    return tuple(result.values())[-MOST:]
