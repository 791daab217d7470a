"""What every driver offers: Protocols, records, error tree.

Error tree::

    DeviceError                 device, port and one plain sentence
    ├── ConnectionFailed        the port cannot be opened, or nothing answers on it
    │   ├── PortInUse           another program has the port
    │   └── PortForbidden       this user may not open the port
    ├── WrongDevice             something answers, but it is not the configured device
    ├── SettingRefused          the device refused or changed a setting
    ├── ReplyTimeout            a command was not answered in time
    ├── ProtocolError           bytes that the protocol does not allow, after all retries
    ├── DeviceLost              the connection broke while in use (cable, power, reset)
    ├── DataOverrun             the device says that it dropped data
    ├── DriverFailed            the driver itself failed: an error that is none of these (``edge``)
    └── DeviceFault             the device reports a fault of its own (drive fault, e-stop)

A driver knows bytes and meaning, never engineering units of the rig and never the application.
"""

from __future__ import annotations

import contextlib
import enum
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Protocol, Self, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import Sentence, SentenceError, say, sentence_of_error


class Named(Protocol):
    """What every driver says of itself."""

    name: str
    port: str


class Line(Protocol):
    """What every line says of itself: whose it is, and where."""

    device: str
    port: str


class DeviceError(SentenceError):
    """Say in one sentence what failed, on which device and port, and what to do."""

    def __init__(self, device: str, port: str, template: str, *values: object) -> None:
        sentence = Sentence(template, *values)
        super().__init__(say("{} on {}: {}", device, port, sentence))
        self.device = device
        self.port = port
        self.sentence = sentence
        self.each: tuple[DeviceError, ...] = (self,)
        """One error a device, where several failed together."""

    @classmethod
    def at(cls, who: Named | Line, template: str, *values: object) -> Self:
        """Return the error of a driver, or of the line on which it speaks."""
        name = getattr(who, "name", "") or getattr(who, "device", "")
        return cls(str(name), who.port, template, *values)


class ConnectionFailed(DeviceError):
    """The port cannot be opened, or nothing answers on it."""


class PortInUse(ConnectionFailed):
    """Another program has the port."""


class PortForbidden(ConnectionFailed):
    """This user may not open the port."""


class WrongDevice(DeviceError):
    """Something answers, but it is not the configured device."""


class SettingRefused(DeviceError):
    """The device refused or changed a setting."""


class ReplyTimeout(DeviceError):
    """A command was not answered in time."""


class ProtocolError(DeviceError):
    """The device sent bytes that its protocol does not allow."""


class DeviceLost(DeviceError):
    """The connection broke while in use."""


class SettingsLost(DeviceLost):
    """The device answers, but is not set up any more, as after a restart."""


class DataOverrun(DeviceError):
    """The device says that it dropped data."""


class DriverFailed(DeviceError):
    """The driver raised what no driver should raise, or answered in another form.

    Only ``edge`` raises this; its cause is what the driver raised.
    """


class DeviceFault(DeviceError):
    """The device reports a fault of its own."""


HELP: Final[Mapping[type[DeviceError], str]] = {
    ConnectionFailed: "nothing-answers",
    PortInUse: "the-port-is-in-use",
    PortForbidden: "the-port-may-not-be-opened",
    WrongDevice: "another-device-answers",
    SettingRefused: "a-setting-is-refused",
    ReplyTimeout: "no-answer-or-a-late-one",
    ProtocolError: "damaged-answers",
    DeviceLost: "the-connection-broke",
    SettingsLost: "the-device-has-restarted",
    DataOverrun: "samples-were-dropped",
    DriverFailed: "a-driver-failed",
    DeviceFault: "the-device-reports-a-fault",
}
"""The section of docs/troubleshooting.md that an error leads to, by its kind."""


def help_of(error: DeviceError) -> str:
    """Return the section that helps with an error, "" where there is none."""
    kinds = (HELP.get(kind, "") for kind in type(error).__mro__ if issubclass(kind, DeviceError))
    return next(filter(None, kinds), "")


class BytePort(Line, Protocol):
    """Exchange bytes with a device; what a driver needs of a transport."""

    @property
    def is_open(self) -> bool:
        """Tell whether the port is open."""

    def open(self) -> None:
        """Open the port; raise ConnectionFailed."""

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return what is there, at most maximum bytes; wait timeout_s for the first one."""

    def write(self, data: bytes) -> None:
        """Send all bytes; raise DeviceLost."""

    def drain(self) -> bytes:
        """Read until the line is quiet and return what came."""

    def close(self) -> None:
        """Release the port; never raises."""


class Quality(enum.IntFlag):
    """Flags of one sample or one block; 0 is good.

    SENSOR_FAULT: the device has said that a sensor or its cable is broken; see ``InputFault``.
    """

    GOOD = 0
    SATURATED = 1
    LOST_BEFORE = 2
    RESYNCHRONISED = 4
    COUNT_SUSPECT = 8
    SENSOR_FAULT = 16


@dataclass(frozen=True, slots=True)
class Identity:
    """Tell what answered on a port."""

    maker: str
    model: str
    firmware: str
    serial_number: str
    port: str
    details: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ChannelSpec:
    """Describe one row of a Block: electrical signal = scale * raw + offset, in unit.

    ``name`` is the device's input: ``analog_1`` ... ``analog_8``, ``counter_1``, ``digital``.
    ``unit`` is an electrical one ("mV/V", "V", "count"); N and um belong to calibration.
    """

    name: str
    unit: str
    scale: float = 1.0
    offset: float = 0.0
    minimum: float | None = None
    maximum: float | None = None


@dataclass(frozen=True, slots=True)
class Block:
    """Carry samples from the edge: raw values, never engineering units.

    values: (channels, samples), channel-major, float32 or int32, rows as in ``channels``.
    sequence: number of this block since start, without a gap.
    first_sample: index of the first sample since start, lost samples counted where known.
    host_time_ns: ``time.monotonic_ns()`` when the block's last byte was read; set once.
    quality: (samples,) uint8 of ``Quality``.
    lost_before: samples known to be lost just before this block.
    """

    device: str
    sequence: int
    first_sample: int
    sample_rate_Hz: float
    host_time_ns: int
    values: NDArray[np.float32] | NDArray[np.int32]
    quality: NDArray[np.uint8]
    lost_before: int = 0


class SampleClock(enum.StrEnum):
    """Tell what makes a device sample: its own clock, or each pulse of the crank's encoder."""

    TIME = "time"
    ENCODER = "encoder"


@dataclass(frozen=True, slots=True)
class StreamSetup:
    """Tell what the device will really send, as read back from it.

    clock: ENCODER means one sample a count; sample_rate_Hz is nominal then, a standing crank sends
    no samples, and a Block without samples is a sign of life. A row named ``rate_1`` in Hz, where
    there is one, is the pulse rate at each sample.
    """

    channels: tuple[ChannelSpec, ...]
    sample_rate_Hz: float
    readback: Mapping[str, str | float | int]
    clock: SampleClock = SampleClock.TIME


@dataclass(frozen=True, slots=True)
class DataRequest:
    """Ask a data acquisition device for inputs at a rate.

    inputs: device input name -> kind: ``bridge`` (range in mV/V), ``voltage`` (range in V),
    ``counter`` (counts per revolution after quadrature in ``range``).
    settings: the driver's own keys from the rig file, already checked by ``DriverInfo``.
    """

    sample_rate_Hz: float
    inputs: Mapping[str, tuple[str, float]]
    settings: Mapping[str, Any] = field(default_factory=dict)


@runtime_checkable
class DataSource(Named, Protocol):
    """Acquire samples. One thread calls ``read``; ``stop`` and ``close`` may come from another."""

    def open(self) -> Identity:
        """Open the port and identify the device; raise ConnectionFailed or WrongDevice."""

    def configure(self, request: DataRequest) -> StreamSetup:
        """Set what differs, read everything back; raise SettingRefused."""

    def start(self) -> None:
        """Start streaming; sample index and block sequence restart at 0."""

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block, None when none came in time; raise DeviceLost, DataOverrun."""

    def zero(self, inputs: Sequence[str]) -> None:
        """Zero inputs in the device where it can; raise SettingRefused where it cannot."""

    def stop(self) -> None:
        """Stop streaming; safe to call twice."""

    def close(self) -> None:
        """Release the device; never raises; safe to call twice."""


class InputFaultKind(enum.StrEnum):
    """Tell what is wrong at an input."""

    SATURATED = "saturated"
    OUT_OF_RANGE = "out of range"
    SENSOR_BROKEN = "sensor broken"
    STUCK = "stuck"
    OTHER = "other"


@dataclass(frozen=True, slots=True)
class InputFault:
    """Carry one fault of its inputs that a data source tells of.

    inputs: device input names as in the request, empty when the device does not say which. words:
    what is wrong, without a full stop. host_time_ns: when it became known, by
    ``time.monotonic_ns()``; 0 when the device knew it before the stream was started.
    """

    kind: InputFaultKind
    inputs: tuple[str, ...]
    words: str
    host_time_ns: int


@runtime_checkable
class InputSupervision(Protocol):
    """Offered by a data source, if it likes, beside ``DataSource``."""

    def input_faults(self) -> tuple[InputFault, ...]:
        """Return what the device said of its inputs since the start, each once, oldest first.

        It asks nobody, never waits and never raises; any thread may call it at any time. A fault
        stays in the list until the next start: a device seldom tells that one is over. While one of
        kind SENSOR_BROKEN came since the start, every sample carries ``Quality.SENSOR_FAULT``.
        """


@runtime_checkable
class LineCounters(Protocol):
    """Offered by any driver, if it likes, beside ``DataSource`` or ``Spindle``."""

    def counters(self) -> Mapping[str, int]:
        """Return what the driver counted on its line, by name, in the order to show it.

        Usual names: ``bytes_received``, ``bytes_sent``, ``lost_samples``, ``crc_errors``,
        ``retries``. They count since the port was opened, or the stream started. It asks nobody,
        never waits and never raises; any thread may call it at any time.
        """


@dataclass(frozen=True, slots=True)
class DriveStatus:
    """Tell the drive's state at one moment; speed in rev/s of the crank, signed as the rig.

    position_count: of the drive's own encoder, on the motor's side of a gear. torque_Nm: of the
    motor, as the drive estimates it; NaN where it tells none.
    """

    host_time_ns: int
    speed_rev_per_s: float
    setpoint_rev_per_s: float
    position_count: int
    current_A: float
    supply_V: float
    temperature_C: float
    enabled: bool
    emergency_stop: bool
    faults: tuple[str, ...]
    warnings: tuple[str, ...]
    crc_errors: int = 0
    torque_Nm: float = math.nan


@dataclass(frozen=True, slots=True)
class DriveRequest:
    """Configure a drive: the watchdog is not optional.

    counts_per_revolution: of the drive's own encoder, after quadrature, for one turn of the motor.
    gear_ratio: turns of the motor for one of the crank, positive. Every speed and acceleration that
    a Spindle takes or tells is the crank's. direction: +1 or -1, the rig's positive sense against
    the drive's.
    """

    counts_per_revolution: int
    direction: int
    maximum_speed_rev_per_s: float
    watchdog_timeout_s: float
    settings: Mapping[str, Any] = field(default_factory=dict)
    gear_ratio: float = 1.0

    def __post_init__(self) -> None:
        """Raise ValueError for a gear that turns nothing."""
        if not (math.isfinite(self.gear_ratio) and self.gear_ratio > 0.0):
            raise ValueError(
                say("gear_ratio is {}, must be a finite number above 0", self.gear_ratio)
            )

    @property
    def counts_per_crank_revolution(self) -> float:
        """Return the counts of the drive's encoder for one turn of the crank."""
        return self.counts_per_revolution * self.gear_ratio


@runtime_checkable
class Spindle(Named, Protocol):
    """Turn the crank. Every call but ``drive_off`` is serialised by the driver's own lock.

    The watchdog's setting is read back before the motor is enabled, in ``reset_fault`` and now and
    then in ``status``; where it is not as it was set, the power is taken off and SettingsLost
    raised.
    """

    def open(self) -> Identity:
        """Open the port and identify the drive; raise ConnectionFailed or WrongDevice."""

    def configure(self, request: DriveRequest) -> Mapping[str, str | float | int]:
        """Set the watchdog and what else differs, and return what was read back."""

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        """Ramp to a speed; 0 is the controlled stop."""

    def drive_off(self) -> None:
        """Take the power off the motor at once (coast or brake as the drive does it).

        Any thread calls it at any time. The command is sent in the middle of a call under way, of
        which no speed command is sent afterwards.
        """

    def reset_fault(self) -> None:
        """Acknowledge faults on the operator's command; the motor stays off.

        A fault that stopped the motor (watchdog, fault of the drive) stays in ``status().faults``
        until this or ``configure``. Raises DeviceFault when its cause is still there.
        """

    def status(self) -> DriveStatus:
        """Read the state; feeds the drive's watchdog."""

    def close(self) -> None:
        """Stop the motor, release the drive; never raises; safe to call twice."""


@dataclass(frozen=True, slots=True)
class SlowRequest:
    """Ask a device that is not simultaneous with the crank for quantities.

    quantities: names with their unit, as ``SlowSource.read`` returns them (``temperature_C``).
    timeout_s: the longest that one ``read`` may take. settings: the driver's own keys.
    """

    quantities: tuple[str, ...]
    timeout_s: float = 2.0
    settings: Mapping[str, Any] = field(default_factory=dict)


@runtime_checkable
class SlowSource(Named, Protocol):
    """Tell slow quantities (temperature, humidity) when asked; a thread of its own asks.

    It may fail and come back: after any error the caller closes it and opens it anew.
    """

    def open(self) -> Identity:
        """Open the port and identify the device; raise ConnectionFailed or WrongDevice."""

    def configure(self, request: SlowRequest) -> Mapping[str, str | float | int]:
        """Check that the device tells these quantities; return what was read back.

        Raises SettingRefused, which names what the device does tell.
        """

    def read(self) -> Mapping[str, float]:
        """Ask for the values now, by quantity, NaN where the device says that one is not valid.

        Raises ReplyTimeout, ProtocolError or DeviceLost.
        """

    def close(self) -> None:
        """Release the device; never raises; safe to call twice."""


class DriverKind(enum.StrEnum):
    """Tell what a driver is for."""

    DATA_SOURCE = "data source"
    SPINDLE = "spindle"
    SLOW_SOURCE = "slow source"


@dataclass(frozen=True, slots=True)
class SettingSpec:
    """Describe one key of ``[devices.NAME.settings]``: type, default, range, one sentence.

    kind: ``object`` where the choices are of several types.
    """

    kind: type
    default: Any
    sentence: str
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[Any, ...] = ()


def filled(specs: Mapping[str, SettingSpec], settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return settings with the default of each that is not given."""
    return {key: spec.default for key, spec in specs.items()} | dict(settings)


class InvalidRequest(SentenceError, ValueError):
    """Say in one sentence what of a request no such device can do, and what to do."""


@contextlib.contextmanager
def refusing(who: Named | Line) -> Iterator[None]:
    """Raise a ValueError of a check, which knows no device, as SettingRefused of a device."""
    try:
        yield
    except ValueError as error:
        raise SettingRefused.at(who, sentence_of_error(error)) from error


class DriverFactory(Protocol):
    """Make a driver for a named device on a port."""

    def __call__(
        self, name: str, port: str, settings: Mapping[str, Any]
    ) -> DataSource | Spindle | SlowSource:
        """Return the driver, not yet open; settings: as ``SettingSpec`` lists them."""


@dataclass(frozen=True, slots=True)
class Probe:
    """Tell how to ask who is on an open port, without moving a motor or changing a setting.

    ask: takes the open port and the longest wait for one answer in s; returns None when the device
    is another one. baud_rates: the usual ones, tried in turn where a port has a speed.
    """

    ask: Callable[[BytePort, float], Identity | None]
    baud_rates: tuple[int, ...] = (115200,)


class WireDecoder(Protocol):
    """Show what was said on a recorded line in words, piece by piece, in the order of time."""

    def sent(self, data: bytes) -> Iterable[str]:
        """Return what the program sent, a line each."""

    def received(self, data: bytes) -> Iterable[str]:
        """Return what the bytes from the device complete, a line each."""


@dataclass(frozen=True, slots=True)
class DriverInfo:
    """Describe a driver: the object that an entry point of ``rigapp.drivers`` names.

    simulator: "package.module:Class" of its byte-level simulator, loaded by the simulated rig only.
    usb_ids: vendor and product (None: any of that vendor) of devices with a USB id of their own.
    probe: how ``rigapp doctor`` asks for the device; None: it is recognised by its USB id only.
    check: raises ValueError with one sentence for a request (``DataRequest``, ``DriveRequest`` or
    ``SlowRequest``) that no such device can follow, before a port is opened; None: only the device
    knows. quantities: what the device can tell of itself or of its surroundings beside the test's
    samples, each with its unit (``temperature_C``, ``humidity_percent``): of a slow source the keys
    of ``read``, of a spindle fields of ``DriveStatus``. Channels of a rig file name them as
    ``source``. needed: quantity -> the setting without which it is not told. decoder: shows a
    recorded line in words (``rigapp wire``); None: as bytes. protocol: what is recorded of it,
    "bytes" of a serial line or "slcan" for the frames of a CAN bus.
    """

    name: str
    title: str
    kind: DriverKind
    factory: DriverFactory
    settings: Mapping[str, SettingSpec] = field(default_factory=dict)
    simulator: str | None = None
    usb_ids: tuple[tuple[int, int | None], ...] = ()
    probe: Probe | None = None
    check: Callable[[Any], object] | None = None
    quantities: tuple[str, ...] = ()
    needed: Mapping[str, str] = field(default_factory=dict)
    decoder: Callable[[], WireDecoder] | None = None
    protocol: str = "bytes"
