"""Run one stream: drain the port, make Blocks, restart after a mismatch, monitor silence."""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from collections import deque
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_drivers.api import (
    Block,
    DeviceError,
    DeviceLost,
    InputFault,
    InputFaultKind,
    ProtocolError,
    ReplyTimeout,
    SettingsLost,
)
from rigapp_drivers.dataq.link import READ_BYTES, Link
from rigapp_drivers.dataq.plan import Plan
from rigapp_drivers.dataq.protocol import Clock, echoes_of, line, start_line
from rigapp_drivers.dataq.scans import Run, ScanParser

Ints = NDArray[np.int64]

_PULSES = (1 << 32) - 1


@dataclass(slots=True)
class CountDirection:
    """Track direction and index from block to block.

    direction_line, index_line: numbers of the digital lines of B and Z; None: not connected.
    """

    direction_line: int | None = None
    index_line: int | None = None
    _count: int = 0
    _pulses: int | None = None
    _index_was_high: bool = False

    def counts(self, lines: Ints, pulses: Ints) -> NDArray[np.int32]:
        """Return the count of each scan.

        lines: (n,) states of the digital lines as bits. pulses: (n,) pulses of line A so far,
        modulo 2**32; those of lost scans count in the direction of the next scan.
        """
        before = pulses[0] - 1 if self._pulses is None else self._pulses
        steps = np.diff(pulses, prepend=before) & _PULSES
        if self.direction_line is not None:
            steps = np.where(lines >> self.direction_line & 1, -steps, steps)
        count = self._count + np.cumsum(steps)
        if self.index_line is not None:
            count -= self._set_to_zero(count, (lines >> self.index_line & 1).astype(np.bool_))
        self._count, self._pulses = int(count[-1]), int(pulses[-1])
        return count.astype(np.int32)

    def _set_to_zero(self, count: Ints, high: NDArray[np.bool_]) -> Ints:
        """Return the offset of each count by the latest index; 0 before the first."""
        before = np.concatenate(([self._index_was_high], high[:-1]))
        self._index_was_high = bool(high[-1])
        last_edge = np.maximum.accumulate(np.where(high & ~before, np.arange(count.size), -1))
        return np.where(last_edge >= 0, count[last_edge], 0)


_log = logging.getLogger(__name__)

_SLICE_S: Final = 0.05  # maximum delay until a stop is noticed
_LATENESS_S: Final = 0.01  # normal lateness of a wake-up on an idle computer
_MOST_SENTENCES: Final = 100  # per test; the counters continue
_MOST_RESTARTS: Final = 3  # a line with repeated losses is faulty
_HEALTHY_SCANS: Final = 1000  # scans without a loss that reset the count of restarts
_STUCK_REVOLUTIONS: Final = 2.0  # crank signals repeat every turn; one constant for two is stuck


@dataclass(frozen=True, slots=True)
class Pace:
    """Time-outs of a stream, in s."""

    block_s: float
    silence_s: float
    idle_check_s: float


@dataclass(slots=True)
class Tally:
    """Counts of errors since the start; ``sentences`` holds the last hundred messages.

    lost_scans: by the counter (encoder clock) or by the host's clock (internal clock).
    """

    gaps: int = 0
    lost_scans: int = 0
    restarts: int = 0
    faults: tuple[InputFault, ...] = ()
    sentences: deque[str] = field(default_factory=lambda: deque(maxlen=_MOST_SENTENCES))


class Stream:
    """Scan by a plan; one thread reads, any thread may stop.

    The port is read only if no Block is waiting, which bounds the buffer to one read.
    rate: as reported by the device after the set-up, to detect a restart; empty if its firmware
    does not report it.
    """

    def __init__(self, link: Link, plan: Plan, pace: Pace, rate: str = "") -> None:
        self.tally = Tally()
        self._link = link
        self._plan = plan
        self._pace = pace
        self._start = start_line(plan.clock)
        self._parser = ScanParser(plan.layout, plan.steps, echoes_of(self._start))
        self._rows = len(plan.channels)
        has_lines = plan.direction_line is not None or plan.index_line is not None
        self._direction = (
            CountDirection(plan.direction_line, plan.index_line) if has_lines else None
        )
        self._block_bytes = max(
            1, round(2.0 * plan.layout.words * plan.sample_rate_Hz * pace.block_s)
        )
        self._lock = threading.Lock()
        self._running = False
        self._chunks: list[bytes] = []
        self._waiting = 0
        self._oldest_s = 0.0
        self._silent_s = 0.0
        self._blocks: deque[Block] = deque()
        self._sequence = 0
        self._next_sample = 0
        self._anchor = (0, 0)
        self._bad_restarts = 0
        self._rate = rate
        self._still = np.zeros(plan.layout.analog, np.int64)

    @property
    def running(self) -> bool:
        """Return whether the stream was started and has neither stopped nor failed."""
        return self._running

    def start(self) -> None:
        """Set the counter to 0 and start scanning."""
        with self._lock:
            self._link.set(line("reset", 1))
            nuls = (self._link.tail + self._link.port.drain()).count(0)
            self._parser.echoes = echoes_of(self._start, nuls)
            self._begin()
            self._anchor = (time.monotonic_ns(), 0)
            self._running = True

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block; raise DeviceLost, ProtocolError."""
        deadline = time.monotonic() + timeout_s
        while not self._blocks:
            left = deadline - time.monotonic()
            with self._lock:
                if not self._running:
                    break
                self._pump(max(0.0, min(left, _SLICE_S, self._pace.block_s)))
            if left <= 0.0:
                break
        return self._blocks.popleft() if self._blocks else None

    def stop(self) -> None:
        """Stop scanning and keep the samples received before; raise ReplyTimeout, DeviceLost."""
        if not self._running:
            return
        self._running = False
        patience_s = 5.0 * self._link.reply_timeout_s + 1.0
        if not self._lock.acquire(timeout=patience_s):
            raise ReplyTimeout.at(
                self._link.port, "the device is busy for {:g} s ‹reading thread›.", patience_s
            )
        try:
            self._end()
        finally:
            self._lock.release()

    # --- bytes ----------------------------------------------------------------------------------

    def _begin(self) -> None:
        self._link.port.write(self._start)
        self._silent_s = 0.0

    def _end(self) -> None:
        """Stop the device and process its remaining bytes."""
        data = self._halt()
        self._keep(data)
        if self._waiting:
            self._parse()
        for run in self._parser.finish():
            self._add(run, time.monotonic_ns())

    def _halt(self) -> bytes:
        """Return the bytes before the echo of stop; raise DeviceLost without one in two tries."""
        for _ in range(2):
            data = self._link.stop()
            if data is not None:
                return data
        self._running = False
        raise DeviceLost.at(
            self._link.port,
            "it no longer answers stop; switch it off and on and check the cable.",
        )

    def _keep(self, data: bytes) -> None:
        if not data:
            return
        if not self._waiting:
            self._oldest_s = time.monotonic()
        self._chunks.append(data)
        self._waiting += len(data)

    def _pump(self, wait_s: float) -> None:
        began = time.monotonic()
        data = self._link.port.read_some(READ_BYTES, wait_s)
        now = time.monotonic()
        if data:
            self._silent_s = 0.0
            self._keep(data)
        else:
            # Delays of this thread do not count as silence of the device.
            self._silent_s += min(now - began, wait_s + _LATENESS_S)
            if self._silent_s >= self._patience_s():
                self._silence(self._silent_s)
        full = self._waiting >= self._block_bytes
        if self._waiting and (full or now - self._oldest_s >= self._pace.block_s):
            self._parse()
            if self._parser.broken is not None:
                self._restart(self._parser.broken)

    def _patience_s(self) -> float:
        if self._plan.clock is Clock.ENCODER:
            return self._pace.idle_check_s
        return self._pace.silence_s + 10.0 / self._plan.sample_rate_Hz

    def _silence(self, silent_s: float) -> None:
        """Check a silent device: with the encoder clock the shaft may be stationary."""
        if self._plan.clock is Clock.ENCODER:
            self._end()
            self._require_settings()
            self._parser.restart(clean=True)
            self._begin()
            self._sign_of_life()
            return
        self._halt()
        self._running = False
        raise SettingsLost.at(
            self._link.port,
            (
                "no data for {:.1f} s though it answers: it was probably reset (power, USB) and"
                " has lost its settings and its count; connect it again and find the index again."
            ),
            silent_s,
        )

    def _require_settings(self) -> None:
        """Raise SettingsLost if an idle device has restarted: it would scan other inputs."""
        if not self._rate or self._link.rate() == self._rate:
            return
        self._running = False
        raise SettingsLost.at(
            self._link.port,
            "it has restarted (power, USB) and has lost its settings and its count; connect"
            " it again and find the index again.",
        )

    def _parse(self) -> None:
        data = b"".join(self._chunks)
        self._chunks.clear()
        self._waiting = 0
        host_time_ns = time.monotonic_ns()
        for run in self._parser.feed(data):
            self._add(run, host_time_ns)
        if self._parser.broken is None:
            self._anchor = (host_time_ns, self._next_sample + self._parser.held)
            if self._parser.received >= _HEALTHY_SCANS:
                self._bad_restarts = 0

    def _restart(self, why: str) -> None:
        """Stop, flush and start again; raise ProtocolError after too many restarts."""
        self.tally.restarts += 1
        self._bad_restarts += 1
        self._log_sentence(
            say("data were lost or added on the line; the stream was restarted ‹{}›.", why)
        )
        if self._bad_restarts > _MOST_RESTARTS:
            with contextlib.suppress(DeviceError):
                self._halt()
            self._running = False
            raise ProtocolError.at(
                self._link.port,
                "{}, still so after {} restarts; check that the encoder drives the"
                " counter input, maximum_speed_rpm and maximum_acceleration_rev_per_s2,"
                " and that the device was not reset (its settings and its count are"
                " lost then).",
                why,
                _MOST_RESTARTS,
            )
        self._halt()
        self._parser.restart()
        self._begin()

    # --- Blocks ---------------------------------------------------------------------------------

    def _add(self, run: Run, host_time_ns: int) -> None:
        samples = run.values.shape[1]
        lost = run.lost_before
        if lost is None:
            lost = self._lost_by_time(host_time_ns)
        if lost:
            self.tally.gaps += 1
            self.tally.lost_scans += lost
            self._log_sentence(
                say("{} scans are missing before sample {}.", lost, self._next_sample + lost)
            )
        self._watch_stuck(run)
        if self._direction is not None:
            lines = run.values[self._plan.layout.analog].astype(np.int64)
            run.values[-1] = self._direction.counts(lines, run.values[-1].astype(np.int64))
        block = Block(
            device=self._link.port.device,
            sequence=self._sequence,
            first_sample=self._next_sample + lost,
            sample_rate_Hz=self._plan.sample_rate_Hz,
            host_time_ns=host_time_ns,
            values=run.values[: self._rows],
            quality=run.quality,
            lost_before=lost,
        )
        self._next_sample = block.first_sample + samples
        self._sequence += 1
        self._blocks.append(block)

    def _lost_by_time(self, host_time_ns: int) -> int:
        """Return the number of scans of the internal clock lost during a restart.

        It is 0 with the encoder clock, and before the first valid scan, where the index begins.
        """
        if self._plan.clock is Clock.ENCODER:
            return 0
        then_ns, then_sample = self._anchor
        passed = round((host_time_ns - then_ns) * 1e-9 * self._plan.sample_rate_Hz)
        discarded = 1  # the first scan of a stream
        begin = then_sample + passed - self._parser.received + discarded
        return max(1, begin - self._next_sample)

    def _sign_of_life(self) -> None:
        """Append a Block without samples: the device replies, the shaft is stationary."""
        block = Block(
            device=self._link.port.device,
            sequence=self._sequence,
            first_sample=self._next_sample,
            sample_rate_Hz=self._plan.sample_rate_Hz,
            host_time_ns=time.monotonic_ns(),
            values=np.empty((self._rows, 0), np.int32),
            quality=np.empty(0, np.uint8),
        )
        self._sequence += 1
        self._blocks.append(block)

    def _watch_stuck(self, run: Run) -> None:
        """Report inputs whose converter value is constant for two turns of the shaft."""
        travel = int(run.values[-1, -1]) - int(run.values[-1, 0])
        for row in range(self._plan.layout.analog):
            values = run.values[row]
            if values[0] != values[-1] or (values != values[0]).any():
                self._still[row] = 0
                continue
            self._still[row] += max(0, travel)
            name = self._plan.channels[row].name
            turns = self._still[row] / self._plan.pulses_per_revolution
            if turns >= _STUCK_REVOLUTIONS and not any(name in f.inputs for f in self.tally.faults):
                words = say(
                    (
                        "{} has shown the same value for {:.1f} turns; check its sensor,"
                        " amplifier and cable"
                    ),
                    name,
                    turns,
                )
                fault = InputFault(InputFaultKind.STUCK, (name,), words, time.monotonic_ns())
                self.tally.faults += (fault,)
                self._log_sentence(say("{}.", words))

    def _log_sentence(self, sentence: str) -> None:
        self.tally.sentences.append(sentence)
        _log.warning("%s on %s: %s", self._link.port.device, self._link.port.port, sentence)
