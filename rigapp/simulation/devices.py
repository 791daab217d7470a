"""Create the simulated devices of a rig file, each with simulator, wire and inputs."""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from rigapp.config.channels import input_keys
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import DeviceSection, RigFile
from rigapp.schema.channels import ChannelTable
from rigapp.simulation.disturbances import WiredSignals
from rigapp.simulation.wire.endpoints import Endpoint
from rigapp.simulation.wire.link import SimulatedWire
from rigapp_drivers.api import DriverInfo, DriverKind
from rigapp_drivers.edge import failure_words, foreign
from rigapp_drivers.registry import (
    DriverNotFound,
    SettingsError,
    check_settings,
    load_driver,
    load_simulator,
    package_of,
)
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState, RigSignals

MakeEndpoint = Callable[[str], Endpoint]


@dataclass(frozen=True, slots=True)
class SimulatedDevice:
    """A device's simulator with its wire; quantities: measured by a slow device."""

    name: str
    simulator: Any
    wire: SimulatedWire
    quantities: tuple[str, ...] = ()


def inputs_of(rig: RigFile, channels: ChannelTable) -> dict[str, int]:
    """Return channel -> number of its analog input; raise UnusableInput."""
    names = {key: name for key, name in input_keys(rig).items() if key != "encoder.input"}
    numbers = [_input_number(*item) for item in names.items()]
    if len(set(numbers)) < len(numbers):
        taken = ", ".join(f"{key} = {name!r}" for key, name in names.items())
        raise UnusableInput("{}: two signals cannot share one input; give each its own.", taken)
    return dict(zip((channel.name for channel in channels.sampled), numbers, strict=True))


def signals(seen: WiredSignals, inputs: Mapping[str, int]) -> RigSignals:
    """Return the signals at the inputs of the data acquisition; inputs: from ``inputs_of``."""
    return RigSignals(
        analog={inputs[name]: values for name, values in seen.analog.items()},
        shaft_revolutions=seen.shaft_revolutions,
    )


def simulated_names(rig: RigFile) -> tuple[str, ...]:
    """Return the devices with the port ``simulated``, or all devices if there are none."""
    return rig.simulated_devices or tuple(rig.devices)


class RealDevice:
    """Placeholder for a real drive or data acquisition among simulated devices; does nothing."""

    sample_rate_Hz = 1000.0
    streaming = False
    url = ""

    def connected(self) -> bool:
        """Return False: no host connects to it."""
        return False

    def read(self) -> bytes:
        """Return nothing."""
        return b""

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Send no reply."""
        return b""

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Send nothing."""
        return b""

    def emit(self, now_s: float) -> bytes:
        """Send nothing."""
        return b""

    def observe(self, state: MotorState) -> None:
        """Ignore the state."""

    def command(self, elapsed_s: float, now_s: float) -> DriveCommand:
        """Leave the simulated crank without power."""
        return DriveCommand(DriveMode.OFF)


class SimulatorFailed(Exception):
    """A simulator raised an unexpected error and was disabled."""


class GuardedSimulator:
    """Wrapper of a simulator: after an error it is disabled, and the rig continues.

    failed: the reason as a sentence, empty while it works.
    """

    def __init__(self, simulator: Any, name: str, package: str) -> None:
        self.simulator = simulator
        self.failed = ""
        self._name, self._package = name, package

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the simulator; a method is guarded and cached."""
        attribute = getattr(self.simulator, name, *([_nothing] if self.failed else []))
        if not callable(attribute):
            return attribute

        def guarded(*arguments: Any, **options: Any) -> Any:
            try:
                with foreign(self._fail):
                    return attribute(*arguments, **options)
            except SimulatorFailed:
                return getattr(self.simulator, name, _nothing)(*arguments, **options)

        setattr(self, name, guarded)
        return guarded

    def _fail(self, error: BaseException) -> SimulatorFailed:
        """Disable the simulator: its methods do nothing from now on."""
        self.failed = (
            f"The simulator of {self._name} has failed ({failure_words(error)}); report it to the"
            f" author of the package {self._package}, and connect again."
        )
        print(self.failed, file=sys.stderr, flush=True)
        self.simulator = RealDevice()
        for name in [name for name, value in vars(self).items() if inspect.isfunction(value)]:
            delattr(self, name)
        return SimulatorFailed(self.failed)


def _nothing(*arguments: Any, **options: Any) -> None:
    """Do nothing, like a missing device."""


def real_device(name: str) -> SimulatedDevice:
    """Return the placeholder for a real device."""
    device: Any = RealDevice()
    return SimulatedDevice(name, device, SimulatedWire(device))


def data_device(rig: RigFile, make_endpoint: MakeEndpoint, seed: int) -> SimulatedDevice:
    """Return the simulated data acquisition device; raise UnusableInput."""
    if rig.encoder.device not in simulated_names(rig):
        return real_device(rig.encoder.device)
    counts = rig.encoder.counts_per_revolution * (4 if rig.encoder.quadrature == "before" else 1)
    facts = {"counts_per_revolution": counts, "seed": seed}
    return _device(rig, rig.encoder.device, DriverKind.DATA_SOURCE, facts, make_endpoint, seed)


def drive_device(rig: RigFile, make_endpoint: MakeEndpoint, seed: int) -> SimulatedDevice:
    """Return the simulated drive; raise UnusableInput."""
    if rig.spindle.device not in simulated_names(rig):
        return real_device(rig.spindle.device)
    facts = {"counts_per_revolution": rig.spindle.encoder_counts_per_revolution}
    return _device(rig, rig.spindle.device, DriverKind.SPINDLE, facts, make_endpoint, seed + 1)


def slow_devices(
    rig: RigFile, make_endpoint: MakeEndpoint, seed: int
) -> tuple[SimulatedDevice, ...]:
    """Return the simulated slow devices; raise UnusableInput for any other device."""
    instruments = {rig.spindle.device, rig.encoder.device, rig.load_cell.device, rig.probes.device}
    if rig.spindle.device == rig.encoder.device and rig.spindle.device in simulated_names(rig):
        raise UnusableInput(
            "spindle.device and encoder.device are both {}; the drive and the data"
            " acquisition are separate devices in a simulated rig.",
            repr(rig.spindle.device),
        )
    return tuple(
        _device(rig, name, DriverKind.SLOW_SOURCE, {}, make_endpoint, seed + 2 + number)
        for number, name in enumerate(n for n in rig.devices if n not in instruments)
        if name in simulated_names(rig)
    )


def _device(
    rig: RigFile,
    name: str,
    kind: DriverKind,
    facts: Mapping[str, Any],
    make_endpoint: MakeEndpoint,
    seed: int,
) -> SimulatedDevice:
    info, settings = _load(name, rig.devices[name], kind)
    made, package = _simulator(name, info, settings, facts), package_of(rig.devices[name].driver)
    simulator = GuardedSimulator(made, name, package)
    wire = SimulatedWire(make_endpoint(name), seed=seed)
    return SimulatedDevice(name, simulator, wire, getattr(simulator, "quantities", ()))


def _input_number(key: str, name: str) -> int:
    match = re.fullmatch(r"analog_([1-9][0-9]*)", name)
    if match is None:
        raise UnusableInput(
            "{} = {} is not an analog input; write analog_1, analog_2 ...", key, repr(name)
        )
    return int(match[1])


def _load(
    name: str, device: DeviceSection, kind: DriverKind
) -> tuple[DriverInfo, Mapping[str, Any]]:
    try:
        info = load_driver(device.driver)
        check_settings(info, device.settings, f"devices.{name}.settings")
    except (DriverNotFound, SettingsError) as error:
        raise UnusableInput("devices.{}: {}", name, error) from error
    if kind is DriverKind.SLOW_SOURCE and info.kind is not kind:
        raise UnusableInput(
            "devices.{} is used by neither [spindle], [encoder], [load_cell] nor"
            " [probes]; name it there or take it out.",
            name,
        )
    if info.kind is not kind:
        raise UnusableInput(
            "devices.{}.driver = {} is a {}, where a {} is needed.",
            name,
            repr(device.driver),
            info.kind,
            kind,
        )
    return info, device.settings


def _simulator(
    name: str, info: DriverInfo, settings: Mapping[str, Any], facts: Mapping[str, Any]
) -> Any:
    """Create a simulator with those facts and settings for which it has parameters."""
    try:
        simulator = load_simulator(info)
    except DriverNotFound as error:
        raise UnusableInput("devices.{}: {}", name, error) from error
    parameters = inspect.signature(simulator).parameters
    options = {key: value for key, value in facts.items() if key in parameters}
    options |= {
        key: value
        for key, value in settings.items()
        if key in parameters and type(value).__name__ in str(parameters[key].annotation)
    }
    with foreign(
        lambda error: UnusableInput(
            f"devices.{name}: the simulator of the package {package_of(info.name)} cannot be made"
            f" ({failure_words(error)}); report it to its author."
        )
    ):
        return simulator(**options)
