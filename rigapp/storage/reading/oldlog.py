"""Read texts of a file, and logs of older versions."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import h5py
import msgspec
import numpy as np

from rigapp.schema.alarms import KINDS, Kind
from rigapp.schema.criteria import CRITERIA
from rigapp.schema.loglines import (
    ALARM,
    LIMIT_CHANGED,
    REST,
    AlarmChange,
    LimitChange,
    RestSignals,
    What,
)
from rigapp.schema.messages import Ends, Event, Severity
from rigapp.schema.wire import tree_of

NOT_RECORDED = "The log does not tell."

_ALARM = re.compile(
    r"(?P<title>.+?): (?P<what>raised, first out|raised|cleared|acknowledged|reset|"
    r"no longer shelved|shelved for (?P<seconds>\S+) s: (?P<reason>.*?))\. (?P<cause>.*)",
    re.DOTALL,
)
_LIMIT = re.compile(r"limit (\S+?) changed")
_RULE = re.compile(r"(?P<quantity>\S+) (?P<side>above|below) limit")
_WHAT: Mapping[str, What] = {
    "raised, first out": "raised",
    "raised": "raised",
    "cleared": "cleared",
    "acknowledged": "acknowledged",
    "reset": "reset",
    "no longer shelved": "unshelved",
}
_CRITERIA = {one.title: name for name, one in CRITERIA.items()}
_TITLES = [
    (re.compile(re.sub(r"\\\{\w*\\\}", "(.+)", re.escape(kind.title))), key, kind)
    for key, kind in sorted(KINDS.items(), key=lambda one: "{" in one[1].title)
]
"""How a title looks, and of what kind it is; the whole ones first."""


def translated(events: Iterable[Event]) -> list[Event]:
    """Return the events of an old log with key, level and data, as the engine writes them now."""
    known: dict[str, tuple[str, Severity, AlarmChange]] = {}
    by_kind: dict[str, Callable[[Event], Event]] = {
        ALARM: lambda event: _alarm(event, known),
        LIMIT_CHANGED: _limit,
        REST: _rest,
        "gap": lambda event: msgspec.structs.replace(event, level="warning"),
    }
    return [by_kind[one.kind](one) if one.kind in by_kind else one for one in events]


def _alarm(event: Event, known: dict[str, tuple[str, Severity, AlarmChange]]) -> Event:
    """Translate a line about an alarm; ``known`` holds how each one was, by its title."""
    match = _ALARM.fullmatch(event.text)
    if match is None:
        return event
    title, words = match["title"], match["what"]
    what = _WHAT.get(words, "shelved")
    if what == "raised":
        first_out = words != "raised"
        key, severity, kind = _kind(title, match["cause"], first_out)
        change = AlarmChange(
            what, title, first_out=first_out, cause=match["cause"],
            consequence=kind.consequence, action=kind.action, ends=kind.ends,
        )  # fmt: skip
    elif title in known:
        key, severity, before = known[title]
        active = before.active and what != "cleared"
        acknowledged = before.acknowledged or what == "acknowledged"
        kept = active or not acknowledged or event.after in ("latched", "shelved")
        change = AlarmChange(
            what, title, listed=kept and what != "reset", active=active,
            acknowledged=acknowledged,
            reason=match["reason"] or "", seconds=_number(match["seconds"]) or 0.0,
        )  # fmt: skip
    else:
        return event
    known[title] = key, severity, change
    return msgspec.structs.replace(event, key=key, level=severity.value, data=tree_of(change))


def _kind(title: str, cause: str, first_out: bool) -> tuple[str, Severity, Kind]:
    """Return key, severity and words of an alarm by its title; the title as key when unknown."""
    rule = _RULE.fullmatch(title)
    if rule is not None:
        severity = Severity.CRITICAL if " critical limit" in cause else Severity.WARNING
        key = f"rule:{rule['quantity']}:{severity.value}:{rule['side']}"
        action = "Look at the trend of this quantity."
        return key, severity, Kind(severity, title, cause, NOT_RECORDED, action, Ends.TEST)
    for pattern, key, kind in _TITLES:
        match = pattern.fullmatch(title)
        if match is not None:
            names = (_CRITERIA.get(one, one) for one in match.groups())
            return ":".join((key, *names)), kind.severity, kind
    severity = Severity.CRITICAL if first_out else Severity.WARNING
    return title, severity, Kind(severity, title, cause, NOT_RECORDED, NOT_RECORDED)


def _limit(event: Event) -> Event:
    match, after = _LIMIT.match(event.text), _number(event.after)
    if match is None or after is None:
        return event
    data = tree_of(LimitChange(_number(event.before), after))
    return msgspec.structs.replace(event, key=match[1], data=data)


def _rest(event: Event) -> Event:
    signals = [_number(part) for part in event.after.split(",")]
    if len(signals) != 2 or signals[0] is None or signals[1] is None:
        return event
    data = tree_of(RestSignals(signals[0], signals[1]))
    return msgspec.structs.replace(event, data=data)


def _number(text: str | None) -> float | None:
    try:
        return float(text) if text else None
    except ValueError:
        return None


LOG = "/entry/events"


def texts_of(file: h5py.File) -> Iterator[tuple[str, str]]:
    """Yield each text that is not empty with its path: of a dataset, or of an attribute.

    An attribute's path is that of its owner, ``@`` and its name. A text that stands several times
    in one dataset comes once. The log is left out: its lines are events.
    """
    found: list[h5py.HLObject] = [file]
    file.visititems(lambda _, one: found.append(one))
    for one in found:
        path = str(one.name)
        if path.startswith(f"{LOG}/"):
            continue
        if isinstance(one, h5py.Dataset) and h5py.check_string_dtype(one.dtype) is not None:
            yield from ((path, text) for text in _texts(one[()]))
        for name, value in one.attrs.items():
            yield from ((f"{path}@{name}", text) for text in _texts(value))


def _texts(value: Any) -> Iterator[str]:
    """Yield the different texts of a value, nothing of one that is none."""
    for one in dict.fromkeys(np.asarray(value).ravel().tolist()) if _is_text(value) else ():
        text = one.decode(errors="replace") if isinstance(one, bytes) else str(one)
        if text:
            yield text


def _is_text(value: Any) -> bool:
    array = np.asarray(value)
    if array.dtype.kind != "O":
        return array.dtype.kind in "SU"
    return all(isinstance(one, str | bytes) for one in array.ravel().tolist())
