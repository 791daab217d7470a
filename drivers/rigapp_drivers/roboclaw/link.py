"""Exchange packets with a RoboClaw: flush, send, wait, check, retry, count errors."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Sequence
from typing import Final, TypeVar

from rigapp.texts import joined, say
from rigapp_drivers.api import BytePort, DeviceFault, ProtocolError, ReplyTimeout
from rigapp_drivers.exchange import GIVEN_UP, OpenQuestions
from rigapp_drivers.roboclaw.protocol import (
    ACKNOWLEDGE,
    NEWER,
    Command,
    Generation,
    Rejected,
    missing_bytes,
    parse_values,
    parse_version,
    read_packet,
    write_packet,
)

TRIES: Final = 3  # one disturbed packet must not stop a test; three in a row are a fault
STANDING_TRIES: Final = (1, 2, 4, 6, 8, 10)
"""Wait of each try in time-outs while nothing is to turn: a busy computer or USB may cause the same
delay repeatedly, so that retries with the same wait would not help."""
LATENCY_MARGIN: Final = 1.5
"""Wait of the first try in measured latencies, once replies were late."""
QUIET_S: Final = 0.012  # longer than the 10 ms after which the drive discards a packet
LONGEST_REPLY: Final = 58  # bytes, of command 73
BITS_PER_BYTE: Final = 10
FLUSH_LIMIT: Final = 65536

_UNACKNOWLEDGED: Final = say("not acknowledged by FF")
_REPEATED_BECAUSE: Final = {"crc": say("a damaged answer")}
_NO_REPLY: Final = say("missing or short reply")

_Reply = TypeVar("_Reply")

_log = logging.getLogger(__name__)


class Link:
    """Send packets to one address and return checked replies.

    Only ``request_stop`` and ``overtake`` are thread-safe: the driver holds its lock around every
    other call. ``hurry`` ends the tries of a pending call, so that a stop need not wait for them.
    ``stop_requests`` counts stops; a write is not sent if it has changed since its caller began.

    ``standing``: no motion is commanded, so that a request may wait longer for its reply.

    A reply identifies its request only by the checksum, an acknowledgement not at all. So after a
    request was repeated without a reply, the replies to the other tries are discarded while nothing
    turns; if there are any, the line is slow, and the first try then waits for the latency.

    Line errors are counted (``crc_errors``, ``retries``, ``late_bytes``), and a packet that needed
    retries is logged: neither indicates a fault of the drive.
    """

    def __init__(
        self, serial: BytePort, device: str, port: str, address: int, baud: int, timeout_s: float
    ) -> None:
        self._serial = serial
        self.device = device
        self.port = port
        self.address = address
        self._byte_s = BITS_PER_BYTE / baud
        self._timeout_s = timeout_s
        self.generation: Generation = NEWER
        self.hurry = threading.Event()
        self.stop_requests = 0
        self.standing = True
        self.crc_errors = 0
        self.retries = 0
        self.late_bytes = 0
        self.last_sent_ns = time.monotonic_ns()
        self._sending = threading.Lock()
        self._questions = OpenQuestions(device, timeout_s, "reply_timeout_ms", 1000.0)

    @property
    def late_words(self) -> str:
        """Return the advice on late replies, "" if none was late."""
        return self._questions.words()

    def request_stop(self) -> None:
        """End the tries of a pending call, and block writes that began before."""
        with self._sending:
            self.stop_requests += 1
            self.hurry.set()

    def overtake(self, command: int, *values: int) -> None:
        """Send a write during a pending call without waiting for the acknowledgement."""
        packet = write_packet(self.address, command, *values, generation=self.generation)
        with self._sending:
            self._serial.write(packet)

    def read(self, command: int, tries: int | None = None) -> tuple[int, ...]:
        """Return the numbers of a reply; tries: None for the default, which depends on motion.

        Raises ReplyTimeout without a reply, ProtocolError if all replies were invalid, DeviceLost
        if the port failed.
        """

        def exchange(time_outs: float) -> tuple[int, ...] | Rejected:
            raw = self._request(command, time_outs)
            return parse_values(self.address, command, raw, self.generation)

        if tries is None and self.standing:
            return self._repeat(command, exchange, STANDING_TRIES)
        return self._repeat(command, exchange, self._waits(TRIES if tries is None else tries))

    def version(self) -> str:
        """Return the firmware text, the first read from a drive; errors as ``read``."""

        def exchange(time_outs: float) -> str | Rejected:
            return parse_version(self.address, self._request(Command.VERSION, time_outs))

        return self._repeat(Command.VERSION, exchange, STANDING_TRIES)

    def write(
        self,
        command: int,
        *values: int,
        in_effect: Callable[[], bool] | None = None,
        stop_requests: int | None = None,
        read_back: bool = False,
    ) -> None:
        """Send a write until it is acknowledged by FF.

        in_effect: reads the drive's state back after a failed try; if it returns True, nothing is
        sent again. stop_requests: count when the caller began; None for a write that a stop does
        not block. read_back: only ``in_effect`` counts, not the acknowledgement: an FF has no
        number and may be a late one of an earlier write. Errors as ``read``, and DeviceFault after
        a stop.
        """
        packet = write_packet(self.address, command, *values, generation=self.generation)
        self.write_packet(command, packet, in_effect, stop_requests, read_back)

    def write_packet(
        self,
        command: int,
        packet: bytes,
        in_effect: Callable[[], bool] | None = None,
        stop_requests: int | None = None,
        read_back: bool = False,
    ) -> None:
        """Send a packet that is already built; see ``write``."""
        failures: list[str] = []
        first_s = time.monotonic()
        for attempt, time_outs in enumerate(self._waits(TRIES)):
            if attempt:
                self.retries += 1
                self.wait_for_quiet()
                if in_effect is not None and in_effect():
                    self._log_repeated(_UNACKNOWLEDGED)
                    return
            self._send(packet, stop_requests)
            answer = self._acknowledgement(self._reply_timeout(len(packet) + 1), time_outs)
            if answer == ACKNOWLEDGE and "" in failures:
                self._outwait(first_s)
            if answer == ACKNOWLEDGE and (not read_back or in_effect is None or in_effect()):
                if failures:
                    self._log_repeated(_UNACKNOWLEDGED)
                return
            if answer == ACKNOWLEDGE:
                failures.append(say("acknowledged, and not in effect"))
            else:
                failures.append(
                    say("a wrong answer ‹{}, not FF›", answer.hex().upper()) if answer else ""
                )
            if self.hurry.is_set():
                break
        raise self._failure(command, failures)

    def _acknowledgement(self, time_out_s: float, time_outs: float) -> bytes:
        """Return the first byte received, b"" if none; a stop waits for one time-out only."""
        deadline = time.monotonic() + time_outs * time_out_s
        while True:
            left = deadline - time.monotonic()
            answer = self._serial.read_some(1, min(max(left, 0.0), time_out_s))
            if answer or left <= 0.0 or self.hurry.is_set():
                return answer

    def _waits(self, tries: int) -> tuple[float, ...]:
        """Return the wait of each try in time-outs: longer at first on a slow line.

        While the crank may turn their sum equals the number of tries.
        """
        first = LATENCY_MARGIN * self._questions.late_s / self._timeout_s
        if first <= 1.0:
            return (1.0,) * tries
        if self.standing:
            return (min(first, GIVEN_UP), *(1.0,) * (tries - 1))
        first = min(first, TRIES - 1.0)
        return (first,) if tries == 1 else (first, max(1.0, tries - first))

    def _outwait(self, first_s: float) -> None:
        """Discard late replies to tries that were repeated too early, and measure their latency.

        first_s: time of the first try. Replies arrive in the order of the tries, so the accepted
        one belongs to the first try if others follow; if none does, the first reply was lost.
        """
        if not self.standing:
            return
        latency_s = time.monotonic() - first_s
        until_s = self.last_sent_ns * 1e-9 + latency_s + 0.5 * self._timeout_s
        passed = 0
        while (left := until_s - time.monotonic()) > 0.0 and not self.hurry.is_set():
            passed += len(self._serial.read_some(LONGEST_REPLY, min(left, self._timeout_s)))
        self.late_bytes += passed
        if passed:
            self._questions.measure(latency_s)

    def _repeat(
        self,
        command: int,
        exchange: Callable[[float], _Reply | Rejected],
        tries: Sequence[float],
    ) -> _Reply:
        first = self._waits(1)[0]
        tries = [wait for wait in tries if wait >= first] or tries
        first_s = time.monotonic()
        failures: list[str] = []
        because: set[str] = set()
        for attempt, time_outs in enumerate(tries):
            if attempt:
                self.retries += 1
            if failures and failures[-1]:
                # Without any bytes the line was quiet, and a late reply may still arrive.
                self.wait_for_quiet()
            result = exchange(time_outs)
            if not isinstance(result, Rejected):
                if "" in failures:
                    self._outwait(first_s)
                for reason in sorted(because):
                    self._log_repeated(reason)
                return result
            quiet, cut = result.sentence.startswith("0 "), result.kind == "short"
            said = say("a truncated answer ‹{}›", result.sentence) if cut else result.sentence
            failures.append("" if quiet else said)
            because.add(_REPEATED_BECAUSE.get(result.kind, _NO_REPLY))
            self.crc_errors += result.kind == "crc"
            if self.hurry.is_set():
                break
        raise self._failure(command, failures)

    def _log_repeated(self, reason: str) -> None:
        _log.warning("%s on %s: a packet was repeated: %s", self.device, self.port, reason)

    def _failure(self, command: int, failures: list[str]) -> ProtocolError | ReplyTimeout:
        name = say("{} ({})", Command(command).name, command)
        reasons = list(dict.fromkeys(sentence for sentence in failures if sentence))
        if self.late_words:
            return ReplyTimeout.at(self, "no answer in time; {} ‹{}›.", self.late_words, name)
        if not reasons:
            return ReplyTimeout.at(
                self,
                "no reply in {} tries of {:.0f} ms or longer: check power, cable,"
                " address and baud rate ‹{}›.",
                len(failures),
                self._timeout_s * 1000.0,
                name,
            )
        return ProtocolError.at(
            self,
            "no usable reply in {} tries: {}: check the cable's screen and the baud rate ‹{}›.",
            len(failures),
            joined("; ", reasons),
            name,
        )

    def _reply_timeout(self, wire_bytes: int) -> float:
        return self._timeout_s + wire_bytes * self._byte_s

    def _send(self, packet: bytes, stop_requests: int | None = None) -> None:
        self.late_bytes += len(self._serial.read_some(FLUSH_LIMIT, 0.0))
        with self._sending:
            if stop_requests not in (None, self.stop_requests):
                raise DeviceFault.at(self, "a stop arrived before the speed was set.")
            self._serial.write(packet)
        self.last_sent_ns = time.monotonic_ns()

    def _request(self, command: int, time_outs: float) -> bytes:
        self._send(read_packet(self.address, command))
        raw = b""
        time_out_s = self._reply_timeout(2 + LONGEST_REPLY)
        deadline = time.monotonic() + time_outs * time_out_s
        while missing := missing_bytes(command, raw, self.generation):
            left = deadline - time.monotonic()
            part = self._serial.read_some(missing, min(max(left, 0.0), time_out_s))
            if not part and (left <= 0 or self.hurry.is_set()):
                break
            raw += part
        return raw

    def wait_for_quiet(self) -> None:
        """Wait until the line is silent for longer than the drive's packet time-out."""
        deadline = time.monotonic() + self._reply_timeout(LONGEST_REPLY)
        while late := self._serial.read_some(LONGEST_REPLY, QUIET_S):
            self.late_bytes += len(late)
            if time.monotonic() > deadline:
                return
