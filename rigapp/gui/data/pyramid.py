"""Minimum and maximum at many levels of detail: millions of cycles, a few thousand drawn points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FACTOR = 16
"""Rows of one level that make one row of the next."""

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


class GrowingArray:
    """Hold a one-dimensional array that grows at its end without a copy at every append.

    Capacity is asked for ahead of time (the planned length of the test): untouched memory costs
    nothing, so a test that keeps to its plan never copies.
    """

    def __init__(self, dtype: type, capacity: int) -> None:
        self._data: NDArray[np.floating] = np.empty(max(capacity, 16), dtype=dtype)
        self._size = 0

    def __len__(self) -> int:
        return self._size

    @property
    def values(self) -> NDArray[np.floating]:
        """Return the filled part (a view)."""
        return self._data[: self._size]

    def truncate(self, size: int) -> None:
        """Forget what lies behind the first ``size`` values."""
        self._size = min(self._size, size)

    def write(self, start: int, values: NDArray[np.floating]) -> None:
        """Write values from ``start`` on, which is at most the present length; grow when needed."""
        stop = start + len(values)
        if stop > len(self._data):
            grown = np.empty(max(stop, 2 * len(self._data)), dtype=self._data.dtype)
            grown[: self._size] = self._data[: self._size]
            self._data = grown
        self._data[start:stop] = values
        self._size = max(self._size, stop)


@dataclass(frozen=True, slots=True)
class Envelope:
    """Carry what is to be drawn: per bucket the index of its first row, minimum and maximum."""

    first: NDArray[np.int64]
    low: Singles
    high: Singles


class Pyramid:
    """Keep one series and its minima and maxima per 16, 256, 4096 ... rows.

    NaN means "not known" and is ignored unless a whole bucket is unknown.
    """

    def __init__(self, capacity: int = 1 << 16) -> None:
        self._capacity = capacity
        self._base = GrowingArray(np.float32, capacity)
        self._low: list[GrowingArray] = []
        self._high: list[GrowingArray] = []
        self._settled = 0

    def __len__(self) -> int:
        return len(self._base)

    @property
    def values(self) -> Singles:
        """Return every value (a view)."""
        return self._base.values

    def extend(self, values: NDArray[np.floating]) -> None:
        """Append values; the levels follow when they are looked at."""
        self.write(len(self._base), values)

    def write(self, start: int, values: NDArray[np.floating]) -> None:
        """Write values from row ``start`` (at most the present length) on."""
        if len(values):
            self._base.write(start, values)
            self._settled = min(self._settled, start)

    def truncate(self, size: int) -> None:
        """Forget what lies behind the first ``size`` values; costs next to nothing."""
        if size >= len(self._base):
            return
        self._base.truncate(size)
        # The last bucket of each level is to be made again from what is left of it.
        self._settled = max(0, min(self._settled, size) - 1)
        for levels in (self._low, self._high):
            step = 1
            for level in levels:
                step *= FACTOR
                level.truncate(-(-size // step))

    def settle(self) -> None:
        """Bring every level up to date; costs the rows written since the last time only."""
        first, stop = self._settled, len(self._base)
        if first == stop:
            return
        self._settled = stop
        low = high = self._base
        level = 0
        while len(low) > FACTOR:
            if level == len(self._low):
                size = self._capacity // FACTOR ** (level + 1) + 16
                self._low.append(GrowingArray(np.float32, size))
                self._high.append(GrowingArray(np.float32, size))
                first = 0
            first //= FACTOR
            self._low[level].write(first, _reduce(np.fmin, low.values[first * FACTOR :], FACTOR))
            self._high[level].write(first, _reduce(np.fmax, high.values[first * FACTOR :], FACTOR))
            low, high = self._low[level], self._high[level]
            level += 1

    def envelope(self, start: int, stop: int, buckets: int) -> Envelope:
        """Return minimum and maximum of rows start .. stop in at most about ``buckets`` buckets.

        Buckets are aligned to multiples of their own size, so that a growing or moving view does
        not shimmer; the first and the last may reach over the ends of the view.
        """
        self.settle()
        stop = min(stop, len(self._base))
        start = max(0, min(start, stop))
        size = bucket_size(stop - start, buckets)
        level = min(_level_of(size), len(self._low))
        step = FACTOR**level
        ratio = size // step
        low = self._base if level == 0 else self._low[level - 1]
        high = self._base if level == 0 else self._high[level - 1]
        begin = start // size * ratio
        end = -(-stop // step)
        lowest = _reduce(np.fmin, low.values[begin:end], ratio)
        highest = _reduce(np.fmax, high.values[begin:end], ratio)
        first = begin * step + size * np.arange(len(lowest), dtype=np.int64)
        return Envelope(first, lowest, highest)


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
    whole = len(values) // ratio * ratio
    head = operation.reduce(values[:whole].reshape(-1, ratio), axis=1)
    if whole == len(values):
        return head  # type: ignore[no-any-return]
    return np.append(head, operation.reduce(values[whole:]))


def polyline(x: Floats, envelope: Envelope) -> tuple[Floats, Floats]:
    """Return the points of a line that visits every minimum and maximum of an envelope.

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
    """Return a curve with at most about two points a bucket that keeps every extreme.

    x, y: (n,), x ascending, y finite. Curves short enough come back as they are.
    """
    ratio = -(-len(x) // max(buckets, 1))
    if ratio <= 2:
        return x, y
    points = np.repeat(x[::ratio], 2)
    values = np.empty(len(points), dtype=y.dtype)
    values[0::2] = _reduce(np.fmin, y, ratio)
    values[1::2] = _reduce(np.fmax, y, ratio)
    return points, values
