"""Curves and bands of plots whose axes are never ranged by them, so that no bounds are computed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pyqtgraph as pg
from numpy.typing import NDArray
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPolygonF

from rigapp.gui.look.tokens import Theme
from rigapp.gui.plots.palette import LinePen

Floats = NDArray[np.float64]

SHADE = 48
"""Opacity of a band, of 255: two over each other, and a line below them, can still be told."""


class _InView:
    """An item that is as large as what is seen of its plot, whatever its data are."""

    _seen = QRectF()

    def boundingRect(self) -> QRectF:
        """Return the visible part of the plot."""
        return self._seen

    def viewTransformChanged(self) -> None:
        """Take the new visible part."""
        view = self.getViewBox()  # type: ignore[attr-defined]
        self.prepareGeometryChange()  # type: ignore[attr-defined]
        self._seen = QRectF() if view is None else view.viewRect()

    def dataBounds(self, axis: int, *_: Any, **__: Any) -> tuple[None, None]:
        """Return nothing: what is drawn ranges no axis."""
        return None, None


class Trace(_InView, pg.PlotCurveItem):  # type: ignore[misc]
    """A curve of finite points; NaN ends a piece where it is told ``connect="finite"``."""

    def __init__(self) -> None:
        super().__init__(skipFiniteCheck=True)

    def informViewBoundsChanged(self) -> None:
        """Tell nobody: no axis follows the data."""

    def pixelPadding(self) -> float:
        """Return no room beyond the visible part."""
        return 0.0


class ShadedBand(_InView, pg.GraphicsObject):  # type: ignore[misc]
    """The area between a lower and an upper limit, in the colour of its curve."""

    def __init__(self, pen: LinePen) -> None:
        super().__init__()
        self._pen = pen
        self._polygon = QPolygonF()
        self.limits: tuple[Floats, Floats] = (np.empty(0), np.empty(0))
        self._colour = QColor()
        self.setZValue(-5)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._colour = self._pen.of(theme).color()
        self._colour.setAlpha(SHADE)
        self.update()

    def setData(self, x: Floats, low: Floats, high: Floats) -> None:
        """Draw what is finite of arrays (n,)."""
        known = np.isfinite(low) & np.isfinite(high)
        there, back = x[known], x[known][::-1]
        self.limits = low[known], high[known]
        self._polygon = QPolygonF()
        if there.size:
            self._polygon = pg.functions.arrayToQPolygonF(
                np.concatenate((there, back)), np.concatenate((low[known], high[known][::-1]))
            )
        self.update()

    def paint(self, painter: QPainter, *_: Any) -> None:
        """Fill the area."""
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._colour)
        painter.drawPolygon(self._polygon)


def clear(*items: Trace | ShadedBand) -> None:
    """Draw nothing with curves and bands."""
    nothing = np.empty(0)
    for item in items:
        item.setData(*(nothing,) * (3 if isinstance(item, ShadedBand) else 2))
