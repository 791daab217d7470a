"""The simulated devices of a rig file: which simulator, on which wire, fed with what."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from drivers.api import DriverInfo, DriverKind, RigSignals, SimulatedDataSource, SimulatedDrive
from drivers.registry import (
    DriverNotFound,
    SettingsError,
    check_settings,
    load_driver,
    load_simulator,
)
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import DeviceSection, RigFile
from rigapp.simulation.endpoints import Endpoint
from rigapp.simulation.link import Wire
from rigapp.simulation.plant import Samples

MakeEndpoint = Callable[[str], Endpoint]


@dataclass(frozen=True, slots=True)
class DataDevice:
    """Join the data acquisition device's simulator with its wire."""

    name: str
    simulator: SimulatedDataSource
    wire: Wire


@dataclass(frozen=True, slots=True)
class DriveDevice:
    """Join the drive's simulator with its wire.

    counts_per_crank_revolution, direction: of the drive's own encoder, which is on the motor.
    """

    name: str
    simulator: SimulatedDrive
    wire: Wire
    counts_per_crank_revolution: float
    direction: int


@dataclass(frozen=True, slots=True)
class Inputs:
    """Tell which analog input carries which signal."""

    bridge_1: int
    bridge_2: int
    probe_1: int
    probe_2: int

    def signals(self, samples: Samples) -> RigSignals:
        """Return what the terminals of the data acquisition device see."""
        return RigSignals(
            analog={
                self.bridge_1: samples.bridge_1,
                self.bridge_2: samples.bridge_2,
                self.probe_1: samples.probe_1,
                self.probe_2: samples.probe_2,
            },
            shaft_revolutions=samples.shaft_revolutions,
        )


def inputs_of(rig: RigFile) -> Inputs:
    """Return the analog inputs of load cell and probes; raise UnusableInput."""
    names = {
        "load_cell.input_1": rig.load_cell.input_1,
        "load_cell.input_2": rig.load_cell.input_2,
        "probes.input_1": rig.probes.input_1,
        "probes.input_2": rig.probes.input_2,
    }
    numbers = [_input_number(key, name) for key, name in names.items()]
    if len(set(numbers)) < len(numbers):
        taken = ", ".join(f"{key} = {name!r}" for key, name in names.items())
        raise UnusableInput(f"{taken}: two signals cannot share one input; give each its own.")
    return Inputs(*numbers)


def data_device(rig: RigFile, make_endpoint: MakeEndpoint, seed: int) -> DataDevice:
    """Return the simulated data acquisition device; raise UnusableInput."""
    name = rig.encoder.device
    info, settings = _load(name, rig.devices[name], DriverKind.DATA_SOURCE)
    counts = rig.encoder.counts_per_revolution * (4 if rig.encoder.quadrature == "before" else 1)
    facts = {"counts_per_revolution": counts, "seed": seed}
    simulator = _simulator(name, info, settings, facts)
    return DataDevice(name, simulator, Wire(make_endpoint(name), seed=seed))


def drive_device(rig: RigFile, make_endpoint: MakeEndpoint, seed: int) -> DriveDevice:
    """Return the simulated drive; raise UnusableInput."""
    name = rig.spindle.device
    info, settings = _load(name, rig.devices[name], DriverKind.SPINDLE)
    counts = rig.spindle.encoder_counts_per_revolution
    simulator = _simulator(name, info, settings, {"counts_per_revolution": counts})
    wire = Wire(make_endpoint(name), seed=seed + 1)
    counts_per_crank = counts * rig.spindle.gear_ratio
    return DriveDevice(name, simulator, wire, counts_per_crank, rig.spindle.direction)


def check_devices(rig: RigFile) -> None:
    """Refuse a rig with a device that the simulated rig would not feed; raise UnusableInput."""
    used = {rig.spindle.device, rig.encoder.device, rig.load_cell.device, rig.probes.device}
    for name in rig.devices:
        if name not in used:
            raise UnusableInput(
                f"devices.{name} is used by neither [spindle], [encoder], [load_cell] nor [probes];"
                " name it there or take it out."
            )
    if rig.spindle.device == rig.encoder.device:
        raise UnusableInput(
            f"spindle.device and encoder.device are both {rig.spindle.device!r}; the drive and the"
            " data acquisition are separate devices in a simulated rig."
        )


def _input_number(key: str, name: str) -> int:
    match = re.fullmatch(r"analog_([1-9][0-9]*)", name)
    if match is None:
        raise UnusableInput(
            f"{key} = {name!r} is not an analog input; write analog_1, analog_2 ..."
        )
    return int(match[1])


def _load(
    name: str, device: DeviceSection, kind: DriverKind
) -> tuple[DriverInfo, Mapping[str, Any]]:
    try:
        info = load_driver(device.driver)
        check_settings(info, device.settings, f"devices.{name}.settings")
    except (DriverNotFound, SettingsError) as error:
        raise UnusableInput(f"devices.{name}: {error}") from error
    if info.kind is not kind:
        raise UnusableInput(
            f"devices.{name}.driver = {device.driver!r} is a {info.kind}, where a {kind} is needed."
        )
    return info, device.settings


def _simulator(
    name: str, info: DriverInfo, settings: Mapping[str, Any], facts: Mapping[str, Any]
) -> Any:
    """Make a simulator: it gets the facts and the file's settings that it has parameters for."""
    try:
        simulator = load_simulator(info)
    except DriverNotFound as error:
        raise UnusableInput(f"devices.{name}: {error}") from error
    parameters = inspect.signature(simulator).parameters
    options = {key: value for key, value in facts.items() if key in parameters}
    options |= {
        key: value
        for key, value in settings.items()
        if key in parameters and type(value).__name__ in str(parameters[key].annotation)
    }
    return simulator(**options)
