"""Channel commands of a simulated GSV-8: zero, scales, input types, counters, single values."""

from __future__ import annotations

import math
import struct

from drivers.gsv8 import protocol as p
from drivers.gsv8.protocol import Command, InputType, f32, read_f32, u8, u16, u32
from drivers.gsv8.simulated_device import Device, Entry, Refused, analog, user, users
from drivers.gsv8.simulated_memory import default_scale

_WRITABLE_COUNTER = 0x1FFE


class ChannelCommands:
    """Obey what concerns single channels."""

    def __init__(self, device: Device) -> None:
        self._device = device

    def table(self) -> dict[int, Entry]:
        """Return the commands that this firmware has."""
        device = self._device
        commands: dict[int, Entry] = {
            Command.READ_ZERO: Entry((1,), self._read_zero),
            Command.SET_ZERO: Entry((1,), self._set_zero, writes=True),
            Command.GET_UNIT: Entry((1,), lambda a: u8(device.settings.units[user(a[0])])),
            Command.SET_UNIT: Entry((2,), self._set_unit, writes=True),
            Command.READ_USER_SCALE: Entry((1,), lambda a: f32(device.settings.scales[user(a[0])])),
            Command.WRITE_USER_SCALE: Entry((5,), self._write_scale, writes=True),
            Command.READ_USER_OFFSET: Entry(
                (1,), lambda a: f32(device.settings.offsets[user(a[0])])
            ),
            Command.WRITE_USER_OFFSET: Entry((5,), self._write_offset, writes=True),
            Command.SET_INJECTION: Entry((1,), self._inject),
            Command.GET_RAW_VALUE: Entry((1,), self._raw_value),
            Command.GET_INPUT_TYPE: Entry((2,), self._get_input_type),
            Command.SET_INPUT_TYPE: Entry((2,), self._set_input_type, writes=True),
        }
        if device.hardware.firmware >= p.COUNTER_FIRMWARE:
            commands[Command.READ_COUNTER_MODE] = Entry((1,), self._get_counter)
            commands[Command.WRITE_COUNTER_MODE] = Entry((5,), self._set_counter, writes=True)
        if device.hardware.firmware >= p.ZERO_LOCK_FIRMWARE:
            commands[Command.GET_PROHIBIT_SET_ZERO] = Entry(
                (0,), lambda a: u16(device.hardware.zero_prohibited)
            )
        return commands

    def _read_zero(self, a: bytes) -> bytes:
        return struct.pack(">i", self._device.settings.zeros[analog(a[0])])

    def _write_scale(self, a: bytes) -> bytes:
        return self._write_floats(self._device.settings.scales, a)

    def _write_offset(self, a: bytes) -> bytes:
        return self._write_floats(self._device.settings.offsets, a)

    def _set_zero(self, a: bytes) -> bytes:
        counters = len(self._device.settings.counters)
        if a[0] > p.ANALOG_CHANNELS + counters:
            raise Refused(0x51)
        last = p.ANALOG_CHANNELS + counters
        for channel in [a[0]] if a[0] else range(1, last + 1):
            if self._device.hardware.zero_prohibited >> (channel - 1) & 1:
                if a[0]:
                    raise Refused(0x70)
                continue
            self._zero(channel)
        return b""

    def _zero(self, channel: int) -> None:
        if channel <= p.ANALOG_CHANNELS:
            self._device.settings.zeros[channel - 1] = self._device.state.raw[channel - 1]
            return
        number = self._device.settings.counters[channel - p.ANALOG_CHANNELS - 1]
        mode = p.decode_counter_mode(self._device.settings.counter_modes[number])
        self._device.counters[number].clear(mode)

    def _set_unit(self, a: bytes) -> bytes:
        for place in users(a[0]):
            self._device.settings.units[place] = a[1]
        return b""

    def _write_floats(self, values: list[float], a: bytes) -> bytes:
        value = read_f32(a[1:])
        if not math.isfinite(value):
            raise Refused(0x52)
        for place in users(a[0]):
            values[place] = value
        return b""

    def _get_input_type(self, a: bytes) -> bytes:
        place, asked = analog(a[0]), a[1]
        if asked != 0xFF and asked not in tuple(InputType):
            raise Refused(0x52)
        kind = self._device.settings.input_types[place] if asked == 0xFF else InputType(asked)
        nominal = p.NOMINAL_RANGE.get(kind, 0.0)
        hundredths = nominal * (100_000 if kind is InputType.SINGLE_ENDED else 100)
        return u8(kind) + u32(round(hundredths))

    def _set_input_type(self, a: bytes) -> bytes:
        if a[0] > p.ANALOG_CHANNELS:
            raise Refused(0x51)
        if a[1] >= InputType.COUNTER:
            raise Refused(0x52)
        kind = InputType(a[1])
        for place in [a[0] - 1] if a[0] else range(p.ANALOG_CHANNELS):
            self._device.settings.input_types[place] = kind
            self._device.settings.scales[place] = default_scale(kind)
            self._device.settings.offsets[place] = 0.0
            self._device.settings.zeros[place] = 0
        return b""

    def _inject(self, a: bytes) -> bytes:
        if a[0] > 3:
            raise Refused(0x52)
        self._device.state.injection = a[0]
        return b""

    def _raw_value(self, a: bytes) -> bytes:
        place = user(a[0])
        if place < p.ANALOG_CHANNELS:
            injected = self._device.state.injection == 1
            value = p.HALF_SCALE_CODE if injected else self._device.state.raw[place]
        else:
            value = self._device.counters[place - p.ANALOG_CHANNELS].last_count
        return struct.pack(">i", value)

    def _counter_place(self, index: int) -> tuple[int, int]:
        number, place = index >> 4, index & 0x0F
        if number >= p.COUNTER_CHANNELS or place > 2:
            raise Refused(0x51)
        return number, place

    def _get_counter(self, a: bytes) -> bytes:
        number, place = self._counter_place(a[0])
        present = self._device.hardware.counter_present
        if place == 0:
            return u32(
                self._device.settings.counter_modes[number] | p.COUNTER_PRESENT if present else 0
            )
        values = (
            self._device.settings.counter_gates
            if place == 1
            else self._device.settings.counter_homes
        )
        return u32(values[number])

    def _set_counter(self, a: bytes) -> bytes:
        number, place = self._counter_place(a[0])
        value = int.from_bytes(a[1:], "big")
        if not self._device.hardware.counter_present:
            raise Refused(0x85)
        if place == 0:
            self._set_counter_mode(number, value)
        else:
            values = (
                self._device.settings.counter_gates
                if place == 1
                else self._device.settings.counter_homes
            )
            values[number] = value
        return b""

    def _set_counter_mode(self, number: int, value: int) -> None:
        value &= ~p.COUNTER_PRESENT
        if value & ~_WRITABLE_COUNTER:
            raise Refused(0x53)
        if value & p.SPEED_ON:
            raise Refused(0x59)
        was_on = self._device.settings.counter_modes[number] & p.COUNTER_ON
        is_on = value & p.COUNTER_ON
        if is_on and self._device.settings.rate_Hz > self._device.highest_rate_Hz(counting=True):
            raise Refused(0x64)
        self._device.settings.counter_modes[number] = value
        if is_on and not was_on:
            self._device.settings.objects += 1
            self._device.counters[number].clear(p.decode_counter_mode(value))
        elif was_on and not is_on:
            self._device.settings.objects = max(2, self._device.settings.objects - 1)
