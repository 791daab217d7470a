"""Recovery of a file that is deleted, moved or replaced while it is written.

The kernel keeps an open file as long as it is open, whatever happens to its name. A file that still
has a name gets its original name back as a second link. A file without any name cannot be linked on
Linux; it is copied while writing continues.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.schema.messages import PathReport
from rigapp.storage.filesystem.calls import BINARY, StorageFailed
from rigapp.storage.filesystem.disk import Disk, copy_ranges
from rigapp.storage.filesystem.folder import (
    hidden_name,
    refuse_little_space,
)
from rigapp.storage.filesystem.system import FILES
from rigapp.texts import joined, say, sentence_of_error

PIECE = 1 << 22  # a copy yields to the test every 4 MB, about 20 ms on a disk


@dataclass(frozen=True, slots=True)
class PathState:
    """The state of a file's name: another file has it, or none.

    named: the open file still has a name. where: that name, empty when the kernel does not know it.
    """

    replaced: bool
    named: bool
    where: str = ""

    def sentence(self, path: Path) -> str:
        """Return a description of what happened."""
        if self.named:
            where = say(" to {}", self.where) if self.where else ""
            words = say("{} was moved{} while the test writes it", path, where)
            return say("{}, and another file has its name", words) if self.replaced else words
        if self.replaced:
            return say("{} was replaced by another file while the test writes it", path)
        return say("{} was deleted while the test writes it", path)


def path_state(fd: int, path: Path) -> PathState | None:
    """Return the state of the name of an open file; None when it is intact or unknown."""
    opened = os.fstat(fd)
    try:
        named_file = path.stat()
    except (FileNotFoundError, NotADirectoryError):
        replaced = False
    except OSError:
        return None
    else:
        if (opened.st_ino, opened.st_dev) == (named_file.st_ino, named_file.st_dev):
            return None
        replaced = True
    named = opened.st_nlink > 0
    return PathState(replaced, named, _name_of(fd) if named else "")


def _name_of(fd: int) -> str:
    """Return the kernel's name of an open file; empty where it is unknown or deleted."""
    try:
        name = os.readlink(f"/proc/self/fd/{fd}")
    except OSError:
        return ""
    return "" if name.endswith(" (deleted)") else name


def places_for(path: Path, state: PathState) -> Iterator[Path]:
    """Yield candidate paths to save a file to, in order of preference."""
    yield free_name(path) if state.replaced else path
    for folder in (Path.home(), Path(tempfile.gettempdir())):
        yield free_name(folder / path.name)


def free_name(path: Path) -> Path:
    """Return ``path``, or a similar name in its folder where a file has it already."""
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


class PathWatcher:
    """Monitor the name of one open file; any thread may call it.

    reserve: reserves the space of the test in a file. committing: held during a commit. Lock
    order: ``looking`` before ``committing``.
    """

    def __init__(
        self, disk: Disk, reserve: Callable[[Disk], None], committing: threading.Lock
    ) -> None:
        self.looking = threading.Lock()
        self._disk = disk
        self._reserve = reserve
        self._committing = committing
        self._length = os.fstat(disk.fd).st_size

    def look(self, notice: Callable[[str], object]) -> PathReport | None:
        """Restore the file when it was deleted, moved or replaced; writing continues meanwhile.

        notice: called before the file is saved, which may take long. To be called while
        ``looking`` is held. Return the result, None when nothing has happened. Raises
        StorageFailed when another program has truncated the file.
        """
        disk = self._disk
        if os.fstat(disk.fd).st_size < self._length:
            raise StorageFailed(
                (
                    "{}: another program truncated the file while the test writes it; keep a"
                    " copy of the rest, and check it with rigapp info"
                ),
                disk.path,
            )
        state = path_state(disk.fd, disk.path)
        if state is None:
            return None
        words = state.sentence(disk.path)
        notice(say("{}; everything in it is being saved.", words))
        return self._bring_back(state, words)

    def _bring_back(self, state: PathState, what: str) -> PathReport:
        reasons = []
        for target in places_for(self._disk.path, state):
            try:
                linked = self._save_as(target, state.named)
            except UnusableInput as error:
                reasons.append(sentence_of_error(error))
            except OSError as error:
                reasons.append(say("{}: {}", target, error.strerror or error))
            else:
                how = say("is its new name") if linked else say("has all of it and is written on")
                return PathReport(say("{}; {} {}.", what, target, how), saved=True)
        return PathReport(
            say("{}, and it could not be saved: {}", what, joined("; ", reasons)), saved=False
        )

    def _save_as(self, target: Path, named: bool) -> bool:
        """Save the file as ``target``; return True for a link, False for a copy. Raises OSError."""
        target.parent.mkdir(parents=True, exist_ok=True)
        linked = named and self._link(target)
        if not linked:
            self._copy(target)
        self._disk.path = target
        return linked

    def _link(self, target: Path) -> bool:
        """Link the file to another name; False where the file system or folder forbids it."""
        try:
            FILES.link(self._disk.fd, target)
        except FileExistsError:
            raise
        except OSError:
            return False
        return True

    def _copy(self, target: Path) -> None:
        """Copy the file while it is written, and write to the copy from then on."""
        disk = self._disk
        needed = FILES.taken_bytes(disk.fd)
        refuse_little_space(target.parent, target, needed, say("the file of the running test"))
        hidden = hidden_name(target)
        hidden.unlink(missing_ok=True)
        fd = os.open(hidden, os.O_RDWR | os.O_CREAT | os.O_EXCL | BINARY, 0o600)
        with contextlib.ExitStack() as always, contextlib.ExitStack() as failed:
            always.callback(os.close, fd)
            always.callback(disk.end_copy)
            failed.callback(lambda: hidden.unlink(missing_ok=True))
            disk.begin_copy()
            copy_content(disk.fd, fd)
            self._reserve(Disk(fd, target))
            os.fsync(fd)
            with self._committing:
                disk.follow_copy(fd)
                FILES.sync(fd)
                FILES.protect(fd)
                if not FILES.hold(fd):
                    raise UnusableInput("{}: another process took the new file", target)
                FILES.settle(fd, hidden, target)
                disk.switch_to(fd)
                disk.sync()
            failed.pop_all()
        self._reserve(disk)
        FILES.sync_folder(target.parent)
