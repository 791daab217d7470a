"""Interaction of plots by mouse and keys: zoom, and two cursors with readings."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QRubberBand

from rigapp.gui.plots.readings import LARGE_STEP, SMALL_STEP, CursorPair

DRAG = 12
"""Minimum width and height of a rectangle in pixels; a smaller one is treated as a click."""


class HandledPlot(pg.PlotWidget):  # type: ignore[misc]
    """Zoom, and move two cursors, with the same keys on every plot.

    Subclasses define the sentence shown in place of the curves (``instead``), and repaint.
    """

    def __init__(self, **options: object) -> None:
        """Make the plot with the options of pyqtgraph's widget."""
        super().__init__(**options)
        self._home: dict[str, tuple[float, float]] = {}
        self._movable = (False, False)
        self._pressed: QPoint | None = None
        self.cursors = CursorPair()
        self._frame_drawn = QRubberBand(QRubberBand.Shape.Rectangle, self)

    @property
    def zoomed(self) -> bool:
        """Return whether the plot is zoomed."""
        return bool(self._home)

    def show_range(self, side: str, low: float, high: float, padding: float = 0.0) -> None:
        """Set the range of an axis, "x" or "y"; while zoomed it applies after the zoom."""
        if side in self._home:
            self._home[side] = (low, high)
        else:
            (self.setXRange if side == "x" else self.setYRange)(low, high, padding=padding)

    def zoom(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Zoom to a part, until ``zoom_back``."""
        if not self._home:
            across, up = self.getViewBox().viewRange()
            self._home = {"x": tuple(across), "y": tuple(up)}
            self._movable = tuple(self.getViewBox().state["mouseEnabled"])
            self.setMouseEnabled(x=True, y=True)
        self.setXRange(*x, padding=0.0)
        self.setYRange(*y, padding=0.0)
        self._repaint()

    def zoom_back(self) -> None:
        """End the zoom: show the normal ranges."""
        home, self._home = self._home, {}
        if home:
            self.setMouseEnabled(*self._movable)
        for side, (low, high) in home.items():
            self.show_range(side, low, high)
        self._repaint()

    def show_cursors(self, *, both: bool = True) -> None:
        """Place both cursors within the visible range, or remove them."""
        if both:
            self.cursors.show(*self.viewRange()[0])
        else:
            self.cursors.clear()
        self._read_cursors()

    @property
    def instead(self) -> str:
        """Return the sentence shown in place of the curves, empty when these are shown."""
        return ""

    def _read_cursors(self) -> None:
        """Repaint after the cursors have moved."""
        self.viewport().update()

    def _repaint(self, *_: object) -> None:
        self.resetCachedContent()
        self.viewport().update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the two cursors, end the zoom by Backspace; pass other keys to ``own_key``."""
        if self._cursor_key(event):
            self._read_cursors()
        elif event.key() == Qt.Key.Key_Backspace and self.zoomed:
            self.zoom_back()
        elif not self.own_key(event):
            super().keyPressEvent(event)

    def own_key(self, event: QKeyEvent) -> bool:
        """Handle a key specific to this plot; return whether it was handled."""
        return False

    def _cursor_key(self, event: QKeyEvent) -> bool:
        """Handle a key for the two cursors, the same on every plot."""
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
        """Begin a rectangle or a click; with Shift place a cursor."""
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
        """Zoom to the rectangle; treat one that is too small as a click."""
        self._pressed = None
        if self._frame_drawn.isVisible():
            self._frame_drawn.hide()
            self.scene().clickEvents.clear()  # else the next click is at the rectangle's start
            area = self._frame_drawn.geometry()
            corners = [self.mapToScene(corner) for corner in (area.topLeft(), area.bottomRight())]
            first, last = (self.getViewBox().mapSceneToView(corner) for corner in corners)
            self.zoom((first.x(), last.x()), (last.y(), first.y()))
            event.accept()
            return
        super().mouseReleaseEvent(event)
