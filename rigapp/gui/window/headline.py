"""What the header says, as plain text: pure functions of the engine's status and of the line."""

from __future__ import annotations

import enum
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PurePath

from rigapp.gui.data.link import LinkState
from rigapp.schema.messages import RunState, Severity, Status

STALE_TWIN_S = 5.0
LOW_MARGIN_PERCENT = 10.0

ACTIVE_STATES = frozenset(
    {
        RunState.STARTING,
        RunState.RUNNING,
        RunState.PAUSING,
        RunState.PAUSED,
        RunState.STOPPING,
    }
)


class Level(enum.IntEnum):
    """Tell how far a value is from normal; only what is not normal is coloured."""

    NORMAL = 0
    WARNING = 1
    CRITICAL = 2


class Shape(enum.StrEnum):
    """Name the shape drawn beside the state word, so that it never rests on colour."""

    CIRCLE = "circle"
    TRIANGLE = "triangle"
    BARS = "bars"
    SQUARE = "square"
    ARROWS = "arrows"
    DIAMOND = "diamond"
    BROKEN = "broken"


@dataclass(frozen=True, slots=True)
class Field:
    """One tile: a large value, one line below, how normal it is."""

    value: str
    detail: str = ""
    level: Level = Level.NORMAL


@dataclass(frozen=True, slots=True)
class Headline:
    """Everything that the header shows."""

    shape: Shape
    state: Field
    cycle: Field
    progress: float
    end: Field
    age: Field
    margin: Field
    agreement: Field
    alarms: Field
    line: str


_STATES: dict[RunState, tuple[str, Shape, Level]] = {
    RunState.IDLE: ("Idle", Shape.CIRCLE, Level.NORMAL),
    RunState.CONNECTING: ("Connecting", Shape.ARROWS, Level.NORMAL),
    RunState.READY: ("Ready", Shape.CIRCLE, Level.NORMAL),
    RunState.STARTING: ("Starting", Shape.ARROWS, Level.NORMAL),
    RunState.RUNNING: ("Running", Shape.TRIANGLE, Level.NORMAL),
    RunState.PAUSING: ("Pausing", Shape.ARROWS, Level.WARNING),
    RunState.PAUSED: ("Paused", Shape.BARS, Level.WARNING),
    RunState.STOPPING: ("Stopping", Shape.ARROWS, Level.NORMAL),
    RunState.STOPPED: ("Stopped", Shape.SQUARE, Level.NORMAL),
    RunState.FAULT: ("Fault", Shape.DIAMOND, Level.CRITICAL),
}


def headline(
    status: Status | None,
    link: LinkState,
    link_reason: str,
    data_age_s: float | None,
    now: Callable[[], float] = time.time,
) -> Headline:
    """Return what the header shows for a status (None: never heard of the engine)."""
    unknown = Field("–")
    if status is None:
        state = Field("Attaching", link_reason)
        return Headline(
            Shape.ARROWS, state, unknown, 0.0, unknown, unknown, unknown, unknown, unknown, ""
        )
    shape, state = _state(status, link, link_reason)
    return Headline(
        shape=shape,
        state=state,
        cycle=_cycle(status),
        progress=status.revolution / status.planned if status.planned > 0 else 0.0,
        end=_end(status, now()),
        age=_age(status, data_age_s),
        margin=_margin(status),
        agreement=_agreement(status),
        alarms=_alarms(status),
        line=_line(status),
    )


def _state(status: Status, link: LinkState, link_reason: str) -> tuple[Shape, Field]:
    if link is LinkState.LOST:
        return Shape.BROKEN, Field("No engine", f"{link_reason}; trying again", Level.CRITICAL)
    if link is LinkState.SILENT:
        word = _STATES[status.state][0]
        return Shape.BROKEN, Field("Silent", f"was {word.lower()}; {link_reason}", Level.WARNING)
    word, shape, level = _STATES[status.state]
    return shape, Field(word, status.reason, level)


def _cycle(status: Status) -> Field:
    if status.planned <= 0:
        return Field("–", "no test")
    saved = f"{grouped(status.committed)} saved"
    return Field(f"{grouped(status.revolution)} of {grouped(status.planned)}", saved)


def _end(status: Status, now: float) -> Field:
    if status.state not in ACTIVE_STATES or status.expected_end_at <= 0.0:
        return Field("–", "no test running" if status.state not in ACTIVE_STATES else "")
    left = max(0.0, status.expected_end_at - now)
    moment = time.localtime(status.expected_end_at)
    today = time.localtime(now)
    days = (moment.tm_year, moment.tm_yday) != (today.tm_year, today.tm_yday)
    day = time.strftime("%a, ", moment) if days else ""
    return Field(time.strftime("%H:%M", moment), f"{day}in {duration(left)}")


def _age(status: Status, data_age_s: float | None) -> Field:
    if data_age_s is None or not math.isfinite(data_age_s):
        return Field("–", "no data yet")
    level = Level.NORMAL
    if status.state in ACTIVE_STATES and data_age_s > 2.0:
        level = Level.CRITICAL if data_age_s > 10.0 else Level.WARNING
    return Field(f"{data_age_s:.1f} s" if data_age_s < 100.0 else duration(data_age_s), "", level)


def _margin(status: Status) -> Field:
    if not status.worst_margin or not math.isfinite(status.worst_margin_percent):
        running = status.state in ACTIVE_STATES
        return Field("–", "nothing judged yet" if running else "no test running")
    percent = status.worst_margin_percent
    level = Level.NORMAL
    if percent <= 0.0:
        level = Level.CRITICAL
    elif percent < LOW_MARGIN_PERCENT:
        level = Level.WARNING
    return Field(f"{percent:.0f} %", status.worst_margin.replace("_", " "), level)


def _agreement(status: Status) -> Field:
    if status.twin_revolution <= 0 or not math.isfinite(status.residual_rms_N):
        return Field("–", "no prediction")
    behind = status.revolution - status.twin_revolution
    value = f"±{status.residual_rms_N:.1f} N"
    if is_stale(status):
        return Field(value, f"stale for {duration(status.twin_age_s)}", Level.WARNING)
    return Field(value, "RMS, this cycle" if behind <= 1 else f"RMS, {grouped(behind)} cycles ago")


def is_stale(status: Status) -> bool:
    """Tell whether the prediction has fallen behind a running test."""
    return status.state is RunState.RUNNING and STALE_TWIN_S < status.twin_age_s < math.inf


def _alarms(status: Status) -> Field:
    shown = [alarm for alarm in status.alarms if alarm.state not in ("normal", "shelved")]
    if not shown:
        return Field("None")
    new = sum(1 for alarm in shown if not alarm.acknowledged)
    critical = any(alarm.severity is Severity.CRITICAL for alarm in shown)
    first = next((alarm for alarm in shown if alarm.first_out), shown[0])
    count = f"{len(shown)}" if not new else f"{len(shown)}, {new} new"
    return Field(count, first.title, Level.CRITICAL if critical else Level.WARNING)


def _line(status: Status) -> str:
    parts = []
    if status.test:
        parts.append(f"Test: {status.test}")
    parts.append(f"Rig: {status.rig}")
    if status.simulated:
        speed = status.simulated_speed
        parts.append(
            f"SIMULATED × {speed:.3g}" if math.isfinite(speed) and speed > 0 else "SIMULATED"
        )
    if status.state in ACTIVE_STATES:
        parts.append(f"{status.speed_rpm:.1f} of {status.target_rpm:.1f} rpm")
    if status.operator:
        parts.append(f"Operator: {status.operator}")
    if status.file:
        parts.append(f"File: {PurePath(status.file).name}")
    return "     ".join(parts)


def grouped(number: int) -> str:
    """Return a whole number with thin spaces between groups of three digits."""
    return f"{number:,}".replace(",", "\u2009")


def duration(seconds: float) -> str:
    """Return a length of time in the two largest units that matter."""
    if not math.isfinite(seconds):
        return "–"
    minutes, rest = divmod(int(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    days, hours = divmod(hours, 24)
    if days:
        return f"{days} d {hours} h"
    if hours:
        return f"{hours} h {minutes} min"
    if minutes:
        return f"{minutes} min" if minutes >= 10 else f"{minutes} min {rest} s"
    return f"{rest} s"
