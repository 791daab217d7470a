"""Exchange Modbus frames: one request, one reply, a pause between frames, retries."""

from __future__ import annotations

import struct
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from pymodbus.framer.rtu import FramerRTU
from pymodbus.framer.socket import FramerSocket
from pymodbus.pdu import DecodePDU
from pymodbus.pdu.register_message import ReadHoldingRegistersRequest, ReadInputRegistersRequest

from rigapp.texts import say
from rigapp_drivers.api import BytePort, DeviceFault, ProtocolError, ReplyTimeout
from rigapp_drivers.exchange import NamedQuestions, OpenQuestions
from rigapp_drivers.modbus_sensor.bus import TCP, Bus

_REQUESTS: Final[Mapping[int, Any]] = {3: ReadHoldingRegistersRequest, 4: ReadInputRegistersRequest}
_FRAMER: Final = FramerRTU(DecodePDU(is_server=False))
_TCP_FRAMER: Final = FramerSocket(DecodePDU(is_server=False))
_HEADER: Final = 7  # of a TCP frame: transaction, protocol 0, length, device
_EXCEPTION: Final = 0x80  # bit of the function code of an exception reply
_BUSY: Final = 6
_BUSY_PAUSE_S: Final = 0.1
_EXCEPTIONS: Final = {
    1: say("illegal function"),
    2: say("illegal data address"),
    3: say("illegal data value"),
    4: say("server device failure"),
    5: say("acknowledge, still at work"),
    6: say("server device busy"),
}


@dataclass(frozen=True, slots=True)
class ModbusReply:
    """Reply of a device: register words, an exception, or the reason why it is invalid."""

    words: tuple[int, ...] = ()
    exception: str = ""
    wrong: str = ""
    busy: bool = False


def encode_request(
    device: int, function: int, address: int, count: int, transaction: int | None = None
) -> bytes:
    """Return the frame that reads ``count`` registers of a device from an address.

    transaction: of a frame for TCP; None: for a serial line.
    """
    message = _REQUESTS[function](device, transaction or 0, address, count)
    return bytes((_FRAMER if transaction is None else _TCP_FRAMER).buildFrame(message))


def find_reply(
    data: bytes, request: bytes, function: int, count: int, *, tcp: bool
) -> ModbusReply | None:
    """Return the reply among the bytes since a request, None while it is incomplete.

    Bytes before it are skipped: noise, the adapter's echo of the request, and frames of other
    devices or requests.
    """
    if tcp:
        start = data.find(request[:4])
        head = data[start : start + _HEADER]
        if start < 0 or len(head) < _HEADER:
            return None
        whole = data[start : start + 6 + int.from_bytes(head[4:6], "big")]
        _, pdu = _TCP_FRAMER.handleFrame(whole, 0, 0)
        return None if pdu is None else _checked(pdu, request[6], function, count)
    for start in range(len(data) - 4):
        if data[start] != request[0] or data[start + 1] & ~_EXCEPTION != function:
            continue
        length = 5 if data[start + 1] & _EXCEPTION else 5 + 2 * count
        frame = data[start : start + length]
        if len(frame) == length and crc_is_right(frame):
            return decode_reply(frame, request[0], function, count)
    return None


def crc_is_right(frame: bytes) -> bool:
    """Return whether a frame of a serial line ends with its checksum."""
    return FramerRTU.check_CRC(frame[:-2], int.from_bytes(frame[-2:], "big"))


def wrong_reply(data: bytes, request: bytes, function: int, count: int) -> ModbusReply | None:
    """Return why the received bytes are no valid reply, None if only the echo was received."""
    rest = data.removeprefix(request)
    if not rest:
        return None
    reply = decode_reply(rest, request[0], function, count)
    if reply is not None and reply.wrong:
        return reply
    return ModbusReply(wrong=say("a truncated answer ‹{} bytes›", len(rest)))


def decode_reply(data: bytes, device: int, function: int, count: int) -> ModbusReply | None:
    """Decode the bytes since a request; None while the frame is incomplete."""
    used, pdu = _FRAMER.handleFrame(data, 0, 0)
    if pdu is None:
        return ModbusReply(wrong=say("a damaged answer ‹wrong checksum›")) if used else None
    return _checked(pdu, device, function, count)


def _checked(pdu: Any, device: int, function: int, count: int) -> ModbusReply:
    if pdu.dev_id != device:
        return ModbusReply(wrong=say("an answer of device {}", pdu.dev_id))
    if pdu.isError():
        code = pdu.exception_code
        return ModbusReply(
            exception=say("a refusal ‹exception {}, {}›", code, _EXCEPTIONS.get(code, "unknown")),
            busy=code == _BUSY,
        )
    if pdu.function_code != function or len(pdu.registers) != count:
        return ModbusReply(
            wrong=say(
                "{} words to function {} instead of {} to {}",
                len(pdu.registers),
                pdu.function_code,
                count,
                function,
            )
        )
    return ModbusReply(tuple(pdu.registers))


TRIES: Final = 2
"""A line with less than one checksum error per day needs one; the second covers a disturbance."""
_MOST_BYTES: Final = 256  # an RTU frame (Modbus over serial line 1.02, 2.5.1)
_SILENT_CHARACTERS: Final = 3.5  # between frames, same place
_SHORTEST_PAUSE_S: Final = 0.00175  # above 19200 baud (Modbus over serial line 1.02, 2.5.1.1)
_BITS: Final = 11.0  # of a character with start, parity and stop


class ModbusLink:
    """Communicate with one device; one thread at a time.

    bus: the shared line; None if the device is alone on its line.
    """

    def __init__(
        self,
        port: BytePort,
        device: int,
        baud_rate: int,
        reply_timeout_s: float,
        bus: Bus | None = None,
    ) -> None:
        self.port = port
        self.device = device
        self.reply_timeout_s = reply_timeout_s
        self.crc_errors = 0
        self.retries = 0
        self.busy = 0
        self._tcp = port.port.startswith(TCP)
        self._byte_s = 0.0 if self._tcp else _BITS / baud_rate
        pause_s = max(_SILENT_CHARACTERS * self._byte_s, _SHORTEST_PAUSE_S)
        self._pause_s = 0.0 if self._tcp else pause_s
        self._transaction = 0
        self._named = NamedQuestions(port.device, reply_timeout_s, "reply_timeout_s")
        alone = OpenQuestions(port.device, reply_timeout_s, "reply_timeout_s")
        self._open = self._named if self._tcp else alone
        self.share(bus or Bus())

    def share(self, bus: Bus) -> None:
        """Share the line with other devices on a bus from now on."""
        self._bus = bus
        if self._open not in bus.questions:
            bus.questions.append(self._open)

    def read(
        self, function: int, address: int, count: int, deadline_s: float, tries: int = TRIES
    ) -> tuple[int, ...]:
        """Return the words of registers; deadline_s: on the monotonic clock, for all tries.

        A busy device is polled again until then. Raises ReplyTimeout, ProtocolError if all replies
        were damaged, DeviceFault for an exception reply, DeviceLost.
        """
        if not self._bus.lock.acquire(timeout=max(deadline_s - time.monotonic(), 0.0)):
            raise ReplyTimeout.at(
                self.port,
                "the other devices on this line left no time to ask it; give each a shorter"
                " reply_timeout_s.",
            )
        try:
            return self._read(function, address, count, deadline_s, tries)
        finally:
            self._bus.lock.release()

    def _read(
        self, function: int, address: int, count: int, deadline_s: float, tries: int
    ) -> tuple[int, ...]:
        wrong = ""
        for attempt in range(tries):
            left_s = deadline_s - time.monotonic()
            if attempt and left_s <= 0.0:
                break
            self.retries += bool(attempt)
            waits = self._open.first_wait() if attempt == 0 and tries > 1 else 1.0
            reply = self._request(function, address, count, left_s, waits)
            while reply is not None and reply.busy and time.monotonic() < deadline_s:
                self.busy += 1
                time.sleep(_BUSY_PAUSE_S)
                reply = self._request(
                    function, address, count, deadline_s - time.monotonic(), waits
                )
            if reply is None:
                continue
            if reply.exception:
                raise DeviceFault.at(
                    self.port,
                    "{} is answered by {}; check the settings against the device's manual.",
                    self._requested(function, address, count),
                    reply.exception,
                )
            if reply.words:
                return reply.words
            self.crc_errors += "checksum" in reply.wrong
            wrong = reply.wrong
        if wrong:
            raise ProtocolError.at(
                self.port,
                "{} was answered by {}; check the line, its termination, and that"
                " addresses are used once.",
                self._requested(function, address, count),
                wrong,
            )
        if self._open.late_s:
            raise ReplyTimeout.at(
                self.port,
                "no answer from {} within {:g} s; {}.",
                self._requested(function, address, count),
                self.reply_timeout_s,
                self._open.words(),
            )
        raise ReplyTimeout.at(
            self.port,
            "no answer from {} within {:g} s; check power, wires A and B, address, baud"
            " rate and parity.",
            self._requested(function, address, count),
            self.reply_timeout_s,
        )

    def _request(
        self, function: int, address: int, count: int, left_s: float, waits: float
    ) -> ModbusReply | None:
        """Send one request and wait ``waits`` time-outs; None without a reply."""
        if self._tcp:
            self._transaction = self._transaction % 0xFFFF + 1
            self._named.begin(self._transaction.to_bytes(2, "big"))
        else:
            self._outwait_late_replies()
            time.sleep(self._pause_s)
        transaction = self._transaction if self._tcp else None
        request = encode_request(self.device, function, address, count, transaction)
        stale = self.port.read_some(_MOST_BYTES, 0.0)
        self.port.write(request)
        self._open.requested()
        wire_s = (8 + 5 + 2 * count) * self._byte_s
        wait_s = waits * self.reply_timeout_s + wire_s
        deadline = time.monotonic() + min(wait_s, max(left_s, wire_s))
        data = stale if self._tcp else b""
        reply = None
        while reply is None:
            left_s = deadline - time.monotonic()
            data += self.port.read_some(_MOST_BYTES, max(left_s, 0.0))
            reply = find_reply(data, request, function, count, tcp=self._tcp)
            if reply is None and self._is_damaged(data, function, count):
                reply = wrong_reply(data, request, function, count)
            if left_s <= 0.0:
                break
        if self._tcp:
            self._account(data, request[:2], answered=reply is not None)
        elif reply is not None:
            self._open.answered()
        elif data:
            reply = wrong_reply(data, request, function, count)
        return reply

    def _account(self, data: bytes, transaction: bytes, *, answered: bool) -> None:
        """Measure the latency of late frames received over TCP."""
        self._named.leave(answered=answered)
        while len(data) >= _HEADER:
            if data[:2] != transaction:
                self._named.is_answer(data[:2])
            data = data[6 + int.from_bytes(data[4:6], "big") :]

    def _is_damaged(self, data: bytes, function: int, count: int) -> bool:
        """Return whether the reply is complete but damaged, so that waiting is useless."""
        own = data[:3] == bytes((self.device, function, 2 * count))
        return not self._tcp and own and len(data) == 5 + 2 * count

    def _outwait_late_replies(self) -> None:
        """Wait for and discard late replies to abandoned requests of any user.

        They do not identify their request.
        """
        for question in self._bus.questions:
            while until_s := question.open_until_s():
                if self.port.read_some(_MOST_BYTES, until_s - time.monotonic()):
                    question.answered()
                    # The rest of a frame arrives without a pause.
                    while self.port.read_some(_MOST_BYTES, self._pause_s):
                        pass

    def _requested(self, function: int, address: int, count: int) -> str:
        requested = say("function {}, {} from {} on", function, count, address)
        return say("the device at Modbus address {} ‹{}›", self.device, requested)


_REQUEST: Final = struct.Struct(">BBHH")  # then the CRC


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``."""

    def __init__(self) -> None:
        self._device = self._function = self._count = 0
        self._reply = b""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield the request: device, function, registers."""
        if self._reply:
            yield "(no whole answer: {})".format(self._reply.hex(" "))
        self._reply = b""
        if len(data) != _REQUEST.size + 2:
            yield data.hex(" ")
            return
        self._device, self._function, address, self._count = _REQUEST.unpack(data[:-2])
        requested = f"{self._count} registers from {address} on"
        yield f"device {self._device}, function {self._function}: {requested}"

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the complete reply as unsigned words."""
        self._reply += data
        reply = decode_reply(self._reply, self._device, self._function, self._count)
        if reply is not None:
            words = " ".join(map(str, reply.words))
            yield words or reply.exception or reply.wrong
            self._reply = b""
