"""Place rows of a stream at their final offsets in the file."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.storage.disk import Disk
from rigapp.storage.layout import Field, Stream

Float = NDArray[np.float64]
Offsets = dict[str, int]
GROWTH_ROWS = 4096


class Room:
    """Know how many rows of a stream have reserved disk space, and reserve more while they last."""

    __slots__ = ("_disk", "_offsets", "_stream", "reserved")

    def __init__(self, disk: Disk, stream: Stream, offsets: Offsets, reserved: int) -> None:
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


class RowBuffer:
    """Collect rows of scalar columns and place them a column at a time.

    Appending copies into memory; every ``rows`` rows the caller's thread places them. ``pending``
    and ``placed`` let another thread place what is left without ever keeping ``append`` waiting
    for the disk.
    """

    def __init__(
        self, disk: Disk, stream: Stream, offsets: Offsets, room: Room, count: int, rows: int
    ) -> None:
        self._disk = disk
        self._fields = stream.fields
        self._offsets = [offsets[one.name] for one in stream.fields]
        self._room = room
        self._size = rows
        self._block: Float = np.zeros((len(stream.fields), rows))
        self._rows: Float = self._block.T
        self._base = count
        self._placed = count
        self._fill = 0
        self._lock = threading.Lock()
        self.count = count

    def append(self, values: Float | Sequence[float]) -> bool:
        """Take one row, in the order of the stream's fields; False when there is no room for it."""
        with self._lock:
            if self.count >= self._room.reserved and not self._room.holds(self.count + 1):
                return False
            if self._fill == self._size:
                self._place_full()
            self._rows[self._fill] = values
            self._fill += 1
            self.count += 1
            return True

    def _place_full(self) -> None:
        block = self._block[:, self._placed - self._base :]
        _place_block(self._disk, self._fields, self._offsets, block, self._placed)
        self._base = self._placed = self.count
        self._fill = 0

    def pending(self) -> tuple[int, Float, int]:
        """Return first row, copied block (columns, rows) and count of what is not yet placed."""
        with self._lock:
            block = self._block[:, self._placed - self._base : self._fill].copy()
            return self._placed, block, self.count

    def place(self, first: int, block: Float) -> None:
        """Place what ``pending`` returned; called by the committing thread alone."""
        if block.shape[1] == 0:
            return
        _place_block(self._disk, self._fields, self._offsets, block, first)
        with self._lock:
            self._placed = max(self._placed, first + block.shape[1])


def _place_block(
    disk: Disk, fields: Sequence[Field], offsets: Sequence[int], block: Float, first: int
) -> None:
    for one, offset, column in zip(fields, offsets, block, strict=True):
        if one.dtype != "<f8":
            column = column.astype(one.dtype)
        disk.write(_bytes_of(column), offset + first * column.itemsize)


class RecordPlacer:
    """Place whole records (cycles' samples, curves, events) at once, from the caller's thread."""

    def __init__(self, disk: Disk, stream: Stream, offsets: Offsets, room: Room) -> None:
        self._disk = disk
        self._stream = stream
        self._offsets = offsets
        self._room = room

    def holds(self, rows: int) -> bool:
        """Tell whether the first ``rows`` rows of the stream fit."""
        return rows <= self._room.reserved or self._room.holds(rows)

    def place(self, first: int, rows: int, value_of: Callable[[str], Any]) -> None:
        """Place ``rows`` rows from row ``first`` on; ``value_of`` gives each field's array."""
        for one in self._stream.fields:
            data = np.ascontiguousarray(value_of(one.name), dtype=one.dtype)
            if data.size * data.itemsize != rows * one.row_bytes:
                raise ValueError(
                    f"{self._stream.path(one.name)}: got {data.shape}, "
                    f"wanted {(rows, *one.shape)} values"
                )
            self._disk.write(_bytes_of(data), self._offsets[one.name] + first * one.row_bytes)


def _bytes_of(array: NDArray[Any]) -> memoryview:
    if array.dtype.kind == "S":
        return memoryview(array.tobytes())
    return array.data.cast("B") if array.size else memoryview(b"")
