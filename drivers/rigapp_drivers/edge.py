"""Wrap every call of a driver: any exception is converted into a DeviceError.

Third-party drivers and their libraries may raise anything, SystemExit included. Callers receive a
``DriverFailed`` with device, port and operation, and the original exception as its cause; the
traceback is logged. A return value of a type other than the Protocol's is a failure too.
"""

from __future__ import annotations

import contextlib
import logging
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any, TypeVar

from rigapp.texts import say, sentence_of_error
from rigapp_drivers.api import (
    Block,
    DataRequest,
    DeviceError,
    DriveRequest,
    DriverFailed,
    DriverInfo,
    DriverKind,
    DriveStatus,
    Identity,
    InputFault,
    SlowRequest,
    StreamSetup,
    WrongDevice,
)
from rigapp_drivers.wire.recorder import recorders_of

log = logging.getLogger(__name__)

DOING = {
    "open": say("it was opened"),
    "configure": say("it was set up"),
    "start": say("it was started"),
    "read": say("it was read"),
    "zero": say("it was zeroed"),
    "stop": say("it was stopped"),
    "close": say("it was closed"),
    "set_speed": say("it was given a speed"),
    "drive_off": say("its power was taken off"),
    "reset_fault": say("its fault was reset"),
    "status": say("it was read"),
    "counters": say("its counters were read"),
    "input_faults": say("its inputs were read"),
}
"""Method of a driver -> description of the operation for the error text."""

MOST_WORDS = 300
"""Maximum length of a quoted foreign error text; some are a page long."""

Readback = Mapping[str, str | float | int]
Answer = TypeVar("Answer")


@contextlib.contextmanager
def foreign(convert: Callable[[BaseException], Exception]) -> Iterator[None]:
    """Call foreign code and raise its exceptions as converted by ``convert``.

    Only KeyboardInterrupt in the main thread passes unchanged.
    """
    try:
        yield
    except BaseException as error:
        ours = threading.current_thread() is threading.main_thread()
        if isinstance(error, GeneratorExit) or (isinstance(error, KeyboardInterrupt) and ours):
            raise
        raise convert(error) from error


def failure_words(error: BaseException) -> str:
    """Return the text of a foreign exception on one line of bounded length."""
    try:
        text = " ".join(sentence_of_error(error).split())[:MOST_WORDS]
    except Exception:  # a library's exception whose __str__ fails
        text = ""
    return say("{}: {}", type(error).__name__, text) if text else type(error).__name__


class Edge:
    """Base of all guarded drivers.

    driver: the wrapped driver, for optional functions; call it inside ``calling``.
    serial_number: required serial number; empty: any.
    """

    def __init__(self, driver: Any, name: str, port: str, kind: str) -> None:
        self.driver = driver
        self.name, self.port = name, port
        self.serial_number = ""
        self._kind = kind
        self._logged: set[tuple[str, type[BaseException]]] = set()

    def calling(self, doing: str) -> contextlib.AbstractContextManager[None]:
        """Return the context of a call; raise DeviceError alone. doing: as in ``DOING``."""
        return foreign(lambda error: self._converted(error, doing))

    def _converted(self, error: BaseException, doing: str) -> DeviceError:
        """Return the exception of a driver as a DeviceError."""
        if isinstance(error, DeviceError) and isinstance(getattr(error, "sentence", None), str):
            return error
        # Log each type once: a drive is polled ten times a second.
        if (doing, type(error)) not in self._logged:
            self._logged.add((doing, type(error)))
            who = (self.name, self.port, doing)
            log.warning("%s on %s failed while %s (%s)", *who, failure_words(error))
            # Traceback for log files only, not for the terminal.
            log.info("%s on %s failed while %s", *who, exc_info=error)
        sentence = say("its driver {} failed while {}; the log has the details.", self._kind, doing)
        return DriverFailed(self.name, self.port, sentence)

    def _call(self, call: str, kind: type[Answer], *arguments: Any) -> Answer:
        """Return the result of a call and check its type; raise DeviceError."""
        with self.calling(DOING[call]):
            answer = getattr(self.driver, call)(*arguments)
            if not isinstance(answer, kind):
                raise TypeError(type(answer).__name__)
        return answer

    def _optional(self, call: str, form: Callable[..., Answer]) -> Answer:
        """Return an optional report of a driver, converted by ``form``; empty on failure."""
        with contextlib.suppress(DeviceError), self.calling(DOING[call]):
            report = getattr(self.driver, call, None)
            if report is not None:
                return form(report())
        return form()

    def counters(self) -> Mapping[str, int]:
        """Return the driver's ``LineCounters``, empty if it has none."""
        return self._optional("counters", dict[str, int])

    def close(self) -> None:
        """Release the device; never raises."""
        with contextlib.suppress(DeviceError):
            self._call("close", object)

    def open(self) -> Identity:
        """Open the port and identify the device; raise DeviceError."""
        identity = self._call("open", Identity)
        if not _same_number(self.serial_number, identity.serial_number):
            self.close()
            if not identity.serial_number:
                raise WrongDevice.at(
                    self,
                    (
                        "the device reports no serial number, and {} is required; remove"
                        " serial_number, and name its port by that of its USB cable"
                        " (serial:NUMBER)."
                    ),
                    self.serial_number,
                )
            raise WrongDevice.at(
                self,
                "the device with the serial number {} answers, and {} is required; check the"
                " ports, or correct serial_number in the rig file.",
                identity.serial_number,
                self.serial_number,
            )
        self._note(identity=asdict(identity))
        return identity

    def _configured(self, request: DriveRequest | SlowRequest) -> Readback:
        with self.calling(DOING["configure"]):
            readback = dict(self.driver.configure(request))
        self._note(request=asdict(request), readback=readback)
        return readback

    def _note(self, **content: object) -> None:
        """Add request and result to the recording of the line, if there is one."""
        for recorder in recorders_of(self.name, self.port):
            recorder.note(content)


class GuardedSource(Edge):
    """Guarded ``DataSource``, with ``InputSupervision``."""

    def configure(self, request: DataRequest) -> StreamSetup:
        """Write the settings that differ, read all back; raise DeviceError."""
        setup = self._call("configure", StreamSetup, request)
        self._note(request=asdict(request), readback=dict(setup.readback))
        return setup

    def start(self) -> None:
        """Start streaming; raise DeviceError."""
        self._call("start", object)

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block, None on time-out; raise DeviceError."""
        with self.calling(DOING["read"]):
            block = self.driver.read(timeout_s)
            if not isinstance(block, Block | None):
                raise TypeError(type(block).__name__)
        return block

    def zero(self, inputs: Sequence[str]) -> None:
        """Zero inputs in the device; raise DeviceError."""
        self._call("zero", object, inputs)

    def stop(self) -> None:
        """Stop streaming; raise DeviceError."""
        self._call("stop", object)

    def input_faults(self) -> tuple[InputFault, ...]:
        """Return the faults reported by the device's inputs, empty if not supported."""
        return self._optional("input_faults", tuple[InputFault, ...])


class GuardedSpindle(Edge):
    """Guarded ``Spindle``."""

    def configure(self, request: DriveRequest) -> Readback:
        """Set the watchdog and all settings that differ; raise DeviceError."""
        return self._configured(request)

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        """Ramp to a speed; raise DeviceError."""
        self._call("set_speed", object, speed_rev_per_s, acceleration_rev_per_s2)

    def drive_off(self) -> None:
        """Remove the motor's power at once; raise DeviceError."""
        self._call("drive_off", object)

    def reset_fault(self) -> None:
        """Acknowledge faults; raise DeviceError."""
        self._call("reset_fault", object)

    def status(self) -> DriveStatus:
        """Return the state; this feeds the drive's watchdog; raise DeviceError."""
        return self._call("status", DriveStatus)


class GuardedSlow(Edge):
    """Guarded ``SlowSource``."""

    def configure(self, request: SlowRequest) -> Readback:
        """Check that the device has these quantities; raise DeviceError."""
        return self._configured(request)

    def read(self) -> Mapping[str, float]:
        """Return the present values by quantity; raise DeviceError."""
        with self.calling(DOING["read"]):
            return {str(name): float(value) for name, value in self.driver.read().items()}


def _same_number(required: str, reported: str) -> bool:
    """Return whether the serial numbers agree; some devices omit leading zeros."""
    number, other = (value.strip().casefold().lstrip("0") for value in (required, reported))
    return not required.strip() or number == other


Guarded = GuardedSource | GuardedSpindle | GuardedSlow

GUARDS: Mapping[DriverKind, Callable[[Any, str, str, str], Guarded]] = {
    DriverKind.DATA_SOURCE: GuardedSource,
    DriverKind.SPINDLE: GuardedSpindle,
    DriverKind.SLOW_SOURCE: GuardedSlow,
}


def make_driver(
    info: DriverInfo, name: str, port: str, settings: Mapping[str, Any], serial_number: str = ""
) -> Guarded:
    """Create a guarded driver for a named device on a port; raise DeviceError.

    serial_number: checked when the device is opened; empty: any.
    """
    edge = GUARDS[info.kind](None, name, port, info.name)
    edge.serial_number = serial_number
    with edge.calling(say("it was made")):
        edge.driver = info.factory(name, port, dict(settings))
    return edge
