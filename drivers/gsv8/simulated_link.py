"""Link commands of a simulated GSV-8: identity, status, interfaces, stored configurations."""

from __future__ import annotations

import copy

from drivers.gsv8 import protocol as p
from drivers.gsv8.protocol import Command, u8, u16, u32
from drivers.gsv8.simulated_device import Device, Entry, Refused, Table
from drivers.gsv8.simulated_memory import Settings
from drivers.gsv8.words import encode_value_fault

HARDWARE_OPTIONS = 1 << 0 | 1 << 4 | 1 << 6 | 1 << 7
BAUD_RATES = (19200, 38400, 57600, 115200, 230400, 460800)
UART_SETTING = 10
_NO_STATUS = 0


class LinkCommands:
    """Obey what concerns the link and the device as a whole."""

    def __init__(self, device: Device) -> None:
        self._device = device
        self._stored_sets: dict[int, Settings] = {}
        self._known: Table = {}

    def table(self) -> dict[int, Entry]:
        """Return the commands."""
        hardware = self._device.hardware
        return {
            Command.RESET_STATUS: Entry((0,), self._reset_status),
            Command.GET_INTERFACE: Entry((1,), self._get_interface),
            Command.LOAD_CONFIGURATION: Entry((1,), self._load, writes=True),
            Command.STORE_CONFIGURATION: Entry((1,), self._store, writes=True),
            Command.GET_SERIAL_NUMBER: Entry((0,), lambda a: u32(hardware.serial_number)),
            Command.STOP_TRANSMISSION: Entry((0,), lambda a: self._transmit(False)),
            Command.START_TRANSMISSION: Entry((0,), lambda a: self._transmit(True)),
            Command.CLEAR_BUFFER: Entry((0,), lambda a: b""),
            Command.GET_SOFTWARE_CONFIGURATION: Entry((0,), lambda a: u32(HARDWARE_OPTIONS)),
            Command.FIRMWARE_VERSION: Entry((0,), lambda a: b"".join(map(u16, hardware.firmware))),
            Command.GET_LAST_PROTOCOL_ERROR: Entry((1,), self._protocol_error),
            Command.GET_LAST_VALUE_ERROR: Entry((1,), self._value_error),
            Command.RELEASE_INTERFACE: Entry((0,), lambda a: b""),
            Command.READ_INTERFACE_SETTING: Entry((1,), self._get_interface_setting),
            Command.WRITE_INTERFACE_SETTING: Entry((5,), self._set_interface_setting, writes=True),
            Command.GET_COMMAND_AVAILABLE: Entry((2,), self._available),
        }

    def know(self, table: Table) -> None:
        """Take the whole table, for the question which commands exist."""
        self._known = table

    def _reset_status(self, _: bytes) -> bytes:
        self._device.state.synchronous_error = self._device.state.asynchronous_error = _NO_STATUS
        return b""

    def _get_interface(self, a: bytes) -> bytes:
        flags = a[0]
        if flags & 0xF0:
            raise Refused(0x53)
        if flags & 3 == 3:
            raise Refused(0x56)
        if flags & 8 and self._device.hardware.firmware < p.CHECKSUM_FIRMWARE:
            raise Refused(0x59)
        if flags & 3:
            self._device.state.transmitting = flags & 3 == 2
        self._device.state.data_checksum = bool(flags & 8)
        modern = self._device.hardware.firmware >= p.HIGH_SPEED_FIRMWARE
        self._device.state.high_speed = bool(flags & 4) and modern and self._device.hardware.usb
        return p.InterfaceReply(
            model=p.MODEL_GSV8,
            data_checksum=self._device.state.data_checksum,
            objects=self._device.settings.objects,
            transmitting=self._device.state.transmitting,
            data_type=self._device.settings.data_type,
            write_protected=not self._device.write_access,
            number=0 if self._device.hardware.usb else 1,
            interfaces=2,
        ).encode()

    def _transmit(self, on: bool) -> bytes:
        self._device.state.transmitting = on
        return b""

    def _protocol_error(self, a: bytes) -> bytes:
        if a[0] > 1:
            raise Refused(0x51)
        return u32(
            self._device.state.asynchronous_error if a[0] else self._device.state.synchronous_error
        )

    def _value_error(self, a: bytes) -> bytes:
        faults, stored = self._device.state.faults, self._device.stored_faults
        if a[0] == 0:
            return u8(len(faults), len(stored), 0, 0, 0, 0)
        if a[0] > 83:
            raise Refused(0x51)
        if a[0] == 1 and faults:
            return encode_value_fault(faults[-1])
        if 2 <= a[0] < 2 + len(stored):
            return encode_value_fault(stored[a[0] - 2])
        return bytes(6)

    def _available(self, a: bytes) -> bytes:
        high, low = a
        if not all(number in self._known for number in range(low, high + 1)):
            raise Refused(0x41)
        return b""

    def _get_interface_setting(self, a: bytes) -> bytes:
        flags = 0b111 | (p.OFFSET_BINARY_FLAG if self._device.hardware.offset_binary else 0)
        usb, uart = flags | 1 << 24, flags | 1 << 24
        settings = {
            0: p.InterfaceSetting(1, p.INTERFACE_USB, usb),
            1: p.InterfaceSetting(UART_SETTING, 2, uart),
            UART_SETTING: p.InterfaceSetting(
                0, p.ACTIVE_BAUD_RATE, self._device.settings.uart_baud_rate, writable=True
            ),
        }
        if a[0] not in settings:
            raise Refused(0x51)
        return settings[a[0]].encode()

    def _set_interface_setting(self, a: bytes) -> bytes:
        rate = int.from_bytes(a[1:], "big")
        if a[0] != UART_SETTING:
            raise Refused(0x76 if a[0] in (0, 1) else 0x51)
        if rate not in BAUD_RATES:
            raise Refused(0x52)
        self._device.settings.uart_baud_rate = rate
        return b""

    def _load(self, a: bytes) -> bytes:
        if a[0] == 1:
            self._device.settings = self._device.settings.defaults()
        elif a[0] in self._stored_sets:
            self._device.settings = copy.deepcopy(self._stored_sets[a[0]])
        elif a[0] > 7:
            raise Refused(0x51)
        return b""

    def _store(self, a: bytes) -> bytes:
        if a[0] == 1 or a[0] > 7:
            raise Refused(0x51)
        self._stored_sets[a[0]] = copy.deepcopy(self._device.settings)
        return b""
