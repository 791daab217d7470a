"""Keep what is to be written in memory until a thread that may wait for the disk places it."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Sequence

from rigapp.storage.filesystem.disk import Disk

SOFT_LIMIT = 4 << 20  # 10 s of whole cycles at 120 rpm: so long may a disk sync
HARD_LIMIT = 64 << 20  # three minutes of it: a disk that is so late is too slow


class Backlog:
    """Hold writes (offset, bytes) in order, bounded, between appending and committing.

    Policy: up to SOFT_LIMIT bytes an append only copies into memory, so that a disk that stalls
    delays nobody. Above it each append places ``share`` writes itself. Above HARD_LIMIT it places
    until the backlog is below: then the disk is slower than the data, and the caller must feel it.
    Nothing is ever dropped.
    """

    def __init__(self, disk: Disk) -> None:
        self._disk = disk
        self._writes: deque[tuple[memoryview, int]] = deque()
        self._lock = threading.Lock()
        self._placing = threading.Lock()
        self.bytes = 0

    def put(self, writes: Sequence[tuple[memoryview, int]]) -> None:
        """Add writes; their data must not change afterwards. Raises StorageFailed."""
        self._disk.refuse_broken()
        size = sum(len(data) for data, _ in writes)
        with self._lock:
            self._writes.extend(writes)
            self.bytes += size

    def assist(self, share: int) -> None:
        """Place writes as the policy asks; called by each append. Raises StorageFailed."""
        if self.bytes <= SOFT_LIMIT:
            return
        while (share > 0 or self.bytes > HARD_LIMIT) and self._place_one(
            wait=self.bytes > HARD_LIMIT
        ):
            share -= 1

    def drain(self) -> None:
        """Return when everything put before the call is in the file. Raises StorageFailed."""
        for _ in range(len(self._writes)):
            if not self._place_one(wait=True):
                break
        with self._placing:
            self._disk.refuse_broken()

    def _place_one(self, wait: bool) -> bool:
        """Place the oldest write; one at a time, since a later one may lie over it."""
        if not self._placing.acquire(blocking=wait):
            return False
        try:
            write = self._pop()
            if write is not None:
                self._disk.write(*write)
            return write is not None
        finally:
            self._placing.release()

    def _pop(self) -> tuple[memoryview, int] | None:
        with self._lock:
            if not self._writes:
                return None
            write = self._writes.popleft()
            self.bytes -= len(write[0])
            return write
