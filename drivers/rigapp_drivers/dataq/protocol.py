"""Commands, scan-list words and conversions of the DATAQ DI-2108 and DI-4108; pure.

Commands are lower-case ASCII lines that end in CR, numbers decimal. While idle, the device echoes
each command (a query followed by its value), CR, possibly NULs. While scanning it echoes only
``stop``. The stream has no header, no sync word and no checksum: one little-endian 16-bit word for
each entry of the scan list, in the list's order.
"""

from __future__ import annotations

import enum
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say

MASTER_CLOCK_HZ: Final = 60_000_000
END_OF_LIST: Final = 65535
MOST_ENTRIES: Final = 11
ANALOG_CHANNELS: Final = 8
PACKET_SIZES: Final = (16, 32, 64, 128, 256, 512, 1024, 2048)
RATE_RANGES_HZ: Final = (50e3, 20e3, 10e3, 5e3, 2e3, 1e3, 500.0, 200.0, 100.0, 50.0, 20.0, 10.0)
COUNTER_SPAN: Final = 1 << 16
ADVISED_FIRMWARE: Final = 135  # hundredths

RATE_LINE: Final = "D2"
COUNTER_LINE: Final = "D3"
CLOCK_LINE: Final = "D6"
FREE_LINES: Final = ("D0", "D1", "D2", "D4", "D5")
ALL_INPUTS: Final = 0  # argument of endo: a set bit makes its line an output switch

_DIGITAL_LINES: Final = 0x7F
_RATE_STEPS: Final = 65535.0


class Function(enum.IntEnum):
    """Function of a scan-list entry (bits 3 to 0); 0 to 7 are the analog channels."""

    DIGITAL = 8
    RATE = 9
    COUNTER = 10


class Clock(enum.StrEnum):
    """Scan clock of the device."""

    INTERNAL = "internal"
    ENCODER = "encoder"


class Info(enum.IntEnum):
    """Numbers of the queries in use."""

    MODEL = 1
    FIRMWARE = 2
    SERIAL_NUMBER = 6
    MASTER_CLOCK = 9


FILTERS: Final[Mapping[str, int]] = {"last point": 0, "average": 1, "maximum": 2, "minimum": 3}


@dataclass(frozen=True, slots=True)
class Model:
    """Properties of a model: ranges in V by range code, and the significant bits of a word."""

    number: int
    ranges_V: tuple[float, ...]
    mask: int

    @property
    def name(self) -> str:
        """Return the name on the instrument."""
        return f"DI-{self.number}"


MODELS: Final[Mapping[int, Model]] = {
    2108: Model(2108, (10.0,), 0xFFFF),
    4108: Model(4108, (10.0, 5.0, 2.0, 1.0, 0.5, 0.2), 0xFFFC),
}


class BadReply(ValueError):
    """The device's reply to a command is invalid."""


# --- commands -----------------------------------------------------------------------------------


def analog_word(channel: int, range_code: int) -> int:
    """Return the scan-list word of an analog channel (0 to 7)."""
    if not 0 <= channel < ANALOG_CHANNELS:
        raise ValueError(say("analog channel {} is not 0 to {}", channel, ANALOG_CHANNELS - 1))
    return range_code << 8 | channel


def rate_word(range_Hz: float) -> int:
    """Return the scan-list word of the rate input; raise ValueError for a missing range."""
    if range_Hz not in RATE_RANGES_HZ:
        raise ValueError(say("the rate input has no range of {:g} Hz", range_Hz))
    return (RATE_RANGES_HZ.index(range_Hz) + 1) << 8 | Function.RATE


def line(*words: str | int) -> bytes:
    """Return a command line."""
    return " ".join(str(word) for word in words).encode("ascii") + b"\r"


def start_line(clock: Clock) -> bytes:
    """Return the command that starts scanning: by the internal clock, or by edges on D6."""
    return line("start", 2) if clock is Clock.ENCODER else line("start")


# --- replies ------------------------------------------------------------------------------------


def split_replies(data: bytes) -> tuple[list[str], bytes]:
    """Return the complete lines of idle text and the incomplete rest.

    NULs and line feeds are removed; non-ASCII bytes are shown as escapes.
    """
    *lines, rest = data.replace(b"\0", b"").replace(b"\n", b"").split(b"\r")
    return [text.decode("ascii", "backslashreplace") for text in lines], rest


def query_value(command: bytes, reply: str) -> str:
    """Return the value in the reply to a query; raise BadReply."""
    requested = command.rstrip(b"\r").decode("ascii").strip()
    value = reply.removeprefix(requested)
    if value == reply or not value.strip():
        raise BadReply(say("{} was answered with {}", repr(requested), repr(reply)))
    return value.strip()


def echoes_of(command: bytes, nuls: int = 0) -> tuple[bytes, ...]:
    """Return the possible echoes of ``start`` before the first sample.

    nuls: number of NULs after the previous command's echo; zeros may also be a sample.
    """
    bare = tuple(dict.fromkeys((command, b"start\r")))
    return (*(echo + bytes(nuls) for echo in bare if nuls), *bare)


def without_echo(data: bytes, echoes: tuple[bytes, ...]) -> bytes | None:
    """Return the stream without an echo at its beginning; None: too few bytes to decide.

    Only an exact echo is removed, the longest one: a sample may contain 0D.
    """
    if any(len(data) < len(echo) and echo.startswith(data) for echo in echoes):
        return None
    for echo in echoes:
        if data.startswith(echo):
            return data[len(echo) :]
    return data


# --- conversions: electrical signal = scale * raw + offset --------------------------------------


def analog_scale(range_V: float) -> float:
    """Return V per step: v = range * n / 32768, n signed."""
    return range_V / 32768.0


def rate_scale(range_Hz: float) -> tuple[float, float]:
    """Return (Hz per step, Hz at 0): f = (n + 32768) / 65535 * range, n signed."""
    return range_Hz / _RATE_STEPS, 32768.0 / _RATE_STEPS * range_Hz


def counts_of(words: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """Return counts 0 to 65535 of counter words: n + 32768, n signed."""
    return words ^ np.uint16(0x8000)


def lines_of(words: NDArray[np.uint16]) -> NDArray[np.uint16]:
    """Return the states of the digital lines D0 to D6 as bits: bytes swapped, seven bits."""
    return np.asarray(words >> 8 & _DIGITAL_LINES, np.uint16)


def saturated_limits(mask: int) -> tuple[int, int]:
    """Return the signed words at both ends of the converter's range."""
    return -32768, 32767 & mask


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``.

    Samples arrive between ``start`` and the echo of ``stop``; only their number of bytes is
    reported, as they have no sync word.
    """

    def __init__(self) -> None:
        self._scans = False
        self._rest = b""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield the command lines."""
        text = data.decode("ascii", "replace")
        for command in filter(None, text.split("\r")):
            self._scans |= command.startswith("start")
            yield command

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the reply lines, or the number of bytes of samples."""
        if self._scans:
            end = data.rfind(line("stop"))
            samples = data if end < 0 else data[:end]
            if samples:
                yield f"{len(samples)} bytes of samples"
            if end < 0:
                return
            self._scans, data = False, data[end:]
        replies, self._rest = split_replies(self._rest + data)
        yield from replies
