"""Copy the data confirmed by checksums from a damaged or truncated test file into a new one.

The rows of a file written in place precede its samples, and its settings precede all rows, so that
a truncated copy has most of them. It is extended to the length in its header (missing data read as
zeros, which no checksum confirms), and read like any other file.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.storage.filesystem.folder import hidden_name, move_into_place, refuse_little_space
from rigapp.storage.filesystem.rescue import copy_content
from rigapp.storage.reading.reader import TestReader, open_test
from rigapp.storage.reading.verify import RAGGED, ROWS_AT_ONCE, damage_of, wrong_rows
from rigapp.storage.structure.digest import SEAL
from rigapp.storage.structure.events import first_broken_link
from rigapp.storage.structure.layout import FILE_NAME_ATTRIBUTE, STATE, FileStream, streams_of
from rigapp.storage.upkeep.duplicate import Ranges, open_copy, write_duplicate
from rigapp.texts import say

SIGNATURE = b"\x89HDF\r\n\x1a\n"
END_OF_FILE = {0: 40, 1: 44, 2: 28, 3: 28}
"""Version of an HDF5 superblock -> offset of the file's length in it, 8 bytes."""
MIN_ROWS = 16
"""Rows that are discarded together where one of them cannot be read."""

Rows = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Salvaged:
    """Result of salvaging a file: rows by stream, and differences in the new file.

    lost: committed rows without a valid checksum. missing: paths of datasets that cannot be read.
    damage: sentences about differences in the new file, its settings above all.
    """

    kept: dict[str, int]
    lost: dict[str, int]
    missing: tuple[str, ...]
    damage: tuple[str, ...]


def salvage_test(path: str | os.PathLike[str], to: str | os.PathLike[str]) -> Salvaged:
    """Write every row and cycle confirmed by a checksum into a new, compressed file.

    Raises UnusableInput where the target exists, nothing can be confirmed, or a file of an older
    version has no checksums. The source is not changed.
    """
    source, target = Path(path).absolute(), Path(to).absolute()
    if os.path.lexists(target):
        raise UnusableInput("{}: the file exists and is not overwritten; give another name", target)
    if not target.parent.is_dir():
        raise UnusableInput(
            "{}: the folder {} does not exist; create it first", target, target.parent
        )
    if not source.is_file():
        raise UnusableInput("{}: there is no such file", source)
    refuse_little_space(target.parent, target, 2 * source.stat().st_size, say("the salvaged copy"))
    full, new = hidden_name(target, "packed"), hidden_name(target)
    with contextlib.ExitStack() as undo:
        undo.callback(lambda: full.unlink(missing_ok=True))
        undo.callback(lambda: new.unlink(missing_ok=True))
        _copy_at_full_length(source, full)
        try:
            reader = undo.enter_context(open_test(full))
        except UnusableInput as error:
            raise UnusableInput(
                "{}: its structure is damaged and no data can be found ‹{}›; take another copy",
                source,
                error,
            ) from error
        if not (reader.plan.checksums or reader.compressed):
            raise UnusableInput(
                (
                    "{}: this file is of an older version without check values of its rows; take"
                    " another copy"
                ),
                source,
            )
        streams = streams_of(reader.plan)
        chosen = {name: _sound_rows(reader, s) for name, s in streams.items() if s.counter}
        if not chosen["revolutions"].size:
            raise UnusableInput(
                "{}: no revolution in it is as it was written; take another copy", source
            )
        committed = {name: _committed(reader, name) for name in chosen}
        sizes, first = _sizes(reader, streams, chosen)
        missing: list[str] = []
        write_duplicate(full, new, sizes, missing.append)
        _describe(new, target, source, streams, chosen, first)
        damage = damage_of(new)
        new.chmod(0o444)
        move_into_place(new, target)
    return Salvaged(
        {name: int(rows.size) for name, rows in chosen.items()},
        {name: int(np.sum(~np.isin(np.arange(committed[name]), chosen[name]))) for name in chosen},
        tuple(missing),
        tuple(damage),
    )


def _copy_at_full_length(source: Path, full: Path) -> None:
    """Copy a file with its holes, extended to the length in its header; raises UnusableInput."""
    try:
        with source.open("rb") as old, full.open("xb+") as new:
            head = old.read(64)
            copy_content(old.fileno(), new.fileno())
            offset = END_OF_FILE.get(head[8]) if head.startswith(SIGNATURE) else None
            if offset is None:
                raise UnusableInput(
                    "{}: its head is damaged or it is not an HDF5 file; take another copy", source
                )
            length = int.from_bytes(head[offset : offset + 8], "little")
            if length > os.fstat(new.fileno()).st_size:
                os.ftruncate(new.fileno(), length)
    except OSError as error:
        raise UnusableInput(
            "{}: the file cannot be copied beside {} ({}); choose another folder",
            source,
            full.parent,
            error.strerror,
        ) from error


def _committed(reader: TestReader, stream: str) -> int:
    """Return the number of committed rows of a stream, limited to its declared rows."""
    with contextlib.suppress(UnusableInput):
        return max(0, min(reader.committed(stream), reader.declared(stream)))
    return 0


def _sound_rows(reader: TestReader, stream: FileStream) -> Rows:
    """Return the confirmed rows of a stream, in order.

    Confirmed, ordered rows of revolutions and cycles after the committed ones are included, since
    the counter itself may be damaged.
    """
    rows = _committed(reader, stream.name)
    if stream.name == "events":
        return np.arange(_sound_log(reader, rows))
    sound = [_sound_of(reader, stream.name, 0, rows)]
    if stream.name in ("revolutions", "cycles") and not reader.compressed:
        capacity = reader.declared(stream.name)
        while rows < capacity:
            stop = min(capacity, rows + ROWS_AT_ONCE)
            more = _sound_of(reader, stream.name, rows, stop)
            unbroken = int(np.sum(more == rows + np.arange(more.size)))
            sound.append(more[:unbroken])
            if unbroken < stop - rows:
                break
            rows = stop
    result = np.concatenate(sound)
    return (
        result[_rising(reader, stream, result)]
        if stream.name in ("revolutions", "cycles")
        else result
    )


def _rising(reader: TestReader, stream: FileStream, rows: Rows) -> NDArray[np.bool_]:
    """Return a mask of the rows with a higher revolution than all before; others are older."""
    if not rows.size:
        return np.zeros(0, bool)
    numbers = reader.stored_rows(stream.path("revolution"), 0, int(rows[-1]) + 1)[rows]
    before = np.maximum.accumulate(np.concatenate(([-1], numbers[:-1])))
    return np.asarray(numbers > before)


def _sound_of(reader: TestReader, stream: str, first: int, stop: int) -> Rows:
    """Return the readable rows of a range that their checksums confirm."""
    if first >= stop:
        return np.empty(0, np.int64)
    try:
        if not reader.has_checksum(stream) and stream not in RAGGED:
            reader.raw_rows(stream, first, stop)
            return np.arange(first, stop)
        wrong = wrong_rows(reader, stream, first, stop)
    except UnusableInput:
        if stop - first <= MIN_ROWS:
            return np.empty(0, np.int64)
        middle = (first + stop) // 2
        halves = (_sound_of(reader, stream, *part) for part in ((first, middle), (middle, stop)))
        return np.concatenate(list(halves))
    return np.setdiff1d(np.arange(first, stop), wrong)


def _sound_log(reader: TestReader, rows: int) -> int:
    """Return the number of first rows of the log confirmed by digests, complete texts only."""
    while rows:
        try:
            columns = {
                field.name: values
                for field, values in zip(
                    reader.fields("events"), reader.raw_rows("events", 0, rows)[0], strict=True
                )
            }
        except UnusableInput:
            rows //= 2
            continue
        broken = first_broken_link(columns, reader.metadata()["identifier"])
        rows = rows if broken is None else broken
        while rows and columns["continued"][rows - 1]:
            rows -= 1
        return rows
    return 0


def _sizes(
    reader: TestReader, streams: Mapping[str, FileStream], chosen: Mapping[str, Rows]
) -> tuple[dict[str, int | Ranges], dict[str, NDArray[np.int64]]]:
    """Return the rows that each dataset keeps, by path, and the new first samples of the cycles."""
    sizes: dict[str, int | Ranges] = {}
    first: dict[str, NDArray[np.int64]] = {}
    for name, stream in streams.items():
        if not stream.counter:
            continue
        for field in stream.stored:
            sizes[stream.path(field.name)] = _ranges(chosen[name])
        sizes[stream.path(stream.dimension)] = _ranges(chosen[name])
        if name in RAGGED:
            samples = streams[RAGGED[name]]
            begin, count = (
                reader.stored_rows(stream.path(column), 0, int(rows[-1]) + 1)[rows]
                if (rows := chosen[name]).size
                else np.empty(0, np.int64)
                for column in ("first", "count")
            )
            first[name] = np.cumsum(count) - count
            parts = [(int(a), int(a + n)) for a, n in zip(begin, count, strict=True)]
            for path in (*(field.name for field in samples.stored), samples.dimension):
                sizes[samples.path(path)] = parts
    return sizes, first


def _ranges(rows: Rows) -> Ranges:
    """Return rows as ranges without gaps."""
    if not rows.size:
        return []
    breaks = np.flatnonzero(np.diff(rows) != 1) + 1
    return [(int(part[0]), int(part[-1]) + 1) for part in np.split(rows, breaks)]


def _describe(
    new: Path,
    target: Path,
    source: Path,
    streams: Mapping[str, FileStream],
    chosen: Mapping[str, Rows],
    first: Mapping[str, NDArray[np.int64]],
) -> None:
    """Write the counts of the new file, and the name of its source."""
    with open_copy(new) as file:
        file.attrs[FILE_NAME_ATTRIBUTE] = target.name
        if SEAL in file:
            del file[SEAL]
        for name, rows in chosen.items():
            file[streams[name].path(streams[name].counter)][()] = rows.size
        for name, values in first.items():
            if values.size:
                file[streams[name].path("first")][:] = values
        status = file[f"{STATE}/status"]
        if status[()] not in (b"complete", b"stopped", b"fault"):
            status[()] = b"stopped"
            file[f"{STATE}/reason_code"][()] = b"storage"
        file[f"{STATE}/reason"][()] = say(
            "salvaged from {}: what is as it was written", source.name
        ).encode()[:512]
