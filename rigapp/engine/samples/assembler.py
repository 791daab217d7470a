"""Division of the stream of Blocks into revolutions at the encoder index.

Nothing is interpolated, and no valid sample is dropped: a gap is a break between two segments and a
flag; a missing index, a slipped count and a reversal are flags. A revolution is returned when a few
samples beyond its end have arrived (``Margins``), which the calibration needs to shift the analog
channels relative to the encoder.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass, replace
from operator import itemgetter
from typing import cast

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.counterstate import (
    BREAK,
    CUT,
    EventAt,
    ParameterAt,
    StateAt,
    new_state,
)
from rigapp.engine.samples.motion import ENOUGH_COUNTS
from rigapp.engine.samples.sampleclock import TICKS_PER_S
from rigapp.engine.samples.unwrap import INDEX_NEAR, counted, scan
from rigapp.schema.messages import Flag
from rigapp.texts import say
from rigapp_drivers.api import Block

Values = NDArray[np.float32] | NDArray[np.int32]

MAXIMUM_ACCELERATION_REV_PER_S2 = 200.0
"""Largest acceleration; larger deviations of the count are not motion."""

STANDSTILL_S = 2.0
"""Duration of a standstill beyond which samples are counted, but not stored."""

FIRST_BUFFER = 1 << 16  # samples: several revolutions, so that it rarely grows

KEPT = int(StateAt.KEPT)
"""As int, because access to an enumeration's member is slow, and each block reads it."""

_motion_in = itemgetter(
    StateAt.TRAVEL_FIRST,
    StateAt.TRAVEL,
    StateAt.LOCKED,
    StateAt.UNLOCKED_TURN,
    StateAt.SKIPS,
)
"""The fields of ``Motion`` in the state, read as a list for each block: one by one takes 8 us."""


@dataclass(frozen=True, slots=True)
class EncoderSetup:
    """Relation of the counter to the crank.

    counts_per_revolution: after quadrature. direction: +1 or -1, counter relative to crank.
    restarts_at_index: the index pulse sets the count to zero. modulus: number of counts after which
    the counter wraps, 0 if it does not.
    """

    counts_per_revolution: int
    direction: int = 1
    restarts_at_index: bool = True
    modulus: int = 0

    def __post_init__(self) -> None:
        if self.counts_per_revolution < 4:
            raise ValueError(
                say("counts_per_revolution is {}, must be 4 or more", self.counts_per_revolution)
            )
        if self.direction not in (1, -1):
            raise ValueError(say("direction is {}, must be 1 or -1", self.direction))


@dataclass(frozen=True, slots=True)
class Margins:
    """Number of samples needed before and after a revolution."""

    before: int = 0
    after: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Revolution:
    """Raw data of one revolution.

    ordinal: revolutions of the crank since the first one, including lost ones.
    values: (channels, before + samples + after), a view; the revolution starts at ``before``.
    counts: (samples,) unwrapped counts from the index at its beginning, positive in the rig's
    direction. end_count: that of the first sample after it.
    segments: (k, 2) int64, index in the revolution and device sample index of each run of samples
    without a break; the first has index 0.
    first_sample, end_sample: device sample index of its first sample and of the first after it.
    host_time_ns: monotonic time of the block with its end; later_samples: device samples from its
    end to the end of that block.
    skipped_counts: jump of the count at unreported missing samples, modulo a turn; 0 if the index
    at its end shows that the encoder lost counts.
    ticks: None with a sample clock. With the encoder as clock: the time of each sample of
    ``values``; all values above in device samples are then in these ticks, and sample_rate_Hz is
    their number per second.
    """

    ordinal: int
    values: Values
    before: int
    counts: NDArray[np.int64]
    end_count: int
    segments: NDArray[np.int64]
    first_sample: int
    end_sample: int
    sample_rate_Hz: float
    host_time_ns: int
    later_samples: int
    lost_samples: int
    idle_samples: int
    flags: Flag
    skipped_counts: int = 0
    ticks: NDArray[np.int64] | None = None

    @property
    def samples(self) -> int:
        """Return the number of stored samples."""
        return int(self.counts.shape[0])

    def first_speed_rpm(self, counts_per_revolution: int) -> float:
        """Return the mean speed (rpm) over the first counts that suffice for it, else NaN."""
        enough = max(ENOUGH_COUNTS, counts_per_revolution // 16)
        end = min(int(np.searchsorted(self.counts, enough)), self.samples - 1)
        if end < 1:
            return math.nan
        index = self.sample_indices()
        turned = float(self.counts[end] - self.counts[0]) / counts_per_revolution
        return 60.0 * turned * self.sample_rate_Hz / float(index[end] - index[0])

    def sample_indices(self) -> NDArray[np.int64]:
        """Return the device sample index (or tick) of each sample, (samples,)."""
        if self.ticks is not None:
            return self.ticks[self.before : self.before + self.samples]
        if len(self.segments) == 1:
            first = int(self.segments[0, 1])
            return np.arange(first, first + self.samples, dtype=np.int64)
        index = np.arange(self.samples, dtype=np.int64)
        starts = self.segments[:, 0]
        which = np.searchsorted(starts, index, side="right") - 1
        return np.asarray(index - starts[which] + self.segments[which, 1], np.int64)


@dataclass(slots=True)
class Motion:
    """Latest motion of the crank, for interlocks and display.

    count: unwrapped position, corrected at each index; phase: counts from the index, 0 ..
    counts_per_revolution - 1. travel: counts up to the block's first and last sample, without
    corrections, so that a lost count does not appear as speed.
    gap: samples lost just before the block, -1 if unknown; turned_in_gap: counts in the gap. skips:
    number of permanent jumps of the count.
    """

    count: int = 0
    phase: int = 0
    travel: tuple[int, int] = (0, 0)
    locked: bool = False
    turned_without_index: float = 0.0
    gap: int = 0
    turned_in_gap: int = 0
    skips: int = 0


@dataclass(slots=True, eq=False)
class _Waiting:
    """A revolution that waits for the samples after its end."""

    start: int
    end: int
    event: NDArray[np.int64]
    begin_sample: int
    host_time_ns: int
    later_samples: int
    base: int


class Assembler:
    """Assembler of Revolutions from Blocks; for one thread.

    counter_row: row of the Block with the count. scale, offset: of its ChannelSpec.
    """

    def __init__(
        self,
        encoder: EncoderSetup,
        counter_row: int,
        sample_rate_Hz: float,
        margins: Margins | None = None,
        capacity: int = 1 << 22,
        scale: float = 1.0,
        offset: float = 0.0,
    ) -> None:
        if sample_rate_Hz <= 0:
            raise ValueError(say("sample_rate_Hz is {}, must be positive", sample_rate_Hz))
        self.encoder = encoder
        self.margins = margins or Margins()
        self.sample_rate_Hz = sample_rate_Hz
        self._row = counter_row
        self._scale = scale
        self._offset = offset
        turn = encoder.counts_per_revolution
        parameters = np.zeros(int(ParameterAt.SIZE), np.int64)
        parameters[ParameterAt.COUNTS] = turn
        parameters[ParameterAt.DIRECTION] = encoder.direction
        parameters[ParameterAt.RESTARTS] = int(encoder.restarts_at_index)
        parameters[ParameterAt.MODULUS] = encoder.modulus
        parameters[ParameterAt.TOLERANCE] = math.ceil(
            max(1.0, min(MAXIMUM_ACCELERATION_REV_PER_S2 * turn / sample_rate_Hz**2, turn / 16))
        )
        parameters[ParameterAt.MISSED_AFTER] = max(4, turn // INDEX_NEAR)
        parameters[ParameterAt.IDLE_AFTER] = max(16, round(STANDSTILL_S * sample_rate_Hz))
        parameters[ParameterAt.CAPACITY] = capacity
        self._parameters = parameters
        self._state, self._mean_step = new_state()
        self._next_sample: int | None = None
        self._next_sequence: int | None = None
        self._host_time_ns = 0
        self._values: Values = np.empty((0, 0), np.float32)
        self._positions = np.empty(0, np.int64)
        self._ticks: NDArray[np.int64] | None = None
        self._scratch = np.empty(0, np.int64)
        self._counted = np.empty(0, np.int64)
        self._keep = np.empty(0, np.uint8)
        self._events = np.empty((0, int(EventAt.SIZE)), np.int64)
        self._origin = 0  # storage index of the buffer's first sample
        self._fill = 0
        self._begin: tuple[int, int] | None = None  # storage index, device sample
        self._breaks: deque[tuple[int, int]] = deque()
        self._waiting: deque[_Waiting] = deque()
        self.lost_samples = 0
        self.motion = Motion()

    def discard(self) -> None:
        """Discard the revolution in progress: the next one begins at the next index."""
        self._state[StateAt.INSIDE] = 0
        self._begin = None
        self._waiting.clear()

    def flag_time_jump(self) -> None:
        """Flag the revolution in progress: device and host time differ."""
        self._state[StateAt.FLAGS] |= int(Flag.TIME_JUMP)

    @property
    def ordinal(self) -> int:
        """Return the ordinal of the revolution in progress."""
        return int(self._state[StateAt.ORDINAL])

    def push(self, block: Block, ticks: NDArray[np.int64] | None = None) -> list[Revolution]:
        """Add a Block and return the revolutions that it completes, in order.

        ticks: (samples,) time of each sample in ns, with the encoder as clock.
        """
        n = block.values.shape[1]
        lost = self._lost_before(block)
        self._next_sample = block.first_sample + n
        self._next_sequence = block.sequence + 1
        self._host_time_ns = block.host_time_ns
        if n == 0:
            return []
        self.lost_samples += max(lost, 0)
        self.motion.gap = lost
        if n > self._scratch.size:
            self._scratch = np.empty(2 * n, np.int64)
            self._counted = np.empty(2 * n, np.int64)
            self._keep = np.empty(2 * n, np.uint8)
            self._events = np.empty((4 * n, int(EventAt.SIZE)), np.int64)
        position, keep, events = self._scratch[:n], self._keep[:n], self._events
        counts, quality = self._counts(block, self._counted[:n])
        kept_before = int(self._state[KEPT])
        count = scan(
            counts,
            quality,
            block.first_sample,
            lost,
            self._state,
            self._mean_step,
            self._parameters,
            position,
            keep,
            events,
        )
        kept = int(self._state[KEPT]) - kept_before
        self._append(block.values, position, keep, kept, ticks)
        if kept_before == 0:
            self._breaks.append((0, block.first_sample))
        for event in events[:count]:
            self._handle_event(event, block, n)
        self._update_motion(position)
        return self._ready()

    def unfinished(self) -> Revolution | None:
        """Return the samples of the revolution in progress, flagged PARTIAL; None without any.

        The revolution is not affected. Call it from the thread of ``push``, or while that waits.
        """
        end = self._origin + self._fill
        if self._begin is None or self._begin[0] >= end:
            return None
        state, (start, begin_sample) = self._state, self._begin
        event = np.zeros(int(EventAt.SIZE), np.int64)
        event[EventAt.SAMPLE] = self._next_sample or 0
        event[EventAt.ORDINAL] = state[StateAt.ORDINAL]
        event[EventAt.FLAGS] = int(state[StateAt.FLAGS]) | int(Flag.PARTIAL)
        event[EventAt.LOST] = state[StateAt.LOST]
        event[EventAt.IDLE] = state[StateAt.IDLE]
        event[EventAt.END_POSITION] = state[StateAt.POSITION]
        return self._build(
            _Waiting(
                start=start,
                end=end,
                event=event,
                begin_sample=begin_sample,
                host_time_ns=self._host_time_ns,
                later_samples=0,
                base=int(state[StateAt.BASE]),
            )
        )

    def _lost_before(self, block: Block) -> int:
        if self._next_sample is None or self._next_sequence is None:
            return 0
        missing = block.first_sample - self._next_sample
        if missing < 0:
            return -1
        if missing == 0 and block.sequence != self._next_sequence:
            return block.lost_before or -1
        return max(missing, block.lost_before)

    def _counts(
        self, block: Block, out: NDArray[np.int64]
    ) -> tuple[NDArray[np.int64], NDArray[np.uint8]]:
        raw = block.values[self._row]
        quality = np.ascontiguousarray(block.quality, np.uint8)
        if counted(raw, self._scale, self._offset, out):
            return out, quality
        # A count of NaN: use the last valid one and flag it.
        signal = raw.astype(np.float64) * self._scale + self._offset
        good = np.isfinite(signal)
        last_valid = np.maximum.accumulate(np.where(good, np.arange(signal.size), -1))
        last = float(self._state[StateAt.PREVIOUS] * self.encoder.direction)
        signal = np.where(last_valid >= 0, signal[np.maximum(last_valid, 0)], last)
        quality = quality | np.where(good, 0, 8).astype(np.uint8)
        return np.rint(signal).astype(np.int64), quality

    def _append(
        self,
        values: Values,
        position: NDArray[np.int64],
        keep: NDArray[np.uint8],
        kept: int,
        ticks: NDArray[np.int64] | None,
    ) -> None:
        if kept == 0:
            return
        if ticks is not None and self._ticks is None:
            self._ticks = np.empty(self._positions.size, np.int64)
        self._reserve(kept, values)
        if self._ticks is not None and ticks is not None:
            inside = ticks if kept == position.size else ticks[keep.astype(bool)]
            self._ticks[self._fill : self._fill + kept] = inside
        target = slice(self._fill, self._fill + kept)
        if kept == position.size:
            self._values[:, target] = values
            self._positions[target] = position
        else:
            mask = keep.astype(bool)
            self._values[:, target] = values[:, mask]
            self._positions[target] = position[mask]
        self._fill += kept

    def _oldest_needed(self) -> int:
        """Return the storage index of the oldest sample that is still needed."""
        newest = self._origin + self._fill
        if self._waiting:
            first = self._waiting[0].start
        elif self._begin is not None:
            first = self._begin[0]
        else:
            first = newest
        return max(self._origin, first - self.margins.before)

    def _reserve(self, kept: int, values: Values) -> None:
        if self._fill + kept <= self._positions.size and self._values.dtype == values.dtype:
            return
        oldest = self._oldest_needed()
        start = oldest - self._origin
        needed = self._fill - start
        size = max(FIRST_BUFFER, 4 * (needed + kept))
        # A new buffer instead of moving the data: revolutions are views that may still be in use.
        grown = np.empty((values.shape[0], size), values.dtype)
        positions = np.empty(size, np.int64)
        if needed:
            grown[:, :needed] = self._values[:, start : self._fill]
            positions[:needed] = self._positions[start : self._fill]
        if self._ticks is not None:
            times = np.empty(size, np.int64)
            times[:needed] = self._ticks[start : self._fill]
            self._ticks = times
        self._values, self._positions = cast(Values, grown), positions
        self._origin, self._fill = oldest, needed

    def _handle_event(self, event: NDArray[np.int64], block: Block, n: int) -> None:
        kind, kept, sample = (
            int(event[EventAt.KIND]),
            int(event[EventAt.KEPT]),
            int(event[EventAt.SAMPLE]),
        )
        if kind == BREAK:
            self._breaks.append((kept, sample))
            return
        if kind == CUT and self._begin is not None:
            start, begin_sample = self._begin
            self._waiting.append(
                _Waiting(
                    start=start,
                    end=kept,
                    event=event.copy(),
                    begin_sample=begin_sample,
                    host_time_ns=block.host_time_ns,
                    later_samples=max(0, block.first_sample + n - sample),
                    base=int(event[EventAt.BASE]),
                )
            )
        self._begin = (kept, sample)

    def _update_motion(self, position: NDArray[np.int64]) -> None:
        motion, turn = self.motion, self.encoder.counts_per_revolution
        first, last, locked, unlocked, motion.skips = _motion_in(self._state.tolist())
        motion.turned_in_gap = first - motion.travel[1]
        motion.travel = (first, last)
        motion.count = int(position[-1])
        motion.phase = motion.count % turn
        motion.locked = bool(locked)
        motion.turned_without_index = 0.0 if motion.locked else abs(unlocked) / turn

    def _ready(self) -> list[Revolution]:
        end = self._origin + self._fill
        done: list[Revolution] = []
        while self._waiting and self._waiting[0].end + self.margins.after <= end:
            done.append(self._build(self._waiting.popleft()))
        if not self._waiting:
            oldest = self._begin[0] if self._begin is not None else end
            while len(self._breaks) > 1 and self._breaks[1][0] <= oldest - self.margins.before:
                self._breaks.popleft()
        return done

    def _build(self, item: _Waiting) -> Revolution:
        start, end = item.start, item.end
        segments: list[tuple[int, int]] = [(0, item.begin_sample)]
        first = start - self.margins.before
        last = min(end + self.margins.after, self._origin + self._fill)
        for kept, sample in self._breaks:
            if kept <= start:
                first = max(first, kept)
            elif kept < end:
                segments.append((kept - start, sample))
            else:
                last = min(last, kept)
                break
        first = max(first, self._origin)
        event = item.event
        offset = self._origin
        counts = self._positions[start - offset : end - offset] - item.base
        revolution = Revolution(
            ordinal=int(event[EventAt.ORDINAL]),
            values=self._values[:, first - offset : last - offset],
            before=start - first,
            counts=counts,
            end_count=int(event[EventAt.END_POSITION]) - item.base,
            segments=np.array(segments, np.int64),
            first_sample=item.begin_sample,
            end_sample=int(event[EventAt.SAMPLE]),
            sample_rate_Hz=self.sample_rate_Hz,
            host_time_ns=item.host_time_ns,
            later_samples=item.later_samples,
            lost_samples=int(event[EventAt.LOST]),
            idle_samples=int(event[EventAt.IDLE]),
            skipped_counts=int(event[EventAt.SKIPPED]),
            flags=Flag(int(event[EventAt.FLAGS])),
        )
        if self._ticks is None:
            return revolution
        ticks = self._ticks[: self._fill]
        around = slice(first - offset, last - offset)
        return _timed(revolution, ticks[around], ticks[start - offset : end - offset + 1])


def _timed(
    revolution: Revolution, ticks: NDArray[np.int64], inside: NDArray[np.int64]
) -> Revolution:
    """Return a revolution in ticks. inside: ticks of its samples and of the first after it.

    A long time between two pulses is a standstill, which is idle beyond STANDSTILL_S.
    """
    if inside.size <= revolution.samples:  # no sample after it yet
        inside = np.append(inside, 2 * inside[-1] - inside[-2] if inside.size > 1 else inside[-1])
    idle = np.maximum(np.diff(inside) - round(STANDSTILL_S * TICKS_PER_S), 0)
    nominal = TICKS_PER_S / revolution.sample_rate_Hz
    return replace(
        revolution,
        ticks=ticks,
        first_sample=int(inside[0]),
        end_sample=int(inside[-1]),
        sample_rate_Hz=TICKS_PER_S,
        later_samples=round(revolution.later_samples * nominal),
        idle_samples=int(idle.sum()),
        flags=revolution.flags | (Flag.PAUSED if idle.any() else Flag.GOOD),
    )
