"""Two cursors on a plot: positions, values of each curve, and differences."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from rigapp.gui.plots.curves import Floats
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.palette import LinePen
from rigapp.presentation.numbers import UNKNOWN, true_minus
from rigapp.presentation.translation import tr

MOST_CURVES = 4
"""Maximum number of curves read at the cursors: a longer table would cover the plot."""
SMALL_STEP, LARGE_STEP = 1.0 / 200.0, 1.0 / 20.0
"""Steps of a cursor moved by keys, shares of the visible range."""
FIRST_AT, SECOND_AT = 1.0 / 3.0, 2.0 / 3.0
"""Initial positions of the cursors, shares of the visible range."""


class PlottedCurve(Protocol):
    """Points of a curve, (n,) each."""

    @property
    def x(self) -> Floats:
        """Return the x values."""
        ...

    @property
    def y(self) -> Floats:
        """Return the y values."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class ItemPoints:
    """Points of an item of the plotting library, (n,) each."""

    x: Floats
    y: Floats


NamedCurve = tuple[str, PlottedCurve]


def named_curves(
    drawn: Iterable[tuple[PlottedCurve, LinePen | None]], names: Sequence[CurveName]
) -> Iterator[NamedCurve]:
    """Yield the drawn curves with their names or numbers.

    A name belongs to the curve with the same pen whose last value is nearest.
    """
    for number, (trace, pen) in enumerate(drawn, 1):
        if not len(trace.x):
            continue
        known = trace.y[np.isfinite(trace.y)]
        end = float(known[-1]) if len(known) else math.nan
        own = [name for name in names if name.pen == pen]
        nearest = min(own, key=lambda name: abs(name.at - end), default=None)
        yield nearest.text if nearest is not None else tr("curve {}", number), trace


def value_at(curve: PlottedCurve, at: float) -> float:
    """Return the value of a curve at the point nearest to ``at``; NaN beyond its ends."""
    known = np.flatnonzero(np.isfinite(curve.x) & np.isfinite(curve.y))
    if not known.size or not curve.x[known].min() <= at <= curve.x[known].max():
        return math.nan
    return float(curve.y[known[np.argmin(np.abs(curve.x[known] - at))]])


@dataclass(slots=True)
class CursorPair:
    """Up to two cursors on the x axis; chosen: the one moved by keys."""

    places: list[float] = field(default_factory=list)
    chosen: int = 0

    def put(self, at: float) -> None:
        """Place the first cursor, then the second; later calls move the nearer one."""
        if len(self.places) < 2:
            self.places.append(at)
            self.chosen = len(self.places) - 1
            return
        self.chosen = int(abs(self.places[1] - at) < abs(self.places[0] - at))
        self.places[self.chosen] = at

    def show(self, low: float, high: float) -> None:
        """Place both cursors within the visible range."""
        self.places = [low + share * (high - low) for share in (FIRST_AT, SECOND_AT)]
        self.chosen = 1

    def choose(self, number: int, low: float, high: float) -> None:
        """Select cursor 0 or 1; place both if there are none."""
        if len(self.places) < 2:
            self.show(low, high)
        self.chosen = number

    def move(self, by: float) -> None:
        """Move the selected cursor."""
        if self.places:
            self.places[self.chosen] += by

    def clear(self) -> None:
        """Remove both cursors."""
        self.places, self.chosen = [], 0


def readout(pair: CursorPair, across: str, curves: Iterable[NamedCurve]) -> list[list[str]]:
    """Return a table: x and each curve at both cursors, and the difference.

    across: the quantity of x. curves: in the order of drawing, the last one on top.
    """
    rows = [["", *(str(number + 1) for number in range(len(pair.places)))]]
    read = [(across, list(pair.places))]
    top = dict(curves)  # of curves with the same name, the last one, on top
    for name, curve in list(reversed(top.items()))[:MOST_CURVES]:
        read.append((name, [value_at(curve, at) for at in pair.places]))
    for name, values in read:
        rows.append([name, *map(_number, values)])
    if len(pair.places) == 2:
        rows[0].append("2 \u2212 1")
        for row, (_, values) in zip(rows[1:], read, strict=False):
            row.append(_number(values[1] - values[0]))
    return rows


def _number(value: float) -> str:
    return true_minus(f"{value:.5g}") if math.isfinite(value) else UNKNOWN
