"""Hold writes in memory until a thread that may wait for the disk places them."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rigapp.storage.filesystem.disk import Disk

SOFT_LIMIT = 4 << 20  # 10 s of complete cycles at 120 rpm, the longest expected sync of a disk
HARD_LIMIT = 64 << 20  # three minutes of complete cycles: a disk with more delay is too slow
WAIT_S = 1e-3  # lets the placing thread run; 128 kB take 0.1 ms
MADE_AT_ONCE = 8  # complete cycles or blocks of rows: their columns are joined to runs
RUN_BYTES = 1 << 17  # longer runs cost the same per byte, and an assisting thread waits for one


@dataclass(slots=True)
class _Run:
    """Contiguous writes in the file, written by one system call."""

    offset: int
    end: int
    parts: list[memoryview]


class Backlog:
    """Writes (bytes, offset) in order, bounded, between appending and committing.

    Policy: up to SOFT_LIMIT bytes an append only copies into memory, so that a stalled disk delays
    no caller. Above it each append places ``share`` runs itself. Above HARD_LIMIT it places until
    the backlog is below the limit: the disk is then slower than the data, and the caller must wait.
    Nothing is dropped.

    A cycle's column follows that of the previous cycle in the file. Waiting writes are therefore
    joined: one call for each column of several cycles, not one for each column of each cycle.
    """

    def __init__(self, disk: Disk) -> None:
        self._disk = disk
        self._runs: deque[_Run] = deque()
        self._by_end: dict[int, _Run] = {}
        self._later: deque[tuple[int, Callable[[], object]]] = deque()
        self._lock = threading.Lock()
        self._making = threading.Lock()
        self._placing = threading.Lock()
        self.bytes = 0

    def put(self, writes: Sequence[tuple[memoryview, int]]) -> None:
        """Add writes that do not overlap waiting ones; raises StorageFailed.

        Their data must not change afterwards.
        """
        self._disk.refuse_broken()
        with self._lock:
            for data, offset in writes:
                size = len(data)
                run = self._by_end.pop(offset, None)
                if run is None or offset + size - run.offset > RUN_BYTES:
                    run = _Run(offset, offset, [])
                    self._runs.append(run)
                run.parts.append(data)
                run.end = offset + size
                self._by_end[run.end] = run
                self.bytes += size

    def put_over(self, writes: Sequence[tuple[memoryview, int]]) -> None:
        """Add writes that may overlap waiting ones; the order is kept."""
        self._disk.refuse_broken()
        if not writes:
            return
        with self._lock:
            self._by_end.clear()
            for data, offset in writes:
                self._runs.append(_Run(offset, offset + len(data), [data]))
                self.bytes += len(data)

    def put_later(self, size: int, make: Callable[[], object]) -> None:
        """Add a deferred function that puts ``size`` bytes in its turn; raises StorageFailed."""
        self._disk.refuse_broken()
        with self._lock:
            self._later.append((size, make))
            self.bytes += size

    def assist(self, share: int) -> None:
        """Place runs by the policy; called by each append. Raises StorageFailed."""
        if self.bytes <= SOFT_LIMIT:
            return
        while (share > 0 or self.bytes > HARD_LIMIT) and self._place_one(
            -1 if self.bytes > HARD_LIMIT else WAIT_S
        ):
            share -= 1

    def drain(self) -> None:
        """Return when everything put before the call is in the file. Raises StorageFailed."""
        self._make(len(self._later))
        for _ in range(len(self._runs)):
            if not self._place_one(-1):
                break
        with self._placing:
            self._disk.refuse_broken()

    def _place_one(self, wait_s: float) -> bool:
        """Place the oldest run; one at a time, since a later one may overwrite it."""
        if not self._placing.acquire(timeout=wait_s):
            return False
        try:
            if not self._runs:
                self._make(MADE_AT_ONCE)
            run = self._pop()
            if run is not None:
                self._disk.write_parts(run.parts, run.offset)
            return run is not None
        finally:
            self._placing.release()

    def _make(self, most: int) -> None:
        """Call the functions of ``put_later``; one thread at a time, to keep the order."""
        with self._making:
            for _ in range(most):
                with self._lock:
                    if not self._later:
                        return
                    size, make = self._later.popleft()
                    self.bytes -= size
                make()

    def _pop(self) -> _Run | None:
        with self._lock:
            if not self._runs:
                return None
            run = self._runs.popleft()
            if self._by_end.get(run.end) is run:
                del self._by_end[run.end]
            self.bytes -= run.end - run.offset
            return run
