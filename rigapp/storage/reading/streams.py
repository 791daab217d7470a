"""Read the streams of a test file: rows, columns and texts as they are stored."""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self

import h5py
import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.structure.hdf import is_bare, refuse_damage
from rigapp.storage.structure.layout import (
    CHECKPOINT_SLOTS,
    CHECKSUMS,
    COMPRESSED,
    CONFIGURATION_DIGEST,
    ENTRY,
    FORM_ATTRIBUTE,
    PLAN,
    STATE,
    FileColumn,
    FilePlan,
    FileStream,
    streams_of,
)
from rigapp.texts import joined, say

Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True, slots=True, eq=False)
class StoredVariable:
    """A column in a file: its stream, the shape of its committed rows, its attributes.

    attributes: units, long_name and others of CF and NeXus, without those of HDF5 itself.
    """

    name: str
    stream: str
    shape: tuple[int, ...]
    dtype: np.dtype[Any]
    attributes: dict[str, Any]


class StreamReader:
    """Read the streams of one test file; only committed rows count as data."""

    __test__ = False

    def __init__(self, path: Path, file: h5py.File) -> None:
        self.path = path
        self._file = file
        self._known: dict[str, int] = {}
        with refuse_damage(path, say("its plan")):
            plan = msgspec.json.decode(self._text(PLAN), type=FilePlan)
            # The plan's entry may be damaged; the datasets show whether there are checksums.
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

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def compressed(self) -> bool:
        """Return whether the file is the trimmed, compressed copy of a finished test."""
        with refuse_damage(self.path, FORM_ATTRIBUTE):
            return bool(self._file.attrs[FORM_ATTRIBUTE] == COMPRESSED)

    def committed(self, stream: str = "revolutions") -> int:
        """Return the number of committed rows of a stream.

        stream: as in ``streams_of``; of ``samples`` and ``unfinished_samples`` those of their
        cycles.
        """
        layout = self._streams[stream]
        if stream == "samples":
            return self.first_free_sample(self.committed("cycles"))
        if stream == "checkpoints":
            return CHECKPOINT_SLOTS
        if stream == "waiting":
            return 0
        if stream == "unfinished_samples":
            return self.first_free_sample(self.committed("unfinished"), layout.group)
        if stream in self._known:
            return self._known[stream]
        rows = int(self._read(layout.path(layout.counter)))
        with refuse_damage(self.path, layout.path(layout.counter)):
            if rows < 0:
                raise ValueError(say("rows {} to {} are requested and there are fewer", 0, rows))
        with contextlib.suppress(UnusableInput):  # this entry may itself be damaged
            if self.stored_status() != "running":  # no more will be written
                self._known[stream] = rows
        return rows

    def stored_status(self) -> str:
        """Return the status in the file: running, complete, stopped or fault."""
        return self._state_text("status")

    def first_free_sample(self, cycles: int, group: str = "/entry/cycles") -> int:
        """Return the number of samples in the first ``cycles`` saved cycles."""
        if cycles == 0:
            return 0
        return sum(
            int(self._rows(f"{group}/{name}", cycles - 1, cycles)[0]) for name in ("first", "count")
        )

    def column(
        self, name: str, first: int = 0, stop: int | None = None, stream: str = "revolutions"
    ) -> NDArray[Any]:
        """Return committed rows ``first`` .. ``stop`` of one column of a stream."""
        layout, known = self._streams[stream], self.column_units(stream)
        if name not in known:
            raise UnusableInput(
                "{}: there is no column {} in {}; there are {}",
                self.path,
                repr(name),
                layout.group,
                joined(", ", known),
            )
        end = self.committed(stream) if stop is None else min(stop, self.committed(stream))
        return self._rows(layout.path(name), first, end)

    def column_units(self, stream: str = "revolutions") -> dict[str, str]:
        """Return the units of a stream's columns by name, in their order."""
        return {field.name: field.unit for field in self._streams[stream].fields}

    def fields(self, stream: str) -> tuple[FileColumn, ...]:
        """Return the columns of a stream, without its checksum."""
        return self._streams[stream].fields

    def has(self, stream: str) -> bool:
        """Return whether the file has a stream; older files have fewer."""
        return stream in self._streams

    def has_checksum(self, stream: str) -> bool:
        """Return whether each row of a stream has a checksum; older files have none."""
        return self._streams[stream].checksum is not None

    def raw_rows(
        self, stream: str, first: int, stop: int
    ) -> tuple[list[NDArray[Any]], NDArray[Any]]:
        """Return rows of a stream as stored, committed or not: columns and checksums."""
        layout = self._streams[stream]
        columns = [self._rows(layout.path(field.name), first, stop) for field in layout.fields]
        if layout.checksum is None:
            return columns, np.empty(0, np.uint32)
        return columns, self._rows(layout.path(layout.checksum.name), first, stop)

    def stored_rows(self, path: str, first: int, stop: int) -> NDArray[Any]:
        """Return rows of a dataset as stored, committed or not."""
        return self._rows(path, first, stop)

    def row_bytes(self, stream: str) -> int:
        """Return the bytes of a row; of a cycle, with its usual number of samples."""
        layout = self._streams[stream]
        if stream in ("cycles", "unfinished"):
            return (
                layout.row_bytes + self.plan.samples_per_cycle * self._streams["samples"].row_bytes
            )
        return layout.row_bytes

    def declared(self, stream: str) -> int:
        """Return the number of rows declared for a stream in this file."""
        layout = self._streams[stream]
        with refuse_damage(self.path, layout.group):
            first = layout.fields[0]
            dataset = self._file[layout.path(first.name)]
            return len(dataset) if self.compressed else _room_of(dataset) // first.row_bytes

    def variables(self, stream: str) -> tuple[StoredVariable, ...]:
        """Return the variables of a stream, shapes cut to the committed rows.

        stream: as in ``streams_of``; ``prediction`` excludes its curves and profiles.
        """
        layout, rows = self._streams[stream], self.committed(stream)
        with refuse_damage(self.path, layout.group):
            return tuple(
                StoredVariable(
                    field.name,
                    stream,
                    (rows, *field.shape),
                    np.dtype(field.dtype),
                    _attributes(self._file[layout.path(field.name)]),
                )
                for field in layout.fields
            )

    def attributes(self, stream: str) -> dict[str, dict[str, Any]]:
        """Return the attributes of each column, including those that an older file lacks."""
        newest = streams_of(replace(self.plan, event_details=True, profiles=1))[stream]
        result = {
            field.name: {"units": field.unit, "long_name": field.description}
            for field in newest.fields
        }
        if stream in self._streams:
            result |= {variable.name: variable.attributes for variable in self.variables(stream)}
        return result

    def used_bytes(self, size: int) -> int:
        """Return how many of the ``size`` bytes of the file hold data.

        A file that is written in place has space for everything planned.
        """
        if self.compressed:
            return size
        each = {
            name: sum(
                np.dtype(field.dtype).itemsize * math.prod(field.shape) for field in columns.fields
            )
            for name, columns in self._streams.items()
        }
        return min(size, sum(self.committed(name) * octets for name, octets in each.items()))

    def texts(self) -> Iterator[tuple[str, str]]:
        """Yield every text of the file with its path, except the lines of the log."""
        with refuse_damage(self.path, say("its texts")):
            yield from texts_of(self._file)

    def _table(self, stream: str, first: int) -> Columns:
        layout: FileStream = self._streams[stream]
        end = self.committed(stream)
        return {
            field.name: self._rows(layout.path(field.name), first, end) for field in layout.fields
        }

    def _rows(self, path: str, first: int, end: int) -> NDArray[Any]:
        """Return rows ``first`` .. ``end`` of a dataset, which must have them all.

        Rows beyond the visible length are read at their offset in the file: they are not committed,
        or were committed after this file was opened.
        """
        with refuse_damage(self.path, path):
            dataset = self._file[path]
            if end > len(dataset) and dataset.chunks is None:
                return self._placed_rows(dataset, first, end)
            rows = np.asarray(dataset[first:end])
            if len(rows) != max(0, end - first):
                raise ValueError(
                    say("rows {} to {} are requested and there are {}", first, end, len(rows))
                )
        return rows

    def _placed_rows(self, dataset: h5py.Dataset, first: int, end: int) -> NDArray[Any]:
        shape, dtype = (max(0, end - first), *dataset.shape[1:]), np.dtype(dataset.dtype.str)
        row_bytes = dtype.itemsize * math.prod(shape[1:])
        offset = dataset.id.get_offset()
        if offset is None or end * row_bytes > _room_of(dataset):
            raise ValueError(say("rows {} to {} are requested and there are fewer", first, end))
        handle = self._file.id.get_vfd_handle()
        data = FILES.read_at(handle, shape[0] * row_bytes, offset + first * row_bytes)
        return np.frombuffer(data, dtype).reshape(shape)

    def _read(self, path: str) -> Any:
        """Return a dataset; raise UnusableInput where the file is damaged."""
        with refuse_damage(self.path, path):
            return self._file[path][()]

    def _text(self, path: str) -> str:
        value = self._read(path)
        with refuse_damage(self.path, path):
            return value.decode() if isinstance(value, bytes) else str(value)

    def _state_text(self, name: str) -> str:
        return self._text(f"{STATE}/{name}")

    def _holds(self, path: str) -> bool:
        with refuse_damage(self.path, path):
            return path in self._file

    def _below(self, group: str) -> dict[str, Any]:
        with refuse_damage(self.path, group):
            return _tree(self._file[group])


def _proves(file: h5py.File) -> bool:
    """Return whether a file has any checksum, independently of its plan."""
    groups = ("revolutions", "cycles", "prediction")
    checksums = (f"{ENTRY}/{group}/{CHECKSUMS[group].name}" for group in groups)
    return any(path in file for path in (f"{STATE}/{CONFIGURATION_DIGEST}", *checksums))


def _room_of(dataset: h5py.Dataset) -> int:
    """Return the bytes that a dataset occupies in the file, beyond its visible length too."""
    return int(dataset.id.get_storage_size())


_OF_HDF5 = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST", "DIMENSION_LABELS")
"""Attributes that mark a dimension scale or attach a dataset to one."""


def _attributes(dataset: h5py.Dataset) -> dict[str, Any]:
    return {
        name: value.decode() if isinstance(value, bytes) else value
        for name, value in dataset.attrs.items()
        if name not in _OF_HDF5 and not name.startswith("_Netcdf4")
    }


def _tree(group: h5py.Group) -> dict[str, Any]:
    result: dict[str, Any] = {}
    for name, item in group.items():
        if isinstance(item, h5py.Group):
            result[name] = _tree(item)
            continue
        if item is None:
            raise KeyError(name)
        if is_bare(item):
            continue
        value = item[()]
        if h5py.check_string_dtype(item.dtype) is not None:
            texts = np.asarray(value, dtype=object)
            value = texts.item().decode() if texts.ndim == 0 else [text.decode() for text in texts]
        elif isinstance(value, np.ndarray):
            value = value.tolist()
        else:
            value = value.item()
        result[name] = value
    return result


COLUMN_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,99}")
"""Valid column names: in table headers and file names other characters are unsafe."""
LONGEST_UNIT = 40


def strange_name(column: FileColumn) -> str:
    """Return why a column cannot have been written by this program, else an empty text."""
    if not COLUMN_NAME.fullmatch(column.name):
        return say("{} is no name of a column", repr(column.name[:80]))
    if len(column.unit) > LONGEST_UNIT or not column.unit.isprintable() or '"' in column.unit:
        return say("{} is no unit of a column", repr(column.unit[:80]))
    return ""


def _names(streams: Mapping[str, FileStream]) -> Iterator[FileColumn]:
    for stream in streams.values():
        yield from stream.fields


LOG = "/entry/events"


def texts_of(file: h5py.File) -> Iterator[tuple[str, str]]:
    """Yield each text that is not empty with its path: of a dataset, or of an attribute.

    An attribute's path is that of its owner, ``@`` and its name. Repeated texts of one dataset are
    yielded once. The log is excluded: its lines are events.
    """
    objects: list[h5py.HLObject] = [file]
    file.visititems(lambda _, node: objects.append(node))
    for node in objects:
        path = str(node.name)
        if path.startswith(f"{LOG}/"):
            continue
        if isinstance(node, h5py.Dataset) and h5py.check_string_dtype(node.dtype) is not None:
            yield from ((path, text) for text in _texts(node[()]))
        for name, value in node.attrs.items():
            yield from ((f"{path}@{name}", text) for text in _texts(value))


def _texts(value: Any) -> Iterator[str]:
    """Yield the distinct texts of a value; nothing for other types."""
    for item in dict.fromkeys(np.asarray(value).ravel().tolist()) if _is_text(value) else ():
        text = item.decode(errors="replace") if isinstance(item, bytes) else str(item)
        if text:
            yield text


def _is_text(value: Any) -> bool:
    array = np.asarray(value)
    if array.dtype.kind != "O":
        return array.dtype.kind in "SU"
    return all(isinstance(item, str | bytes) for item in array.ravel().tolist())
