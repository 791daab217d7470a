"""Convert Lawicel (slcan) lines of a CAN adapter to CAN frames and back, and decode them."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
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

OK: Final = b"\r"
ERROR: Final = b"\a"
LONGEST_LINE: Final = 64
BIT_RATES: Final = {
    "0": 10_000,
    "1": 20_000,
    "2": 50_000,
    "3": 100_000,
    "4": 125_000,
    "5": 250_000,
    "6": 500_000,
    "7": 750_000,
    "8": 1_000_000,
    "9": 83_300,
}


@dataclass(frozen=True, slots=True)
class Frame:
    """One CAN frame; a remote frame has a length but no data."""

    identifier: int
    data: bytes = b""
    extended: bool = False
    remote: bool = False
    length: int | None = None

    @property
    def size(self) -> int:
        """Return the data length code."""
        return len(self.data) if self.length is None else self.length


def encode_frame(frame: Frame) -> bytes:
    """Return the line of a frame, with its CR."""
    kind = "r" if frame.remote else "t"
    if frame.extended:
        head = f"{kind.upper()}{frame.identifier:08X}{frame.size}"
    else:
        head = f"{kind}{frame.identifier:03X}{frame.size}"
    return head.encode("ascii") + frame.data.hex().upper().encode("ascii") + OK


def decode_frame(line: str) -> Frame | None:
    """Return the frame of a line without its CR, None if it is not a frame."""
    kind, digits = line[:1], 8 if line[:1] in ("T", "R") else 3
    head, payload = line[1 : 1 + digits], line[2 + digits :]
    try:
        identifier, size = int(head, 16), int(line[1 + digits])
        data = bytes.fromhex(payload)
    except (ValueError, IndexError):
        return None
    remote = kind in ("r", "R")
    limit = 1 << 29 if digits == 8 else 1 << 11
    wrong = len(head) != digits or not head.isalnum() or identifier >= limit or size > 8
    if wrong or kind not in "tTrR" or len(payload) != (0 if remote else 2 * size):
        return None
    return Frame(identifier, data, digits == 8, remote, size if remote else None)


class SlcanAdapter:
    """State of a simulated adapter: channel open or not, bit rate, incomplete lines.

    ``receive`` returns the frames that the host sends to the bus, and the adapter's replies.
    """

    def __init__(self) -> None:
        self.is_open = False
        self.listen_only = False
        self.bit_rate: int | None = None
        self._line = b""

    def receive(self, data: bytes) -> tuple[list[Frame], bytes]:
        """Process bytes from the host."""
        frames: list[Frame] = []
        answers = b""
        *lines, self._line = (self._line + data).split(OK)
        if len(self._line) > LONGEST_LINE:
            self._line = b""
            answers += ERROR
        for line in lines:
            answers += self._obey(line.decode("ascii", "replace"), frames)
        return frames, answers

    def _obey(self, line: str, frames: list[Frame]) -> bytes:
        command, rest = line[:1], line[1:]
        if command == "":
            return OK
        if command in ("t", "T", "r", "R"):
            return self._transmit(line, frames)
        if command in ("O", "L"):
            self.is_open, self.listen_only = True, command == "L"
            return OK
        if command == "C":
            self.is_open = False
            return OK
        if command == "S" and rest in BIT_RATES:
            self.bit_rate = BIT_RATES[rest]
            return OK
        if command == "s" and len(rest) == 4:
            self.bit_rate = None  # timing registers: assumed to match the bus
            return OK
        if command == "V":
            return b"V1013" + OK
        if command == "N":
            return b"NA123" + OK
        return ERROR

    def _transmit(self, line: str, frames: list[Frame]) -> bytes:
        frame = decode_frame(line)
        if frame is None or not self.is_open or self.listen_only:
            return ERROR
        frames.append(frame)
        return b"Z\r" if frame.extended else b"z\r"


_NODES: Final = 0x7F
_SPECIFIER: Final = 0xE0  # command specifier of an SDO frame (CiA 301, 7.2.4.3)
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
        """Yield the sent frames."""
        for line in data.decode("ascii", "replace").split("\r"):
            if line:
                yield _words(line)

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the received frames."""
        *lines, self._rest = (self._rest + data.decode("ascii", "replace")).split("\r")
        for line in filter(None, lines):
            yield _words(line)


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
        return _sdo(frame, node, requested=kind == SDO_REQUEST_BASE)
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


def _sdo(frame: Frame, node: int, *, requested: bool) -> str:
    head, index, subindex, value = struct.unpack("<BHBI", frame.data)
    shown = f"{index:04X}:{subindex}"
    if head & _SPECIFIER == _ABORT:
        return "SDO node {}: abort {} by {}".format(node, shown, f"{value:08X}")
    name = _WORDS.get((requested, head & _SPECIFIER))
    if name is None:
        return "SDO node {}: segment {}".format(node, frame.data.hex(" "))
    size = 4 - (head >> 2 & 3) if head & 1 else 4
    number = value & (1 << 8 * size) - 1
    carries = (requested and head & _SPECIFIER == 0x20) or (
        not requested and head & _SPECIFIER == 0x40
    )
    return "SDO node {}: {} {}".format(node, name, f"{shown} = {number:#x}" if carries else shown)
