"""The layout of a test file: its streams, their columns and sizes, as plain records.

A *stream* is a set of 1-D datasets that grow together, row by row, up to a committed counter. All
of them exist at their full size before the first sample; ``planned`` rows have reserved disk space,
and ``capacity`` rows are declared, so that an extension of the test changes no structure.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np

from rigapp.schema.channels import BASE, Channel, ChannelTable, Column
from rigapp.schema.columns import (
    CURVES,
    PREDICTED_CURVES,
    PREDICTION_POINTS,
    PROFILE_ANGLES_DEG,
    PROFILE_CURVES,
    PROFILES_PER_DECADE,
    prediction_columns,
    profile_columns,
)

SCHEMA = 1
"""Version of the file's structure; a reader refuses newer ones."""

SCHEMA_ATTRIBUTE = "rigapp_schema"

FILE_NAME_ATTRIBUTE = "file_name"

FORM_ATTRIBUTE = "rigapp_form"
IN_PLACE = "in place"
COMPRESSED = "compressed"

ENTRY = "/entry"
STATE = "/entry/state"
CONFIGURATION = "/entry/configuration"
CALIBRATION = "/entry/calibration"
PLAN = "/entry/configuration/plan"
DETECTORS = "/entry/instrument"
FORCE_UNCERTAINTY = "/entry/calibration/force_uncertainty"
START_TIME = "/entry/start_time"
END_TIME = "/entry/end_time"

ROW_MULTIPLE = 512  # rows of 8 bytes fill whole pages
SPARE_REVOLUTIONS = 1000  # so that a short test can be extended as well
SAMPLE_RESERVE = 1.1  # revolutions differ; unused space is given back at the end

CONFIGURATION_DIGEST = "configuration_sha256"
"""Name in ``/entry/state`` of the digest of the data fixed before the first row."""

STATE_FIELDS: dict[str, tuple[str, str]] = {
    "status": ("S16", "running, complete, stopped or fault"),
    "reason_code": ("S16", "why the test ended, as a code"),
    "reason": ("S512", "why the test ended, as a sentence"),
    "writer": ("S96", "process that writes or wrote the file"),
    "planned_revolutions": ("<i8", "revolutions the test shall have"),
    "first_revolution": ("<i8", "number of the first revolution"),
    "gaps": ("<i8", "interruptions of the test, each with an event that tells where"),
    "resumed": ("<i8", "times the test was resumed"),
    "cycles_refused": ("<i8", "whole cycles not kept because their reserved room was full"),
    "events_refused": ("<i8", "events not kept because their reserved room was full"),
}
"""Fixed-size scalars of ``/entry/state`` that the writer overwrites in place: dtype, sentence."""

TIME_DTYPE = "S32"


@dataclass(frozen=True, slots=True)
class FileColumn(Column):
    """One dataset of a stream; ``shape`` is that of one row."""

    shape: tuple[int, ...] = ()

    @property
    def row_bytes(self) -> int:
        """Return the bytes of one row."""
        return int(np.dtype(self.dtype).itemsize) * math.prod(self.shape)


@dataclass(frozen=True, slots=True)
class FileStream:
    """Datasets that grow together; ``counter`` is empty where another stream has the counter.

    checksum: the CRC-32C of each row; None where another stream or a digest protects the rows, and
    in older files.
    """

    name: str
    group: str
    dimension: str
    counter: str
    fields: tuple[FileColumn, ...]
    planned: int
    capacity: int
    checksum: FileColumn | None = None

    @property
    def stored(self) -> tuple[FileColumn, ...]:
        """Return all datasets of the stream, its checksum last."""
        return self.fields if self.checksum is None else (*self.fields, self.checksum)

    def path(self, name: str) -> str:
        """Return the path of one of the stream's datasets."""
        return f"{self.group}/{name}"

    @property
    def row_bytes(self) -> int:
        """Return the bytes of one row over all fields."""
        return sum(field.row_bytes for field in self.stored)


@dataclass(frozen=True, slots=True)
class FilePlan:
    """The size and the optional parts of a test file.

    revolutions: rows of statistics. cycles: complete cycles stored. samples_per_cycle: samples
    expected in a cycle at the test's speed. events: rows of the log. prediction: whether a twin
    runs. channels: the measured channels; older files have those of every rig.
    cycle_reason: whether each cycle has the reason for its storage and its quality. event_details:
    whether events have key, level and data. unfinished_samples: samples reserved for revolutions
    cut off by the end of a test; 0 stores none. profiles: worn profiles stored, and with them the
    twin's checkpoints; 0 stores neither. checksums: whether rows and cycles have a CRC-32C each,
    and the settings a digest. waiting_cycles: newest complete cycles, held until it is decided
    whether they are stored.
    """

    revolutions: int
    cycles: int
    samples_per_cycle: int
    events: int = 8192
    prediction: bool = True
    first_revolution: int = 1
    channels: tuple[Channel, ...] = BASE.channels
    revolution_columns: tuple[Column, ...] = BASE.revolution_columns
    cycle_columns: tuple[Column, ...] = BASE.cycle_columns
    prediction_columns: tuple[Column, ...] = field(default_factory=prediction_columns)
    prediction_points: int = PREDICTION_POINTS
    predicted_curves: tuple[str, ...] = PREDICTED_CURVES
    cycle_reason: bool = False
    event_details: bool = False
    unfinished_samples: int = 0
    profiles: int = 0
    checksums: bool = False
    waiting_cycles: int = 0

    @property
    def table(self) -> ChannelTable:
        """Return the channels of the file."""
        return ChannelTable(self.channels)


_EVENT_FIELDS = (
    FileColumn("time", "<f8", "s", "UTC seconds since 1970-01-01"),
    FileColumn("revolution", "<i8", "1", "revolution at which it happened"),
    FileColumn("kind", "S32", "", "what happened, as a code"),
    FileColumn("source", "S32", "", "who or what caused it"),
    FileColumn("text", "S256", "", "what happened, as a sentence"),
    FileColumn("before", "S128", "", "value before"),
    FileColumn("after", "S128", "", "value after"),
)
_EVENT_DETAILS = (
    FileColumn("key", "S128", "", "what it is about, of an alarm or a limit its key"),
    FileColumn("level", "S16", "", "how bad it is: information, warning or critical"),
    FileColumn(
        "data", "S256", "", "what programs read of it, as JSON; empty when there is nothing"
    ),
)
_EVENT_CHAIN = (
    FileColumn("continued", "<i4", "1", "1: the texts go on in the next row"),
    FileColumn(
        "digest", "S64", "", "SHA-256 over the digest before and this row, see file-format.md"
    ),
)


def event_fields(details: bool) -> tuple[FileColumn, ...]:
    """Return the columns of the log, with or without key, level and data."""
    return (*_EVENT_FIELDS, *(_EVENT_DETAILS if details else ()), *_EVENT_CHAIN)


INDEX_FIELDS = (
    FileColumn("revolution", "<i8", "1", "number of the revolution"),
    FileColumn("first", "<i8", "1", "index of the cycle's first sample"),
    FileColumn("count", "<i8", "1", "samples of the cycle"),
)
QUALITY_FIELD = FileColumn("quality", "<i4", "1", "quality of the revolution, flags as in its row")
WHY_FIELD = FileColumn(
    "why", "S16", "", "why it is kept: scheduled, last, before, trigger or after"
)

UNFINISHED_ROWS = 64
"""Maximum number of unfinished revolutions in a file: one for each stop of a test."""


def streams_of(plan: FilePlan) -> dict[str, FileStream]:
    """Return the streams of a file by name, in their order in the file."""
    rows = max(1, plan.revolutions)
    all_rows = _rounded(rows + max(rows, SPARE_REVOLUTIONS))
    cycles = max(1, plan.cycles)
    all_cycles = _rounded(math.ceil(cycles * all_rows / rows) + 16 if plan.cycles else 1)
    samples = (
        math.ceil((cycles + 2) * plan.samples_per_cycle * SAMPLE_RESERVE) if plan.cycles else 1
    )
    all_samples = _rounded(math.ceil(samples * all_rows / rows) if plan.cycles else 1)
    twin_rows, all_twin_rows = (rows, all_rows) if plan.prediction else (1, ROW_MULTIPLE)
    curves, all_curves = (cycles, all_cycles) if plan.prediction else (1, ROW_MULTIPLE)
    index: tuple[FileColumn, ...] = INDEX_FIELDS
    if plan.cycle_reason:
        index = (*index, QUALITY_FIELD, WHY_FIELD)
    curve_fields = (
        FileColumn(
            "curve_revolution", "<i8", "1", "number of the revolution of the predicted curve"
        ),
        *(
            FileColumn(
                f"curve_{curve.name}",
                curve.dtype,
                curve.unit,
                curve.description,
                (plan.prediction_points,),
            )
            for curve in CURVES
            if curve.name in plan.predicted_curves
        ),
    )
    result: tuple[FileStream, ...] = (
        FileStream(
            "revolutions", "/entry/revolutions", "revolution", "committed",
            _fields(plan.revolution_columns), rows, all_rows,
        ),
        FileStream("cycles", "/entry/cycles", "revolution", "committed", index, cycles, all_cycles),
        FileStream(
            "samples", "/entry/cycles", "sample", "", _fields(plan.cycle_columns),
            samples, all_samples,
        ),
        FileStream(
            "prediction", "/entry/prediction", "revolution", "committed",
            _fields(plan.prediction_columns), twin_rows, all_twin_rows,
        ),
        FileStream(
            "curves", "/entry/prediction", "curve_revolution", "committed_curves", curve_fields,
            curves, all_curves,
        ),
        FileStream(
            "events", "/entry/events", "event", "committed", event_fields(plan.event_details),
            plan.events, _rounded(plan.events),
        ),
    )  # fmt: skip
    if plan.unfinished_samples:
        result = (*result, *_unfinished_streams(plan))
    if plan.profiles:
        result = (*result, *_worn_streams(plan))
    if plan.waiting_cycles:
        result = (*result, _waiting_stream(plan))
    if plan.checksums:
        result = tuple(replace(stream, checksum=CHECKSUMS.get(stream.name)) for stream in result)
        # A truncated copy then loses samples and curves before any row.
        result = tuple(sorted(result, key=lambda s: _LAST.index(s.name) if s.name in _LAST else -1))
    return {stream.name: stream for stream in result}


_LAST = ("curves", "waiting", "unfinished_samples", "samples")
"""Streams at the end of a file, the longest last."""


AHEAD = {"revolutions": 4096, "prediction": 4096, "curves": 16, "profiles": 16}
"""Stream -> rows by which the visible length runs ahead of the data; 0 for the others."""


def _checksum(name: str, of: str) -> FileColumn:
    return FileColumn(name, "<u4", "1", f"CRC-32C of {of}, see file-format.md")


CHECKSUMS = {
    "revolutions": _checksum("checksum", "the row"),
    "prediction": _checksum("checksum", "the row"),
    "cycles": _checksum("checksum", "the cycle and its row"),
    "waiting": _checksum("checksum", "the cycle and its row"),
    "unfinished": _checksum("checksum", "the revolution and its row"),
    "curves": _checksum("curve_checksum", "the curves"),
    "profiles": _checksum("profile_checksum", "the profile"),
}
"""Stream -> its column of checksums. The log has digests, checkpoints have their own CRC."""


def _unfinished_streams(plan: FilePlan) -> tuple[FileStream, FileStream]:
    group, samples = "/entry/unfinished", plan.unfinished_samples
    return (
        FileStream(
            "unfinished", group, "revolution", "committed", (*INDEX_FIELDS, QUALITY_FIELD),
            UNFINISHED_ROWS, _rounded(UNFINISHED_ROWS),
        ),
        FileStream(
            "unfinished_samples", group, "sample", "", _fields(plan.cycle_columns),
            samples, _rounded(UNFINISHED_ROWS * samples),
        ),
    )  # fmt: skip


WAITING = "/entry/waiting"
WAITING_FIELDS = (INDEX_FIELDS[0], INDEX_FIELDS[2], QUALITY_FIELD, WHY_FIELD)


def _waiting_stream(plan: FilePlan) -> FileStream:
    samples = math.ceil(plan.samples_per_cycle * SAMPLE_RESERVE)
    fields = (
        *WAITING_FIELDS,
        *(replace(field, shape=(samples,)) for field in _fields(plan.cycle_columns)),
    )
    slots = plan.waiting_cycles
    return FileStream("waiting", WAITING, "slot", "", fields, slots, slots)


CHECKPOINT_SLOTS = 2
CHECKPOINT_BYTES = 1 << 15


def profile_rows(revolutions: int) -> int:
    """Return the number of worn profiles that the twin stores for a number of revolutions."""
    return math.ceil(PROFILES_PER_DECADE * math.log10(max(revolutions, 1))) + 3


PROFILE_ANGLE = "angle from the initial contact point, follower frame"
PROFILE_SENTENCES = {
    "measured": "measured depth, NaN where the pin never came",
    "predicted": "predicted depth of wear",
    "driven": "depth of wear by the model from measured forces",
    "uncertainty": "expanded uncertainty (k = 2) of the measured depth",
}


def _worn_streams(plan: FilePlan) -> tuple[FileStream, FileStream]:
    group, size = "/entry/prediction", (len(PROFILE_ANGLES_DEG),)
    profiles = (
        *_fields(
            Column(f"profile_{column.name}", column.dtype, column.unit, column.description)
            for column in profile_columns()
        ),
        *(
            FileColumn(f"profile_{curve}", "<f4", "mm", PROFILE_SENTENCES[curve], size)
            for curve in PROFILE_CURVES
        ),
    )
    checkpoints = (
        FileColumn(
            "checkpoint_revolution", "<i8", "1", "newest revolution in the twin's checkpoint"
        ),
        FileColumn("checkpoint_length", "<i8", "1", "bytes of the checkpoint, 0: none"),
        FileColumn("checkpoint_crc", "<i8", "1", "CRC-32 of these bytes"),
        FileColumn("checkpoint_state", "|u1", "1", "the twin's bushings", (CHECKPOINT_BYTES,)),
    )
    room = profile_rows(2 * plan.revolutions + SPARE_REVOLUTIONS)
    return (
        FileStream(
            "profiles", group, "profile_revolution", "committed_profiles", profiles,
            plan.profiles, max(room, plan.profiles),
        ),
        FileStream(
            "checkpoints", group, "checkpoint", "", checkpoints,
            CHECKPOINT_SLOTS, CHECKPOINT_SLOTS,
        ),
    )  # fmt: skip


def reserved_bytes(streams: Iterable[FileStream]) -> int:
    """Return the disk space of the planned rows of the streams, bytes."""
    return sum(stream.planned * stream.row_bytes for stream in streams)


def declared_bytes(streams: Iterable[FileStream]) -> int:
    """Return the length of the file that results from the streams, bytes."""
    return sum(stream.capacity * stream.row_bytes for stream in streams)


def planned_rows(plan: FilePlan, revolutions: int) -> dict[str, int]:
    """Return the rows of each stream for ``revolutions`` instead of the planned number."""
    streams = streams_of(plan)
    share = revolutions / max(1, plan.revolutions)
    return {
        name: min(stream.capacity, math.ceil(stream.planned * share))
        for name, stream in streams.items()
        if name not in ("events", "unfinished", "unfinished_samples", "checkpoints", "waiting")
    }


def _fields(columns: Iterable[Column]) -> tuple[FileColumn, ...]:
    return tuple(
        FileColumn(column.name, column.dtype, column.unit, column.description) for column in columns
    )


def _rounded(rows: int) -> int:
    return math.ceil(rows / ROW_MULTIPLE) * ROW_MULTIPLE
