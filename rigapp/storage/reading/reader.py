"""Read a test file, running, interrupted or finished, in place or compressed."""

from __future__ import annotations

import contextlib
import math
import os
import re
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import h5py
import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.columns import PROFILE_ANGLES_DEG
from rigapp.schema.messages import Event
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.reading.oldlog import texts_of, translated
from rigapp.storage.reading.resample import Method, resample_channels
from rigapp.storage.structure.digest import SEAL, settings_digest
from rigapp.storage.structure.events import events_of, first_broken_link
from rigapp.storage.structure.hdf import is_bare, open_for_reading, telling_damage
from rigapp.storage.structure.layout import (
    CALIBRATION,
    CHECKPOINT_BYTES,
    CHECKPOINT_SLOTS,
    CHECKSUMS,
    COMPRESSED,
    CONFIGURATION,
    CONFIGURATION_DIGEST,
    END_TIME,
    ENTRY,
    FORM_ATTRIBUTE,
    PLAN,
    SCHEMA,
    SCHEMA_ATTRIBUTE,
    START_TIME,
    STATE,
    STATE_FIELDS,
    FileColumn,
    FilePlan,
    FileStream,
    streams_of,
)
from rigapp.texts import joined, say, sentence_of_error

Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True, slots=True)
class StoredCycle:
    """Carry one cycle: its revolution and one array of samples a column.

    why: scheduled, last, before, trigger or after; empty for an unfinished revolution. quality:
    flags as in the revolution's row, 0 where the file does not tell. table: the channels of the
    file.
    """

    revolution: int
    columns: Columns
    why: str = "scheduled"
    quality: int = 0
    table: ChannelTable = BASE

    def resampled(self, points: int = 360, method: Method = "linear") -> StoredCycle:
        """Return this cycle on a uniform grid of crank angles, without time and raw signals.

        method: linear or band-limited, see ``rigapp.storage.reading.resample``. Raises ValueError.
        """
        even = resample_channels(self.columns, self.table, points, method)
        return replace(self, columns={**even})


@dataclass(frozen=True, slots=True, eq=False)
class StoredVariable:
    """Describe a column in a file: its stream, the shape of its safe rows, what it says of itself.

    attributes: units, long_name and whatever else CF and NeXus want, without those of HDF5 itself.
    """

    name: str
    stream: str
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    attributes: dict[str, Any]


def open_test(path: str | os.PathLike[str]) -> TestReader:
    """Open a test file for reading; a running test is not disturbed.

    Raises UnusableInput with one sentence for what is missing, not HDF5, not a test, damaged or
    from a newer version.
    """
    target = Path(path)
    return TestReader(target, _opened(target))


class TestReader:
    """Answer questions about one test file; only committed rows count as data."""

    __test__ = False

    def __init__(self, path: Path, file: h5py.File) -> None:
        self.path = path
        self._file = file
        self._known: dict[str, int] = {}
        with telling_damage(path, say("its plan")):
            plan = msgspec.json.decode(self._text(PLAN), type=FilePlan)
            # That word of the plan may be what is damaged: what is there decides.
            self.plan = replace(plan, checksums=plan.checksums or _proves(file))
            self._streams = streams_of(self.plan)
        strange = next(filter(None, map(strange_name, _names(self._streams))), "")
        if strange:
            raise UnusableInput(
                "{}: {}; rigapp writes no such file: do not use it, and ask who sent it",
                path,
                strange,
            )

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> TestReader:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def compressed(self) -> bool:
        """Tell whether the file is the trimmed, compressed copy of a finished test."""
        with telling_damage(self.path, FORM_ATTRIBUTE):
            return bool(self._file.attrs[FORM_ATTRIBUTE] == COMPRESSED)

    def committed(self, stream: str = "revolutions") -> int:
        """Return the safe rows of a stream.

        stream: as in ``streams_of``; of ``samples`` and ``unfinished_samples`` those of their
        cycles.
        """
        found = self._streams[stream]
        if stream == "samples":
            return self.first_free_sample(self.committed("cycles"))
        if stream == "checkpoints":
            return CHECKPOINT_SLOTS
        if stream == "waiting":
            return 0
        if stream == "unfinished_samples":
            return self.first_free_sample(self.committed("unfinished"), found.group)
        if stream in self._known:
            return self._known[stream]
        rows = int(self._read(found.path(found.counter)))
        with telling_damage(self.path, found.path(found.counter)):
            if rows < 0:
                raise ValueError(say("rows {} to {} are wanted and there are fewer", 0, rows))
        with contextlib.suppress(UnusableInput):  # that word may be what is damaged
            if self.stored_status() != "running":  # no more come
                self._known[stream] = rows
        return rows

    def stored_status(self) -> str:
        """Return the word in the file: running, complete, stopped or fault."""
        return self._state_text("status")

    def summary(self) -> dict[str, Any]:
        """Return what ``rigapp info`` shows; its keys are a promise to users."""
        revolutions = self.committed()
        first, last = self._first_and_last(revolutions)
        status, reason = self._status(revolutions)
        return {
            "status": status,
            "reason": reason,
            "revolutions": revolutions,
            "first_revolution": first,
            "last_revolution": last,
            "gaps": self.state("gaps"),
            "cycles_saved": self.committed("cycles"),
            "started": self._text(START_TIME),
            "schema": int(self._file.attrs[SCHEMA_ATTRIBUTE]),
        }

    def _first_and_last(self, rows: int) -> tuple[int | None, int | None]:
        """Return the numbers of the first and the last of so many revolutions."""
        if not rows:
            return None, None
        first, last = (int(self.column("revolution", row, row + 1)[0]) for row in (0, rows - 1))
        with telling_damage(self.path, say("the number of its safe revolutions")):
            if last - first < rows - 1:
                raise ValueError(say("{} revolutions cannot end at number {}", rows, last))
        return first, last

    def state(self, name: str) -> int:
        """Return one number of ``/entry/state``, for example ``planned_revolutions``."""
        return int(self._read(f"{STATE}/{name}"))

    def has_all_revolutions(self) -> bool:
        """Tell whether the last revolution of the plan is committed."""
        rows = self.committed()
        planned = self.state("planned_revolutions")
        return rows > 0 and int(self.column("revolution", rows - 1)[0]) >= planned

    def reason_code(self) -> str:
        """Return why the test ended as a code, empty while it has not."""
        return self._state_text("reason_code")

    def metadata(self) -> dict[str, Any]:
        """Return title, people, specimen, times and numbers that head a report."""
        names = {
            "title": "/entry/title",
            "operator": "/entry/user/name",
            "specimen": "/entry/sample/name",
            "bushing": "/entry/sample/description",
            "notes": "/entry/experiment_description",
            "rig": "/entry/instrument/name",
            "identifier": "/entry/entry_identifier_uuid",
            "started": START_TIME,
            "ended": END_TIME,
        }
        found: dict[str, Any] = {
            name: self._text(path) if self._holds(path) else "" for name, path in names.items()
        }
        found["simulated"] = bool(self._read("/entry/simulated"))
        found["planned_revolutions"] = self.state("planned_revolutions")
        found["reason_code"] = self.reason_code()
        return found

    def rows(self, first: int = 0) -> Columns:
        """Return the committed rows from row ``first`` on, one array a column."""
        return self._table("revolutions", first)

    def column(
        self, name: str, first: int = 0, stop: int | None = None, stream: str = "revolutions"
    ) -> NDArray[Any]:
        """Return committed rows ``first`` .. ``stop`` of one column of a stream."""
        found, known = self._streams[stream], self.column_units(stream)
        if name not in known:
            raise UnusableInput(
                "{}: there is no column {} in {}; there are {}",
                self.path,
                repr(name),
                found.group,
                joined(", ", known),
            )
        end = self.committed(stream) if stop is None else min(stop, self.committed(stream))
        return self._rows(found.path(name), first, end)

    def column_units(self, stream: str = "revolutions") -> dict[str, str]:
        """Return the units of a stream's columns by name, in their order."""
        return {one.name: one.unit for one in self._streams[stream].fields}

    def cycle_revolutions(self) -> NDArray[np.int64]:
        """Return the numbers of the revolutions whose whole cycle is saved."""
        return self.column("revolution", stream="cycles")

    def cycle_reasons(self) -> list[str]:
        """Return why each saved cycle is kept: scheduled, last, before, trigger or after."""
        if not self.plan.cycle_reason:
            return ["scheduled"] * self.committed("cycles")
        return np.char.decode(self.column("why", stream="cycles"), "ascii", "replace").tolist()

    def cycle_qualities(self) -> NDArray[np.int64]:
        """Return the quality flags of each saved cycle's revolution, 0 where not recorded."""
        if not self.plan.cycle_reason:
            return np.zeros(self.committed("cycles"), dtype=np.int64)
        return self.column("quality", stream="cycles").astype(np.int64)

    def first_free_sample(self, cycles: int, group: str = "/entry/cycles") -> int:
        """Return the number of samples in the first ``cycles`` saved cycles."""
        if cycles == 0:
            return 0
        return sum(
            int(self._rows(f"{group}/{one}", cycles - 1, cycles)[0]) for one in ("first", "count")
        )

    def cycle(self, index: int) -> StoredCycle:
        """Return the saved cycle ``index``, negative from the end; raises IndexError."""
        number = self.committed("cycles")
        place = index + number if index < 0 else index
        if not 0 <= place < number:
            raise IndexError(
                say("{}: there is no saved cycle {}, there are {}", self.path, index, number)
            )
        return next(self._ragged("cycles", place, place + 1))

    def cycles(self) -> Iterator[StoredCycle]:
        """Yield the saved cycles in order."""
        yield from self._ragged("cycles", 0, self.committed("cycles"))

    def unfinished(self) -> list[StoredCycle]:
        """Return the revolutions that an end of the test cut off, in order; each is a part."""
        if "unfinished" not in self._streams:
            return []
        return list(self._ragged("unfinished", 0, self.committed("unfinished")))

    def _ragged(self, stream: str, start: int, stop: int) -> Iterator[StoredCycle]:
        index = self._streams[stream]
        samples = self._streams["samples" if stream == "cycles" else "unfinished_samples"]
        known = {
            one.name: self._rows(index.path(one.name), start, stop).tolist() for one in index.fields
        }
        whys = known.get("why", [b"scheduled" if stream == "cycles" else b""] * (stop - start))
        qualities = known.get("quality", [0] * (stop - start))
        table = self.plan.table
        for i, (first, count) in enumerate(zip(known["first"], known["count"], strict=True)):
            yield StoredCycle(
                known["revolution"][i],
                {
                    one.name: self._rows(samples.path(one.name), first, first + count)
                    for one in samples.fields
                },
                whys[i].decode(errors="replace"),
                qualities[i],
                table,
            )

    def predictions(self, first: int = 0) -> Columns:
        """Return the committed rows of the twin's stream, one array a column."""
        return self._table("prediction", first)

    def curve_revolutions(self) -> NDArray[np.int64]:
        """Return the numbers of the revolutions whose predicted curves are saved."""
        return self.column("curve_revolution", stream="curves")

    def predicted_curve(self, revolution: int) -> Columns | None:
        """Return the predicted curves of a revolution with their ``angle``, None when not saved."""
        places = np.flatnonzero(self.curve_revolutions() == revolution)
        if places.size == 0:
            return None
        row = int(places[-1])
        curves = {
            name: self._rows(f"/entry/prediction/curve_{name}", row, row + 1)[0]
            for name in self.plan.predicted_curves
        }
        return {"angle": self.angles(), **curves}

    def profiles(self) -> Columns:
        """Return the committed worn profiles: ``angle`` (deg) and one array a column.

        Curves (profiles, angles) in mm, NaN where nothing is known; empty for files without.
        """
        angle = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)
        fields = self._profile_fields()
        table = {one.name: np.empty((0, *one.shape)) for one in fields.values()}
        if "profiles" in self._streams:
            table = self._table("profiles", 0)
        return {"angle": angle, **{name: table[one.name] for name, one in fields.items()}}

    def _profile_fields(self) -> dict[str, FileColumn]:
        """Return what a worn profile has, of files without them too, by name."""
        stream = streams_of(replace(self.plan, profiles=1))["profiles"]
        return {one.name.removeprefix("profile_"): one for one in stream.fields}

    def checkpoint(self) -> bytes:
        """Return the newest checkpoint of the twin at or before the last safe row, else nothing."""
        if "checkpoints" not in self._streams:
            return b""
        revolutions = self.committed()
        last = self._first_and_last(revolutions)[1] or 0
        slots = self._table("checkpoints", 0)
        best, found = -1, b""
        for slot in range(CHECKPOINT_SLOTS):
            number, length = (
                int(slots[f"checkpoint_{one}"][slot]) for one in ("revolution", "length")
            )
            if not (0 < length <= CHECKPOINT_BYTES and best < number <= last):
                continue
            state = slots["checkpoint_state"][slot, :length].tobytes()
            if zlib.crc32(state) == int(slots["checkpoint_crc"][slot]):
                best, found = number, state
        return found

    def events(self) -> list[Event]:
        """Return the committed events in order, those of older files as newer ones have them."""
        found = events_of(self._table("events", 0))
        return found if self.plan.event_details else translated(found)

    def first_altered_event(self) -> int | None:
        """Return the first row of the log whose digest does not hold, None when all do."""
        return first_broken_link(
            self._table("events", 0), self._text("/entry/entry_identifier_uuid")
        )

    def last_digest(self) -> bytes:
        """Return the digest of the log's last row, empty when there is none."""
        number = self.committed("events")
        return bytes(self._rows("/entry/events/digest", number - 1, number)[0]) if number else b""

    def texts(self) -> Iterator[tuple[str, str]]:
        """Yield every text of the file with its path, the lines of the log left out."""
        with telling_damage(self.path, say("its texts")):
            yield from texts_of(self._file)

    def configuration(self) -> dict[str, Any]:
        """Return the configuration: texts ``rig`` and ``test``, ``parameters``, ``versions``."""
        return self._below(CONFIGURATION)

    def calibration(self) -> dict[str, Any]:
        """Return the calibration records that the test was measured with, nested by name."""
        return self._below(CALIBRATION)

    def used_bytes(self, size: int) -> int:
        """Return how many of the bytes of the file, ``size``, hold data.

        A file that is written in place has room for everything that was planned.
        """
        if self.compressed:
            return size
        each = {
            name: sum(np.dtype(one.dtype).itemsize * math.prod(one.shape) for one in found.fields)
            for name, found in self._streams.items()
        }
        return min(size, sum(self.committed(name) * octets for name, octets in each.items()))

    def variables(self, stream: str) -> tuple[StoredVariable, ...]:
        """Return what a stream holds as it stands in the file, shapes cut to the safe rows.

        stream: as in ``streams_of``; of ``prediction`` without its curves and profiles.
        """
        found, rows = self._streams[stream], self.committed(stream)
        with telling_damage(self.path, found.group):
            return tuple(
                StoredVariable(
                    one.name,
                    stream,
                    (rows, *one.shape),
                    np.dtype(one.dtype),
                    _attributes(self._file[found.path(one.name)]),
                )
                for one in found.fields
            )

    def attributes(self, stream: str) -> dict[str, dict[str, Any]]:
        """Return what each column says of itself, also those that the file is too old to have."""
        whole = streams_of(replace(self.plan, event_details=True, profiles=1))[stream]
        found = {
            one.name: {"units": one.unit, "long_name": one.description} for one in whole.fields
        }
        if stream in self._streams:
            found |= {one.name: one.attributes for one in self.variables(stream)}
        return found

    def fields(self, stream: str) -> tuple[FileColumn, ...]:
        """Return the columns of a stream, without its checksum."""
        return self._streams[stream].fields

    def has_checksum(self, stream: str) -> bool:
        """Tell whether each row of a stream has a checksum; files of before have none."""
        return self._streams[stream].checksum is not None

    def raw_rows(
        self, stream: str, first: int, stop: int
    ) -> tuple[list[NDArray[Any]], NDArray[Any]]:
        """Return rows of a stream as they are stored, committed or not: columns, and checksums."""
        found = self._streams[stream]
        columns = [self._rows(found.path(one.name), first, stop) for one in found.fields]
        if found.checksum is None:
            return columns, np.empty(0, np.uint32)
        return columns, self._rows(found.path(found.checksum.name), first, stop)

    def row_bytes(self, stream: str) -> int:
        """Return the bytes of a row, of a cycle with the samples that it has as a rule."""
        found = self._streams[stream]
        if stream in ("cycles", "unfinished"):
            return (
                found.row_bytes + self.plan.samples_per_cycle * self._streams["samples"].row_bytes
            )
        return found.row_bytes

    def declared(self, stream: str) -> int:
        """Return the rows that a stream can have in this file."""
        found = self._streams[stream]
        with telling_damage(self.path, found.group):
            first = found.fields[0]
            dataset = self._file[found.path(first.name)]
            return len(dataset) if self.compressed else _room_of(dataset) // first.row_bytes

    def stored_rows(self, path: str, first: int, stop: int) -> NDArray[Any]:
        """Return rows of a dataset as they are stored, committed or not."""
        return self._rows(path, first, stop)

    def settings_confirmed(self) -> bool:
        """Tell whether all that was fixed before the first row is as it was then."""
        return self.settings_digest() == self._state_text(CONFIGURATION_DIGEST)

    def settings_digest(self) -> str:
        """Return the digest, in hexadecimal, of all that is fixed before the first row."""
        with telling_damage(self.path, CONFIGURATION):
            return settings_digest(self._file, self.plan).decode()

    def ending(self) -> list[str]:
        """Return the texts of how the test began, went and ended, as they are stored."""
        return [
            *(self._text(f"{STATE}/{name}") for name in STATE_FIELDS),
            self._text(START_TIME),
            self._text(END_TIME),
        ]

    def seal_text(self) -> str:
        """Return the seal in the file, empty where it has none."""
        path = f"{SEAL}/seal"
        return self._text(path) if self._holds(path) else ""

    def has(self, stream: str) -> bool:
        """Tell whether the file keeps a stream; those of before keep fewer."""
        return stream in self._streams

    def angles(self) -> NDArray[np.float64]:
        """Return the crank angles of the predicted curves, deg."""
        return np.asarray(self._read("/entry/prediction/angle"), dtype=np.float64)

    def _table(self, stream: str, first: int) -> Columns:
        found: FileStream = self._streams[stream]
        end = self.committed(stream)
        return {one.name: self._rows(found.path(one.name), first, end) for one in found.fields}

    def _status(self, revolutions: int) -> tuple[str, str]:
        stored = self.stored_status()
        reason = self._state_text("reason")
        if stored == "complete":
            return "complete", reason
        if stored in ("stopped", "fault"):
            return "stopped", reason
        if FILES.is_held(self.path, self.writer()):
            return "running", ""
        whole = self.has_all_revolutions()
        safe = (
            say("all {} revolutions are", revolutions)
            if whole
            else say("{} revolutions are", revolutions)
        )
        following = say("ends the test with them") if whole else say("goes on after them")
        return (
            "interrupted",
            say(
                "the program that wrote the file ended without closing the test (killed,"
                " crashed or power lost); {} safe, resume {}",
                safe,
                following,
            ),
        )

    def writer(self) -> str:
        """Return the process that writes or wrote the file, ``process N on HOST`` while it does."""
        return self._state_text("writer")

    def _holds(self, path: str) -> bool:
        with telling_damage(self.path, path):
            return path in self._file

    def _state_text(self, name: str) -> str:
        return self._text(f"{STATE}/{name}")

    def _text(self, path: str) -> str:
        value = self._read(path)
        with telling_damage(self.path, path):
            return value.decode() if isinstance(value, bytes) else str(value)

    def _rows(self, path: str, first: int, end: int) -> NDArray[Any]:
        """Return rows ``first`` .. ``end`` of a dataset, which has them all.

        Those beyond the length that it shows to others are read at their place in the file: they
        are not committed, or were after this file was opened.
        """
        with telling_damage(self.path, path):
            dataset = self._file[path]
            if end > len(dataset) and dataset.chunks is None:
                return self._placed_rows(dataset, first, end)
            rows = np.asarray(dataset[first:end])
            if len(rows) != max(0, end - first):
                raise ValueError(
                    say("rows {} to {} are wanted and there are {}", first, end, len(rows))
                )
        return rows

    def _placed_rows(self, dataset: h5py.Dataset, first: int, end: int) -> NDArray[Any]:
        shape, dtype = (max(0, end - first), *dataset.shape[1:]), np.dtype(dataset.dtype.str)
        row_bytes = dtype.itemsize * math.prod(shape[1:])
        offset = dataset.id.get_offset()
        if offset is None or end * row_bytes > _room_of(dataset):
            raise ValueError(say("rows {} to {} are wanted and there are fewer", first, end))
        handle = self._file.id.get_vfd_handle()
        data = FILES.read_at(handle, shape[0] * row_bytes, offset + first * row_bytes)
        return np.frombuffer(data, dtype).reshape(shape)

    def _read(self, path: str) -> Any:
        """Return a dataset; raise UnusableInput where the file is damaged."""
        with telling_damage(self.path, path):
            return self._file[path][()]

    def _below(self, group: str) -> dict[str, Any]:
        with telling_damage(self.path, group):
            return _tree(self._file[group])


def _proves(file: h5py.File) -> bool:
    """Tell whether a file has the checksum of anything, whatever it says of itself."""
    groups = ("revolutions", "cycles", "prediction")
    checksums = (f"{ENTRY}/{group}/{CHECKSUMS[group].name}" for group in groups)
    return any(path in file for path in (f"{STATE}/{CONFIGURATION_DIGEST}", *checksums))


def _room_of(dataset: h5py.Dataset) -> int:
    """Return the bytes that a dataset has in the file, whatever the length that it shows."""
    return int(dataset.id.get_storage_size())


_OF_HDF5 = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS")
"""Attributes that make a dataset a dimension, or join it to one."""


def _attributes(dataset: h5py.Dataset) -> dict[str, Any]:
    return {
        name: value.decode() if isinstance(value, bytes) else value
        for name, value in dataset.attrs.items()
        if name not in _OF_HDF5 and not name.startswith("_Netcdf4")
    }


def _tree(group: h5py.Group) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for name, item in group.items():
        if isinstance(item, h5py.Group):
            found[name] = _tree(item)
            continue
        if item is None:
            raise KeyError(name)
        if is_bare(item):
            continue
        value = item[()]
        if h5py.check_string_dtype(item.dtype) is not None:
            texts = np.asarray(value, dtype=object)
            value = texts.item().decode() if texts.ndim == 0 else [one.decode() for one in texts]
        elif isinstance(value, np.ndarray):
            value = value.tolist()
        else:
            value = value.item()
        found[name] = value
    return found


COLUMN_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,99}")
"""Columns head tables, and channels name files: what else they hold would act there."""
LONGEST_UNIT = 40


def strange_name(column: FileColumn) -> str:
    """Return why a column cannot be one that this program wrote, or nothing."""
    if not COLUMN_NAME.fullmatch(column.name):
        return say("{} is no name of a column", repr(column.name[:80]))
    if len(column.unit) > LONGEST_UNIT or not column.unit.isprintable() or '"' in column.unit:
        return say("{} is no unit of a column", repr(column.unit[:80]))
    return ""


def _names(streams: Mapping[str, FileStream]) -> Iterator[FileColumn]:
    for stream in streams.values():
        yield from stream.fields


def _opened(path: Path) -> h5py.File:
    if path.is_dir():
        raise UnusableInput("{}: this is a folder, not a test file", path)
    try:
        if path.stat().st_size == 0:
            raise UnusableInput("{}: the file is empty; a copy of the test must be restored", path)
        file = open_for_reading(path)
    except FileNotFoundError as error:
        raise UnusableInput("{}: there is no such file", path) from error
    except OSError as error:
        raise UnusableInput(_refusal(path, sentence_of_error(error))) from error
    with contextlib.ExitStack() as undo:
        undo.callback(file.close)
        _refuse_foreign(path, file)
        undo.pop_all()
    return file


def _refusal(path: Path, message: str) -> str:
    if "truncated" in message:
        return say("{}: the file is cut short, perhaps an unfinished copy; copy it again", path)
    if "signature not found" in message:
        return say("{}: this is not an HDF5 file; give a file that rigapp run wrote", path)
    if "ermission" in message:
        return say("{}: the file may not be read; ask its owner for permission", path)
    return say("{}: the file cannot be opened as HDF5 ‹{}›", path, message)


def _refuse_foreign(path: Path, file: h5py.File) -> None:
    with telling_damage(path, SCHEMA_ATTRIBUTE):
        schema = file.attrs.get(SCHEMA_ATTRIBUTE)
        schema = None if schema is None else int(schema)
    if schema is None:
        raise UnusableInput(
            "{}: this HDF5 file is not a test; give a file that rigapp run wrote", path
        )
    if schema > SCHEMA:
        raise UnusableInput(
            "{}: the file has schema {} and this version reads up to {}; install a newer rigapp",
            path,
            schema,
            SCHEMA,
        )
