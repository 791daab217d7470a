"""Minimum and maximum at many levels of detail: millions of cycles, a few thousand drawn points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.rownumbers import RowNumbers

FACTOR = 16
"""Rows of one level that make one row of the next."""

ALL = 16
"""Levels: more rows than these cover fit in no memory."""

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


KEPT = 1 << 16
"""Newest rows, and newest buckets of 16, that are held; older ones in buckets of 256 and more."""
ALWAYS_HELD = 2
"""From this level on everything is held: 73 columns of 10^7 rows in 256 need 23 MB."""

Fetch = Callable[[int, int], NDArray[np.floating]]
"""Returns rows start .. stop of a series from its file."""


class GrowingArray:
    """The end of a growing one-dimensional array; indices count from its beginning.

    It grows without a copy at every append. Capacity is allocated ahead of time (the planned length
    of the test): untouched memory costs nothing.
    """

    def __init__(self, dtype: type, capacity: int) -> None:
        self._data: NDArray[np.floating] = np.empty(max(capacity, 16), dtype=dtype)
        self._size = 0
        self.origin = 0

    def __len__(self) -> int:
        return self._size

    @property
    def values(self) -> NDArray[np.floating]:
        """Return the held values (a view)."""
        return self._data[: self._size - self.origin]

    def part(self, start: int, stop: int) -> NDArray[np.floating]:
        """Return values start .. stop, which are held (a view)."""
        return self._data[max(start - self.origin, 0) : max(min(stop, self._size) - self.origin, 0)]

    def write(self, start: int, values: NDArray[np.floating]) -> None:
        """Write values from ``start`` on, which is held or the present length; grow when needed."""
        first = start - self.origin
        stop = first + len(values)
        if stop > len(self._data):
            grown = np.empty(max(stop, 2 * len(self._data)), dtype=self._data.dtype)
            grown[: self._size - self.origin] = self.values
            self._data = grown
        self._data[first:stop] = values
        self._size = max(self._size, start + len(values))

    def forget(self, before: int) -> None:
        """Drop the values before an index."""
        rest = self._data[before - self.origin : self._size - self.origin].copy()
        self._data[: len(rest)] = rest
        self.origin = before


@dataclass(frozen=True, slots=True)
class Envelope:
    """The points to draw: per bucket the index of its first row, minimum and maximum."""

    first: NDArray[np.int64]
    low: Singles
    high: Singles


class Pyramid:
    """The newest rows of a series, and minima and maxima per 16, 256, 4096 ... rows.

    NaN means "not known" and is ignored unless a whole bucket is unknown. Its memory hardly grows
    with its length: rows older than ``kept`` are held in buckets alone, and come from ``fetch``
    where that is given. limit: number of visible rows (a replay); None: all.
    """

    def __init__(self, capacity: int = 1 << 16, kept: int = KEPT) -> None:
        self._capacity = capacity
        self._kept = kept
        self._base = GrowingArray(np.float32, min(capacity, 4 * kept))
        self._low: list[GrowingArray] = []
        self._high: list[GrowingArray] = []
        self._settled: list[int] = []
        self.fetch: Fetch | None = None
        self.limit: int | None = None

    def __len__(self) -> int:
        return len(self._base) if self.limit is None else min(self.limit, len(self._base))

    @property
    def values(self) -> Singles:
        """Return every value; too many for a screen in a long series."""
        return self.rows(0, len(self))

    def rows(self, start: int, stop: int) -> Singles:
        """Return rows start .. stop (a view where they are held), NaN where they are not kept."""
        start, stop = max(start, 0), min(stop, len(self))
        if start >= self._base.origin:
            return self._base.part(start, stop)
        if self.fetch is not None:
            return np.asarray(self.fetch(start, stop), dtype=np.float32)
        held = self._base.part(self._base.origin, stop)
        return np.concatenate([np.full(stop - start - len(held), np.nan, np.float32), held])

    def extend(self, values: NDArray[np.floating]) -> None:
        """Append values; the levels are updated when they are used."""
        for first in range(0, len(values), self._kept):
            self.write(len(self._base), values[first : first + self._kept])
            if len(self._base) - self._base.origin > 3 * self._kept:
                self._forget()

    def write(self, start: int, values: NDArray[np.floating]) -> None:
        """Write values from row ``start`` (held, or the present length) on."""
        if len(values):
            self._base.write(start, values)
            self._settled = [min(row, start) for row in self._settled]

    def _forget(self) -> None:
        """Drop old rows and fine buckets, after coarse ones are made of them."""
        self.settle()
        fine = ALWAYS_HELD - 1
        for array in (self._base, *self._low[:fine], *self._high[:fine]):
            before = (len(array) - self._kept) // FACTOR * FACTOR
            if before - array.origin >= self._kept:
                array.forget(before)

    def settle(self, levels: int = ALL) -> None:
        """Bring the finest levels up to date; costs the rows written since the last time only."""
        stop = len(self._base)
        low = high = self._base
        level = 0
        while len(low) > FACTOR and level < levels:
            step = FACTOR ** (level + 1)
            if level == len(self._low):
                size = self._capacity // step + 16
                size = size if level + 1 >= ALWAYS_HELD else min(size, 3 * self._kept)
                self._low.append(GrowingArray(np.float32, size))
                self._high.append(GrowingArray(np.float32, size))
                self._settled.append(0)
            if self._settled[level] < stop:
                at = self._settled[level] // step
                for array, source, operation in (
                    (self._low[level], low, np.fmin),
                    (self._high[level], high, np.fmax),
                ):
                    fresh = source.part(at * FACTOR, len(source))
                    array.write(at, _reduce(operation, fresh, FACTOR))
                self._settled[level] = stop
            low, high = self._low[level], self._high[level]
            level += 1

    def envelope(self, start: int, stop: int, buckets: int) -> Envelope:
        """Return minimum and maximum of rows start .. stop in at most about ``buckets`` buckets.

        Buckets are aligned to multiples of their own size, so that a growing or moving view does
        not shimmer; the first and the last may reach over the ends of the view.
        """
        stop = min(stop, len(self))
        start = max(0, min(start, stop))
        size = bucket_size(stop - start, buckets)
        while True:
            level = self._settled_level(size)
            low, high = self._level(level)
            step = FACTOR**level
            ratio = size // step
            begin = start // size * ratio
            if begin >= low.origin:
                break
            if self.fetch is not None:
                first_row, end = start // size * size, min(-(-stop // step) * step, len(self))
                return self._from_rows(self.rows(first_row, end), first_row, size)
            size = step * FACTOR  # not available any more: as fine as they are held
        end = -(-stop // step)
        lowest = _reduce(np.fmin, low.part(begin, end), ratio)
        highest = _reduce(np.fmax, high.part(begin, end), ratio)
        first = begin * step + size * np.arange(len(lowest), dtype=np.int64)
        return self._cut(Envelope(first, lowest, highest), size)

    def _settled_level(self, size: int) -> int:
        """Return the coarsest level whose rows make up buckets of a size, up to date."""
        self.settle(_level_of(size))
        return min(_level_of(size), len(self._low))

    def _level(self, level: int) -> tuple[GrowingArray, GrowingArray]:
        if level == 0:
            return self._base, self._base
        return self._low[level - 1], self._high[level - 1]

    @staticmethod
    def _from_rows(rows: Singles, begin: int, size: int) -> Envelope:
        low, high = (_reduce(operation, rows, size) for operation in (np.fmin, np.fmax))
        return Envelope(begin + size * np.arange(len(low), dtype=np.int64), low, high)

    def _cut(self, envelope: Envelope, size: int) -> Envelope:
        """Return an envelope whose last bucket ends with the limit."""
        end, first = len(self), envelope.first
        if self.limit is None or not len(first) or int(first[-1]) + size <= end:
            return envelope
        if int(first[-1]) + size > len(self._base) == end:
            return envelope
        last = self._from_rows(self.rows(int(first[-1]), end), int(first[-1]), size)
        low, high = (
            np.append(bounds[:-1], end_bounds[:1])
            for bounds, end_bounds in ((envelope.low, last.low), (envelope.high, last.high))
        )
        return Envelope(first, low, high)


def bucket_size(rows: int, buckets: int) -> int:
    """Return the power of two of rows per bucket that keeps ``rows`` within ``buckets``."""
    needed = -(-rows // max(buckets, 1))
    return 1 << max(needed - 1, 0).bit_length()


def _level_of(size: int) -> int:
    """Return the coarsest level whose rows make up buckets of this size."""
    return (size.bit_length() - 1) // 4


def _reduce(operation: np.ufunc, values: NDArray[np.floating], ratio: int) -> NDArray[np.floating]:
    if ratio == 1 or len(values) == 0:
        return values
    full = len(values) // ratio * ratio
    if full == 0:
        return operation.reduce(values, keepdims=True)  # type: ignore[no-any-return]
    # Rank in the bucket first: numpy reduces long rows four times faster than short ones.
    ranked = np.ascontiguousarray(values[:full].reshape(-1, ratio).T)
    head = operation.reduce(ranked, axis=0)
    if full == len(values):
        return head  # type: ignore[no-any-return]
    return np.append(head, operation.reduce(values[full:]))


def polyline(x: Floats | RowNumbers, envelope: Envelope) -> tuple[Floats, Floats]:
    """Return the points of a line through every minimum and maximum of an envelope.

    x: position of every row of the series. Runs of unknown values shrink to one NaN point.
    """
    if len(envelope.first) == 0:
        return np.empty(0), np.empty(0)
    at = x[envelope.first]
    if np.array_equal(envelope.low, envelope.high, equal_nan=True):
        points, values = at, envelope.low.astype(np.float64)
    else:
        points = np.repeat(at, 2)
        values = np.empty(2 * len(at))
        values[0::2] = envelope.low
        values[1::2] = envelope.high
    unknown = np.isnan(values)
    if unknown.any():
        keep = ~(unknown & np.concatenate(([True], unknown[:-1])))
        points, values = points[keep], values[keep]
    return points, values


def thinned(
    x: Floats, y: NDArray[np.floating], buckets: int
) -> tuple[Floats, NDArray[np.floating]]:
    """Return curves with at most about two points a bucket that keep every extreme.

    x: (n,) ascending; y: (..., n) finite. Curves short enough come back as they are.
    """
    ratio = -(-len(x) // max(buckets, 1))
    if ratio <= 2:
        return x, y
    points = np.repeat(x[::ratio], 2)
    values = np.empty((*y.shape[:-1], len(points)), dtype=y.dtype)
    full = len(x) // ratio
    # Rank in the bucket first: numpy reduces long rows many times faster than short ones.
    ranked = np.ascontiguousarray(
        np.moveaxis(y[..., : full * ratio].reshape(*y.shape[:-1], full, ratio), -1, 0)
    )
    values[..., 0 : 2 * full : 2] = np.fmin.reduce(ranked, axis=0)
    values[..., 1 : 2 * full : 2] = np.fmax.reduce(ranked, axis=0)
    rest = y[..., full * ratio :]
    if rest.shape[-1]:
        values[..., -2] = np.fmin.reduce(rest, axis=-1)
        values[..., -1] = np.fmax.reduce(rest, axis=-1)
    return points, values
