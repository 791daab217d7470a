"""Marks on a plot: grid, limits, moments, spots, names at the curves.

They are painted directly from plain records, since a scene item for each would cost more than the
curves.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from operator import attrgetter
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QBrush, QColor, QFont, QFontMetrics, QPainter, QPolygonF

from rigapp.gui.look.fonts import sized
from rigapp.gui.plots.palette import LinePen, line_pen
from rigapp.presentation.tokens import CAPTION_PT, STEP, Theme
from rigapp.schema.messages import Severity
from rigapp.viewer.margins import watched
from rigapp.viewer.moments import MarkedMoment
from rigapp.viewer.news import News
from rigapp.viewer.shown import MARKS, Level, level_of_limit

Tick = tuple[float, str]
Floats = NDArray[np.floating]
Place = TypeVar("Place", float, Floats)
"""A value or an array of values on an axis."""
NEAREST = 1e-9
"""Minimum width of a range; a narrower one is empty."""
GROUND = 200
"""Opacity of the background of texts at a spot, of 255: a curve below stays visible."""
READOUT_GROUND = 230
"""Opacity of the background of the table at the cursors, of 255."""
CLOSEST = 0.8
"""Minimum distance of two names in line heights: the height of letters, which then do not touch."""
MOST_NAME = 24
"""Maximum number of characters at a moment; its full text is in the log."""


@dataclass(frozen=True, slots=True)
class CurveName:
    """The name of a curve, written on its right, and the last value of the curve."""

    text: str
    pen: LinePen
    at: float


@dataclass(frozen=True, slots=True)
class LimitLine:
    """A limit of the drawn quantity; below: the forbidden side is below it."""

    value: float
    words: str
    below: bool = False
    level: Level = Level.NORMAL


@dataclass(frozen=True, slots=True)
class Spot:
    """A point with a text; outside the range it is drawn as a caret at the edge."""

    x: float
    y: float
    text: str
    pen: LinePen


@dataclass(frozen=True, slots=True)
class Marks:
    """All marks of a plot."""

    names: tuple[CurveName, ...] = ()
    limits: tuple[LimitLine, ...] = ()
    moments: tuple[MarkedMoment, ...] = ()
    spots: tuple[Spot, ...] = ()

    @property
    def words(self) -> str:
        """Return the text of all marks for a screen reader."""
        parts = [mark.text for mark in self.names] + [mark.text for mark in self.spots]
        return ", ".join((*parts, *(limit.words for limit in self.limits)))


@dataclass(frozen=True, slots=True)
class PlotFrame:
    """Transform values to the screen: rectangle of the curves and ranges of both axes."""

    rect: QRectF
    x_range: tuple[float, float]
    y_range: tuple[float, float]

    def x(self, value: Place) -> Place:
        """Return the x of a value, pixels."""
        low, high = self.x_range
        return self.rect.left() + self.rect.width() * (value - low) / max(high - low, NEAREST)

    def y(self, value: Place) -> Place:
        """Return the y of a value, pixels from the top."""
        low, high = self.y_range
        return self.rect.bottom() - self.rect.height() * (value - low) / max(high - low, NEAREST)


def spread(wanted: Sequence[float], room: float, low: float, high: float) -> list[float]:
    """Return positions near the wanted ones, in order, at least ``room`` apart in low..high.

    Where there is too little room, they are equally spaced from low.
    """
    order = sorted(range(len(wanted)), key=lambda index: wanted[index])
    room = min(room, (high - low) / max(len(wanted) - 1, 1))
    positions = [0.0] * len(wanted)
    last = low - room
    for index in order:
        last = positions[index] = max(wanted[index], last + room)
    last = high + room
    for index in reversed(order):
        last = positions[index] = min(positions[index], last - room)
    return positions


@cache
def small_font(*, strong: bool = False) -> tuple[QFont, QFontMetrics]:
    """Return the font of marks with its metrics."""
    weight = QFont.Weight.DemiBold if strong else QFont.Weight.Normal
    font = sized(QFont(), CAPTION_PT, weight)
    return font, QFontMetrics(font)


@lru_cache(maxsize=256)
def _width_of_name(text: str) -> int:
    return small_font(strong=True)[1].horizontalAdvance(text)


def name_room(names: Sequence[CurveName]) -> int:
    """Return the width of names beside a plot, rounded to the layout grid."""
    widest = max((_width_of_name(name.text) for name in names), default=0)
    return -(-(widest + STEP) // (2 * STEP)) * 2 * STEP


def paint_axes(
    painter: QPainter, frame: PlotFrame, across: Sequence[Tick], up: Sequence[Tick], theme: Theme
) -> None:
    """Paint a faint line at every tick, a stronger one at zero, and the texts of the ticks."""
    rect = frame.rect
    font, metrics = small_font()
    painter.setFont(font)
    half, row = metrics.height() / 2.0, float(metrics.height())
    for value, text in across:
        x = frame.x(value)
        painter.setPen(line_pen(theme.grid))
        painter.drawLine(QPointF(x, rect.top()), QPointF(x, rect.bottom()))
        painter.setPen(QColor(theme.muted))
        width = metrics.horizontalAdvance(text)
        box = QRectF(x - width / 2.0, rect.bottom() + STEP // 2, width, row)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
    for value, text in up:
        y = frame.y(value)
        painter.setPen(line_pen(theme.strong if abs(value) < NEAREST else theme.grid))
        painter.drawLine(QPointF(rect.left(), y), QPointF(rect.right(), y))
        painter.setPen(QColor(theme.muted))
        box = QRectF(0.0, y - half, rect.left() - STEP // 2, row)
        painter.drawText(box, Qt.AlignmentFlag.AlignRight, text)
    painter.setPen(line_pen(theme.strong))
    painter.drawLine(rect.bottomLeft(), rect.bottomRight())


def paint_captions(painter: QPainter, frame: PlotFrame, across: str, up: str, theme: Theme) -> None:
    """Write the captions of the axes: below the ticks, and rotated at their left."""
    rect = frame.rect
    font, metrics = small_font()
    painter.setFont(font)
    painter.setPen(QColor(theme.muted))
    row = metrics.height()
    box = QRectF(rect.left(), rect.bottom() + row + STEP, rect.width(), row)
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, across)
    painter.save()
    painter.translate(0.0, rect.bottom())
    painter.rotate(-90.0)
    painter.drawText(QRectF(0.0, 0.0, rect.height(), row), Qt.AlignmentFlag.AlignCenter, up)
    painter.restore()


def paint_limits(
    painter: QPainter, frame: PlotFrame, limits: Sequence[LimitLine], theme: Theme
) -> None:
    """Paint the limits within the range, their forbidden side hatched."""
    low, high = frame.y_range
    for limit in limits:
        if not low <= limit.value <= high:
            continue
        colour = QColor(_limit_colour(limit, theme))
        hatch = QColor(_limit_colour(limit, theme) if limit.level else theme.strong)
        edge = frame.rect.bottom() if limit.below else frame.rect.top()
        at = frame.y(limit.value)
        side = QRectF(
            QPointF(frame.rect.left(), min(at, edge)), QPointF(frame.rect.right(), max(at, edge))
        )
        painter.fillRect(side, QBrush(hatch, Qt.BrushStyle.BDiagPattern))
        painter.setPen(line_pen(colour.name()))
        painter.drawLine(QPointF(side.left(), at), QPointF(side.right(), at))


def _limit_colour(limit: LimitLine, theme: Theme) -> str:
    return theme.ink(limit.level, theme.secondary)


def _clear_first(boxes: Sequence[QRectF], curves: Sequence[tuple[Floats, Floats]]) -> list[QRectF]:
    """Return rectangles ordered by the number of curve points in them, the fewest first.

    curves: x and y of each on the screen, arrays (n,).
    """
    points = np.zeros(len(boxes), np.int64)
    for x, y in curves:
        points += [
            np.count_nonzero(
                (x >= box.left()) & (x <= box.right()) & (y >= box.top()) & (y <= box.bottom())
            )
            for box in boxes
        ]
    return [boxes[index] for index in np.argsort(points, kind="stable")]


def paint_limit_words(
    painter: QPainter,
    frame: PlotFrame,
    limits: Sequence[LimitLine],
    theme: Theme,
    taken: list[QRectF],
    curves: Sequence[tuple[Floats, Floats]] = (),
) -> None:
    """Write the action of each limit in the range, clear of the curves where there is room.

    curves: x and y of each on the screen, arrays (n,).
    """
    low, high = frame.y_range
    font, metrics = small_font()
    painter.setFont(font)
    height = float(metrics.height())
    for limit in limits:
        if low <= limit.value <= high:
            at = frame.y(limit.value)
            tops = (at - height, at) if limit.below else (at, at - height)
            text, colour = f"{MARKS[limit.level]}{limit.words}", _limit_colour(limit, theme)
            boxes = _clear_first(_along(frame.rect, metrics, text, tops), curves)
            _words(painter, frame, text, colour, boxes, taken, _ground(theme))


def paint_next_limits(
    painter: QPainter,
    frame: PlotFrame,
    limits: Sequence[LimitLine],
    theme: Theme,
    taken: list[QRectF],
    curves: Sequence[tuple[Floats, Floats]] = (),
) -> None:
    """Write the next limits outside the range at its edges, clear of spots and curves.

    curves: see ``paint_limit_words``.
    """
    low, high = frame.y_range
    rect = frame.rect
    font, metrics = small_font()
    painter.setFont(font)
    height = float(metrics.height())
    value = attrgetter("value")
    above = min((limit for limit in limits if limit.value > high), key=value, default=None)
    under = max((limit for limit in limits if limit.value < low), key=value, default=None)
    for edge, caret, tops in (
        (above, "⌃", (rect.top(), rect.top() + height)),
        (under, "⌄", (rect.bottom() - height, rect.bottom() - 2 * height)),
    ):
        if edge is not None:
            text = f"{edge.words} {caret}"
            boxes = _clear_first(_along(rect, metrics, text, tops)[::-1], curves)
            _words(painter, frame, text, theme.muted, boxes, taken, _ground(theme))


def _along(rect: QRectF, metrics: QFontMetrics, text: str, tops: Sequence[float]) -> list[QRectF]:
    """Return rectangles for a text at given heights: left, centre, right."""
    width, height = float(metrics.horizontalAdvance(text)), float(metrics.height())
    lefts = (rect.left() + STEP, rect.center().x() - width / 2, rect.right() - width - STEP)
    return [QRectF(left, top, width, height) for left in lefts for top in tops]


def _words(
    painter: QPainter,
    frame: PlotFrame,
    text: str,
    colour: str,
    boxes: Iterable[QRectF],
    taken: list[QRectF],
    ground: QColor | None = None,
) -> None:
    """Write a text in the first free rectangle; ground: background painted over the curves."""
    rect = frame.rect.adjusted(0, -1, 0, 1)
    for box in boxes:
        if rect.contains(box) and not any(box.intersects(other) for other in taken):
            taken.append(box)
            if ground is not None:
                painter.fillRect(box, ground)
            painter.setPen(QColor(colour))
            painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
            return


def paint_names(
    painter: QPainter, frame: PlotFrame, names: Sequence[CurveName], theme: Theme
) -> None:
    """Write the names of curves at their right, without overlap.

    Where not all have room, the last ones are omitted.
    """
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    half = metrics.height() / 2.0
    low, high = frame.rect.top() + half, frame.rect.bottom() - half
    names = names[: 1 + int(max(high - low, 0.0) / (CLOSEST * metrics.height()))]
    wanted = [min(max(frame.y(name.at), low), high) for name in names]
    for name, at in zip(names, spread(wanted, metrics.height(), low, high), strict=True):
        painter.setPen(name.pen.ink(theme))
        foot = at - half + metrics.ascent()
        painter.drawText(QPointF(frame.rect.right() + STEP, foot), name.text)


def paint_cursor(painter: QPainter, frame: PlotFrame, at: float, text: str, theme: Theme) -> None:
    """Write the value of the cursor at its lower end."""
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    width, height = metrics.horizontalAdvance(text) + STEP, float(metrics.height())
    left = min(frame.x(at), frame.rect.right() - width)
    box = QRectF(left, frame.rect.bottom() - height, width, height)
    painter.fillRect(box, QColor(theme.text))
    painter.setPen(QColor(theme.base))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def paint_readout(
    painter: QPainter, frame: PlotFrame, positions: Sequence[float], rows: Sequence[Sequence[str]],
    theme: Theme,
) -> None:  # fmt: skip
    """Paint two cursors, numbered at their upper ends, and the table of their readings."""
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    for number, at in enumerate(positions, 1):
        if frame.x_range[0] <= at <= frame.x_range[1]:
            painter.setPen(line_pen(theme.highlight))
            x = frame.x(at)
            painter.drawLine(QPointF(x, frame.rect.top()), QPointF(x, frame.rect.bottom()))
            painter.setPen(QColor(theme.highlight))
            painter.drawText(QPointF(x + 2.0, frame.rect.top() + metrics.ascent()), str(number))
    widths = [
        max(map(metrics.horizontalAdvance, column)) + STEP for column in zip(*rows, strict=True)
    ]
    height = metrics.height()
    left, top = frame.rect.left() + STEP, frame.rect.top() + STEP
    if positions and frame.x(positions[0]) - left < sum(widths) + STEP:
        left = max(left, frame.rect.right() - sum(widths) - STEP)
    box = QRectF(left, top, sum(widths) + STEP, len(rows) * height + STEP)
    ground = QColor(theme.base)
    ground.setAlpha(READOUT_GROUND)
    painter.fillRect(box, ground)
    painter.setPen(QColor(theme.strong))
    painter.drawRect(box)
    painter.setPen(QColor(theme.text))
    for number, row in enumerate(rows):
        x = left + STEP / 2.0
        for column, (text, width) in enumerate(zip(row, widths, strict=True)):
            cell = QRectF(x, top + STEP / 2.0 + number * height, width, height)
            side = Qt.AlignmentFlag.AlignRight if column else Qt.AlignmentFlag.AlignLeft
            painter.drawText(cell, side | Qt.AlignmentFlag.AlignVCenter, text)
            x += width


def paint_spots(
    painter: QPainter, frame: PlotFrame, spots: Sequence[Spot], theme: Theme, taken: list[QRectF]
) -> None:
    """Paint spots with their texts; one outside the range as a caret at the edge."""
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    rect, size = frame.rect, STEP / 2.0
    for spot in spots:
        x, y = frame.x(spot.x), frame.y(spot.y)
        if not rect.left() <= x <= rect.right():
            continue
        colour = spot.pen.ink(theme)
        painter.setPen(colour)
        over, under = y < rect.top(), y > rect.bottom()
        y = min(max(y, rect.top() + size), rect.bottom() - size)
        if over or under:
            tip = y - size if over else y + size
            wings = [QPointF(x + side * size, 2 * y - tip) for side in (-1, 1)]
            painter.drawPolyline(QPolygonF([wings[0], QPointF(x, tip), wings[1]]))
        else:
            painter.setBrush(QColor(theme.base))
            painter.drawEllipse(QPointF(x, y), size, size)
        width, height = float(metrics.horizontalAdvance(spot.text)), float(metrics.height())
        boxes = [
            QRectF(left, top, width, height)
            for top in (y - size - height, y - size, y + size)
            for left in (x + STEP, x - STEP - width)
        ]
        taken.append(QRectF(x - size, y - size, 2 * size, 2 * size))
        _words(painter, frame, spot.text, colour.name(), boxes, taken, _ground(theme))


def _ground(theme: Theme) -> QColor:
    """Return the background of texts over curves."""
    ground = QColor(theme.base)
    ground.setAlpha(GROUND)
    return ground


def paint_moments(
    painter: QPainter, frame: PlotFrame, moments: Sequence[MarkedMoment], theme: Theme
) -> None:
    """Paint a line at every moment, with its shape and text in the lane above the plot."""
    low, high = frame.x_range
    shown = [moment for moment in moments if low <= moment.revolution <= high]
    font, metrics = small_font()
    painter.setFont(font)
    middle = frame.rect.top() - metrics.height() / 2.0 - 2.0
    free = frame.rect.right()
    # From the right, so that the newest keep their texts where not all have room.
    for moment in reversed(shown):
        x = frame.x(moment.revolution)
        critical = moment.severity is Severity.CRITICAL
        painter.setPen(line_pen(theme.critical if critical else theme.muted, dotted=not critical))
        painter.drawLine(QPointF(x, frame.rect.top()), QPointF(x, frame.rect.bottom()))
        colour = QColor(theme.critical if critical else theme.secondary)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
        painter.drawPolygon(_shape(moment.severity, x, middle))
        text = moment.words
        text = text if len(text) <= MOST_NAME else text[: MOST_NAME - 1] + "…"
        if x + STEP + metrics.horizontalAdvance(text) <= free:
            painter.setPen(colour)
            top = middle - metrics.height() / 2.0
            painter.drawText(QPointF(x + STEP, top + metrics.ascent()), text)
        free = x - STEP


def trip_lines(frame: PlotFrame, moments: Sequence[MarkedMoment]) -> list[QRectF]:
    """Return the rectangles of the lines of critical moments, which texts must not cover."""
    shown = [moment.revolution for moment in moments if moment.severity is Severity.CRITICAL]
    return [QRectF(frame.x(at) - 1.0, frame.rect.top(), 2.0, frame.rect.height()) for at in shown]


def _shape(severity: Severity | None, x: float, y: float) -> QPolygonF:
    """Return the shape of a severity: flag (note), triangle (warning), diamond (critical)."""
    half = STEP / 2.0
    corners = {
        None: ((0, -1), (1.6, -0.4), (0, 0.2), (0, 1.2), (-0.3, 1.2), (-0.3, -1)),
        Severity.WARNING: ((0, -1), (1, 1), (-1, 1)),
        Severity.CRITICAL: ((0, -1.2), (1.2, 0), (0, 1.2), (-1.2, 0)),
    }[severity]
    return QPolygonF([QPointF(x + half * right, y + half * down) for right, down in corners])


def alarm_token(news: News) -> tuple[tuple[str, str], ...]:
    """Return the data that determine the colours of limits; their change requires a redraw."""
    alarms = news.status.alarms if news.status is not None else ()
    return tuple((alarm.key, alarm.state) for alarm in alarms)


def limit_lines(news: News, columns: Collection[str]) -> tuple[LimitLine, ...]:
    """Return the limits of columns as lines of a plot, each coloured by its own alarm."""
    alarms = news.status.alarms if news.status is not None else ()
    return tuple(
        LimitLine(margin.limit, margin.words, margin.below, level_of_limit(alarms, margin.key))
        for margin in watched(news)
        if margin.column in columns
    )
