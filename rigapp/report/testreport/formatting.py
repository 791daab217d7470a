"""Format numbers, times and codes for a report."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any, Final

from rigapp.presentation.numbers import grouped
from rigapp.presentation.translation import Text, tr
from rigapp.schema.channels import Channel
from rigapp.schema.messages import Flag
from rigapp.storage import name_and_unit
from rigapp.texts import capitalised

UNKNOWN: Final[Text] = "unknown"
NOUNS: Final[tuple[Text, ...]] = (
    "alarm", "alarms", "event", "events", "gap", "gaps", "line", "lines", "revolution",
    "revolutions", "sample", "samples", "complete cycle", "complete cycles", "more trigger",
    "more triggers",
)  # fmt: skip
"""Nouns of ``counted``, singular and plural."""

DECIMALS = {"N": 1, "um": 1, "mm": 4, "rpm": 2, "deg": 1, "degC": 1, "s": 1, "1": 0}
"""Decimal places of each unit on this kind of rig."""

POWER: Final = re.compile(r"(?<=[a-z])\^?([23])(?![0-9])")
"""Exponent of a unit: g/cm3, mm^3."""
SHORTER: Final[dict[str, Text]] = {
    "force": "joint force |F|",
    "force_1": "force along the crank, force_1",
    "force_2": "force across the crank, force_2",
    "probe_1": "pin along the follower, probe_1",
    "speed": "speed of the crank",
    "probe_2": "pin across the follower, probe_2",
}
"""Short names of the channels of every rig for headings; those of the schema are sentences."""

FLAGS: Final[dict[Flag, Text]] = {
    Flag.LOST_SAMPLES: "samples lost in or just before the revolution",
    Flag.COUNT_MISMATCH: "encoder count at the index is not a multiple of one turn",
    Flag.MISSED_INDEX: "no index pulse",
    Flag.SATURATED: "an input at the end of its range",
    Flag.GAP_BEFORE: "data missing before the revolution",
    Flag.REVERSED: "the crank turned backwards",
    Flag.PARTIAL: "the revolution is incomplete",
    Flag.TIME_JUMP: "device time and host time drifted apart",
    Flag.PAUSED: "a pause in the revolution",
    Flag.RAMP: "the speed was being changed",
    Flag.SENSOR_FAULT: "a sensor or its cable was broken",
}

STATUSES: Final[dict[str, Text]] = {
    "running": "running while the report was made",
    "complete": "complete",
    "stopped": "stopped before the planned end",
    "interrupted": "interrupted: the program ended without closing the test",
}

REASONS: Final[dict[str, Text]] = {
    "complete": "all planned revolutions were made",
    "operator": "stopped by the operator",
    "limit": "stopped by a limit",
    "device": "stopped because a device failed",
    "storage": "stopped because the file could not be written",
    "internal": "stopped because a part of the program failed",
}


def title_of(channel: Channel) -> str:
    """Return the name of a channel in tables and figures."""
    return tr(SHORTER.get(channel.name, channel.description or channel.name))


def symbol(unit: str) -> str:
    """Return the printed form of a unit."""
    named = {"um": "µm", "1": "", "deg": "°", "degC": "°C"}.get(unit, unit.replace("um/", "µm/"))
    return POWER.sub(lambda power: {"2": "²", "3": "³"}[power[1]], named)


def number(value: float, unit: str = "1", digits: int | None = None) -> str:
    """Return a value with the decimal places of its unit; not finite: unknown."""
    if not math.isfinite(value):
        return tr(UNKNOWN)
    decimals = DECIMALS.get(unit, 3) if digits is None else digits
    text = f"{value:.{decimals}f}"
    return text.lstrip("-") if float(text) == 0.0 else text


def quantity(value: float, unit: str, digits: int | None = None) -> str:
    """Return a value with its unit; not finite: unknown."""
    text = number(value, unit, digits)
    return text if text == tr(UNKNOWN) else f"{text} {symbol(unit)}".rstrip()


def counted(value: int, noun: str, many: str = "") -> str:
    """Return a number with its noun, singular or plural."""
    return f"{grouped(value)} {tr(noun if value == 1 else many or noun + 's')}"


def utc(seconds: float) -> str:
    """Return UTC seconds since 1970-01-01 as a date and time of day."""
    if not math.isfinite(seconds):
        return tr(UNKNOWN)
    try:
        return f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%d %H:%M:%S}"
    except (OverflowError, OSError, ValueError):
        return tr(UNKNOWN)


def stamp(text: str) -> str:
    """Return an ISO 8601 time of the file as a date and time of day, empty: unknown."""
    try:
        return f"{datetime.fromisoformat(text).astimezone(UTC):%Y-%m-%d %H:%M:%S} UTC"
    except ValueError:
        return text or tr(UNKNOWN)


def size(octets: int) -> str:
    """Return a file's size in decimal units and in bytes."""
    exact = tr("{} bytes", grouped(octets))
    for unit, factor in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if octets >= factor:
            return f"{octets / factor:.1f} {unit} ({exact})"
    return exact


def flags(quality: int) -> str:
    """Return the flags of a revolution as text, empty for a good one."""
    return "; ".join(tr(words) for flag, words in FLAGS.items() if quality & flag)


def settings(values: Mapping[str, Any], prefix: str = "") -> list[tuple[str, str]]:
    """Return nested settings as rows of name and value, with the key's unit after the value."""
    rows: list[tuple[str, str]] = []
    for key, value in values.items():
        if isinstance(value, Mapping):
            rows += settings(value, f"{prefix}{key.replace('_', ' ')}, ")
            continue
        name, unit = name_and_unit(key)
        text = _setting(value)
        shown = text if text == tr(UNKNOWN) else f"{text} {symbol(unit)}".rstrip()
        rows.append((f"{prefix}{_named(name)}", shown or tr("none")))
    return rows


def _named(name: str) -> str:
    """Return the name of a key; in another language that of the form of a test file."""
    words = name.replace("_", " ")
    known = tr(capitalised(words))
    return words if known == capitalised(words) else known


MANY: Final = 1e12
"""Integers from this value are treated as quantities, written with a power of ten."""


def _setting(value: Any) -> str:
    if isinstance(value, float) and math.isnan(value):
        return tr(UNKNOWN)
    if isinstance(value, list):
        if value and all(isinstance(number, float) and math.isnan(number) for number in value):
            return tr(UNKNOWN)
        if any(isinstance(row, list) for row in value):
            return "; ".join(", ".join(map(_setting, row)) for row in value)
        return ", ".join(map(_setting, value))
    if isinstance(value, float) and value.is_integer() and abs(value) < MANY:
        return f"{value:.0f}"  # all digits of a count
    return f"{value:.6g}" if isinstance(value, float) else str(value)
