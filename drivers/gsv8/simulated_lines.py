"""Digital lines and analog outputs of a simulated GSV-8: settings that do not touch the stream."""

from __future__ import annotations

from drivers.gsv8.protocol import Command, f32, read_f32, u8, u16
from drivers.gsv8.simulated_device import Device, Entry, Refused, analog, line

_QEI_TYPE = 0x000008


class LineCommands:
    """Keep and return the settings of lines and outputs."""

    def __init__(self, device: Device) -> None:
        self._device = device

    def table(self) -> dict[int, Entry]:
        """Return the commands."""
        return {
            Command.GET_OUTPUT_TYPE: Entry((1,), self._get_output),
            Command.SET_OUTPUT_TYPE: Entry((3,), self._set_output, writes=True),
            Command.GET_DIO_DIRECTION: Entry((1,), self._get_direction),
            Command.SET_DIO_DIRECTION: Entry((2,), self._set_direction, writes=True),
            Command.GET_DIO_TYPE: Entry((1,), self._get_line_type),
            Command.SET_DIO_TYPE: Entry((5,), self._set_line_type, writes=True),
            Command.GET_DIO_LEVEL: Entry((1,), self._get_level),
            Command.SET_DIO_LEVEL: Entry((3,), self._set_level, writes=True),
            Command.GET_DIO_INITIAL_LEVEL: Entry((1,), self._get_initial),
            Command.SET_DIO_INITIAL_LEVEL: Entry((3,), self._set_initial, writes=True),
            Command.READ_DIO_THRESHOLD: Entry((2,), self._get_threshold),
            Command.WRITE_DIO_THRESHOLD: Entry((6,), self._set_threshold, writes=True),
        }

    def _get_output(self, a: bytes) -> bytes:
        return u8(*self._device.settings.outputs[analog(a[0])])

    def _get_initial(self, a: bytes) -> bytes:
        return u16(self._device.settings.line_initial[line(a[0])])

    def _set_output(self, a: bytes) -> bytes:
        if a[1] > 6:
            raise Refused(0x52)
        self._device.settings.outputs[analog(a[0])] = (a[1], a[2])
        return b""

    def _get_direction(self, a: bytes) -> bytes:
        if not 1 <= a[0] <= 4:
            raise Refused(0x51)
        return u8(self._device.settings.line_directions[a[0] - 1])

    def _set_direction(self, a: bytes) -> bytes:
        if a[0] > 4:
            raise Refused(0x51)
        if a[1] > 1:
            raise Refused(0x52)
        for group in [a[0] - 1] if a[0] else range(4):
            self._device.settings.line_directions[group] = a[1]
        return b""

    def _get_line_type(self, a: bytes) -> bytes:
        place = line(a[0])
        kind, channel = self._device.settings.line_types[place]
        if any(
            10 + 3 * number <= place <= 12 + 3 * number for number in self._device.settings.counters
        ):
            kind, channel = _QEI_TYPE, 0
        return kind.to_bytes(3, "big") + u8(channel)

    def _set_line_type(self, a: bytes) -> bytes:
        self._device.settings.line_types[line(a[0])] = (int.from_bytes(a[1:4], "big"), a[4])
        return b""

    def _get_level(self, a: bytes) -> bytes:
        levels = self._device.settings.line_levels
        if a[0] == 0:
            return u16(sum(bool(level) << n for n, level in enumerate(levels)))
        return u16(levels[line(a[0])])

    def _set_level(self, a: bytes) -> bytes:
        value = int.from_bytes(a[1:], "big")
        if a[0] == 0:
            self._device.settings.line_levels = [value >> n & 1 for n in range(16)]
        else:
            self._device.settings.line_levels[line(a[0])] = value
        return b""

    def _set_initial(self, a: bytes) -> bytes:
        self._device.settings.line_initial[line(a[0])] = int.from_bytes(a[1:], "big")
        return b""

    def _get_threshold(self, a: bytes) -> bytes:
        return f32(self._device.settings.line_thresholds.get((line(a[0]), a[1]), 0.0))

    def _set_threshold(self, a: bytes) -> bytes:
        self._device.settings.line_thresholds[line(a[0]), a[1]] = read_f32(a[2:])
        return b""
