"""Ask a Modbus device: one request, one reply, a pause between frames, tries again."""

from __future__ import annotations

import time
from typing import Final

from rigapp_drivers.api import BytePort, DeviceFault, ProtocolError, ReplyTimeout
from rigapp_drivers.modbus_sensor.protocol import ModbusReply, decode_reply, encode_request

TRIES: Final = 2
"""A line without a checksum error a day needs one; a second bears a disturbance."""
_MOST_BYTES: Final = 256  # an RTU frame (Modbus over serial line 1.02, 2.5.1)
_SILENT_CHARACTERS: Final = 3.5  # between frames, same place
_SHORTEST_PAUSE_S: Final = 0.00175  # above 19200 baud (Modbus over serial line 1.02, 2.5.1.1)
_BITS: Final = 11.0  # of a character with start, parity and stop


class ModbusLink:
    """Speak with one device; one thread at a time."""

    def __init__(self, port: BytePort, device: int, baud_rate: int, reply_timeout_s: float) -> None:
        self.port = port
        self.device = device
        self.reply_timeout_s = reply_timeout_s
        self.crc_errors = 0
        self.retries = 0
        self._byte_s = _BITS / baud_rate
        self._pause_s = max(_SILENT_CHARACTERS * self._byte_s, _SHORTEST_PAUSE_S)
        self._late_until_s = 0.0

    def read(
        self, function: int, address: int, count: int, deadline_s: float, tries: int = TRIES
    ) -> tuple[int, ...]:
        """Return the words of registers; deadline_s: on the monotonic clock, for all tries.

        Raises ReplyTimeout, ProtocolError when only spoiled answers came, DeviceFault when the
        device answers by an exception, DeviceLost.
        """
        wrong = ""
        for attempt in range(tries):
            left_s = deadline_s - time.monotonic()
            if attempt and left_s <= 0.0:
                break
            self.retries += bool(attempt)
            reply = self._ask(function, address, count, left_s)
            if reply is None:
                continue
            if reply.exception:
                raise DeviceFault.at(
                    self.port,
                    f"{self._asked(function, address, count)} is answered by {reply.exception}; "
                    "check the settings against the device's manual.",
                )
            if reply.words:
                return reply.words
            self.crc_errors += "checksum" in reply.wrong
            wrong = reply.wrong
        if wrong:
            raise ProtocolError.at(
                self.port,
                f"{self._asked(function, address, count)} was answered by {wrong}; check the line, "
                "its termination, and that addresses are used once.",
            )
        raise ReplyTimeout.at(
            self.port,
            f"no answer from {self._asked(function, address, count)} within "
            f"{self.reply_timeout_s:g} s; check power, wires A and B, address, baud rate and "
            "parity.",
        )

    def _ask(self, function: int, address: int, count: int, left_s: float) -> ModbusReply | None:
        self._outwait_late_reply()
        time.sleep(self._pause_s)
        self.port.read_some(_MOST_BYTES, 0.0)
        self.port.write(encode_request(self.device, function, address, count))
        wire_s = (8 + 5 + 2 * count) * self._byte_s
        deadline = time.monotonic() + min(self.reply_timeout_s + wire_s, max(left_s, wire_s))
        data = b""
        while True:
            left_s = deadline - time.monotonic()
            data += self.port.read_some(_MOST_BYTES, max(left_s, 0.0))
            reply = decode_reply(data, self.device, function, count) if data else None
            if reply is not None:
                return reply
            if left_s <= 0.0:
                break
        self._late_until_s = time.monotonic() + self.reply_timeout_s
        return ModbusReply(wrong=f"an answer cut short ‹{len(data)} bytes›") if data else None

    def _outwait_late_reply(self) -> None:
        """Let the answer to a question that was given up pass: it does not say what it answers."""
        while (left_s := self._late_until_s - time.monotonic()) > 0.0:
            if self.port.read_some(_MOST_BYTES, left_s):
                self._late_until_s = 0.0

    def _asked(self, function: int, address: int, count: int) -> str:
        asked = f"function {function}, {count} from {address} on"
        return f"the device at Modbus address {self.device} ‹{asked}›"
