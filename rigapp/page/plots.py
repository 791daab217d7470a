"""Plots of a rig: force over the crank angle with the model, and trends with bands."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

from rigapp.presentation.numbers import COEFFICIENT_SCALE, COEFFICIENT_UNIT, axis_number
from rigapp.viewer.channels import SIZE
from rigapp.viewer.comparison import CURVES, RevolutionCurves, binned, compose, stacked
from rigapp.viewer.frames import COMPONENT_NAMES, ForceFrame
from rigapp.viewer.knownwear import COEFFICIENT, REMAINING, newest_wear
from rigapp.viewer.lines import EVERYTHING, Drawn, Flagged, banded, drawn, rows_in_view
from rigapp.viewer.news import News
from rigapp.viewer.quantities import (
    LARGEST,
    TrendLine,
    TrendQuantity,
    trend_quantities,
)
from rigapp.viewer.ranges import SteadyRange, round_places
from rigapp.viewer.series import SeriesTable

# Curves are drawn as SVG: lines and words, every colour from the page's style sheet. A drawing is
# as wide as a telephone and scales with its place, so that one is right for every page.

Floats = NDArray[np.float64]

WIDTH, HEIGHT = 344, 196
LEFT, RIGHT, TOP, BOTTOM = 50, 8, 8, 34
"""Around the curves: numbers and words of the axes."""
PARTS_ACROSS, PARTS_UP = 4, 4
"""Approximate number of parts of an axis: numbers of five digits do not touch."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """A line, (n,) each, NaN where it breaks; role: of its colour, text: in the legend."""

    x: Floats
    y: Floats
    role: str
    text: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Ribbon:
    """The area between two lines, (n,) each, NaN where it breaks; role: of its colour."""

    x: Floats
    low: Floats
    high: Floats
    role: str


@dataclass(frozen=True, slots=True)
class Drawing:
    """Contents of a drawing. across: the range of x; low, high: least range of the y axis."""

    title: str
    x_axis: str
    y_axis: str
    across: tuple[float, float]
    low: float
    high: float
    curves: Sequence[Curve]
    ribbons: Sequence[Ribbon] = ()


def svg(drawing: Drawing, steady: SteadyRange) -> str:
    """Return a drawing as an SVG element; steady: keeps the y axis from one to the next."""
    steady.update(drawing.low, drawing.high)
    frame = _Frame(drawing.across, steady.range or (0.0, 1.0))
    curves = [
        f'<path class="ribbon {ribbon.role}" d="{frame.area(ribbon)}"/>'
        for ribbon in drawing.ribbons
    ]
    curves += [
        f'<path class="curve {curve.role}" d="{frame.line(curve.x, curve.y)}"/>'
        for curve in drawing.curves
    ]
    inner = "".join(curves)
    box = f'x="{LEFT}" y="{TOP}" width="{frame.width}" height="{frame.height}"'
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(drawing.title)}">'
        f"{frame.axes(drawing.x_axis, drawing.y_axis)}<svg {box}>{inner}</svg></svg>"
    )


class _Frame:
    """Places of values in a drawing."""

    def __init__(self, across: tuple[float, float], upward: tuple[float, float]) -> None:
        self.width, self.height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
        self._across, self._upward = across, upward

    def line(self, x: Floats, y: Floats) -> str:
        """Return the path of a line, interrupted at NaN."""
        words, pen = [], "M"
        for x_px, y_px in zip(self._x(x), self._y(y), strict=True):
            if math.isfinite(x_px) and math.isfinite(y_px):
                words.append(f"{pen}{x_px:.1f} {y_px:.1f}")
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


BIN_DEG = 2.0
"""On a telephone a revolution is less than 360 pixels wide."""
BUCKETS = 150
"""Pairs of minimum and maximum that fill a drawing's width."""
FORCE_SPAN_N = 5.0
"""As small a range as the window draws: about twice the noise of a good load cell."""
FEWEST_ROWS = 2
"""A line has two points."""

_NAMES = dict(zip(CURVES, ("|F|", *COMPONENT_NAMES[ForceFrame.CRANK]), strict=True))
_ROLES = dict(zip(CURVES, ("main", "first", "second"), strict=True))
_LIMITED = {
    COEFFICIENT: TrendQuantity(
        "Wear coefficient, 95 %",
        f"K ({COEFFICIENT_UNIT})",
        0.1,
        (),
        (TrendLine("", "first", ""),),
        COEFFICIENT_SCALE,
    ),
    REMAINING: TrendQuantity(
        "Revolutions that remain, 95 %", "Revolutions", 100.0, (), (TrendLine("", "first", ""),)
    ),
}
"""Quantities with their limits in separate columns."""


@dataclass(frozen=True, slots=True)
class Plot:
    """A drawing with its title and legend (role and words)."""

    title: str
    legend: tuple[tuple[str, str], ...]
    picture: str


class Painter:
    """Draw the plots of one rig; axes are steady between updates."""

    def __init__(self) -> None:
        self._steady: dict[str, SteadyRange] = {}

    def forget(self) -> None:
        """Start with new axes: another test is shown."""
        self._steady.clear()

    def force(self, news: News) -> Plot | None:
        """Return the newest revolution with the model, None before the first one."""
        cycle, prediction = news.data.cycle, news.data.prediction
        if prediction is not None:
            cycle = news.data.partner(prediction) or cycle
        if cycle is None or len(cycle.angle_deg) < FEWEST_ROWS:
            return None
        if prediction is not None and SIZE not in prediction.curves:
            prediction = None
        shown = compose(cycle, prediction, ForceFrame.CRANK, None)
        title = f"Force over the crank angle, revolution {shown.measured_revolution}"
        curves = list(_revolution(shown, stale=news.stale))
        return self._plot("force", _fitted(title, "Crank angle (°)", "Force (N)", curves), 0.0)

    def trends(self, news: News) -> list[Plot]:
        """Return the trends that have data."""
        quantities = trend_quantities(news.data.channels)
        free = [channel.name for channel in news.data.channels.free]
        names = [name for name in (LARGEST, "wear", "residual", *free) if name in quantities]
        requested = {name: quantities[name] for name in names} | _LIMITED
        result = (self._trend(name, quantity, news) for name, quantity in requested.items())
        return [plot for plot in result if plot is not None]

    def _trend(self, name: str, quantity: TrendQuantity, news: News) -> Plot | None:
        rows, predictions = news.data.rows, news.data.predictions
        if len(rows) < FEWEST_ROWS or (name in _LIMITED and not newest_wear(predictions).known):
            return None
        flagged = Flagged(rows, EVERYTHING, BUCKETS)
        if name in _LIMITED:
            lines = [(TrendLine(name, "first", "most likely"), predictions)]
        else:
            lines = [(line, rows) for line in quantity.measured]
            lines += [(line, predictions) for line in quantity.predicted]
        lines = [(line, table) for line, table in lines if line.column in table.names]
        seen = [
            (line, table, drawn(table, line.column, flagged, EVERYTHING, BUCKETS, quantity.scale))
            for line, table in lines
        ]
        seen = [curve for curve in seen if np.isfinite(curve[2].low)]
        if not seen:
            return None
        ribbons = [
            ribbon for line, table, _ in seen for ribbon in _ribbons(name, line, table, quantity)
        ]
        lows, highs = zip(*((drawn.low, drawn.high) for _, _, drawn in seen), strict=True)
        drawing = Drawing(
            quantity.title,
            "Revolution",
            quantity.axis,
            (float(rows.revolutions[0]), float(rows.revolutions[-1])),
            min(lows),
            max(highs),
            [_curve(line, table is predictions, curve) for line, table, curve in seen],
            ribbons,
        )
        return self._plot(name, drawing, quantity.minimum_span)

    def _plot(self, name: str, drawing: Drawing, span: float) -> Plot:
        steady = self._steady.setdefault(name, SteadyRange(span or FORCE_SPAN_N))
        legend = tuple((curve.role, curve.text) for curve in drawing.curves if curve.text)
        return Plot(drawing.title, legend, svg(drawing, steady))


def _revolution(shown: RevolutionCurves, *, stale: bool) -> Iterator[Curve]:
    """Yield the model below the measurement."""
    if shown.model is not None and shown.model_angle_deg is not None:
        words = f"model of revolution {shown.model_revolution}"
        role = "stale" if stale else "model"
        for name in CURVES:
            text = (f"{words}, behind" if stale else words) if name == SIZE else ""
            yield Curve(shown.model_angle_deg, shown.model[name], role, text)
    angle, means = binned(shown.angle_deg, stacked(shown.measured), BIN_DEG)
    for name, values in zip(CURVES, means, strict=True):
        yield Curve(angle, values, _ROLES[name], _NAMES[name])


def _fitted(title: str, x_axis: str, y_axis: str, curves: list[Curve]) -> Drawing:
    """Return a drawing of one revolution whose axis includes every curve."""
    values = np.concatenate([curve.y for curve in curves])
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if values.size else (np.nan, np.nan)
    return Drawing(title, x_axis, y_axis, (0.0, 360.0), low, high, curves)


def _curve(line: TrendLine, predicted: bool, curve: Drawn) -> Curve:
    """Return a trend's line; a line of the model always has the model's colour."""
    measured = not predicted or line.column.startswith(("measured_", "residual", *_LIMITED))
    role = line.role if measured else "model"
    return Curve(curve.x, curve.y, role, line.text if measured else "model")


def _ribbons(
    name: str, line: TrendLine, table: SeriesTable, quantity: TrendQuantity
) -> Iterable[Ribbon]:
    """Return the band of a line, if it has one: its uncertainty, or its separate limits."""
    if name in _LIMITED:
        rows = rows_in_view(table, EVERYTHING)
        low, high = (
            table.series(f"{name}_{side}").envelope(*rows, BUCKETS) for side in ("low", "high")
        )
        least, most = (quantity.scale * y.astype(np.float64) for y in (low.low, high.high))
        yield Ribbon(table.revolutions[low.first], least, most, line.role)
    elif line.doubt and line.doubt in table.names:
        x, least, most = banded(table, line.column, line.doubt, EVERYTHING, BUCKETS, quantity.scale)
        measured = line.column.startswith("measured_")
        yield Ribbon(x, least, most, line.role if measured else "model")
