"""Lines to draw, and the extremes that an axis follows: of revolutions without a flag."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.gui.data.pyramid import Envelope, polyline
from rigapp.gui.data.series import SeriesTable

Floats = NDArray[np.float64]
View = tuple[float, float]
"""The first and the last revolution that are seen."""

QUALITY = "quality"
EVERYTHING: View = (-np.inf, np.inf)


@dataclass(frozen=True, slots=True)
class Drawn:
    """The points of a line, (n,) each, and what an axis is to follow of them.

    low, high: NaN where nothing is known. above, under: revolution and value of the largest and
    the smallest flagged one beyond them, where there is one.
    """

    x: Floats
    y: Floats
    low: float = np.nan
    high: float = np.nan
    above: tuple[float, float] | None = None
    under: tuple[float, float] | None = None


def drawn(
    table: SeriesTable, column: str, rows: SeriesTable, view: View, buckets: int, scale: float = 1.0
) -> Drawn:
    """Return ``scale`` times a series in a view, in at most about ``buckets`` buckets.

    rows: say by their quality which revolutions are flagged. A bucket with such a one does not
    range the axis, unless every bucket has one.
    """
    start, stop = rows_in_view(table, view)
    envelope = table.series(column).envelope(start, stop, buckets)
    x, y = polyline(table.revolutions, envelope)
    y *= scale
    known = np.isfinite(envelope.low) & np.isfinite(envelope.high)
    if not known.any():
        return Drawn(x, y)
    at = table.revolutions[envelope.first]
    unflagged = known & ~_flagged(rows, view, buckets, at)
    fine = unflagged if unflagged.any() else known
    lows, highs = (scale * one.astype(np.float64) for one in (envelope.low, envelope.high))
    low, high = float(lows[fine].min()), float(highs[fine].max())
    least, most = int(np.nanargmin(lows)), int(np.nanargmax(highs))
    return Drawn(
        x,
        y,
        low,
        high,
        (float(at[most]), float(highs[most])) if highs[most] > high else None,
        (float(at[least]), float(lows[least])) if lows[least] < low else None,
    )


def banded(
    table: SeriesTable, column: str, doubt: str, view: View, buckets: int, scale: float = 1.0
) -> tuple[Floats, Floats, Floats]:
    """Return ``scale`` times a series less and plus its uncertainty: revolutions, low, high."""
    middle, half = (
        table.series(name).envelope(*rows_in_view(table, view), buckets) for name in (column, doubt)
    )
    low, high = (scale * one.astype(np.float64) for one in (middle.low, middle.high))
    doubt_high = scale * half.high.astype(np.float64)
    return table.revolutions[middle.first], low - doubt_high, high + doubt_high


def rows_in_view(table: SeriesTable, view: View) -> tuple[int, int]:
    """Return the rows between two revolutions, one more at each end."""
    start = int(np.searchsorted(table.revolutions, view[0])) - 1
    return max(start, 0), int(np.searchsorted(table.revolutions, view[1], side="right")) + 1


def _flagged(rows: SeriesTable, view: View, buckets: int, at: Floats) -> NDArray[np.bool_]:
    """Tell of buckets that begin at revolutions whether one of their rows is flagged."""
    if QUALITY not in rows.names or not len(rows):
        return np.zeros(len(at), dtype=bool)
    flags: Envelope = rows.series(QUALITY).envelope(*rows_in_view(rows, view), buckets)
    place = np.searchsorted(rows.revolutions[flags.first], at, side="right") - 1
    # Not known (NaN) is not flagged: files of before have no such column.
    return np.asarray(flags.high > 0.0)[np.maximum(place, 0)]
