"""Read columns of long streams in blocks, so that a long test does not fill the memory."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.rownumbers import RowNumbers
from rigapp.storage.reading.streams import Columns, StreamReader

BLOCK_ROWS = 1 << 18
"""2 MB of a column: the overhead of a read is then less than the transfer itself."""


def blocks(
    reader: StreamReader,
    names: Sequence[str],
    stream: str = "revolutions",
    *,
    start: int = 0,
    stop: int | None = None,
    backwards: bool = False,
) -> Iterator[tuple[int, Columns]]:
    """Yield the first row and the columns of each block of committed rows start .. stop.

    backwards: the last block first; the rows within each stay in order. Columns that an older file
    does not have are NaN.
    """
    rows = reader.committed(stream)
    end = rows if stop is None else min(stop, rows)
    stored = reader.column_units(stream)
    firsts: Sequence[int] = range(start, end, BLOCK_ROWS)
    for first in reversed(firsts) if backwards else firsts:
        last = min(end, first + BLOCK_ROWS)
        yield (
            first,
            {
                name: reader.column(name, first, last, stream)
                if name in stored
                else np.full(last - first, np.nan)
                for name in names
            },
        )


class StoredColumns(Mapping[str, NDArray[Any]]):
    """The columns of a stream by name, each read on access and not kept."""

    def __init__(self, reader: StreamReader, stream: str) -> None:
        self._reader = reader
        self._stream = stream
        self._names = tuple(reader.column_units(stream))

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._names:
            raise KeyError(name)
        return self._reader.column(name, stream=self._stream)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


def row_numbers(reader: StreamReader, stream: str = "revolutions") -> RowNumbers:
    """Return the revolution of every committed row of a stream.

    Numbers increase, so a run without a gap is determined by its ends; those between are not read.
    """
    result = RowNumbers()
    waiting = [(0, reader.committed(stream))]
    while waiting:
        first, stop = waiting.pop()
        if stop - first > BLOCK_ROWS:
            low, high = (
                int(reader.column("revolution", row, row + 1, stream)[0])
                for row in (first, stop - 1)
            )
            if high - low == stop - 1 - first:
                result.follow(low, stop - first)
            else:
                middle = (first + stop) // 2
                waiting += [(middle, stop), (first, middle)]
        elif stop > first:
            result.extend(reader.column("revolution", first, stop, stream))
    return result


def rows_up_to(reader: StreamReader, revolution: float, stream: str = "revolutions") -> int:
    """Return the number of rows of a stream up to and including a revolution, numbers ascending.

    By bisection: only a few rows are read, not the column.
    """
    low, high = 0, reader.committed(stream)
    while low < high:
        middle = (low + high) // 2
        if reader.column("revolution", middle, middle + 1, stream)[0] <= revolution:
            low = middle + 1
        else:
            high = middle
    return low


def newest_known(
    reader: StreamReader, names: Sequence[str], count: int, stop: int | None = None
) -> dict[str, NDArray[Any]]:
    """Return the newest ``count`` predictions whose columns are all finite, in order."""
    result: list[Columns] = []
    have = 0
    for _, block in blocks(reader, names, "prediction", stop=stop, backwards=True):
        known = np.logical_and.reduce([np.isfinite(block[name]) for name in names])
        rows = np.flatnonzero(known)[-(count - have) :]
        result.append({name: block[name][rows] for name in names})
        have += rows.size
        if have >= count:
            break
    return {name: np.concatenate([np.empty(0), *(p[name] for p in result[::-1])]) for name in names}
