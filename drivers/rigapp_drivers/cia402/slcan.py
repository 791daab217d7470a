"""The Lawicel (slcan) side of a simulated CAN adapter: text lines to CAN frames and back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

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
    """Hold one CAN frame; a remote frame has a length but no data."""

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
    """Return the frame of a line without its CR, None when it is none."""
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
    """Keep the state of a simulated adapter: channel open or not, bit rate, half lines.

    ``receive`` returns the frames that the host wants on the bus and the adapter's own answers.
    """

    def __init__(self) -> None:
        self.is_open = False
        self.listen_only = False
        self.bit_rate: int | None = None
        self._line = b""

    def receive(self, data: bytes) -> tuple[list[Frame], bytes]:
        """Take bytes from the host."""
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
            self.bit_rate = None  # timing registers: taken as right
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
