"""Texts of the state of a rig: a word, and a line with what is next."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable
from typing import Final

from rigapp.presentation.times import dated
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.details import details_of
from rigapp.schema.messages import (
    NO_TEST,
    Alarm,
    HowEnded,
    OpenCalibration,
    RunState,
    Severity,
    Status,
)

STATES: Final[dict[RunState, Text]] = {
    RunState.IDLE: "Idle",
    RunState.CONNECTING: "Connecting",
    RunState.READY: "Ready",
    RunState.STARTING: "Starting",
    RunState.RUNNING: "Running",
    RunState.PAUSING: "Pausing",
    RunState.PAUSED: "Paused",
    RunState.STOPPING: "Stopping",
    RunState.STOPPED: "Stopped",
    RunState.FAULT: "Fault",
    RunState.CALIBRATING: "Calibrating",
}
OUTCOMES: Final[dict[HowEnded, Text]] = {
    HowEnded.COMPLETE: "Complete",
    HowEnded.OPERATOR: "Stopped",
    HowEnded.TRIPPED: "Tripped",
    HowEnded.FAULT: "Fault",
    HowEnded.INTERRUPTED: "Interrupted",
    HowEnded.RUNNING: "Running",
    HowEnded.NOT_READABLE: "Cannot be read",
}
"""How a test ended, wherever it is shown: strip, card, list, report, command line."""

CALIBRATED: Final[tuple[Text, ...]] = ("load cell", "probes", "slow roll", "running check")
"""What the command line calibrates; the window's words are with its choices."""

USUAL: Final[dict[RunState, Text]] = {
    RunState.RUNNING: "Running as planned.",
    RunState.READY: "Ready: the devices are connected. Start a test with F5.",
    RunState.CONNECTING: "Connecting: finding the devices of the rig.",
    RunState.STARTING: "Starting: the zeros are taken, then the spindle is brought to speed.",
}
"""Line of a state for which the engine gives no reason and no next step."""


def is_resting(status: Status) -> bool:
    """Return whether the test rests between two steps and resumes by itself."""
    test = status.test or NO_TEST
    return test.resting and status.engine.state is RunState.PAUSED


def state_word(status: Status) -> str:
    """Return the state in a word; after a test, how the test ended."""
    test = status.test or NO_TEST
    if is_resting(status):
        return tr("Resting")
    if status.rig.coasting:
        return tr("Coasting")
    if status.engine.state is RunState.STOPPED and test.outcome is not None:
        return tr(OUTCOMES[test.outcome])
    return tr(STATES[status.engine.state])


def rest_text(status: Status) -> str:
    """Return the remaining time of a rest, and the step to which it belongs."""
    test = status.test or NO_TEST
    left = math.ceil(test.rest_left_s)
    return tr("{} s left, step {} of {}", left, test.step, test.steps)


def calibration_text(status: Status) -> str:
    """Return what is calibrated, by whom and since when; empty without a calibration."""
    return (
        calibration_words(status.engine.calibration)
        if status.engine.calibration is not None
        else ""
    )


def calibration_words(calibration: OpenCalibration) -> str:
    """Return what is calibrated, by whom and since when."""
    since = since_text(calibration.since, time.time())
    return tr("{}, by {}, since {}", tr(calibration.what), calibration.who, since)


def occupied_text(status: Status) -> str:
    """Return why the spindle cannot turn while a calibration is open."""
    text: Text = (
        "Calibrating: {}. Nothing starts until it ends: close it, or press End calibration."
    )
    return tr(text, calibration_text(status))


def since_text(since: float, now: float) -> str:
    """Return a time of day, with its day where that is another one; UTC seconds."""
    moment, today = time.localtime(since), time.localtime(now)
    same_day = (moment.tm_year, moment.tm_yday) == (today.tm_year, today.tm_yday)
    return dated("%H:%M" if same_day else "%a %H:%M", moment)


def state_line(status: Status, key: str = "") -> str:
    """Return state and next step; key: that does the next step, in the window."""
    word = state_word(status)
    if is_resting(status):
        return f"{word}, {rest_text(status)}. {tr('The test resumes by itself.')}"
    step, occupied = status.recovery, calibration_text(status)
    reason = "" if status.engine.state is RunState.CALIBRATING else status.engine.reason
    pressed = f" ({key})" if key and step.verb and step.left else ""
    parts = [
        f"{word}: {translate(reason)}" if reason else "",
        f"{tr(STATES[RunState.CALIBRATING])}: {occupied}." if occupied else "",
        translate(step.sentence) + pressed,
    ]
    return "  ".join(part for part in parts if part) or _unnamed(status, word)


def state_details(status: Status) -> str:
    """Return the technical details of ``state_line``, a line each."""
    reasons = (status.engine.reason, status.recovery.sentence)
    alarm = worst_alarm(status.alarms) if not any(reasons) else None
    texts = reasons if alarm is None else (alarm.title, alarm.cause)
    return "\n".join(filter(None, map(details_of, texts)))


def _unnamed(status: Status, word: str) -> str:
    """Return the line of a state without reason and next step: its worst alarm comes first."""
    alarm = worst_alarm(status.alarms)
    if alarm is not None:
        return f"{word}. {translate(alarm.title)}: {translate(alarm.cause)}"
    return tr(USUAL.get(status.engine.state, f"{word}."))


def listed_alarms(alarms: Iterable[Alarm]) -> list[Alarm]:
    """Return the alarms to show: those that have not ended and are not shelved."""
    return [alarm for alarm in alarms if alarm.state not in ("normal", "shelved")]


def worst_alarm(alarms: Iterable[Alarm]) -> Alarm | None:
    """Return the alarm to name: not acknowledged, first out, critical, then the oldest."""
    return min(
        listed_alarms(alarms),
        key=lambda alarm: (
            alarm.acknowledged,
            not alarm.first_out,
            alarm.severity is not Severity.CRITICAL,
            alarm.raised_at,
        ),
        default=None,
    )
