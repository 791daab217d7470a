"""The queue between the reader and the processing thread, bounded by samples."""

from __future__ import annotations

import threading
from collections import deque

from rigapp_drivers.api import Block


class BlockQueue:
    """Hand Blocks from the reader to the processing thread, bounded by samples.

    A full queue refuses the newest block, which shows as a gap.
    """

    def __init__(self, samples: int) -> None:
        self.limit = samples
        self._blocks: deque[Block] = deque()
        self._samples = 0
        self._condition = threading.Condition()
        self.refused_blocks = 0

    def put(self, block: Block) -> bool:
        """Add a block; False when it was refused because the queue is full."""
        size = block.values.shape[1]
        with self._condition:
            if self._blocks and self._samples + size > self.limit:
                self.refused_blocks += 1
                return False
            self._blocks.append(block)
            self._samples += size
            self._condition.notify_all()
        return True

    def get(self, timeout_s: float) -> Block | None:
        """Return the oldest block, or None when none came in time."""
        with self._condition:
            self._condition.wait_for(lambda: bool(self._blocks), timeout_s)
            if not self._blocks:
                return None
            block = self._blocks.popleft()
            self._samples -= block.values.shape[1]
            self._condition.notify_all()
        return block

    def wait_below(self, samples: int, timeout_s: float) -> bool:
        """Wait until fewer samples wait; False when they did not in time."""
        with self._condition:
            return self._condition.wait_for(lambda: self._samples < samples, timeout_s)

    @property
    def samples(self) -> int:
        """Return the samples waiting."""
        return self._samples

    @property
    def oldest_ns(self) -> int | None:
        """Return the host time of the oldest block waiting, None when none waits."""
        with self._condition:
            return self._blocks[0].host_time_ns if self._blocks else None
