"""Create, open and configure the devices of a rig file."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NoReturn, cast

from rigapp.config.channels import channel_table, input_keys
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import RigFile
from rigapp.engine.identifying import combined_error, identity_record, stranger
from rigapp.engine.wirerecording import WireRecording
from rigapp.texts import joined, say, sentence_of_error
from rigapp_drivers.api import (
    ConnectionFailed,
    DataRequest,
    DeviceError,
    DriveRequest,
    DriverInfo,
    DriverKind,
    Identity,
    SlowRequest,
    StreamSetup,
    WrongDevice,
)
from rigapp_drivers.discovery import has_speed
from rigapp_drivers.edge import (
    Guarded,
    GuardedSlow,
    GuardedSource,
    GuardedSpindle,
    failure_words,
    foreign,
    make_driver,
)
from rigapp_drivers.registry import (
    DriverBroken,
    DriverNotFound,
    SettingsError,
    check_settings,
    load_driver,
    package_of,
)
from rigapp_drivers.wire.ports import beside

LoadDriver = Callable[[str], DriverInfo]

KINDS = {"mV/V": "bridge", "V": "voltage"}
"""Unit of an input's signal -> quantity measured by the data source."""


@dataclass(slots=True)
class Devices:
    """Devices of a rig: one data source, one spindle, slow sources with their requests.

    Each slow source is opened and read by its own thread (``samples.slow``). explain: replaces an
    error of opening by that of another device that answers on the port.
    """

    source: GuardedSource
    spindle: GuardedSpindle
    data_request: DataRequest
    drive_request: DriveRequest
    drivers: Mapping[str, str]
    slow: tuple[tuple[GuardedSlow, SlowRequest], ...] = ()
    identities: dict[str, Identity] = field(default_factory=dict)
    readback: dict[str, Mapping[str, str | float | int]] = field(default_factory=dict)
    explain: Callable[[DeviceError, Guarded], DeviceError] = lambda error, device: error

    def open(self) -> StreamSetup:
        """Open and configure source and spindle; raise DeviceError after closing both."""
        try:
            self._identify()
            setup = self.source.configure(self.data_request)
            self._note(self.source, setup.readback)
            # Last, as it starts the drive's watchdog, and many inputs take long to set up.
            self._note(self.spindle, self.spindle.configure(self.drive_request))
        except BaseException:
            self.close()
            raise
        return setup

    def _identify(self) -> None:
        """Open source and spindle; the error lists all devices that fail, also slow sources."""
        errors = []
        for device in (self.spindle, self.source):
            try:
                self.identities[device.name] = device.open()
            except DeviceError as error:
                errors.append(self.explain(error, device))
        if errors:
            raise combined_error([*errors, *self._silent_slow()])

    def _silent_slow(self) -> Iterator[DeviceError]:
        """Yield the errors of slow sources; each is opened and closed again."""
        for device, _ in self.slow:
            try:
                device.open()
            except DeviceError as error:
                yield self.explain(error, device)
            finally:
                device.close()

    def _note(self, device: Guarded, readback: Mapping[str, str | float | int]) -> None:
        self.readback[device.name] = {**identity_record(self.identities[device.name]), **readback}

    def close(self) -> None:
        """Stop and close all devices; the drive first, as closing it stops the motor."""
        self.spindle.close()
        self.source.close()


@dataclass(frozen=True, slots=True)
class DevicePlan:
    """Names, drivers and requests of the devices of a rig file."""

    source: str
    source_driver: DriverInfo
    data_request: DataRequest
    spindle: str
    spindle_driver: DriverInfo
    drive_request: DriveRequest
    slow: Mapping[str, tuple[DriverInfo, SlowRequest]]


def plan_devices(
    rig: RigFile, where: str = say("rig file"), load: LoadDriver = load_driver
) -> DevicePlan:
    """Return the requests to the devices; raise UnusableInput if one cannot be fulfilled.

    Opens nothing. where: the file, for error messages.
    """
    sources = {key: getattr(rig, key).device for key in ("encoder", "load_cell", "probes")}
    if len(set(sources.values())) != 1:
        named = joined(
            ", ", (say("{}.device = {}", key, repr(name)) for key, name in sources.items())
        )
        raise UnusableInput(
            "{}: {}; all three must name one device, whose samples are simultaneous", where, named
        )
    name, drive = rig.encoder.device, rig.spindle.device
    info, settings = _driver(rig, name, DriverKind.DATA_SOURCE, where, load)
    rate = settings.get("sample_rate_Hz")
    if not isinstance(rate, int | float):
        raise UnusableInput(
            "{}: devices.{}.settings.sample_rate_Hz is missing; give the sample rate", where, name
        )
    drive_info, drive_settings = _driver(rig, drive, DriverKind.SPINDLE, where, load)
    data = DataRequest(float(rate), _inputs(rig), settings)
    drive_request = DriveRequest(
        counts_per_revolution=rig.spindle.encoder_counts_per_revolution,
        direction=rig.spindle.direction,
        maximum_speed_rev_per_s=rig.spindle.maximum_speed_rpm / 60.0,
        watchdog_timeout_s=rig.spindle.watchdog_timeout_s,
        gear_ratio=rig.spindle.gear_ratio,
        settings=drive_settings,
    )
    _check_inputs(rig, info, data, where)
    objection = _objection(drive_info, drive_request)
    if objection:
        raise UnusableInput("{}: [spindle] on devices.{}: {}", where, drive, objection)
    _check_drive_quantities(rig, drive_info, drive_settings, where)
    slow = dict(_slow_requests(rig, where, load))
    return DevicePlan(name, info, data, drive, drive_info, drive_request, slow)


def _check_drive_quantities(
    rig: RigFile, info: DriverInfo, settings: Mapping[str, Any], where: str
) -> None:
    """Raise UnusableInput for a slow channel of a quantity that the drive does not measure."""
    for channel in channel_table(rig).slow:
        if channel.device != rig.spindle.device:
            continue
        needed = info.needed.get(channel.input, "")
        if channel.input not in info.quantities:
            objection = say(
                "a {} reports {}",
                info.title,
                joined(", ", info.quantities) or say("none of its own"),
            )
        elif needed and not settings[needed]:
            objection = say(
                "give devices.{}.settings.{}, without which none is reported",
                channel.device,
                needed,
            )
        else:
            continue
        source = say("channels.{}.source = '{}.{}'", channel.name, channel.device, channel.input)
        raise UnusableInput("{}: {}: {}", where, source, objection)


def _slow_requests(
    rig: RigFile, where: str, load: LoadDriver
) -> Iterator[tuple[str, tuple[DriverInfo, SlowRequest]]]:
    """Yield the request to each slow device; raise UnusableInput if it cannot be fulfilled."""
    slow = [channel for channel in channel_table(rig).slow if channel.device != rig.spindle.device]
    for name in dict.fromkeys(channel.device for channel in slow):
        channels = [channel for channel in slow if channel.device == name]
        try:
            info, settings = _driver(rig, name, DriverKind.SLOW_SOURCE, where, load)
        except UnusableInput as error:
            if not isinstance(error.__cause__, DriverBroken):
                raise
            info, settings = _unloadable_driver(rig.devices[name].driver, error.__cause__), {}
        request = SlowRequest(
            tuple(dict.fromkeys(channel.input for channel in channels)), settings=settings
        )
        for channel in channels:
            objection = _objection(info, replace(request, quantities=(channel.input,)))
            if objection:
                raise UnusableInput(
                    "{}: channels.{}.source = '{}.{}': {}",
                    where,
                    channel.name,
                    name,
                    channel.input,
                    objection,
                )
        yield name, (info, request)


def _inputs(rig: RigFile) -> dict[str, tuple[str, float]]:
    lines = 4 if rig.encoder.quadrature == "before" else 1
    result = {
        channel.input: (KINDS[channel.signal_unit], channel.signal_range)
        for channel in channel_table(rig).sampled
    }
    result[rig.encoder.input] = ("counter", float(rig.encoder.counts_per_revolution * lines))
    return result


def _check_inputs(rig: RigFile, info: DriverInfo, request: DataRequest, where: str) -> None:
    """Raise UnusableInput if the data source cannot fulfil a request; names the faulty input."""
    objection = _objection(info, request)
    if not objection:
        return
    keys = {name: key for key, name in input_keys(rig).items()}
    objections = {
        name: _objection(info, replace(request, inputs={name: kind}))
        for name, kind in request.inputs.items()
    }
    faulty = [name for name, words in objections.items() if words]
    if 0 < len(faulty) < len(objections):
        name = faulty[0]
        raise UnusableInput(f"{where}: {keys[name]} = {name!r}: {objections[name]}")
    raise UnusableInput("{}: [devices.{}.settings]: {}", where, rig.encoder.device, objection)


def _objection(info: DriverInfo, request: DataRequest | DriveRequest | SlowRequest) -> str:
    """Return why the driver cannot fulfil a request, or an empty text; raise UnusableInput."""
    if info.check is None:
        return ""
    with foreign(lambda error: _check_failed(info, error)):
        try:
            info.check(request)
        except ValueError as error:
            return sentence_of_error(error)
    return ""


def _check_failed(info: DriverInfo, error: BaseException) -> UnusableInput:
    return UnusableInput(
        say(
            "the driver {} failed to check its request ‹{}›; report it to the author of the"
            " package {}",
            info.name,
            failure_words(error),
            package_of(info.name),
        )
    )


def make_devices(
    rig: RigFile,
    ports: Mapping[str, str],
    load: LoadDriver = load_driver,
    where: str = say("rig file"),
    record: WireRecording | None = None,
    folder: Path = Path(),
) -> Devices:
    """Create the drivers of a rig file, without opening a port; raise UnusableInput, DeviceError.

    ports: device name -> port, replacing that of the rig file. record: of the devices' lines.
    folder: of the rig file, used without ``record``.
    """
    plan = plan_devices(rig, where, load)
    factory = DriverMaker(rig, ports, where, record or WireRecording(folder))
    source = factory.driver(plan.source, plan.source_driver, plan.data_request.settings)
    spindle = factory.driver(plan.spindle, plan.spindle_driver, plan.drive_request.settings)
    return Devices(
        source=cast(GuardedSource, source),
        spindle=cast(GuardedSpindle, spindle),
        data_request=plan.data_request,
        drive_request=plan.drive_request,
        drivers={
            name: rig.devices[name].driver for name in (plan.source, plan.spindle, *plan.slow)
        },
        slow=tuple(
            (_slow_source(factory, name, info, request.settings), request)
            for name, (info, request) in plan.slow.items()
        ),
        explain=factory.explain,
    )


class UnloadableSource:
    """Stand-in for a slow source whose driver cannot be loaded; fails to open with the reason."""

    def __init__(self, error: DeviceError) -> None:
        self._error = error

    def open(self) -> Identity:
        """Raise ConnectionFailed with the reason."""
        error = self._error
        raise ConnectionFailed(error.device, error.port, error.sentence) from error

    def close(self) -> None:
        """Do nothing."""


def _slow_source(
    factory: DriverMaker, name: str, info: DriverInfo, settings: Mapping[str, Any]
) -> GuardedSlow:
    try:
        return cast(GuardedSlow, factory.driver(name, info, settings))
    except DeviceError as error:
        return GuardedSlow(UnloadableSource(error), name, error.port, info.name)


def _unloadable_driver(driver: str, error: DriverBroken) -> DriverInfo:
    """Return a stand-in for a slow source's driver whose package cannot be loaded."""

    def fails(name: str, port: str, settings: Mapping[str, Any]) -> NoReturn:
        raise ConnectionFailed(name, port, sentence_of_error(error)) from error

    return DriverInfo(driver, driver, DriverKind.SLOW_SOURCE, fails)


def _driver(
    rig: RigFile, name: str, kind: DriverKind, where: str, load: LoadDriver
) -> tuple[DriverInfo, dict[str, Any]]:
    section = rig.devices.get(name)
    if section is None:
        known = joined(", ", rig.devices) or "none"
        raise UnusableInput("{}: there is no device {}; there are: {}", where, repr(name), known)
    try:
        info = load(section.driver)
        settings = check_settings(
            info, section.settings, say("{}: [devices.{}.settings]", where, name)
        )
    except DriverNotFound as error:
        raise UnusableInput("{}: devices.{}.driver: {}", where, name, error) from error
    except SettingsError as error:
        raise UnusableInput(sentence_of_error(error)) from error
    if info.kind is not kind:
        raise UnusableInput(
            "{}: devices.{}.driver = {} is a {}, a {} is needed",
            where,
            name,
            repr(section.driver),
            info.kind.value,
            kind.value,
        )
    return info, settings


@dataclass(frozen=True, slots=True)
class DriverMaker:
    """Factory of the drivers of a rig file's devices."""

    rig: RigFile
    ports: Mapping[str, str]
    where: str
    record: WireRecording

    def driver(self, name: str, info: DriverInfo, settings: Mapping[str, Any]) -> Guarded:
        """Return the guarded driver of a device; raise UnusableInput, DeviceError."""
        device = self.rig.devices[name]
        port = beside(self.record.folder, self.ports.get(name, device.port))
        if port == "simulated":
            raise UnusableInput(
                "{}: devices.{}.port is 'simulated', and no simulated device runs for it",
                self.where,
                name,
            )
        self.record.attach(name, port, device.record, info, settings)
        return make_driver(info, name, port, settings, device.serial_number)

    def explain(self, error: DeviceError, device: Guarded) -> DeviceError:
        """Return the error of opening a device, or that of another device on its port.

        A UART adapter's port is not probed: a motor controller interprets any byte as a speed.
        """
        missing = isinstance(error, ConnectionFailed | WrongDevice)
        if device.name in self.ports or not missing or has_speed(device.port):
            return error
        return stranger(device, self.rig.devices[device.name].driver) or error
