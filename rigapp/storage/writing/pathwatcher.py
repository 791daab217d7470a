"""See that the file of a running test keeps its name, and give it one again when it lost it."""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Callable
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.schema.messages import PathReport
from rigapp.storage.filesystem.calls import BINARY, StorageFailed
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.folder import (
    hidden_name,
    refuse_little_space,
)
from rigapp.storage.filesystem.rescue import PathState, copy_content, path_state, places_for
from rigapp.storage.filesystem.system import FILES
from rigapp.texts import joined, say, sentence_of_error


class PathWatcher:
    """Look after the name of one open file, by any thread.

    reserve: reserves the room of the test in a file. committing: held while a commit is made. Lock
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
        """Bring the file back when it was deleted, moved or replaced; writing goes on meanwhile.

        notice: told what happened before the file is saved, which may take long. To be called while
        ``looking`` is held. Return what became of it, None when nothing has happened. Raises
        StorageFailed when another program has cut the file short.
        """
        disk = self._disk
        if os.fstat(disk.fd).st_size < self._length:
            raise StorageFailed(
                "{}: another program has cut the file short while the test writes it;"
                " keep a copy of what is left of it, and see what rigapp info says of it",
                disk.path,
            )
        fate = path_state(disk.fd, disk.path)
        if fate is None:
            return None
        what = fate.sentence(disk.path)
        notice(say("{}; everything in it is being saved.", what))
        return self._bring_back(fate, what)

    def _bring_back(self, fate: PathState, what: str) -> PathReport:
        reasons = []
        for target in places_for(self._disk.path, fate):
            try:
                linked = self._save_as(target, fate.named)
            except UnusableInput as error:
                reasons.append(sentence_of_error(error))
            except OSError as error:
                reasons.append(say("{}: {}", target, error.strerror or error))
            else:
                how = say("is its name now") if linked else say("has all of it and is written on")
                return PathReport(say("{}; {} {}.", what, target, how), saved=True)
        return PathReport(
            say("{}, and it could not be saved: {}", what, joined("; ", reasons)), saved=False
        )

    def _save_as(self, target: Path, named: bool) -> bool:
        """Let the file be called ``target``; True by a link, False by a copy. Raises OSError."""
        target.parent.mkdir(parents=True, exist_ok=True)
        linked = named and self._link(target)
        if not linked:
            self._copy(target)
        self._disk.path = target
        return linked

    def _link(self, target: Path) -> bool:
        """Give the file another name; False where its file system or folder does not allow it."""
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
                disk.go_on_in(fd)
                disk.sync()
            failed.pop_all()
        self._reserve(disk)
        FILES.sync_folder(target.parent)
