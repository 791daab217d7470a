"""Processing of Blocks: overload check, assembly, motion check, revolutions."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.judging.checks import PeakForce, SaturationWatch, full_samples
from rigapp.engine.samples.assembler import Assembler, Revolution
from rigapp.engine.samples.buffers import Means, RecentSignals
from rigapp.engine.samples.motion import MotionWindow, Point
from rigapp.engine.samples.sampleclock import TICKS_PER_S, EncoderClock
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.channels import LOAD_CELL, PROBES
from rigapp_drivers.api import Block, SampleClock


class SampleMonitor(Protocol):
    """Actions on samples; called in the processing thread."""

    def begun(self, sample: int) -> None:
        """Begin the test with this device sample."""

    def overload(self, force_N: float, beyond_range: bool) -> None:
        """Act on a force above the limit, or NaN; beyond_range: force_N is a lower bound."""

    def cut_off(self, inputs: frozenset[str], force_N: float, slowed: bool) -> bool:
        """Act on a force above the limit that only these saturated inputs show.

        slowed: the crank has lost speed. Returns whether the inputs count as saturated.
        """

    def saturated(self, inputs: frozenset[str]) -> None:
        """Act on a change of the inputs that stay at the end of their range, as channels."""

    def calm(self) -> None:
        """Act on a force within its limit again."""

    def motion(self, speed_rpm: float) -> None:
        """Act on the latest speed."""

    def revolution(self, revolution: Revolution) -> None:
        """Act on a revolution."""

    def lost(self, samples: int, seconds: float) -> None:
        """Act on lost samples: their number so far, and the duration of the gap."""


SLOWED_SHARE = 0.8
"""Share of the expected turn below which the crank was slowed by an obstacle. A drive holds its
speed within some per cent, and a broken cable does not slow the crank."""

BEFORE_S = 0.4
"""Window of the mean speed before a saturated sample, before a jam slows the crank."""

SAME_WINDOW = 0.95
"""Ratio from which a shorter window is used as it is, since the difference is invisible."""


@dataclass(slots=True, eq=False)
class Averaging:
    """Mean of the analog signals over a number of samples, for a zero."""

    wanted: int
    total: NDArray[np.float64]
    squares: NDArray[np.float64]
    samples: int = 0
    done: threading.Event = field(default_factory=threading.Event)

    def add(self, signals: NDArray[np.float64]) -> None:
        """Add signals (inputs, samples)."""
        self.total += signals.sum(axis=1)
        self.squares += (signals**2).sum(axis=1)
        self.samples += signals.shape[1]
        if self.samples >= self.wanted:
            self.done.set()

    @property
    def mean(self) -> NDArray[np.float64]:
        """Return the mean signals (inputs,)."""
        return np.asarray(self.total / max(self.samples, 1), np.float64)

    @property
    def noise(self) -> NDArray[np.float64]:
        """Return the standard deviations of one sample (inputs,)."""
        spread = self.squares / max(self.samples, 1) - self.mean**2
        return np.sqrt(np.maximum(spread, 0.0))


@dataclass(frozen=True, slots=True, eq=False)
class Live:
    """Latest sample: electrical signals and engineering values, by channel."""

    signals: Mapping[str, float]
    values: Mapping[str, float]
    count: float
    host_s: float


class Processor:
    """Processing of the Blocks of one connection; ``handle`` is for the processing thread.

    monitor: actions on the samples; set before the first block. next_sample: the expected device
    sample; saturated_until: that after the last block with a saturated sample.
    """

    monitor: SampleMonitor

    def __init__(
        self,
        calibration: Calibration,
        overload_N: Callable[[], float],
        real_time: bool,
    ) -> None:
        self._overload_N = overload_N
        by_encoder = calibration.counter.clock is SampleClock.ENCODER
        self._clock = (
            EncoderClock(calibration.sample_rate_Hz, calibration.counter.pulse_rate, real_time)
            if by_encoder
            else None
        )
        self._averaging: Averaging | None = None
        self._recent: RecentSignals | None = None
        self.index_seen = False
        self._discard = threading.Event()
        self._over = False
        self._saturation = SaturationWatch(calibration)
        self._set(calibration)
        self.assembler = Assembler(
            calibration.encoder,
            calibration.counter.row,
            calibration.sample_rate_Hz,
            calibration.margins,
            scale=calibration.counter.scale,
            offset=calibration.counter.offset,
        )
        self.motion = MotionWindow(
            calibration.encoder.counts_per_revolution,
            TICKS_PER_S if by_encoder else calibration.sample_rate_Hz,
            math.degrees(calibration.index_angle_rad),
        )
        self._newest: Block | None = None
        self._busy = threading.Lock()
        self.next_sample = 0
        self.saturated_until = 0

    def _set(self, calibration: Calibration) -> None:
        self.calibration = calibration
        self._peak = PeakForce(calibration)

    @property
    def saturated(self) -> frozenset[str]:
        """Return the inputs that stay at the end of their range, as channels."""
        return self._saturation.inputs

    @property
    def force_N(self) -> float:
        """Return |F| of the latest sample, NaN before the first."""
        live = self.live
        return math.nan if live is None else live.values["force"]

    @property
    def live(self) -> Live | None:
        """Return the latest sample, None before the first; computed at each call."""
        block, calibration = self._newest, self.calibration
        if block is None:
            return None
        newest = block.values[:, -1:]
        raw = newest[calibration.rows].astype(np.float64)
        host_s, angle = block.host_time_ns * 1e-9, None
        if self._peak.needs_angle or calibration.probes.correction is not None:
            angle = self.motion.angle_deg(host_s)
        counts = None if angle is None else calibration.counts_at(math.radians(angle))
        values = calibration.engineering(raw, counts)[:, 0]
        correction, pair = calibration.probes.correction, calibration.inputs_of(PROBES)
        if correction is not None:
            values[pair] = correction.at(
                None if angle is None else math.radians(angle),
                calibration.index_angle_rad,
                values[pair],
            )
        signals = calibration.signals(newest)[:, 0].tolist()
        named = dict(zip(calibration.names, values.tolist(), strict=True))
        named["force"] = math.hypot(*values[calibration.inputs_of(LOAD_CELL)])
        return Live(
            signals=dict(zip(calibration.names, signals, strict=True)),
            values=named,
            count=float(newest[calibration.counter.row, 0]),
            host_s=host_s,
        )

    def use(self, calibration: Calibration) -> None:
        """Use another calibration of the same inputs from the next block on; see ``set_tare``."""
        self._set(calibration)

    def set_tare(self, tare: Sequence[float], angle: float | None = None) -> None:
        """Use another tare from the next block on; not during a test.

        angle: of the crank when it was taken, rad, None if unknown.
        """
        self._set(self.calibration.with_tare(tare, angle))

    def begin_test(self) -> None:
        """Discard the revolution in progress at the next block; the next one starts at an index."""
        self._discard.set()

    def average(self, samples: int) -> Averaging:
        """Start averaging the next samples."""
        inputs = len(self.calibration.wires)
        averaging = Averaging(samples, np.zeros(inputs), np.zeros(inputs))
        self._averaging = averaging
        return averaging

    def listen(self, window_s: float) -> Means:
        """Return the signals of the last window_s; recording starts with the first call."""
        recent = self._recent
        if recent is None or recent.window_s < SAME_WINDOW * window_s:
            rate, inputs = self.calibration.sample_rate_Hz, len(self.calibration.wires)
            recent = RecentSignals(rate, window_s, inputs)
            self._recent = recent
        return recent.read()

    def unfinished(self, timeout_s: float = 1.0) -> Revolution | None:
        """Return the samples of the revolution in progress; thread-safe.

        None without samples, or if the processing thread is busy for longer than timeout_s.
        """
        if not self._busy.acquire(timeout=timeout_s):
            return None
        try:
            return self.assembler.unfinished()
        finally:
            self._busy.release()

    def handle(self, block: Block) -> None:
        """Process a block."""
        with self._busy:
            self._handle(block)

    def _handle(self, block: Block) -> None:
        n = block.values.shape[1]
        if n == 0:
            self.assembler.push(block)
            if self._clock is not None:
                self._add_standstill(
                    self._clock.quiet(block.host_time_ns), block.host_time_ns * 1e-9
                )
            return
        ticks = self._clock.times(block) if self._clock is not None else None
        if self._check_overload(block, ticks):
            self.saturated_until = block.first_sample + n
        if self._discard.is_set():
            self._discard.clear()
            self.assembler.discard()
            self.monitor.begun(block.first_sample if ticks is None else int(ticks[0]))
        assembler = self.assembler
        revolutions = assembler.push(block, ticks)
        self.next_sample = block.first_sample + n
        if assembler.motion.gap:
            self.motion.gap()
            gap_s = max(0, assembler.motion.gap) / self.calibration.sample_rate_Hz
            self.monitor.lost(assembler.lost_samples, gap_s)
        self._add_motion(block, n, ticks)
        for revolution in revolutions:
            self.monitor.revolution(revolution)

    def _check_overload(self, block: Block, ticks: NDArray[np.int64] | None) -> bool:
        """Check the force of all samples first; that of a saturated input is a lower bound.

        Returns whether a sample is flagged as saturated.
        """
        full = full_samples(block, self.calibration)
        count_and_step = self._extrapolated_count() if self._peak.needs_angle else None
        peak, limit_N = self._peak.of(block.values, count_and_step), self._overload_N()
        over = not peak <= limit_N
        saturated_samples, measured = None, peak
        if over and full is not None:
            pair = self.calibration.inputs_of(LOAD_CELL)
            saturated_samples = full[pair]
            unsaturated = block.values.compress(~saturated_samples.any(axis=0), axis=1)
            measured = self._peak.of(unsaturated, count_and_step)
        if not measured <= limit_N:
            known = measured if math.isnan(measured) else peak
            self.monitor.overload(known, beyond_range=known > measured)
        elif over and saturated_samples is not None:
            names = [self.calibration.names[i] for i in pair]
            inputs = frozenset(names[i] for i in np.flatnonzero(saturated_samples.any(axis=1)))
            slowed = self._slowed(block, int(np.argmax(saturated_samples.any(axis=0))), ticks)
            if self.monitor.cut_off(inputs, peak, slowed):
                self._saturation.mark(inputs)
        elif self._over:
            self.monitor.calm()
        self._over = over
        if self._saturation.look(full, block.values.shape[1]):
            self.monitor.saturated(self._saturation.inputs)
        return full is not None

    def _extrapolated_count(self) -> tuple[float, float] | None:
        """Return the count of the next sample and the counts per sample; None before the index.

        Extrapolated from the previous speed: the pin's weight is small, and samples are checked
        before they are assembled.
        """
        last = self.motion.newest()
        if last is None or last.phase is None:
            return None
        step = 1.0
        if self._clock is None:
            step = self.motion.counts_in(1.0, BEFORE_S)
        return last.phase + step, step

    def _slowed(self, block: Block, sample: int, ticks: NDArray[np.int64] | None) -> bool:
        """Return whether the crank lost speed from the sample before ``sample`` to the block's end.

        The load cell's filter delays the force relative to the count.
        """
        counter, turn = self.calibration.counter, self.calibration.encoder.counts_per_revolution
        newest, last = self._newest, self.motion.newest()
        if newest is None or last is None:
            return False
        times = ticks if ticks is not None else block.first_sample + np.arange(len(block.quality))
        times = np.append(last.sample, times)[sample:]
        counts = np.append(newest.values[counter.row, -1], block.values[counter.row])[sample:]
        steps = counter.scale * np.diff(counts.astype(np.float64))
        # The count restarts at the index, which is not a step of the crank.
        turned = np.abs((steps + turn / 2) % turn - turn / 2).sum()
        expected = self.motion.counts_in(times[-1] - times[0], BEFORE_S)
        # The resolution of the encoder is one count.
        return bool(turned <= SLOWED_SHARE * expected - 1.0)

    def _add_standstill(self, tick: int, host_s: float) -> None:
        """Record a block without pulses: the device works, the crank is stationary."""
        last = self.motion.newest()
        count = self.assembler.motion.travel[1]
        if last is None or tick > last.sample:
            phase = last.phase if last is not None else None
            self.motion.add(None, Point(tick, count, host_s, phase))
        self.monitor.motion(self.motion.speed_rpm())

    def _add_motion(self, block: Block, n: int, ticks: NDArray[np.int64] | None) -> None:
        host_s = block.host_time_ns * 1e-9
        motion = self.assembler.motion
        first, last = motion.travel
        phase = motion.phase if motion.locked else None
        begin, end = block.first_sample, block.first_sample + n - 1
        if ticks is not None:
            begin, end = int(ticks[0]), int(ticks[-1])
        self.motion.add(Point(begin, first, host_s, None), Point(end, last, host_s, phase))
        self._newest = block
        self.index_seen = self.index_seen or phase is not None
        recent = self._recent
        if recent is not None:
            recent.add(block.first_sample, self.calibration.signals(block.values))
            if recent.forgotten:
                self._recent = None
        averaging = self._averaging
        if averaging is not None:
            averaging.add(self.calibration.signals(block.values))
            if averaging.done.is_set():
                self._averaging = None
        self.monitor.motion(self.motion.speed_rpm())
