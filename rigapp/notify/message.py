"""A message, and its text for an absent operator."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Literal

import msgspec

from rigapp.schema.details import sentence_of
from rigapp.schema.messages import NO_TEST, Alarm, Status
from rigapp.schema.notices import Finished

Turn = Literal["raised", "recovered", "told"]
Level = Literal["critical", "warning", "information"]

MOST_CHARACTERS = 3000
"""Maximum characters of a text: more than any alarm has, less than every service accepts."""


class Message(msgspec.Struct, frozen=True):
    """A message. turn: of a condition that comes and goes, or a single one. at: UTC s."""

    key: str
    turn: Turn
    level: Level
    title: str
    text: str
    at: float


def alarm_message(alarm: Alarm) -> tuple[str, str]:
    """Return title and text of an alarm that rises."""
    where = f" At revolution {alarm.revolution:,}." if alarm.revolution else ""
    text = f"{alarm.cause}{where}\n{alarm.consequence}\nWhat to do: {alarm.action}"
    return alarm.title, text


def finished_message(end: Finished) -> tuple[str, str]:
    """Return title and text of the end of a test."""
    text = f"{end.sentence}\n{end.revolutions:,} revolutions are safe in {end.file}."
    return f"Test {end.status}", text


def summary_message(status: Status, made: int) -> tuple[str, str]:
    """Return title and text of the daily summary; made: revolutions since the last one."""
    test = status.test or NO_TEST
    lines = [f"State: {status.engine.state.value}."]
    if test.title:
        lines.append(f"Test: {test.title}, in {test.file}.")
        lines.append(
            f"Revolution {test.revolution:,} of {test.planned:,};"
            f" {max(0, made):,} since the last summary."
        )
    if test.expected_end_at > 0.0:
        lines.append(f"Expected end: {clock(test.expected_end_at)}.")
    if test.criterion:
        lines.append(f"Nearest end: {test.criterion}, {test.criterion_percent:.3g} % before it.")
    if test.worst_margin:
        lines.append(f"Least margin: {test.worst_margin_percent:.3g} % to {test.worst_margin}.")
    names = ", ".join(alarm.title for alarm in status.alarms if alarm.active)
    lines.append(f"Alarms: {names or 'none'}.")
    return "Daily summary", "\n".join(lines)


def headline(rig: str, message: Message) -> str:
    """Return the title under which a message arrives."""
    if message.turn == "recovered":
        return f"{rig}: OVER: {message.title}"
    level = "" if message.level == "information" else f"{message.level.upper()}: "
    return f"{rig}: {level}{message.title}"


def worded(rig: str, batch: Sequence[Message]) -> tuple[str, str]:
    """Return title and text of a delivery: one message, or several in one."""
    if len(batch) == 1:
        message = batch[0]
        text = f"{sentence_of(message.text)}\n{clock(message.at)}"
        return headline(rig, message), text[:MOST_CHARACTERS]
    parts = [
        f"{clock(message.at)}  {headline(rig, message)}\n{sentence_of(message.text)}"
        for message in batch
    ]
    share = MOST_CHARACTERS // len(parts)
    return f"{rig}: {len(batch)} messages", "\n\n".join(part[:share] for part in parts)


def worst_level(batch: Sequence[Message]) -> Level:
    """Return the worst level of some messages; ended conditions do not count."""
    levels = {message.level for message in batch if message.turn != "recovered"}
    if "critical" in levels:
        return "critical"
    return "warning" if "warning" in levels else "information"


def clock(at: float) -> str:
    """Return a time by this computer's clock, with its offset from UTC."""
    return time.strftime("%Y-%m-%d %H:%M:%S %z", time.localtime(at))
