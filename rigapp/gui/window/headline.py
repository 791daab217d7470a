"""What the header says, as plain text: pure functions of the engine's status and of the line."""

from __future__ import annotations

import enum
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PurePath

from rigapp.gui.data.connection import ConnectionState
from rigapp.gui.data.news import is_stale
from rigapp.gui.data.texts import duration, grouped
from rigapp.schema.messages import RunState, Severity, Status
from rigapp.schema.states import ACTIVE

LATE_DATA_S, MISSING_DATA_S = 2.0, 10.0
"""Devices send ten times a second or more: later data are a warning, then a failure."""

LOW_MARGIN_PERCENT = 10.0  # of the limit; nearer than that is worth a look


class Level(enum.IntEnum):
    """Tell how far a value is from normal; only what is not normal is coloured."""

    NORMAL = 0
    WARNING = 1
    CRITICAL = 2


class StateShape(enum.StrEnum):
    """Name the shape drawn beside the state word, so that it never rests on colour."""

    CIRCLE = "circle"
    TRIANGLE = "triangle"
    BARS = "bars"
    SQUARE = "square"
    ARROWS = "arrows"
    DIAMOND = "diamond"
    BROKEN = "broken"


@dataclass(frozen=True, slots=True)
class TileText:
    """One tile: a large value, one line below, how normal it is."""

    value: str
    detail: str = ""
    level: Level = Level.NORMAL


@dataclass(frozen=True, slots=True)
class Headline:
    """Everything that the header shows."""

    shape: StateShape
    state: TileText
    cycle: TileText
    progress: float
    end: TileText
    age: TileText
    margin: TileText
    agreement: TileText
    alarms: TileText
    line: str


_STATES: dict[RunState, tuple[str, StateShape, Level]] = {
    RunState.IDLE: ("Idle", StateShape.CIRCLE, Level.NORMAL),
    RunState.CONNECTING: ("Connecting", StateShape.ARROWS, Level.NORMAL),
    RunState.READY: ("Ready", StateShape.CIRCLE, Level.NORMAL),
    RunState.STARTING: ("Starting", StateShape.ARROWS, Level.NORMAL),
    RunState.RUNNING: ("Running", StateShape.TRIANGLE, Level.NORMAL),
    RunState.PAUSING: ("Pausing", StateShape.ARROWS, Level.WARNING),
    RunState.PAUSED: ("Paused", StateShape.BARS, Level.WARNING),
    RunState.STOPPING: ("Stopping", StateShape.ARROWS, Level.NORMAL),
    RunState.STOPPED: ("Stopped", StateShape.SQUARE, Level.NORMAL),
    RunState.FAULT: ("Fault", StateShape.DIAMOND, Level.CRITICAL),
}


def headline(
    status: Status | None,
    connection: ConnectionState,
    connection_reason: str,
    data_age_s: float | None,
    now: Callable[[], float] = time.time,
) -> Headline:
    """Return what the header shows for a status (None: never heard of the engine)."""
    unknown = TileText("–")
    if status is None:
        state = TileText("Attaching", connection_reason)
        return Headline(
            StateShape.ARROWS, state, unknown, 0.0, unknown, unknown, unknown, unknown, unknown, ""
        )
    shape, state = _state(status, connection, connection_reason)
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


def _state(
    status: Status, connection: ConnectionState, connection_reason: str
) -> tuple[StateShape, TileText]:
    if connection is ConnectionState.LOST:
        return StateShape.BROKEN, TileText(
            "No engine", f"{connection_reason}; trying again", Level.CRITICAL
        )
    if connection is ConnectionState.SILENT:
        word = _STATES[status.state][0]
        return StateShape.BROKEN, TileText(
            "Silent", f"was {word.lower()}; {connection_reason}", Level.WARNING
        )
    word, shape, level = _STATES[status.state]
    return shape, TileText(word, status.reason, level)


def _cycle(status: Status) -> TileText:
    if status.planned <= 0:
        return TileText("–", "no test")
    saved = f"{grouped(status.committed)} saved"
    return TileText(f"{grouped(status.revolution)} of {grouped(status.planned)}", saved)


def _end(status: Status, now: float) -> TileText:
    if status.state not in ACTIVE or status.expected_end_at <= 0.0:
        return TileText("–", "no test running" if status.state not in ACTIVE else "")
    left = max(0.0, status.expected_end_at - now)
    moment = time.localtime(status.expected_end_at)
    today = time.localtime(now)
    days = (moment.tm_year, moment.tm_yday) != (today.tm_year, today.tm_yday)
    day = time.strftime("%a, ", moment) if days else ""
    return TileText(time.strftime("%H:%M", moment), f"{day}in {duration(left)}")


def _age(status: Status, data_age_s: float | None) -> TileText:
    if data_age_s is None or not math.isfinite(data_age_s):
        return TileText("–", "no data yet")
    level = Level.NORMAL
    if status.state in ACTIVE and data_age_s > LATE_DATA_S:
        level = Level.CRITICAL if data_age_s > MISSING_DATA_S else Level.WARNING
    return TileText(
        f"{data_age_s:.1f} s" if data_age_s < 100.0 else duration(data_age_s), "", level
    )


def _margin(status: Status) -> TileText:
    if not status.worst_margin or not math.isfinite(status.worst_margin_percent):
        running = status.state in ACTIVE
        return TileText("–", "nothing judged yet" if running else "no test running")
    percent = status.worst_margin_percent
    level = Level.NORMAL
    if percent <= 0.0:
        level = Level.CRITICAL
    elif percent < LOW_MARGIN_PERCENT:
        level = Level.WARNING
    return TileText(f"{percent:.0f} %", status.worst_margin.replace("_", " "), level)


def _agreement(status: Status) -> TileText:
    if status.twin_revolution <= 0 or not math.isfinite(status.residual_rms_N):
        return TileText("–", "no prediction")
    behind = status.revolution - status.twin_revolution
    value = f"±{status.residual_rms_N:.1f} N"
    if is_stale(status):
        return TileText(value, f"stale for {duration(status.twin_age_s)}", Level.WARNING)
    return TileText(
        value, "RMS, this cycle" if behind <= 1 else f"RMS, {grouped(behind)} cycles ago"
    )


def _alarms(status: Status) -> TileText:
    shown = [alarm for alarm in status.alarms if alarm.state not in ("normal", "shelved")]
    if not shown:
        return TileText("None")
    new = sum(1 for alarm in shown if not alarm.acknowledged)
    critical = any(alarm.severity is Severity.CRITICAL for alarm in shown)
    first = next((alarm for alarm in shown if alarm.first_out), shown[0])
    count = f"{len(shown)}" if not new else f"{len(shown)}, {new} new"
    return TileText(count, first.title, Level.CRITICAL if critical else Level.WARNING)


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
    if status.state in ACTIVE:
        parts.append(f"{status.speed_rpm:.1f} of {status.target_rpm:.1f} rpm")
    if status.operator:
        parts.append(f"Operator: {status.operator}")
    if status.file:
        parts.append(f"File: {PurePath(status.file).name}")
    return "     ".join(parts)
