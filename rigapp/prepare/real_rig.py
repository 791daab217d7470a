"""The files of a rig with real devices, and a search of ports, without user interface."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from serial.tools import list_ports

from rigapp.config.commented import commented
from rigapp.config.loading import parse_rig, parse_test
from rigapp.config.reading import read_text
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.toml import toml_tree
from rigapp.prepare.folders import StartingFile
from rigapp.prepare.schemas import schema_text
from rigapp.prepare.shipped import examples_folder
from rigapp.texts import joined, say
from rigapp_drivers.api import DriverInfo, DriverKind
from rigapp_drivers.discovery import ask, drivers_of_usb_id, may_be_probed
from rigapp_drivers.registry import DriverNotFound, available_drivers, load_driver
from rigapp_drivers.wire.ports import BY_ID, stable_name

NO_PORT: Final = "/dev/serial/by-id/NOT-FOUND-YET"
"""Placeholder for an unknown port, which ``rigapp check`` reports as missing."""

_CAN_TYPE: Final = "280"
_CAN_NETWORK: Final = re.compile(r"v?can\d+")
"""Name of a CAN interface of the system; others are ports of slcan adapters."""


@dataclass(frozen=True, slots=True)
class Role:
    """Role of a device in the rig file: kind of driver, and name in a question."""

    kind: DriverKind
    words: str


ROLES: Final[Mapping[str, Role]] = {
    "daq": Role(DriverKind.DATA_SOURCE, say("data acquisition")),
    "drive": Role(DriverKind.SPINDLE, say("drive")),
}
"""Name of a device in the rig file -> its role."""

WIRED: Final[Mapping[str, Mapping[str, Mapping[str, Any]]]] = {
    "gsv8": {
        "settings": {"sample_rate_Hz": 960.0},
        "encoder": {"counts_per_revolution": 3600, "restarts_at_index": True},
        "load_cell": {"range_mV_per_V": 3.5},
    },
    "dataq": {
        "settings": {
            "sample_rate_Hz": 960.0,
            "bridge_amplifiers": {"analog_1": 5.0, "analog_2": 5.0},
        },
        # A DATAQ counts one edge of each line of a 3600-count encoder, and has no index.
        "encoder": {"counts_per_revolution": 900, "restarts_at_index": False},
        "load_cell": {"range_mV_per_V": 2.0},
    },
}
"""Additional entries of the rig file by driver."""

NOTES: Final[Mapping[str, str]] = {
    "load_cell.matrix_N_per_mV_per_V": "These are 400 N at a rated output of 2 mV/V; calibrate.",
    "load_cell.full_scale_N": "From the cell's label.",
    "load_cell.calibration": "rigapp calibrate load-cell makes it.",
    "probes.sensitivity_um_per_V": "From the probes' data sheet; calibrate.",
    "probes.calibration": "rigapp calibrate probes makes it.",
    "encoder.direction": "Turn the crank by hand: the angle must grow counter-clockwise.",
    "spindle.encoder_counts_per_revolution": "From the motor's data sheet.",
    "spindle.maximum_speed_rpm": "What crank, guide and motor bear.",
}

ABOUT_REAL: Final[Mapping[str, str]] = {
    "rig.toml": say("the rig: devices, wiring, calibration; read it through once"),
    "test.toml": say("a first test of 50 revolutions at 30 rpm"),
    "parameters.toml": say("the mechanism, for rigapp model"),
    "rig.schema.json": say("lets an editor complete and check rig.toml"),
    "test.schema.json": say("the same for test.toml"),
    "calibration/load_cell.toml": say("settings of the load cell's calibration"),
    "calibration/probes.toml": say("settings of the probes' calibration"),
    "calibration/run_out.toml": say("settings of the pin's run-out map"),
    "calibration/channel.toml": say("settings of another channel's calibration"),
}
"""Path of a file -> its description."""


@dataclass(frozen=True, slots=True)
class Box:
    """One device of the rig: its name there, driver and port, empty if unknown."""

    name: str
    driver: DriverInfo
    port: str


@dataclass(frozen=True, slots=True)
class FoundPort:
    """A port of this computer: its persistent name, and a description of the device.

    driver: of the device that answers; empty if none does, or the port was not probed.
    """

    name: str
    words: str
    driver: str = ""


def drivers_of(role: str) -> dict[str, DriverInfo]:
    """Return the drivers suitable for a role, by name; role: a key of ``ROLES``."""
    return {info.name: info for info in _drivers() if info.kind is ROLES[role].kind}


def search_ports() -> list[FoundPort]:
    """Return the ports, those with answering devices first; takes a second or two for each port.

    Only ports of native USB devices are probed: a motor controller behind a UART adapter might
    interpret any byte as a speed.
    """
    drivers = _drivers()
    result = [_looked_at(port, drivers) for port in sorted(list_ports.comports())]
    result += [FoundPort(name, say("CAN interface")) for name in can_networks()]
    return sorted(result, key=lambda port: not port.driver)


def _looked_at(port: Any, drivers: Sequence[DriverInfo]) -> FoundPort:
    known = drivers_of_usb_id(port.vid, port.pid, drivers)
    described = "" if port.description in (None, "n/a") else port.description
    label = joined(" / ", (info.title for info in known)) or described or say("serial port")
    name = lasting_name(port.device)
    if not os.access(port.device, os.R_OK | os.W_OK):
        return FoundPort(name, say("{}: this user may not open it", label))
    if not may_be_probed(port.device, known):
        return FoundPort(name, say("{}: not queried, it is not a USB device itself", label))
    inquiry = ask(port.device, [*known, *(driver for driver in drivers if driver not in known)])
    if inquiry.answer is None:
        return FoundPort(name, say("{}: {}", label, inquiry.problem or say("no answer")))
    number = inquiry.answer.identity.serial_number
    title = inquiry.answer.title
    words = say("{}, serial number {}", title, number) if number else say("{} answers", title)
    return FoundPort(name, words, inquiry.answer.driver)


def can_networks(folder: Path = Path("/sys/class/net")) -> list[str]:
    """Return the names of the CAN interfaces of the system."""
    try:
        return sorted(path.name for path in folder.iterdir() if _kind_of(path) == _CAN_TYPE)
    except OSError:
        return []


def _kind_of(network: Path) -> str:
    try:
        return (network / "type").read_text("utf-8").strip()
    except (OSError, UnicodeDecodeError):
        return ""


def _drivers() -> list[DriverInfo]:
    """Return the loadable drivers; ``rigapp doctor`` reports the others."""
    result = []
    for name in available_drivers():
        try:
            result.append(load_driver(name))
        except DriverNotFound:
            continue
    return result


def real_files(boxes: Sequence[Box]) -> list[StartingFile]:
    """Return the files of a rig with these devices, checked by reading them."""
    examples = examples_folder()
    rig = "#:schema ./rig.schema.json\n" + commented(
        RigFile,
        rig_tree(boxes, toml_tree(read_text(examples / "simulated.toml"), "simulated.toml")),
        NOTES,
        {box.name: box.driver.settings for box in boxes},
        without=("simulation",),
    )
    first = toml_tree(read_text(examples / "paper.toml"), "paper.toml")
    first |= {"title": "First test", "metadata": {"operator": "", "specimen": "bushing 1"}}
    first["run"] |= {"revolutions": 50}
    first["cycles"] |= {"every_revolutions": 10}
    test = "#:schema ./test.schema.json\n" + commented(TestFile, first)
    parse_rig(rig, "rig.toml")
    parse_test(test, "test.toml")
    calibrations = [
        StartingFile(
            path.relative_to(examples), read_text(path).replace("../simulated.toml", "../rig.toml")
        )
        for path in sorted((examples / "calibration").glob("*.toml"))
    ]
    return [
        StartingFile(Path("rig.toml"), rig),
        StartingFile(Path("test.toml"), test),
        StartingFile(Path("parameters.toml"), read_text(examples / "parameters.toml")),
        StartingFile(Path("rig.schema.json"), schema_text("rig")),
        StartingFile(Path("test.schema.json"), schema_text("test")),
        *calibrations,
    ]


def rig_tree(boxes: Sequence[Box], simulated: Mapping[str, Any]) -> dict[str, Any]:
    """Return the rig file of real devices as tables; simulated: tables of the simulated rig."""
    tree = {key: value for key, value in simulated.items() if key != "simulation"}
    tree["name"] = "Slider-crank"
    devices = {}
    for box in boxes:
        settings = dict(WIRED.get(box.driver.name, {}).get("settings", {}))
        if box.driver.name == "cia402" and _CAN_NETWORK.fullmatch(box.port):
            settings["interface"] = "socketcan"
        devices[box.name] = {"driver": box.driver.name, "port": box.port or NO_PORT} | (
            {"settings": settings} if settings else {}
        )
        for section in ("encoder", "load_cell"):
            tree[section] = {**tree[section], **WIRED.get(box.driver.name, {}).get(section, {})}
    return tree | {"devices": devices}


def lasting_name(port: str, folder: Path = BY_ID) -> str:
    """Return the persistent name of a port, or the port itself."""
    return stable_name(port, folder) or port
