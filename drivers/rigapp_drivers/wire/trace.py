"""File format of a recorded line: notes, and bytes with time and direction, with checksums.

After the first line (``rigapp wire 1``) come records: kind (1 byte), length (u32), time (i64, ns of
the monotonic clock), payload, CRC-32 of all of these; integers little-endian. The first record is a
note (JSON) that names the device.
"""

from __future__ import annotations

import enum
import json
import struct
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO, Final

from rigapp.texts import SentenceError, say

MAGIC: Final = b"rigapp wire 1\n"
_HEAD: Final = struct.Struct("<cIq")
_CRC: Final = struct.Struct("<I")
MOST_BYTES: Final = 1 << 24
"""Maximum length of one record; a greater value means a damaged file."""
LARGEST_FILE: Final = 1 << 30


class RecordKind(enum.Enum):
    """Kind of a record."""

    SENT = b">"
    RECEIVED = b"<"
    NOTE = b"#"


class TraceError(SentenceError, ValueError):
    """A file is not a recorded line, or is damaged; one sentence with the place."""


@dataclass(frozen=True, slots=True)
class WireRecord:
    """Bytes sent or received, or a note (JSON); time_ns: monotonic."""

    kind: RecordKind
    time_ns: int
    data: bytes

    @property
    def note(self) -> Mapping[str, Any]:
        """Return the content of a note, empty for other records."""
        if self.kind is not RecordKind.NOTE:
            return {}
        content = json.loads(self.data)
        return content if isinstance(content, dict) else {}


@dataclass(frozen=True, slots=True)
class WireTrace:
    """A recorded line.

    header: device, driver, settings, protocol. problem: why the file ends early, empty if it is
    complete.
    """

    path: Path
    header: Mapping[str, Any]
    records: tuple[WireRecord, ...]
    problem: str = ""


def encode_record(kind: RecordKind, time_ns: int, data: bytes) -> bytes:
    """Return the bytes of one record."""
    head = _HEAD.pack(kind.value, len(data), time_ns)
    return b"".join((head, data, _CRC.pack(zlib.crc32(data, zlib.crc32(head)))))


def encode_note(time_ns: int, content: Mapping[str, Any]) -> bytes:
    """Return the bytes of a note."""
    return encode_record(RecordKind.NOTE, time_ns, json.dumps(content, default=str).encode())


def read_trace(path: Path) -> WireTrace:
    """Return the undamaged part of a recorded line; raise TraceError for any other file."""
    try:
        size = path.stat().st_size
        if not path.is_file() or size > LARGEST_FILE:
            raise TraceError("{}: this is no recorded line; give a file of --record-wire.", path)
        with path.open("rb") as file:
            return _read(path, file)
    except OSError as error:
        raise TraceError(
            "{}: the recorded line cannot be read ‹{}›.", path, error.strerror or error
        ) from error


def _read(path: Path, file: BinaryIO) -> WireTrace:
    if file.read(len(MAGIC)) != MAGIC:
        raise TraceError("{}: this is no recorded line; give a file of --record-wire.", path)
    records: list[WireRecord] = []
    problem = ""
    try:
        records.extend(_records(file, records))
    except _Damaged as error:
        problem = say("{}: {}", path, error.args[0])
    header = records[0].note if records else {}
    if not isinstance(header.get("driver"), str):
        raise TraceError("{}: the recorded line is damaged at its beginning.", path)
    return WireTrace(path, header, tuple(records[1:]), problem)


class _Damaged(Exception):
    """A record is truncated or does not match its checksum."""


def _records(file: BinaryIO, done: list[WireRecord]) -> Iterator[WireRecord]:
    while head := file.read(_HEAD.size):
        if len(head) < _HEAD.size:
            raise _Damaged(_cut(done))
        mark, length, time_ns = _HEAD.unpack(head)
        if length > MOST_BYTES:
            raise _Damaged(_bad_checksum(done))
        data, sum_ = file.read(length), file.read(_CRC.size)
        if len(data) < length or len(sum_) < _CRC.size:
            raise _Damaged(_cut(done))
        if zlib.crc32(data, zlib.crc32(head)) != _CRC.unpack(sum_)[0]:
            raise _Damaged(_bad_checksum(done))
        try:
            record = WireRecord(RecordKind(mark), time_ns, data)
            assert record.kind is not RecordKind.NOTE or record.note is not None
        except ValueError as error:
            raise _Damaged(_bad_checksum(done)) from error
        yield record


def _cut(done: list[WireRecord]) -> str:
    return say("the recording is cut short after record {}; what is before it is used.", len(done))


def _bad_checksum(done: list[WireRecord]) -> str:
    return say("the recording is damaged at record {}; what is before it is used.", len(done) + 1)
