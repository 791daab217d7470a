"""Place rows of a stream at their final offsets in the file."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.structure.layout import FileStream
from rigapp.storage.writing.backlog import Backlog

Float = NDArray[np.float64]
Offsets = dict[str, int]
GROWTH_ROWS = 4096  # reserved at once, so that asking the disk is rare


class Room:
    """Know how many rows of a stream have reserved disk space, and reserve more while they last."""

    __slots__ = ("_disk", "_offsets", "_stream", "reserved")

    def __init__(self, disk: Disk, stream: FileStream, offsets: Offsets, reserved: int) -> None:
        self._disk = disk
        self._stream = stream
        self._offsets = offsets
        self.reserved = reserved

    def holds(self, rows: int) -> bool:
        """Tell whether ``rows`` rows fit, reserving more where the file declares them."""
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
        for one in self._stream.fields:
            start = self._offsets[one.name] + self.reserved * one.row_bytes
            self._disk.reserve(start, (rows - self.reserved) * one.row_bytes)
        self.reserved = max(self.reserved, rows)

    def give_back(self, rows: int) -> None:
        """Give the disk space after the first ``rows`` rows back."""
        for one in self._stream.fields:
            start = self._offsets[one.name] + rows * one.row_bytes
            self._disk.give_back(start, (self._stream.capacity - rows) * one.row_bytes)
        self.reserved = min(self.reserved, rows)


class RowBuffer:
    """Collect rows of scalar columns and hand them to the backlog a column at a time.

    ``pending`` copies what is not yet handed over, so that the committing thread can place it while
    appending goes on.
    """

    def __init__(
        self,
        backlog: Backlog,
        stream: FileStream,
        offsets: Offsets,
        room: Room,
        count: int,
        rows: int,
    ) -> None:
        self._backlog = backlog
        self._fields = stream.fields
        self._offsets = [offsets[one.name] for one in stream.fields]
        self._room = room
        self._size = rows
        self._lock = threading.Lock()
        self._placed = count
        self.count = count
        self._begin_block()

    def append(self, values: Float | Sequence[float]) -> bool:
        """Take one row, in the order of the stream's fields; False when there is no room for it."""
        with self._lock:
            if self.count >= self._room.reserved and not self._room.holds(self.count + 1):
                return False
            self._rows[self._fill] = values
            self._fill += 1
            self.count += 1
            if self._fill == self._size:
                self._hand_over(self._placed, self._block[:, self._placed - self._base :])
                self._placed = self.count
                self._begin_block()
        self._backlog.assist(2)
        return True

    def hand_over_pending(self) -> int:
        """Hand what is left to the backlog; return the rows that are in it or in the file."""
        with self._lock:
            first, count = self._placed, self.count
            block = self._block[:, first - self._base : self._fill].copy()
            self._placed = count
        self._hand_over(first, block)
        return count

    def _begin_block(self) -> None:
        self._base = self.count
        self._fill = 0
        self._block: Float = np.empty((len(self._fields), self._size))
        self._rows: Float = self._block.T

    def _hand_over(self, first: int, block: Float) -> None:
        if block.shape[1] == 0:
            return
        writes = []
        for one, offset, column in zip(self._fields, self._offsets, block, strict=True):
            if one.dtype != "<f8":
                column = column.astype(one.dtype)
            writes.append((_bytes_of(column), offset + first * column.itemsize))
        self._backlog.put(writes)


class RecordPlacer:
    """Hand whole records (cycles' samples, curves, events) to the backlog."""

    def __init__(self, backlog: Backlog, stream: FileStream, offsets: Offsets, room: Room) -> None:
        self._backlog = backlog
        self._stream = stream
        self._fields = [
            (one, np.dtype(one.dtype), one.row_bytes, offsets[one.name]) for one in stream.fields
        ]
        self._room = room

    def holds(self, rows: int) -> bool:
        """Tell whether the first ``rows`` rows of the stream fit."""
        return rows <= self._room.reserved or self._room.holds(rows)

    def place(self, first: int, rows: int, values: Mapping[str, ArrayLike]) -> None:
        """Place ``rows`` rows from row ``first`` on; values: each field's array by name.

        An array that has the field's type already is not copied: it must not change afterwards.
        """
        writes = []
        for one, dtype, row_bytes, offset in self._fields:
            data = np.ascontiguousarray(values[one.name], dtype=dtype)
            if data.nbytes != rows * row_bytes:
                raise ValueError(
                    f"{self._stream.path(one.name)}: got {data.shape}, "
                    f"wanted {(rows, *one.shape)} values"
                )
            writes.append((_bytes_of(data), offset + first * row_bytes))
        self._backlog.put(writes)


def _bytes_of(array: NDArray[Any]) -> memoryview:
    if array.dtype.kind == "S":
        return memoryview(array.tobytes())
    return array.data.cast("B") if array.size else memoryview(b"")
