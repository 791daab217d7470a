"""The commands of a simulated GSV-8: each a function of the device and the parameter bytes.

Not implemented, as a rig does not use them: levels of digital lines, raw values, analog outputs,
units of the display, stored sets of settings, the bit rate of a UART, the list of commands. The
device responds that it has no such command.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping
from typing import NamedTuple

from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.numbers import DataType
from rigapp_drivers.gsv8.protocol import Command, InputType, f32, read_f32, u8, u16, u32
from rigapp_drivers.gsv8.simulator.state import Device, default_scale
from rigapp_drivers.gsv8.words import encode_value_fault

UART_SETTING = 10
WRITE_ACCESS_ELSEWHERE = 0x75
_HARDWARE_OPTIONS = 1 << 0 | 1 << 4 | 1 << 6 | 1 << 7
_WRITABLE_MODE = 0b1111 | 0xFFF << 8 | 1 << 22
_WRITABLE_COUNTER = 0x1FFE
_FILTER_SHARE = 0.4  # of the sample rate; the filter must pass all frequencies below
_FILTERS_HZ = (28.0, 885.0, 11400.0)


class Entry(NamedTuple):
    """A command: its function, allowed numbers of parameters, whether it changes a setting.

    since: first firmware with this command.
    """

    handler: Callable[[Device, bytes], bytes]
    length: int
    writes: bool = False
    since: tuple[int, int] = (0, 0)


class RequestRefused(Exception):
    """Respond with a status code and no data."""

    def __init__(self, status: int) -> None:
        super().__init__(f"status {status:02X}")
        self.status = status


def _among(value: int, first: int, last: int, status: int = 0x51) -> int:
    """Return the index of a number counted from ``first``; refuse one outside the range."""
    if not first <= value <= last:
        raise RequestRefused(status)
    return value - first


def _analog(channel: int) -> int:
    return _among(channel, 1, p.ANALOG_CHANNELS)


def _user(channel: int) -> int:
    return _among(channel, 1, p.USER_CHANNELS)


def _users(channel: int) -> range:
    """Return the indices of a channel 1..10, of all for 0."""
    return range(p.USER_CHANNELS) if channel == 0 else range(_user(channel), channel)


def _line(number: int) -> int:
    return _among(number, 1, 16)


def _number(data: bytes) -> int:
    return int.from_bytes(data, "big")


# --- the link and the device as a whole -----------------------------------------------------------


def _reset_status(d: Device, _: bytes) -> bytes:
    d.state.synchronous_error = d.state.asynchronous_error = 0
    return b""


def _get_interface(d: Device, a: bytes) -> bytes:
    flags, state, hardware = a[0], d.state, d.hardware
    if flags & 0xF0:
        raise RequestRefused(0x53)
    if flags & 3 == 3:
        raise RequestRefused(0x56)
    if flags & 8 and hardware.firmware < p.CHECKSUM_FIRMWARE:
        raise RequestRefused(0x59)
    if flags & 3:
        state.transmitting = flags & 3 == 2
    state.data_checksum = bool(flags & 8)
    modern = hardware.firmware >= p.HIGH_SPEED_FIRMWARE
    state.high_speed = bool(flags & 4) and modern and hardware.usb
    return p.InterfaceReply(
        model=p.MODEL_GSV8,
        data_checksum=state.data_checksum,
        objects=d.settings.objects,
        transmitting=state.transmitting,
        data_type=d.settings.data_type,
        write_protected=not d.write_access,
        number=0 if hardware.usb else 1,
        interfaces=2,
    ).encode()


def _transmit(on: bool) -> Callable[[Device, bytes], bytes]:
    def obey(d: Device, _: bytes) -> bytes:
        d.state.transmitting = on
        return b""

    return obey


def _protocol_error(d: Device, a: bytes) -> bytes:
    requested = _among(a[0], 0, 1)
    return u32(d.state.asynchronous_error if requested else d.state.synchronous_error)


def _value_error(d: Device, a: bytes) -> bytes:
    faults, requested = d.state.faults, _among(a[0], 0, 1)
    if requested == 0:
        return u8(len(faults), len(faults), 0, 0, 0, 0)
    return encode_value_fault(faults[-1]) if faults else bytes(6)


def _get_interface_setting(d: Device, a: bytes) -> bytes:
    flags = 0b111 | (p.OFFSET_BINARY_FLAG if d.hardware.offset_binary else 0) | 1 << 24
    rate = d.settings.uart_baud_rate
    settings = {
        0: p.InterfaceSetting(1, p.INTERFACE_USB, flags),
        1: p.InterfaceSetting(UART_SETTING, 2, flags),
        UART_SETTING: p.InterfaceSetting(0, p.ACTIVE_BAUD_RATE, rate, writable=True),
    }
    if a[0] not in settings:
        raise RequestRefused(0x51)
    return settings[a[0]].encode()


# --- the stream -----------------------------------------------------------------------------------


def _get_mapping(d: Device, a: bytes) -> bytes:
    _among(a[0], 0, 0)
    return u16(0 if d.hardware.firmware <= p.MAPPING_HIDDEN_FIRMWARE else d.settings.objects)


def _set_mapping(d: Device, a: bytes) -> bytes:
    _among(a[0], 0, 0)
    objects, counters = _number(a[1:]), len(d.settings.counters)
    if objects < (max(2, counters + 1) if d.hardware.usb else 1 + counters):
        raise RequestRefused(0x55)
    if objects > p.ANALOG_CHANNELS + counters:
        raise RequestRefused(0x54)
    if d.settings.rate_Hz > d.highest_rate_Hz(objects=objects):
        raise RequestRefused(0x64)
    d.settings.objects = objects
    return b""


def _get_transmit_mode(d: Device, a: bytes) -> bytes:
    highest = p.USER_CHANNELS if d.hardware.counter_present else p.ANALOG_CHANNELS
    off = 0 if d.state.transmitting else p.TX_OFF
    values = (d.settings.transmit_flags | off, d.settings.data_type, highest << 8 | 2)
    return u16(values[_among(a[0], 0, 2)])


def _set_transmit_mode(d: Device, a: bytes) -> bytes:
    index, value = a[0], _number(a[1:])
    if index == p.TX_FLAGS:
        if value & (p.TX_MAXIMA | p.TX_MINIMA):
            raise RequestRefused(0x59)
        d.settings.transmit_flags = value & (p.TX_ALWAYS_OFF | p.TX_CHECKSUM)
    elif index == p.TX_DATA_TYPE:
        if value not in tuple(DataType):
            raise RequestRefused(0x52)
        if d.settings.rate_Hz > d.highest_rate_Hz(DataType(value)):
            raise RequestRefused(0x64)
        d.settings.data_type = DataType(value)
    else:
        raise RequestRefused(0x76 if index == 2 else 0x51)
    return b""


def _rate_range(d: Device, a: bytes) -> bytes:
    return f32(1.0 if _among(a[0], 0, 1) else d.highest_rate_Hz())


def _write_rate(d: Device, a: bytes) -> bytes:
    rate = read_f32(a)
    if rate not in p.ALLOWED_RATES_HZ:
        raise RequestRefused(0x52)
    if rate > d.highest_rate_Hz():
        raise RequestRefused(0x64)
    d.settings.rate_Hz = rate
    return b""


def _set_mode(d: Device, a: bytes) -> bytes:
    flags = _number(a)
    if flags & ~(_WRITABLE_MODE | p.MODE_WRITE_LOCK):
        raise RequestRefused(0x53)
    d.settings.mode = flags & _WRITABLE_MODE
    return b""


def _read_filter(d: Device, _: bytes) -> bytes:
    limit = d.settings.filter_Hz
    if d.settings.mode & p.MODE_FILTER_AUTOMATIC:
        wide = (f for f in _FILTERS_HZ if f >= _FILTER_SHARE * d.settings.rate_Hz)
        limit = next(wide, _FILTERS_HZ[-1])
    return u16(round(limit))


def _write_filter(d: Device, a: bytes) -> bytes:
    wanted = read_f32(a)
    if not wanted > 0.0 or math.isinf(wanted):
        raise RequestRefused(0x52)
    d.settings.filter_Hz = min(_FILTERS_HZ, key=lambda f: abs(f - wanted))
    d.settings.mode &= ~p.MODE_FILTER_AUTOMATIC
    return b""


# --- single channels ------------------------------------------------------------------------------


def _set_zero(d: Device, a: bytes) -> bytes:
    last = p.ANALOG_CHANNELS + len(d.settings.counters)
    _among(a[0], 0, last)
    for channel in [a[0]] if a[0] else range(1, last + 1):
        if not d.hardware.zero_prohibited >> (channel - 1) & 1:
            _zero(d, channel)
        elif a[0]:
            raise RequestRefused(0x70)
    return b""


def _zero(d: Device, channel: int) -> None:
    if channel <= p.ANALOG_CHANNELS:
        d.settings.zeros[channel - 1] = d.state.raw[channel - 1]
        return
    number = d.settings.counters[channel - p.ANALOG_CHANNELS - 1]
    d.counters[number].clear(p.decode_counter_mode(d.settings.counter_modes[number]))


def _write_floats(values: list[float], a: bytes) -> bytes:
    value = read_f32(a[1:])
    if not math.isfinite(value):
        raise RequestRefused(0x52)
    for index in _users(a[0]):
        values[index] = value
    return b""


def _get_input_type(d: Device, a: bytes) -> bytes:
    index, requested = _analog(a[0]), a[1]
    if requested != 0xFF and requested not in tuple(InputType):
        raise RequestRefused(0x52)
    kind = d.settings.input_types[index] if requested == 0xFF else InputType(requested)
    nominal = p.NOMINAL_RANGE.get(kind, 0.0)
    return u8(kind) + u32(round(nominal * (100_000 if kind is InputType.SINGLE_ENDED else 100)))


def _set_input_type(d: Device, a: bytes) -> bytes:
    _among(a[0], 0, p.ANALOG_CHANNELS)
    if a[1] >= InputType.COUNTER:
        raise RequestRefused(0x52)
    kind, settings = InputType(a[1]), d.settings
    for index in [a[0] - 1] if a[0] else range(p.ANALOG_CHANNELS):
        settings.input_types[index] = kind
        settings.scales[index] = default_scale(kind)
        settings.offsets[index] = 0.0
        settings.zeros[index] = 0
    return b""


def _inject(d: Device, a: bytes) -> bytes:
    d.state.injection = _among(a[0], 0, 3, 0x52)
    return b""


def _counter_values(d: Device, index: int) -> tuple[int, list[int]]:
    """Return the counter's number and the list (modes, gates, homes) selected by an index byte."""
    lists = (d.settings.counter_modes, d.settings.counter_gates, d.settings.counter_homes)
    return _among(index >> 4, 0, p.COUNTER_CHANNELS - 1), lists[_among(index & 0x0F, 0, 2)]


def _get_counter(d: Device, a: bytes) -> bytes:
    number, values = _counter_values(d, a[0])
    if values is not d.settings.counter_modes:
        return u32(values[number])
    return u32(values[number] | p.COUNTER_PRESENT if d.hardware.counter_present else 0)


def _set_counter(d: Device, a: bytes) -> bytes:
    number, values = _counter_values(d, a[0])
    if not d.hardware.counter_present:
        raise RequestRefused(0x85)
    if values is d.settings.counter_modes:
        _set_counter_mode(d, number, _number(a[1:]) & ~p.COUNTER_PRESENT)
    else:
        values[number] = _number(a[1:])
    return b""


def _set_counter_mode(d: Device, number: int, value: int) -> None:
    if value & ~_WRITABLE_COUNTER:
        raise RequestRefused(0x53)
    if value & p.SPEED_ON:
        raise RequestRefused(0x59)
    was_on = d.settings.counter_modes[number] & p.COUNTER_ON
    is_on = value & p.COUNTER_ON
    if is_on and d.settings.rate_Hz > d.highest_rate_Hz(counting=True):
        raise RequestRefused(0x64)
    d.settings.counter_modes[number] = value
    if is_on and not was_on:
        d.settings.objects += 1
        d.counters[number].clear(p.decode_counter_mode(value))
    elif was_on and not is_on:
        d.settings.objects = max(2, d.settings.objects - 1)


# --- digital lines --------------------------------------------------------------------------------


def _set_direction(d: Device, a: bytes) -> bytes:
    _among(a[0], 0, 4)
    _among(a[1], 0, 1, 0x52)
    for group in [a[0] - 1] if a[0] else range(4):
        d.settings.line_directions[group] = a[1]
    return b""


def _set_threshold(d: Device, a: bytes) -> bytes:
    d.settings.line_thresholds[_line(a[0]), a[1]] = read_f32(a[2:])
    return b""


def _nothing(d: Device, a: bytes) -> bytes:
    return b""


_COMMANDS: Mapping[int, Entry] = {
    Command.RESET_STATUS: Entry(_reset_status, 0),
    Command.GET_INTERFACE: Entry(_get_interface, 1),
    Command.READ_ZERO: Entry(lambda d, a: struct.pack(">i", d.settings.zeros[_analog(a[0])]), 1),
    Command.SET_ZERO: Entry(_set_zero, 1, writes=True),
    Command.READ_USER_SCALE: Entry(lambda d, a: f32(d.settings.scales[_user(a[0])]), 1),
    Command.WRITE_USER_SCALE: Entry(
        lambda d, a: _write_floats(d.settings.scales, a), 5, writes=True
    ),
    Command.GET_SERIAL_NUMBER: Entry(lambda d, a: u32(d.hardware.serial_number), 0),
    Command.STOP_TRANSMISSION: Entry(_transmit(False), 0),
    Command.START_TRANSMISSION: Entry(_transmit(True), 0),
    Command.CLEAR_BUFFER: Entry(_nothing, 0),
    Command.GET_MODE: Entry(lambda d, a: u32(d.settings.mode), 0),
    Command.SET_MODE: Entry(_set_mode, 4, writes=True),
    Command.GET_SOFTWARE_CONFIGURATION: Entry(lambda d, a: u32(_HARDWARE_OPTIONS), 0),
    Command.FIRMWARE_VERSION: Entry(lambda d, a: b"".join(map(u16, d.hardware.firmware)), 0),
    Command.GET_PROHIBIT_SET_ZERO: Entry(
        lambda d, a: u16(d.hardware.zero_prohibited), 0, since=p.ZERO_LOCK_FIRMWARE
    ),
    Command.SET_INJECTION: Entry(_inject, 1),
    Command.GET_VALUE: Entry(_nothing, 0),  # the response is a measured value
    Command.GET_LAST_PROTOCOL_ERROR: Entry(_protocol_error, 1),
    Command.GET_LAST_VALUE_ERROR: Entry(_value_error, 1),
    Command.GET_TX_MAPPING: Entry(_get_mapping, 1),
    Command.SET_TX_MAPPING: Entry(_set_mapping, 3, writes=True),
    Command.GET_DIO_DIRECTION: Entry(
        lambda d, a: u8(d.settings.line_directions[_among(a[0], 1, 4)]), 1
    ),
    Command.SET_DIO_DIRECTION: Entry(_set_direction, 2, writes=True),
    Command.READ_DIO_THRESHOLD: Entry(
        lambda d, a: f32(d.settings.line_thresholds.get((_line(a[0]), a[1]), 0.0)), 2
    ),
    Command.WRITE_DIO_THRESHOLD: Entry(_set_threshold, 6, writes=True),
    Command.READ_DATA_RATE_RANGE: Entry(_rate_range, 1),
    Command.READ_COUNTER_MODE: Entry(_get_counter, 1, since=p.COUNTER_FIRMWARE),
    Command.WRITE_COUNTER_MODE: Entry(_set_counter, 5, writes=True, since=p.COUNTER_FIRMWARE),
    Command.RELEASE_INTERFACE: Entry(_nothing, 0),
    Command.READ_INTERFACE_SETTING: Entry(_get_interface_setting, 1),
    Command.GET_TX_MODE: Entry(_get_transmit_mode, 1),
    Command.SET_TX_MODE: Entry(_set_transmit_mode, 3, writes=True),
    Command.READ_DATA_RATE: Entry(lambda d, a: f32(d.settings.rate_Hz), 0),
    Command.WRITE_DATA_RATE: Entry(_write_rate, 4, writes=True),
    Command.READ_ANALOG_FILTER: Entry(_read_filter, 0),
    Command.WRITE_ANALOG_FILTER: Entry(_write_filter, 4, writes=True),
    Command.READ_USER_OFFSET: Entry(lambda d, a: f32(d.settings.offsets[_user(a[0])]), 1),
    Command.WRITE_USER_OFFSET: Entry(
        lambda d, a: _write_floats(d.settings.offsets, a), 5, writes=True
    ),
    Command.GET_INPUT_TYPE: Entry(_get_input_type, 2),
    Command.SET_INPUT_TYPE: Entry(_set_input_type, 2, writes=True),
}


def obey(d: Device, command: int, parameters: bytes) -> bytes:
    """Execute a command and return its data; raise RequestRefused."""
    entry = _COMMANDS.get(command)
    if entry is None or entry.since > d.hardware.firmware:
        raise RequestRefused(0x40)
    if len(parameters) != entry.length:
        raise RequestRefused(0x5B)
    if entry.writes and not d.write_access:
        raise RequestRefused(WRITE_ACCESS_ELSEWHERE)
    data = entry.handler(d, parameters)
    d.writes += entry.writes
    return data
