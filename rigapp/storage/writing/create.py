"""Make the file of a test whole before its first sample: structure, space, places, name."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.names import name_refusal
from rigapp.storage.filesystem.calls import BINARY
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.errors import StorageFailed
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

Places = dict[str, tuple[int, int]]
"""Path of a dataset -> offset and length in bytes."""

STRUCTURE_BYTES = 1 << 20  # groups, attributes, settings and records; 0.3 MB as a rule


def refuse_bad_target(path: Path, plan: FilePlan) -> None:
    """Refuse an existing file, a missing or read-only folder, too little space: UnusableInput."""
    folder = path.parent
    wrong = name_refusal(path)
    if wrong:
        raise UnusableInput(f"{folder}: {wrong}")
    if os.path.lexists(path):
        raise UnusableInput(
            f"{path}: the file exists and is not overwritten; give another name, "
            "or use resume to go on with it"
        )
    if not folder.is_dir():
        raise UnusableInput(f"{path}: the folder {folder} does not exist; create it first")
    if not os.access(folder, os.W_OK | os.X_OK):
        raise UnusableInput(f"{path}: the folder {folder} cannot be written to; choose another one")
    streams = streams_of(plan).values()
    refuse_little_space(folder, path, reserved_bytes(streams) + STRUCTURE_BYTES)
    limit = _largest_file()
    length = declared_bytes(streams) + STRUCTURE_BYTES
    if limit is not None and length > limit:
        raise UnusableInput(
            f"{path}: the test needs a file of {length / MEGABYTE:.0f} MB, but this system allows "
            f"files of {limit / MEGABYTE:.0f} MB; {(length - limit) / MEGABYTE:.1f} MB are missing,"
            " keep fewer whole cycles or raise the limit (ulimit -f)"
        )


def _largest_file() -> int | None:
    """Return the bytes that this system allows a file, None for any number."""
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

    Returns the open, locked file and the places of its datasets. Raises UnusableInput; then
    nothing is left behind.
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
                raise UnusableInput(f"{path}: another process took the new file; try again")
            undo.callback(FILES.release, fd)
            FILES.settle(fd, hidden, path)
            FILES.sync_folder(path.parent)
        undo.pop_all()
    disk.bytes_written = 0
    return disk, places


def places_of(path: Path) -> Places:
    """Return where the in-place datasets of a file lie, as h5py reports it."""
    places: Places = {}

    def note(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset) and item.chunks is None:
            offset = item.id.get_offset()
            if offset is not None:
                places["/" + name] = (int(offset), int(item.id.get_storage_size()))

    with open_for_reading(path) as file:
        file.visititems(note)
    return places


def fitted_streams(plan: FilePlan, places: Places) -> dict[str, FileStream]:
    """Return the streams of a plan with the sizes that the file really has."""
    found: dict[str, FileStream] = {}
    for name, stream in streams_of(plan).items():
        first = stream.fields[0]
        capacity = places[stream.path(first.name)][1] // first.row_bytes
        planned = min(stream.planned, capacity)
        found[name] = replace(stream, planned=planned, capacity=capacity)
    return found


def reserve_stream(disk: Disk, stream: FileStream, places: Places, first: int, rows: int) -> None:
    """Reserve the disk space of rows ``first`` .. ``rows`` of a stream; raises OSError."""
    for one in stream.fields:
        offset = places[stream.path(one.name)][0]
        disk.reserve(offset + first * one.row_bytes, (rows - first) * one.row_bytes)


def check_places(disk: Disk, file: Path, streams: Mapping[str, FileStream], places: Places) -> None:
    """Write a mark through each place, read it back through h5py, and clear it again.

    Raises StorageFailed when the library's offsets do not hold: then no test may start.
    """
    marks: list[tuple[str, int, int, bytes]] = []
    for stream in streams.values():
        for one in stream.fields:
            path = stream.path(one.name)
            for row in sorted({0, stream.planned - 1}):
                mark = (b"%08d" % len(marks) * (one.row_bytes // 8 + 1))[: one.row_bytes]
                marks.append((path, row, places[path][0] + row * one.row_bytes, mark))
    for _, _, offset, mark in marks:
        disk.write(mark, offset)
    with open_for_reading(file) as opened:
        for path, row, offset, mark in marks:
            found = np.asarray(opened[path][row])
            if found.tobytes() != mark:
                raise StorageFailed(
                    f"{disk.path}: {path} row {row} is not where HDF5 says ({offset}); "
                    "no test can be stored with this HDF5 library, run rigapp doctor"
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
        raise UnusableInput(f"{path}: the file exists and is not overwritten") from error
    except StorageFailed as error:
        raise UnusableInput(str(error)) from error
    except RuntimeError as error:
        raise UnusableInput(
            f"{path}: HDF5 could not write the file ({short_reason(error)}); "
            "free some space or choose another folder"
        ) from error
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise UnusableInput(
                f"{path}: the disk refused to reserve the room for the test ({error.strerror}); "
                "free some space or keep fewer whole cycles"
            ) from error
        raise UnusableInput(
            f"{path}: the file cannot be created ({error.strerror or error}); choose another folder"
        ) from error
