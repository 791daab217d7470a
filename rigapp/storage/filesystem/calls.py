"""What a test file asks of the system beyond open and close."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

from rigapp.texts import SentenceError

Bytes = bytes | bytearray | memoryview

BINARY: int = getattr(os, "O_BINARY", 0)
"""A flag of Windows: without it bytes are changed on their way to a file."""


class FileSystem(Protocol):
    """Do to an open file what a test file needs; what fails raises OSError.

    Offsets and lengths are in bytes. Any thread may call.
    """

    def write_at(self, fd: int, parts: Sequence[Bytes], offset: int) -> int:
        """Write parts one after the other from an offset on; return how many bytes went."""

    def read_at(self, fd: int, length: int, offset: int) -> bytes:
        """Return the bytes at an offset, fewer at the end of the file."""

    def sync(self, fd: int) -> None:
        """Return when the bytes written before are on the disk."""

    def reserve(self, fd: int, offset: int, length: int) -> None:
        """Reserve disk space for a range; what stands there stays."""

    def give_back(self, fd: int, offset: int, length: int) -> bool:
        """Let a range read as zeros and take no space; False where nothing was done."""

    def forget(self, fd: int, offset: int, length: int) -> None:
        """Let go of synced pages in memory, where the system can be told."""

    def taken_bytes(self, fd: int) -> int:
        """Return the disk space that a file takes."""

    def data_ranges(self, fd: int, size: int) -> Iterator[tuple[int, int]]:
        """Yield start and end of what a file has data in; all of it where nobody can tell."""

    def link(self, fd: int, path: Path) -> None:
        """Give an open file that has a name another one."""

    def protect(self, fd: int) -> None:
        """Make a file read-only for everybody, where the file system knows modes."""

    def settle(self, fd: int, hidden: Path, path: Path) -> None:
        """Give an open file its name, never over an existing one; its descriptor stays."""

    def exchange(self, fd: int, ready: Path, path: Path) -> None:
        """Put a closed file into the place of an open one; its descriptor is of no more use."""

    def sync_folder(self, folder: Path) -> None:
        """Return when the folder's names are on the disk."""

    def hold(self, fd: int) -> bool:
        """Mark an open file as being written by this process; False when another one does."""

    def release(self, fd: int) -> None:
        """Take the mark away; it goes with the process, and is to go before the file is closed."""

    def is_held(self, path: Path, named: str) -> bool:
        """Tell whether a process is writing a file; named: the writer as the file names it."""

    def is_taken(self, path: Path, named: str) -> bool:
        """Tell of a file that this process holds whether another one is writing it all the same."""


class StorageFailed(SentenceError):
    """Say in one sentence which file can no longer be written, and why; the test must end."""


class DiskFull(StorageFailed):
    """Say in one sentence which part of the file is full."""
