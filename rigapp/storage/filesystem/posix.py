"""Files on Linux and macOS: positioned writes, reserved space, holes, locks of the kernel.

A writer holds two locks. A byte-range lock of the open file description, far beyond the data, marks
the file as being written and keeps a second writer out. A shared ``flock`` makes HDF5 refuse
to open the file for writing (it needs an exclusive one), while readers (shared) pass. The kernel
releases both when the writer ends. Where the file system has no locks, or a process with read
access holds one, the process that the file names is checked instead, as in ``portable``.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import fcntl
import os
import struct
import sys
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from rigapp.storage.filesystem.calls import Bytes
from rigapp.storage.filesystem.folder import move_into_place
from rigapp.storage.filesystem.portable import PortableFiles

KEEP_SIZE = 1
PUNCH_HOLE = 2
"""Flags of Linux's fallocate(2)."""


def punch_hole(fd: int, offset: int, length: int) -> bool:
    """Deallocate a range of an open file, which then reads as zeros; False if nothing was done."""
    call = _fallocate()
    return call is not None and call(fd, KEEP_SIZE | PUNCH_HOLE, offset, length) == 0


@cache
def _fallocate() -> Any:
    if sys.platform != "linux":
        return None
    library = ctypes.CDLL(None)
    call = getattr(library, "fallocate64", None) or getattr(library, "fallocate", None)
    if call is not None:
        call.argtypes = (ctypes.c_int, ctypes.c_int, ctypes.c_int64, ctypes.c_int64)
    return call


assert sys.platform != "win32"

LOCK_OFFSET = 1 << 62  # beyond any data
BLOCK = 512  # bytes of the unit in which the system counts a file's space
_FLOCK = "hhqqi0q"
_MOST_PARTS = 1024
"""Maximum number of buffers in one call on Linux and macOS (IOV_MAX)."""
_OFD = sys.platform == "linux" and hasattr(fcntl, "F_OFD_SETLK")
_ENOTSUPP = 524  # internal to Linux, but NFS and FUSE return it
_NO_LOCKS = (errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL, errno.ENOSYS, _ENOTSUPP)
_NO_ROOM_CALL = (errno.EOPNOTSUPP, errno.ENOSYS, errno.EINVAL)


class PosixFiles:
    """See ``FileSystem``."""

    def __init__(self) -> None:
        self._by_name = PortableFiles()

    def write_at(self, fd: int, parts: Sequence[Bytes], offset: int) -> int:
        """Write without moving the file's position."""
        if len(parts) == 1:
            return os.pwrite(fd, parts[0], offset)
        return os.pwritev(fd, parts[:_MOST_PARTS], offset)

    def read_at(self, fd: int, length: int, offset: int) -> bytes:
        """Read without moving the file's position."""
        return os.pread(fd, length, offset)

    def sync(self, fd: int) -> None:
        """Sync the data; on macOS flush the disk's own cache too."""
        if sys.platform == "darwin":
            fcntl.fcntl(fd, fcntl.F_FULLFSYNC)
        else:
            os.fdatasync(fd)

    def reserve(self, fd: int, offset: int, length: int) -> None:
        """Allocate blocks where the file system can, else extend the file."""
        if sys.platform == "darwin":
            if os.fstat(fd).st_size < offset + length:
                os.ftruncate(fd, offset + length)
            return
        try:
            os.posix_fallocate(fd, offset, length)
        except OSError as error:
            if error.errno not in _NO_ROOM_CALL:
                raise

    def give_back(self, fd: int, offset: int, length: int) -> bool:
        """Punch a hole."""
        return punch_hole(fd, offset, length)

    def forget(self, fd: int, offset: int, length: int) -> None:
        """Advise the kernel to drop the pages."""
        if sys.platform == "linux":
            with contextlib.suppress(OSError):
                os.posix_fadvise(fd, offset, length, os.POSIX_FADV_DONTNEED)

    def taken_bytes(self, fd: int) -> int:
        """Return the bytes of the allocated blocks; holes have none."""
        return os.fstat(fd).st_blocks * BLOCK

    def data_ranges(self, fd: int, size: int) -> Iterator[tuple[int, int]]:
        """Query the file system for data and holes."""
        stop = 0
        while stop < size:
            try:
                start = os.lseek(fd, stop, os.SEEK_DATA)
                stop = os.lseek(fd, start, os.SEEK_HOLE)
            except OSError:
                if stop == 0 and os.fstat(fd).st_blocks:
                    yield 0, size
                return
            yield start, stop

    def link(self, fd: int, path: Path) -> None:
        """Link through the kernel's entry for the open file in /proc (Linux)."""
        folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY)
        try:
            # Python lets the kernel follow the link in /proc only with a folder's descriptor.
            os.link(f"/proc/self/fd/{fd}", path.name, src_dir_fd=folder, dst_dir_fd=folder)
            os.fsync(folder)
        finally:
            os.close(folder)

    def protect(self, fd: int) -> None:
        """Remove all write permissions."""
        with contextlib.suppress(OSError):
            os.fchmod(fd, 0o444)

    def settle(self, fd: int, hidden: Path, path: Path) -> None:
        """Move the file while it is open."""
        move_into_place(hidden, path)

    def exchange(self, fd: int, ready: Path, path: Path) -> None:
        """Replace the old file by name; processes that have it open keep it."""
        os.replace(ready, path)

    def sync_folder(self, folder: Path) -> None:
        """Sync the folder itself, where that is possible."""
        fd = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        try:
            os.fsync(fd)
        except OSError as error:
            if error.errno != errno.EINVAL:
                raise
        finally:
            os.close(fd)

    def hold(self, fd: int) -> bool:
        """Acquire both locks; without locks, rely on the process named in the file."""
        try:
            if _OFD:
                fcntl.fcntl(fd, fcntl.F_OFD_SETLK, _record(fcntl.F_WRLCK))
            else:
                fcntl.lockf(fd, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, LOCK_OFFSET)
        except OSError as error:
            blocked = error.errno in (errno.EAGAIN, errno.EACCES)
            if blocked and _lock_of(fd) == fcntl.F_WRLCK:
                return False
            if not blocked and error.errno not in _NO_LOCKS:
                raise
            if not self._by_name.hold(fd):
                return False
        with contextlib.suppress(OSError):
            fcntl.flock(fd, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return True

    def release(self, fd: int) -> None:
        """Do nothing: the kernel releases the locks when the file is closed."""
        self._by_name.release(fd)

    def is_held(self, path: Path, named: str) -> bool:
        """Test the first lock; where there are no locks, check the named process."""
        fd = os.open(path, os.O_RDONLY)
        try:
            kind = _lock_of(fd)
        finally:
            os.close(fd)
        if kind in (fcntl.F_WRLCK, fcntl.F_UNLCK):
            return kind == fcntl.F_WRLCK
        return self._by_name.is_held(path, named)

    def is_taken(self, path: Path, named: str) -> bool:
        """Rely on the locks where there are any."""
        fd = os.open(path, os.O_RDONLY)
        try:
            kind = _lock_of(fd)
        finally:
            os.close(fd)
        known = kind in (fcntl.F_WRLCK, fcntl.F_UNLCK)
        return not known and self._by_name.is_taken(path, named)


def _lock_of(fd: int) -> int | None:
    """Return the kind of a conflicting lock on an open file, None where locks are unsupported."""
    try:
        if _OFD:
            answer = fcntl.fcntl(fd, fcntl.F_OFD_GETLK, _record(fcntl.F_WRLCK))
            return int(struct.unpack(_FLOCK, answer)[0])
        try:
            fcntl.lockf(fd, fcntl.LOCK_SH | fcntl.LOCK_NB, 1, LOCK_OFFSET)
        except OSError as error:
            if error.errno in (errno.EAGAIN, errno.EACCES):
                return fcntl.F_WRLCK
            raise
        return fcntl.F_UNLCK
    except OSError as error:
        if error.errno in _NO_LOCKS:
            return None
        raise


def _record(kind: int) -> bytes:
    return struct.pack(_FLOCK, kind, os.SEEK_SET, LOCK_OFFSET, 1, 0)
