"""The append-only log: events as fixed-width rows, each bound to the one before by a digest."""

from __future__ import annotations

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

CODES = ("kind", "source", "key", "level")
"""Texts of one row; one that is too long is cut."""

TEXTS = ("text", "before", "after", "data")
"""Texts that go on in the next row."""

_HASHED = ("kind", "source", "text", "before", "after", "key", "level", "data")


ASKED_KINDS = frozenset({"note", "command", "limit_changed", "zero", "viewer"})
OWN_ALARMS = "engine"
"""The source of an alarm that nobody asked for."""


def asked_for(event: Event) -> bool:
    """Tell whether an event is there because somebody asked the engine for something."""
    return event.kind in ASKED_KINDS or (event.kind == "alarm" and event.source != OWN_ALARMS)


def rows_of(event: Event, digest: bytes, fields: Sequence[FileColumn]) -> list[dict[str, Any]]:
    """Return an event as rows; a text longer than its column goes on in the next row.

    digest: hexadecimal digest of the row before, of the file's identifier for the first row.
    """
    width = {one.name: int(one.dtype[1:]) for one in fields if one.dtype.startswith("S")}
    texts = {**msgspec.structs.asdict(event), "data": _encoded(event.data)}
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
        found.append(Event(row["time"], row["revolution"], data=data, **texts))
        open_texts = {}
    return found


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


def _encoded(data: Mapping[str, Any]) -> str:
    return json_bytes(data).decode() if data else ""


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
