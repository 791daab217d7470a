"""The only writer of a running test's file: write bytes at offsets and sync them."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterable, Sequence
from pathlib import Path

from rigapp.storage.filesystem.calls import Bytes, StorageFailed
from rigapp.storage.filesystem.system import FILES
from rigapp.texts import say

PAGE = 1 << 16
"""Granularity of the record of writes while the file is being copied, bytes."""


class Disk:
    """Write one open file in place.

    After one failed write or sync the file counts as broken for good: the kernel may have dropped
    the pages, and a later success would prove nothing.
    """

    __slots__ = ("_failure", "_touched", "_writing", "bytes_written", "fd", "path")

    def __init__(self, fd: int, path: Path) -> None:
        self._writing = threading.Lock()
        self._touched: set[int] | None = None
        self.fd = fd
        self.path = path
        self.bytes_written = 0
        self._failure = ""

    def write(self, data: Bytes, offset: int) -> None:
        """Write all of ``data`` at ``offset``; raises StorageFailed."""
        self.write_parts((data,), offset)

    def write_parts(self, parts: Sequence[Bytes], offset: int) -> None:
        """Write all parts, one after the other, from ``offset`` on; raises StorageFailed."""
        self.refuse_broken()
        size = sum(map(len, parts))
        with self._writing:
            try:
                done = FILES.write_at(self.fd, parts, offset)
                while done < size:
                    rest = memoryview(b"".join(parts))[done:]
                    done += FILES.write_at(self.fd, (rest,), offset + done)
            except OSError as error:
                raise self._failed(say("writing"), error) from error
            if self._touched is not None:
                self._touched.update(range(offset // PAGE, (offset + size) // PAGE + 1))
            self.bytes_written += size

    def sync(self) -> None:
        """Return when all bytes written before are on the disk; raises StorageFailed."""
        self.refuse_broken()
        try:
            FILES.sync(self.fd)
        except OSError as error:
            raise self._failed("syncing", error) from error

    def refuse_broken(self) -> None:
        """Raise StorageFailed again after a failure."""
        if self._failure:
            raise StorageFailed(self._failure)

    def reserve(self, offset: int, length: int) -> None:
        """Reserve disk space for a range; raises OSError (ENOSPC, EDQUOT, EFBIG)."""
        if length > 0:
            FILES.reserve(self.fd, offset, length)

    def give_back(self, offset: int, length: int) -> None:
        """Deallocate the disk space of a range; it then reads as zeros, the file's length stays.

        A file system that cannot do so keeps the space. Raises StorageFailed after a failure.
        """
        self.refuse_broken()
        if length > 0:
            with self._writing:
                FILES.give_back(self.fd, offset, length)

    def forget(self, offset: int, length: int) -> None:
        """Release synced pages in memory, so that a long test keeps no more than it needs."""
        FILES.forget(self.fd, offset, length)

    def begin_copy(self) -> None:
        """Start to record the written ranges: the file is being copied."""
        with self._writing:
            self._touched = set()

    def follow_copy(self, fd: int) -> None:
        """Copy the ranges written since ``begin_copy``, or since the last call."""
        with self._writing:
            touched, self._touched = self._touched or set(), set()
        copy_ranges(self.fd, fd, ((page * PAGE, PAGE) for page in sorted(touched)))

    def switch_to(self, fd: int) -> None:
        """Write to the copy from now on and close the old file; raises OSError before that."""
        with self._writing:
            touched = self._touched or set()
            copy_ranges(self.fd, fd, ((page * PAGE, PAGE) for page in sorted(touched)))
            FILES.release(self.fd)
            os.dup2(fd, self.fd, inheritable=False)

    def end_copy(self) -> None:
        """Stop recording the written ranges."""
        with self._writing:
            self._touched = None

    def close(self) -> None:
        """Close the file; writing to it afterwards raises StorageFailed."""
        FILES.release(self.fd)
        os.close(self.fd)
        self._failure = self._failure or say("{}: the file is closed", self.path)

    def _failed(self, doing: str, error: OSError) -> StorageFailed:
        self._failure = say(
            "{}: {} failed ({}); data committed before are safe. Check the disk before resuming",
            self.path,
            doing,
            error.strerror,
        )
        return StorageFailed(self._failure)


def copy_ranges(source: int, target: int, ranges: Iterable[tuple[int, int]]) -> None:
    """Copy ranges (offset, length) of an open file to the same places of another."""
    for offset, length in ranges:
        data = FILES.read_at(source, length, offset)
        done = 0
        while done < len(data):
            done += FILES.write_at(target, (memoryview(data)[done:],), offset + done)
