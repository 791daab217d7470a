"""The state bar: is all well? Legible from three metres, grey unless something is not normal."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFontMetrics,
    QPainter,
    QPaintEvent,
    QPolygonF,
)
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QProgressBar,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from rigapp.gui.plots.palette import Theme
from rigapp.gui.widgets.labels import ElidedLabel, FittedLabel, scaled_font
from rigapp.gui.window.headline import Headline, Level, StateShape, TileText

MARKS = {Level.NORMAL: "", Level.WARNING: "▲ ", Level.CRITICAL: "◆ "}


class ShapeMark(QWidget):
    """Draw the shape of the state."""

    def __init__(self, size: int) -> None:
        super().__init__()
        self._shape = StateShape.ARROWS
        self._colour = QColor("black")
        self.setFixedSize(QSize(size, size))
        self.setObjectName("state_shape")
        self.setAccessibleName("Shape of the state")

    def show_shape(self, shape: StateShape, colour: str) -> None:
        """Show a shape in a colour."""
        if shape is not self._shape or QColor(colour) != self._colour:
            self._shape, self._colour = shape, QColor(colour)
            self.setAccessibleDescription(shape.value)
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the shape within the unit square of the widget."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(self._colour)
        side = min(self.width(), self.height())
        painter.scale(side, side)
        _SHAPES[self._shape](painter)
        painter.end()


def _circle(painter: QPainter) -> None:
    painter.drawEllipse(QRectF(0.15, 0.15, 0.7, 0.7))


def _triangle(painter: QPainter) -> None:
    _polygon(painter, (0.18, 0.08), (0.92, 0.5), (0.18, 0.92))


def _bars(painter: QPainter) -> None:
    painter.drawRect(QRectF(0.18, 0.1, 0.24, 0.8))
    painter.drawRect(QRectF(0.58, 0.1, 0.24, 0.8))


def _square(painter: QPainter) -> None:
    painter.drawRect(QRectF(0.14, 0.14, 0.72, 0.72))


def _arrows(painter: QPainter) -> None:
    for left in (0.04, 0.36, 0.68):
        _polygon(painter, (left, 0.22), (left + 0.28, 0.5), (left, 0.78))


def _diamond(painter: QPainter) -> None:
    _polygon(painter, (0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5))
    painter.setBrush(QColor("white"))
    painter.drawRect(QRectF(0.44, 0.2, 0.12, 0.36))
    painter.drawEllipse(QRectF(0.43, 0.64, 0.14, 0.14))


def _broken(painter: QPainter) -> None:
    _polygon(painter, (0.0, 0.4), (0.34, 0.4), (0.26, 0.6), (0.0, 0.6))
    _polygon(painter, (1.0, 0.4), (0.72, 0.4), (0.64, 0.6), (1.0, 0.6))
    _polygon(painter, (0.56, 0.1), (0.66, 0.1), (0.44, 0.9), (0.34, 0.9))


def _polygon(painter: QPainter, *corners: tuple[float, float]) -> None:
    painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in corners]))


_SHAPES = {
    StateShape.CIRCLE: _circle,
    StateShape.TRIANGLE: _triangle,
    StateShape.BARS: _bars,
    StateShape.SQUARE: _square,
    StateShape.ARROWS: _arrows,
    StateShape.DIAMOND: _diamond,
    StateShape.BROKEN: _broken,
}


class Tile(QFrame):
    """Show a caption, a large value and one line below it."""

    def __init__(self, name: str, caption: str, theme: Theme, factor: float) -> None:
        super().__init__()
        self._theme = theme
        self._level: Level | None = None
        self._caption_text = caption
        self.setObjectName(f"tile_{name}")
        self.setAccessibleName(caption)
        self.caption = QLabel(caption)
        self.caption.setObjectName(f"{name}_caption")
        self.caption.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.value = FittedLabel(f"{name}_value", caption, scaled_font(self, factor, bold=True))
        self.detail = ElidedLabel(f"{name}_detail", f"{caption}, detail")
        self.column = QVBoxLayout(self)
        self.column.setContentsMargins(8, 2, 8, 2)
        self.column.setSpacing(0)
        for widget in (self.caption, self.value, self.detail):
            self.column.addWidget(widget)
        self.column.addStretch(1)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        level, self._level = self._level, None
        self._set_level(level or Level.NORMAL)

    def show_field(self, field: TileText) -> None:
        """Show a field."""
        self._set_level(field.level)
        self.value.show_text(field.value)
        self.detail.show_text(field.detail)
        self.setAccessibleDescription(f"{MARKS[field.level]}{field.value} {field.detail}".strip())

    def _set_level(self, level: Level) -> None:
        if level is self._level:
            return
        self._level = level
        theme = self._theme
        colours = {
            Level.NORMAL: (theme.window, theme.text, theme.muted),
            Level.WARNING: (theme.warning, theme.on_signal, theme.on_signal),
            Level.CRITICAL: (theme.critical, *_on_critical(theme)),
        }
        back, text, small = colours[level]
        self.caption.setText(MARKS[level] + self._caption_text)
        self.setStyleSheet(
            f"#{self.objectName()} {{ background: {back}; border: 1px solid {theme.border};"
            f" border-radius: 4px; }} QLabel {{ color: {text}; background: transparent; }}"
            f" #{self.caption.objectName()}, #{self.detail.objectName()} {{ color: {small}; }}"
        )

    @property
    def foreground(self) -> str:
        """Return the colour of the text on the tile's present background."""
        if self._level is Level.CRITICAL:
            return _on_critical(self._theme)[0]
        return self._theme.on_signal if self._level is Level.WARNING else self._theme.text


def _on_critical(theme: Theme) -> tuple[str, str]:
    ink = "#ffffff" if theme.name == "light" else "#000000"
    return ink, ink


class Header(QWidget):
    """Hold the tiles in one row and the identity of test, rig and file below."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.setObjectName("header")
        self.setAccessibleName("State of the test")
        self.state = Tile("state", "State", theme, 2.6)
        self.cycle = Tile("cycle", "Cycle", theme, 2.2)
        self.end = Tile("end", "Ends", theme, 1.9)
        self.age = Tile("age", "Data age", theme, 1.9)
        self.margin = Tile("margin", "Least margin to a limit", theme, 1.9)
        self.agreement = Tile("agreement", "Measured − model", theme, 1.9)
        self.alarms = Tile("alarms", "Alarms", theme, 1.9)
        height = QFontMetrics(self.state.value.font()).height()
        self.shape = ShapeMark(int(height * 0.95))
        self._put_shape_beside_state()
        self.progress = QProgressBar()
        self.progress.setObjectName("progress")
        self.progress.setAccessibleName("Progress of the test")
        self.progress.setTextVisible(False)
        self.progress.setMaximum(1000)
        self.progress.setFixedHeight(max(6, height // 7))
        self.cycle.column.addWidget(self.progress)
        self.line = ElidedLabel("identity", "Test, rig and file")
        self._lay_out()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        for tile in self._tiles():
            tile.dress(theme)

    def show_headline(self, shown: Headline) -> None:
        """Show a headline; what has not changed is not repainted."""
        self.state.show_field(shown.state)
        self.shape.show_shape(shown.shape, self.state.foreground)
        self.cycle.show_field(shown.cycle)
        self.progress.setValue(min(1000, int(1000 * shown.progress)))
        self.end.show_field(shown.end)
        self.age.show_field(shown.age)
        self.margin.show_field(shown.margin)
        self.agreement.show_field(shown.agreement)
        self.alarms.show_field(shown.alarms)
        self.line.show_text(shown.line)

    def _tiles(self) -> tuple[Tile, ...]:
        return (
            self.state,
            self.cycle,
            self.end,
            self.age,
            self.margin,
            self.agreement,
            self.alarms,
        )

    def _put_shape_beside_state(self) -> None:
        self.state.column.removeWidget(self.state.value)
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(self.shape)
        row.addWidget(self.state.value, 1)
        self.state.column.insertLayout(1, row)

    def _lay_out(self) -> None:
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(4)
        for column, (tile, stretch) in enumerate(
            zip(self._tiles(), (30, 32, 16, 13, 20, 19, 20), strict=True)
        ):
            grid.addWidget(tile, 0, column)
            grid.setColumnStretch(column, stretch)
        grid.addWidget(self.line, 1, 0, 1, len(self._tiles()))
