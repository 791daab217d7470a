"""The settings of a CiA 402 drive in the rig file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from rigapp.texts import say
from rigapp_drivers.api import SettingSpec
from rigapp_drivers.spindles import TORQUE_CONSTANT

BIT_RATES: Final = (10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 750_000, 1_000_000)
INTERFACES: Final = ("slcan", "socketcan", "pcan", "kvaser", "gs_usb")

SETTINGS: Final[Mapping[str, SettingSpec]] = {
    "interface": SettingSpec(
        str, "slcan", say("CAN adapter; the port is its channel."), choices=INTERFACES
    ),
    "bit_rate": SettingSpec(int, 500_000, say("Bit rate of the CAN bus."), choices=BIT_RATES),
    "node_id": SettingSpec(int, 1, say("Node id of the drive."), 1, 127),
    "host_node_id": SettingSpec(
        int, 127, say("Node id under which this computer sends its heartbeat."), 1, 127
    ),
    "heartbeat_ms": SettingSpec(
        int, 100, say("Period of the drive's heartbeat, which is supervised."), 20, 1000
    ),
    "sdo_timeout_ms": SettingSpec(
        float, 200.0, say("Longest wait for the answer to one request."), 20.0, 2000.0
    ),
    "pdo_timeout_ms": SettingSpec(
        float, 100.0, say("Longest wait for speed and position after a SYNC."), 5.0, 2000.0
    ),
    "sleep_after_open_s": SettingSpec(
        float,
        0.1,
        say("Wait after opening an slcan adapter; one that resets needs 2 s."),
        0.0,
        10.0,
    ),
    "objects": SettingSpec(
        str,
        "auto",
        say('Objects to use: "auto" takes the EPOS4\'s own when the maker is maxon.'),
        choices=("auto", "epos4", "generic"),
    ),
    "velocity_unit": SettingSpec(
        str,
        say("as set"),
        say("Unit to set in the drive; milli-rpm is finer, and not every drive has it."),
        choices=(say("as set"), "rpm", "milli-rpm"),
    ),
    "velocity_step_rpm": SettingSpec(
        float,
        0.0,
        say(
            "Step in which the drive takes speeds, in rpm of the motor, from its manual, where the"
            " drive does not tell it (object 60A9); 0: as it tells."
        ),
        0.0,
        1e3,
    ),
    "acceleration_unit_rpm_per_s": SettingSpec(
        float, 1.0, say("Step of the drive's accelerations (assumed; see its manual)."), 1e-6, 1e6
    ),
    "supply_unit_V": SettingSpec(float, 0.1, say("Step of object 2200:1 (assumed)."), 1e-6, 1e3),
    "current_unit_A": SettingSpec(float, 0.001, say("Step of object 30D1:1 (assumed)."), 1e-6, 1e3),
    "temperature_unit_C": SettingSpec(
        float, 0.1, say("Step of object 3201:1 (assumed)."), 1e-6, 1e3
    ),
    "torque_on_inputs": SettingSpec(
        int,
        3,
        say(
            "Bits of object 3202:1 that are set while safe torque off is not active"
            " (assumed); 0 does not look."
        ),
        0,
        255,
    ),
    "torque_constant_Nm_per_A": TORQUE_CONSTANT,
}

_NUMBERED_CHANNELS: Final = ("kvaser", "gs_usb")


def bus_options(port: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments of ``can.Bus`` for a port; raise ValueError for a wrong channel."""
    interface = str(settings["interface"])
    options: dict[str, Any] = {
        "interface": interface,
        "channel": port,
        "bitrate": int(settings["bit_rate"]),
    }
    if interface == "slcan":
        options["sleep_after_open"] = float(settings["sleep_after_open_s"])
        options["timeout"] = 0.01
    elif interface in _NUMBERED_CHANNELS:
        if not port.isdecimal():
            raise ValueError(say("the channel of {} is a number, not {}", interface, repr(port)))
        options["channel"] = int(port)
        if interface == "gs_usb":
            options["index"] = int(port)
    return options
