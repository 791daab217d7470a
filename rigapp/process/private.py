"""Create and check folders and files that only their owner can access."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from rigapp.config.errors import UnusableInput

SMALL_BYTES = 1 << 16


def owned_by_user(status: os.stat_result) -> bool:
    """Return whether a file or folder belongs to this user; True on systems without owners."""
    return not hasattr(os, "getuid") or status.st_uid == os.getuid()


def open_to_others(status: os.stat_result) -> bool:
    """Return whether another user may read or write a file; False on systems without modes."""
    return hasattr(os, "getuid") and bool(status.st_mode & 0o077)


def private_folder(folder: Path, instead: str = "") -> Path:
    """Return a folder of mode 0700 owned by this user and no link; create it if missing.

    A folder that others can only read is closed to them. One that others can write is refused, as
    its content may be theirs. instead: another remedy for the error text. Raises UnusableInput.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        status = folder.lstat()
        if not stat.S_ISDIR(status.st_mode):
            raise UnusableInput("{}: is a link, not a folder{}.", folder, instead)
        if not hasattr(os, "getuid"):
            return folder
        if not owned_by_user(status):
            raise UnusableInput("{}: belongs to another user{}.", folder, instead)
        if status.st_mode & 0o022:
            raise UnusableInput(
                "{}: others can write into it; look at what is in it, then chmod 700 it{}.",
                folder,
                instead,
            )
        if stat.S_IMODE(status.st_mode) != 0o700:
            folder.chmod(0o700)
    except OSError as error:
        raise UnusableInput("{}: cannot be made ‹{}›{}.", folder, error, instead) from error
    return folder


def read_own(path: Path) -> bytes | None:
    """Return a small regular file of this user; None if missing, a link or any other file."""
    try:
        descriptor = os.open(
            path, os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
        )
    except OSError:
        return None
    try:
        status = os.fstat(descriptor)
        if not (
            stat.S_ISREG(status.st_mode) and status.st_size <= SMALL_BYTES and owned_by_user(status)
        ):
            return None
        return os.read(descriptor, SMALL_BYTES)
    except OSError:
        return None
    finally:
        os.close(descriptor)


def read_secret(path: Path) -> bytes:
    """Return a file of this user that no other user can read; raise UnusableInput."""
    text = read_own(path)
    if text is None:
        raise UnusableInput("{}: is no small file of yours; a link is not followed.", path)
    if open_to_others(path.lstat()):
        raise UnusableInput("{}: others can read this secret; chmod 600 it.", path)
    return text
