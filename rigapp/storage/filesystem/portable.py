"""Files through the functions that every system has: no holes, no locks of the kernel.

Reserving a range only extends the file, which allocates the space on NTFS. The writer of a file is
the process that it names, if that is running and began before the file's last change.
"""

from __future__ import annotations

import errno
import os
import re
import socket
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

from rigapp.storage.filesystem.calls import BINARY, Bytes
from rigapp.texts import say

_NAMED = re.compile(r"process (\d+) on (.+)")
_CLOCK_S = 2.0  # resolution of file times on some file systems


class PortableFiles:
    """See ``FileSystem``."""

    def __init__(self) -> None:
        # All threads share the one position of a descriptor.
        self._placing = threading.Lock()
        self._held: set[tuple[int, int]] = set()

    def write_at(self, fd: int, parts: Sequence[Bytes], offset: int) -> int:
        """Seek and write; no other thread moves the position meanwhile."""
        data = parts[0] if len(parts) == 1 else b"".join(parts)
        with self._placing:
            os.lseek(fd, offset, os.SEEK_SET)
            return os.write(fd, data)

    def read_at(self, fd: int, length: int, offset: int) -> bytes:
        """Seek, read and seek back, since HDF5 relies on the position."""
        parts = []
        with self._placing:
            before = os.lseek(fd, 0, os.SEEK_CUR)
            os.lseek(fd, offset, os.SEEK_SET)
            while length > 0 and (part := os.read(fd, length)):
                parts.append(part)
                length -= len(part)
            os.lseek(fd, before, os.SEEK_SET)
        return b"".join(parts)

    def sync(self, fd: int) -> None:
        """Sync data and attributes of the file."""
        os.fsync(fd)

    def reserve(self, fd: int, offset: int, length: int) -> None:
        """Extend the file to the end of the range."""
        if os.fstat(fd).st_size < offset + length:
            os.ftruncate(fd, offset + length)

    def give_back(self, fd: int, offset: int, length: int) -> bool:
        """Do nothing: the space stays allocated."""
        return False

    def forget(self, fd: int, offset: int, length: int) -> None:
        """Do nothing."""

    def taken_bytes(self, fd: int) -> int:
        """Return the file's length."""
        return os.fstat(fd).st_size

    def data_ranges(self, fd: int, size: int) -> Iterator[tuple[int, int]]:
        """Yield the whole file."""
        if size:
            yield 0, size

    def link(self, fd: int, path: Path) -> None:
        """Raise OSError: an open file cannot be linked."""
        raise OSError(errno.ENOTSUP, say("an open file can get no second name here"), str(path))

    def protect(self, fd: int) -> None:
        """Do nothing."""

    def settle(self, fd: int, hidden: Path, path: Path) -> None:
        """Close the file temporarily, since some systems cannot move an open file."""
        if os.path.lexists(path):
            raise FileExistsError(errno.EEXIST, say("file exists"), str(path))
        _close_for_now(fd)
        os.rename(hidden, path)
        again = os.open(path, os.O_RDWR | BINARY)
        try:
            os.dup2(again, fd, inheritable=False)
        finally:
            os.close(again)

    def exchange(self, fd: int, ready: Path, path: Path) -> None:
        """Close the old file first, since some systems cannot replace an open file."""
        self.release(fd)
        _close_for_now(fd)
        os.replace(ready, path)

    def sync_folder(self, folder: Path) -> None:
        """Do nothing: the system orders names by itself."""

    def hold(self, fd: int) -> bool:
        """Record that this process writes the file; ``is_taken`` finds others."""
        key = _key(os.fstat(fd))
        if key in self._held:
            return False
        self._held.add(key)
        return True

    def release(self, fd: int) -> None:
        """Remove the record."""
        self._held.discard(_key(os.fstat(fd)))

    def is_held(self, path: Path, named: str) -> bool:
        """Return whether this process writes it, or the named one is running and old enough."""
        return _key(path.stat()) in self._held or self.is_taken(path, named)

    def is_taken(self, path: Path, named: str) -> bool:
        """Return whether the named process is another one that is running and old enough."""
        match = _NAMED.fullmatch(named)
        if match is None or match[2] != socket.gethostname() or int(match[1]) == os.getpid():
            return False
        import psutil

        try:
            process = psutil.Process(int(match[1]))
            ended = process.status() == psutil.STATUS_ZOMBIE
            return not ended and process.create_time() <= path.stat().st_mtime + _CLOCK_S
        except psutil.NoSuchProcess:
            return False
        except psutil.AccessDenied:
            return True


def _close_for_now(fd: int) -> None:
    """Close a file but keep its descriptor number occupied."""
    with open(os.devnull, "r+b", buffering=0) as aside:
        os.dup2(aside.fileno(), fd, inheritable=False)


def _key(status: os.stat_result) -> tuple[int, int]:
    return status.st_dev, status.st_ino
