"""File names: validity, temporary files included; names of new results."""

from __future__ import annotations

import os
import time
from getpass import getuser
from pathlib import Path

from rigapp.texts import say

LONGEST_NAME_BYTES = 239
"""Maximum length of a file name: 255 bytes on most systems, less 16 of temporary names."""

LONGEST_PATH_BYTES = 4000
"""Maximum length of a path: systems allow 4,096 bytes, temporary names included."""


def name_refusal(path: Path) -> str:
    """Return why a file of that name cannot be created, without a full stop; empty if it can."""
    if path.name in ("", ".."):
        return say("{} names no file; give the name of a file", repr(str(path)))
    control = next((character for character in path.name if not character.isprintable()), "")
    if control:
        return say(
            "the file name {} holds the character {}; take it out", repr(path.name), repr(control)
        )
    length = len(os.fsencode(path.absolute()))
    if length > LONGEST_PATH_BYTES:
        return say(
            "the path that ends with {} has {} bytes, {} at most; choose a folder"
            " nearer to the root",
            path.name[-40:],
            length,
            LONGEST_PATH_BYTES,
        )
    length = len(os.fsencode(path.name))
    if length > LONGEST_NAME_BYTES:
        start = path.name[:40]
        return say(
            "the file name {}... has {} bytes, {} at most; shorten it",
            start,
            length,
            LONGEST_NAME_BYTES,
        )
    return ""


def new_result(folder: Path, name: str) -> Path:
    """Return the path of a new test file: name, time and ``.h5``."""
    stamp = time.strftime("%Y%m%d-%H%M%S")
    path, more = folder / f"{name}-{stamp}.h5", 1
    while path.exists():
        more += 1
        path = folder / f"{name}-{stamp}-{more}.h5"
    return path


def login_name() -> str:
    """Return the name of the account, empty if the system has none."""
    try:
        return getuser()
    except (KeyError, OSError, ImportError):  # an account without an entry; Python 3.11 on Windows
        return ""
