"""RoboClaw packet serial: encode and decode packets, without any input or output.

A write is ``address command data.. crc`` and is acknowledged by one byte FF. A read is
``address command`` alone; its reply is ``data.. crc``, where the CRC covers address, command and
data. Numbers are big-endian. The command number alone determines the data that follow.

Source: RoboClaw user manual (packet serial); reply variants from the manufacturer's library.
"""

from __future__ import annotations

import binascii
import enum
import struct
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from rigapp.texts import say

ACKNOWLEDGE: Final = b"\xff"
CRC_LENGTH: Final = 2
VERSION_LIMIT: Final = 48
NVM_KEY: Final = 0xE22EAB7A
BAUD_RATES: Final = (2400, 9600, 19200, 38400, 57600, 115200, 230400, 460800)
TIMEOUT_UNIT_S: Final = 0.1
MAXIMUM_DUTY: Final = 32767
MAXIMUM_DUTY_ACCELERATION: Final = 655359  # duty per s: all of it in 50 ms
FIXED_POINT: Final = 65536.0
CURRENT_UNIT_A: Final = 0.01
VOLTAGE_UNIT_V: Final = 0.1
TEMPERATURE_UNIT_C: Final = 0.1


class Command(enum.IntEnum):
    """Commands in use; M1 and M2 forms are separate commands."""

    SET_TIMEOUT = 14
    GET_TIMEOUT = 15
    COUNT_M1 = 16
    COUNT_M2 = 17
    SPEED_M1 = 18
    SPEED_M2 = 19
    RESET_COUNTS = 20
    VERSION = 21
    SET_COUNT_M1 = 22
    SET_COUNT_M2 = 23
    MAIN_VOLTAGE = 24
    LOGIC_VOLTAGE = 25
    SET_VELOCITY_PID_M1 = 28
    SET_VELOCITY_PID_M2 = 29
    INSTANT_SPEED_M1 = 30
    INSTANT_SPEED_M2 = 31
    DUTY_M1 = 32
    DUTY_M2 = 33
    SET_SPEED_M1 = 35
    SET_SPEED_M2 = 36
    RAMP_SPEED_M1 = 38
    RAMP_SPEED_M2 = 39
    PWM = 48
    CURRENTS = 49
    VELOCITY_PID_M1 = 55
    VELOCITY_PID_M2 = 56
    SET_MAIN_LIMITS = 57
    MAIN_LIMITS = 59
    SET_DUTY_ACCELERATION_M1 = 68
    SET_DUTY_ACCELERATION_M2 = 69
    COMBINED_STATUS = 73
    SET_PIN_FUNCTIONS = 74
    PIN_FUNCTIONS = 75
    COUNTS = 78
    INSTANT_SPEEDS = 79
    DUTY_ACCELERATIONS = 81
    TEMPERATURE_1 = 82
    TEMPERATURE_2 = 83
    STATUS = 90
    ENCODER_MODES = 91
    SET_ENCODER_MODE_M1 = 92
    SET_ENCODER_MODE_M2 = 93
    SAVE_TO_NVM = 94
    VOLTAGES = 100
    TEMPERATURES = 101
    AVERAGE_SPEEDS = 108
    SET_CURRENT_LIMIT_M1 = 133
    SET_CURRENT_LIMIT_M2 = 134
    CURRENT_LIMIT_M1 = 135
    CURRENT_LIMIT_M2 = 136
    RESET_EMERGENCY_STOP = 200
    SET_EMERGENCY_STOP_LOCK = 201
    EMERGENCY_STOP_LOCK = 202


class EmergencyStopLock(enum.IntEnum):
    """Release of an emergency stop after its input is inactive (commands 201, 202)."""

    HARDWARE = 0x00
    AUTOMATIC = 0x55
    SOFTWARE = 0xAA


@dataclass(frozen=True, slots=True)
class Generation:
    """Packet layouts that depend on the firmware.

    status_bits: width of the reply to command 90, 16 or 32.
    pin_modes: bytes of commands 74 and 75, 3 or 5.
    voltage_offset: whether commands 57 and 59 have the automatic-offset byte.
    """

    status_bits: int = 32
    pin_modes: int = 5
    voltage_offset: bool = True


NEWER: Final = Generation()
OLDER: Final = Generation(status_bits=16, pin_modes=3, voltage_offset=False)


def _of_both(formats: Mapping[int, str]) -> dict[int, str]:
    """Return formats of motor 1's commands, and of motor 2's, whose numbers are one higher."""
    return {number + motor: layout for number, layout in formats.items() for motor in (0, 1)}


_FIXED_WRITES: Final[Mapping[int, str]] = {
    Command.SET_TIMEOUT: ">B",
    Command.RESET_COUNTS: ">",
    Command.SAVE_TO_NVM: ">I",
    Command.RESET_EMERGENCY_STOP: ">",
    Command.SET_EMERGENCY_STOP_LOCK: ">B",
} | _of_both(
    {
        Command.SET_COUNT_M1: ">i",
        Command.SET_VELOCITY_PID_M1: ">4I",
        Command.DUTY_M1: ">h",
        Command.SET_DUTY_ACCELERATION_M1: ">I",
        Command.SET_SPEED_M1: ">i",
        Command.RAMP_SPEED_M1: ">Ii",
        Command.SET_ENCODER_MODE_M1: ">B",
        Command.SET_CURRENT_LIMIT_M1: ">2I",
    }
)
_FIXED_REPLIES: Final[Mapping[int, str]] = {
    Command.GET_TIMEOUT: ">B",
    Command.MAIN_VOLTAGE: ">H",
    Command.LOGIC_VOLTAGE: ">H",
    Command.PWM: ">2h",
    Command.CURRENTS: ">2h",
    Command.COMBINED_STATUS: ">2I4H4h6i4h",
    Command.COUNTS: ">2i",
    Command.INSTANT_SPEEDS: ">2i",
    Command.DUTY_ACCELERATIONS: ">2I",
    Command.ENCODER_MODES: ">2B",
    Command.VOLTAGES: ">2H",
    Command.TEMPERATURES: ">2H",
    Command.AVERAGE_SPEEDS: ">2i",
    Command.EMERGENCY_STOP_LOCK: ">B",
} | _of_both(
    {
        Command.COUNT_M1: ">iB",
        Command.SPEED_M1: ">IB",
        Command.INSTANT_SPEED_M1: ">IB",
        Command.VELOCITY_PID_M1: ">4I",
        Command.TEMPERATURE_1: ">H",
        Command.CURRENT_LIMIT_M1: ">2I",
    }
)


def crc16(data: bytes) -> int:
    """Return the CRC-16 with polynomial 0x1021 and initial 0 (XMODEM; "123456789" -> 31C3)."""
    return binascii.crc_hqx(data, 0)


def write_format(command: int, generation: Generation = NEWER) -> str | None:
    """Return the struct format of a write's data; None for commands that are not writes."""
    if command == Command.SET_MAIN_LIMITS:
        return ">2HB" if generation.voltage_offset else ">2H"
    if command == Command.SET_PIN_FUNCTIONS:
        return f">{generation.pin_modes}B"
    return _FIXED_WRITES.get(command)


def reply_format(command: int, generation: Generation = NEWER) -> str | None:
    """Return the struct format of a read's reply; None if it is no read, or text (21)."""
    if command == Command.STATUS:
        return ">I" if generation.status_bits == 32 else ">H"
    if command == Command.MAIN_LIMITS:
        return ">2HB" if generation.voltage_offset else ">2H"
    if command == Command.PIN_FUNCTIONS:
        return f">{generation.pin_modes}B"
    return _FIXED_REPLIES.get(command)


def write_packet(address: int, command: int, *values: int, generation: Generation = NEWER) -> bytes:
    """Return a write packet with its CRC.

    Raises ValueError if the command is no write or a value does not fit its field.
    """
    layout = write_format(command, generation)
    if layout is None:
        raise ValueError(say("command {} is not a write command", command))
    try:
        body = bytes((address, command)) + struct.pack(layout, *values)
    except struct.error as error:
        raise ValueError(say("command {} cannot carry {}: {}", command, values, error)) from error
    return body + struct.pack(">H", crc16(body))


def read_packet(address: int, command: int) -> bytes:
    """Return a read request: two bytes, no CRC."""
    return bytes((address, command))


@dataclass(frozen=True, slots=True)
class Rejected:
    """Reason why bytes are no valid reply: ``kind`` is "short", "crc" or "text"."""

    kind: str
    sentence: str


def missing_bytes(command: int, raw: bytes, generation: Generation = NEWER) -> int:
    """Return the minimum number of missing bytes of a reply; 0 if it is complete."""
    if command == Command.VERSION:
        end = raw.find(b"\x00", 0, VERSION_LIMIT)
        if end < 0:
            return 1 if len(raw) < VERSION_LIMIT else 0
        return max(0, end + 1 + CRC_LENGTH - len(raw))
    layout = reply_format(command, generation)
    if layout is None:
        return 0
    return max(0, struct.calcsize(layout) + CRC_LENGTH - len(raw))


def _checked(address: int, command: int, raw: bytes) -> bytes | Rejected:
    data, sent = raw[:-CRC_LENGTH], int.from_bytes(raw[-CRC_LENGTH:], "big")
    computed = crc16(bytes((address, command)) + data)
    if sent != computed:
        return Rejected(
            "crc", say("a damaged answer ‹CRC {} instead of {}›", f"{sent:04X}", f"{computed:04X}")
        )
    return data


def parse_values(
    address: int, command: int, raw: bytes, generation: Generation = NEWER
) -> tuple[int, ...] | Rejected:
    """Return the numbers of a reply in wire order, or why it is invalid. Accepts any bytes."""
    layout = reply_format(command, generation)
    if layout is None:
        return Rejected("short", say("command {} has no reply of numbers", command))
    expected = struct.calcsize(layout) + CRC_LENGTH
    if len(raw) != expected:
        return Rejected("short", say("{} of {} bytes", len(raw), expected))
    data = _checked(address, command, raw)
    return data if isinstance(data, Rejected) else struct.unpack(layout, data)


def parse_version(address: int, raw: bytes) -> str | Rejected:
    """Return the firmware text of command 21 without its LF NUL, or why it is invalid."""
    end = raw.find(b"\x00", 0, VERSION_LIMIT)
    if end < 0 or len(raw) != end + 1 + CRC_LENGTH:
        return Rejected("short", say("{} bytes without the end of a text", len(raw)))
    data = _checked(address, Command.VERSION, raw)
    if isinstance(data, Rejected):
        return data
    text = data[:end].rstrip(b"\n")
    if not text.isascii():
        return Rejected("text", say("a firmware text that is not readable"))
    return text.decode("ascii")


def count_of(values: tuple[int, ...]) -> int:
    """Return the count of commands 16 and 17 (two's complement); wrap flags follow it."""
    return values[0]


def speed_of(values: tuple[int, ...]) -> int:
    """Return the signed speed in counts/s of commands 18, 19, 30, 31 (magnitude, direction)."""
    magnitude, reverse = values
    return -magnitude if reverse else magnitude


@dataclass(frozen=True, slots=True)
class VelocityPid:
    """Velocity loop of a motor; qpps is the speed in counts/s at full duty."""

    p: float
    i: float
    d: float
    qpps: int


def velocity_pid_of(values: tuple[int, ...]) -> VelocityPid:
    """Return the velocity loop of commands 55 and 56, which send P, I, D, QPPS."""
    p, i, d, qpps = values
    return VelocityPid(p / FIXED_POINT, i / FIXED_POINT, d / FIXED_POINT, qpps)


@dataclass(frozen=True, slots=True)
class CombinedStatus:
    """Reply to command 73; pairs are (motor 1, motor 2), raw units of the wire."""

    tick: int
    state: int
    temperatures: tuple[int, ...]
    main_voltage: int
    logic_voltage: int
    pwm: tuple[int, ...]
    currents: tuple[int, ...]
    counts: tuple[int, ...]
    setpoints: tuple[int, ...]
    speeds: tuple[int, ...]
    speed_errors: tuple[int, ...]
    position_errors: tuple[int, ...]


def combined_status_of(values: tuple[int, ...]) -> CombinedStatus:
    """Return the record of command 73 (20 numbers, 56 bytes)."""
    tick, state, hot_1, hot_2, main, logic, *pairs = values
    both = (tuple(pairs[index : index + 2]) for index in range(0, len(pairs), 2))
    return CombinedStatus(tick, state, (hot_1, hot_2), main, logic, *both)


_HEAD: Final = 2  # address and command


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``.

    A reply does not identify its request: it is decoded as the reply to the latest one. If the
    checksum is wrong for the newer firmware's layout, the older one's is tried.
    """

    def __init__(self) -> None:
        self._address, self._command, self._write = 0, 0, True
        self._reply = b""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield the request: the command with its numbers."""
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
        """Yield the complete reply."""
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
