"""Plots that keep still and cost little: fixed ranges, names at the curves, marks painted."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any, Final
from weakref import ref

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPoint, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QFont,
    QFontMetrics,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QResizeEvent,
    QShowEvent,
)
from PySide6.QtWidgets import QLabel, QRubberBand, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.plots.axes import QuietAxis
from rigapp.gui.plots.curves import Canvas, Dots, ShadedBand, Trace
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
    LARGE_STEP,
    SMALL_STEP,
    CursorPair,
    ItemPoints,
    NamedCurve,
    PlottedCurve,
    named_curves,
    readout,
)
from rigapp.gui.widgets.build import named, prose
from rigapp.gui.widgets.labels import ShortLabel
from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import BODY_PT, GAP, STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.series import LiveData

LEAST_HEIGHT = 20 * STEP
"""Of what is shown as a plot, with its axis: a page too low for it scrolls."""
LEAST_ROOM = 2 * STEP
"""Beside a plot without names: half of the last tick's text stands there."""
QUARTERS = range(0, 361, 90)
"""Of a turn, degrees: where an axis of crank angles has its ticks."""


class NameRoom:
    """The width that the names of curves have beside plots which stand below each other."""

    def __init__(self) -> None:
        self._needs: dict[QuietPlot, int] = {}

    @property
    def width(self) -> int:
        """Return the width that the widest of their names needs."""
        return max(self._needs.values(), default=LEAST_ROOM)

    def need(self, plot: QuietPlot, width: int) -> None:
        """Take what the names of a plot need; it shrinks only when the plot starts afresh."""
        self._set(plot, max(width, self._needs.get(plot, LEAST_ROOM)))

    def start_afresh(self, plot: QuietPlot) -> None:
        """Begin with the least width: what the plot draws next is of another test."""
        self._set(plot, LEAST_ROOM)

    def _set(self, plot: QuietPlot, width: int) -> None:
        before = self.width
        self._needs[plot] = width
        if self.width != before:
            for one in self._needs:
                one.give_room()


DRAG = 12
"""Pixels that a rectangle has at least either way: less is a click with an unsteady hand."""


class QuietPlot(pg.PlotWidget):  # type: ignore[misc]
    """A plot without buttons, automatic ranges or a legend; ``show_marks`` does the rest.

    A rectangle drawn with the mouse is shown larger, moved by the middle button, until Backspace or
    the menu shows all again; the menu (right click, Shift+F10) gives picture and data away.
    Shift+click, or the keys 1 and 2, put down two cursors that Ctrl with an arrow moves and Esc
    takes away. ``said`` tells what came of it.
    """

    said = Signal(str, bool)

    def __init__(
        self,
        name: str,
        spoken: Text,
        theme: Theme,
        *,
        lane: bool = False,
        room: NameRoom | None = None,
    ) -> None:
        """Make a plot; lane: with room above it for the words of moments; room: a shared one."""
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
        # What lies behind the curves is painted once, and kept until something of it moves.
        view = self.getViewBox()
        for moved in (view.sigRangeChanged, view.sigResized, view.geometryChanged):
            moved.connect(self._repaint)
        self._home: dict[str, tuple[float, float]] = {}
        self._movable = (False, False)
        self._pressed: QPoint | None = None
        self.cursors = CursorPair()
        self._across = ""
        self._frame_drawn = QRubberBand(QRubberBand.Shape.Rectangle, self)
        self.give_room()
        self.dress(theme)

    def sizeHint(self) -> QSize:
        """Want no more than the least: a page then scrolls only where that has no room."""
        return QSize(self.minimumWidth(), self.minimumHeight())

    @property
    def zoomed(self) -> bool:
        """Tell whether a part is shown larger."""
        return bool(self._home)

    def show_range(self, side: str, low: float, high: float, padding: float = 0.0) -> None:
        """Show values from low to high on an axis, "x" or "y"; once nobody looks closer."""
        if side in self._home:
            self._home[side] = (low, high)
        else:
            (self.setXRange if side == "x" else self.setYRange)(low, high, padding=padding)

    def zoom(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Show a part larger, until ``zoom_back``."""
        if not self._home:
            across, up = self.getViewBox().viewRange()
            self._home = {"x": tuple(across), "y": tuple(up)}
            self._movable = tuple(self.getViewBox().state["mouseEnabled"])
            self.setMouseEnabled(x=True, y=True)
        self.setXRange(*x, padding=0.0)
        self.setYRange(*y, padding=0.0)
        self._repaint()

    def zoom_back(self) -> None:
        """Show what is shown when nobody looks closer."""
        home, self._home = self._home, {}
        if home:
            self.setMouseEnabled(*self._movable)
        for side, (low, high) in home.items():
            self.show_range(side, low, high)
        self._repaint()

    def captions(self) -> tuple[str, str]:
        """Return what stands along the axes; for the vertical one what the plot is, without it."""
        return self._axes["bottom"].text, self._axes["left"].text or self.accessibleName()

    def drawn(self) -> Iterator[tuple[PlottedCurve, LinePen | None]]:
        """Yield curves and points with their pens; None for a pen of pyqtgraph's own items."""
        yield from ((one, self._pens[one]) for one in self._canvas.traces)
        for item in self.getPlotItem().listDataItems():
            x, y = item.getData()
            if x is not None:
                yield ItemPoints(np.asarray(x, np.float64), np.asarray(y, np.float64)), None

    def curves(self) -> Iterator[NamedCurve]:
        """Yield the curves that are drawn, each with its name."""
        return named_curves(self.drawn(), self._marks.names)

    def show_cursors(self, *, both: bool = True) -> None:
        """Put both cursors down where they can be seen, or take them away."""
        if both:
            self.cursors.show(*self.viewRange()[0])
        else:
            self.cursors.clear()
        self._read_cursors()

    def _read_cursors(self) -> None:
        """Say what is read at the cursors, to eyes and to a screen reader."""
        rows = self.cursor_readout() if self.cursors.places else []
        words = "; ".join(" ".join(row).strip() for row in rows)
        self.setAccessibleDescription(words or self._marks.words)
        self.viewport().update()

    def cursor_readout(self) -> list[list[str]]:
        """Return the table of what is read at the cursors."""
        return readout(self.cursors, self.captions()[0] or self._across, self.curves())

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the two cursors, show all again by Backspace; the rest is the plot's own."""
        if self._cursor_key(event):
            self._read_cursors()
        elif event.key() == Qt.Key.Key_Backspace and self.zoomed:
            self.zoom_back()
        elif not self.own_key(event):
            super().keyPressEvent(event)

    def own_key(self, event: QKeyEvent) -> bool:
        """Do what a key does on this plot alone; return whether it does something."""
        return False

    def _cursor_key(self, event: QKeyEvent) -> bool:
        """Do what a key does with the two cursors, the same on every plot."""
        key, held, pair = Qt.Key(event.key()), event.modifiers(), self.cursors
        low, high = self.viewRange()[0]
        sign = {Qt.Key.Key_Left: -1.0, Qt.Key.Key_Right: 1.0}.get(key)
        if key in (Qt.Key.Key_1, Qt.Key.Key_2) and not held:
            pair.choose(int(key == Qt.Key.Key_2), low, high)
        elif sign and pair.places and held & Qt.KeyboardModifier.ControlModifier:
            large = held & Qt.KeyboardModifier.ShiftModifier
            pair.move(sign * (high - low) * (LARGE_STEP if large else SMALL_STEP))
        elif key == Qt.Key.Key_Escape and pair.places:
            pair.clear()
        else:
            return False
        return True

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a rectangle, or a click; with Shift put down a cursor."""
        shift = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        if event.button() == Qt.MouseButton.LeftButton and shift and not self.instead:
            at = self.getViewBox().mapSceneToView(self.mapToScene(event.position().toPoint()))
            self.cursors.put(at.x())
            self._read_cursors()
            self.setFocus(Qt.FocusReason.MouseFocusReason)
            event.accept()
            return
        if event.button() == Qt.MouseButton.LeftButton and not self.instead:
            self._pressed = event.position().toPoint()
        super().mousePressEvent(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Draw the rectangle."""
        if self._pressed is None:
            super().mouseMoveEvent(event)
            return
        drawn = QRect(self._pressed, event.position().toPoint()).normalized()
        self._frame_drawn.setGeometry(drawn)
        self._frame_drawn.setVisible(min(drawn.width(), drawn.height()) >= DRAG)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Show what is in the rectangle; one too small for that was a click."""
        self._pressed = None
        if self._frame_drawn.isVisible():
            self._frame_drawn.hide()
            self.scene().clickEvents.clear()  # else the next click were where this rectangle began
            area = self._frame_drawn.geometry()
            corners = [self.mapToScene(one) for one in (area.topLeft(), area.bottomRight())]
            first, last = (self.getViewBox().mapSceneToView(one) for one in corners)
            self.zoom((first.x(), last.x()), (last.y(), first.y()))
            event.accept()
            return
        super().mouseReleaseEvent(event)

    def dress(self, theme: Theme) -> None:
        """Take a theme: background, axes, every curve and line."""
        self.theme = theme
        self.setBackground(theme.base)
        self._instead.setStyleSheet(f"color: {theme.muted}; border: 1px dashed {theme.border}")
        for item, pen in self._pens.items():
            item.setPen(pen.of(theme))

    def label(self, side: str, text: Text) -> None:
        """Write an axis label; the unit is part of the text."""
        axis, text = self._axes[side], tr(text)
        if text != axis.text:
            axis.caption(text)
            self._repaint()

    @property
    def instead(self) -> str:
        """Return the sentence that stands in place of axes and curves, empty when these show."""
        return self._instead.text()

    def name_places(self, side: str, texts: Sequence[str]) -> None:
        """Write texts at 0, 1, 2 … of an axis in place of numbers; none: numbers again."""
        self._axes[side].setTicks([list(enumerate(texts))] if texts else None)
        self._repaint()

    def empty(self, sentence: Text) -> None:
        """Show a sentence in place of axes and curves, which mean nothing yet; "": show these."""
        sentence = tr(sentence)
        if sentence == self._instead.text():
            return
        self._instead.setText(sentence)
        self._instead.setVisible(bool(sentence))
        self.setAccessibleDescription(sentence)
        self.getPlotItem().setVisible(not sentence)
        self._repaint()

    def resizeEvent(self, event: QResizeEvent | None) -> None:
        """Keep the sentence of an empty plot in its middle."""
        super().resizeEvent(event)
        if event is not None:
            self._instead.setGeometry(self.rect().adjusted(GAP, STEP, -GAP, -STEP))

    def curve(self, pen: LinePen) -> Trace:
        """Add an empty curve for data known to be finite."""
        item = Trace(self._canvas.update)
        self._canvas.traces.append(item)
        self.draw_with(pen, item)
        return item

    def dots(self, pen: LinePen) -> Dots:
        """Add points that no line joins, none yet."""
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
        """Draw curves or lines with a pen, in every theme."""
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
        """Show values from low to high, by steps that keep still; nothing new when they are NaN."""
        if math.isfinite(low) and math.isfinite(high):
            self.empty("")
        if self.steady.update(low, high) and self.steady.range is not None:
            self.show_range("y", *self.steady.range)

    def show_marks(self, **parts: Any) -> None:
        """Show names, limits, moments or spots (see ``Marks``); the others stay."""
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
        """Return what stands on the plot beside its curves."""
        return self._marks

    def start_afresh(self) -> None:
        """Forget range, room and marks: what is drawn next is of another test."""
        self.steady.forget()
        self._room.start_afresh(self)
        self.cursors.clear()
        self.show_marks(names=(), limits=(), moments=(), spots=())

    def drawBackground(self, painter: QPainter, rect: QRectF) -> None:
        """Paint what lies behind the curves."""
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
        """Paint what lies before the curves."""
        if self.instead:
            return
        frame, marks = self._frame(), self._marks
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        taken: list[QRectF] = []
        paint_spots(painter, frame, marks.spots, self.theme, taken)
        taken += trip_lines(frame, marks.moments)
        if marks.limits:
            traces = [one for one in self._canvas.traces if len(one.x)]
            curves = [(frame.x(one.x), frame.y(one.y)) for one in traces]
            paint_limit_words(painter, frame, marks.limits, self.theme, taken, curves)
            paint_next_limits(painter, frame, marks.limits, self.theme, taken, curves)
        paint_names(painter, frame, marks.names, self.theme)
        if self.cursors.places:
            rows = self.cursor_readout()
            paint_readout(painter, frame, self.cursors.places, rows, self.theme)

    def _repaint(self, *_: object) -> None:
        self._placed = None
        self.resetCachedContent()
        self.viewport().update()

    def _frame(self) -> PlotFrame:
        if self._placed is None:
            view = self.getViewBox()
            across, up = view.viewRange()
            self._placed = PlotFrame(view.sceneBoundingRect(), tuple(across), tuple(up))
        return self._placed

    def give_room(self) -> None:
        """Leave room for moments above the curves, and for names beside them."""
        self.getPlotItem().layout.setContentsMargins(0, self._top, self._room.width, 0)

    def guide(self, at: float, *, horizontal: bool) -> pg.InfiniteLine:
        """Add a calm line where the grid has none."""
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
"""Called with the place of the cursor on the x axis; None takes the cursor away."""


class CursorPlot(QuietPlot):
    """A plot with a cursor that a click puts somewhere and Esc takes away."""

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
        """Take the cursor away by Esc."""
        if event.key() != Qt.Key.Key_Escape:
            return super().own_key(event)
        self._pointed(None)
        return True

    def cursor_text(self, at: float) -> str:
        """Return what stands at the cursor."""
        return grouped(round(at))

    def drawForeground(self, painter: QPainter, rect: QRectF) -> None:
        """Paint what lies before the curves, and where the cursor is."""
        super().drawForeground(painter, rect)
        if self.cursor_line.isVisible() and not self.instead:
            at = self.cursor_line.value()
            paint_cursor(painter, self._frame(), at, self.cursor_text(at), self.theme)

    def show_cursor(self, at: float | None) -> None:
        """Put the cursor somewhere, or take it away."""
        self.cursor_line.setVisible(at is not None)
        if at is not None:
            self.cursor_line.setValue(at)
        self.viewport().update()

    def _clicked(self, event: Any) -> None:
        view = self.getViewBox()
        if view.sceneBoundingRect().contains(event.scenePos()):
            self._pointed(float(view.mapSceneToView(event.scenePos()).x()))


NO_REVOLUTION: Final[Text] = "No revolution measured yet"
"""The beginning of the sentence of a plot that waits for the first one."""


class PlotPanel(QWidget):
    """A panel of plots: in a new theme every plot on it is drawn anew.

    The data that is drawn is held weakly: a panel that nobody looks at keeps no test that is over.
    """

    def __init__(self, name: str, spoken: Text) -> None:
        super().__init__()
        self._data: ref[LiveData] | None = None
        named(self, name, spoken, role="card")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setContentsMargins(GAP, STEP, GAP, STEP)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        for plot in self.findChildren(QuietPlot):
            plot.dress(theme)

    def minimumSizeHint(self) -> QSize:
        """Return what it needs at its width: a splitter does not ask how its texts wrap."""
        least, layout = super().minimumSizeHint(), self.layout()
        if layout is not None and layout.hasHeightForWidth():
            least.setHeight(max(least.height(), layout.totalMinimumHeightForWidth(self.width())))
        return least

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Take note that texts wrap otherwise now."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def take_data(self, data: LiveData) -> bool:
        """Take the data that is drawn from now on; return whether it is other than before."""
        other = self._data is None or data is not self._data()
        if other:
            self._data = ref(data)
        return other

    def showEvent(self, event: QShowEvent) -> None:
        """Show nothing of a test that is over: what is new is drawn in a turn of its own."""
        if self._data is not None and self._data() is None:
            for plot in self.findChildren(QuietPlot):
                plot.empty(NO_REVOLUTION)
        super().showEvent(event)


def plot_heading(text: Text) -> QLabel:
    """Return the title of a card, or of a part of it."""
    made = QLabel(tr(text))
    made.setFont(sized(made.font(), BODY_PT, QFont.Weight.DemiBold))
    return made


def remark(name: str, spoken: Text) -> QLabel:
    """Return what is said in a few words below a title; it wraps."""
    return prose(name, spoken, role="caption")


def detail(name: str, spoken: Text) -> ShortLabel:
    """Return what stands beside a title: unit, revolution; its short text has always room."""
    made = ShortLabel(name, spoken)
    made.setProperty("role", "secondary")
    made.setContentsMargins(STEP // 2, 0, STEP // 2, 0)
    return made
