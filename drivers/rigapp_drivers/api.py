"""Define the driver interface: Protocols, data records, error tree.

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
    ├── DataOverrun             the device reports that it dropped data
    ├── DriverFailed            the driver itself failed: an error that is none of these (``edge``)
    └── DeviceFault             the device reports a fault of its own (drive fault, e-stop)

A driver converts bytes to raw values. It uses no engineering units of the rig and does not import
the application.
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
    """Attributes that every driver has: device name and port."""

    name: str
    port: str


class Line(Protocol):
    """Attributes that every line has: the name of its device, and the port."""

    device: str
    port: str


class DeviceError(SentenceError):
    """Base of all driver errors: one sentence on what failed, the device, the port, the remedy."""

    def __init__(self, device: str, port: str, template: str, *values: object) -> None:
        sentence = Sentence(template, *values)
        super().__init__(say("{} on {}: {}", device, port, sentence))
        self.device = device
        self.port = port
        self.sentence = sentence
        self.each: tuple[DeviceError, ...] = (self,)
        """One error per device if several failed together."""

    @classmethod
    def at(cls, who: Named | Line, template: str, *values: object) -> Self:
        """Return an error with the device and port of a driver or of its line."""
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
    """The device answers but has lost its settings, for example after a restart."""


class DataOverrun(DeviceError):
    """The device reports that it dropped data."""


class DriverFailed(DeviceError):
    """The driver raised an undocumented exception or returned a value of the wrong type.

    Only ``edge`` raises this; ``__cause__`` is the exception of the driver.
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
"""Error class -> section of docs/troubleshooting.md."""


def help_of(error: DeviceError) -> str:
    """Return the section of the troubleshooting guide for an error, "" if none."""
    kinds = (HELP.get(kind, "") for kind in type(error).__mro__ if issubclass(kind, DeviceError))
    return next(filter(None, kinds), "")


class BytePort(Line, Protocol):
    """Exchange bytes with a device; the interface of a transport."""

    @property
    def is_open(self) -> bool:
        """Return whether the port is open."""

    def open(self) -> None:
        """Open the port; raise ConnectionFailed."""

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return the available bytes, at most maximum; wait up to timeout_s for the first."""

    def write(self, data: bytes) -> None:
        """Send all bytes; raise DeviceLost."""

    def drain(self) -> bytes:
        """Read until the line is quiet and return the bytes."""

    def close(self) -> None:
        """Release the port; never raises."""


class Quality(enum.IntFlag):
    """Flags of one sample or one block; 0 is good.

    SENSOR_FAULT: the device reported a broken sensor or cable; see ``InputFault``.
    """

    GOOD = 0
    SATURATED = 1
    LOST_BEFORE = 2
    RESYNCHRONISED = 4
    COUNT_SUSPECT = 8
    SENSOR_FAULT = 16


@dataclass(frozen=True, slots=True)
class Identity:
    """Identity of the device that answered on a port."""

    maker: str
    model: str
    firmware: str
    serial_number: str
    port: str
    details: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ChannelSpec:
    """One row of a Block: electrical signal = scale * raw + offset, in unit.

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
    """Samples from a device: raw values, never engineering units.

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
    """Sample clock of a device: its own clock, or the pulses of the crank's encoder."""

    TIME = "time"
    ENCODER = "encoder"


@dataclass(frozen=True, slots=True)
class StreamSetup:
    """Stream settings as read back from the device.

    clock: ENCODER means one sample per count; sample_rate_Hz is then nominal, a stationary crank
    sends no samples, and a Block without samples is a heartbeat. An optional row ``rate_1`` in Hz
    is the pulse rate at each sample.
    """

    channels: tuple[ChannelSpec, ...]
    sample_rate_Hz: float
    readback: Mapping[str, str | float | int]
    clock: SampleClock = SampleClock.TIME


@dataclass(frozen=True, slots=True)
class DataRequest:
    """Request for inputs of a data acquisition device at a sample rate.

    inputs: device input name -> kind: ``bridge`` (range in mV/V), ``voltage`` (range in V),
    ``counter`` (counts per revolution after quadrature in ``range``).
    settings: the driver's own keys from the rig file, already checked by ``DriverInfo``.
    """

    sample_rate_Hz: float
    inputs: Mapping[str, tuple[str, float]]
    settings: Mapping[str, Any] = field(default_factory=dict)


@runtime_checkable
class DataSource(Named, Protocol):
    """Acquire samples. One thread calls ``read``; another may call ``stop`` and ``close``."""

    def open(self) -> Identity:
        """Open the port and identify the device; raise ConnectionFailed or WrongDevice."""

    def configure(self, request: DataRequest) -> StreamSetup:
        """Write the settings that differ, read all back; raise SettingRefused."""

    def start(self) -> None:
        """Start streaming; sample index and block sequence restart at 0."""

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block, None on time-out; raise DeviceLost, DataOverrun."""

    def zero(self, inputs: Sequence[str]) -> None:
        """Zero inputs in the device; raise SettingRefused if it has no such function."""

    def stop(self) -> None:
        """Stop streaming; safe to call twice."""

    def close(self) -> None:
        """Release the device; never raises; safe to call twice."""


class InputFaultKind(enum.StrEnum):
    """Kind of fault of an input."""

    SATURATED = "saturated"
    OUT_OF_RANGE = "out of range"
    SENSOR_BROKEN = "sensor broken"
    STUCK = "stuck"
    OTHER = "other"


@dataclass(frozen=True, slots=True)
class InputFault:
    """One fault of the inputs, as reported by a data source.

    inputs: device input names as in the request, empty if the device does not report which. words:
    the fault, without a full stop. host_time_ns: time of the report, by ``time.monotonic_ns()``; 0
    if the fault is older than the stream.
    """

    kind: InputFaultKind
    inputs: tuple[str, ...]
    words: str
    host_time_ns: int


@runtime_checkable
class InputSupervision(Protocol):
    """Optional interface of a data source, in addition to ``DataSource``."""

    def input_faults(self) -> tuple[InputFault, ...]:
        """Return the input faults reported since the start, each once, oldest first.

        No communication, no wait, no exception; callable from any thread at any time. A fault stays
        in the list until the next start: devices seldom report its end. After one of kind
        SENSOR_BROKEN every sample carries ``Quality.SENSOR_FAULT`` until the next start.
        """


@runtime_checkable
class LineCounters(Protocol):
    """Optional interface of any driver, in addition to ``DataSource`` or ``Spindle``."""

    def counters(self) -> Mapping[str, int]:
        """Return the counters of the line by name, in display order.

        Usual names: ``bytes_received``, ``bytes_sent``, ``lost_samples``, ``crc_errors``,
        ``retries``. They count from the opening of the port or the start of the stream. No
        communication, no wait, no exception; callable from any thread at any time.
        """


@dataclass(frozen=True, slots=True)
class DriveStatus:
    """State of the drive at one moment; speed in rev/s of the crank, with the rig's sign.

    position_count: of the drive's own encoder, on the motor side of a gear. torque_Nm: of the
    motor, as estimated by the drive; NaN if not available.
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
    """Request to configure a drive; the watchdog is mandatory.

    counts_per_revolution: of the drive's own encoder, after quadrature, for one turn of the motor.
    gear_ratio: turns of the motor for one of the crank, positive. Every speed and acceleration that
    a Spindle takes or returns is the crank's. direction: +1 or -1, the rig's positive direction
    relative to the drive's.
    """

    counts_per_revolution: int
    direction: int
    maximum_speed_rev_per_s: float
    watchdog_timeout_s: float
    settings: Mapping[str, Any] = field(default_factory=dict)
    gear_ratio: float = 1.0

    def __post_init__(self) -> None:
        """Raise ValueError for an invalid gear ratio."""
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
    """Turn the crank. The driver's lock serialises every call except ``drive_off``.

    The watchdog's setting is read back before the motor is enabled, in ``reset_fault`` and
    periodically in ``status``; if it has changed, the power is removed and SettingsLost raised.
    """

    def open(self) -> Identity:
        """Open the port and identify the drive; raise ConnectionFailed or WrongDevice."""

    def configure(self, request: DriveRequest) -> Mapping[str, str | float | int]:
        """Set the watchdog and all settings that differ; return the values read back."""

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        """Ramp to a speed; 0 is a controlled stop."""

    def drive_off(self) -> None:
        """Remove the motor's power at once (coast or brake, depending on the drive).

        Callable from any thread at any time. The command is sent during a pending call, which then
        sends no further speed command.
        """

    def reset_fault(self) -> None:
        """Acknowledge faults on the operator's request; the motor stays off.

        A fault that stopped the motor (watchdog, fault of the drive) stays in ``status().faults``
        until this or ``configure``. Raises DeviceFault while its cause persists.
        """

    def status(self) -> DriveStatus:
        """Return the state; this feeds the drive's watchdog."""

    def close(self) -> None:
        """Stop the motor and release the drive; never raises; safe to call twice."""


@dataclass(frozen=True, slots=True)
class SlowRequest:
    """Request for quantities of a device that is not synchronous with the crank.

    quantities: names with their unit, as ``SlowSource.read`` returns them (``temperature_C``).
    timeout_s: maximum duration of one ``read``. settings: the driver's own keys.
    """

    quantities: tuple[str, ...]
    timeout_s: float = 2.0
    settings: Mapping[str, Any] = field(default_factory=dict)


@runtime_checkable
class SlowSource(Named, Protocol):
    """Read slow quantities (temperature, humidity) on request, in a separate thread.

    After any error the caller closes the source and opens it again.
    """

    def open(self) -> Identity:
        """Open the port and identify the device; raise ConnectionFailed or WrongDevice."""

    def configure(self, request: SlowRequest) -> Mapping[str, str | float | int]:
        """Check that the device has these quantities; return the settings read back.

        Raises SettingRefused, which names the quantities that the device has.
        """

    def read(self) -> Mapping[str, float]:
        """Return the present values by quantity, NaN if the device reports one as invalid.

        Raises ReplyTimeout, ProtocolError or DeviceLost.
        """

    def close(self) -> None:
        """Release the device; never raises; safe to call twice."""


class DriverKind(enum.StrEnum):
    """Kind of device that a driver is for."""

    DATA_SOURCE = "data source"
    SPINDLE = "spindle"
    SLOW_SOURCE = "slow source"


@dataclass(frozen=True, slots=True)
class SettingSpec:
    """One key of ``[devices.NAME.settings]``: type, default, range, description.

    kind: ``object`` if the choices are of several types.
    """

    kind: type
    default: Any
    sentence: str
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[Any, ...] = ()


def filled(specs: Mapping[str, SettingSpec], settings: Mapping[str, Any]) -> dict[str, Any]:
    """Return settings completed with the defaults."""
    return {key: spec.default for key, spec in specs.items()} | dict(settings)


class InvalidRequest(SentenceError, ValueError):
    """A request that no device of this type can fulfil; one sentence with the remedy."""


@contextlib.contextmanager
def refusing(who: Named | Line) -> Iterator[None]:
    """Re-raise the ValueError of a check as SettingRefused with device and port."""
    try:
        yield
    except ValueError as error:
        raise SettingRefused.at(who, sentence_of_error(error)) from error


class DriverFactory(Protocol):
    """Factory of a driver for a named device on a port."""

    def __call__(
        self, name: str, port: str, settings: Mapping[str, Any]
    ) -> DataSource | Spindle | SlowSource:
        """Return the driver, not yet open; settings: keys as listed in ``SettingSpec``."""


@dataclass(frozen=True, slots=True)
class Probe:
    """Method to identify the device on an open port without moving a motor or changing a setting.

    ask: takes the open port and the time-out of one reply in s; returns None for a different
    device. baud_rates: the usual ones, tried in turn if the port has a baud rate.
    """

    ask: Callable[[BytePort, float], Identity | None]
    baud_rates: tuple[int, ...] = (115200,)


class WireDecoder(Protocol):
    """Decode a recorded line into text, piece by piece, in chronological order."""

    def sent(self, data: bytes) -> Iterable[str]:
        """Return the program's requests as text, one per line."""

    def received(self, data: bytes) -> Iterable[str]:
        """Return the replies completed by these bytes as text, one per line."""


@dataclass(frozen=True, slots=True)
class DriverInfo:
    """Description of a driver: the object that an entry point of ``rigapp.drivers`` names.

    simulator: "package.module:Class" of its byte-level simulator, loaded by the simulated rig only.
    usb_ids: vendor and product (None: any of that vendor) of devices with their own USB id.
    probe: how ``rigapp doctor`` identifies the device; None: by its USB id only.
    check: raises ValueError with one sentence for a request (``DataRequest``, ``DriveRequest`` or
    ``SlowRequest``) that no such device can fulfil, before a port is opened; None: no such check.
    quantities: slow values that the device can report in addition to the test's samples, each with
    its unit (``temperature_C``, ``humidity_percent``): keys of ``read`` of a slow source, fields of
    ``DriveStatus`` of a spindle. Channels of a rig file name them as ``source``. needed: quantity
    -> the setting that it requires. decoder: decodes a recorded line (``rigapp wire``); None: shown
    as bytes. protocol: content of a recording, "bytes" of a serial line or "slcan" for the frames
    of a CAN bus.
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
