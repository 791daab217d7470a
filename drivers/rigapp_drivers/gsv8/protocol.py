"""Commands of the GSV-8: numbers, request bytes, replies (SPEC p9-12 and p24-90).

A request is ``AA | 9n | command | parameters | 85`` with n parameter bytes; with a CRC-8 it is
``AA | Bn | command | parameters | crc | 85``. Multi-byte values are big-endian.
"""

from __future__ import annotations

import enum
import functools
import struct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say


def _crc8_table() -> bytes:
    table = bytearray()
    for byte in range(256):
        for _ in range(8):
            byte = (byte << 1) ^ (0x07 if byte & 0x80 else 0)
        table.append(byte & 0xFF)
    return bytes(table)


def _crc16_table() -> NDArray[np.uint16]:
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = (byte >> 1) ^ (0xA001 if byte & 1 else 0)
        table.append(byte)
    return np.array(table, dtype=np.uint16)


_CRC8 = _crc8_table()
_CRC16 = _crc16_table()


def crc8(data: bytes) -> int:
    """Return the CRC-8 of commands: polynomial 0x07, initial 0, of all bytes after the prefix."""
    crc = 0
    for byte in data:
        crc = _CRC8[crc ^ byte]
    return crc


def crc16(data: bytes) -> int:
    """Return the CRC-16 of measured values: Modbus, sent low byte first."""
    return int(crc16_of_rows(np.frombuffer(data, np.uint8)[None])[0])


def crc16_of_rows(rows: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Return the CRC-16 of every row of (n, bytes).

    A CRC is linear: the contribution of a byte depends on its value and position only. So all bytes
    are looked up at once; byte by byte takes ten times as long for the rows of one packet.
    """
    of_zeros, shares, places = _crc16_shares(rows.shape[1])
    parts = shares.take(np.ascontiguousarray(rows.T) + places)
    return np.bitwise_xor.reduce(parts, axis=0, initial=of_zeros)


@functools.lru_cache(maxsize=64)
def _crc16_shares(length: int) -> tuple[np.uint16, NDArray[np.uint16], NDArray[np.intp]]:
    """Return the CRC-16 of ``length`` zeros, the bytes' contributions, each position's offset."""
    of_zeros, share = np.uint16(0xFFFF), _CRC16
    shares = np.empty((length, 256), np.uint16)
    for index in reversed(range(length)):
        shares[index] = share
        share = (share >> 8) ^ _CRC16[share & 0xFF]
        of_zeros = (of_zeros >> 8) ^ _CRC16[of_zeros & 0xFF]
    return of_zeros, shares.ravel(), 256 * np.arange(length)[:, None]


MODEL_GSV8 = 0x08
ANALOG_CHANNELS = 8
COUNTER_CHANNELS = 2
USER_CHANNELS = ANALOG_CHANNELS + COUNTER_CHANNELS
MAPPING_HIDDEN_FIRMWARE = (1, 38)  # up to it, only GetInterface returns the number of objects
COUNTER_FIRMWARE = (1, 45)
CHECKSUM_FIRMWARE = (1, 56)
HIGH_SPEED_FIRMWARE = (1, 54)
ZERO_LOCK_FIRMWARE = (1, 54)
HIGH_SPEED_FROM_HZ = 12000.0
HALF_SCALE_CODE = 0x003CF3CF
"""Signed int24 code of the test value injected by command 35: half of the nominal range."""

ALLOWED_RATES_HZ: tuple[float, ...] = tuple(
    float(rate)
    for rate in (
        *(1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 16, 20, 24, 25, 30, 32, 40, 48, 50, 60, 75, 80, 96),
        *(100, 120, 125, 150, 160, 192, 200, 240, 250, 300, 320, 375, 384, 400, 480, 500, 600),
        *(640, 750, 800, 960, 1000, 1200, 1500, 1600, 1920, 2000, 2400, 3000, 3200, 4000, 4800),
        *(6000, 8000, 9600, 12000, 16000, 24000, 48000),
    )
)
"""Divisors of 48000 that the device accepts as data rate (MAN p42-44)."""


class Command(enum.IntEnum):
    """Command numbers."""

    RESET_STATUS = 0x00
    GET_INTERFACE = 0x01
    READ_ZERO = 0x02
    SET_ZERO = 0x0C
    READ_USER_SCALE = 0x14
    WRITE_USER_SCALE = 0x15
    GET_SERIAL_NUMBER = 0x1F
    STOP_TRANSMISSION = 0x23
    START_TRANSMISSION = 0x24
    CLEAR_BUFFER = 0x25
    GET_MODE = 0x26
    SET_MODE = 0x27
    GET_SOFTWARE_CONFIGURATION = 0x2A
    FIRMWARE_VERSION = 0x2B
    GET_PROHIBIT_SET_ZERO = 0x32
    SET_INJECTION = 0x35
    GET_VALUE = 0x3B
    GET_LAST_PROTOCOL_ERROR = 0x42
    GET_LAST_VALUE_ERROR = 0x43
    GET_TX_MAPPING = 0x49
    SET_TX_MAPPING = 0x4A
    GET_DIO_DIRECTION = 0x59
    SET_DIO_DIRECTION = 0x5A
    READ_DIO_THRESHOLD = 0x5F
    WRITE_DIO_THRESHOLD = 0x60
    READ_DATA_RATE_RANGE = 0x63
    READ_COUNTER_MODE = 0x69
    WRITE_COUNTER_MODE = 0x6A
    RELEASE_INTERFACE = 0x7A
    READ_INTERFACE_SETTING = 0x7B
    GET_TX_MODE = 0x80
    SET_TX_MODE = 0x81
    READ_DATA_RATE = 0x8A
    WRITE_DATA_RATE = 0x8B
    READ_ANALOG_FILTER = 0x90
    WRITE_ANALOG_FILTER = 0x91
    READ_USER_OFFSET = 0x9A
    WRITE_USER_OFFSET = 0x9B
    GET_INPUT_TYPE = 0xA2
    SET_INPUT_TYPE = 0xA3

    @property
    def words(self) -> str:
        """Return the command in words, with its number."""
        return say("{} ‹command {}›", self.name.lower().replace("_", " "), f"{self.value:02X}")


class InputType(enum.IntEnum):
    """Wiring and range of an analog input."""

    BRIDGE_8V75 = 0
    BRIDGE_5V = 1
    BRIDGE_2V5 = 2
    SINGLE_ENDED = 3
    PT1000 = 4
    THERMOCOUPLE_K_ABSOLUTE = 5
    THERMOCOUPLE_K_RELATIVE = 6
    COUNTER = 7

    @property
    def words(self) -> str:
        """Return the input type in words."""
        return _INPUT_WORDS[self]


_INPUT_WORDS = {
    InputType.BRIDGE_8V75: say("bridge, 8.75 V excitation, 2 mV/V"),
    InputType.BRIDGE_5V: say("bridge, 5 V excitation, 3.5 mV/V"),
    InputType.BRIDGE_2V5: say("bridge, 2.5 V excitation, 7 mV/V"),
    InputType.SINGLE_ENDED: say("single-ended, 10 V"),
    InputType.PT1000: "PT1000",
    InputType.THERMOCOUPLE_K_ABSOLUTE: say("thermocouple K, absolute"),
    InputType.THERMOCOUPLE_K_RELATIVE: say("thermocouple K, relative"),
    InputType.COUNTER: say("counter or frequency"),
}

NOMINAL_RANGE: dict[InputType, float] = {
    InputType.BRIDGE_8V75: 2.0,
    InputType.BRIDGE_5V: 3.5,
    InputType.BRIDGE_2V5: 7.0,
    InputType.SINGLE_ENDED: 10.0,
}
"""Nominal range in mV/V (bridges) or V (single-ended)."""


class Quadrature(enum.IntEnum):
    """Evaluation of the edges of A and B by the counter (bits 4:3 of the counter mode)."""

    PULSE_AND_DIRECTION = 0
    X1 = 1
    X2 = 2
    X4 = 3

    @property
    def counts_per_line(self) -> int:
        """Return the counts per encoder line."""
        return (1, 1, 2, 4)[self.value]


COUNTER_PRESENT = 1 << 0
COUNTER_ON = 1 << 1
SPEED_ON = 1 << 2
COUNTER_USES_INDEX = 1 << 5
COUNTER_SATURATES = 1 << 6
COUNTER_STORES_LAST = 1 << 7
PULL_UPS_OFF = 1 << 10
INDEX_INVERTED = 1 << 11
COUNTER_NOISE_FILTER = 1 << 12

MODE_MULTI_AXIS = 1 << 0
MODE_FILTER_AUTOMATIC = 1 << 1
MODE_NOISE_CUT = 1 << 3
MODE_WRITE_LOCK = 1 << 7
MODE_AUTO_ZERO = 1 << 22

TX_OFF = 1 << 0
TX_ALWAYS_OFF = 1 << 1
TX_MAXIMA = 1 << 2
TX_MINIMA = 1 << 3
TX_CHECKSUM = 1 << 5

INTERFACE_KINDS = {
    1: "RS-232",
    2: say("UART 3.3 V"),
    3: "USB",
    4: "CAN",
    5: "Ethernet",
    6: "RS-422",
    7: "SPI",
}
INTERFACE_USB = 3
OFFSET_BINARY_FLAG = 1 << 3
ACTIVE_BAUD_RATE = 4  # data type of an extended interface setting

MAPPED_OBJECTS = 0  # index of the TX mapping: number of objects in the frame
TX_FLAGS, TX_DATA_TYPE = 0, 1  # indices of the TX mode


@dataclass(frozen=True, slots=True)
class CounterMode:
    """Settings of a quadrature input (SPEC p63-64)."""

    on: bool = True
    quadrature: Quadrature = Quadrature.X4
    use_index: bool = True
    saturate: bool = False
    store_last: bool = False
    pull_ups: bool = True
    index_inverted: bool = False
    noise_filter: bool = False

    def encode(self) -> int:
        """Return the mode flags."""
        flags = self.quadrature << 3 ^ _COUNTER_INVERTED
        return flags ^ sum(bit for name, bit in _COUNTER_BITS.items() if getattr(self, name))


_COUNTER_BITS = {
    "on": COUNTER_ON,
    "use_index": COUNTER_USES_INDEX,
    "saturate": COUNTER_SATURATES,
    "store_last": COUNTER_STORES_LAST,
    "pull_ups": PULL_UPS_OFF,
    "index_inverted": INDEX_INVERTED,
    "noise_filter": COUNTER_NOISE_FILTER,
}
_COUNTER_INVERTED = PULL_UPS_OFF  # set means off


@functools.lru_cache(maxsize=256)
def decode_counter_mode(flags: int) -> CounterMode:
    """Return the settings in mode flags; speed measuring is not represented."""
    on = {name: bool((flags ^ _COUNTER_INVERTED) & bit) for name, bit in _COUNTER_BITS.items()}
    return CounterMode(quadrature=Quadrature(flags >> 3 & 3), **on)


def request(command: int, parameters: bytes = b"", *, checksum: bool = False) -> bytes:
    """Return the bytes of a request with at most 15 parameter bytes."""
    if len(parameters) > 15:
        raise ValueError(say("a request holds at most 15 parameter bytes"))
    body = bytes(((0xB0 if checksum else 0x90) | len(parameters), command)) + parameters
    check = bytes((crc8(body),)) if checksum else b""
    return b"\xaa" + body + check + b"\x85"


def u8(*values: int) -> bytes:
    """Return bytes of unsigned 8-bit values."""
    return bytes(values)


def u16(value: int) -> bytes:
    """Return an unsigned 16-bit value, big-endian."""
    return struct.pack(">H", value)


def u32(value: int) -> bytes:
    """Return an unsigned 32-bit value, big-endian."""
    return struct.pack(">I", value)


def f32(value: float) -> bytes:
    """Return a 32-bit float, big-endian."""
    return struct.pack(">f", value)


def read_f32(data: bytes) -> float:
    """Return the 32-bit float in four bytes."""
    return float(struct.unpack(">f", data)[0])


def decode_version(data: bytes) -> tuple[int, int]:
    """Return the firmware's version in four bytes."""
    major, minor = struct.unpack(">HH", data)
    return major, minor


def version_words(firmware: tuple[int, int]) -> str:
    """Return a firmware version in the manufacturer's notation."""
    return f"{firmware[0]}.{firmware[1]:02d}"


def counter_index(counter: int, index: int) -> int:
    """Return the index byte of commands 69 and 6A: counter 0 or 1; 0 mode, 1 gate, 2 home."""
    return counter << 4 | index


@dataclass(frozen=True, slots=True)
class InterfaceReply:
    """The reply to GetInterface (SPEC p27)."""

    model: int
    data_checksum: bool
    objects: int
    transmitting: bool
    data_type: int
    write_protected: bool
    number: int
    interfaces: int

    def encode(self) -> bytes:
        """Return the four data bytes."""
        return bytes(
            (
                (0xC0 if self.data_checksum else 0x40) | self.model,
                (self.objects - 1) << 4 | (8 if self.transmitting else 0) | self.data_type,
                (0x80 if self.write_protected else 0) | self.number,
                self.interfaces,
            )
        )


def decode_interface(data: bytes) -> InterfaceReply:
    """Return the meaning of the four data bytes of GetInterface."""
    kind, stream, protection, count = data
    return InterfaceReply(
        model=kind & 0x3F,
        data_checksum=kind >> 6 == 3,
        objects=(stream >> 4) + 1,
        transmitting=bool(stream & 8),
        data_type=stream & 7,
        write_protected=bool(protection & 0xC0),
        number=protection & 0x3F,
        interfaces=count,
    )


@dataclass(frozen=True, slots=True)
class InterfaceSetting:
    """One entry of the interface settings (SPEC p73, p89)."""

    next_index: int
    kind: int
    data: int
    writable: bool = False

    def encode(self) -> bytes:
        """Return the six data bytes."""
        return bytes((self.next_index, self.kind | (0x80 if self.writable else 0))) + u32(self.data)


def decode_interface_setting(data: bytes) -> InterfaceSetting:
    """Return the meaning of the six data bytes of command 7B."""
    return InterfaceSetting(
        data[0], data[1] & 0x7F, int.from_bytes(data[2:6], "big"), bool(data[1] & 0x80)
    )


SOFTWARE_OPTIONS = {
    0: "ADC",
    1: "EtherCAT",
    2: "LCD",
    3: "TEDS",
    4: say("digital lines"),
    6: say("analog outputs"),
    7: "serial",
    8: say("frequency output"),
    9: say("sensor supervisor"),
    10: "multi-axis",
    11: "CANopen",
    12: say("four-channel 96 kHz model"),
}


def software_options(flags: int) -> tuple[str, ...]:
    """Return the options that GetSoftwareConfiguration reports, in words."""
    return tuple(words for bit, words in SOFTWARE_OPTIONS.items() if flags >> bit & 1)


def neighbours_of_rate(rate_Hz: float) -> tuple[float, ...]:
    """Return the next allowed rates below and above a rate that is not allowed."""
    below: Sequence[float] = [rate for rate in ALLOWED_RATES_HZ if rate < rate_Hz]
    above: Sequence[float] = [rate for rate in ALLOWED_RATES_HZ if rate > rate_Hz]
    return (*below[-1:], *above[:1])
