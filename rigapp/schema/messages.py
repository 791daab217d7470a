"""Messages between engine, twin, window and command line: msgspec records, sent as MessagePack.

Arrays travel as bytes (little-endian) and come back by ``as_array``. A message is immutable.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping
from functools import cache
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.channels import BASE
from rigapp.schema.queue import QueuedTest
from rigapp.schema.wire import tree_of

PROTOCOL_VERSION = 4
FLAT_STATUS = (2, 3)
"""Older versions that a viewer accepts: their status is flat, the texts of 2 are plain."""

NOTE_CHARACTERS = 2000
"""Maximum length of a note, and of the reason of a command."""


class RunState(enum.StrEnum):
    """States of a run; every path through them ends with the spindle stopped and a reason.

    CALIBRATING: displayed for a rig at rest that a calibration occupies; not a state of the
    engine, see ``Status.shown``.
    """

    IDLE = "idle"
    CONNECTING = "connecting"
    READY = "ready"
    STARTING = "starting"
    RUNNING = "running"
    PAUSING = "pausing"
    PAUSED = "paused"
    STOPPING = "stopping"
    STOPPED = "stopped"
    FAULT = "fault"
    CALIBRATING = "calibrating"


AT_REST = frozenset({RunState.IDLE, RunState.READY, RunState.STOPPED})
"""States without a test and without a fault: a calibration may occupy the rig in them."""


class FinishReason(enum.StrEnum):
    """Code of the reason why a run ended; a sentence accompanies it."""

    COMPLETE = "complete"
    OPERATOR = "operator"
    LIMIT = "limit"
    DEVICE = "device"
    STORAGE = "storage"
    INTERNAL = "internal"


class HowEnded(enum.StrEnum):
    """How a test ended, for display."""

    COMPLETE = "complete"
    OPERATOR = "stopped by operator"
    TRIPPED = "tripped"
    FAULT = "fault"
    INTERRUPTED = "interrupted"
    RUNNING = "running"
    NOT_READABLE = "not readable"


class Flag(enum.IntFlag):
    """Quality of one revolution; 0 is good."""

    GOOD = 0
    LOST_SAMPLES = 1
    COUNT_MISMATCH = 2
    MISSED_INDEX = 4
    SATURATED = 8
    GAP_BEFORE = 16
    REVERSED = 32
    PARTIAL = 64
    TIME_JUMP = 128
    PAUSED = 256
    RAMP = 512
    SENSOR_FAULT = 1024


NOT_STEADY = int(Flag.RAMP | Flag.PAUSED | Flag.PARTIAL)
"""Flags of revolutions away from the set speed: stored and shown, but evaluated by no rule of a
test."""


class Severity(enum.StrEnum):
    """Severity of an alarm."""

    WARNING = "warning"
    CRITICAL = "critical"


class Ends(enum.StrEnum):
    """Latest end of an alarm's condition.

    SEEN: the engine detects its end. STAND: the spindle is stationary. CONNECTION: the devices
    are reconnected. DRIVE: the drive accepts a reset. TEST: the test is over. ENGINE: another
    engine is started.
    """

    SEEN = "seen"
    STAND = "stand"
    CONNECTION = "connection"
    DRIVE = "drive"
    TEST = "test"
    ENGINE = "engine"


class Alarm(msgspec.Struct, frozen=True):
    """An alarm: condition, consequence and remedy.

    value: measured value, for kinds that state one (|F| of an overload, N).
    """

    key: str
    severity: Severity
    title: str
    cause: str
    consequence: str
    action: str
    raised_at: float
    revolution: int
    active: bool = True
    acknowledged: bool = False
    first_out: bool = False
    state: str = "unacknowledged"
    ends: Ends = Ends.SEEN
    value: float | None = None


class PathReport(msgspec.Struct, frozen=True):
    """Event at the file of a test, and whether all of its content has a name again."""

    sentence: str
    saved: bool


class Remedy(enum.StrEnum):
    """Steps from a fault back to a running test, in this order."""

    CAUSE = "cause"
    CONNECT = "connect"
    ACKNOWLEDGE = "acknowledge"
    RESET = "reset"
    RESUME = "go on"
    NONE = "none"


class Recovery(msgspec.Struct, frozen=True):
    """Steps from a state back to a running test; see ``engine.views``.

    step: the next one, NONE while a test runs. verb: the request for it, empty for manual
    work or waiting. sentence: instruction. left: all open steps, in their order.
    cause: key of the alarm concerned, empty without one.
    """

    step: Remedy = Remedy.NONE
    verb: str = ""
    sentence: str = ""
    left: tuple[Remedy, ...] = ()
    cause: str = ""


class OpenCalibration(msgspec.Struct, frozen=True):
    """The calibration that occupies the rig: type, person, and begin, UTC seconds."""

    what: str
    who: str
    since: float


class _UnknownIsNone(msgspec.Struct, frozen=True, omit_defaults=True):
    """Base of records whose numbers may be unknown: None, absent on the wire."""

    def __post_init__(self) -> None:
        """Replace numbers that are not finite by None, those of an older engine too."""
        for name in _may_be_unknown(type(self)):
            value = getattr(self, name)
            if value is not None and not math.isfinite(value):
                msgspec.structs.force_setattr(self, name, None)


@cache
def _may_be_unknown(record: type[msgspec.Struct]) -> tuple[str, ...]:
    return tuple(
        field.name for field in msgspec.structs.fields(record) if field.type == float | None
    )


class DriveView(_UnknownIsNone, frozen=True):
    """State of the drive; age_s: since it was reported.

    A drive may not report every number: None is unknown.
    """

    speed_rpm: float | None
    setpoint_rpm: float | None
    current_A: float | None
    supply_V: float | None
    temperature_C: float | None
    enabled: bool
    emergency_stop: bool
    faults: tuple[str, ...]
    warnings: tuple[str, ...]
    age_s: float | None = None


class ChannelView(_UnknownIsNone, frozen=True):
    """Live state of a channel: its newest raw signal and calibrated value.

    calibration: conversion to the value, in words. age_s: of a slow channel's value, None for a
    sampled one.
    """

    name: str
    raw: float
    raw_unit: str
    value: float
    unit: str
    calibration: str
    uncertainty: float | None = None
    age_s: float | None = None


class DeviceView(msgspec.Struct, frozen=True):
    """State of a device: identity, rate, losses, last error.

    counters: counts of its driver on the line, by name (``bytes_received``, ``crc_errors``,
    ``retries``), in display order; empty without any. wiring: assignment of the
    inputs, if the driver states it. advice: checks of this device. needed: no test runs
    without it; one of slow channels may be missing. help: the section of docs/troubleshooting.md
    for its last error, empty without one.
    """

    name: str
    driver: str
    port: str
    connected: bool
    identity: str
    sample_rate_Hz: float = 0.0
    lost_samples: int = 0
    errors: int = 0
    last_error: str = ""
    counters: dict[str, int] = {}
    wiring: str = ""
    advice: str = ""
    needed: bool = True
    help: str = ""


class LineReport(msgspec.Struct, frozen=True):
    """Recording of the lines for an error report, or the last report.

    file: the package written at the end. since, until: s since 1970; until 0: no limit.
    sentence: result, empty during recording.
    """

    file: str
    devices: tuple[str, ...]
    since: float
    until: float = 0.0
    sentence: str = ""


class EngineStatus(_UnknownIsNone, frozen=True):
    """The engine's part of a status.

    operator: who started the newest test. in_command: holder of the control lock. rows_dropped: not
    sent to this viewer. queue: the tests of the rig's queue, finished ones included; queue_works:
    the next one begins by itself. calibration: the one that occupies the rig, or None; the state
    beside it is the engine's own, since older viewers know no other. line_report: lines that are
    recorded for a report, or the last such report, None before the first.
    """

    state: RunState
    reason: str = ""
    pid: int = 0
    host_time: float = 0.0
    operator: str = ""
    in_command: str = ""
    rows_dropped: int = 0
    queue: tuple[QueuedTest, ...] = ()
    queue_works: bool = False
    calibration: OpenCalibration | None = None
    line_report: LineReport | None = None


class TestStatus(_UnknownIsNone, frozen=True):
    """The test under way, or the last one.

    revolution_age_s: since the newest evaluated revolution ended, None before the first one.
    criterion_percent: distance to its nearest planned end or stop criterion, in
    percent of it. step: of ``steps``, both 0 without steps; resting: between two of them;
    the test resumes by itself in rest_left_s seconds of this computer. outcome: how it ended, None
    while it is open.
    """

    title: str = ""
    file: str = ""
    revolution: int = 0
    planned: int = 0
    committed: int = 0
    first_revolution: int = 0
    target_rpm: float = 0.0
    started_at: float = 0.0
    expected_end_at: float = 0.0
    revolution_age_s: float | None = None
    worst_margin_percent: float | None = None
    worst_margin: str = ""
    criterion_percent: float | None = None
    criterion: str = ""
    twin_revolution: int = 0
    twin_age_s: float | None = None
    residual_rms_N: float | None = None
    step: int = 0
    steps: int = 0
    resting: bool = False
    rest_left_s: float = 0.0
    outcome: HowEnded | None = None


NO_TEST = TestStatus()
"""Displayed without a test."""


class RigStatus(_UnknownIsNone, frozen=True):
    """The rig and its devices.

    speed_rpm, data_age_s: None without a connection. coasting: the crank turns without
    power during a stop. limits_need_pin: only operators with a PIN change limits.
    """

    name: str = ""
    simulated: bool = False
    simulated_speed: float = 0.0
    speed_rpm: float | None = None
    data_age_s: float | None = None
    coasting: bool = False
    drive: DriveView | None = None
    devices: tuple[DeviceView, ...] = ()
    channels: tuple[ChannelView, ...] = ()
    limits_need_pin: bool = False


class Status(msgspec.Struct, frozen=True, omit_defaults=True):
    """The engine, its test and its rig at one moment; test: None before the first one.

    Snapshots contain it as it is; the reply to a request is flat, see ``tree`` and ``of_tree``.
    """

    engine: EngineStatus
    test: TestStatus | None = None
    rig: RigStatus = RigStatus()
    alarms: tuple[Alarm, ...] = ()
    recovery: Recovery = Recovery()

    def shown(self) -> Status:
        """Return it with the displayed state: an open calibration occupies the rig."""
        if self.engine.calibration is None or self.engine.state not in AT_REST:
            return self
        engine = msgspec.structs.replace(self.engine, state=RunState.CALIBRATING)
        return msgspec.structs.replace(self, engine=engine)

    def flat(self) -> dict[str, Any]:
        """Return the fields of all parts by their names in the reply to a request."""
        shown: dict[str, Any] = {"alarms": self.alarms, "recovery": self.recovery}
        for part in (self.engine, self.test or NO_TEST, self.rig):
            for name in part.__struct_fields__:
                shown[_FLAT[type(part)].get(name, name)] = getattr(part, name)
        return shown

    def tree(self) -> dict[str, Any]:
        """Return it as the reply to a request with every field, None where unknown."""
        return {name: tree_of(value) for name, value in self.flat().items()}

    @staticmethod
    def of_tree(tree: Mapping[str, Any]) -> Status:
        """Return the status of a reply, or of a snapshot of protocol 3 and older."""
        return Status.of_flat(
            {name: msgspec.convert(tree[name], kind) for name, kind in _types() if name in tree}
        )

    @staticmethod
    def of_flat(flat: Mapping[str, Any]) -> Status:
        """Return the status with these fields; without a test if none is mentioned."""
        engine, test, rig = (
            {
                name: flat[flat_name]
                for name in part.__struct_fields__
                if (flat_name := names.get(name, name)) in flat
            }
            for part, names in _FLAT.items()
        )
        return Status(
            EngineStatus(**engine),
            TestStatus(**test) if any(test.values()) else None,
            RigStatus(**rig),
            flat.get("alarms", ()),
            flat.get("recovery", Recovery()),
        )


_FLAT: dict[type[msgspec.Struct], dict[str, str]] = {
    EngineStatus: {"pid": "engine_pid"},
    TestStatus: {"title": "test"},
    RigStatus: {"name": "rig"},
}
"""Parts of a status whose fields are merged in a reply, with the names renamed there."""


@cache
def _types() -> tuple[tuple[str, Any], ...]:
    own = [(field.name, field.type) for field in msgspec.structs.fields(Status)[-2:]]
    return (
        *own,
        *(
            (names.get(field.name, field.name), field.type)
            for part, names in _FLAT.items()
            for field in msgspec.structs.fields(part)
        ),
    )


class Cycle(msgspec.Struct, frozen=True):
    """One whole revolution for drawing: float32 arrays as bytes, calibrated.

    curves: by channel, in the order of ``ChannelTable.curves``, each in its own unit and frame.
    """

    revolution: int
    angle_deg: bytes
    curves: dict[str, bytes]


class WornProfile(msgspec.Struct, frozen=True):
    """A worn profile, measured and by the model; see ``columns.PROFILE_CURVES``.

    values: ``profile_columns`` in order, float64. measured, predicted, driven, uncertainty:
    float32, mm, at PROFILE_ANGLES_DEG; NaN where the pin never was. keep: due for storage
    in the file.
    """

    revolution: int
    values: bytes
    measured: bytes
    predicted: bytes
    driven: bytes
    uncertainty: bytes
    keep: bool = True


class Prediction(msgspec.Struct, frozen=True):
    """The twin's prediction for one revolution.

    values: the columns of ``prediction_columns`` in order, float64.
    force_1, force_2, force (N), nominal_pressure (MPa), sliding_speed (m/s), pressure_velocity
    (MPa m/s), agreement_uncertainty (N): float32 on PREDICTION_POINTS crank angles, empty where
    unknown.
    profile: a new worn profile, None for most revolutions. checkpoint: state to continue
    from here, empty if unchanged.
    """

    revolution: int
    values: bytes
    force_1: bytes
    force_2: bytes
    force: bytes
    profile: WornProfile | None = None
    checkpoint: bytes = b""
    nominal_pressure: bytes = b""
    sliding_speed: bytes = b""
    pressure_velocity: bytes = b""
    agreement_uncertainty: bytes = b""


class RevolutionMeasured(msgspec.Struct, frozen=True):
    """Request a prediction: the measured history of one revolution (float64 as bytes).

    temperature_C: of the room, NaN if not measured.
    """

    revolution: int
    time_s: bytes
    angle_rad: bytes
    force_1: bytes
    force_2: bytes
    probe_1: bytes
    probe_2: bytes
    temperature_C: float = float("nan")


class Snapshot(msgspec.Struct, frozen=True):
    """New data for a viewer since the last snapshot, at most 30 times a second.

    columns: name -> unit of the values of a row, in order. rows: float64 (n, columns) as bytes;
    rows are dropped oldest first
    when a viewer lags, and ``first_row`` shows the gap.
    predictions: float64 (m, columns) of ``prediction_columns`` as bytes.
    profile: the newest worn profile, when there is one since the last snapshot.
    recorded: of a replay, the number of its rows in the status's file; they are not sent.
    """

    status: Status
    first_row: int
    rows: bytes
    predictions: bytes
    cycle: Cycle | None = None
    prediction: Prediction | None = None
    profile: WornProfile | None = None
    columns: dict[str, str] = msgspec.field(default_factory=lambda: BASE.units)
    recorded: int | None = None


class Event(msgspec.Struct, frozen=True):
    """One line of the append-only log: person, action, values before and after.

    text: for people. key: subject, for an alarm or a limit its key. level: ``information``
    or a ``Severity``. data: for programs, see ``rigapp.schema.loglines``.
    """

    time: float
    revolution: int
    kind: str
    source: str
    text: str
    before: str = ""
    after: str = ""
    key: str = ""
    level: str = "information"
    data: dict[str, Any] = {}


class Request(msgspec.Struct, frozen=True):
    """A request to the engine; ``verb`` is one of the service's commands.

    client: identity of the requesting viewer, the same for all its requests.
    """

    verb: str
    arguments: dict[str, Any] = {}
    operator: str = ""
    version: int = PROTOCOL_VERSION
    identifier: int = 0
    client: str = ""


class Reply(msgspec.Struct, frozen=True):
    """Reply to a request: ok with a result, or not ok with one plain sentence."""

    ok: bool
    sentence: str = ""
    result: Any = None
    identifier: int = 0


def as_array(data: bytes, dtype: str = "<f4") -> NDArray[Any]:
    """Return the array in the bytes of a message (read-only, 1-D)."""
    return np.frombuffer(data, dtype=dtype)


def last_set_speed(speed: NDArray[Any], quality: NDArray[Any]) -> float:
    """Return the speed of the last revolution outside of ramps, else of the last one, rpm.

    speed, quality: the columns (n,), signed and as ``Flag``, NaN where unknown. NaN without rows.
    """
    flags = np.nan_to_num(quality).astype(np.int64)
    steady = np.flatnonzero(flags & NOT_STEADY == 0)
    row = steady[-1:] if steady.size else slice(-1, None)
    return abs(float(speed[row][0])) if len(speed) else float("nan")
