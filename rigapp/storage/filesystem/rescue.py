"""What becomes of a file that is deleted, moved or replaced while it is written, and the way back.

The kernel keeps an open file as long as it is open, whatever happens to its name. A file that still
has a name somewhere gets its own one back, as a second link. One that has none any more can get no
link on Linux; it is copied while writing goes on.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from rigapp.storage.filesystem.system import FILES
from rigapp.texts import say

PIECE = 1 << 22  # a copy gives way to the test every 4 MB, some 20 ms of a disk


@dataclass(frozen=True, slots=True)
class PathState:
    """Say what happened to a name: another file has it, or none.

    named: the open file has a name still. where: that name, empty when the kernel does not tell.
    """

    replaced: bool
    named: bool
    where: str = ""

    def sentence(self, path: Path) -> str:
        """Return what happened in words."""
        if self.named:
            where = say(" to {}", self.where) if self.where else ""
            words = say("{} was moved{} while the test writes it", path, where)
            return say("{}, and another file has its name", words) if self.replaced else words
        if self.replaced:
            return say("{} was replaced by another file while the test writes it", path)
        return say("{} was deleted while the test writes it", path)


def path_state(fd: int, path: Path) -> PathState | None:
    """Return what happened to the name of an open file; None when it has it, or nobody can tell."""
    mine = os.fstat(fd)
    try:
        there = path.stat()
    except (FileNotFoundError, NotADirectoryError):
        replaced = False
    except OSError:
        return None
    else:
        if (mine.st_ino, mine.st_dev) == (there.st_ino, there.st_dev):
            return None
        replaced = True
    named = mine.st_nlink > 0
    return PathState(replaced, named, _name_of(fd) if named else "")


def _name_of(fd: int) -> str:
    """Return the name of an open file; empty when it is not the one by which it was opened."""
    try:
        name = os.readlink(f"/proc/self/fd/{fd}")
    except OSError:
        return ""
    return "" if name.endswith(" (deleted)") else name


def places_for(path: Path, fate: PathState) -> Iterator[Path]:
    """Yield the names under which to save a file, the best one first."""
    yield free_name(path) if fate.replaced else path
    for folder in (Path.home(), Path(tempfile.gettempdir())):
        yield free_name(folder / path.name)


def free_name(path: Path) -> Path:
    """Return a name beside ``path``, or itself, that no file has."""
    if not os.path.lexists(path):
        return path
    names = (path.with_name(f"{path.stem}-saved-{number}{path.suffix}") for number in count(1))
    return next(name for name in names if not os.path.lexists(name))


def copy_content(source: int, target: int) -> None:
    """Copy an open file with its holes into another, empty one; raises OSError."""
    size = os.fstat(source).st_size
    os.ftruncate(target, size)
    for start, stop in FILES.data_ranges(source, size):
        copy_ranges(source, target, ((first, PIECE) for first in range(start, stop, PIECE)))


def copy_ranges(source: int, target: int, ranges: Iterable[tuple[int, int]]) -> None:
    """Copy ranges (offset, length) of an open file to the same places of another."""
    for offset, length in ranges:
        data = FILES.read_at(source, length, offset)
        done = 0
        while done < len(data):
            done += FILES.write_at(target, (memoryview(data)[done:],), offset + done)
