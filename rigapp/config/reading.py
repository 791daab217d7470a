"""Read a small file at a path of any kind, with limits of size and time."""

from __future__ import annotations

import errno
import os
import select
import stat
import sys
import threading
import time
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.texts import say

LARGEST_BYTES = 16 << 20  # far more than a file written by hand
PATIENCE_S = 5.0  # a hanging network folder answers later or never
MAX_HANGING_READS = 8
"""Maximum number of hanging reads, as of a folder that does not answer; more are refused."""

_PIECE = 1 << 16
_hanging = threading.BoundedSemaphore(MAX_HANGING_READS)


def read_bytes(path: Path, largest: int = LARGEST_BYTES) -> bytes:
    """Return the bytes of a file, or of a pipe that another process writes.

    Raises UnusableInput for other objects, for more than ``largest`` bytes and when they do not
    arrive within PATIENCE_S; OSError as ``open``.
    """
    # In a separate thread, since access to an unreachable folder hangs.
    result: list[bytes | BaseException] = []

    def run() -> None:
        try:
            result.append(_read(path, largest))
        except BaseException as error:
            result.append(error)
        finally:
            _hanging.release()

    if not _hanging.acquire(timeout=PATIENCE_S):
        raise UnusableInput("{}: cannot be read now, {} other files hang.", path, MAX_HANGING_READS)
    thread = threading.Thread(target=run, name="read file", daemon=True)
    thread.start()
    thread.join(2.0 * PATIENCE_S)
    if not result:
        raise UnusableInput(
            "{}: could not be read within {:g} s; is its folder reachable?", path, 2.0 * PATIENCE_S
        )
    if isinstance(result[0], BaseException):
        raise result[0]
    return result[0]


def read_text(path: Path, largest: int = LARGEST_BYTES) -> str:
    """Return the text of a file with newline line ends; raises UnusableInput.

    A byte order mark is removed. An impossible file name raises OSError.
    """
    try:
        text = read_bytes(path, largest).decode("utf-8-sig")
    except FileNotFoundError as error:
        raise UnusableInput("{}: there is no such file; check the name.", path) from error
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno == errno.ENAMETOOLONG:
            raise
        raise UnusableInput("{}: cannot be read as text ‹{}›.", path, error) from error
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _read(path: Path, largest: int) -> bytes:
    """Read without waiting for the other end of a pipe to be opened."""
    descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
    try:
        mode = os.fstat(descriptor).st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(say("{} is a folder", path))
        if not (stat.S_ISREG(mode) or stat.S_ISFIFO(mode)):
            raise UnusableInput("{}: is a device or a socket; name a file.", path)
        return _all_of(path, descriptor, largest, pipe=stat.S_ISFIFO(mode))
    finally:
        os.close(descriptor)


def _all_of(path: Path, descriptor: int, largest: int, *, pipe: bool) -> bytes:
    deadline = time.monotonic() + PATIENCE_S
    data = bytearray()
    while len(data) <= largest:
        left = deadline - time.monotonic()
        if pipe and (left <= 0.0 or not _wait_for_data(descriptor, left)):
            raise UnusableInput(
                "{}: is a pipe without data for {:g} s; name a file.",
                path,
                PATIENCE_S,
            )
        part = os.read(descriptor, _PIECE)
        if not part:
            return bytes(data)
        data += part
    raise UnusableInput(
        "{}: is larger than {:.0f} MB; name another file.", path, largest / 1000000.0
    )


def _wait_for_data(descriptor: int, seconds: float) -> bool:
    """Wait for bytes or the end of a pipe; a pipe without a writer provides neither."""
    if sys.platform == "win32":  # where pipes have no file names
        return True
    watch = select.poll()
    watch.register(descriptor, select.POLLIN)
    return bool(watch.poll(1000.0 * seconds))
