"""Write a file atomically: readers get the previous or the new one, never a part."""

from __future__ import annotations

import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from rigapp.config.errors import UnusableInput

_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


def part_name(name: str) -> str:
    """Return a hidden, unpredictable name for a file while it is written."""
    return f".{name}.part-{os.getpid()}-{secrets.token_hex(4)}"


def place_of(target: Path) -> Path:
    """Return the path to write: the target of a link, unless other users could have made it."""
    folder = target.parent.resolve()
    if os.name == "posix" and folder.is_dir() and folder.stat().st_mode & _OTHERS_WRITE:
        return folder / target.name
    return target.resolve()


@contextmanager
def whole_file(
    target: Path, name: str = "", *, new: bool = False, mode: int | None = None
) -> Iterator[Path]:
    """Yield a hidden file beside the target, which it replaces when it is complete.

    The file is synced before it is renamed. A link is followed, except in a folder that others can
    write, where it is replaced. name: of the target in a sentence. new: do not replace an existing
    target. mode: permissions, by default those of a replaced file. Raises UnusableInput naming the
    target, which is then unchanged.
    """
    path = place_of(target)
    part = path.with_name(part_name(path.name))
    try:
        yield part
        with part.open("r+b") as stream:
            os.fsync(stream.fileno())
        if mode is None and path.exists() and not path.is_symlink():
            mode = path.stat().st_mode & 0o777
        if mode is not None:
            part.chmod(mode)
        if new:
            os.link(part, path)
        else:
            part.replace(path)
    except OSError as error:
        raise UnusableInput(
            "{}: cannot be written ({}) ‹{}›.", name or target, error.strerror, error
        ) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def harmless(text: str) -> str:
    """Return a text as a spreadsheet cell; a formula is preceded by a quote."""
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t", "\r") and text else text
