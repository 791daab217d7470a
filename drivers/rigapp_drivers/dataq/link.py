"""Exchange command lines with an idle DATAQ instrument, and stop a scanning one.

``PROBE`` identifies an instrument on a port.
"""

from __future__ import annotations

import re
import time
from typing import Final

from rigapp.texts import say
from rigapp_drivers.api import BytePort, Identity, Probe, ProtocolError, ReplyTimeout
from rigapp_drivers.dataq.protocol import BadReply, Info, line, query_value, split_replies
from rigapp_drivers.exchange import NamedQuestions

READ_BYTES: Final = 1 << 18
TRIES: Final = 2  # a lost command is sent again; the echo confirms it
_SLICE_S: Final = 0.05  # maximum delay until a stop is noticed
_STOP: Final = line("stop")
_RATE: Final = line("rrate")
_SHOWN: Final = 40


class Link:
    """Communicate with one instrument; one thread at a time.

    heard: bytes received after the latest ``stop``, its echo included. A reply repeats its command,
    so that a late one is recognised and skipped. tail: bytes after the latest reply.
    """

    def __init__(self, port: BytePort, reply_timeout_s: float, pause_s: float) -> None:
        self.port = port
        self.reply_timeout_s = reply_timeout_s
        self.pause_s = pause_s
        self.heard = 0
        self.retries = 0
        self.tail = b""
        self._requested = NamedQuestions(port.device, reply_timeout_s, "reply_timeout_s")

    def set(self, command: bytes) -> None:
        """Send a command and wait for its echo; raise ReplyTimeout or ProtocolError."""
        echo = _words(command)
        reply = self._exchange(command)
        if reply.strip() != echo:
            raise ProtocolError.at(
                self.port,
                "{} was answered with {} instead of its echo; check that no other"
                " program uses the device, and switch it off and on.",
                repr(echo),
                repr(reply[:_SHOWN]),
            )
        time.sleep(self.pause_s)

    def query(self, info: Info, tries: int = TRIES) -> str:
        """Return an item of ``info``; raise ReplyTimeout or ProtocolError."""
        command = line("info", info.value)
        reply = self._exchange(command, tries)
        try:
            return query_value(command, reply)
        except BadReply as error:
            raise ProtocolError.at(
                self.port,
                "{}; check the port in the rig file, and that the device is in CDC mode.",
                error,
            ) from error

    def rate(self, tries: int = TRIES) -> str:
        """Return the set rate as reported by the device; raise ReplyTimeout, ProtocolError.

        Older firmware does not report it. It is one of the settings lost at power-off.
        """
        reply = self._exchange(_RATE, tries)
        try:
            return query_value(_RATE, reply)
        except BadReply as error:
            raise ProtocolError.at(self.port, "{}; check the device's firmware.", error) from error

    def stop(self) -> bytes | None:
        """Stop scanning and return the samples received before the echo; None without an echo.

        The echo is the last transmission: the line is quiet afterwards.
        """
        self.port.write(_STOP)
        data = b""
        deadline = time.monotonic() + self.reply_timeout_s
        while (left := deadline - time.monotonic()) > 0.0:
            data += self.port.read_some(READ_BYTES, min(left, _SLICE_S))
            self.heard = len(data)
            end = data.rfind(_STOP)
            if end >= 0:
                self.port.drain()
                return data[:end]
        return None

    def _exchange(self, command: bytes, tries: int = TRIES) -> str:
        """Send a command and return the reply; skip lines of other commands."""
        echo = _words(command)
        stray, rest = "", b""
        self._requested.timeout_s = self.reply_timeout_s
        self._requested.begin(echo)
        for attempt in range(tries):
            self.retries += bool(attempt)
            waits = self._requested.first_wait() if attempt == 0 and tries > 1 else 1.0
            self.port.write(command)
            self._requested.requested()
            deadline = time.monotonic() + waits * self.reply_timeout_s
            while (left := deadline - time.monotonic()) > 0.0:
                rest += self.port.read_some(READ_BYTES, min(left, _SLICE_S))
                self.tail = rest[rest.rfind(b"\r") + 1 :]
                lines, rest = split_replies(rest)
                for reply in filter(None, lines):
                    of_query = _question_of(reply)
                    if self._requested.is_answer(of_query):
                        self._requested.leave(answered=True)
                        return reply
                    stray = reply
        self._requested.leave(answered=False)
        if self._requested.late_s:
            words = self._requested.words()
            raise ReplyTimeout.at(self.port, "no answer in time; {} ‹{}›.", words, echo)
        if stray:
            return stray
        raise ReplyTimeout.at(
            self.port,
            "no answer within {:g} s, {} tries; check cable and power, and that the LED"
            " blinks yellow (CDC mode) ‹{}›.",
            self.reply_timeout_s,
            tries,
            echo,
        )


def _question_of(reply: str) -> str:
    """Return the repeated command of a reply; after that of a query follows its value."""
    words = {"info": 2, "rrate": 1}.get(reply.partition(" ")[0])
    return reply if words is None else " ".join(reply.split()[:words])


def _words(command: bytes) -> str:
    return command.rstrip(b"\r").decode("ascii").strip()


_REST_S: Final = 0.05  # by then the rest of another reply has arrived
_MOST_BYTES: Final = 4096
_SERIAL_DIGITS: Final = 8


def ask(port: BytePort, timeout_s: float) -> Identity | None:
    """Probe with ``info 1`` for its echo and a model number; nothing is set.

    A scanning instrument replies to ``stop`` only, which is not sent: its USB id identifies it.
    """
    port.write(b"\r")  # terminates an incomplete command of another probe
    port.read_some(_MOST_BYTES, min(timeout_s, _REST_S))
    link = Link(port, timeout_s, 0.0)
    try:
        model = link.query(Info.MODEL, tries=1)
        if not model.isalnum():
            return None
        firmware, serial = (
            link.query(info, tries=1) for info in (Info.FIRMWARE, Info.SERIAL_NUMBER)
        )
    except (ReplyTimeout, ProtocolError):
        return None
    return identity_of(model, firmware, serial, port.port)


def identity_of(model: str, firmware: str, serial: str, port: str) -> Identity:
    """Return the identity from the replies; the firmware version is in hundredths, in hex."""
    if re.fullmatch(r"[0-9A-Fa-f]+", firmware):
        firmware = version_words(int(firmware, 16))
    return Identity(
        say("DATAQ Instruments"), f"DI-{model}", firmware, serial[:_SERIAL_DIGITS], port
    )


def version_words(hundredths: int) -> str:
    """Return a firmware version in the manufacturer's notation."""
    return f"{hundredths // 100}.{hundredths % 100:02d}"


PROBE: Final = Probe(ask)
