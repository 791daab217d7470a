"""What stands on a plot beside its curves: grid, limits, moments, spots, names at the curves.

All of it is painted straight from plain records, since an item of the scene for each would cost
more than the curves.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
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
"""A place on an axis, and what stands there."""
NEAREST = 1e-9
"""Of a range: what is less wide is none."""
GROUND = 200
"""Opacity of what lies below the words of a spot, of 255: a curve there is still seen."""
READOUT_GROUND = 230
"""Opacity of what lies below the table at the cursors, of 255."""
CLOSEST = 0.8
"""Of a line's height, between two names: its letters are so high, and do not touch."""
MOST_NAME = 24
"""Characters of the words at a moment; its whole text stands in the log."""


@dataclass(frozen=True, slots=True)
class CurveName:
    """The name of a curve, at the right of it, and the value at which the curve ends."""

    text: str
    pen: LinePen
    at: float


@dataclass(frozen=True, slots=True)
class LimitLine:
    """A limit of what is drawn; below: the forbidden side is below it."""

    value: float
    words: str
    below: bool = False
    level: Level = Level.NORMAL


@dataclass(frozen=True, slots=True)
class Spot:
    """A point that is worth its words; beyond the range it stands as a caret at the edge."""

    x: float
    y: float
    text: str
    pen: LinePen


@dataclass(frozen=True, slots=True)
class Marks:
    """Everything that stands on a plot beside its curves."""

    names: tuple[CurveName, ...] = ()
    limits: tuple[LimitLine, ...] = ()
    moments: tuple[MarkedMoment, ...] = ()
    spots: tuple[Spot, ...] = ()

    @property
    def words(self) -> str:
        """Return all of it for a screen reader."""
        parts = [one.text for one in self.names] + [one.text for one in self.spots]
        return ", ".join((*parts, *(one.words for one in self.limits)))


@dataclass(frozen=True, slots=True)
class PlotFrame:
    """Where values are on the screen: the rectangle of the curves and the ranges of both axes."""

    rect: QRectF
    x_range: tuple[float, float]
    y_range: tuple[float, float]

    def x(self, value: Place) -> Place:
        """Return the place of a value across."""
        low, high = self.x_range
        return self.rect.left() + self.rect.width() * (value - low) / max(high - low, NEAREST)

    def y(self, value: Place) -> Place:
        """Return the place of a value from above."""
        low, high = self.y_range
        return self.rect.bottom() - self.rect.height() * (value - low) / max(high - low, NEAREST)


def spread(wanted: Sequence[float], room: float, low: float, high: float) -> list[float]:
    """Return places near the wanted ones, in their order, that are ``room`` apart in low..high.

    Where there is too little room for all, they are equally close from low on.
    """
    order = sorted(range(len(wanted)), key=lambda one: wanted[one])
    room = min(room, (high - low) / max(len(wanted) - 1, 1))
    found = [0.0] * len(wanted)
    last = low - room
    for one in order:
        last = found[one] = max(wanted[one], last + room)
    last = high + room
    for one in reversed(order):
        last = found[one] = min(found[one], last - room)
    return found


@cache
def small_font(*, strong: bool = False) -> tuple[QFont, QFontMetrics]:
    """Return the font of what stands on a plot, and how large its letters are."""
    weight = QFont.Weight.DemiBold if strong else QFont.Weight.Normal
    font = sized(QFont(), CAPTION_PT, weight)
    return font, QFontMetrics(font)


@lru_cache(maxsize=256)
def _width_of_name(text: str) -> int:
    return small_font(strong=True)[1].horizontalAdvance(text)


def name_room(names: Sequence[CurveName]) -> int:
    """Return the width that names need beside a plot, on the grid."""
    widest = max((_width_of_name(one.text) for one in names), default=0)
    return -(-(widest + STEP) // (2 * STEP)) * 2 * STEP


def paint_axes(
    painter: QPainter, frame: PlotFrame, across: Sequence[Tick], up: Sequence[Tick], theme: Theme
) -> None:
    """Paint a calm line at every tick, a stronger one at zero, and what stands at the ticks."""
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
        place = QRectF(x - width / 2.0, rect.bottom() + STEP // 2, width, row)
        painter.drawText(place, Qt.AlignmentFlag.AlignCenter, text)
    for value, text in up:
        y = frame.y(value)
        painter.setPen(line_pen(theme.strong if abs(value) < NEAREST else theme.grid))
        painter.drawLine(QPointF(rect.left(), y), QPointF(rect.right(), y))
        painter.setPen(QColor(theme.muted))
        place = QRectF(0.0, y - half, rect.left() - STEP // 2, row)
        painter.drawText(place, Qt.AlignmentFlag.AlignRight, text)
    painter.setPen(line_pen(theme.strong))
    painter.drawLine(rect.bottomLeft(), rect.bottomRight())


def paint_captions(painter: QPainter, frame: PlotFrame, across: str, up: str, theme: Theme) -> None:
    """Write what is drawn along the axes: below the ticks, and turned at the left of them."""
    rect = frame.rect
    font, metrics = small_font()
    painter.setFont(font)
    painter.setPen(QColor(theme.muted))
    row = metrics.height()
    place = QRectF(rect.left(), rect.bottom() + row + STEP, rect.width(), row)
    painter.drawText(place, Qt.AlignmentFlag.AlignCenter, across)
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
    for one in limits:
        if not low <= one.value <= high:
            continue
        colour = QColor(_limit_colour(one, theme))
        hatch = QColor(_limit_colour(one, theme) if one.level else theme.strong)
        edge = frame.rect.bottom() if one.below else frame.rect.top()
        at = frame.y(one.value)
        side = QRectF(
            QPointF(frame.rect.left(), min(at, edge)), QPointF(frame.rect.right(), max(at, edge))
        )
        painter.fillRect(side, QBrush(hatch, Qt.BrushStyle.BDiagPattern))
        painter.setPen(line_pen(colour.name()))
        painter.drawLine(QPointF(side.left(), at), QPointF(side.right(), at))


def _limit_colour(limit: LimitLine, theme: Theme) -> str:
    return theme.ink(limit.level, theme.secondary)


def _clear_first(places: Sequence[QRectF], curves: Sequence[tuple[Floats, Floats]]) -> list[QRectF]:
    """Return places in their order, those first through which the fewest points of curves go.

    curves: x and y of each on the screen, arrays (n,).
    """
    points = np.zeros(len(places), np.int64)
    for x, y in curves:
        points += [
            np.count_nonzero(
                (x >= one.left()) & (x <= one.right()) & (y >= one.top()) & (y <= one.bottom())
            )
            for one in places
        ]
    return [places[at] for at in np.argsort(points, kind="stable")]


def paint_limit_words(
    painter: QPainter,
    frame: PlotFrame,
    limits: Sequence[LimitLine],
    theme: Theme,
    taken: list[QRectF],
    curves: Sequence[tuple[Floats, Floats]] = (),
) -> None:
    """Write what happens at each limit in the range, beside the curves where there is room.

    curves: x and y of each on the screen, arrays (n,).
    """
    low, high = frame.y_range
    font, metrics = small_font()
    painter.setFont(font)
    height = float(metrics.height())
    for one in limits:
        if low <= one.value <= high:
            at = frame.y(one.value)
            tops = (at - height, at) if one.below else (at, at - height)
            text, colour = f"{MARKS[one.level]}{one.words}", _limit_colour(one, theme)
            places = _clear_first(_along(frame.rect, metrics, text, tops), curves)
            _words(painter, frame, text, colour, places, taken, _ground(theme))


def paint_next_limits(
    painter: QPainter,
    frame: PlotFrame,
    limits: Sequence[LimitLine],
    theme: Theme,
    taken: list[QRectF],
    curves: Sequence[tuple[Floats, Floats]] = (),
) -> None:
    """Write at the edges of the range the next limits beyond it, beside spots and curves.

    curves: see ``paint_limit_words``.
    """
    low, high = frame.y_range
    rect = frame.rect
    font, metrics = small_font()
    painter.setFont(font)
    height = float(metrics.height())
    above = min((one for one in limits if one.value > high), key=_value, default=None)
    under = max((one for one in limits if one.value < low), key=_value, default=None)
    for edge, caret, tops in (
        (above, "⌃", (rect.top(), rect.top() + height)),
        (under, "⌄", (rect.bottom() - height, rect.bottom() - 2 * height)),
    ):
        if edge is not None:
            text = f"{edge.words} {caret}"
            places = _clear_first(_along(rect, metrics, text, tops)[::-1], curves)
            _words(painter, frame, text, theme.muted, places, taken, _ground(theme))


def _value(one: LimitLine) -> float:
    return one.value


def _along(rect: QRectF, metrics: QFontMetrics, text: str, tops: Sequence[float]) -> list[QRectF]:
    """Return where words may stand at heights: at the left, in the middle, at the right."""
    width, height = float(metrics.horizontalAdvance(text)), float(metrics.height())
    lefts = (rect.left() + STEP, rect.center().x() - width / 2, rect.right() - width - STEP)
    return [QRectF(left, top, width, height) for left in lefts for top in tops]


def _words(
    painter: QPainter,
    frame: PlotFrame,
    text: str,
    colour: str,
    places: Iterable[QRectF],
    taken: list[QRectF],
    ground: QColor | None = None,
) -> None:
    """Write words at the first place that is free; ground: laid below them, over the curves."""
    rect = frame.rect.adjusted(0, -1, 0, 1)
    for place in places:
        if rect.contains(place) and not any(place.intersects(one) for one in taken):
            taken.append(place)
            if ground is not None:
                painter.fillRect(place, ground)
            painter.setPen(QColor(colour))
            painter.drawText(place, Qt.AlignmentFlag.AlignCenter, text)
            return


def paint_names(
    painter: QPainter, frame: PlotFrame, names: Sequence[CurveName], theme: Theme
) -> None:
    """Write the names of curves at the right of them, apart from each other.

    Where not all have room the last ones are left out.
    """
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    half = metrics.height() / 2.0
    low, high = frame.rect.top() + half, frame.rect.bottom() - half
    names = names[: 1 + int(max(high - low, 0.0) / (CLOSEST * metrics.height()))]
    wanted = [min(max(frame.y(one.at), low), high) for one in names]
    for one, at in zip(names, spread(wanted, metrics.height(), low, high), strict=True):
        painter.setPen(one.pen.ink(theme))
        painter.drawText(QPointF(frame.rect.right() + STEP, at - half + metrics.ascent()), one.text)


def paint_cursor(painter: QPainter, frame: PlotFrame, at: float, text: str, theme: Theme) -> None:
    """Write where the cursor is, at its foot."""
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    width, height = metrics.horizontalAdvance(text) + STEP, float(metrics.height())
    left = min(frame.x(at), frame.rect.right() - width)
    place = QRectF(left, frame.rect.bottom() - height, width, height)
    painter.fillRect(place, QColor(theme.text))
    painter.setPen(QColor(theme.base))
    painter.drawText(place, Qt.AlignmentFlag.AlignCenter, text)


def paint_readout(
    painter: QPainter, frame: PlotFrame, places: Sequence[float], rows: Sequence[Sequence[str]],
    theme: Theme,
) -> None:  # fmt: skip
    """Paint two cursors, numbered at their heads, and the table of what is read at them."""
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    for number, at in enumerate(places, 1):
        if frame.x_range[0] <= at <= frame.x_range[1]:
            painter.setPen(line_pen(theme.highlight))
            x = frame.x(at)
            painter.drawLine(QPointF(x, frame.rect.top()), QPointF(x, frame.rect.bottom()))
            painter.setPen(QColor(theme.highlight))
            painter.drawText(QPointF(x + 2.0, frame.rect.top() + metrics.ascent()), str(number))
    widths = [
        max(metrics.horizontalAdvance(row[at]) for row in rows) + STEP for at in range(len(rows[0]))
    ]
    height = metrics.height()
    left, top = frame.rect.left() + STEP, frame.rect.top() + STEP
    if places and frame.x(places[0]) - left < sum(widths) + STEP:
        left = max(left, frame.rect.right() - sum(widths) - STEP)
    box = QRectF(left, top, sum(widths) + STEP, len(rows) * height + STEP)
    ground = QColor(theme.base)
    ground.setAlpha(READOUT_GROUND)
    painter.fillRect(box, ground)
    painter.setPen(QColor(theme.strong))
    painter.drawRect(box)
    painter.setPen(QColor(theme.text))
    for line, row in enumerate(rows):
        x = left + STEP / 2.0
        for at, (text, width) in enumerate(zip(row, widths, strict=True)):
            place = QRectF(x, top + STEP / 2.0 + line * height, width, height)
            side = Qt.AlignmentFlag.AlignRight if at else Qt.AlignmentFlag.AlignLeft
            painter.drawText(place, side | Qt.AlignmentFlag.AlignVCenter, text)
            x += width


def paint_spots(
    painter: QPainter, frame: PlotFrame, spots: Sequence[Spot], theme: Theme, taken: list[QRectF]
) -> None:
    """Paint spots with their words beside them; one beyond the range as a caret at the edge."""
    font, metrics = small_font(strong=True)
    painter.setFont(font)
    rect, size = frame.rect, STEP / 2.0
    for one in spots:
        x, y = frame.x(one.x), frame.y(one.y)
        if not rect.left() <= x <= rect.right():
            continue
        colour = one.pen.ink(theme)
        painter.setPen(colour)
        over, under = y < rect.top(), y > rect.bottom()
        y = min(max(y, rect.top() + size), rect.bottom() - size)
        if over or under:
            tip = y - size if over else y + size
            wings = [QPointF(x + way * size, 2 * y - tip) for way in (-1, 1)]
            painter.drawPolyline(QPolygonF([wings[0], QPointF(x, tip), wings[1]]))
        else:
            painter.setBrush(QColor(theme.base))
            painter.drawEllipse(QPointF(x, y), size, size)
        width, height = float(metrics.horizontalAdvance(one.text)), float(metrics.height())
        places = [
            QRectF(left, top, width, height)
            for top in (y - size - height, y - size, y + size)
            for left in (x + STEP, x - STEP - width)
        ]
        taken.append(QRectF(x - size, y - size, 2 * size, 2 * size))
        _words(painter, frame, one.text, colour.name(), places, taken, _ground(theme))


def _ground(theme: Theme) -> QColor:
    """Return what is laid below words that stand over curves."""
    ground = QColor(theme.base)
    ground.setAlpha(GROUND)
    return ground


def paint_moments(
    painter: QPainter, frame: PlotFrame, moments: Sequence[MarkedMoment], theme: Theme
) -> None:
    """Paint a line at every moment, and in the lane above the plot its shape and its words."""
    shown = [one for one in moments if frame.x_range[0] <= one.revolution <= frame.x_range[1]]
    font, metrics = small_font()
    painter.setFont(font)
    middle = frame.rect.top() - metrics.height() / 2.0 - 2.0
    free = frame.rect.right()
    # From the right, so that the newest keep their words where not all have room.
    for one in reversed(shown):
        x = frame.x(one.revolution)
        critical = one.severity is Severity.CRITICAL
        painter.setPen(line_pen(theme.critical if critical else theme.muted, dotted=not critical))
        painter.drawLine(QPointF(x, frame.rect.top()), QPointF(x, frame.rect.bottom()))
        colour = QColor(theme.critical if critical else theme.secondary)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(colour)
        painter.drawPolygon(_shape(one.severity, x, middle))
        text = one.words if len(one.words) <= MOST_NAME else one.words[: MOST_NAME - 1] + "…"
        if x + STEP + metrics.horizontalAdvance(text) <= free:
            painter.setPen(colour)
            top = middle - metrics.height() / 2.0
            painter.drawText(QPointF(x + STEP, top + metrics.ascent()), text)
        free = x - STEP


def trip_lines(frame: PlotFrame, moments: Sequence[MarkedMoment]) -> list[QRectF]:
    """Return the places of the lines of critical moments, over which no words are to stand."""
    shown = [one.revolution for one in moments if one.severity is Severity.CRITICAL]
    return [QRectF(frame.x(at) - 1.0, frame.rect.top(), 2.0, frame.rect.height()) for at in shown]


def _shape(severity: Severity | None, x: float, y: float) -> QPolygonF:
    """Return a flag for a note, a triangle for a warning, a diamond for what is critical."""
    half = STEP / 2.0
    corners = {
        None: ((0, -1), (1.6, -0.4), (0, 0.2), (0, 1.2), (-0.3, 1.2), (-0.3, -1)),
        Severity.WARNING: ((0, -1), (1, 1), (-1, 1)),
        Severity.CRITICAL: ((0, -1.2), (1.2, 0), (0, 1.2), (-1.2, 0)),
    }[severity]
    return QPolygonF([QPointF(x + half * right, y + half * down) for right, down in corners])


def alarm_token(news: News) -> tuple[tuple[str, str], ...]:
    """Return what the colours of limits depend on: a plot is drawn anew when it changes."""
    alarms = news.status.alarms if news.status is not None else ()
    return tuple((one.key, one.state) for one in alarms)


def limit_lines(news: News, columns: Collection[str]) -> tuple[LimitLine, ...]:
    """Return the limits of columns as lines of a plot, each coloured by its alarm alone."""
    alarms = news.status.alarms if news.status is not None else ()
    return tuple(
        LimitLine(one.limit, one.words, one.below, level_of_limit(alarms, one.key))
        for one in watched(news)
        if one.column in columns
    )
