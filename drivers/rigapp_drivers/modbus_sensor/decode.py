"""Show the bytes of a Modbus RTU line in words, for ``rigapp wire``."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import Final

from rigapp_drivers.modbus_sensor.link import decode_reply

_REQUEST: Final = struct.Struct(">BBHH")  # then the CRC


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``."""

    def __init__(self) -> None:
        self._device = self._function = self._count = 0
        self._reply = b""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield what is asked: device, function, registers."""
        if self._reply:
            yield "(no whole answer: {})".format(self._reply.hex(" "))
        self._reply = b""
        if len(data) != _REQUEST.size + 2:
            yield data.hex(" ")
            return
        self._device, self._function, address, self._count = _REQUEST.unpack(data[:-2])
        asked = f"{self._count} registers from {address} on"
        yield f"device {self._device}, function {self._function}: {asked}"

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the answer when it is whole, as unsigned words."""
        self._reply += data
        reply = decode_reply(self._reply, self._device, self._function, self._count)
        if reply is not None:
            words = " ".join(map(str, reply.words))
            yield words or reply.exception or reply.wrong
            self._reply = b""
