"""A plot handled by mouse and keys: a part shown larger, and two cursors with their readings."""

from __future__ import annotations

import pyqtgraph as pg
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QKeyEvent, QMouseEvent
from PySide6.QtWidgets import QRubberBand

from rigapp.gui.plots.readings import LARGE_STEP, SMALL_STEP, CursorPair

DRAG = 12
"""Least size of a rectangle in pixels, either way: less is a click with an unsteady hand."""


class HandledPlot(pg.PlotWidget):  # type: ignore[misc]
    """Show a part larger, and move two cursors, the same on every plot.

    Subclasses define the sentence in place of the curves (``instead``), and repaint.
    """

    def __init__(self, **options: object) -> None:
        """Make it with the options of pyqtgraph's widget."""
        super().__init__(**options)
        self._home: dict[str, tuple[float, float]] = {}
        self._movable = (False, False)
        self._pressed: QPoint | None = None
        self.cursors = CursorPair()
        self._frame_drawn = QRubberBand(QRubberBand.Shape.Rectangle, self)

    @property
    def zoomed(self) -> bool:
        """Tell whether a part is shown larger."""
        return bool(self._home)

    def show_range(self, side: str, low: float, high: float, padding: float = 0.0) -> None:
        """Show values from low to high on an axis, "x" or "y"; while zoomed, after the zoom."""
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
        """Show the ranges outside of the zoom."""
        home, self._home = self._home, {}
        if home:
            self.setMouseEnabled(*self._movable)
        for side, (low, high) in home.items():
            self.show_range(side, low, high)
        self._repaint()

    def show_cursors(self, *, both: bool = True) -> None:
        """Put both cursors where they are visible, or remove them."""
        if both:
            self.cursors.show(*self.viewRange()[0])
        else:
            self.cursors.clear()
        self._read_cursors()

    @property
    def instead(self) -> str:
        """Return the sentence in place of the curves, empty when these are shown."""
        return ""

    def _read_cursors(self) -> None:
        """Repaint after the cursors have moved."""
        self.viewport().update()

    def _repaint(self, *_: object) -> None:
        self.resetCachedContent()
        self.viewport().update()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move the two cursors, show all again by Backspace; pass other keys to ``own_key``."""
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
        """Begin a rectangle, or a click; with Shift put a cursor."""
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
            corners = [self.mapToScene(corner) for corner in (area.topLeft(), area.bottomRight())]
            first, last = (self.getViewBox().mapSceneToView(corner) for corner in corners)
            self.zoom((first.x(), last.x()), (last.y(), first.y()))
            event.accept()
            return
        super().mouseReleaseEvent(event)
