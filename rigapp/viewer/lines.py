"""Lines to draw, and the extremes for an axis: of revolutions without a flag."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.viewer.pyramid import polyline
from rigapp.viewer.series import SeriesTable

Floats = NDArray[np.float64]
View = tuple[float, float]
"""The first and the last visible revolution."""

QUALITY = "quality"
EVERYTHING: View = (-np.inf, np.inf)
LOOKED_BACK = 5
"""Revolutions searched for one without a flag: an older value is not current."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """The points of a line, (n,) each, and the range for its axis.

    low, high: NaN where nothing is known. above, under: revolution and value of the largest and
    the smallest flagged one beyond them, where there is one.
    """

    x: Floats
    y: Floats
    low: float = np.nan
    high: float = np.nan
    above: tuple[float, float] | None = None
    under: tuple[float, float] | None = None


class Flagged:
    """The buckets of a view with a flagged revolution; computed once for all its lines."""

    def __init__(self, rows: SeriesTable, view: View, buckets: int) -> None:
        self._starts: Floats = np.empty(0)
        if QUALITY in rows.names and len(rows):
            flags = rows.series(QUALITY).envelope(*rows_in_view(rows, view), buckets)
            self._starts = rows.revolutions[flags.first]
            # Not known (NaN) is not flagged: older files have no such column.
            self._flagged = flags.high > 0.0

    def at(self, revolutions: Floats) -> NDArray[np.bool_]:
        """Return which buckets, (n,), that begin at these revolutions have a flag."""
        if not len(self._starts) or not self._flagged.any():
            return np.zeros(len(revolutions), dtype=bool)
        if np.array_equal(revolutions, self._starts):
            return self._flagged
        # A table with fewer rows has other buckets: one may reach into several of the flags.
        before = np.concatenate(([0], np.cumsum(self._flagged)))
        first = np.maximum(np.searchsorted(self._starts, revolutions, side="right") - 1, 0)
        stop = np.append(np.searchsorted(self._starts, revolutions[1:]), len(self._starts))
        flagged: NDArray[np.bool_] = before[np.maximum(stop, first + 1)] > before[first]
        return flagged


def drawn(
    table: SeriesTable, column: str, flagged: Flagged, view: View, buckets: int, scale: float = 1.0
) -> Drawn:
    """Return ``scale`` times a series in a view, in at most about ``buckets`` buckets.

    A bucket with a flagged revolution does not count for the axis, unless every bucket has one.
    """
    start, stop = rows_in_view(table, view)
    envelope = table.series(column).envelope(start, stop, buckets)
    x, y = polyline(table.revolutions, envelope)
    y *= scale
    known = np.isfinite(envelope.low) & np.isfinite(envelope.high)
    if not known.any():
        return Drawn(x, y)
    at = table.revolutions[envelope.first]
    unflagged = known & ~flagged.at(at)
    fine = unflagged if unflagged.any() else known
    low, high = scale * float(envelope.low[fine].min()), scale * float(envelope.high[fine].max())
    least, most = int(np.nanargmin(envelope.low)), int(np.nanargmax(envelope.high))
    lowest, highest = scale * float(envelope.low[least]), scale * float(envelope.high[most])
    return Drawn(
        x,
        y,
        low,
        high,
        (float(at[most]), highest) if highest > high else None,
        (float(at[least]), lowest) if lowest < low else None,
    )


def banded(
    table: SeriesTable, column: str, doubt: str, view: View, buckets: int, scale: float = 1.0
) -> tuple[Floats, Floats, Floats]:
    """Return ``scale`` times a series less and plus its uncertainty: revolutions, low, high."""
    middle, half = (
        table.series(name).envelope(*rows_in_view(table, view), buckets) for name in (column, doubt)
    )
    if len(middle.first) != len(half.first):  # one of them is still being read
        return np.empty(0), np.empty(0), np.empty(0)
    low, high = (scale * bound.astype(np.float64) for bound in (middle.low, middle.high))
    doubt_high = scale * half.high.astype(np.float64)
    return table.revolutions[middle.first], low - doubt_high, high + doubt_high


def newest_good(table: SeriesTable, rows: SeriesTable) -> int:
    """Return the newest row of a table whose revolution has no flag, else its newest row."""
    last = len(table) - 1
    for row in range(last, max(last - LOOKED_BACK, -1), -1):
        at = rows.revolutions.searchsorted(table.revolutions[row])
        # Not known (NaN) is not flagged.
        if QUALITY not in rows.names or not rows.at(QUALITY, at) > 0.0:
            return row
    return last


def rows_in_view(table: SeriesTable, view: View) -> tuple[int, int]:
    """Return the rows between two revolutions, one more at each end."""
    start = table.revolutions.searchsorted(view[0]) - 1
    return max(start, 0), table.revolutions.searchsorted(view[1], "right") + 1
