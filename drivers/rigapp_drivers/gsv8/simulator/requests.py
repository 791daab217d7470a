"""Cut what the host sends into requests, as the simulated device does."""

from __future__ import annotations

from typing import NamedTuple

from rigapp_drivers.gsv8.checksums import crc8
from rigapp_drivers.gsv8.frames import PREFIX, SUFFIX

_PARAMETER_TIMEOUT_S = 0.2
_TOO_LATE, _WRONG_CHECKSUM = 0x5A, 0x43


class Asked(NamedTuple):
    """A request, with the status to answer with (0: obey)."""

    command: int
    parameters: bytes
    status: int
    checksum: bool


class RequestReader:
    """Collect bytes until a request is whole.

    ``broken`` is set when bytes broke the frame rules; the device ignores them without an answer.
    """

    def __init__(self) -> None:
        self.broken = False
        self._buffer = b""
        self._begun_s = 0.0

    def take(self, data: bytes, now_s: float) -> list[Asked]:
        """Return the requests that these bytes complete."""
        requests: list[Asked] = []
        late = self._too_late(now_s)
        if late is not None:
            requests.append(late)
        if not self._buffer:
            self._begun_s = now_s
        self._buffer += data
        while self._buffer:
            if not self._seems_a_request():
                self.broken = True
                self._buffer = self._buffer[1:]
                continue
            length = self._length()
            if length is None or len(self._buffer) < length:
                break
            request = _decode(self._buffer[:length])
            if request is None:
                self.broken = True
                self._buffer = self._buffer[1:]
                continue
            requests.append(request)
            self._buffer = self._buffer[length:]
            self._begun_s = now_s
        return requests

    def _seems_a_request(self) -> bool:
        if self._buffer[0] != PREFIX:
            return False
        return len(self._buffer) < 2 or self._buffer[1] & 0xF0 in (0x90, 0xB0)

    def _length(self) -> int | None:
        if len(self._buffer) < 2:
            return None
        head = self._buffer[1]
        return 4 + (head & 0x0F) + (1 if head & 0x20 else 0)

    def _too_late(self, now_s: float) -> Asked | None:
        """Give up a request whose parameters did not arrive in time."""
        if not self._buffer or now_s - self._begun_s <= _PARAMETER_TIMEOUT_S:
            return None
        begun, self._buffer = self._buffer, b""
        if len(begun) < 3:
            self.broken = True
            return None
        return Asked(begun[2], b"", _TOO_LATE, bool(begun[1] & 0x20))


def _decode(frame: bytes) -> Asked | None:
    if frame[-1] != SUFFIX:
        return None
    count, checksum = frame[1] & 0x0F, bool(frame[1] & 0x20)
    wrong = checksum and crc8(frame[1:-2]) != frame[-2]
    status = _WRONG_CHECKSUM if wrong else 0
    return Asked(frame[2], frame[3 : 3 + count], status, checksum)
