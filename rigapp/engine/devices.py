"""Make, open and configure the devices of a rig file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import cast

from drivers.api import (
    DataRequest,
    DataSource,
    DriveRequest,
    DriverInfo,
    DriverKind,
    Identity,
    Spindle,
    StreamSetup,
)
from drivers.registry import DriverNotFound, SettingsError, check_settings, load_driver
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import DeviceSection, RigFile

LoadDriver = Callable[[str], DriverInfo]


@dataclass(slots=True)
class Devices:
    """The devices of a rig: one source of samples, one spindle."""

    source: DataSource
    spindle: Spindle
    data_request: DataRequest
    drive_request: DriveRequest
    drivers: Mapping[str, str]
    identities: dict[str, Identity] = field(default_factory=dict)
    readback: dict[str, Mapping[str, str | float | int]] = field(default_factory=dict)

    def open(self) -> StreamSetup:
        """Open and configure all of them; raise DeviceError. On failure all are closed again."""
        try:
            self.identities[self.spindle.name] = self.spindle.open()
            self.readback[self.spindle.name] = self.spindle.configure(self.drive_request)
            self.identities[self.source.name] = self.source.open()
            setup = self.source.configure(self.data_request)
            self.readback[self.source.name] = setup.readback
        except BaseException:
            self.close()
            raise
        return setup

    def close(self) -> None:
        """Stop and release all of them; the drive first, since closing it stops the motor."""
        self.spindle.close()
        self.source.close()


def make_devices(rig: RigFile, ports: Mapping[str, str], load: LoadDriver = load_driver) -> Devices:
    """Make the drivers of a rig file without touching a port; raise UnusableInput.

    ports: device name -> port, in place of the rig file's.
    """
    sources = {key: getattr(rig, key).device for key in ("encoder", "load_cell", "probes")}
    if len(set(sources.values())) != 1:
        named = ", ".join(f"{key}.device = {name!r}" for key, name in sources.items())
        raise UnusableInput(
            f"rig file: {named}; all three must name one device, whose samples are simultaneous"
        )
    name = rig.encoder.device
    source, settings = _make(rig, name, DriverKind.DATA_SOURCE, ports, load)
    rate = settings.get("sample_rate_Hz")
    if not isinstance(rate, int | float):
        raise UnusableInput(
            f"rig file: devices.{name}.settings.sample_rate_Hz is missing; give the sample rate"
        )
    spindle, drive_settings = _make(rig, rig.spindle.device, DriverKind.SPINDLE, ports, load)
    lines = 4 if rig.encoder.quadrature == "before" else 1
    cell, probes = rig.load_cell, rig.probes
    return Devices(
        source=cast(DataSource, source),
        spindle=cast(Spindle, spindle),
        data_request=DataRequest(
            sample_rate_Hz=float(rate),
            inputs={
                cell.input_1: ("bridge", cell.range_mV_per_V),
                cell.input_2: ("bridge", cell.range_mV_per_V),
                probes.input_1: ("voltage", probes.range_V),
                probes.input_2: ("voltage", probes.range_V),
                rig.encoder.input: ("counter", float(rig.encoder.counts_per_revolution * lines)),
            },
            settings=settings,
        ),
        drive_request=DriveRequest(
            counts_per_revolution=rig.spindle.encoder_counts_per_revolution,
            direction=rig.spindle.direction,
            maximum_speed_rev_per_s=rig.spindle.maximum_speed_rpm / 60.0,
            watchdog_timeout_s=rig.spindle.watchdog_timeout_s,
            settings=drive_settings,
            simulated=rig.simulation is not None,
        ),
        drivers={
            name: rig.devices[name].driver,
            rig.spindle.device: _section(rig, rig.spindle.device).driver,
        },
    )


def _section(rig: RigFile, name: str) -> DeviceSection:
    section = rig.devices.get(name)
    if section is None:
        known = ", ".join(rig.devices) or "none"
        raise UnusableInput(f"rig file: there is no device {name!r}; there are: {known}")
    return section


def _make(
    rig: RigFile, name: str, kind: DriverKind, ports: Mapping[str, str], load: LoadDriver
) -> tuple[DataSource | Spindle, dict[str, object]]:
    section = _section(rig, name)
    port = ports.get(name, section.port)
    if port == "simulated":
        raise UnusableInput(
            f"rig file: devices.{name}.port is 'simulated', and no simulated device runs for it"
        )
    try:
        info = load(section.driver)
        settings = check_settings(info, section.settings, f"rig file [devices.{name}.settings]")
    except (DriverNotFound, SettingsError) as error:
        raise UnusableInput(str(error)) from error
    if info.kind is not kind:
        raise UnusableInput(
            f"rig file: devices.{name}.driver = {section.driver!r} is a {info.kind.value}, "
            f"a {kind.value} is needed"
        )
    return info.factory(name, port, settings), settings
