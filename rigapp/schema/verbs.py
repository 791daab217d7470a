"""The one table of what may be asked of an engine: argument record, who may, lane, time-out.

A new verb is one row here, with a record of its arguments where it has any, and what it does in
``service.host``. Bounds of the arguments stand in the records and are judged by ``service.bounds``.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Annotated, Any

import msgspec

from rigapp.schema.faults import FaultRecord
from rigapp.schema.messages import NOTE_CHARACTERS

PATH_CHARACTERS = 4096
"""Systems take paths of so many bytes."""

WHAT_CHARACTERS = 100
"""Of the name of what is calibrated: it is shown in the strip."""

Words = Annotated[str, msgspec.Meta(max_length=NOTE_CHARACTERS)]
Name = Annotated[str, msgspec.Meta(max_length=PATH_CHARACTERS)]
Pin = Annotated[str, msgspec.Meta(max_length=100)]
Duration = Annotated[float, msgspec.Meta(ge=0.0, le=1e9)]
Revolutions = Annotated[Any, msgspec.Meta(extra={"key": "run.revolutions"})]
"""A number that is judged, and named, like a key of a file; see ``config.ranges``."""


class Nothing(msgspec.Struct, frozen=True):
    """Ask without arguments."""


class Reason(msgspec.Struct, frozen=True):
    """Say why."""

    reason: Words = ""


class AlarmKey(msgspec.Struct, frozen=True):
    """Name an alarm; none: all of them."""

    key: Name = ""


class Start(msgspec.Struct, frozen=True):
    """Name the test file, the file to make, and how many revolutions in place of the test's.

    calibration: key of the open calibration that the test is part of.
    """

    test: Name
    out: Name
    revolutions: Revolutions = None
    calibration: Name = ""


class BeginCalibration(msgspec.Struct, frozen=True):
    """Name what is calibrated, and the fastest speed at which it turns the spindle, 0: never."""

    what: Annotated[str, msgspec.Meta(min_length=1, max_length=WHAT_CHARACTERS)]
    fastest_rpm: Annotated[float, msgspec.Meta(ge=0.0, le=1e5)] = 0.0


class CalibrationKey(msgspec.Struct, frozen=True):
    """Give the key that the beginning of the calibration was answered with."""

    key: Name


class ReleaseCalibration(Reason, frozen=True):
    """Say which calibration is ended: ``since`` of the one that was looked at, 0: whichever."""

    since: float = 0.0


class File(msgspec.Struct, frozen=True):
    """Name the file of a test."""

    file: Name


class Resume(File, frozen=True):
    """Name the file of a test to go on with; reason: why it may in spite of what differs."""

    reason: Words = ""


class QueueAdd(msgspec.Struct, frozen=True):
    """Name test files for the end of the queue, and the folder for what they record."""

    tests: tuple[Name, ...]
    folder: Name


class QueueRemove(msgspec.Struct, frozen=True):
    """Name tests of the queue by their numbers."""

    numbers: tuple[int, ...]


class Shelve(msgspec.Struct, frozen=True):
    """Name an alarm to hide for some minutes, and why."""

    key: Name
    reason: Words
    minutes: Duration


class Note(msgspec.Struct, frozen=True):
    """Carry a note for the log."""

    text: Annotated[str, msgspec.Meta(max_length=NOTE_CHARACTERS, title="note")]


class Extend(msgspec.Struct, frozen=True):
    """Give the test under way another number of revolutions; pin: where the rig file wants one."""

    revolutions: Revolutions
    reason: Words = ""
    pin: Pin = ""


class SetLimit(msgspec.Struct, frozen=True):
    """Name a limit, see ``Engine.set_limit``, and its new value, which is judged there.

    pin: of who asks, where the rig file wants one.
    """

    name: Name
    value: Any
    reason: Words = ""
    pin: Pin = ""


class Zero(msgspec.Struct, frozen=True):
    """Name what to zero."""

    what: tuple[Name, ...] = ("load_cell",)
    reason: Words = ""


class LinesToReport(msgspec.Struct, frozen=True):
    """Name the package to write, the devices (none: all), and for how long, 0: until it is ended.

    reconnect: the devices are connected anew, so that their set-up is recorded.
    """

    file: Name
    devices: tuple[Name, ...] = ()
    duration_s: Annotated[float, msgspec.Meta(ge=0.0, le=86400.0)] = 0.0
    reconnect: bool = False


class FaultKind(msgspec.Struct, frozen=True):
    """Name a kind of fault of the simulated rig."""

    kind: Name


class LastSeconds(msgspec.Struct, frozen=True):
    """Say how many of the last seconds are wanted."""

    window_s: Duration


class Hand(msgspec.Struct, frozen=True):
    """Say what simulated hands shall do, see ``simulation.simulated_operator``."""

    what: Name
    details: dict[str, str | int | float | bool] = {}


class Force(msgspec.Struct, frozen=True):
    """Say whether to take what another has."""

    force: bool = False


class Priority(enum.StrEnum):
    """Where a request waits its turn, and whose workers carry it out.

    SAFETY: each verb has workers of its own, so that nothing else, however many requests hang,
    keeps it waiting, and it is never refused for its arguments. The verbs of each other lane share
    its workers.
    """

    SAFETY = "safety"
    LOOK = "look"
    WORK = "work"


class Who(enum.StrEnum):
    """Who may ask: any viewer at any time, or only the one in command while there is one."""

    ANYONE = "anyone"
    HOLDER = "holder of command"


@dataclass(frozen=True, slots=True)
class Verb:
    """How the service treats a verb.

    timeout_s: how long its sender waits for the answer unless it says otherwise. urgent: it never
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
    """Return how a verb is treated, by name; one that nobody knows like work without arguments."""
    return VERBS.get(name) or Verb(name, Nothing, Priority.WORK)
