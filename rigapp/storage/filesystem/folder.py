"""The folder of a test file: free space, a hidden name until the file is complete, then its own."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.process.stale_files import find_stale, remove_left_behind
from rigapp.texts import say, sentence_of_error

SPACE_MARGIN = 32 << 20
"""Bytes that stay free beside a file, for the log, the report and other programs."""
MEGABYTE = 1e6


def refuse_little_space(
    folder: Path, path: Path, needed: int, subject: str = say("the test")
) -> None:
    """Raise UnusableInput when a folder's disk has less than ``needed`` bytes and a margin free."""
    free = shutil.disk_usage(folder).free
    missing = needed + SPACE_MARGIN - free
    if missing > 0:
        raise UnusableInput(
            (
                "{}: {} needs {:.0f} MB, {} has {:.0f} MB free; {:.1f} MB are missing. Free"
                " space or store fewer cycles"
            ),
            path,
            subject,
            (needed + SPACE_MARGIN) / MEGABYTE,
            folder,
            free / MEGABYTE,
            missing / MEGABYTE,
        )


def hidden_name(path: Path, what: str = "new") -> Path:
    """Return the hidden name of an incomplete file, by which ``remove_stale`` finds it.

    what: at most 6 letters, see ``LONGEST_NAME_BYTES``.
    """
    return path.parent / f".{path.name}.{what}-{os.getpid()}"


def move_into_place(hidden: Path, path: Path) -> None:
    """Rename the file to ``path``, never over an existing one."""
    try:
        os.link(hidden, path)
    except FileExistsError:
        raise
    except OSError:
        if os.path.lexists(path):
            raise FileExistsError(errno.EEXIST, say("file exists"), str(path)) from None
        os.rename(hidden, path)
    else:
        hidden.unlink()


def remove_stale(folder: Path) -> None:
    """Remove files left by killed processes in a folder of results; protect those they had open."""
    for mark, match in find_stale(folder, r"\.(?P<name>.+)\.opened-(?P<pid>\d+)"):
        left = folder / match["name"]
        with contextlib.suppress(OSError):
            if not left.is_symlink():
                left.chmod(0o444)
            mark.unlink()
    remove_left_behind(folder, r"\..+\.(?:new|packed)-(?P<pid>\d+)")


def short_reason(error: Exception) -> str:
    """Return the operating system's message from HDF5's long one, or its first line."""
    text = sentence_of_error(error)
    _, result, rest = text.partition("error message = '")
    return rest.partition("'")[0] if result else text.partition("\n")[0]
