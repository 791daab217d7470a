"""The append-only log: rows chained by digests, and conversion of older versions."""

from __future__ import annotations

import contextlib
import hashlib
import re
import struct
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

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
from rigapp.schema.wire import json_bytes, parts_of_sentence, sentence_of_parts, tree_of
from rigapp.storage.structure.layout import FileColumn
from rigapp.texts import Sentence, braces

CODES = ("kind", "source", "key", "level")
"""Texts of one row; longer ones are truncated."""

TEXTS = ("text", "before", "after", "data")
"""Texts that may continue in the next row."""

_HASHED = ("kind", "source", "text", "before", "after", "key", "level", "data")


SENTENCES_KEY = "said"
"""Key of ``data``: templates and values of an event's sentences, for translation."""
ASKED_KINDS = frozenset({"note", "command", "limit_changed", "zero", "viewer"})
OWN_ALARMS = "engine"
"""Source of an alarm that no request caused."""


def is_requested(event: Event) -> bool:
    """Return whether an event results from a request to the engine."""
    return event.kind in ASKED_KINDS or (event.kind == "alarm" and event.source != OWN_ALARMS)


def rows_of(event: Event, digest: bytes, fields: Sequence[FileColumn]) -> list[dict[str, Any]]:
    """Return an event as rows; a text longer than its column continues in the next row.

    digest: hexadecimal digest of the row before, of the file's identifier for the first row.
    """
    width = {field.name: int(field.dtype[1:]) for field in fields if field.dtype.startswith("S")}
    texts = {**msgspec.structs.asdict(event), "data": _encoded(event)}
    parts = {name: _parts(texts[name], width[name]) for name in TEXTS if name in width}
    codes = {name: _parts(texts[name], width[name])[0] for name in CODES if name in width}
    number = max(map(len, parts.values()))
    rows: list[dict[str, Any]] = []
    for i in range(number):
        row: dict[str, Any] = {
            "time": event.time,
            "revolution": event.revolution,
            **codes,
            **{name: cut[i] if i < len(cut) else b"" for name, cut in parts.items()},
            "continued": int(i < number - 1),
        }
        digest = digest_of(row, digest)
        rows.append({**row, "digest": digest})
    return rows


def digest_of(row: Mapping[str, Any], before: bytes) -> bytes:
    """Return the hexadecimal SHA-256 of a row and the digest before it.

    Hashed are: the digest before (ASCII), time (little-endian float64), revolution (int64),
    continued (int32), then kind, source, text, before, after, and key, level and data where the
    file has them, each as UTF-8 and a zero byte.
    """
    numbers = struct.pack("<dqi", row["time"], row["revolution"], row["continued"])
    texts = b"".join(row[name] + b"\0" for name in _HASHED if name in row)
    return hashlib.sha256(before + numbers + texts).hexdigest().encode()


def seed_of(identifier: str) -> bytes:
    """Return the digest that precedes the first row of a file."""
    return hashlib.sha256(identifier.encode()).hexdigest().encode()


def events_of(columns: Mapping[str, NDArray[Any]]) -> list[Event]:
    """Return the events in columns of rows, with continued texts joined."""
    result: list[Event] = []
    open_texts: dict[str, bytes] = {}
    for row in table_rows(columns):
        for name in TEXTS:
            open_texts[name] = open_texts.get(name, b"") + row.get(name, b"")
        if row["continued"]:
            continue
        codes = {name: row[name] for name in CODES if name in row}
        texts = {k: v.decode(errors="replace") for k, v in (codes | open_texts).items()}
        data = _decoded(texts.pop("data"))
        sentences = _sentences(data.pop(SENTENCES_KEY, ()))
        texts["text"] = sentences.get(texts["text"], texts["text"])
        data = {key: sentences.get(v, v) if isinstance(v, str) else v for key, v in data.items()}
        result.append(Event(row["time"], row["revolution"], data=data, **texts))
        open_texts = {}
    return result


def logged_sentence(text: str, events: Iterable[Event]) -> str:
    """Return the translatable sentence of the log for a text of a file, else the text itself."""
    return next((event.text for event in reversed([*events]) if event.text == text), text)


def first_broken_link(columns: Mapping[str, NDArray[Any]], identifier: str) -> int | None:
    """Return the first row whose digest does not match its content, None when all do."""
    digest = seed_of(identifier)
    for i, row in enumerate(table_rows(columns)):
        digest = digest_of(row, digest)
        if digest != row["digest"]:
            return i
    return None


def table_rows(columns: Mapping[str, NDArray[Any]]) -> Iterable[dict[str, Any]]:
    """Yield the rows of a table given by columns, as plain Python values."""
    for values in zip(*(column.tolist() for column in columns.values()), strict=True):
        yield dict(zip(columns, values, strict=True))


def columns_of(
    rows: Sequence[Mapping[str, Any]], fields: Sequence[FileColumn]
) -> dict[str, NDArray[Any]]:
    """Return rows as one array for each column."""
    return {
        field.name: np.array([row[field.name] for row in rows], field.dtype) for field in fields
    }


def _encoded(event: Event) -> str:
    parts = [
        parts_of_sentence(text)
        for text in (event.text, *event.data.values())
        if isinstance(text, Sentence) and _has_words(text)
    ]
    data = {**event.data, SENTENCES_KEY: parts} if parts else event.data
    return json_bytes(data).decode() if data else ""


def _has_words(text: object) -> bool:
    """Return whether a text is a sentence that can be translated."""
    if not isinstance(text, Sentence):
        return False
    literals = "".join(literal for literal, _, _ in braces(text.template))
    return any(map(str.isalpha, literals)) or any(map(_has_words, text.values.values()))


def _sentences(structures: Any) -> dict[str, Sentence]:
    """Return sentences by their English texts; other values are skipped."""
    result: dict[str, Sentence] = {}
    for structure in structures if isinstance(structures, list) else ():
        with contextlib.suppress(ValueError, TypeError, KeyError, AttributeError, RecursionError):
            sentence = sentence_of_parts(structure)
            result[str(sentence)] = sentence
    return result


def _decoded(text: str) -> dict[str, Any]:
    try:
        result = msgspec.json.decode(text) if text else {}
    except msgspec.DecodeError:
        return {}
    return result if isinstance(result, dict) else {}


def _parts(text: str, width: int) -> list[bytes]:
    """Split a text between characters into one or more UTF-8 parts of at most ``width`` bytes."""
    data = text.replace("\0", " ").encode("utf-8", errors="replace")
    parts: list[bytes] = []
    while len(data) > width:
        end = width
        while (data[end] & 0xC0) == 0x80:
            end -= 1
        parts.append(data[:end])
        data = data[end:]
    return [*parts, data]


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
_CRITERIA = {criterion.title: name for name, criterion in CRITERIA.items()}
_TITLES = [
    (re.compile(re.sub(r"\\\{\w*\\\}", "(.+)", re.escape(kind.title))), key, kind)
    for key, kind in sorted(KINDS.items(), key=lambda item: "{" in item[1].title)
]
"""Pattern of each title and its kind; titles without a pattern first."""


def translated(events: Iterable[Event]) -> list[Event]:
    """Return the events of an old log in the present form, with key, level and data."""
    known: dict[str, tuple[str, Severity, AlarmChange]] = {}
    by_kind: dict[str, Callable[[Event], Event]] = {
        ALARM: lambda event: _alarm(event, known),
        LIMIT_CHANGED: _limit,
        REST: _rest,
        "gap": lambda event: msgspec.structs.replace(event, level="warning"),
    }
    return [by_kind[event.kind](event) if event.kind in by_kind else event for event in events]


def _alarm(event: Event, known: dict[str, tuple[str, Severity, AlarmChange]]) -> Event:
    """Convert an event of an alarm; known: the last state of each alarm, by its title."""
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
    """Return key, severity and kind of an alarm by its title; the title as key when unknown."""
    rule = _RULE.fullmatch(title)
    if rule is not None:
        severity = Severity.CRITICAL if " critical limit" in cause else Severity.WARNING
        key = f"rule:{rule['quantity']}:{severity.value}:{rule['side']}"
        action = "Look at the trend of this quantity."
        return key, severity, Kind(severity, title, cause, NOT_RECORDED, action, Ends.TEST)
    for pattern, key, kind in _TITLES:
        match = pattern.fullmatch(title)
        if match is not None:
            names = (_CRITERIA.get(part, part) for part in match.groups())
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
