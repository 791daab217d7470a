"""Stream commands of a simulated GSV-8: mapping, number format, rate, mode, filter."""

from __future__ import annotations

import math

from drivers.gsv8 import protocol as p
from drivers.gsv8.numbers import DataType
from drivers.gsv8.protocol import Command, f32, read_f32, u16, u32
from drivers.gsv8.simulated_device import Device, Entry, Refused, only

_WRITABLE_MODE = 0b1111 | 0xFFF << 8 | 1 << 22
_FILTERS_HZ = (28.0, 885.0, 11400.0)


class StreamCommands:
    """Obey what shapes the stream of measured values."""

    def __init__(self, device: Device) -> None:
        self._device = device

    def table(self) -> dict[int, Entry]:
        """Return the commands."""
        return {
            Command.GET_MODE: Entry((0,), lambda a: u32(self._device.settings.mode)),
            Command.SET_MODE: Entry((4,), self._set_mode, writes=True),
            Command.GET_TX_MAPPING: Entry((1,), self._get_mapping),
            Command.SET_TX_MAPPING: Entry((3,), self._set_mapping, writes=True),
            Command.READ_DATA_RATE_RANGE: Entry((1,), self._rate_range),
            Command.GET_TX_MODE: Entry((1,), self._get_transmit_mode),
            Command.SET_TX_MODE: Entry((3,), self._set_transmit_mode, writes=True),
            Command.READ_DATA_RATE: Entry((0,), lambda a: f32(self._device.settings.rate_Hz)),
            Command.WRITE_DATA_RATE: Entry((4,), self._write_rate, writes=True),
            Command.READ_ANALOG_FILTER: Entry((0,), lambda a: u16(round(self._filter_Hz()))),
            Command.WRITE_ANALOG_FILTER: Entry((4,), self._write_filter, writes=True),
        }

    def _get_mapping(self, a: bytes) -> bytes:
        only(a[0], 0)
        return u16(
            0 if self._device.hardware.firmware <= (1, 38) else self._device.settings.objects
        )

    def _set_mapping(self, a: bytes) -> bytes:
        only(a[0], 0)
        objects = int.from_bytes(a[1:], "big")
        counters = len(self._device.settings.counters)
        fewest = max(2, counters + 1) if self._device.hardware.usb else 1 + counters
        if objects < fewest:
            raise Refused(0x55)
        if objects > p.ANALOG_CHANNELS + counters:
            raise Refused(0x54)
        if self._device.settings.rate_Hz > self._device.highest_rate_Hz(objects=objects):
            raise Refused(0x64)
        self._device.settings.objects = objects
        return b""

    def _get_transmit_mode(self, a: bytes) -> bytes:
        highest = p.USER_CHANNELS if self._device.hardware.counter_present else p.ANALOG_CHANNELS
        off = 0 if self._device.state.transmitting else p.TX_OFF
        values = (
            self._device.settings.transmit_flags | off,
            self._device.settings.data_type,
            highest << 8 | 2,
        )
        if a[0] >= len(values):
            raise Refused(0x51)
        return u16(values[a[0]])

    def _set_transmit_mode(self, a: bytes) -> bytes:
        index, value = a[0], int.from_bytes(a[1:], "big")
        if index == p.TX_FLAGS:
            if value & (p.TX_MAXIMA | p.TX_MINIMA):
                raise Refused(0x59)
            self._device.settings.transmit_flags = value & (p.TX_ALWAYS_OFF | p.TX_CHECKSUM)
        elif index == p.TX_DATA_TYPE:
            if value not in tuple(DataType):
                raise Refused(0x52)
            data_type = DataType(value)
            if self._device.settings.rate_Hz > self._device.highest_rate_Hz(data_type):
                raise Refused(0x64)
            self._device.settings.data_type = data_type
        else:
            raise Refused(0x76 if index == 2 else 0x51)
        return b""

    def _rate_range(self, a: bytes) -> bytes:
        if a[0] > 1:
            raise Refused(0x51)
        return f32(1.0 if a[0] else self._device.highest_rate_Hz())

    def _write_rate(self, a: bytes) -> bytes:
        rate = read_f32(a)
        if rate not in p.ALLOWED_RATES_HZ:
            raise Refused(0x52)
        if rate > self._device.highest_rate_Hz():
            raise Refused(0x64)
        self._device.settings.rate_Hz = rate
        return b""

    def _set_mode(self, a: bytes) -> bytes:
        flags = int.from_bytes(a, "big")
        if flags & ~(_WRITABLE_MODE | p.MODE_WRITE_LOCK):
            raise Refused(0x53)
        self._device.settings.mode = flags & _WRITABLE_MODE
        return b""

    def _filter_Hz(self) -> float:
        if not self._device.settings.mode & p.MODE_FILTER_AUTOMATIC:
            return self._device.settings.filter_Hz
        return next(
            (f for f in _FILTERS_HZ if f >= 0.4 * self._device.settings.rate_Hz), _FILTERS_HZ[-1]
        )

    def _write_filter(self, a: bytes) -> bytes:
        wanted = read_f32(a)
        if not wanted > 0.0 or math.isinf(wanted):
            raise Refused(0x52)
        self._device.settings.filter_Hz = min(_FILTERS_HZ, key=lambda f: abs(f - wanted))
        self._device.settings.mode &= ~p.MODE_FILTER_AUTOMATIC
        return b""
