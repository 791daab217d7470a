"""Read and write single settings of a GSV-8 as numbers (SPEC p27-90)."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from rigapp.texts import say
from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.link import Link
from rigapp_drivers.gsv8.protocol import Command, InputType, u8
from rigapp_drivers.gsv8.words import ValueFault, decode_value_fault

SLOW = 5.0
"""Time-out factor for slow commands of the device, which measure or store many values."""


@dataclass(frozen=True, slots=True)
class Setting:
    """One number stored in the device: its name in words, and how it is read and written.

    layout: ``struct`` format of the number; written: the format for writing if different. index:
    the parameters before it; asked: those for reading if different. mask: of the significant bits.
    kind: type of the number. since: first firmware that has it; before, it reads as 0.
    """

    words: str
    read: Command
    write: Command
    layout: str
    index: bytes = b""
    requested: bytes | None = None
    written: str = ""
    mask: int | None = None
    kind: Callable[[Any], Any] | None = None
    since: tuple[int, int] = (0, 0)
    patience: float = 1.0


RATE = Setting("sample_rate_Hz", Command.READ_DATA_RATE, Command.WRITE_DATA_RATE, ">f")
MODE = Setting(
    say("mode (multi-axis, noise cut and auto-zero off; analog filter)"),
    Command.GET_MODE,
    Command.SET_MODE,
    ">I",
    mask=~p.MODE_WRITE_LOCK,  # set by the device only
)
FILTER = Setting(
    "analog_filter", Command.READ_ANALOG_FILTER, Command.WRITE_ANALOG_FILTER, ">H", written=">f"
)
FLAGS = Setting(
    say("transmission (always off, maxima or minima in the frame)"),
    Command.GET_TX_MODE,
    Command.SET_TX_MODE,
    ">H",
    u8(p.TX_FLAGS),
    mask=p.TX_ALWAYS_OFF | p.TX_MAXIMA | p.TX_MINIMA | p.TX_CHECKSUM,
)
DATA_TYPE = Setting("data_type", Command.GET_TX_MODE, Command.SET_TX_MODE, ">H", u8(p.TX_DATA_TYPE))
OBJECTS = Setting(
    say("number of inputs in the frame"),
    Command.GET_TX_MAPPING,
    Command.SET_TX_MAPPING,
    ">H",
    u8(p.MAPPED_OBJECTS),
)


def input_type(channel: int) -> Setting:
    """Return the input type of an analog channel; writing it reloads scale and offset."""
    return Setting(
        say("input type of analog_{}", channel),
        Command.GET_INPUT_TYPE,
        Command.SET_INPUT_TYPE,
        ">B4x",
        u8(channel),
        requested=u8(channel, 0xFF),
        written=">B",
        kind=InputType,
        patience=SLOW,
    )


def scale(channel: int) -> Setting:
    """Return the user scale of a channel."""
    words = say("user scale of analog_{}", channel)
    read, write = Command.READ_USER_SCALE, Command.WRITE_USER_SCALE
    return Setting(words, read, write, ">f", u8(channel))


def offset(channel: int) -> Setting:
    """Return the user offset of a channel."""
    words = say("user offset of analog_{}", channel)
    read, write = Command.READ_USER_OFFSET, Command.WRITE_USER_OFFSET
    return Setting(words, read, write, ">f", u8(channel))


def counter_mode(counter: int, mask: int | None = None) -> Setting:
    """Return the mode flags of a counter."""
    words = say("mode of counter_{}", counter + 1)
    return _counter(counter, 0, words, mask)


def counter_home(counter: int) -> Setting:
    """Return the count that is loaded at the index pulse."""
    return _counter(counter, 2, say("home value of counter_{}", counter + 1), None)


def _counter(counter: int, index: int, words: str, mask: int | None) -> Setting:
    address = u8(p.counter_index(counter, index))
    read, write = Command.READ_COUNTER_MODE, Command.WRITE_COUNTER_MODE
    return Setting(words, read, write, ">I", address, mask=mask, since=p.COUNTER_FIRMWARE)


WRITE_WAIT: Final = 3.0
"""Wait of a write in time-outs: the settings memory allows a limited number (SPEC p24)."""


class Registers:
    """Settings of one device; every method raises SettingRefused, ReplyTimeout, DeviceLost.

    channel: 1..8 analog, 9 and 10 the counters in use. counter: 0 or 1.
    """

    def __init__(self, link: Link, firmware: tuple[int, int]) -> None:
        self._link = link
        self._firmware = firmware
        self._session = 0x01

    def get(self, setting: Setting) -> Any:
        """Return the number stored in the device."""
        if setting is OBJECTS and self._firmware <= p.MAPPING_HIDDEN_FIRMWARE:
            return self._interface().objects
        if self._firmware < setting.since:
            return 0
        requested = setting.index if setting.requested is None else setting.requested
        data = self._link.command(setting.read, requested, reply=struct.calcsize(setting.layout))
        (value,) = struct.unpack(setting.layout, data)
        if setting.mask is not None:
            value &= setting.mask
        return value if setting.kind is None else setting.kind(value)

    def set(self, setting: Setting, value: float) -> None:
        """Write a number once: without a response, read back before writing again."""
        parameters = setting.index + struct.pack(setting.written or setting.layout, value)
        self._link.command(
            setting.write, parameters, tries=1, patience=WRITE_WAIT * setting.patience
        )

    def open_session(self, *, high_speed: bool, data_checksum: bool) -> p.InterfaceReply:
        """Stop the transmission; each call sets checksum and high-speed frames anew."""
        self._session = 0x01 | (0x04 if high_speed else 0) | (0x08 if data_checksum else 0)
        return self._interface()

    def interface_setting(self, index: int) -> p.InterfaceSetting | None:
        """Return an interface setting, None if the device does not report it."""
        response = self._link.exchange(Command.READ_INTERFACE_SETTING, u8(index))
        if response.status or len(response.data) != 6:
            return None
        return p.decode_interface_setting(response.data)

    def highest_rate_Hz(self) -> float:
        """Return the highest rate that the present settings allow."""
        data = self._link.command(Command.READ_DATA_RATE_RANGE, u8(0), reply=4)
        return p.read_f32(data)

    def zero(self, channel: int) -> int:
        """Return the stored zero of an analog channel as a signed 24-bit code."""
        data = self._link.command(Command.READ_ZERO, u8(channel), reply=4)
        return int.from_bytes(data, "big", signed=True)

    def latest_fault(self) -> ValueFault | None:
        """Return the latest value error since power-on, None if there is none."""
        response = self._link.exchange(Command.GET_LAST_VALUE_ERROR, u8(1), reply=6)
        return decode_value_fault(response.data) if response.status == 0 else None

    def set_zero(self, channel: int) -> None:
        """Zero a channel on its raw values; the device stores it."""
        self._link.command(Command.SET_ZERO, u8(channel), tries=1, patience=SLOW)

    def zero_prohibited(self, channel: int) -> bool:
        """Return whether zeroing a channel is prohibited in the device."""
        if self._firmware < p.ZERO_LOCK_FIRMWARE:
            return False
        data = self._link.command(Command.GET_PROHIBIT_SET_ZERO, reply=2)
        return bool(int.from_bytes(data, "big") >> (channel - 1) & 1)

    def lines_are_outputs(self, group: int) -> bool:
        """Return whether a group of four digital lines is known to be outputs."""
        response = self._link.exchange(Command.GET_DIO_DIRECTION, u8(group))
        return response.status == 0 and response.data[:1] == b"\x00"

    def _interface(self) -> p.InterfaceReply:
        data = self._link.command(Command.GET_INTERFACE, u8(self._session), reply=4)
        return p.decode_interface(data)
