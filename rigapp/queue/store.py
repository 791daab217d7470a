"""The queue of a rig on the disk: read, and changed by one process at a time."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.process.locks import taken
from rigapp.queue.items import Queue
from rigapp.schema.wire import json_bytes
from rigapp.texts import say

LOCK_S = 5.0
LOOK_EVERY_S = 0.02


class QueueStore:
    """One queue in one file; commands and engine change it, each for a moment."""

    def __init__(self, path: Path, rig: Path) -> None:
        self._path = path
        self._rig = str(rig.resolve())
        self._seen: tuple[tuple[int, int], Queue] = ((0, 0), Queue(rig=self._rig))

    def read(self) -> Queue:
        """Return the queue, an empty one where there is none yet; raise UnusableInput."""
        try:
            return msgspec.json.decode(self._path.read_bytes(), type=Queue)
        except FileNotFoundError:
            return Queue(rig=self._rig)
        except (OSError, ValueError) as error:
            raise UnusableInput(
                "{}: the queue cannot be read ‹{}›; move the file away.", self._path, error
            ) from error

    def view(self) -> Queue:
        """Return the queue for frequent readers: read only if the file has changed."""
        try:
            status = self._path.stat()
            state = (status.st_mtime_ns, status.st_ino)
            if state != self._seen[0]:
                self._seen = (state, self.read())
        except (OSError, UnusableInput):
            return Queue(rig=self._rig)
        return self._seen[1]

    def change(self, how: Callable[[Queue], Queue]) -> Queue:
        """Replace the queue by a changed one, and return it; raise UnusableInput."""
        with self._alone():
            changed = how(self.read())
            with whole_file(self._path, say("the queue"), mode=0o600) as part:
                part.write_bytes(msgspec.json.format(json_bytes(changed)))
        return changed

    @contextmanager
    def _alone(self) -> Iterator[None]:
        deadline = time.monotonic() + LOCK_S
        with self._path.with_suffix(".lock").open("ab") as file:
            while not taken(file.fileno()):
                if time.monotonic() > deadline:
                    raise UnusableInput(
                        "{}: another program has been changing the queue for {:g} s; try again.",
                        self._path,
                        LOCK_S,
                    )
                time.sleep(LOOK_EVERY_S)
            yield
