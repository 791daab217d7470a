"""Place rows of a stream at their final offsets in the file."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.structure.checksum import MANY_ROWS, WORDS, row_checksums, word_checksums
from rigapp.storage.structure.layout import AHEAD, STATE, FileStream
from rigapp.storage.writing.backlog import Backlog
from rigapp.storage.writing.create import Places
from rigapp.texts import say

Float = NDArray[np.float64]
Offsets = dict[str, int]
MIN_LENGTH = 1
"""HDF5 regards a dataset with an offset and no length as damaged."""
GROWTH_ROWS = 4096  # reserved together, so that system calls are rare


class Capacity:
    """Rows of a stream with reserved disk space; more are reserved on demand.

    It also sets the number of rows that other programs see. HDF5 has the length of a dataset in its
    header; it is increased in steps ahead of the rows, so that readers of a running test find
    columns of equal length, where rows not yet written are NaN. lengths: offset of each dataset's
    length field, none where others see all rows. rows: in the file.
    """

    __slots__ = (
        "_ahead", "_disk", "_floats", "_lengths", "_offsets", "_reached", "_shown", "_stream",
        "reserved",
    )  # fmt: skip

    def __init__(
        self,
        disk: Disk,
        stream: FileStream,
        offsets: Offsets,
        reserved: int,
        lengths: Sequence[int],
        rows: int,
    ) -> None:
        self._disk = disk
        self._stream = stream
        self._offsets = offsets
        self.reserved = reserved
        self._lengths = lengths
        self._ahead = AHEAD.get(stream.name, 0)
        self._floats = [field for field in stream.fields if np.dtype(field.dtype).kind == "f"]
        self._reached = self._shown = -1
        for data, offset in self.reach(rows):
            disk.write(data, offset)
        self.show()

    def reach(self, rows: int) -> list[tuple[memoryview, int]]:
        """Return the fill writes after the first ``rows`` rows, due before any further row."""
        most = max(rows, self.reserved)
        if not self._lengths or min(rows + self._ahead // 2, most) <= self._reached:
            return []
        first = max(rows, self._reached)
        self._reached = max(MIN_LENGTH, min(rows + self._ahead, most))
        count = self._reached - first
        return [
            (
                _bytes_of(np.full((count, *column.shape), np.nan, column.dtype)),
                self._offsets[column.name] + first * column.row_bytes,
            )
            for column in (self._floats if count else ())
        ]

    def show(self) -> None:
        """Make the rows that are reached visible to other programs; raises StorageFailed."""
        rows = self._reached
        if rows != self._shown:
            for offset in self._lengths:
                self._disk.write(rows.to_bytes(8, "little"), offset)
            self._shown = rows

    def end(self, rows: int) -> None:
        """Make exactly ``rows`` rows visible to other programs; raises StorageFailed."""
        self._reached = max(MIN_LENGTH, rows)
        self.show()

    def holds(self, rows: int) -> bool:
        """Return whether ``rows`` rows fit, reserving more where the file declares them."""
        if rows <= self.reserved:
            return True
        if rows > self._stream.capacity:
            return False
        wanted = max(rows + GROWTH_ROWS, rows + rows // 8)
        try:
            self.reserve(min(self._stream.capacity, wanted))
        except OSError:
            return False
        return True

    def reserve(self, rows: int) -> None:
        """Reserve the disk space of the first ``rows`` rows; raises OSError."""
        for field in self._stream.stored:
            start = self._offsets[field.name] + self.reserved * field.row_bytes
            self._disk.reserve(start, (rows - self.reserved) * field.row_bytes)
        self.reserved = max(self.reserved, rows)

    def give_back(self, rows: int) -> None:
        """Deallocate the disk space after the first ``rows`` rows."""
        for field in self._stream.stored:
            start = self._offsets[field.name] + rows * field.row_bytes
            self._disk.give_back(start, (self._stream.capacity - rows) * field.row_bytes)
        self.reserved = min(self.reserved, rows)


class RowBuffer:
    """Collect rows of scalar columns and pass them to the backlog a column at a time."""

    def __init__(
        self,
        backlog: Backlog,
        stream: FileStream,
        offsets: Offsets,
        room: Capacity,
        count: int,
        rows: int,
    ) -> None:
        self._backlog = backlog
        self._fields = stream.fields
        dtypes = [np.dtype(field.dtype) for field in stream.fields]
        self._sizes = np.array([dtype.itemsize for dtype in dtypes])
        self._narrow = [(i, dtype) for i, dtype in enumerate(dtypes) if dtype != np.float64]
        self._offsets = [offsets[field.name] for field in stream.fields]
        self._checksum = None if stream.checksum is None else offsets[stream.checksum.name]
        self._room = room
        self._size = rows
        self._lock = threading.Lock()
        self._placed = count
        self.count = count
        self._begin_block()

    def append(self, values: Float | Sequence[float]) -> bool:
        """Append one row, in the order of the stream's fields; False when there is no space."""
        with self._lock:
            if self.count >= self._room.reserved and not self._room.holds(self.count + 1):
                return False
            self._block[self._fill] = values
            self._fill += 1
            self.count += 1
            if self._fill == self._size:
                rows = self._block[self._placed - self._base :]
                self._backlog.put_later(rows.nbytes, partial(self._hand_over, self._placed, rows))
                self._placed = self.count
                self._begin_block()
        self._backlog.assist(2)
        return True

    def hand_over_pending(self) -> int:
        """Pass the remaining rows to the backlog; return the rows that are in it or in the file."""
        with self._lock:
            first, count = self._placed, self.count
            rows = self._block[first - self._base : self._fill]
            self._placed = count
            self._backlog.put_over(self._room.reach(count))
        self._hand_over(first, rows)
        return count

    def _begin_block(self) -> None:
        self._base = self.count
        self._fill = 0
        self._block: Float = np.empty((self._size, len(self._offsets)))

    def _hand_over(self, first: int, rows: Float) -> None:
        """Pass rows on, a column at a time; they must not change afterwards."""
        if not len(rows):
            return
        block = np.array(rows.T, order="C")
        columns, words = list(block), block.view(np.uint64)
        for i, dtype in self._narrow:
            columns[i] = block[i].astype(dtype)
            words[i] = columns[i].view(WORDS[dtype.itemsize])
        writes = [
            (_bytes_of(column), offset + first * column.itemsize)
            for column, offset in zip(columns, self._offsets, strict=True)
        ]
        if self._checksum is not None:
            many = len(rows) >= MANY_ROWS
            crcs = (
                word_checksums(words, self._sizes)
                if many
                else row_checksums(self._fields, columns, len(rows))
            )
            writes.append((_bytes_of(crcs), self._checksum + first * crcs.itemsize))
        self._backlog.put(writes)


class RecordPlacer:
    """Pass complete records (cycles' samples, curves, events) to the backlog."""

    def __init__(
        self, backlog: Backlog, stream: FileStream, offsets: Offsets, room: Capacity
    ) -> None:
        self._backlog = backlog
        self._stream = stream
        self._fields = [
            (field, np.dtype(field.dtype), field.row_bytes, offsets[field.name])
            for field in stream.stored
        ]
        self._room = room

    def holds(self, rows: int) -> bool:
        """Return whether the first ``rows`` rows of the stream fit."""
        return rows <= self._room.reserved or self._room.holds(rows)

    def place(
        self, first: int, rows: int, values: Mapping[str, ArrayLike], *, over: bool = False
    ) -> None:
        """Place ``rows`` rows from row ``first`` on; values: each field's array by name.

        over: the same rows were placed before; a shorter record leaves the rest of them unchanged.
        An array that already has the field's type is not copied: it must not change afterwards.
        """
        writes: list[tuple[memoryview, int]] = []
        columns: list[NDArray[Any]] = []
        checksum = self._stream.checksum
        for column, dtype, row_bytes, offset in self._fields:
            if column is checksum and column.name not in values:
                shapes = ((rows, *field.shape) for field in self._stream.fields)
                columns = list(map(np.ndarray.reshape, columns, shapes))
                crcs = row_checksums(self._stream.fields, columns, rows)
                values = {**values, column.name: crcs}
            data = np.ascontiguousarray(values[column.name], dtype=dtype)
            if data.nbytes > rows * row_bytes or (data.nbytes < rows * row_bytes and not over):
                raise ValueError(
                    say(
                        "{}: {} values given, {} expected",
                        self._stream.path(column.name),
                        data.shape,
                        (rows, *column.shape),
                    )
                )
            writes.append((_bytes_of(data), offset + first * row_bytes))
            columns.append(data)
        if over:
            self._backlog.put_over(writes)
        else:
            self._backlog.put(writes)
            self._backlog.put_over(self._room.reach(first + rows))


def _bytes_of(array: NDArray[Any]) -> memoryview:
    if array.dtype.kind == "S":
        return memoryview(array.tobytes())
    return array.data.cast("B") if array.size else memoryview(b"")


FINAL_STATUSES = ("complete", "stopped", "fault")


@dataclass(slots=True)
class Counts:
    """Numbers of rows of each stream, and of refused rows."""

    revolutions: int = 0
    cycles: int = 0
    samples: int = 0
    unfinished: int = 0
    unfinished_samples: int = 0
    prediction: int = 0
    curves: int = 0
    profiles: int = 0
    events: int = 0
    gaps: int = 0
    resumed: int = 0
    cycles_refused: int = 0
    events_refused: int = 0
    planned_revolutions: int = 0


COUNTERS = {
    "cycles": "/entry/cycles/committed",
    "unfinished": "/entry/unfinished/committed",
    "curves": "/entry/prediction/committed_curves",
    "profiles": "/entry/prediction/committed_profiles",
    "prediction": "/entry/prediction/committed",
    "events": "/entry/events/committed",
    "gaps": f"{STATE}/gaps",
    "resumed": f"{STATE}/resumed",
    "cycles_refused": f"{STATE}/cycles_refused",
    "events_refused": f"{STATE}/events_refused",
    "planned_revolutions": f"{STATE}/planned_revolutions",
    "revolutions": "/entry/revolutions/committed",
}
"""Counters in the order of writing in a commit; a file need not have all of them."""


class Scalars:
    """Overwrite scalars in place: int64, and texts of fixed length."""

    def __init__(self, disk: Disk, places: Places) -> None:
        self._disk = disk
        self._places = places

    def put_state(self, name: str, value: int | str) -> None:
        """Overwrite one scalar of ``/entry/state``."""
        self.put(f"{STATE}/{name}", value)

    def put(self, path: str, value: int | str) -> None:
        """Overwrite one scalar; a text that is too long is truncated between characters."""
        offset, length = self._places[path]
        if isinstance(value, int):
            data = value.to_bytes(8, "little", signed=True)
        else:
            data = value.encode()[:length].decode(errors="ignore").encode().ljust(length, b"\0")
        self._disk.write(data, offset)
