"""The system calls that a test file needs beyond open and close."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

from rigapp.texts import SentenceError

Bytes = bytes | bytearray | memoryview

BINARY: int = getattr(os, "O_BINARY", 0)
"""A flag of Windows: without it line ends are translated on writing."""


class FileSystem(Protocol):
    """The operations on an open file that a test file needs; failures raise OSError.

    Offsets and lengths are in bytes. Any thread may call.
    """

    def write_at(self, fd: int, parts: Sequence[Bytes], offset: int) -> int:
        """Write parts one after the other from an offset; return the number of bytes written."""

    def read_at(self, fd: int, length: int, offset: int) -> bytes:
        """Return the bytes at an offset, fewer at the end of the file."""

    def sync(self, fd: int) -> None:
        """Return when the bytes written before are on the disk."""

    def reserve(self, fd: int, offset: int, length: int) -> None:
        """Reserve disk space for a range; its content stays."""

    def give_back(self, fd: int, offset: int, length: int) -> bool:
        """Deallocate a range, which then reads as zeros; False where nothing was done."""

    def forget(self, fd: int, offset: int, length: int) -> None:
        """Release synced pages in memory, where the system can."""

    def taken_bytes(self, fd: int) -> int:
        """Return the disk space that a file takes."""

    def data_ranges(self, fd: int, size: int) -> Iterator[tuple[int, int]]:
        """Yield start and end of the ranges with data; the whole file where that is unknown."""

    def link(self, fd: int, path: Path) -> None:
        """Add a second name (hard link) to an open file."""

    def protect(self, fd: int) -> None:
        """Make a file read-only for everybody, where the file system supports modes."""

    def settle(self, fd: int, hidden: Path, path: Path) -> None:
        """Rename an open file, never over an existing one; its descriptor stays valid."""

    def exchange(self, fd: int, ready: Path, path: Path) -> None:
        """Replace an open file by a closed one; the descriptor of the open one becomes invalid."""

    def sync_folder(self, folder: Path) -> None:
        """Return when the folder's entries are on the disk."""

    def hold(self, fd: int) -> bool:
        """Mark an open file as being written by this process; False when another one does."""

    def release(self, fd: int) -> None:
        """Remove the mark, before the file is closed; it ends with the process."""

    def is_held(self, path: Path, named: str) -> bool:
        """Return whether a process is writing a file; named: the writer as the file names it."""

    def is_taken(self, path: Path, named: str) -> bool:
        """Return whether another process is writing a file that this one holds."""


class StorageFailed(SentenceError):
    """Raised when a file can no longer be written, with its path and the reason; ends the test."""


class DiskFull(StorageFailed):
    """Raised when a part of the file, named in the sentence, is full."""
