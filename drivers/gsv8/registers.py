"""Read and write single settings of a GSV-8 as typed values (SPEC p27-90)."""

from __future__ import annotations

from drivers.gsv8 import protocol as p
from drivers.gsv8.link import Link
from drivers.gsv8.protocol import Command, InputType, f32, read_f32, u8, u16, u32
from drivers.gsv8.words import ValueFault, decode_value_fault

SLOW = 5.0
"""Patience for commands that the device may take long for: they measure, or store much."""

_MOST_STORED_FAULTS = 82  # the last index is 83 at most
_MAPPING_NOT_READABLE = (1, 38)


class Registers:
    """Settings of one device; every method raises SettingRefused, ReplyTimeout, DeviceLost.

    channel: 1..8 analog, 9 and 10 the counters in use. counter: 0 or 1.
    """

    def __init__(self, link: Link, firmware: tuple[int, int]) -> None:
        self._link = link
        self._firmware = firmware
        self._session = 0x01

    def open_session(self, *, high_speed: bool, data_checksum: bool) -> p.InterfaceReply:
        """Silence the device; every such call decides anew on checksum and high-speed frames."""
        self._session = 0x01 | (0x04 if high_speed else 0) | (0x08 if data_checksum else 0)
        return self._interface()

    def interface_setting(self, index: int) -> p.InterfaceSetting | None:
        """Return an interface setting, None where the device does not tell."""
        response = self._link.exchange(Command.READ_INTERFACE_SETTING, u8(index))
        if response.status or len(response.data) != 6:
            return None
        return p.decode_interface_setting(response.data)

    def rate_Hz(self) -> float:
        """Return the sample rate."""
        return self._f32(Command.READ_DATA_RATE)

    def set_rate_Hz(self, rate: float) -> None:
        """Set the sample rate."""
        self._link.command(Command.WRITE_DATA_RATE, f32(rate))

    def highest_rate_Hz(self) -> float:
        """Return the highest rate that the present settings allow."""
        return self._f32(Command.READ_DATA_RATE_RANGE, u8(0))

    def mode(self) -> int:
        """Return the mode flags without the write lock, which only the device sets."""
        return self._u32(Command.GET_MODE) & ~p.MODE_WRITE_LOCK

    def set_mode(self, flags: int) -> None:
        """Set the mode flags."""
        self._link.command(Command.SET_MODE, u32(flags))

    def filter_Hz(self) -> int:
        """Return the limit of the analog filter."""
        return int.from_bytes(self._link.command(Command.READ_ANALOG_FILTER, reply=2), "big")

    def set_filter_Hz(self, limit: int) -> None:
        """Set the limit of the analog filter."""
        self._link.command(Command.WRITE_ANALOG_FILTER, f32(limit))

    def transmit_mode(self, index: int) -> int:
        """Return a transmit mode: 0 flags, 1 number format."""
        return int.from_bytes(self._link.command(Command.GET_TX_MODE, u8(index), reply=2), "big")

    def set_transmit_mode(self, index: int, value: int) -> None:
        """Set a transmit mode."""
        self._link.command(Command.SET_TX_MODE, u8(index) + u16(value))

    def objects(self) -> int:
        """Return how many objects a frame has."""
        if self._firmware <= _MAPPING_NOT_READABLE:
            return self._interface().objects
        data = self._link.command(Command.GET_TX_MAPPING, u8(p.MAPPED_OBJECTS), reply=2)
        return int.from_bytes(data, "big")

    def set_objects(self, objects: int) -> None:
        """Set how many objects a frame has."""
        self._link.command(Command.SET_TX_MAPPING, u8(p.MAPPED_OBJECTS) + u16(objects))

    def input_type(self, channel: int) -> InputType:
        """Return the input type of an analog channel."""
        return InputType(self._link.command(Command.GET_INPUT_TYPE, u8(channel, 0xFF), reply=5)[0])

    def set_input_type(self, channel: int, kind: InputType) -> None:
        """Set the input type; the device then reloads scale and offset of the channel."""
        self._link.command(Command.SET_INPUT_TYPE, u8(channel, kind), patience=SLOW)

    def scale(self, channel: int) -> float:
        """Return the user scale."""
        return self._f32(Command.READ_USER_SCALE, u8(channel))

    def set_scale(self, channel: int, scale: float) -> None:
        """Set the user scale."""
        self._link.command(Command.WRITE_USER_SCALE, u8(channel) + f32(scale))

    def offset(self, channel: int) -> float:
        """Return the user offset."""
        return self._f32(Command.READ_USER_OFFSET, u8(channel))

    def set_offset(self, channel: int, offset: float) -> None:
        """Set the user offset."""
        self._link.command(Command.WRITE_USER_OFFSET, u8(channel) + f32(offset))

    def zero(self, channel: int) -> int:
        """Return the stored zero of an analog channel as a signed 24-bit code."""
        data = self._link.command(Command.READ_ZERO, u8(channel), reply=4)
        return int.from_bytes(data, "big", signed=True)

    def value_faults(self) -> tuple[ValueFault, ...]:
        """Return the value errors that the device stored, oldest first."""
        stored = self._link.command(Command.GET_LAST_VALUE_ERROR, u8(0), reply=6)[1]
        faults = []
        for place in range(min(stored, _MOST_STORED_FAULTS)):
            response = self._link.exchange(Command.GET_LAST_VALUE_ERROR, u8(2 + place), reply=6)
            fault = decode_value_fault(response.data) if response.status == 0 else None
            if fault is not None:
                faults.append(fault)
        return tuple(faults)

    def latest_fault(self) -> ValueFault | None:
        """Return the latest value error since the device's power came, None when there is none."""
        response = self._link.exchange(Command.GET_LAST_VALUE_ERROR, u8(1), reply=6)
        return decode_value_fault(response.data) if response.status == 0 else None

    def set_zero(self, channel: int) -> None:
        """Zero a channel on its raw values; the device stores it."""
        self._link.command(Command.SET_ZERO, u8(channel), tries=1, patience=SLOW)

    def zero_prohibited(self, channel: int) -> bool:
        """Tell whether zeroing a channel is prohibited in the device."""
        if self._firmware < p.ZERO_LOCK_FIRMWARE:
            return False
        data = self._link.command(Command.GET_PROHIBIT_SET_ZERO, reply=2)
        return bool(int.from_bytes(data, "big") >> (channel - 1) & 1)

    def counter_mode(self, counter: int) -> int:
        """Return the mode flags of a counter, 0 where the device has none."""
        if self._firmware < p.COUNTER_FIRMWARE:
            return 0
        return self._u32(Command.READ_COUNTER_MODE, u8(p.counter_index(counter, 0)))

    def set_counter_mode(self, counter: int, flags: int) -> None:
        """Set the mode flags of a counter."""
        parameters = u8(p.counter_index(counter, 0)) + u32(flags)
        self._link.command(Command.WRITE_COUNTER_MODE, parameters)

    def counter_home(self, counter: int) -> int:
        """Return the count that the index sets."""
        return self._u32(Command.READ_COUNTER_MODE, u8(p.counter_index(counter, 2)))

    def set_counter_home(self, counter: int, count: int) -> None:
        """Set the count that the index sets."""
        parameters = u8(p.counter_index(counter, 2)) + u32(count)
        self._link.command(Command.WRITE_COUNTER_MODE, parameters)

    def lines_are_outputs(self, group: int) -> bool:
        """Tell whether a group of four digital lines is known to be outputs."""
        response = self._link.exchange(Command.GET_DIO_DIRECTION, u8(group))
        return response.status == 0 and response.data[:1] == b"\x00"

    def _interface(self) -> p.InterfaceReply:
        data = self._link.command(Command.GET_INTERFACE, u8(self._session), reply=4)
        return p.decode_interface(data)

    def _u32(self, command: Command, parameters: bytes = b"") -> int:
        return int.from_bytes(self._link.command(command, parameters, reply=4), "big")

    def _f32(self, command: Command, parameters: bytes = b"") -> float:
        return read_f32(self._link.command(command, parameters, reply=4))
