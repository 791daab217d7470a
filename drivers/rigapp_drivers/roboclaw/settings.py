"""The settings of a RoboClaw in the rig file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from rigapp_drivers.api import SettingSpec
from rigapp_drivers.roboclaw.protocol import BAUD_RATES
from rigapp_drivers.spindles import TORQUE_CONSTANT

SETTINGS: Final[Mapping[str, SettingSpec]] = {
    "address": SettingSpec(int, 128, "Packet serial address of the drive.", 128, 135),
    "motor": SettingSpec(int, 1, "Motor output that drives the spindle.", choices=(1, 2)),
    "baud_rate": SettingSpec(
        int, 38400, "Baud rate of the drive's UART; USB ignores it.", choices=BAUD_RATES
    ),
    "status_width": SettingSpec(
        str,
        "auto",
        'Bits of the status word; "auto" decides by the firmware and checks it.',
        choices=("auto", "16", "32"),
    ),
    "combined_status": SettingSpec(
        str,
        "auto",
        'Read everything in one packet (command 73); "auto" asks the drive once whether it can.',
        choices=("auto", "never"),
    ),
    "reply_timeout_ms": SettingSpec(
        float, 100.0, "Longest wait for a reply, besides its time on the wire.", 20.0, 1000.0
    ),
    "torque_constant_Nm_per_A": TORQUE_CONSTANT,
}
