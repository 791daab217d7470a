"""Write a file whole or not at all: a reader sees the former one or the new one, never half."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from rigapp.config.errors import UnusableInput


@contextmanager
def whole_file(
    target: Path, name: str = "", *, new: bool = False, mode: int | None = None
) -> Iterator[Path]:
    """Yield the name of a hidden file beside the target that takes its place once it is written.

    It is on the disk before it gets the name. name: how a sentence calls the target. new: a target
    that is there is not replaced. mode: permissions, by default those of a file that is replaced.
    Raises UnusableInput naming the target, which is then as it was.
    """
    place = target.resolve()
    part = place.with_name(f".{place.name}.part-{os.getpid()}")
    try:
        yield part
        with part.open("r+b") as stream:
            os.fsync(stream.fileno())
        if mode is None and place.exists():
            mode = place.stat().st_mode & 0o777
        if mode is not None:
            part.chmod(mode)
        if new:
            os.link(part, place)
        else:
            part.replace(place)
    except OSError as error:
        raise UnusableInput(
            f"{name or target}: cannot be written ({error.strerror}) ‹{error}›."
        ) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)
