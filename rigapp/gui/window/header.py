"""The state bar: is all well? Legible from three metres, grey unless something is not normal."""

from __future__ import annotations

from collections.abc import Sequence

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
    QLabel,
    QProgressBar,
    QSizePolicy,
    QWidget,
)

from rigapp.gui.data.channels import FreeValue
from rigapp.gui.plots.palette import Theme
from rigapp.gui.widgets.build import column, named, row
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
        named(self, "state_shape", "Shape of the state")

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
        paint_shape(painter, self._shape)
        painter.end()


Points = tuple[tuple[float, float], ...]


def _rectangle(left: float, top: float, width: float, height: float) -> Points:
    right, bottom = left + width, top + height
    return (left, top), (right, top), (right, bottom), (left, bottom)


POLYGONS: dict[StateShape, tuple[Points, ...]] = {
    StateShape.TRIANGLE: (((0.18, 0.08), (0.92, 0.5), (0.18, 0.92)),),
    StateShape.BARS: (_rectangle(0.18, 0.1, 0.24, 0.8), _rectangle(0.58, 0.1, 0.24, 0.8)),
    StateShape.SQUARE: (_rectangle(0.14, 0.14, 0.72, 0.72),),
    StateShape.ARROWS: tuple(
        ((left, 0.22), (left + 0.28, 0.5), (left, 0.78)) for left in (0.04, 0.36, 0.68)
    ),
    StateShape.DIAMOND: (((0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5)),),
    StateShape.BROKEN: (
        ((0.0, 0.4), (0.34, 0.4), (0.26, 0.6), (0.0, 0.6)),
        ((1.0, 0.4), (0.72, 0.4), (0.64, 0.6), (1.0, 0.6)),
        ((0.56, 0.1), (0.66, 0.1), (0.44, 0.9), (0.34, 0.9)),
    ),
}
"""The shapes within the unit square; the circle is none of them."""


def paint_shape(painter: QPainter, shape: StateShape) -> None:
    """Paint a shape with the painter's brush within the unit square."""
    if shape is StateShape.CIRCLE:
        painter.drawEllipse(QRectF(0.15, 0.15, 0.7, 0.7))
    for corners in POLYGONS.get(shape, ()):
        painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in corners]))
    if shape is StateShape.DIAMOND:
        painter.setBrush(QColor("white"))
        painter.drawRect(QRectF(0.44, 0.2, 0.12, 0.36))
        painter.drawEllipse(QRectF(0.43, 0.64, 0.14, 0.14))


class Tile(QFrame):
    """Show a caption, a large value and one line below it."""

    def __init__(self, name: str, caption: str, theme: Theme, factor: float) -> None:
        super().__init__()
        self._theme = theme
        self._level: Level | None = None
        self._caption_text = caption
        named(self, f"tile_{name}", caption)
        self.caption = named(QLabel(caption), f"{name}_caption", caption)
        self.caption.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.value = FittedLabel(f"{name}_value", caption, scaled_font(self, factor, bold=True))
        self.detail = ElidedLabel(f"{name}_detail", f"{caption}, detail")
        self.column = column(self.caption, self.value, self.detail, None, on=self)
        self.column.setContentsMargins(8, 2, 8, 2)
        self.column.setSpacing(0)
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
            Level.CRITICAL: (theme.critical, theme.on_critical, theme.on_critical),
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
            return self._theme.on_critical
        return self._theme.on_signal if self._level is Level.WARNING else self._theme.text


TILES = (
    ("state", "State", 2.6, 30),
    ("cycle", "Cycle", 2.2, 32),
    ("end", "Ends", 1.9, 16),
    ("age", "Data age", 1.9, 13),
    ("margin", "Least margin to a limit", 1.9, 20),
    ("agreement", "Measured − model", 1.9, 19),
    ("alarms", "Alarms", 1.9, 20),
)
"""The tiles in order: name in the headline, caption, size of the value, share of the width."""

FREE_SIZE = 1.3
"""Size of a free channel's value: read at the desk, not from three metres."""


class Header(QWidget):
    """Hold the tiles in one row, the identity of test, rig and file below, then free channels."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        named(self, "header", "State of the test")
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setSpacing(4)
        self.tiles: dict[str, Tile] = {}
        for place, (name, caption, factor, share) in enumerate(TILES):
            self.tiles[name] = Tile(name, caption, theme, factor)
            grid.addWidget(self.tiles[name], 0, place)
            grid.setColumnStretch(place, share)
        self.state = self.tiles["state"]
        height = QFontMetrics(self.state.value.font()).height()
        self.shape = ShapeMark(int(height * 0.95))
        self.state.column.removeWidget(self.state.value)
        beside = row(self.shape, (self.state.value, 1))
        beside.setSpacing(8)
        self.state.column.insertLayout(1, beside)
        self.progress = named(QProgressBar(), "progress", "Progress of the test")
        self.progress.setTextVisible(False)
        self.progress.setMaximum(1000)
        self.progress.setFixedHeight(max(6, height // 7))
        self.tiles["cycle"].column.addWidget(self.progress)
        self.line = ElidedLabel("identity", "Test, rig and file")
        grid.addWidget(self.line, 1, 0, 1, len(TILES))
        self._theme = theme
        self.free: dict[str, Tile] = {}
        self._free_row = row()
        grid.addLayout(self._free_row, 2, 0, 1, len(TILES))

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        for tile in (*self.tiles.values(), *self.free.values()):
            tile.dress(theme)

    def show_headline(self, shown: Headline) -> None:
        """Show a headline; what has not changed is not repainted."""
        for name, tile in self.tiles.items():
            tile.show_field(getattr(shown, name))
        self.shape.show_shape(shown.shape, self.state.foreground)
        self.progress.setValue(min(1000, int(1000 * shown.progress)))
        self.line.show_text(shown.line)

    def show_free(self, values: Sequence[FreeValue]) -> None:
        """Show a tile for each free channel of the rig, in a row of their own."""
        for gone in self.free.keys() - {one.name for one in values}:
            self.free.pop(gone).deleteLater()
        for one in values:
            if one.name not in self.free:
                made = Tile(f"free_{one.name}", one.title, self._theme, FREE_SIZE)
                self.free[one.name] = made
                self._free_row.addWidget(made, 1)
            self.free[one.name].show_field(TileText(one.value, one.detail))
