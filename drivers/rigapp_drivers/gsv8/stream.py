"""Cut the samples of a streaming GSV-8 into Blocks, and poll the device meanwhile.

It is polled at a low rate for lost data and input faults.
"""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rigapp_drivers.api import Block, DataOverrun, InputFault, InputFaultKind, Quality, ReplyTimeout
from rigapp_drivers.gsv8.frames import Response
from rigapp_drivers.gsv8.link import Link, Pending, TimedRun
from rigapp_drivers.gsv8.protocol import Command, u8
from rigapp_drivers.gsv8.words import ValueFault, decode_value_fault, status_words


class BlockMaker:
    """Collect runs of one stream and cut them into Blocks.

    rows: indices of the frame's objects, in the order of the Block's rows. A Block ends where
    samples are known to be lost, so that ``lost_before`` refers to its first sample.
    """

    def __init__(
        self, device: str, sample_rate_Hz: float, rows: Sequence[int], block_s: float
    ) -> None:
        self._device = device
        self._rate = sample_rate_Hz
        self._rows = list(rows)
        self._block_samples = max(1, round(sample_rate_Hz * block_s))
        self._block_ns = round(block_s * 1e9)
        self._runs: deque[TimedRun] = deque()
        self._held = 0
        self._sequence = 0
        self._next_sample = 0
        self._flag_loss = False
        self._sensor_broken = False

    def add(self, runs: Sequence[TimedRun]) -> None:
        """Add samples in chronological order."""
        self._runs.extend(runs)
        self._held += sum(timed.run.values.shape[1] for timed in runs)

    def flag_loss(self) -> None:
        """Flag the next Block: the device lost an unknown number of samples before it."""
        self._flag_loss = True

    def flag_sensor(self) -> None:
        """Flag all further Blocks: the device reported a broken sensor."""
        self._sensor_broken = True

    def ready(self, now_ns: int) -> bool:
        """Return whether a Block is full, or its oldest samples have waited long enough."""
        if self._held >= self._block_samples:
            return True
        return bool(self._runs) and now_ns - self._runs[0].host_time_ns >= self._block_ns

    def make(self) -> Block | None:
        """Return the next Block, None without samples."""
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


_log = logging.getLogger(__name__)

_OVERRUN = 0x91

Question = tuple[Command, bytes, int]
"""Command, parameters, number of data bytes of the response."""

_LOST_DATA: Question = (Command.GET_LAST_PROTOCOL_ERROR, u8(1), 4)  # 1: asynchronous errors
_FAULT: Question = (Command.GET_LAST_VALUE_ERROR, u8(1), 6)  # 1: the latest fault
_RESET: Question = (Command.RESET_STATUS, b"", 0)
_FAULT_EVERY = 4  # every fourth poll: lost data are more urgent than a broken wire, which persists
_MISSES_ALLOWED = 3  # with more unanswered polls a loss could be missed for long
_PATIENCE_S = 5.0  # a response may queue behind measured values of this time
_MOST_FAULTS = 64  # more than needed for one test


class StreamWatch:
    """Poll the device between measured values without waiting for responses.

    on_loss: called when the device reports lost data, unless ``stop_on_loss``, which raises
    DataOverrun. must_answer: raise ReplyTimeout after several unanswered polls, since lost data
    would not be noticed. on_broken: called when the device reports a broken sensor or cable.
    known: latest fault before the start, which is not reported again; a broken sensor is, without
    on_broken, since it may not have been repaired. ``last_fault``: latest reported input fault. A
    saturated input is polled for at once, a broken wire by every fourth poll. ``faults``: the last
    64, for any thread.
    """

    def __init__(
        self,
        link: Link,
        interval_s: float,
        stop_on_loss: bool,
        must_answer: bool,
        on_loss: Callable[[], None],
        on_broken: Callable[[], None],
        known: ValueFault | None = None,
    ) -> None:
        self.losses = 0
        self.last_fault: ValueFault | None = None
        self._link = link
        self._interval_s = interval_s
        self._stop_on_loss = stop_on_loss
        self._must_answer = must_answer
        self._on_loss = on_loss
        self._on_broken = on_broken
        self._pending: Pending | None = None
        self._next_s = time.monotonic() + interval_s
        self._queue: list[Question] = []
        self._known = known
        self._polls = 0
        self._misses = 0
        self.faults: tuple[InputFault, ...] = ()
        if known is not None and known.as_input_fault(0).kind is InputFaultKind.SENSOR_BROKEN:
            before = replace(
                known.as_input_fault(0), words=f"{known.words} (reported before the start)"
            )
            self.faults = (before,)
            _log.warning("%s: %s", link.port.device, before.words)

    def saturated(self) -> None:
        """Record a saturated input: the next poll requests which one."""
        if _FAULT not in self._queue:
            self._queue.append(_FAULT)

    def step(self) -> None:
        """Send the next poll when it is due, and process the response to the last."""
        now = time.monotonic()
        if self._pending is not None:
            self._check_pending(self._pending, now)
        if self._pending is None and now >= self._next_s:
            question = self._queue[0] if self._queue else self._regular()
            command, parameters, reply = question
            self._pending = self._link.post(command, parameters, reply=reply)
            if self._pending is not None:
                self._polls += 1
                del self._queue[:1]
            self._next_s = now + self._interval_s

    def _regular(self) -> Question:
        return _FAULT if self._polls % _FAULT_EVERY == _FAULT_EVERY - 1 else _LOST_DATA

    def _check_pending(self, pending: Pending, now_s: float) -> None:
        if pending.answered.is_set():
            self._pending = None
            self._misses = 0
            assert pending.response is not None
            self._take(pending.command, pending.response)
        elif now_s - pending.sent_s > max(_PATIENCE_S, self._link.reply_timeout_s):
            self._link.abandon(pending)
            self._pending = None
            self._misses += 1
            if self._misses >= _MISSES_ALLOWED and self._must_answer:
                raise ReplyTimeout.at(
                    self._link.port,
                    "it streams but did not answer {} {} times, so lost data would not"
                    " be noticed; check the cable and other programs.",
                    pending.command.words,
                    self._misses,
                )

    def _take(self, command: Command, response: Response) -> None:
        if response.status:
            _log.warning(
                "%s: %s was refused: %s",
                self._link.port.device,
                command.words,
                status_words(response.status),
            )
        elif command is Command.GET_LAST_VALUE_ERROR:
            self._take_fault(decode_value_fault(response.data))
        elif command is Command.GET_LAST_PROTOCOL_ERROR:
            self._take_error(int.from_bytes(response.data, "big"))

    def _take_fault(self, fault: ValueFault | None) -> None:
        if fault is not None and fault not in (self.last_fault, self._known):
            self.last_fault = fault
            report = fault.as_input_fault(time.monotonic_ns())
            self.faults = (*self.faults, report)[-_MOST_FAULTS:]
            _log.warning("%s: %s", self._link.port.device, fault.words)
            if report.kind is InputFaultKind.SENSOR_BROKEN:
                self._on_broken()

    def _take_error(self, code: int) -> None:
        if code == 0:
            return
        # Clear the report, so that the next loss is recognised as a new one.
        self._queue.append(_RESET)
        self._next_s = time.monotonic()
        if code != _OVERRUN:
            _log.warning("%s: %s", self._link.port.device, status_words(code))
            return
        self.losses += 1
        if self._stop_on_loss:
            raise DataOverrun.at(
                self._link.port,
                "the device dropped measured values because they were not read in time;"
                " lower sample_rate_Hz or free the computer.",
            )
        _log.warning("%s: the device dropped measured values", self._link.port.device)
        self._on_loss()
