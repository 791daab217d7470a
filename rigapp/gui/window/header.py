"""The state bar, legible from three metres and grey in normal state; the message line below it."""

from __future__ import annotations

import time
from dataclasses import dataclass

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QPainter,
    QPaintEvent,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QFrame, QLabel, QProgressBar, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.fonts import sized
from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import column, named, row
from rigapp.gui.widgets.labels import ElidedLabel, FittedLabel
from rigapp.gui.window.headline import Headline, StateShape, TileText
from rigapp.presentation.times import dated
from rigapp.presentation.tokens import CAPTION_PT, GAP, LARGE_PT, MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.shown import MARKS, Level

REFUSAL_S = 20.0
"""Time for which the reason of a refusal has half of the line; its tool tip has the full text."""
HEIGHT = 13 * STEP // 2
"""Height of ``MESSAGE_LINES`` of text, enough for a cause and its remedy at 1366 pixels."""


class MessageLine(QFrame):
    """The line below the state bar: statements and questions, the last answer, and the time.

    bars: the questions, then the notice; while a bar is shown, later ones and the answer are
    hidden.
    """

    def __init__(self, bars: tuple[Bar, ...], answer: QWidget, theme: Theme) -> None:
        super().__init__()
        named(self, "message_line", "Messages")
        self.setMinimumHeight(HEIGHT)
        self.clock = named(QLabel(), "clock", "Time")
        self.clock.setFixedWidth(18 * STEP)
        self.clock.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        *asking, notice = bars
        self._asking, self._statements = tuple(asking), QWidget()
        self._shares = statements = row((notice, 1), (answer, 1), on=self._statements)
        statements.setContentsMargins(0, 0, 0, 0)
        statements.setSpacing(GAP)
        self._refused_at: float | None = None
        self.give_room(refused=False)
        self._row = row(*((bar, 1) for bar in asking), (self._statements, 1), self.clock, on=self)
        self._row.setSpacing(GAP)
        self.make_room(tight=False)
        for bar in bars:
            bar.setMinimumHeight(HEIGHT - 1)
            bar.installEventFilter(self)
        self.dress(theme)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Show one bar at a time."""
        if event.type() in (QEvent.Type.ShowToParent, QEvent.Type.HideToParent):
            asking = any(not bar.isHidden() for bar in self._asking)
            if self._statements.isHidden() is not asking:
                self._statements.setHidden(asking)
        return super().eventFilter(watched, event)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        dress_part(
            self,
            theme,
            f"#message_line {{ background: {theme.alternate};"
            f" border-bottom: 1px solid {theme.hairline}; }}"
            f" #clock {{ color: {theme.muted}; font-size: {CAPTION_PT}pt; }}",
        )

    def make_room(self, *, tight: bool) -> None:
        """Hide the time in a tight window."""
        self.clock.setVisible(not tight)
        self._row.setContentsMargins(0, 0, 0 if tight else MARGIN, 1)

    def give_room(self, *, refused: bool) -> None:
        """Divide the line between message and answer; the reason of a refusal gets half of it."""
        self._refused_at = time.monotonic() if refused else None
        for index, share in enumerate((1, 1) if refused else (5, 2)):
            self._shares.setStretch(index, share)

    def show_time(self) -> None:
        """Show the time of day; return the room of an old refusal to the message."""
        if self._refused_at is not None and time.monotonic() - self._refused_at > REFUSAL_S:
            self.give_room(refused=False)
        now = dated("%a %d %b  %H:%M:%S", time.localtime())
        if now != self.clock.text():
            self.clock.setText(now)


BAR_HEIGHT = 5
"""Height of the bars in tiles, pixels; thin, since the number shows the exact value."""


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
            self.setAccessibleDescription(tr(shape.value))
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
"""Shapes within the unit square, except the circle."""


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


@dataclass(frozen=True, slots=True)
class TileSpec:
    """One tile of the state bar: name in the headline, caption, size of the value, share.

    from_width: minimum width of a state bar that shows the tile. short: a shorter caption.
    """

    name: str
    caption: Text
    points: float
    share: int
    from_width: int = 0
    short: Text = ""


class Tile(QFrame):
    """Show a caption, a value, an optional bar, and one line below it."""

    def __init__(self, spec: TileSpec, theme: Theme) -> None:
        super().__init__()
        name = spec.name
        self._theme = theme
        self._look: tuple[int, bool] = Level.NORMAL, False
        caption = self._caption_text = tr(spec.caption)
        self._short = tr(spec.short)
        named(self, f"tile_{name}", caption)
        self.caption = ElidedLabel(f"{name}_caption", caption)
        self.value = FittedLabel(
            f"{name}_value", caption, sized(self.font(), spec.points, QFont.Weight.DemiBold)
        )
        self.detail = ElidedLabel(f"{name}_detail", tr("{}, detail", caption))
        small = sized(self.font(), CAPTION_PT)
        for label in (self.caption, self.detail):
            label.setFont(small)
        self.column = column(self.caption, self.value, None, self.detail, on=self)
        self.column.setContentsMargins(MARGIN, STEP, STEP, STEP)
        self.column.setSpacing(2)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self._show_look()

    def show_field(self, field: TileText) -> None:
        """Show a field."""
        if (field.level, field.old) != self._look:
            self._look = field.level, field.old
            self._show_look()
        self.value.show_text(field.value)
        self.detail.show_text(field.detail, field.short)
        text = f"{MARKS[Level(field.level)]}{self.value.whole} {self.detail.whole}"
        self.setAccessibleDescription(text.strip())

    def _show_look(self) -> None:
        """Colour the tile by its level; an old value is grey, except on a coloured tile."""
        theme, (level, old) = self._theme, self._look
        colours: dict[int, tuple[str, str, str]] = {
            Level.NORMAL: (theme.base, theme.muted if old else theme.text, theme.muted),
            Level.WARNING: (theme.warning, theme.on_signal, theme.on_signal),
            Level.CRITICAL: (theme.critical, theme.on_critical, theme.on_critical),
        }
        back, text, small = colours[level]
        mark = MARKS[Level(level)]
        self.caption.show_text(mark + self._caption_text, self._short and mark + self._short)
        self.setStyleSheet(
            f"#{self.objectName()} {{ background: {back}; border: 0;"
            f" border-right: 1px solid {theme.hairline}; }}"
            f" QLabel {{ color: {text}; background: transparent; }}"
            f" #{self.caption.objectName()}, #{self.detail.objectName()} {{ color: {small}; }}"
        )

    @property
    def foreground(self) -> str:
        """Return the colour of the text on the tile's present background."""
        level, theme = self._look[0], self._theme
        return (theme.text, theme.on_signal, theme.on_critical)[level]


TILES = (
    TileSpec("state", "State", LARGE_PT, 248),
    TileSpec("cycle", "Cycle", LARGE_PT, 296),
    TileSpec("force", "|F| maximum", VALUE_PT, 192),
    TileSpec("wear", "Wear depth", VALUE_PT, 264, 760),
    TileSpec("agreement", "Measured − model", VALUE_PT, 160, 840, "Δ model"),
    TileSpec("alarms", "Alarms", LARGE_PT, 184),
)
"""The tiles in order; a share is the width in a window of 1440 pixels."""

STRIP_HEIGHT = 14 * STEP
TIGHT_HEIGHT = 11 * STEP
TIGHT_PT = 18.0
"""Font size of the large values in a tight window, where they remain the largest."""


class Header(QFrame):
    """The state bar: tiles in a strip of constant height."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        named(self, "header", "State of the test")
        self.setFixedHeight(STRIP_HEIGHT)
        self.tiles = {spec.name: Tile(spec, theme) for spec in TILES}
        layout = row(*((self.tiles[spec.name], spec.share) for spec in TILES), on=self)
        layout.setContentsMargins(0, 0, 0, 1)
        layout.setSpacing(0)
        self.state = self.tiles["state"]
        self.shape = ShapeMark(int(0.6 * self.state.value.height()))
        self.state.column.removeWidget(self.state.value)
        beside = row(self.shape, (self.state.value, 1))
        beside.setSpacing(STEP)
        self.state.column.insertLayout(1, beside)
        self.progress = self._bar("cycle", "progress", "Progress of the test")
        self.margin = self._bar("force", "margin", "Force against its limit")
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        dress_part(
            self,
            theme,
            f"#header {{ background: {theme.base}; border-bottom: 1px solid {theme.hairline}; }}",
        )
        for tile in self.tiles.values():
            tile.dress(theme)

    def make_room(self, *, tight: bool) -> None:
        """Reduce the height in a tight window."""
        self.setFixedHeight(TIGHT_HEIGHT if tight else STRIP_HEIGHT)
        for spec in TILES:
            tile = self.tiles[spec.name]
            points = min(spec.points, TIGHT_PT) if tight else spec.points
            tile.value.set_largest(sized(self.font(), points, QFont.Weight.DemiBold))
        self.shape.setFixedSize(*(2 * [int(0.6 * self.state.value.height())]))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the tiles without room."""
        super().resizeEvent(event)
        for spec in TILES:
            self.tiles[spec.name].setVisible(self.width() >= spec.from_width)

    def show_headline(self, shown: Headline) -> None:
        """Show a headline; unchanged parts are not repainted."""
        for name, tile in self.tiles.items():
            tile.show_field(getattr(shown, name))
        self.shape.show_shape(shown.shape, self.state.foreground)
        for bar, share in ((self.progress, shown.progress), (self.margin, shown.used)):
            bar.setValue(min(bar.maximum(), int(bar.maximum() * share)))

    def _bar(self, tile: str, name: str, spoken: Text) -> QProgressBar:
        bar = named(QProgressBar(), name, spoken)
        bar.setTextVisible(False)
        bar.setMaximum(1000)
        bar.setFixedHeight(BAR_HEIGHT)
        self.tiles[tile].column.insertWidget(2, bar)
        return bar
