"""Minimum and maximum at many levels of detail: millions of cycles, a few thousand drawn points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FACTOR = 16
"""Rows of one level that make one row of the next."""

ALL = 16
"""Levels: more rows than these make have room in no memory."""

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
        self._settled: list[int] = []

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
            self._settled = [min(one, start) for one in self._settled]

    def truncate(self, size: int) -> None:
        """Forget what lies behind the first ``size`` values; costs next to nothing."""
        if size >= len(self._base):
            return
        self._base.truncate(size)
        # The last bucket of each level is to be made again from what is left of it.
        self._settled = [max(0, min(one, size) - 1) for one in self._settled]
        for levels in (self._low, self._high):
            step = 1
            for level in levels:
                step *= FACTOR
                level.truncate(-(-size // step))

    def settle(self, levels: int = ALL) -> None:
        """Bring the finest levels up to date; costs the rows written since the last time only."""
        stop = len(self._base)
        low = high = self._base
        level = 0
        while len(low) > FACTOR and level < levels:
            step = FACTOR ** (level + 1)
            if level == len(self._low):
                size = self._capacity // step + 16
                self._low.append(GrowingArray(np.float32, size))
                self._high.append(GrowingArray(np.float32, size))
                self._settled.append(0)
            if self._settled[level] < stop:
                at = self._settled[level] // step
                for array, source, operation in (
                    (self._low[level], low, np.fmin),
                    (self._high[level], high, np.fmax),
                ):
                    array.write(at, _reduce(operation, source.values[at * FACTOR :], FACTOR))
                self._settled[level] = stop
            low, high = self._low[level], self._high[level]
            level += 1

    def envelope(self, start: int, stop: int, buckets: int) -> Envelope:
        """Return minimum and maximum of rows start .. stop in at most about ``buckets`` buckets.

        Buckets are aligned to multiples of their own size, so that a growing or moving view does
        not shimmer; the first and the last may reach over the ends of the view.
        """
        stop = min(stop, len(self._base))
        start = max(0, min(start, stop))
        size = bucket_size(stop - start, buckets)
        self.settle(_level_of(size))
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
    if whole == 0:
        return operation.reduce(values, keepdims=True)  # type: ignore[no-any-return]
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
    """Return curves with at most about two points a bucket that keep every extreme.

    x: (n,) ascending; y: (..., n) finite. Curves short enough come back as they are.
    """
    ratio = -(-len(x) // max(buckets, 1))
    if ratio <= 2:
        return x, y
    points = np.repeat(x[::ratio], 2)
    values = np.empty((*y.shape[:-1], len(points)), dtype=y.dtype)
    whole = len(x) // ratio
    # Rank in the bucket first: numpy reduces long rows many times faster than short ones.
    ranked = np.ascontiguousarray(
        np.moveaxis(y[..., : whole * ratio].reshape(*y.shape[:-1], whole, ratio), -1, 0)
    )
    values[..., 0 : 2 * whole : 2] = np.fmin.reduce(ranked, axis=0)
    values[..., 1 : 2 * whole : 2] = np.fmax.reduce(ranked, axis=0)
    rest = y[..., whole * ratio :]
    if rest.shape[-1]:
        values[..., -2] = np.fmin.reduce(rest, axis=-1)
        values[..., -1] = np.fmax.reduce(rest, axis=-1)
    return points, values
