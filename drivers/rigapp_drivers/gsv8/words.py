"""Describe status codes and value errors of the GSV-8 (SPEC p17-21), and decode its line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from rigapp.texts import joined, say
from rigapp_drivers.api import InputFault, InputFaultKind
from rigapp_drivers.gsv8.frames import StreamParser
from rigapp_drivers.gsv8.protocol import Command

STATUS_WORDS: dict[int, str] = {
    0x00: say("done"),
    0x01: say("done, and other parameters changed with it"),
    0x40: say("unknown command for the device"),
    0x41: say("this device does not have this command"),
    0x42: say("the request ended wrongly"),
    0x43: say("the request arrived damaged"),
    0x50: say("a parameter is wrong"),
    0x51: say("the index, channel or address does not exist"),
    0x52: say("the value is not one of those allowed"),
    0x53: say("some bits of the value are not allowed"),
    0x54: say("the value is too big"),
    0x55: say("the value is too small"),
    0x56: say("this combination of parameters is not allowed"),
    0x57: say("the value is too big for the other settings"),
    0x58: say("the value is too small for the other settings"),
    0x59: say("this function of the parameter is not available"),
    0x5A: say("the parameters arrived too late (more than 200 ms)"),
    0x5B: say("the number of parameters is wrong"),
    0x5C: say("the value does not fit the other settings"),
    0x5D: say("another function uses this hardware"),
    0x60: say("there are no data"),
    0x61: say("the stored data are inconsistent"),
    0x62: say("the device is in the wrong state for it"),
    0x63: say("the device does not support it"),
    0x64: say("the data rate is too high for the other settings"),
    0x6E: say("a condition for the memory is not met"),
    0x6F: say("the memory denies access"),
    0x70: say("access denied"),
    0x71: say("writing is locked in the device; unlock it with the maker's program"),
    0x72: say("a password is missing; unlock the device with the maker's program"),
    0x74: say("the allowed number of executions is used up"),
    0x75: say("another port (a field bus or a second program) has write access; release it there"),
    0x76: say("the setting can only be read"),
    0x80: say("internal fault of the device"),
    0x81: say("arithmetic fault in the device"),
    0x82: say("the analog-to-digital converter is faulty"),
    0x83: say("the measured value is not suitable for it"),
    0x84: say("the settings memory is faulty ‹EEPROM›"),
    0x85: say("external hardware is missing"),
    0x86: say("the memory card is missing or faulty"),
    0x87: say("the memory card refused the access"),
    0x91: say("the device could not send in time: measured values were lost"),
    0x92: say("the device is busy"),
    0x99: say("the device takes no more requests for now"),
    0xC0: say("the radio link failed"),
}


def status_words(code: int) -> str:
    """Return the meaning of a status code."""
    if 0xB0 <= code <= 0xB8:
        return say("the sensor's memory cannot be used ‹TEDS, status {}›", f"{code:02X}")
    words = STATUS_WORDS.get(code, say("a status unknown to this program"))
    return say("{} ‹status {}›", words, f"{code:02X}")


_KINDS = {
    1: InputFaultKind.SATURATED,
    2: InputFaultKind.OUT_OF_RANGE,
    3: InputFaultKind.SENSOR_BROKEN,
}


@dataclass(frozen=True, slots=True)
class ValueFault:
    """Value error stored in the device (command 43)."""

    kind: int
    operating_minutes: int
    flags: int

    @property
    def words(self) -> str:
        """Return the fault in words."""
        return value_fault_words(self.kind, self.flags)

    @property
    def channels(self) -> tuple[int, ...]:
        """Return the analog inputs (1 to 8) that it concerns, empty for other errors."""
        if self.kind == 1:
            return tuple(n + 1 for n in range(8) if (self.flags | self.flags >> 8) >> n & 1)
        if self.kind == 2:
            return tuple(n + 1 for n in range(8) if self.flags >> n & 1)
        if self.kind == 3:
            return tuple(n + 1 for n in range(8) if self.flags >> 2 * n & 3)
        return ()

    def as_input_fault(self, host_time_ns: int) -> InputFault:
        """Return the fault as an ``InputFault``."""
        kind = _KINDS.get(self.kind, InputFaultKind.OTHER)
        inputs = tuple(f"analog_{channel}" for channel in self.channels)
        return InputFault(kind, inputs, self.words, host_time_ns)


def decode_value_fault(data: bytes) -> ValueFault | None:
    """Return the fault in the six bytes of command 43, None if there is none."""
    bits = int.from_bytes(data[:6], "big")
    kind = bits >> 45
    if kind == 0:
        return None
    return ValueFault(kind, (bits >> 16) & 0x1FFFFFFF, bits & 0xFFFF)


def encode_value_fault(fault: ValueFault) -> bytes:
    """Return the six bytes of command 43."""
    bits = fault.kind << 45 | (fault.operating_minutes & 0x1FFFFFFF) << 16 | fault.flags
    return bits.to_bytes(6, "big")


_EIGHT = range(1, 9)
_FLAGS: dict[int, tuple[str, tuple[str, ...]]] = {
    1: (
        say("input saturated"),
        (
            *(say("channel {:d} above its range", n) for n in _EIGHT),
            *(say("channel {:d} below its range", n) for n in _EIGHT),
        ),
    ),
    2: (say("measured value beyond its maximum"), tuple(say("channel {}", n) for n in _EIGHT)),
    3: (
        say("sensor or its cable is broken"),
        tuple(say("channel {} Ud{}", n, s) for n in _EIGHT for s in "+-"),
    ),
    4: (
        say("analog output"),
        (
            *(say("current loop {} open", n) for n in _EIGHT),
            *(say("driver {} too hot", n) for n in _EIGHT),
        ),
    ),
    5: (say("short circuit of a digital line"), tuple(say("DIO {}", n) for n in range(1, 17))),
}
"""Kind of value error -> its name, and the meanings of its flags from bit 0."""


def value_fault_words(kind: int, flags: int) -> str:
    """Return a value error in words, with the channels concerned."""
    if kind not in _FLAGS:
        return say("value error of unknown kind ‹{}, flags {}›", kind, f"{flags:04X}")
    what, names = _FLAGS[kind]
    if kind == 4 and flags == 0xFFFF:
        return say("{}: unknown output", what)
    named = [name for bit, name in enumerate(names) if flags >> bit & 1]
    return say("{}: {}", what, joined(", ", named) or say("no channel named"))


_REQUEST: Final = 0x90
_CHECKED_REQUEST: Final = 0xB0
_KIND: Final = 0xF0


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``."""

    def __init__(self) -> None:
        self._parser = StreamParser()
        self._parser.response_expected = True

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield the request: the command with its parameters."""
        kind = data[1] & _KIND if len(data) > 3 else 0
        if kind not in (_REQUEST, _CHECKED_REQUEST):
            yield data.hex(" ")
            return
        parameters = data[3 : 3 + (data[1] & 0x0F)]
        known = data[2] in Command.__members__.values()
        name = Command(data[2]).words if known else "command {}".format(f"{data[2]:02X}")
        yield f"{name} {parameters.hex(' ')}".rstrip()

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the responses; of measured values only the number of bytes."""
        tally = self._parser.tally
        before = tally.dropped_bytes
        parsed = self._parser.feed(data)
        for response in parsed.responses:
            content = response.data.hex(" ") or "-"
            yield f"response: {status_words(response.status)}, {content}"
        dropped = tally.dropped_bytes - before
        rest = len(data) - sum(4 + len(earlier.data) for earlier in parsed.responses) - dropped
        if rest > 0:
            yield f"{rest} bytes of measured values"
        if dropped:
            yield f"{dropped} bytes that are no frame"
