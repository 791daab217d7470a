"""The append-only log: events as fixed-width rows, each bound to the one before by a digest."""

from __future__ import annotations

import contextlib
import hashlib
import struct
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.messages import Event
from rigapp.schema.wire import json_bytes
from rigapp.storage.structure.layout import FileColumn
from rigapp.texts import Sentence, braces

CODES = ("kind", "source", "key", "level")
"""Texts of one row; one that is too long is cut."""

TEXTS = ("text", "before", "after", "data")
"""Texts that go on in the next row."""

_HASHED = ("kind", "source", "text", "before", "after", "key", "level", "data")


SAID = "said"
"""Key of ``data``: templates and values of the sentences of a line, for other languages."""
ASKED_KINDS = frozenset({"note", "command", "limit_changed", "zero", "viewer"})
OWN_ALARMS = "engine"
"""The source of an alarm that nobody asked for."""


def is_requested(event: Event) -> bool:
    """Tell whether an event is there because somebody asked the engine for something."""
    return event.kind in ASKED_KINDS or (event.kind == "alarm" and event.source != OWN_ALARMS)


def rows_of(event: Event, digest: bytes, fields: Sequence[FileColumn]) -> list[dict[str, Any]]:
    """Return an event as rows; a text longer than its column goes on in the next row.

    digest: hexadecimal digest of the row before, of the file's identifier for the first row.
    """
    width = {one.name: int(one.dtype[1:]) for one in fields if one.dtype.startswith("S")}
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
    """Return what the first row of a file is bound to."""
    return hashlib.sha256(identifier.encode()).hexdigest().encode()


def events_of(columns: Mapping[str, NDArray[Any]]) -> list[Event]:
    """Return the events that columns of rows hold, the continued ones joined."""
    found: list[Event] = []
    open_texts: dict[str, bytes] = {}
    for row in table_rows(columns):
        for name in TEXTS:
            open_texts[name] = open_texts.get(name, b"") + row.get(name, b"")
        if row["continued"]:
            continue
        codes = {name: row[name] for name in CODES if name in row}
        texts = {k: v.decode(errors="replace") for k, v in (codes | open_texts).items()}
        data = _decoded(texts.pop("data"))
        said = _sentences(data.pop(SAID, ()))
        texts["text"] = said.get(texts["text"], texts["text"])
        data = {key: said.get(v, v) if isinstance(v, str) else v for key, v in data.items()}
        found.append(Event(row["time"], row["revolution"], data=data, **texts))
        open_texts = {}
    return found


def as_said(text: str, events: Iterable[Event]) -> str:
    """Return a text of a file as the sentence that its log has of it; as it is without one."""
    return next((one.text for one in reversed([*events]) if one.text == text), text)


def first_broken_link(columns: Mapping[str, NDArray[Any]], identifier: str) -> int | None:
    """Return the first row whose digest does not follow from its content, None when all do."""
    digest = seed_of(identifier)
    for i, row in enumerate(table_rows(columns)):
        digest = digest_of(row, digest)
        if digest != row["digest"]:
            return i
    return None


def table_rows(columns: Mapping[str, NDArray[Any]]) -> Iterable[dict[str, Any]]:
    """Yield the rows of a table given by columns, as plain Python values."""
    for values in zip(*(one.tolist() for one in columns.values()), strict=True):
        yield dict(zip(columns, values, strict=True))


def columns_of(
    rows: Sequence[Mapping[str, Any]], fields: Sequence[FileColumn]
) -> dict[str, NDArray[Any]]:
    """Return rows as one array a column."""
    return {one.name: np.array([row[one.name] for row in rows], one.dtype) for one in fields}


def _encoded(event: Event) -> str:
    said = [_structure(one) for one in (event.text, *event.data.values()) if _has_words(one)]
    data = {**event.data, SAID: said} if said else event.data
    return json_bytes(data).decode() if data else ""


def _has_words(text: object) -> bool:
    """Tell whether a text is a sentence that a catalogue may have."""
    if not isinstance(text, Sentence):
        return False
    literals = "".join(literal for literal, _, _ in braces(text.template))
    return any(map(str.isalpha, literals)) or any(map(_has_words, text.values.values()))


def _structure(sentence: Sentence) -> list[Any]:
    values = {
        name: _structure(value) if isinstance(value, Sentence) else value
        for name, value in sentence.values.items()
    }
    return [sentence.template, values] if values else [sentence.template]


def _sentence(structure: Any) -> Sentence:
    """Return a sentence of its structure; raise ValueError or TypeError where it is none."""
    template, values = (*structure, {})[:2]
    if not isinstance(template, str):
        raise TypeError(template)
    made = {k: _sentence(v) if isinstance(v, list) else v for k, v in values.items()}
    return Sentence.of(template, made)


def _sentences(structures: Any) -> dict[str, Sentence]:
    """Return sentences by their English texts; what is none, is left out."""
    found: dict[str, Sentence] = {}
    for one in structures if isinstance(structures, list) else ():
        with contextlib.suppress(ValueError, TypeError, KeyError, AttributeError, RecursionError):
            sentence = _sentence(one)
            found[str(sentence)] = sentence
    return found


def _decoded(text: str) -> dict[str, Any]:
    try:
        found = msgspec.json.decode(text) if text else {}
    except msgspec.DecodeError:
        return {}
    return found if isinstance(found, dict) else {}


def _parts(text: str, width: int) -> list[bytes]:
    """Cut a text into UTF-8 pieces of at most ``width`` bytes, between characters, at least one."""
    data = text.replace("\0", " ").encode("utf-8", errors="replace")
    parts: list[bytes] = []
    while len(data) > width:
        end = width
        while (data[end] & 0xC0) == 0x80:
            end -= 1
        parts.append(data[:end])
        data = data[end:]
    return [*parts, data]
