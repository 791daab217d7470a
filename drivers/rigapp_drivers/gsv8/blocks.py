"""Join samples as they come from the port into Blocks of a useful length; pure."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from rigapp_drivers.api import Block, Quality
from rigapp_drivers.gsv8.link import TimedRun


class BlockMaker:
    """Collect runs of one stream and cut them into Blocks.

    rows: which objects of the frame, in the order of the Block's rows. A Block ends where samples
    are known to be lost, so that ``lost_before`` tells the truth about its first sample.
    """

    def __init__(
        self, device: str, sample_rate_Hz: float, rows: Sequence[int], block_s: float
    ) -> None:
        self._device = device
        self._rate = sample_rate_Hz
        self._rows = list(rows)
        self._wanted = max(1, round(sample_rate_Hz * block_s))
        self._block_ns = round(block_s * 1e9)
        self._runs: deque[TimedRun] = deque()
        self._held = 0
        self._sequence = 0
        self._next_sample = 0
        self._flag_loss = False
        self._sensor_broken = False

    def add(self, runs: Sequence[TimedRun]) -> None:
        """Take samples in their order."""
        self._runs.extend(runs)
        self._held += sum(timed.run.values.shape[1] for timed in runs)

    def flag_loss(self) -> None:
        """Mark the next Block: the device lost samples of an unknown number before it."""
        self._flag_loss = True

    def flag_sensor(self) -> None:
        """Mark all Blocks from now on: a sensor is broken, says the device."""
        self._sensor_broken = True

    def ready(self, now_ns: int) -> bool:
        """Tell whether enough samples are there, or the oldest have waited long enough."""
        if self._held >= self._wanted:
            return True
        return bool(self._runs) and now_ns - self._runs[0].host_time_ns >= self._block_ns

    def make(self) -> Block | None:
        """Return the next Block, None when there are no samples."""
        if not self._runs:
            return None
        parts = [self._runs.popleft()]
        while self._runs and not self._runs[0].run.lost_before:
            parts.append(self._runs.popleft())
        values = parts[0].run.values
        quality = parts[0].run.quality
        if len(parts) > 1:
            values = np.concatenate([part.run.values for part in parts], axis=1)
            quality = np.concatenate([part.run.quality for part in parts])
        count = values.shape[1]
        self._held -= count
        if self._rows != list(range(len(values))):
            values = values[self._rows]
        lost = parts[0].run.lost_before
        if self._flag_loss or lost:
            quality[0] |= Quality.LOST_BEFORE
            self._flag_loss = False
        if self._sensor_broken:
            quality |= np.uint8(Quality.SENSOR_FAULT)
        block = Block(
            device=self._device,
            sequence=self._sequence,
            first_sample=self._next_sample + lost,
            sample_rate_Hz=self._rate,
            host_time_ns=parts[-1].host_time_ns,
            values=values,
            quality=quality,
            lost_before=lost,
        )
        self._sequence += 1
        self._next_sample += lost + count
        return block
