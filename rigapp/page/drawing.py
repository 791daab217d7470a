"""Draw curves as SVG: lines and words alone, every colour from the page's style sheet.

A drawing is as wide as a telephone and grows with its place, so that one serves every page.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from rigapp.presentation.numbers import axis_number
from rigapp.viewer.ranges import SteadyRange, round_places

Floats = NDArray[np.float64]

WIDTH, HEIGHT = 344, 196
LEFT, RIGHT, TOP, BOTTOM = 50, 8, 8, 34
"""Around the curves: numbers and words of the axes."""
PARTS_ACROSS, PARTS_UP = 4, 4
"""About so many parts has an axis: numbers of five digits do not meet."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A line, (n,) each, NaN where it breaks; role: of its colour, text: in the legend."""

    x: Floats
    y: Floats
    role: str
    text: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Ribbon:
    """What lies between two lines, (n,) each, NaN where it breaks; role: of its colour."""

    x: Floats
    low: Floats
    high: Floats
    role: str


@dataclass(frozen=True, slots=True)
class Drawing:
    """What is drawn. across: the range of x; low, high: what the axis of y is to show at least."""

    title: str
    x_axis: str
    y_axis: str
    across: tuple[float, float]
    low: float
    high: float
    curves: Sequence[Curve]
    ribbons: Sequence[Ribbon] = ()


def svg(drawing: Drawing, steady: SteadyRange) -> str:
    """Return a drawing as an SVG element; steady: keeps the axis of y from one to the next."""
    steady.update(drawing.low, drawing.high)
    frame = _Frame(drawing.across, steady.range or (0.0, 1.0))
    curves = [f'<path class="ribbon {one.role}" d="{frame.area(one)}"/>' for one in drawing.ribbons]
    curves += [
        f'<path class="curve {one.role}" d="{frame.line(one.x, one.y)}"/>' for one in drawing.curves
    ]
    inner = "".join(curves)
    box = f'x="{LEFT}" y="{TOP}" width="{frame.width}" height="{frame.height}"'
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(drawing.title)}">'
        f"{frame.axes(drawing.x_axis, drawing.y_axis)}<svg {box}>{inner}</svg></svg>"
    )


class _Frame:
    """Where values stand in a drawing."""

    def __init__(self, across: tuple[float, float], upward: tuple[float, float]) -> None:
        self.width, self.height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
        self._across, self._upward = across, upward

    def line(self, x: Floats, y: Floats) -> str:
        """Return the path of a line; what is not known breaks it."""
        words, pen = [], "M"
        for one, other in zip(self._x(x), self._y(y), strict=True):
            if math.isfinite(one) and math.isfinite(other):
                words.append(f"{pen}{one:.1f} {other:.1f}")
                pen = "L"
            else:
                pen = "M"
        return "".join(words)

    def area(self, ribbon: Ribbon) -> str:
        """Return the path around a ribbon, one closed part after the other."""
        known = np.isfinite(ribbon.low) & np.isfinite(ribbon.high)
        edges = np.flatnonzero(np.diff(np.concatenate(([False], known, [False])).astype(np.int8)))
        words = []
        for start, stop in edges.reshape(-1, 2):
            x = np.concatenate((ribbon.x[start:stop], ribbon.x[start:stop][::-1]))
            y = np.concatenate((ribbon.low[start:stop], ribbon.high[start:stop][::-1]))
            words.append(f"{self.line(x, y)}Z")
        return "".join(words)

    def axes(self, x_axis: str, y_axis: str) -> str:
        """Return the grid with its numbers and words."""
        right, bottom = LEFT + self.width, TOP + self.height
        words = []
        step, places = round_places(*self._upward, PARTS_UP)
        for value, y in zip(places, TOP + self._y(np.array(places)), strict=True):
            words.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{right}"/>')
            number = axis_number(value, step)
            words.append(f'<text x="{LEFT - 5}" y="{y + 4:.1f}" class="end">{number}</text>')
        step, places = round_places(*self._across, PARTS_ACROSS)
        for value, x in zip(places, LEFT + self._x(np.array(places)), strict=True):
            words.append(f'<path class="grid" d="M{x:.1f} {TOP}V{bottom}"/>')
            number = axis_number(value, step)
            words.append(f'<text x="{x:.1f}" y="{bottom + 14}" class="middle">{number}</text>')
        middle = LEFT + self.width / 2
        words.append(f'<text x="{middle}" y="{HEIGHT - 5}" class="middle">{escape(x_axis)}</text>')
        turned = f'transform="translate(11 {TOP + self.height / 2}) rotate(-90)"'
        words.append(f'<text {turned} class="middle">{escape(y_axis)}</text>')
        return "".join(words)

    def _x(self, values: Floats) -> Floats:
        low, high = self._across
        return (values - low) * (self.width / (high - low))

    def _y(self, values: Floats) -> Floats:
        low, high = self._upward
        return (high - values) * (self.height / (high - low))
