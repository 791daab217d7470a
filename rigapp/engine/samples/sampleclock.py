"""The device time of samples that the encoder clocks: one a pulse, at no fixed times.

Time comes from the device where it records the pulse rate: the time from one pulse to the next is
one over that rate. Without it the host's clock gives it, smoothed, as blocks come with the jitter
of their transport. A rig in real time is tied to the host's clock in both cases: small deviations
are evened out slowly, and a long silence is a standstill of the crank, before the first pulse
after it. The time of a simulated rig is not the host's: it needs the pulse rate, and a standstill
takes no time.

Times are whole ticks of 1 ns, so that they are kept exactly over months.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_drivers.api import Block

TICKS_PER_S = 1_000_000_000.0

LONGEST_PULSE_S = 2.0
"""Between two pulses a turning crank takes no longer, however low the rate reads."""

SNAP_S = 0.25
"""Device time that is so far behind the host's has missed a standstill."""

EVEN_OUT_S = 10.0
"""A smaller deviation from the host's clock is evened out over this time ..."""

LARGEST_CHANGE = 0.005
"""... by changing the intervals by this share at most."""

LEAST_SHARE = 0.05
"""Of its own length, to which an interval is cut where device time is ahead: time never stops."""

SMOOTHING_S = 0.3
"""Without a pulse rate: the interval between pulses is averaged over this time."""


@dataclass(frozen=True, slots=True)
class PulseRate:
    """Where a Block carries the pulse rate: rate in Hz = scale * raw + offset."""

    row: int
    scale: float
    offset: float


class EncoderClock:
    """Assign a time to every sample of a stream; called by one thread.

    nominal_Hz: the usual pulse rate. rate: None where the device does not record it. real_time: the
    host's clock can be relied on.
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
        """Return the time at a moment when no pulse has come; raises RuntimeError before any."""
        if self._now is None:
            self._now = self._host = host_time_ns
        return self._now + max(0, host_time_ns - self._host)

    def times(self, block: Block) -> NDArray[np.int64]:
        """Return the time of each sample of the next block, (samples,), strictly growing."""
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
        """Return the ticks before each sample, those of lost pulses with the first."""
        rate = self._rate
        if rate is not None:
            rates = block.values[rate.row].astype(np.float64) * rate.scale + rate.offset
            slowest = 1.0 / LONGEST_PULSE_S
            intervals = TICKS_PER_S / np.maximum(np.nan_to_num(rates), slowest)
            intervals[0] *= 1 + lost
            return intervals
        elapsed = block.host_time_ns - self._host
        if 0 < elapsed < SNAP_S * TICKS_PER_S:
            # Weighted by pulses, not by the time itself, whose jitter would make it too long.
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
