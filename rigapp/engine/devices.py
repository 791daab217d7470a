"""Make, open and configure the devices of a rig file."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn, cast

from rigapp.config.channels import channel_table, input_keys
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import RigFile
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
)
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

LoadDriver = Callable[[str], DriverInfo]

KINDS = {"mV/V": "bridge", "V": "voltage"}
"""Unit of an input's signal -> what the data source is asked to measure there."""


@dataclass(slots=True)
class Devices:
    """The devices of a rig: one source of samples, one spindle, slow sources with their requests.

    A slow source is opened and asked by a thread of its own (``samples.slow``).
    """

    source: GuardedSource
    spindle: GuardedSpindle
    data_request: DataRequest
    drive_request: DriveRequest
    drivers: Mapping[str, str]
    slow: tuple[tuple[GuardedSlow, SlowRequest], ...] = ()
    identities: dict[str, Identity] = field(default_factory=dict)
    readback: dict[str, Mapping[str, str | float | int]] = field(default_factory=dict)

    def open(self) -> StreamSetup:
        """Open and configure source and spindle; raise DeviceError. On failure both are closed."""
        try:
            self.identities[self.spindle.name] = self.spindle.open()
            self.identities[self.source.name] = self.source.open()
            setup = self.source.configure(self.data_request)
            self.readback[self.source.name] = setup.readback
            # Last: from here on the drive's watchdog runs, and many inputs take long to set up.
            self.readback[self.spindle.name] = self.spindle.configure(self.drive_request)
        except BaseException:
            self.close()
            raise
        return setup

    def close(self) -> None:
        """Stop and release all of them; the drive first, since closing it stops the motor."""
        self.spindle.close()
        self.source.close()


@dataclass(frozen=True, slots=True)
class DevicePlan:
    """What the devices of a rig file will be asked for: names, drivers, settings, requests."""

    source: str
    source_driver: DriverInfo
    data_request: DataRequest
    spindle: str
    spindle_driver: DriverInfo
    drive_request: DriveRequest
    slow: Mapping[str, tuple[DriverInfo, SlowRequest]]


def plan_devices(
    rig: RigFile, where: str = "rig file", load: LoadDriver = load_driver
) -> DevicePlan:
    """Return what the devices will be asked for; raise UnusableInput where one cannot do it.

    Nothing is opened. where: the file, for the sentence.
    """
    sources = {key: getattr(rig, key).device for key in ("encoder", "load_cell", "probes")}
    if len(set(sources.values())) != 1:
        named = ", ".join(f"{key}.device = {name!r}" for key, name in sources.items())
        raise UnusableInput(
            f"{where}: {named}; all three must name one device, whose samples are simultaneous"
        )
    name, drive = rig.encoder.device, rig.spindle.device
    info, settings = _driver(rig, name, DriverKind.DATA_SOURCE, where, load)
    rate = settings.get("sample_rate_Hz")
    if not isinstance(rate, int | float):
        raise UnusableInput(
            f"{where}: devices.{name}.settings.sample_rate_Hz is missing; give the sample rate"
        )
    drive_info, drive_settings = _driver(rig, drive, DriverKind.SPINDLE, where, load)
    data = DataRequest(float(rate), _inputs(rig), settings)
    wanted = DriveRequest(
        counts_per_revolution=rig.spindle.encoder_counts_per_revolution,
        direction=rig.spindle.direction,
        maximum_speed_rev_per_s=rig.spindle.maximum_speed_rpm / 60.0,
        watchdog_timeout_s=rig.spindle.watchdog_timeout_s,
        gear_ratio=rig.spindle.gear_ratio,
        settings=drive_settings,
    )
    _check_inputs(rig, info, data, where)
    wrong = _objection(drive_info, wanted)
    if wrong:
        raise UnusableInput(f"{where}: [spindle] on devices.{drive}: {wrong}")
    _check_drive_quantities(rig, drive_info, drive_settings, where)
    slow = dict(_slow_requests(rig, where, load))
    return DevicePlan(name, info, data, drive, drive_info, wanted, slow)


def _check_drive_quantities(
    rig: RigFile, info: DriverInfo, settings: Mapping[str, Any], where: str
) -> None:
    """Refuse a slow channel of something that the drive does not tell."""
    for one in channel_table(rig).slow:
        if one.device != rig.spindle.device:
            continue
        needed = info.needed.get(one.input, "")
        if one.input not in info.quantities:
            wrong = f"a {info.title} tells {', '.join(info.quantities) or 'nothing of itself'}"
        elif needed and not settings[needed]:
            wrong = f"give devices.{one.device}.settings.{needed}, without which none is told"
        else:
            continue
        source = f"channels.{one.name}.source = '{one.device}.{one.input}'"
        raise UnusableInput(f"{where}: {source}: {wrong}")


def _slow_requests(
    rig: RigFile, where: str, load: LoadDriver
) -> Iterator[tuple[str, tuple[DriverInfo, SlowRequest]]]:
    """Yield what each slow device will be asked for; raise UnusableInput where it cannot tell."""
    slow = [one for one in channel_table(rig).slow if one.device != rig.spindle.device]
    for name in dict.fromkeys(one.device for one in slow):
        wanted = [one for one in slow if one.device == name]
        try:
            info, settings = _driver(rig, name, DriverKind.SLOW_SOURCE, where, load)
        except UnusableInput as error:
            if not isinstance(error.__cause__, DriverBroken):
                raise
            info, settings = _broken(rig.devices[name].driver, error.__cause__), {}
        request = SlowRequest(tuple(dict.fromkeys(one.input for one in wanted)), settings=settings)
        for one in wanted:
            wrong = _objection(info, replace(request, quantities=(one.input,)))
            if wrong:
                raise UnusableInput(
                    f"{where}: channels.{one.name}.source = '{name}.{one.input}': {wrong}"
                )
        yield name, (info, request)


def _inputs(rig: RigFile) -> dict[str, tuple[str, float]]:
    lines = 4 if rig.encoder.quadrature == "before" else 1
    found = {
        one.input: (KINDS[one.signal_unit], one.signal_range) for one in channel_table(rig).sampled
    }
    found[rig.encoder.input] = ("counter", float(rig.encoder.counts_per_revolution * lines))
    return found


def _check_inputs(rig: RigFile, info: DriverInfo, request: DataRequest, where: str) -> None:
    """Refuse what the data source cannot do, with the key of the input where one is at fault."""
    wrong = _objection(info, request)
    if not wrong:
        return
    keys = {name: key for key, name in input_keys(rig).items()}
    alone = {
        name: _objection(info, replace(request, inputs={name: kind}))
        for name, kind in request.inputs.items()
    }
    faulty = [name for name, words in alone.items() if words]
    if 0 < len(faulty) < len(alone):
        name = faulty[0]
        raise UnusableInput(f"{where}: {keys[name]} = {name!r}: {alone[name]}")
    raise UnusableInput(f"{where}: [devices.{rig.encoder.device}.settings]: {wrong}")


def _objection(info: DriverInfo, request: DataRequest | DriveRequest | SlowRequest) -> str:
    """Return why no such device can do it, empty where one can; raise UnusableInput."""
    if info.check is None:
        return ""
    with foreign(lambda error: _no_objection(info, error)):
        try:
            info.check(request)
        except ValueError as error:
            return str(error)
    return ""


def _no_objection(info: DriverInfo, error: BaseException) -> UnusableInput:
    return UnusableInput(
        f"the driver {info.name} failed to check its request ‹{failure_words(error)}›; report it to"
        f" the author of the package {package_of(info.name)}"
    )


def make_devices(
    rig: RigFile,
    ports: Mapping[str, str],
    load: LoadDriver = load_driver,
    where: str = "rig file",
) -> Devices:
    """Make the drivers of a rig file without touching a port; raise UnusableInput, DeviceError.

    ports: device name -> port, in place of the rig file's.
    """
    plan = plan_devices(rig, where, load)
    source = _made(rig, plan.source, plan.source_driver, plan.data_request.settings, ports, where)
    spindle = _made(
        rig, plan.spindle, plan.spindle_driver, plan.drive_request.settings, ports, where
    )
    return Devices(
        source=cast(GuardedSource, source),
        spindle=cast(GuardedSpindle, spindle),
        data_request=plan.data_request,
        drive_request=plan.drive_request,
        drivers={
            name: rig.devices[name].driver for name in (plan.source, plan.spindle, *plan.slow)
        },
        slow=tuple(
            (_slow_source(rig, name, info, request.settings, ports, where), request)
            for name, (info, request) in plan.slow.items()
        ),
    )


class Unusable:
    """A slow source whose driver cannot be had: it says why, and the rig goes on without it."""

    def __init__(self, error: DeviceError) -> None:
        self._error = error

    def open(self) -> Identity:
        """Raise ConnectionFailed with the reason."""
        error = self._error
        raise ConnectionFailed(error.device, error.port, error.sentence) from error

    def close(self) -> None:
        """Do nothing: nothing was opened."""


def _slow_source(rig: RigFile, name: str, info: DriverInfo, *made: Any) -> GuardedSlow:
    try:
        return cast(GuardedSlow, _made(rig, name, info, *made))
    except DeviceError as error:
        return GuardedSlow(Unusable(error), name, error.port, info.name)


def _broken(driver: str, error: DriverBroken) -> DriverInfo:
    """Return what stands for the driver of a slow source whose package cannot be loaded."""

    def fails(name: str, port: str, settings: Mapping[str, Any]) -> NoReturn:
        raise ConnectionFailed(name, port, str(error)) from error

    return DriverInfo(driver, driver, DriverKind.SLOW_SOURCE, fails)


def _driver(
    rig: RigFile, name: str, kind: DriverKind, where: str, load: LoadDriver
) -> tuple[DriverInfo, dict[str, Any]]:
    section = rig.devices.get(name)
    if section is None:
        known = ", ".join(rig.devices) or "none"
        raise UnusableInput(f"{where}: there is no device {name!r}; there are: {known}")
    try:
        info = load(section.driver)
        settings = check_settings(info, section.settings, f"{where}: [devices.{name}.settings]")
    except DriverNotFound as error:
        raise UnusableInput(f"{where}: devices.{name}.driver: {error}") from error
    except SettingsError as error:
        raise UnusableInput(str(error)) from error
    if info.kind is not kind:
        raise UnusableInput(
            f"{where}: devices.{name}.driver = {section.driver!r} is a {info.kind.value}, "
            f"a {kind.value} is needed"
        )
    return info, settings


def _made(
    rig: RigFile,
    name: str,
    info: DriverInfo,
    settings: Mapping[str, Any],
    ports: Mapping[str, str],
    where: str,
) -> Guarded:
    port = ports.get(name, rig.devices[name].port)
    if port == "simulated":
        raise UnusableInput(
            f"{where}: devices.{name}.port is 'simulated', and no simulated device runs for it"
        )
    return make_driver(info, name, port, settings)
