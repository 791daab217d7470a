"""Exchange packets with a RoboClaw: flush, send, wait, check, try again, count what went wrong."""

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
"""How many time-outs each try waits while nothing is to turn: a busy computer, or a busy USB, may
be late by the same time again and again, so that more of the same wait would not help."""
LATENCY_MARGIN: Final = 1.5
"""The first try waits for so many latencies, once answers were late."""
QUIET_S: Final = 0.012  # longer than the 10 ms after which the drive forgets a packet
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

    Not thread-safe but for ``request_stop`` and ``overtake``: the driver holds its lock around
    every other call. ``hurry`` ends the tries of a call under way, so that a stop need not wait for
    them. ``stop_requests`` counts; a write is not sent when it has changed since its caller began.

    ``standing``: nothing is commanded to turn, so that a question may wait for its answer longer.

    An answer names its question by its checksum alone, an acknowledgement not at all. So after a
    try that was repeated in silence the answers to the others are let pass, while nothing turns;
    when they come, the line is slow, and from then on a first try waits for its latency.

    What the line spoils is counted (``crc_errors``, ``retries``, ``late_bytes``), and a packet that
    came through only when repeated goes to the log: neither says anything of the drive.
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
        """Return what to do about answers that are late, "" where none was."""
        return self._questions.words()

    def request_stop(self) -> None:
        """End the tries of a call under way, and forbid the writes that were begun before."""
        with self._sending:
            self.stop_requests += 1
            self.hurry.set()

    def overtake(self, command: int, *values: int) -> None:
        """Send a write in the middle of a call under way; nobody waits for the answer."""
        packet = write_packet(self.address, command, *values, generation=self.generation)
        with self._sending:
            self._serial.write(packet)

    def read(self, command: int, tries: int | None = None) -> tuple[int, ...]:
        """Return the numbers of a reply; tries: None for as many as the motion allows.

        Raises ReplyTimeout when nothing came, ProtocolError when what came was wrong every time,
        DeviceLost when the port broke.
        """

        def exchange(time_outs: float) -> tuple[int, ...] | Rejected:
            raw = self._ask(command, time_outs)
            return parse_values(self.address, command, raw, self.generation)

        if tries is None and self.standing:
            return self._repeat(command, exchange, STANDING_TRIES)
        return self._repeat(command, exchange, self._waits(TRIES if tries is None else tries))

    def version(self) -> str:
        """Return the firmware text, the first that a drive is asked for; errors as ``read``."""

        def exchange(time_outs: float) -> str | Rejected:
            return parse_version(self.address, self._ask(Command.VERSION, time_outs))

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

        in_effect: reads the drive's state back after a failed try; when it tells that the write has
        taken effect, nothing is sent again. stop_requests: when the caller began; None for a write
        that a stop does not forbid. read_back: only ``in_effect`` counts, whatever was
        acknowledged: an FF has no number, and may be a late one of an earlier write. Errors as
        ``read``, and DeviceFault when a stop came.
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
                    self._tell_repeated(_UNACKNOWLEDGED)
                    return
            self._send(packet, stop_requests)
            answer = self._acknowledgement(self._reply_timeout(len(packet) + 1), time_outs)
            if answer == ACKNOWLEDGE and "" in failures:
                self._outwait(first_s)
            if answer == ACKNOWLEDGE and (not read_back or in_effect is None or in_effect()):
                if failures:
                    self._tell_repeated(_UNACKNOWLEDGED)
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
        """Return the first byte that comes, b"" when none does; a stop waits one time-out only."""
        deadline = time.monotonic() + time_outs * time_out_s
        while True:
            left = deadline - time.monotonic()
            answer = self._serial.read_some(1, min(max(left, 0.0), time_out_s))
            if answer or left <= 0.0 or self.hurry.is_set():
                return answer

    def _waits(self, tries: int) -> tuple[float, ...]:
        """Return how many time-outs each try waits: more at first on a line that is slow.

        While the crank may turn they are as many in all as there are tries.
        """
        first = LATENCY_MARGIN * self._questions.late_s / self._timeout_s
        if first <= 1.0:
            return (1.0,) * tries
        if self.standing:
            return (min(first, GIVEN_UP), *(1.0,) * (tries - 1))
        first = min(first, TRIES - 1.0)
        return (first,) if tries == 1 else (first, max(1.0, tries - first))

    def _outwait(self, first_s: float) -> None:
        """Let answers to tries that were repeated too early pass, and measure how late they are.

        first_s: when the first try was sent. Answers come in the order of the tries, so the one
        that was taken is the first one's where others follow; where none does, it was lost.
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
                # Where nothing came the line was quiet, and a reply that is late may come yet.
                self.wait_for_quiet()
            result = exchange(time_outs)
            if not isinstance(result, Rejected):
                if "" in failures:
                    self._outwait(first_s)
                for reason in sorted(because):
                    self._tell_repeated(reason)
                return result
            quiet, cut = result.sentence.startswith("0 "), result.kind == "short"
            said = say("a truncated answer ‹{}›", result.sentence) if cut else result.sentence
            failures.append("" if quiet else said)
            because.add(_REPEATED_BECAUSE.get(result.kind, _NO_REPLY))
            self.crc_errors += result.kind == "crc"
            if self.hurry.is_set():
                break
        raise self._failure(command, failures)

    def _tell_repeated(self, reason: str) -> None:
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

    def _ask(self, command: int, time_outs: float) -> bytes:
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
        """Wait until the line is silent for longer than the drive's own packet time-out."""
        deadline = time.monotonic() + self._reply_timeout(LONGEST_REPLY)
        while late := self._serial.read_some(LONGEST_REPLY, QUIET_S):
            self.late_bytes += len(late)
            if time.monotonic() > deadline:
                return
