"""Show the frames of a CANopen node's bus in words, for ``rigapp wire``."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import Final

from rigapp_drivers.cia402.protocol import (
    EMERGENCY_BASE,
    HEARTBEAT_BASE,
    NMT_ID,
    SDO_REPLY_BASE,
    SDO_REQUEST_BASE,
    TPDO_BASES,
    Nmt,
    NodeState,
)
from rigapp_drivers.cia402.slcan import Frame, decode_frame

_NODES: Final = 0x7F
_SPECIFIER: Final = 0xE0  # what an SDO frame is (CiA 301, 7.2.4.3)
_ABORT: Final = 0x80
_WORDS: Final = {
    (True, 0x20): "write",
    (True, 0x40): "read",
    (False, 0x40): "value",
    (False, 0x60): "written",
}
_RPDO_BASES: Final = (0x200, 0x300, 0x400, 0x500)


class Decoder:
    """Decode both directions of one bus, recorded as slcan lines; implements ``WireDecoder``."""

    def __init__(self) -> None:
        self._rest = ""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield the frames that the program sent."""
        for one in data.decode("ascii", "replace").split("\r"):
            if one:
                yield _words(one)

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the frames that came."""
        *lines, self._rest = (self._rest + data.decode("ascii", "replace")).split("\r")
        for one in filter(None, lines):
            yield _words(one)


def _words(line: str) -> str:
    frame = decode_frame(line)
    if frame is None or frame.extended or frame.remote:
        return repr(line)
    kind, node = frame.identifier & ~_NODES, frame.identifier & _NODES
    if frame.identifier == NMT_ID and len(frame.data) == 2:
        command = frame.data[0]
        known = command in Nmt.__members__.values()
        return f"NMT {Nmt(command).name if known else command} to node {frame.data[1]}"
    if kind in (SDO_REQUEST_BASE, SDO_REPLY_BASE) and len(frame.data) == 8:
        return _sdo(frame, node, asked=kind == SDO_REQUEST_BASE)
    if kind == HEARTBEAT_BASE and len(frame.data) == 1:
        state = frame.data[0] & 0x7F
        known = state in NodeState.__members__.values()
        return f"heartbeat of node {node}: {NodeState(state).name if known else state}"
    if kind == EMERGENCY_BASE and node and len(frame.data) == 8:
        code = f"{int.from_bytes(frame.data[:2], 'little'):04X}"
        return f"emergency of node {node}: {code}"
    for name, bases in (("TPDO", TPDO_BASES), ("RPDO", _RPDO_BASES)):
        if kind in bases:
            return "{}{} of node {}: {}".format(
                name, bases.index(kind) + 1, node, frame.data.hex(" ")
            )
    return f"{frame.identifier:03X}: {frame.data.hex(' ')}"


def _sdo(frame: Frame, node: int, *, asked: bool) -> str:
    head, index, subindex, value = struct.unpack("<BHBI", frame.data)
    shown = f"{index:04X}:{subindex}"
    if head & _SPECIFIER == _ABORT:
        return "SDO node {}: abort {} by {}".format(node, shown, f"{value:08X}")
    name = _WORDS.get((asked, head & _SPECIFIER))
    if name is None:
        return "SDO node {}: segment {}".format(node, frame.data.hex(" "))
    size = 4 - (head >> 2 & 3) if head & 1 else 4
    number = value & (1 << 8 * size) - 1
    carries = (asked and head & _SPECIFIER == 0x20) or (not asked and head & _SPECIFIER == 0x40)
    return "SDO node {}: {} {}".format(node, name, f"{shown} = {number:#x}" if carries else shown)
