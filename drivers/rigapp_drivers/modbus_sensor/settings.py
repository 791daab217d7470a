"""The keys of ``[devices.NAME.settings]`` that the Modbus sensor driver knows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from rigapp_drivers.api import SettingSpec
from rigapp_drivers.modbus_sensor.registers import OWN, PRESETS

SETTINGS: Final[Mapping[str, SettingSpec]] = {
    "preset": SettingSpec(
        str,
        "SHT20",
        "Registers of a usual transmitter (temperature_C and humidity_percent), or one's own.",
        choices=(*PRESETS, OWN),
    ),
    "registers": SettingSpec(
        list,
        [],
        "One table a quantity: quantity (its name with the unit at the end), function (3 or 4), "
        "address, type (i16, u16, i32, f32), scale, offset, words, invalid.",
    ),
    "address": SettingSpec(int, 1, "Modbus address of the device.", 1, 247),
    "baud_rate": SettingSpec(
        int,
        9600,
        "Speed of the RS-485 line.",
        choices=(1200, 2400, 4800, 9600, 14400, 19200, 38400, 57600, 115200),
    ),
    "parity": SettingSpec(str, "none", "Parity of the line.", choices=("none", "even", "odd")),
    "stop_bits": SettingSpec(int, 1, "Stop bits of the line.", choices=(1, 2)),
    "reply_timeout_s": SettingSpec(
        float, 0.3, "How long to wait for the answer to a request.", 0.02, 5.0
    ),
}
