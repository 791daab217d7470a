"""Buffers of samples between threads: queued blocks, and means of the last seconds."""

from __future__ import annotations

import threading
import time
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_drivers.api import Block


class BlockQueue:
    """Queue of Blocks from the reader to the processing thread, bounded by samples.

    A full queue rejects the latest block, which causes a gap.
    """

    def __init__(self, samples: int) -> None:
        self.limit = samples
        self._blocks: deque[Block] = deque()
        self._samples = 0
        self._condition = threading.Condition()
        self.refused_blocks = 0

    def put(self, block: Block) -> bool:
        """Add a block; return False if the queue is full."""
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
        """Return the oldest block, or None after the time-out."""
        with self._condition:
            self._condition.wait_for(lambda: bool(self._blocks), timeout_s)
            if not self._blocks:
                return None
            block = self._blocks.popleft()
            self._samples -= block.values.shape[1]
            self._condition.notify_all()
        return block

    def wait_below(self, samples: int, timeout_s: float) -> bool:
        """Wait until fewer samples are queued; return False after the time-out."""
        with self._condition:
            return self._condition.wait_for(lambda: self._samples < samples, timeout_s)

    @property
    def samples(self) -> int:
        """Return the number of queued samples."""
        return self._samples

    @property
    def oldest_ns(self) -> int | None:
        """Return the host time of the oldest queued block, None without one."""
        with self._condition:
            return self._blocks[0].host_time_ns if self._blocks else None


MEANS_PER_SECOND = 20.0  # as fast as a person can read
LONGEST_WINDOW_S = 60.0  # over a longer window, drift exceeds noise
FORGOTTEN_AFTER_S = 30.0
"""Time without a request (host time) after which the recording ends."""

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Means:
    """Means of consecutive samples: signals (n, inputs), device sample (n,) at the end of each."""

    end: NDArray[np.int64]
    signals: Array
    samples_per_mean: int
    sample_rate_Hz: float


class RecentSignals:
    """Means of the last window; the processing thread writes, any thread reads.

    A gap in the sample numbers clears it, so that the means are always consecutive.
    """

    def __init__(self, sample_rate_Hz: float, window_s: float, inputs: int) -> None:
        self._inputs = inputs
        self._rate = sample_rate_Hz
        self._each = max(1, round(sample_rate_Hz / MEANS_PER_SECOND))
        kept = max(1, round(min(window_s, LONGEST_WINDOW_S) * sample_rate_Hz / self._each))
        self._means: deque[tuple[int, Array]] = deque(maxlen=kept)
        self._rest: Array = np.empty((inputs, 0))
        self._next = -1
        self._read_s = time.monotonic()
        self._lock = threading.Lock()

    @property
    def window_s(self) -> float:
        """Return the length of the window, s of device time."""
        return (self._means.maxlen or 0) * self._each / self._rate

    @property
    def forgotten(self) -> bool:
        """Return whether there was no request for ``FORGOTTEN_AFTER_S``."""
        return time.monotonic() - self._read_s > FORGOTTEN_AFTER_S

    def add(self, first_sample: int, signals: Array) -> None:
        """Add signals (inputs, n); first_sample: device sample of the first."""
        with self._lock:
            if first_sample != self._next:
                self._means.clear()
                self._rest = np.empty((self._inputs, 0))
            self._next = first_sample + signals.shape[1]
            signals_so_far = np.concatenate((self._rest, signals), axis=1)
            count = signals_so_far.shape[1] // self._each
            start = self._next - signals_so_far.shape[1]
            parts = signals_so_far[:, : count * self._each].reshape(self._inputs, count, self._each)
            means = parts.mean(axis=2)
            for index in range(count):
                self._means.append((start + (index + 1) * self._each, means[:, index]))
            self._rest = signals_so_far[:, count * self._each :]

    def read(self) -> Means:
        """Return the stored means."""
        with self._lock:
            self._read_s = time.monotonic()
            means = list(self._means)
        return Means(
            end=np.array([end for end, _ in means], dtype=np.int64),
            signals=np.array([mean for _, mean in means]).reshape(-1, self._inputs),
            samples_per_mean=self._each,
            sample_rate_Hz=self._rate,
        )
