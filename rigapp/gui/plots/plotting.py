"""Plots with stable axes and low cost: fixed ranges, names at the curves, painted marks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QFontMetrics,
    QKeyEvent,
    QPainter,
    QResizeEvent,
)
from PySide6.QtWidgets import QLabel

from rigapp.gui.plots.axes import QuietAxis
from rigapp.gui.plots.curves import Canvas, Dots, ShadedBand, Trace
from rigapp.gui.plots.handled import HandledPlot
from rigapp.gui.plots.marks import (
    Marks,
    PlotFrame,
    name_room,
    paint_axes,
    paint_captions,
    paint_cursor,
    paint_limit_words,
    paint_limits,
    paint_moments,
    paint_names,
    paint_next_limits,
    paint_readout,
    paint_spots,
    trip_lines,
)
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.readings import (
    ItemPoints,
    NamedCurve,
    PlottedCurve,
    named_curves,
    readout,
)
from rigapp.gui.widgets.build import named
from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import GAP, STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.ranges import SteadyRange

LEAST_HEIGHT = 20 * STEP
"""Minimum height of a plot with its axis; a lower page scrolls."""
LEAST_ROOM = 2 * STEP
"""Margin beside a plot without names: half of the last tick's text."""
QUARTERS = range(0, 361, 90)
"""Ticks of an axis of crank angles, degrees."""


class NameRoom:
    """Common width of the curves' names beside plots that are below each other."""

    def __init__(self) -> None:
        self._needs: dict[QuietPlot, int] = {}

    @property
    def width(self) -> int:
        """Return the width of the widest name."""
        return max(self._needs.values(), default=LEAST_ROOM)

    def need(self, plot: QuietPlot, width: int) -> None:
        """Set the width for the names of a plot; it decreases only after ``start_afresh``."""
        self._set(plot, max(width, self._needs.get(plot, LEAST_ROOM)))

    def start_afresh(self, plot: QuietPlot) -> None:
        """Reset to the minimum width before the plot draws another test."""
        self._set(plot, LEAST_ROOM)

    def _set(self, plot: QuietPlot, width: int) -> None:
        before = self.width
        self._needs[plot] = width
        if self.width != before:
            for other in self._needs:
                other.give_room()


class QuietPlot(HandledPlot):
    """A plot without buttons, automatic ranges or a legend; for names and marks see ``show_marks``.

    Drawing a rectangle with the mouse zooms; the middle button moves the part; Backspace or the
    menu ends the zoom. The menu (right click, Shift+F10) saves picture and data. Shift+click or the
    keys 1 and 2 place two cursors, Ctrl with an arrow moves them, Esc removes them. ``reported``:
    the result of the menu, and whether it is a success.
    """

    reported = Signal(str, bool)

    def __init__(
        self,
        name: str,
        spoken: Text,
        theme: Theme,
        *,
        lane: bool = False,
        room: NameRoom | None = None,
    ) -> None:
        """Make a plot; lane: reserve room above for texts of moments; room: shared name width."""
        axes = {side: QuietAxis(side) for side in ("left", "bottom")}
        super().__init__(background=theme.base, axisItems=axes, enableMenu=False)
        named(self, name, spoken)
        self.hideButtons()
        self.setMouseEnabled(x=False, y=False)
        self.disableAutoRange()
        self.setFrameShape(pg.QtWidgets.QFrame.Shape.NoFrame)
        self.setMinimumSize(QSize(120, LEAST_HEIGHT))
        self._axes = axes
        self._pens: dict[Any, LinePen] = {}
        self._canvas = Canvas()
        self.addItem(self._canvas)
        self._placed: PlotFrame | None = None
        self._marks = Marks()
        self._room = room or NameRoom()
        self._room.start_afresh(self)
        self._top = QFontMetrics(self.font()).height() if lane else STEP
        self.steady = SteadyRange(1.0)
        self._instead = QLabel(self)
        self._instead.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._instead.setWordWrap(True)
        self._instead.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._instead.hide()
        # The background of the curves is cached until a part of it moves.
        view = self.getViewBox()
        for moved in (view.sigRangeChanged, view.sigResized, view.geometryChanged):
            moved.connect(self._repaint)
        self._across = ""
        self.give_room()
        self.dress(theme)

    def sizeHint(self) -> QSize:
        """Return the minimum size, so that a page scrolls only where this does not fit."""
        return QSize(self.minimumWidth(), self.minimumHeight())

    def captions(self) -> tuple[str, str]:
        """Return the captions of the axes; the plot's name replaces a missing vertical one."""
        return self._axes["bottom"].text, self._axes["left"].text or self.accessibleName()

    def drawn(self) -> Iterator[tuple[PlottedCurve, LinePen | None]]:
        """Yield curves and points with their pens; None for a pen of pyqtgraph's own items."""
        yield from ((trace, self._pens[trace]) for trace in self._canvas.traces)
        for item in self.getPlotItem().listDataItems():
            x, y = item.getData()
            if x is not None:
                yield ItemPoints(np.asarray(x, np.float64), np.asarray(y, np.float64)), None

    def curves(self) -> Iterator[NamedCurve]:
        """Yield the drawn curves with their names."""
        return named_curves(self.drawn(), self._marks.names)

    def _read_cursors(self) -> None:
        """Show the readings at the cursors, also to a screen reader."""
        rows = self.cursor_readout() if self.cursors.places else []
        words = "; ".join(" ".join(row).strip() for row in rows)
        self.setAccessibleDescription(words or self._marks.words)
        self.viewport().update()

    def cursor_readout(self) -> list[list[str]]:
        """Return the table of the readings at the cursors."""
        return readout(self.cursors, self.captions()[0] or self._across, self.curves())

    def dress(self, theme: Theme) -> None:
        """Apply a theme to background, axes, curves and lines."""
        self.theme = theme
        self.setBackground(theme.base)
        self._instead.setStyleSheet(f"color: {theme.muted}; border: 1px dashed {theme.border}")
        for item, pen in self._pens.items():
            item.setPen(pen.of(theme))

    def label(self, side: str, text: Text) -> None:
        """Set the label of an axis; the unit is part of the text."""
        axis, text = self._axes[side], tr(text)
        if text != axis.text:
            axis.caption(text)
            self._repaint()

    @property
    def instead(self) -> str:
        """Return the sentence shown in place of axes and curves, empty when these are shown."""
        return self._instead.text()

    def name_places(self, side: str, texts: Sequence[str]) -> None:
        """Label 0, 1, 2 … of an axis by texts instead of numbers; none: numbers again."""
        self._axes[side].setTicks([list(enumerate(texts))] if texts else None)
        self._repaint()

    def empty(self, sentence: Text) -> None:
        """Show a sentence in place of axes and curves; an empty one shows these again."""
        sentence = tr(sentence)
        if sentence == self._instead.text():
            return
        self._instead.setText(sentence)
        self._instead.setVisible(bool(sentence))
        self.setAccessibleDescription(sentence)
        self.getPlotItem().setVisible(not sentence)
        self._repaint()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """Centre the sentence of an empty plot."""
        super().resizeEvent(event)
        if event is not None:
            self._instead.setGeometry(self.rect().adjusted(GAP, STEP, -GAP, -STEP))

    def curve(self, pen: LinePen) -> Trace:
        """Add an empty curve."""
        item = Trace(self._canvas.update)
        self._canvas.traces.append(item)
        self.draw_with(pen, item)
        return item

    def dots(self, pen: LinePen) -> Dots:
        """Add an empty set of unconnected points."""
        item = Dots(self._canvas.update)
        self._canvas.traces.append(item)
        self.draw_with(pen, item)
        return item

    def shade(self, pen: LinePen) -> ShadedBand:
        """Add an empty band, in the colour of a curve, behind the curves."""
        item = ShadedBand(self._canvas.update)
        self._canvas.bands.append(item)
        self.draw_with(pen, item)
        return item

    def draw_with(self, pen: LinePen, *items: Any) -> None:
        """Set the pen of curves or lines for every theme."""
        for item in items:
            self._pens[item] = pen
            item.setPen(pen.of(self.theme))

    def take_out(self, item: Trace | ShadedBand) -> None:
        """Remove a curve or a band."""
        del self._pens[item]
        kept: list[Any] = self._canvas.traces if isinstance(item, Trace) else self._canvas.bands
        kept.remove(item)
        self._canvas.update()

    def fit(self, low: float, high: float) -> None:
        """Set the vertical range to low..high in stable steps; unchanged when they are NaN."""
        if math.isfinite(low) and math.isfinite(high):
            self.empty("")
        if self.steady.update(low, high) and self.steady.range is not None:
            self.show_range("y", *self.steady.range)

    def show_marks(self, **parts: Any) -> None:
        """Show names, limits, moments or spots (see ``Marks``); other marks stay."""
        marks = replace(self._marks, **parts)
        before, self._marks = self._marks, marks
        if marks == before:
            return
        if not self.instead:
            self.setAccessibleDescription(marks.words)
        if marks.names != before.names:
            self._room.need(self, name_room(marks.names))
        if (marks.limits, marks.moments) != (before.limits, before.moments):
            self._repaint()
        self.viewport().update()

    @property
    def marks(self) -> Marks:
        """Return the marks of the plot."""
        return self._marks

    def start_afresh(self) -> None:
        """Reset range, room and marks before another test is drawn."""
        self.steady.forget()
        self._room.start_afresh(self)
        self.cursors.clear()
        self.show_marks(names=(), limits=(), moments=(), spots=())

    def drawBackground(self, painter: QPainter, rect: QRectF) -> None:
        """Paint the marks behind the curves."""
        super().drawBackground(painter, rect)
        if not self.instead:
            frame, marks = self._frame(), self._marks
            bottom, left = self._axes["bottom"], self._axes["left"]
            shown = (
                bottom.ticks() if bottom.height() > STEP else [(at, "") for at, _ in bottom.ticks()]
            )
            paint_axes(painter, frame, shown, left.ticks(), self.theme)
            paint_captions(painter, frame, bottom.text, left.text, self.theme)
            paint_limits(painter, frame, marks.limits, self.theme)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            paint_moments(painter, frame, marks.moments, self.theme)

    def drawForeground(self, painter: QPainter, rect: QRectF) -> None:
        """Paint the marks in front of the curves."""
        if self.instead:
            return
        frame, marks = self._frame(), self._marks
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        taken: list[QRectF] = []
        paint_spots(painter, frame, marks.spots, self.theme, taken)
        taken += trip_lines(frame, marks.moments)
        if marks.limits:
            traces = [trace for trace in self._canvas.traces if len(trace.x)]
            curves = [(frame.x(trace.x), frame.y(trace.y)) for trace in traces]
            paint_limit_words(painter, frame, marks.limits, self.theme, taken, curves)
            paint_next_limits(painter, frame, marks.limits, self.theme, taken, curves)
        paint_names(painter, frame, marks.names, self.theme)
        if self.cursors.places:
            rows = self.cursor_readout()
            paint_readout(painter, frame, self.cursors.places, rows, self.theme)

    def _repaint(self, *_: object) -> None:
        self._placed = None
        super()._repaint()

    def _frame(self) -> PlotFrame:
        if self._placed is None:
            view = self.getViewBox()
            across, up = view.viewRange()
            self._placed = PlotFrame(view.sceneBoundingRect(), tuple(across), tuple(up))
        return self._placed

    def give_room(self) -> None:
        """Set the margins for moments above the curves and names beside them."""
        self.getPlotItem().layout.setContentsMargins(0, self._top, self._room.width, 0)

    def guide(self, at: float, *, horizontal: bool) -> pg.InfiniteLine:
        """Add a faint line at a position without grid line."""
        line = pg.InfiniteLine(at, angle=0 if horizontal else 90)
        self.draw_with(LinePen("grid"), line)
        line.setZValue(-10)
        self.addItem(line, ignoreBounds=True)
        return line

    def show_crank_angle(self, *, label: bool = True) -> None:
        """Set the x axis to one revolution with ticks at every quarter."""
        self.show_range("x", 0.0, 360.0)
        axis, self._across = self._axes["bottom"], tr("Crank angle")
        axis.setTicks([[(float(at), f"{at}°") for at in QUARTERS]])
        if label:
            self.label("bottom", "Crank angle")
        else:
            axis.setHeight(STEP)


Pointed = Callable[[float | None], None]
"""Called with the position of the cursor on the x axis; None: the cursor is removed."""


class CursorPlot(QuietPlot):
    """A plot with a cursor that a click places and Esc removes."""

    def __init__(
        self,
        name: str,
        spoken: Text,
        theme: Theme,
        pointed: Pointed,
        *,
        lane: bool = False,
        room: NameRoom | None = None,
    ) -> None:
        super().__init__(name, spoken, theme, lane=lane, room=room)
        self._pointed = pointed
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setToolTip(
            tr(
                "Click, or Tab to it and use ← →, to read values; Esc ends it."
                " Draw a rectangle to look closer. Shift+click, or 1 and 2: two cursors and their"
                " difference."
            )
        )
        self.cursor_line = self.guide(0.0, horizontal=False)
        self.draw_with(LinePen("text"), self.cursor_line)
        self.cursor_line.hide()
        self.scene().sigMouseClicked.connect(self._clicked)

    def own_key(self, event: QKeyEvent) -> bool:
        """Remove the cursor by Esc."""
        if event.key() != Qt.Key.Key_Escape:
            return super().own_key(event)
        self._pointed(None)
        return True

    def cursor_text(self, at: float) -> str:
        """Return the text at the cursor."""
        return grouped(round(at))

    def drawForeground(self, painter: QPainter, rect: QRectF) -> None:
        """Paint the marks in front of the curves, and the cursor."""
        super().drawForeground(painter, rect)
        if self.cursor_line.isVisible() and not self.instead:
            at = self.cursor_line.value()
            paint_cursor(painter, self._frame(), at, self.cursor_text(at), self.theme)

    def show_cursor(self, at: float | None) -> None:
        """Place the cursor at a value of x, or remove it."""
        self.cursor_line.setVisible(at is not None)
        if at is not None:
            self.cursor_line.setValue(at)
        self.viewport().update()

    def _clicked(self, event: Any) -> None:
        view = self.getViewBox()
        if view.sceneBoundingRect().contains(event.scenePos()):
            self._pointed(float(view.mapSceneToView(event.scenePos()).x()))
