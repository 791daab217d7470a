"""Plots that keep still and cost little: fixed ranges, a few lines for a grid, legend outside."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import pyqtgraph as pg
from PySide6.QtCore import QPointF, QSize, Qt
from PySide6.QtGui import QFontMetrics, QKeyEvent, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QLabel, QSizePolicy, QWidget

from rigapp.gui.data.ranges import SteadyRange
from rigapp.gui.look.tokens import GAP, STEP, Theme
from rigapp.gui.plots.palette import LinePen, line_pen
from rigapp.gui.widgets.build import named


class QuietPlot(pg.PlotWidget):  # type: ignore[misc]
    """A plot without menus, buttons, automatic ranges or a grid that is painted at every frame."""

    def __init__(self, name: str, spoken: str, theme: Theme) -> None:
        super().__init__(background=theme.base)
        named(self, name, spoken)
        self.setMenuEnabled(False)
        self.hideButtons()
        self.setMouseEnabled(x=False, y=False)
        self.disableAutoRange()
        self.setFrameShape(pg.QtWidgets.QFrame.Shape.NoFrame)
        self.setMinimumSize(QSize(120, 60))
        metrics = QFontMetrics(self.font())
        self.getPlotItem().layout.setContentsMargins(
            0, metrics.height() // 2, metrics.horizontalAdvance("000"), metrics.height() // 4
        )
        self._pens: dict[Any, LinePen] = {}
        self.steady = SteadyRange(1.0)
        self._instead = QLabel(self)
        self._instead.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._instead.setWordWrap(True)
        self._instead.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._instead.hide()
        self.getAxis("left").setWidth(metrics.horizontalAdvance("−00.00") + 2 * metrics.height())
        for side in ("left", "bottom"):
            self.getAxis(side).enableAutoSIPrefix(False)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme: background, axes, every curve and line."""
        self.theme = theme
        self.setBackground(theme.base)
        self._instead.setStyleSheet(f"color: {theme.muted}; border: 1px dashed {theme.border}")
        for side in ("left", "bottom"):
            axis = self.getAxis(side)
            axis.setPen(line_pen(theme.border))
            axis.setTextPen(theme.text)
        for item, pen in self._pens.items():
            item.setPen(pen.of(theme))

    def label(self, side: str, text: str) -> None:
        """Write an axis label; the unit is part of the text."""
        self.getAxis(side).setLabel(text)

    @property
    def instead(self) -> str:
        """Return the sentence that stands in place of axes and curves, empty when these show."""
        return self._instead.text()

    def empty(self, sentence: str) -> None:
        """Show a sentence in place of axes and curves, which mean nothing yet; "": show these."""
        if sentence == self._instead.text():
            return
        self._instead.setText(sentence)
        self._instead.setVisible(bool(sentence))
        self.setAccessibleDescription(sentence)
        self.getPlotItem().setVisible(not sentence)

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """Keep the sentence of an empty plot in its middle."""
        super().resizeEvent(event)
        if event is not None:
            gap = QFontMetrics(self.font()).height()
            self._instead.setGeometry(self.rect().adjusted(gap, gap // 2, -gap, -gap // 2))

    def curve(self, pen: LinePen) -> pg.PlotCurveItem:
        """Add an empty curve for data known to be finite."""
        item = pg.PlotCurveItem(skipFiniteCheck=True)
        self.addItem(item)
        self.draw_with(pen, item)
        return item

    def draw_with(self, pen: LinePen, *items: Any) -> None:
        """Draw curves or lines with a pen, in every theme."""
        for item in items:
            self._pens[item] = pen
            item.setPen(pen.of(self.theme))

    def take_out(self, item: Any) -> None:
        """Remove a curve."""
        del self._pens[item]
        self.removeItem(item)

    def fit(self, low: float, high: float) -> None:
        """Show values from low to high, by steps that keep still; nothing new when they are NaN."""
        if math.isfinite(low) and math.isfinite(high):
            self.empty("")
        if self.steady.update(low, high) and self.steady.range is not None:
            self.setYRange(*self.steady.range, padding=0.0)

    def guide(self, at: float, *, horizontal: bool) -> pg.InfiniteLine:
        """Add a calm line in place of a grid."""
        line = pg.InfiniteLine(at, angle=0 if horizontal else 90)
        self.draw_with(LinePen("grid"), line)
        line.setZValue(-10)
        self.addItem(line, ignoreBounds=True)
        return line

    def band(self) -> pg.LinearRegionItem:
        """Add a horizontal band behind the curves, hidden until it is given a height."""
        item = pg.LinearRegionItem(
            (0.0, 0.0), orientation="horizontal", movable=False, brush=self.theme.band
        )
        self.draw_with(LinePen("band"), *item.lines)
        item.setZValue(-20)
        item.hide()
        self.addItem(item, ignoreBounds=True)
        return item

    def show_crank_angle(self, *, label: bool = True) -> None:
        """Set the x axis to one revolution with ticks and lines at every quarter."""
        self.setXRange(0.0, 360.0, padding=0.0)
        axis = self.getAxis("bottom")
        major = [(float(at), str(at)) for at in range(0, 361, 90)]
        minor = [(float(at), "") for at in range(0, 361, 30) if at % 90]
        axis.setTicks([major, minor])
        axis.setStyle(hideOverlappingLabels=False)
        if label:
            self.label("bottom", "Crank angle (deg)")
        else:
            axis.setStyle(showValues=False)
            axis.setHeight(6)
        for at in (90.0, 180.0, 270.0):
            self.guide(at, horizontal=False)


Pointed = Callable[[float | None], None]
"""Called with the place of the cursor on the x axis; None takes the cursor away."""


class CursorPlot(QuietPlot):
    """A plot with a cursor that a click puts somewhere and Esc takes away."""

    def __init__(self, name: str, spoken: str, theme: Theme, pointed: Pointed) -> None:
        super().__init__(name, spoken, theme)
        self._pointed = pointed
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.cursor_line = self.guide(0.0, horizontal=False)
        self.draw_with(LinePen("text"), self.cursor_line)
        self.cursor_line.hide()
        self.scene().sigMouseClicked.connect(self._clicked)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Take the cursor away by Esc."""
        if event.key() == Qt.Key.Key_Escape:
            self._pointed(None)
        else:
            super().keyPressEvent(event)

    def show_cursor(self, at: float | None) -> None:
        """Put the cursor somewhere, or take it away."""
        self.cursor_line.setVisible(at is not None)
        if at is not None:
            self.cursor_line.setValue(at)

    def _clicked(self, event: Any) -> None:
        view = self.getViewBox()
        if view.sceneBoundingRect().contains(event.scenePos()):
            self._pointed(float(view.mapSceneToView(event.scenePos()).x()))


NO_REVOLUTION = "No revolution measured yet"
"""The beginning of the sentence of a plot that waits for the first one."""

LegendEntry = tuple[str, LinePen]
"""One line of a legend: text and the pen that the curve has."""


def clear(*curves: pg.PlotCurveItem) -> None:
    """Draw nothing with curves."""
    for curve in curves:
        curve.setData([], [])


class LegendRow(QWidget):
    """Show samples of the curves with their names, outside the plot."""

    def __init__(self, name: str, theme: Theme) -> None:
        super().__init__()
        self.setObjectName(name)
        self._theme = theme
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(4, 0, 4, 0)
        self._row.setSpacing(4)
        self._row.addStretch(1)
        self.setMinimumWidth(1)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._entries: tuple[LegendEntry, ...] = ()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        entries, self._entries = self._entries, ()
        self.show_entries(entries)

    def show_entries(self, entries: Sequence[LegendEntry]) -> None:
        """Replace what is shown."""
        entries = tuple(entries)
        if entries == self._entries:
            return
        self._entries = entries
        gap = QFontMetrics(self.font()).horizontalAdvance("M")
        while self._row.count() > 1:
            item = self._row.takeAt(0)
            widget = item.widget() if item is not None else None
            if widget is not None:
                widget.hide()
                widget.deleteLater()
        for text, pen in entries:
            at = self._row.count() - 1
            self._row.insertWidget(at, _Sample(pen.of(self._theme)))
            label = QLabel(text)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setContentsMargins(0, 0, gap, 0)
            label.setProperty("role", "caption")
            self._row.insertWidget(at + 1, label)
        self.setAccessibleName("Legend: " + ", ".join(text for text, _ in entries))


class PlotPanel(QWidget):
    """A panel of plots: in a new theme every plot and legend on it is drawn anew."""

    def __init__(self, name: str, spoken: str) -> None:
        super().__init__()
        named(self, name, spoken).setProperty("role", "card")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setContentsMargins(GAP, STEP, GAP, STEP)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        for plot in self.findChildren(QuietPlot):
            plot.dress(theme)
        for legend in self.findChildren(LegendRow):
            legend.dress(theme)


class _Sample(QWidget):
    """Paint a short piece of a curve."""

    def __init__(self, pen: QPen) -> None:
        super().__init__()
        self._pen = QPen(pen)
        self._pen.setWidthF(2.0)
        self.setFixedWidth(QFontMetrics(self.font()).horizontalAdvance("MM"))
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the line at mid height."""
        painter = QPainter(self)
        painter.setPen(self._pen)
        middle = self.height() / 2.0
        painter.drawLine(QPointF(1.0, middle), QPointF(self.width() - 6.0, middle))
        painter.end()
