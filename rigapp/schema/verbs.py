"""Table of the engine's requests: argument record, permission, priority, time-out.

A new verb is one row here, with a record of its arguments if any, and its action in
``service.host``. Bounds of the arguments are in the records and checked by ``service.bounds``.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Annotated, Any

import msgspec

from rigapp.schema.faults import FaultRecord
from rigapp.schema.messages import NOTE_CHARACTERS

PATH_CHARACTERS = 4096
"""Limit of operating systems for the bytes of a path."""

WHAT_CHARACTERS = 100
"""Limit for the name of a calibration, which is shown in the strip."""

Words = Annotated[str, msgspec.Meta(max_length=NOTE_CHARACTERS)]
Name = Annotated[str, msgspec.Meta(max_length=PATH_CHARACTERS)]
Pin = Annotated[str, msgspec.Meta(max_length=100)]
Duration = Annotated[float, msgspec.Meta(ge=0.0, le=1e9)]
Revolutions = Annotated[Any, msgspec.Meta(extra={"key": "run.revolutions"})]
"""A number that is checked, and named, like a key of a file; see ``config.ranges``."""


class Nothing(msgspec.Struct, frozen=True):
    """No arguments."""


class Reason(msgspec.Struct, frozen=True):
    """A reason."""

    reason: Words = ""


class AlarmKey(msgspec.Struct, frozen=True):
    """Key of an alarm; none: all of them."""

    key: Name = ""


class Start(msgspec.Struct, frozen=True):
    """The test file, the file to make, and revolutions that override the test's.

    calibration: key of the open calibration to which the test belongs.
    """

    test: Name
    out: Name
    revolutions: Revolutions = None
    calibration: Name = ""


class BeginCalibration(msgspec.Struct, frozen=True):
    """Calibration type, and the fastest speed at which it turns the spindle, 0: never."""

    what: Annotated[str, msgspec.Meta(min_length=1, max_length=WHAT_CHARACTERS)]
    fastest_rpm: Annotated[float, msgspec.Meta(ge=0.0, le=1e5)] = 0.0


class CalibrationKey(msgspec.Struct, frozen=True):
    """Key in the reply to the beginning of the calibration."""

    key: Name


class ReleaseCalibration(Reason, frozen=True):
    """Calibration to end: ``since`` of the one that was shown, 0: any."""

    since: float = 0.0


class File(msgspec.Struct, frozen=True):
    """File of a test."""

    file: Name


class Resume(File, frozen=True):
    """File of a test to resume; reason: for resuming in spite of differences."""

    reason: Words = ""


class QueueAdd(msgspec.Struct, frozen=True):
    """Test files for the end of the queue, and the folder for their recordings."""

    tests: tuple[Name, ...]
    folder: Name


class QueueRemove(msgspec.Struct, frozen=True):
    """Numbers of tests of the queue."""

    numbers: tuple[int, ...]


class Shelve(msgspec.Struct, frozen=True):
    """Alarm to hide for some minutes, and the reason."""

    key: Name
    reason: Words
    minutes: Duration


class Note(msgspec.Struct, frozen=True):
    """A note for the log."""

    text: Annotated[str, msgspec.Meta(max_length=NOTE_CHARACTERS, title="note")]


class Extend(msgspec.Struct, frozen=True):
    """New number of revolutions of the test under way; pin: if the rig file requires one."""

    revolutions: Revolutions
    reason: Words = ""
    pin: Pin = ""


class SetLimit(msgspec.Struct, frozen=True):
    """A limit, see ``Engine.set_limit``, and its new value, which is checked there.

    pin: of the operator, if the rig file requires one.
    """

    name: Name
    value: Any
    reason: Words = ""
    pin: Pin = ""


class Zero(msgspec.Struct, frozen=True):
    """Instrument to zero."""

    what: tuple[Name, ...] = ("load_cell",)
    reason: Words = ""


class LinesToReport(msgspec.Struct, frozen=True):
    """The package to write, the devices (none: all), and the duration, 0: until ended.

    reconnect: reconnect the devices, so that their set-up is recorded.
    """

    file: Name
    devices: tuple[Name, ...] = ()
    duration_s: Annotated[float, msgspec.Meta(ge=0.0, le=86400.0)] = 0.0
    reconnect: bool = False


class FaultKind(msgspec.Struct, frozen=True):
    """A kind of fault of the simulated rig."""

    kind: Name


class LastSeconds(msgspec.Struct, frozen=True):
    """Number of the last seconds to return."""

    window_s: Duration


class Hand(msgspec.Struct, frozen=True):
    """Action of the simulated operator, see ``simulation.simulated_operator``."""

    what: Name
    details: dict[str, str | int | float | bool] = {}


class Force(msgspec.Struct, frozen=True):
    """Whether to take over the control of another viewer."""

    force: bool = False


class Priority(enum.StrEnum):
    """Queue in which a request waits, with its workers.

    SAFETY: each verb has workers of its own, so that hanging requests never delay it, and it is
    never refused for its arguments. The verbs of each other priority share its workers.
    """

    SAFETY = "safety"
    LOOK = "look"
    WORK = "work"


class Who(enum.StrEnum):
    """Permission: any viewer at any time, or only the holder of the control lock, if any."""

    ANYONE = "anyone"
    HOLDER = "holder of command"


@dataclass(frozen=True, slots=True)
class Verb:
    """Handling of a verb by the service.

    timeout_s: default time-out of the sender. urgent: it never
    waits behind another request of the same viewer.
    """

    name: str
    record: type[msgspec.Struct]
    lane: Priority
    who: Who = Who.HOLDER
    timeout_s: float = 10.0
    urgent: bool = False


VERBS = {
    verb.name: verb
    for verb in (
        Verb("stop", Reason, Priority.SAFETY, Who.ANYONE, urgent=True),
        Verb("drive_off", Reason, Priority.SAFETY, Who.ANYONE, urgent=True),
        Verb("acknowledge", AlarmKey, Priority.SAFETY, Who.ANYONE, urgent=True),
        Verb("reset", Nothing, Priority.SAFETY, timeout_s=30.0, urgent=True),
        Verb("hello", Nothing, Priority.LOOK, Who.ANYONE),
        Verb("status", Nothing, Priority.LOOK, Who.ANYONE),
        Verb("present", Nothing, Priority.LOOK, Who.ANYONE, timeout_s=2.0),
        Verb("take_command", Force, Priority.LOOK, Who.ANYONE),
        Verb("release_command", Nothing, Priority.LOOK, Who.ANYONE),
        Verb("signals", LastSeconds, Priority.WORK, Who.ANYONE),
        Verb("simulation_state", Nothing, Priority.WORK, Who.ANYONE),
        Verb("connect", Nothing, Priority.WORK, timeout_s=90.0),
        Verb("reconnect", Nothing, Priority.WORK, timeout_s=90.0),
        Verb("start", Start, Priority.WORK, timeout_s=120.0),
        Verb("resume_file", Resume, Priority.WORK, timeout_s=120.0),
        Verb("queue_start", Nothing, Priority.WORK, timeout_s=120.0),
        Verb("queue_stop", Nothing, Priority.WORK),
        Verb("queue_add", QueueAdd, Priority.WORK),
        Verb("queue_remove", QueueRemove, Priority.WORK),
        Verb("examine_file", File, Priority.WORK, timeout_s=120.0),
        Verb("pause", Reason, Priority.WORK, urgent=True),
        Verb("resume", Nothing, Priority.WORK, timeout_s=30.0),
        Verb("shelve", Shelve, Priority.WORK),
        Verb("note", Note, Priority.WORK),
        Verb("extend", Extend, Priority.WORK),
        Verb("set_limit", SetLimit, Priority.WORK),
        Verb("calibration_begin", BeginCalibration, Priority.WORK, timeout_s=20.0),
        Verb("calibration_end", CalibrationKey, Priority.WORK, Who.ANYONE, timeout_s=30.0),
        Verb("calibration_release", ReleaseCalibration, Priority.WORK, timeout_s=30.0),
        Verb("report_begin", LinesToReport, Priority.WORK, timeout_s=120.0),
        Verb("report_end", Nothing, Priority.WORK, timeout_s=60.0),
        Verb("use_records", Nothing, Priority.WORK),
        Verb("zero", Zero, Priority.WORK, timeout_s=60.0),
        Verb("inject_fault", FaultRecord, Priority.WORK),
        Verb("clear_fault", FaultKind, Priority.WORK),
        Verb("hand", Hand, Priority.WORK, timeout_s=30.0),
        Verb("shutdown", Nothing, Priority.LOOK),
    )
}


def verb_of(name: str) -> Verb:
    """Return the handling of a verb by name; an unknown one is work without arguments."""
    return VERBS.get(name) or Verb(name, Nothing, Priority.WORK)
