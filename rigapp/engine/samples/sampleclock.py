"""Device time of samples with the encoder as clock: one per pulse, at irregular times.

If the device records the pulse rate, the time between pulses is its inverse. Else it is from the
host's clock, smoothed because of the jitter of the blocks' transport. In real time, the device time
follows the host's clock in both cases: small deviations are corrected slowly, and a long time
without pulses is a standstill of the crank, before the next pulse. The time of a simulated rig is
not the host's: it needs the pulse rate, and a standstill takes no time.

Times are integer ticks of 1 ns, exact over months.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_drivers.api import Block

TICKS_PER_S = 1_000_000_000.0

LONGEST_PULSE_S = 2.0
"""Longest time between pulses of a turning crank, for any recorded rate."""

SNAP_S = 0.25
"""Lag of the device time behind the host's that indicates a standstill."""

EVEN_OUT_S = 10.0
"""Time in which a smaller deviation from the host's clock is corrected ..."""

LARGEST_CHANGE = 0.005
"""... with at most this relative change of the intervals."""

LEAST_SHARE = 0.05
"""Least factor of an interval if device time is ahead: time must not stop."""

SMOOTHING_S = 0.3
"""Averaging time of the interval between pulses without a pulse rate."""


@dataclass(frozen=True, slots=True)
class PulseRate:
    """Row of a Block with the pulse rate: rate in Hz = scale * raw + offset."""

    row: int
    scale: float
    offset: float


class EncoderClock:
    """Times of the samples of a stream; for one thread.

    nominal_Hz: usual pulse rate. rate: None if the device does not record it. real_time: whether
    the host's clock is valid.
    """

    def __init__(self, nominal_Hz: float, rate: PulseRate | None, real_time: bool) -> None:
        if rate is None and not real_time:
            raise ValueError(say("the time of a rig that is not in real time needs the pulse rate"))
        self._rate = rate
        self._real_time = real_time
        self._interval = TICKS_PER_S / nominal_Hz
        self._now: int | None = None
        self._host = 0
        self._next_sample = 0

    def quiet(self, host_time_ns: int) -> int:
        """Return the device time at a host time without a pulse."""
        if self._now is None:
            self._now = self._host = host_time_ns
        return self._now + max(0, host_time_ns - self._host)

    def times(self, block: Block) -> NDArray[np.int64]:
        """Return the time of each sample of the next block, (samples,), strictly increasing."""
        n = block.values.shape[1]
        if self._now is None:
            self._host, self._next_sample = block.host_time_ns, block.first_sample
        lost = max(0, block.first_sample - self._next_sample)
        intervals = self._intervals(block, n, lost)
        if self._now is None:
            self._now = block.host_time_ns - round(float(intervals.sum()))
        if self._real_time:
            self._follow_host(intervals, block.host_time_ns)
        ticks = self._now + np.cumsum(np.maximum(np.rint(intervals), 1.0)).astype(np.int64)
        self._now = int(ticks[-1])
        self._host = block.host_time_ns
        self._next_sample = block.first_sample + n
        return ticks

    def _intervals(self, block: Block, n: int, lost: int) -> NDArray[np.float64]:
        """Return the ticks before each sample; those of lost pulses are added to the first."""
        rate = self._rate
        if rate is not None:
            rates = block.values[rate.row].astype(np.float64) * rate.scale + rate.offset
            slowest = 1.0 / LONGEST_PULSE_S
            intervals = TICKS_PER_S / np.maximum(np.nan_to_num(rates), slowest)
            intervals[0] *= 1 + lost
            return intervals
        elapsed = block.host_time_ns - self._host
        if 0 < elapsed < SNAP_S * TICKS_PER_S:
            # Weighted by pulses, not by time, whose jitter would cause a bias to longer intervals.
            pulses = n + lost
            share = min(1.0, pulses * self._interval / (SMOOTHING_S * TICKS_PER_S))
            self._interval += share * (elapsed / pulses - self._interval)
        intervals = np.full(n, self._interval)
        intervals[0] *= 1 + lost
        return intervals

    def _follow_host(self, intervals: NDArray[np.float64], host_time_ns: int) -> None:
        assert self._now is not None
        total = float(intervals.sum())
        behind = host_time_ns - (self._now + total)
        if behind > SNAP_S * TICKS_PER_S:
            intervals[0] += behind
        elif behind < -SNAP_S * TICKS_PER_S:
            intervals *= max(LEAST_SHARE, (total + behind) / total)
        else:
            change = behind / (EVEN_OUT_S * TICKS_PER_S)
            intervals *= 1.0 + min(LARGEST_CHANGE, max(-LARGEST_CHANGE, change))
