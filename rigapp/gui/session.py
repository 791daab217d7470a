"""Follow one test at a time: history from its file, then live rows, gaps filled from the file."""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from pathlib import Path

from rigapp.engine.messages import Snapshot
from rigapp.gui.series import LiveData
from rigapp.gui.tasks import Worker

log = logging.getLogger(__name__)

HELD_SNAPSHOTS = 600
"""Snapshots held while the file is read; the oldest go first, which the next reading mends."""

Loader = Callable[[Path, int], LiveData]


class Session:
    """Turn snapshots into the data of the present test."""

    def __init__(self, loader: Loader) -> None:
        self._loader = loader
        self._worker = Worker("gui-history", bound=2)
        self._identity: str | None = None
        self._held: deque[Snapshot] | None = None
        self.data = LiveData()
        self.problem = ""

    def take(self, snapshot: Snapshot) -> bool:
        """Take a snapshot; return whether it belongs to another test than the last one."""
        status = snapshot.status
        identity = status.file
        changed = identity != self._identity
        if changed:
            self._identity = identity
            self._held = None
            self.data = LiveData(status.planned)
            self.problem = ""
        self.data.take(snapshot)
        if self._held is not None:
            self._held.append(snapshot)
        elif self.data.missing_from is not None and status.file:
            self._read(Path(status.file), status.planned, snapshot)
        return changed

    def deliver(self) -> None:
        """Take a history that has been read."""
        self._worker.deliver()

    def close(self) -> None:
        """End the reading thread."""
        self._worker.close()

    def _read(self, path: Path, planned: int, snapshot: Snapshot) -> None:
        self._held = deque([snapshot], maxlen=HELD_SNAPSHOTS)
        identity = self._identity
        self._worker.submit(
            lambda: self._loader(path, planned),
            lambda data: self._loaded(identity, data),
            lambda error: self._failed(identity, path, error),
        )

    def _loaded(self, identity: str | None, data: LiveData) -> None:
        if identity != self._identity or self._held is None:
            return
        held, self._held = self._held, None
        for snapshot in held:
            data.take(snapshot)
        data.cycle = data.cycle or self.data.cycle
        data.prediction = data.prediction or self.data.prediction
        self.data = data
        self.problem = ""

    def _failed(self, identity: str | None, path: Path, error: Exception) -> None:
        if identity != self._identity:
            return
        log.error("History of %s cannot be read: %s", path, error)
        self.problem = f"Earlier cycles cannot be shown: {error}"
        self._held = None
        self.data.missing_from = None
