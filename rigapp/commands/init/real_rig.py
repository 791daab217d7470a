"""`rigapp init --real`: the files of a rig with real devices, asked for or told by options."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rigapp.commands.init.folder import StartingFile, fill_folder
from rigapp.commands.init.schema import schema_text
from rigapp.config.commented import commented
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig, parse_test
from rigapp.config.reading import read_text
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.toml import toml_tree
from rigapp.prepare.shipped import examples_folder
from rigapp_drivers.wire.ports import BY_ID, stable_name

if TYPE_CHECKING:
    from rigapp_drivers.api import DriverInfo
    from rigapp_drivers.discovery import Answer

NO_PORT: Final = "/dev/serial/by-id/NOT-FOUND-YET"
"""Written where no port is known: no device has that name, and check says so."""

_CAN_NETWORK: Final = re.compile(r"v?can\d+")
"""A CAN interface of the system; any other name is that of an slcan adapter's port."""

ROLES: Final[Mapping[str, tuple[str, str]]] = {
    "daq": ("data source", "data acquisition"),
    "drive": ("spindle", "drive"),
}
"""Name of a device in the rig file -> its kind of driver, and what a question calls it."""

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
        # A DATAQ counts one edge of each line of a 3600-count encoder, and knows no index.
        "encoder": {"counts_per_revolution": 900, "restarts_at_index": False},
        "load_cell": {"range_mV_per_V": 2.0},
    },
}
"""What a box asks of the rig file that another one does not."""

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

ABOUT: Final[Mapping[str, str]] = {
    "rig.toml": "the rig: devices, wiring, calibration; read it through once",
    "test.toml": "a first test of 50 revolutions at 30 rpm",
    "parameters.toml": "the mechanism, for rigapp model",
    "rig.schema.json": "lets an editor complete and check rig.toml",
    "test.schema.json": "the same for test.toml",
    "calibration/load_cell.toml": "settings of the load cell's calibration",
    "calibration/probes.toml": "settings of the probes' calibration",
    "calibration/run_out.toml": "settings of the pin's run-out map",
    "calibration/channel.toml": "settings of another channel's calibration",
}

NEXT: Final = (
    "rigapp doctor",
    "rigapp check rig.toml test.toml",
    "rigapp calibrate load-cell --rig rig.toml --settings calibration/load_cell.toml"
    " --to cell.json",
    "rigapp gui --rig rig.toml",
)


@dataclass(frozen=True, slots=True)
class Box:
    """One device of the rig: its name there, its driver and the port, empty where none is known."""

    name: str
    driver: DriverInfo
    port: str


def prepare_real_folder(folder: Path, named: Mapping[str, tuple[str, str]]) -> int:
    """Write the files of a real rig into a folder; exit status.

    named: name of a device -> driver and port as told by options, empty where they are not. What is
    missing is asked for on a terminal. Raises UnusableInput for an unknown driver, for a missing
    one where nobody can be asked, and when a file is there already.
    """
    from rigapp_drivers.registry import available_drivers, load_driver

    drivers = [load_driver(name) for name in available_drivers()]
    found = _devices_on_ports(drivers) if not all(port for _, port in named.values()) else {}
    boxes = [_box(name, *named[name], drivers, found) for name in ROLES]
    fill_folder(folder, real_files(boxes), ABOUT)
    for box in boxes:
        if not box.port:
            print(
                f"No {box.driver.title} answers on a port; write its port at [devices.{box.name}]"
                " in rig.toml. rigapp doctor lists the ports."
            )
    print("Try next:" if folder.resolve() == Path.cwd() else f"Try next, in {folder}:")
    for command in NEXT:
        print(f"  {command}")
    return 0


def real_files(boxes: Sequence[Box]) -> list[StartingFile]:
    """Return the files of a rig with these devices; they are read once, so that they are right."""
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
            one.relative_to(examples), read_text(one).replace("../simulated.toml", "../rig.toml")
        )
        for one in sorted((examples / "calibration").glob("*.toml"))
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
    """Return the rig file of real devices as tables; simulated: that of the simulated rig."""
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


def _box(
    name: str,
    driver: str,
    port: str,
    drivers: Sequence[DriverInfo],
    found: Mapping[str, Answer],
) -> Box:
    """Return a device as told, as found, or as somebody at the terminal answers."""
    kind, words = ROLES[name]
    fitting = [info for info in drivers if info.kind.value == kind]
    here = {at: one for at, one in found.items() if one.driver in {info.name for info in fitting}}
    if not driver:
        driver = _asked(
            f"Which {words}",
            [info.name for info in fitting],
            next((one.driver for one in here.values()), ""),
            option=f"--{name}",
        )
    info = next((one for one in fitting if one.name == driver), None)
    if info is None:
        raise UnusableInput(
            f"--{name} {driver}: is no driver of a {words}; say"
            f" {' or '.join(one.name for one in fitting)}."
        )
    if not port:
        answering = [at for at, one in here.items() if one.driver == driver]
        port = _port_of(info, answering)
    return Box(name, info, port)


def _port_of(info: DriverInfo, answering: Sequence[str]) -> str:
    """Return the port of a device: the one that answers, or what somebody types; may be empty."""
    if len(answering) == 1:
        print(f"{info.title}: found on {answering[0]}.")
        return answering[0]
    if not sys.stdin.isatty():
        return ""
    if answering:
        return _asked(f"Port of the {info.title}", answering, answering[0])
    print(f"{info.title}: answers on no port that may be asked.")
    return _typed(f"Port of the {info.title} (Enter: leave open): ")


def _asked(question: str, choices: Sequence[str], first: str, option: str = "") -> str:
    """Return one of some choices as somebody types it; a number or the word itself."""
    if not sys.stdin.isatty():
        raise UnusableInput(f"Say {option} {' or '.join(choices)}; there is no terminal to ask on.")
    for number, choice in enumerate(choices, 1):
        print(f"  {number}  {choice}")
    first = first or choices[0]
    while True:
        said = _typed(f"{question}? [{first}] ") or first
        if said.isdecimal() and 1 <= int(said) <= len(choices):
            return choices[int(said) - 1]
        if said in choices:
            return said
        print(f"{said} is none of these.")


def _typed(question: str) -> str:
    try:
        return input(question).strip()
    except EOFError:
        raise UnusableInput("The questions were not answered; nothing is written.") from None


def _devices_on_ports(drivers: Sequence[DriverInfo]) -> dict[str, Answer]:
    """Return who answers on the ports that may be asked, by the name that a port keeps."""
    from serial.tools import list_ports

    from rigapp_drivers.discovery import ask, drivers_of_usb_id, may_be_asked

    found = {}
    for port in sorted(list_ports.comports()):
        known = drivers_of_usb_id(port.vid, port.pid, drivers)
        if may_be_asked(port.device, known) and os.access(port.device, os.R_OK | os.W_OK):
            answer = ask(
                port.device, [*known, *(one for one in drivers if one not in known)]
            ).answer
            if answer is not None:
                found[lasting_name(port.device)] = answer
    return found


def lasting_name(port: str, folder: Path = BY_ID) -> str:
    """Return the name under which a port is found again after a restart, or the port itself."""
    return stable_name(port, folder) or port
