"""Curves and bands of a plot, all painted by one item of its scene.

A separate item for each would cost three times as much as its painting: the scene queries the
bounds of every item several times a frame.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pyqtgraph as pg
from numpy.typing import NDArray
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

Floats = NDArray[np.float64]
Changed = Callable[[], None]

SHADE = 48
"""Opacity of a band, of 255: overlapping bands and a line below them stay visible."""
DOT = 5.0
"""Diameter of a point, pixels."""
NOTHING: Floats = np.empty(0)


class Trace:
    """A curve, interrupted at NaN."""

    def __init__(self, changed: Changed) -> None:
        self._changed = changed
        self._pieces: list[QPolygonF] = []
        self._pen = QPen()
        self.x, self.y = NOTHING, NOTHING

    @property
    def empty(self) -> bool:
        """Return whether nothing is drawn."""
        return len(self.x) == 0

    def setPen(self, pen: QPen) -> None:
        """Set the pen."""
        self._pen = pen
        self._changed()

    def setData(self, x: Floats, y: NDArray[np.floating]) -> None:
        """Draw points, (n,) each."""
        self.x, self.y = np.asarray(x), np.asarray(y)
        known = np.isfinite(self.y)
        if known.all():
            bounds = [(0, len(self.y))]
        else:
            edges = np.flatnonzero(np.diff(known, prepend=False, append=False))
            bounds = list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
        self._pieces = [_polygon(self.x[a:b], self.y[a:b]) for a, b in bounds if b > a]
        self._changed()

    def paint(self, painter: QPainter) -> None:
        """Paint the curve."""
        if self._pieces:
            painter.setPen(self._pen)
            for piece in self._pieces:
                painter.drawPolyline(piece)


class Dots:
    """Unconnected points; NaN is not drawn."""

    def __init__(self, changed: Changed) -> None:
        self._changed = changed
        self._points = QPolygonF()
        self._pen = QPen()
        self.x, self.y = NOTHING, NOTHING

    def setPen(self, pen: QPen) -> None:
        """Set the colour to that of a pen."""
        self._pen = QPen(pen.color(), DOT)
        self._pen.setCosmetic(True)
        self._pen.setCapStyle(Qt.PenCapStyle.RoundCap)
        self._changed()

    def setData(self, x: Floats, y: Floats) -> None:
        """Draw points, (n,) each."""
        known = np.isfinite(x) & np.isfinite(y)
        self.x, self.y = x[known], y[known]
        self._points = _polygon(self.x, self.y)
        self._changed()

    def paint(self, painter: QPainter) -> None:
        """Paint the points, round at any scale of the axes."""
        places = painter.worldTransform().map(self._points)
        painter.save()
        painter.resetTransform()
        painter.setPen(self._pen)
        painter.drawPoints(places)
        painter.restore()


class ShadedBand:
    """The area between a lower and an upper limit, in the colour of its curve."""

    def __init__(self, changed: Changed) -> None:
        self._changed = changed
        self._polygon = QPolygonF()
        self._colour = QColor()
        self.low, self.high = NOTHING, NOTHING

    @property
    def empty(self) -> bool:
        """Return whether nothing is drawn."""
        return len(self.low) == 0

    def setPen(self, pen: QPen) -> None:
        """Set the colour of the area to that of a pen."""
        self._colour = pen.color()
        self._colour.setAlpha(SHADE)
        self._changed()

    def setData(self, x: Floats, low: Floats, high: Floats) -> None:
        """Draw the finite values of arrays (n,)."""
        known = np.isfinite(low) & np.isfinite(high)
        at, self.low, self.high = x[known], low[known], high[known]
        corners = np.concatenate((at, at[::-1])), np.concatenate((self.low, self.high[::-1]))
        self._polygon = _polygon(*corners)
        self._changed()

    def paint(self, painter: QPainter) -> None:
        """Fill the area."""
        if not self._polygon.isEmpty():
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(self._colour)
            painter.drawPolygon(self._polygon)


class Canvas(pg.GraphicsObject):  # type: ignore[misc]
    """The one item that paints the curves of a plot, bands first; it does not range the axes."""

    def __init__(self) -> None:
        super().__init__()
        self._seen = QRectF()
        self.bands: list[ShadedBand] = []
        self.traces: list[Trace | Dots] = []

    def boundingRect(self) -> QRectF:
        """Return the visible part of the plot."""
        return self._seen

    def viewTransformChanged(self) -> None:
        """Update the visible part."""
        view = self.getViewBox()
        self.prepareGeometryChange()
        self._seen = QRectF() if view is None else view.viewRect()

    def dataBounds(self, axis: int, *_: Any, **__: Any) -> tuple[None, None]:
        """Return no bounds, so that the curves do not range the axes."""
        return None, None

    def paint(self, painter: QPainter, *_: Any) -> None:
        """Paint all curves."""
        for band in self.bands:
            band.paint(painter)
        for trace in self.traces:
            trace.paint(painter)


def _polygon(x: Floats, y: NDArray[np.floating]) -> QPolygonF:
    """Return points as a polygon; a single point is repeated, so that it is painted as a dot."""
    if len(x) == 0:
        return QPolygonF()
    if len(x) == 1:
        x, y = np.repeat(x, 2), np.repeat(y, 2)
    polygon: QPolygonF = pg.functions.arrayToQPolygonF(x, y)
    return polygon


def clear(*items: Trace | ShadedBand) -> None:
    """Clear curves and bands."""
    for item in items:
        if not item.empty:
            item.setData(*(NOTHING,) * (3 if isinstance(item, ShadedBand) else 2))
