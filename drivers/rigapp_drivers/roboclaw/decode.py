"""Show the bytes of a RoboClaw's line in words, for ``rigapp wire``."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import Final

from rigapp_drivers.roboclaw.protocol import (
    ACKNOWLEDGE,
    CRC_LENGTH,
    NEWER,
    OLDER,
    Command,
    Generation,
    Rejected,
    missing_bytes,
    parse_values,
    parse_version,
    write_format,
)

_HEAD: Final = 2  # address and command


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``.

    A reply does not say what it answers: it is read as that to the latest question. The older
    firmware's layout is tried where the newer one's checksum is wrong.
    """

    def __init__(self) -> None:
        self._address, self._command, self._write = 0, 0, True
        self._reply = b""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield what is asked: the command with its numbers."""
        if self._reply:
            yield "(reply cut short: {})".format(self._reply.hex(" "))
        self._reply = b""
        if len(data) < _HEAD:
            yield data.hex(" ")
            return
        self._address, self._command = data[0], data[1]
        self._write = len(data) > _HEAD
        yield f"{_name(data[1])} {_values(data)}".rstrip()

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the reply when it is whole."""
        self._reply += data
        if self._write:
            good = self._reply == ACKNOWLEDGE
            yield "acknowledged" if good else "not FF: {}".format(self._reply.hex(" "))
            self._reply = b""
            return
        for generation in (NEWER, OLDER):
            if missing_bytes(self._command, self._reply, generation):
                continue
            reply = self._parsed(generation)
            if not isinstance(reply, Rejected):
                yield reply
                self._reply = b""
                return
        if not missing_bytes(self._command, self._reply):
            yield "damaged reply: {}".format(self._reply.hex(" "))
            self._reply = b""

    def _parsed(self, generation: Generation) -> str | Rejected:
        if self._command == Command.VERSION:
            return parse_version(self._address, self._reply)
        values = parse_values(self._address, self._command, self._reply, generation)
        return values if isinstance(values, Rejected) else " ".join(map(str, values))


def _name(command: int) -> str:
    if command in Command.__members__.values():
        return Command(command).name.lower().replace("_", " ")
    return f"command {command}"


def _values(packet: bytes) -> str:
    body = packet[_HEAD:-CRC_LENGTH]
    for generation in (NEWER, OLDER):
        layout = write_format(packet[1], generation) if body else None
        if layout is not None and struct.calcsize(layout) == len(body):
            return " ".join(map(str, struct.unpack(layout, body)))
    return body.hex(" ")
