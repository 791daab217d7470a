"""Where drivers are called: whatever one of them raises leaves as a DeviceError.

A driver may be anybody's, and may call any library: it raises what it likes, SystemExit included.
Who calls one through here meets a ``DriverFailed`` that names device, port and what was being done,
with the error as its cause; the log has the traceback. An answer of another kind than the Protocol
says is a failure too.
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
"""Call of a driver -> what was being done, for the sentence."""

MOST_WORDS = 300
"""Characters of an error of others that are repeated; some bring a whole page."""

Readback = Mapping[str, str | float | int]
Answer = TypeVar("Answer")


@contextlib.contextmanager
def foreign(convert: Callable[[BaseException], Exception]) -> Iterator[None]:
    """Call code of others: whatever it raises leaves as what ``convert`` makes of it.

    Only the user's own interrupt, which reaches the main thread, is left as it is.
    """
    try:
        yield
    except BaseException as error:
        ours = threading.current_thread() is threading.main_thread()
        if isinstance(error, GeneratorExit) or (isinstance(error, KeyboardInterrupt) and ours):
            raise
        raise convert(error) from error


def failure_words(error: BaseException) -> str:
    """Return what an error of others says, in one line of bounded length."""
    try:
        said = " ".join(sentence_of_error(error).split())[:MOST_WORDS]
    except Exception:  # of a library whose error has no words
        said = ""
    return say("{}: {}", type(error).__name__, said) if said else type(error).__name__


class Edge:
    """What every guarded driver has: whose it is, and the way in which it is called.

    driver: the one behind, for what only some drivers offer; call it inside ``calling``.
    serial_number: what the device must say that it has; empty: any.
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
        """Return what a driver has raised as the DeviceError that it should have been."""
        if isinstance(error, DeviceError) and isinstance(getattr(error, "sentence", None), str):
            return error
        # Once of each kind: a drive is asked ten times a second.
        if (doing, type(error)) not in self._logged:
            self._logged.add((doing, type(error)))
            who = (self.name, self.port, doing)
            log.warning("%s on %s failed while %s (%s)", *who, failure_words(error))
            # For files: no traceback on a terminal.
            log.info("%s on %s failed while %s", *who, exc_info=error)
        sentence = say("its driver {} failed while {}; the log has the details.", self._kind, doing)
        return DriverFailed(self.name, self.port, sentence)

    def _call(self, call: str, kind: type[Answer], *arguments: Any) -> Answer:
        """Return the answer of a call, which must be of a kind; raise DeviceError."""
        with self.calling(DOING[call]):
            answer = getattr(self.driver, call)(*arguments)
            if not isinstance(answer, kind):
                raise TypeError(type(answer).__name__)
        return answer

    def _said(self, call: str, form: Callable[..., Answer]) -> Answer:
        """Return what a driver says of itself in a form; the empty one where it fails or cannot."""
        with contextlib.suppress(DeviceError), self.calling(DOING[call]):
            said = getattr(self.driver, call, None)
            if said is not None:
                return form(said())
        return form()

    def counters(self) -> Mapping[str, int]:
        """Return what the driver counted on its line (``LineCounters``), empty without any."""
        return self._said("counters", dict[str, int])

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
        """Put what was asked and answered beside the bytes, where the line is recorded."""
        for recorder in recorders_of(self.name, self.port):
            recorder.note(content)


class GuardedSource(Edge):
    """A ``DataSource`` behind the edge, with ``InputSupervision``."""

    def configure(self, request: DataRequest) -> StreamSetup:
        """Set what differs, read everything back; raise DeviceError."""
        setup = self._call("configure", StreamSetup, request)
        self._note(request=asdict(request), readback=dict(setup.readback))
        return setup

    def start(self) -> None:
        """Start streaming; raise DeviceError."""
        self._call("start", object)

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block, None when none came in time; raise DeviceError."""
        with self.calling(DOING["read"]):
            block = self.driver.read(timeout_s)
            if not isinstance(block, Block | None):
                raise TypeError(type(block).__name__)
        return block

    def zero(self, inputs: Sequence[str]) -> None:
        """Zero inputs in the device where it can; raise DeviceError."""
        self._call("zero", object, inputs)

    def stop(self) -> None:
        """Stop streaming; raise DeviceError."""
        self._call("stop", object)

    def input_faults(self) -> tuple[InputFault, ...]:
        """Return what the device said of its inputs, empty where it says nothing."""
        return self._said("input_faults", tuple[InputFault, ...])


class GuardedSpindle(Edge):
    """A ``Spindle`` behind the edge."""

    def configure(self, request: DriveRequest) -> Readback:
        """Set the watchdog and what else differs; raise DeviceError."""
        return self._configured(request)

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        """Ramp to a speed; raise DeviceError."""
        self._call("set_speed", object, speed_rev_per_s, acceleration_rev_per_s2)

    def drive_off(self) -> None:
        """Take the power off the motor at once; raise DeviceError."""
        self._call("drive_off", object)

    def reset_fault(self) -> None:
        """Acknowledge faults; raise DeviceError."""
        self._call("reset_fault", object)

    def status(self) -> DriveStatus:
        """Read the state, which feeds the drive's watchdog; raise DeviceError."""
        return self._call("status", DriveStatus)


class GuardedSlow(Edge):
    """A ``SlowSource`` behind the edge."""

    def configure(self, request: SlowRequest) -> Readback:
        """Check that the device tells these quantities; raise DeviceError."""
        return self._configured(request)

    def read(self) -> Mapping[str, float]:
        """Return the values now, by quantity, as numbers; raise DeviceError."""
        with self.calling(DOING["read"]):
            return {str(name): float(value) for name, value in self.driver.read().items()}


def _same_number(required: str, told: str) -> bool:
    """Tell whether a device has the required serial number; leading zeros are left out by some."""
    number, other = (one.strip().casefold().lstrip("0") for one in (required, told))
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
    """Make a driver for a named device on a port, behind the edge; raise DeviceError.

    serial_number: what the device must say when it is opened; empty: any.
    """
    edge = GUARDS[info.kind](None, name, port, info.name)
    edge.serial_number = serial_number
    with edge.calling(say("it was made")):
        edge.driver = info.factory(name, port, dict(settings))
    return edge
