"""Exchange requests, responses and measured values with a GSV-8 over a byte port.

Responses arrive between measured values. A waiting command and the reading thread take turns at
the port: samples received by a command are kept for the reader, a response received by the reader
is passed to its command.
"""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from dataclasses import dataclass, field

from rigapp.texts import say
from rigapp_drivers.api import BytePort, ProtocolError, ReplyTimeout, SettingRefused
from rigapp_drivers.exchange import OpenQuestions
from rigapp_drivers.gsv8.frames import FrameLayout, Parsed, Response, Run, StreamParser, Tally
from rigapp_drivers.gsv8.protocol import Command, request
from rigapp_drivers.gsv8.words import status_words

_log = logging.getLogger(__name__)

_READ_BYTES = 1 << 18
_SLICE_S = 0.02  # maximum delay until a stop is noticed
_BUSY_STATUSES = frozenset((0x43, 0x5A, 0x92, 0x99))  # transmission error, or busy: retry
_DONE = (0x00, 0x01)
_FOREIGN_LIMIT = 3  # one may be a damaged frame; three in a row mean another setting
_MOST_KEPT_SAMPLES = 1 << 20  # 22 s at the highest rate without a reader


@dataclass(frozen=True, slots=True)
class TimedRun:
    """Samples and the time at which their last byte was read (``time.monotonic_ns``)."""

    run: Run
    host_time_ns: int


@dataclass(slots=True)
class Pending:
    """A pending request, and its response once received.

    reply: number of data bytes of the response; None: any. stray: a response of another length was
    received, which belongs to an earlier request.
    """

    command: Command
    reply: int | None
    sent_s: float
    response: Response | None = None
    stray: bool = False
    answered: threading.Event = field(default_factory=threading.Event)

    def fits(self, response: Response) -> bool:
        """Return whether a response may belong to the request."""
        return bool(response.status) or self.reply in (None, len(response.data))


class Link:
    """Communicate with one device; commands are serialised, one thread at a time reads the port.

    Up to 2**20 samples are buffered, then the oldest are dropped and counted as lost.
    ``checksum``: protect commands by a CRC-8.
    """

    def __init__(self, port: BytePort, reply_timeout_s: float = 1.0) -> None:
        self.port = port
        self.reply_timeout_s = reply_timeout_s
        self.checksum = False
        self.late_replies = 0
        self.retries = 0
        self._open = OpenQuestions(port.device, reply_timeout_s, "reply_timeout_s")
        self._parser = StreamParser()
        self._reading = threading.Lock()
        self._commanding = threading.Lock()
        self._keeping = threading.Lock()
        self._pending: Pending | None = None
        self._runs: deque[TimedRun] = deque()
        self._kept = 0

    @property
    def tally(self) -> Tally:
        """Return the counts of line errors since the layout was set."""
        return self._parser.tally

    def expect(self, layout: FrameLayout | None, *, hold: bool = False) -> None:
        """Discard all samples and expect frames of this layout; None: skip measured values.

        hold: return no sample before a complete frame follows it, see ``StreamParser``.
        """
        with self._reading:
            self._parser = StreamParser(layout, hold=hold)
            self.take()

    def command(
        self,
        command: Command,
        parameters: bytes = b"",
        *,
        reply: int = 0,
        tries: int = 3,
        patience: float = 1.0,
    ) -> bytes:
        """Send a request and return the data of the response, ``reply`` bytes.

        patience: factor on the time-out. Raises SettingRefused with the status in words,
        ReplyTimeout, ProtocolError, DeviceLost.
        """
        response = self.exchange(command, parameters, reply=reply, tries=tries, patience=patience)
        # The status "done, and more was changed" has no data, so it cannot answer a read.
        if response.status not in _DONE or (reply and response.status):
            raise SettingRefused.at(
                self.port, "{} was refused: {}.", command.words, status_words(response.status)
            )
        return response.data

    def exchange(
        self,
        command: Command,
        parameters: bytes = b"",
        *,
        reply: int | None = None,
        tries: int = 3,
        patience: float = 1.0,
    ) -> Response:
        """Send a request and return its response, whatever its status.

        reply: data bytes of a valid response; None: any. Raises ReplyTimeout, and ProtocolError if
        only responses of another length were received.
        """
        if not self._commanding.acquire(timeout=4.0 * tries * self.reply_timeout_s):
            raise self._timeout(command, say("the previous command is not finished"))
        stray = False
        try:
            self._outwait_posted()
            self._outwait_late_replies()
            waits = self._open.waits(tries)
            for attempt, time_outs in enumerate(waits):
                self.retries += bool(attempt)
                pending = self._send(command, parameters, reply)
                if not self._await(pending, patience * time_outs * self.reply_timeout_s):
                    stray |= pending.stray
                    continue
                assert pending.response is not None
                if attempt:
                    _log.warning(
                        "%s: %s was answered at try %d only",
                        self.port.device,
                        command.words,
                        attempt + 1,
                    )
                if pending.response.status in _BUSY_STATUSES and attempt < len(waits) - 1:
                    continue
                return pending.response
        finally:
            self._forget()
            self._commanding.release()
        if stray:
            raise ProtocolError.at(
                self.port,
                "{} was answered with a wrong length; check the firmware and that no"
                " other program uses the device.",
                command.words,
            )
        raise self._timeout(command, say("{} tries", tries))

    def post(
        self, command: Command, parameters: bytes = b"", *, reply: int | None = None
    ) -> Pending | None:
        """Send a request without waiting; None while another one is pending.

        The response is received while samples are read; call ``abandon`` if it is missing.
        """
        if not self._commanding.acquire(blocking=False):
            return None
        try:
            if self._pending is not None and not self._pending.answered.is_set():
                return None
            return self._send(command, parameters, reply)
        finally:
            self._commanding.release()

    def abandon(self, pending: Pending) -> None:
        """Stop waiting for the response to a posted request."""
        if self._pending is pending:
            self._forget()

    def one_frame(self, layout: FrameLayout) -> Run:
        """Request one measured value (while the device does not stream) and return it."""
        self.expect(layout)
        with self._commanding:
            self._outwait_posted()
            self._write(Command.GET_VALUE, b"")
            deadline = time.monotonic() + self.reply_timeout_s
            while time.monotonic() < deadline:
                self.read(_SLICE_S)
                runs = self.take()
                if runs:
                    return runs[0].run
        raise self._timeout(Command.GET_VALUE, say("no measured value received"))

    def read(self, timeout_s: float) -> None:
        """Read the port once, unless another thread is reading; wait up to timeout_s."""
        if self._reading.acquire(timeout=max(timeout_s, 0.0)):
            try:
                self._pump(timeout_s)
            finally:
                self._reading.release()

    def take(self) -> list[TimedRun]:
        """Return the received samples, oldest first."""
        with self._keeping:
            runs = list(self._runs)
            self._runs.clear()
            self._kept = 0
        return runs

    def _write(self, command: Command, parameters: bytes) -> None:
        self.port.write(request(command, parameters, checksum=self.checksum))

    def _send(self, command: Command, parameters: bytes, reply: int | None) -> Pending:
        pending = Pending(command, reply, time.monotonic())
        self._pending = pending
        self._parser.response_expected = True
        self._open.timeout_s = self.reply_timeout_s
        self._open.requested()
        self._write(command, parameters)
        return pending

    def _forget(self) -> None:
        self._pending = None
        self._parser.response_expected = False

    def _await(self, pending: Pending, timeout_s: float) -> bool:
        """Wait for a response; read the port unless another thread is reading."""
        deadline = time.monotonic() + timeout_s
        while not pending.answered.is_set():
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            if not self._reading.acquire(timeout=min(left, _SLICE_S)):
                continue
            try:
                if not pending.answered.is_set():
                    self._pump_for_answer(left)
            finally:
                self._reading.release()
        return True

    def _pump_for_answer(self, left_s: float) -> None:
        silent = not self._pump(min(left_s, 2.0 * _SLICE_S))
        # An incomplete frame must not hide the response that follows it.
        if silent and left_s < self.reply_timeout_s / 2.0 and self._parser.waiting_bytes:
            self._sort(self._parser.give_up_tail(), time.monotonic_ns())

    def _pump(self, timeout_s: float) -> bool:
        """Read and sort the available bytes; return whether there were any. Needs the read lock."""
        data = self.port.read_some(_READ_BYTES, timeout_s)
        if not data:
            return False
        host_time_ns = time.monotonic_ns()
        self._sort(self._parser.feed(data), host_time_ns)
        if self._parser.consecutive_foreign >= _FOREIGN_LIMIT:
            self._parser.consecutive_foreign = 0
            raise ProtocolError.at(
                self.port,
                "the measured values have another number of inputs or another format"
                " than the device was set to; stop the test, configure again and check"
                " object_map.",
            )
        return True

    def _sort(self, parsed: Parsed, host_time_ns: int) -> None:
        for response in parsed.responses:
            self._open.answered()
            pending = self._pending
            if pending is None or pending.answered.is_set():
                self.late_replies += 1
                continue
            if not pending.fits(response):
                self.late_replies += 1
                pending.stray = True
                continue
            pending.response = response
            self._parser.response_expected = False
            pending.answered.set()
        with self._keeping:
            for run in parsed.runs:
                self._keep(run, host_time_ns)

    def _keep(self, run: Run, host_time_ns: int) -> None:
        self._runs.append(TimedRun(run, host_time_ns))
        self._kept += run.values.shape[1]
        while self._kept > _MOST_KEPT_SAMPLES and len(self._runs) > 1:
            old = self._runs.popleft().run
            self._kept -= old.values.shape[1]
            lost = old.values.shape[1] + old.lost_before
            self._add_lost(lost)

    def _add_lost(self, lost: int) -> None:
        """Add lost samples to the oldest buffered run."""
        oldest = self._runs.popleft()
        run = Run(oldest.run.values, oldest.run.quality, oldest.run.lost_before + lost)
        self._runs.appendleft(TimedRun(run, oldest.host_time_ns))

    def _outwait_posted(self) -> None:
        """Wait for the response to a posted request: responses do not identify their request."""
        posted = self._pending
        if posted is not None:
            self._await(posted, self.reply_timeout_s / 2.0)
        self._forget()

    def _outwait_late_replies(self) -> None:
        """Wait for and discard late responses to requests that timed out."""
        self._forget()
        while until_s := self._open.open_until_s():
            self.read(min(_SLICE_S, max(0.0, until_s - time.monotonic())))

    def _timeout(self, command: Command, why: str) -> ReplyTimeout:
        if self._open.late_s:
            words = self._open.words()
            return ReplyTimeout.at(self.port, "no answer to {}; {}.", command.words, words)
        return ReplyTimeout.at(
            self.port,
            "no answer to {} within {:g} s ({}); check cable and power, and that no"
            " other program uses the device.",
            command.words,
            self.reply_timeout_s,
            why,
        )
