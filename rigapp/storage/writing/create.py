"""Create the complete file of a test before its first sample: structure, space, offsets, name."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import groupby
from operator import itemgetter
from pathlib import Path
from typing import BinaryIO

import h5py
import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.names import name_refusal
from rigapp.storage.filesystem.calls import BINARY, StorageFailed
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.folder import (
    MEGABYTE,
    hidden_name,
    refuse_little_space,
    remove_stale,
    short_reason,
)
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.structure.build import build_file
from rigapp.storage.structure.hdf import open_for_reading
from rigapp.storage.structure.layout import (
    FilePlan,
    FileStream,
    declared_bytes,
    reserved_bytes,
    streams_of,
)
from rigapp.storage.structure.metadata import TestMetadata
from rigapp.texts import sentence_of_error

Places = dict[str, tuple[int, int]]
"""Path of a dataset -> offset and length in bytes."""

STRUCTURE_BYTES = 1 << 20  # groups, attributes, settings and records; typically 0.3 MB


def refuse_bad_target(path: Path, plan: FilePlan) -> None:
    """Raise UnusableInput for an existing file, a missing or read-only folder, or a full disk."""
    folder = path.parent
    wrong = name_refusal(path)
    if wrong:
        raise UnusableInput("{}: {}", folder, wrong)
    if os.path.lexists(path):
        raise UnusableInput(
            (
                "{}: the file exists and is not overwritten; give another name, or use resume to"
                " continue it"
            ),
            path,
        )
    if not folder.is_dir():
        raise UnusableInput("{}: the folder {} does not exist; create it first", path, folder)
    if not os.access(folder, os.W_OK | os.X_OK):
        raise UnusableInput(
            "{}: the folder {} cannot be written to; choose another one", path, folder
        )
    streams = streams_of(plan).values()
    refuse_little_space(folder, path, reserved_bytes(streams) + STRUCTURE_BYTES)
    limit = _largest_file()
    length = declared_bytes(streams) + STRUCTURE_BYTES
    if limit is not None and length > limit:
        raise UnusableInput(
            (
                "{}: the test needs a file of {:.0f} MB, but this system allows files of {:.0f}"
                " MB; {:.1f} MB are missing. Store fewer cycles or raise the limit (ulimit -f)"
            ),
            path,
            length / MEGABYTE,
            limit / MEGABYTE,
            (length - limit) / MEGABYTE,
        )


def _largest_file() -> int | None:
    """Return the system's limit on the size of a file in bytes, None without a limit."""
    if sys.platform == "win32":
        return None
    try:
        import resource
    except ImportError:  # not a POSIX system
        return None
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)[0]
    return None if limit == resource.RLIM_INFINITY else limit


def create_file(path: Path, plan: FilePlan, metadata: TestMetadata) -> tuple[Disk, Places]:
    """Create the file under a hidden name, reserve and check it, and move it into place.

    Return the open, locked file and the offsets of its datasets. Raises UnusableInput and then
    leaves no file.
    """
    refuse_bad_target(path, plan)
    remove_stale(path.parent)
    hidden = hidden_name(path)
    fd = -1
    with contextlib.ExitStack() as undo:
        undo.callback(lambda: hidden.unlink(missing_ok=True))
        with _space_errors(path):
            build_file(hidden, plan, metadata, path.name)
            fd = os.open(hidden, os.O_RDWR | BINARY)
            undo.callback(os.close, fd)
            places = places_of(hidden)
            disk = Disk(fd, path)
            for stream in streams_of(plan).values():
                reserve_stream(disk, stream, places, 0, stream.planned)
            check_places(disk, hidden, streams_of(plan), places)
            FILES.protect(fd)
            os.fsync(fd)
            if not FILES.hold(fd):
                raise UnusableInput("{}: another process took the new file; try again", path)
            undo.callback(FILES.release, fd)
            FILES.settle(fd, hidden, path)
            FILES.sync_folder(path.parent)
        undo.pop_all()
    disk.bytes_written = 0
    return disk, places


def places_of(path: Path) -> Places:
    """Return the offsets of the in-place datasets of a file, from h5py."""
    places: Places = {}

    def note(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset) and item.chunks is None:
            offset = item.id.get_offset()
            if offset is not None:
                places["/" + name] = (int(offset), int(item.id.get_storage_size()))

    with open_for_reading(path) as file:
        file.visititems(note)
    return places


_EXTENT, _CONTINUED = 0x01, 0x10
"""Header messages of an HDF5 object: length of a dataset; continuation of the header."""


def lengths_of(path: Path, streams: Mapping[str, FileStream]) -> dict[str, tuple[int, ...]]:
    """Return the offsets of the datasets' length fields, for each stream of data.

    A stream whose length fields are not found is omitted: other programs then see all its rows.
    """
    result: dict[str, tuple[int, ...]] = {}
    with open_for_reading(path) as file, path.open("rb") as stream:
        for name, data in streams.items():
            names = dict.fromkeys((*(column.name for column in data.stored), data.dimension))
            offsets = [_length_of(file[data.path(column)], stream) for column in names]
            if name not in ("waiting", "checkpoints") and all(offsets):
                result[name] = tuple(offsets)
    return result


def _length_of(dataset: h5py.Dataset, stream: BinaryIO) -> int:
    """Return the offset of a dataset's length field in its file, 0 where it is not found.

    Header of version 1: 16 bytes, then messages: kind and size in 2 bytes each, 4 more bytes, data.
    """

    def read(start: int, size: int) -> bytes:
        stream.seek(start)
        return stream.read(size)

    def number(data: bytes, offset: int, size: int = 8) -> int:
        return int.from_bytes(data[offset : offset + size], "little")

    address = h5py.h5o.get_info(dataset.id).addr
    head = read(address, 16)
    blocks = [(address + 16, number(head, 8, 4))] if head[:1] == b"\1" else []
    for start, size in blocks:
        block, offset = read(start, size), 0
        while offset + 16 <= len(block):
            kind = number(block, offset, 2)
            if kind == _CONTINUED and len(blocks) < number(head, 2, 2):
                blocks.append((number(block, offset + 8), number(block, offset + 16)))
            if kind == _EXTENT:
                same = block[offset + 8] == 1 and number(block, offset + 16) == len(dataset)
                return start + offset + 16 if same else 0
            offset += 8 + number(block, offset + 2, 2)
    return 0


def fitted_streams(plan: FilePlan, places: Places) -> dict[str, FileStream]:
    """Return the streams of a plan with the actual sizes in the file."""
    result: dict[str, FileStream] = {}
    for name, stream in streams_of(plan).items():
        first = stream.fields[0]
        capacity = places[stream.path(first.name)][1] // first.row_bytes
        planned = min(stream.planned, capacity)
        result[name] = replace(stream, planned=planned, capacity=capacity)
    return result


def reserve_stream(disk: Disk, stream: FileStream, places: Places, first: int, rows: int) -> None:
    """Reserve the disk space of rows ``first`` .. ``rows`` of a stream; raises OSError."""
    for field in stream.stored:
        offset = places[stream.path(field.name)][0]
        disk.reserve(offset + first * field.row_bytes, (rows - first) * field.row_bytes)


def check_places(disk: Disk, file: Path, streams: Mapping[str, FileStream], places: Places) -> None:
    """Write a mark at each offset, read it back through h5py, and clear it.

    Raises StorageFailed when the library's offsets are wrong: then no test may start.
    """
    marks: list[tuple[str, int, int, bytes]] = []
    for stream in streams.values():
        for field in stream.stored:
            path = stream.path(field.name)
            for row in sorted({0, stream.planned - 1}):
                mark = ((b"%08d" % len(marks))[::-1] * (field.row_bytes // 8 + 1))[
                    : field.row_bytes
                ]
                marks.append((path, row, places[path][0] + row * field.row_bytes, mark))
    for _, _, offset, mark in marks:
        disk.write(mark, offset)
    with open_for_reading(file) as opened:
        for path, group in groupby(marks, key=itemgetter(0)):
            dataset = opened[path]  # once: opening costs more than reading
            for _, row, offset, mark in group:
                if np.asarray(dataset[row]).tobytes() != mark:
                    raise StorageFailed(
                        (
                            "{}: {} row {} is not where HDF5 reports it ({}); no test can be"
                            " stored with this HDF5 library, run rigapp doctor"
                        ),
                        disk.path,
                        path,
                        row,
                        offset,
                    )
    for _, _, offset, mark in marks:
        disk.write(bytes(len(mark)), offset)
    for stream in streams.values():
        if stream.counter:
            assert places[stream.path(stream.counter)][0] % 8 == 0


@contextlib.contextmanager
def _space_errors(path: Path) -> Iterator[None]:
    try:
        yield
    except FileExistsError as error:
        raise UnusableInput("{}: the file exists and is not overwritten", path) from error
    except StorageFailed as error:
        raise UnusableInput(sentence_of_error(error)) from error
    except RuntimeError as error:
        raise UnusableInput(
            "{}: HDF5 could not write the file ({}); free some space or choose another folder",
            path,
            short_reason(error),
        ) from error
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise UnusableInput(
                (
                    "{}: the disk refused to reserve space for the test ({}); free some space or"
                    " store fewer cycles"
                ),
                path,
                error.strerror,
            ) from error
        raise UnusableInput(
            "{}: the file cannot be created ({}); choose another folder",
            path,
            error.strerror or error,
        ) from error
