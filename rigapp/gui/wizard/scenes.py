"""Pictures of a step at the rig: crank and weights, level, probe, slow roll."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetricsF, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.widgets.build import named
from rigapp.presentation.tokens import BODY_PT, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr
from rigapp_calibration.load_cell.weights import piece_texts

LEAST = QSize(30 * STEP, 24 * STEP)
"""Minimum size; below it the texts on the weights overlap."""

LINE, THIN = 2.0, 1.0
HEAD = 1.4 * STEP
ARM = 0.2
"""Length of the crank, as a share of the picture's height."""
LEAST_PIECE, FORCE = 2.5 * STEP, 5.0 * STEP
"""Minimum heights of a weight with its text and of the force below: the crank shrinks first."""


class Scene(Protocol):
    """A picture that can be drawn."""

    def paint(self, brush: Brush, room: QRectF) -> None:
        """Draw the picture into a rectangle."""
        ...


@dataclass(frozen=True, slots=True)
class Piece:
    """Equal weights on the pin: their text, and whether they are added, stay or are removed."""

    words: str
    added: bool = False
    removed: bool = False


def stack_of(pieces: Sequence[float], before: Sequence[float] = ()) -> list[Piece]:
    """Return the weights (kg), heaviest first: unchanged, added now, removed now."""
    now, was = Counter(pieces), Counter(before)
    return [
        *(Piece(words) for words in piece_texts((now & was).elements())),
        *(Piece(f"+ {words}", added=True) for words in piece_texts((now - was).elements())),
        *(Piece(f"\u2212 {words}", removed=True) for words in piece_texts((was - now).elements())),
    ]


class Brush:
    """Painter for parts of scenes in the colours of a theme."""

    def __init__(self, painter: QPainter, theme: Theme, font: QFont) -> None:
        self.painter, self.theme, self._font = painter, theme, font

    def pen(
        self, colour: str, width: float = LINE, *, dashed: bool = False, fill: str = ""
    ) -> None:
        """Set the pen, and the fill colour, or no fill."""
        pen = QPen(QColor(colour), width)
        if dashed:
            pen.setStyle(Qt.PenStyle.DashLine)
        self.painter.setPen(pen)
        self.painter.setBrush(QColor(fill) if fill else Qt.BrushStyle.NoBrush)

    def words(self, at: QPointF, text: str, colour: str, points: float = BODY_PT) -> None:
        """Draw a text centred at a point."""
        font = self._bold(points)
        self.painter.setFont(font)
        self.painter.setPen(QColor(colour))
        metrics = QFontMetricsF(font)
        width, height = metrics.horizontalAdvance(text) + STEP, metrics.height()
        box = QRectF(at.x() - width / 2, at.y() - height / 2, width, height)
        self.painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)

    def boxed(self, box: QRectF, text: str) -> None:
        """Draw a box with a text in it, widened to the text."""
        theme = self.theme
        width = QFontMetricsF(self._bold(BODY_PT)).horizontalAdvance(text) + 2 * STEP
        more = max(width - box.width(), 0.0) / 2
        wide, room = box.adjusted(-more, 0.0, more, 0.0), self.painter.window()
        wide.moveRight(min(wide.right(), room.right() - STEP))
        wide.moveLeft(max(wide.left(), room.left() + STEP))
        self.pen(theme.text, fill=theme.base)
        self.painter.drawRect(wide)
        self.words(wide.center(), text, theme.text)

    def _bold(self, points: float) -> QFont:
        return sized(self._font, points, QFont.Weight.DemiBold)

    def arrow(self, start: QPointF, end: QPointF, colour: str) -> None:
        """Draw a straight arrow."""
        self.pen(colour)
        self.painter.drawLine(start, end)
        self._head(end, math.atan2(end.y() - start.y(), end.x() - start.x()), colour)

    def turn(self, middle: QPointF, radius: float, start: float, sweep: float, colour: str) -> None:
        """Draw an arc with a head; start, sweep: rad, anticlockwise from the right."""
        self.pen(colour)
        box = QRectF(middle.x() - radius, middle.y() - radius, 2 * radius, 2 * radius)
        degrees = [round(16 * math.degrees(angle)) for angle in (start, sweep)]
        self.painter.drawArc(box, *degrees)
        if sweep:
            end = start + sweep
            tip = on_circle(middle, radius, end)
            way = end + math.copysign(math.pi / 2, sweep)
            self._head(tip, -way, colour)

    def _head(self, tip: QPointF, way: float, colour: str) -> None:
        corners = [tip]
        for side in (-0.45, 0.45):
            back = way + math.pi + side
            corners.append(tip + QPointF(math.cos(back), math.sin(back)) * HEAD)
        self.pen(colour, fill=colour)
        self.painter.drawPolygon(QPolygonF(corners))

    def disc(self, middle: QPointF, radius: float) -> None:
        """Draw a circle."""
        self.painter.drawEllipse(middle, radius, radius)


def on_circle(middle: QPointF, radius: float, angle: float) -> QPointF:
    """Return a point on a circle; angle: rad, anticlockwise from the right."""
    return middle + QPointF(math.cos(angle), -math.sin(angle)) * radius


def paint_crank(brush: Brush, middle: QPointF, arm: float, angle: float, colour: str) -> QPointF:
    """Draw the crank with its pin at an angle (rad); return the position of the pin."""
    theme, painter = brush.theme, brush.painter
    pin = on_circle(middle, arm, angle)
    pen = QPen(QColor(colour), 0.5 * arm)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    painter.setPen(pen)
    painter.drawLine(middle, pin)
    pen.setColor(QColor(theme.base))
    pen.setWidthF(0.5 * arm - 2 * LINE)
    painter.setPen(pen)
    painter.drawLine(middle, pin)
    brush.pen(theme.secondary, fill=theme.base)
    brush.disc(middle, 0.34 * arm)
    brush.pen(theme.secondary, fill=theme.secondary)
    brush.disc(middle, 0.07 * arm)
    brush.pen(theme.highlight, fill=theme.tint)
    brush.disc(pin, 0.2 * arm)
    return pin


@dataclass(frozen=True, slots=True)
class WeightScene:
    """The crank at an angle and the weights on its pin.

    angle: rad, of the crank, anticlockwise from level. now: its present angle, None when not known.
    stack: the weights. weight_N: of all weights that should hang, 0 for none. turning: whether the
    crank must be turned to the angle.
    """

    angle: float
    now: float | None = None
    stack: tuple[Piece, ...] = ()
    weight_N: float = 0.0
    turning: bool = False

    def paint(self, brush: Brush, room: QRectF) -> None:
        """Draw crank, angle, weights and their force."""
        theme, arm = brush.theme, ARM * min(room.height(), room.width())
        hangs = len(self.stack) * LEAST_PIECE + (FORCE if self.weight_N > 0.0 else 0.0)
        arm = min(arm, max((room.height() - hangs) / 3.4, STEP))
        middle = QPointF(room.center().x(), room.top() + 1.75 * arm)
        brush.pen(theme.muted, THIN, dashed=True)
        brush.painter.drawLine(middle, middle + QPointF(1.9 * arm, 0.0))
        if self.turning and self.now is not None:
            paint_crank(brush, middle, arm, self.now, theme.strong)
        pin = paint_crank(brush, middle, arm, self.angle, theme.secondary)
        start = self.now if self.turning and self.now is not None else 0.0
        sweep = math.remainder(self.angle - start, 2 * math.pi) if self.turning else self.angle
        colour = theme.highlight if self.turning else theme.secondary
        brush.turn(middle, 1.45 * arm, start, sweep, colour)
        at = QPointF(room.left() + 1.1 * arm, room.top() + 0.4 * arm)
        brush.words(at, f"{math.degrees(self.angle):.0f}\u00b0", theme.highlight, VALUE_PT)
        self._hang(brush, room, pin, middle.y() + 1.65 * arm)

    def _hang(self, brush: Brush, room: QRectF, pin: QPointF, top: float) -> None:
        if not self.stack:
            return
        theme, painter = brush.theme, brush.painter
        force = self.weight_N > 0.0
        height = min(
            4.0 * STEP, (room.bottom() - top - (FORCE if force else 0.0)) / len(self.stack)
        )
        width = 13.0 * STEP
        left = min(max(pin.x() - width / 2, room.left()), room.right() - width)
        brush.pen(theme.text)
        painter.drawLine(pin, QPointF(pin.x(), top))
        for index, piece in enumerate(self.stack):
            box = QRectF(left, top + index * height, width, height - 2.0)
            new = piece.added or piece.removed
            brush.pen(
                theme.highlight if new else theme.text,
                dashed=piece.removed,
                fill=theme.tint if piece.added else theme.base,
            )
            painter.drawRoundedRect(box, 3.0, 3.0)
            brush.words(box.center(), piece.words, theme.highlight if new else theme.text)
        if force:
            foot = QPointF(pin.x(), top + len(self.stack) * height)
            brush.arrow(foot, foot + QPointF(0.0, 3.5 * STEP), theme.text)
            beside = foot + QPointF(6.0 * STEP, 2.0 * STEP)
            brush.words(beside, f"{self.weight_N:.1f} N", theme.text)


@dataclass(frozen=True, slots=True)
class LevelScene:
    """The crank with a spirit level on its flat; turned: the level is turned end for end."""

    now: float | None = None
    turned: bool = False

    def paint(self, brush: Brush, room: QRectF) -> None:
        """Draw crank, level and its bubble; the crank at its present angle, if known."""
        theme, painter = brush.theme, brush.painter
        arm = 1.6 * ARM * min(room.height(), room.width())
        middle = room.center() + QPointF(-0.5 * arm, 0.3 * arm)
        brush.pen(theme.muted, THIN, dashed=True)
        painter.drawLine(middle - QPointF(0.8 * arm, 0.0), middle + QPointF(2.0 * arm, 0.0))
        angle = 0.0 if self.now is None else self.now
        paint_crank(brush, middle, arm, angle, theme.secondary)
        painter.save()
        painter.translate(middle)
        painter.rotate(-math.degrees(angle))
        level = QRectF(0.0, -0.25 * arm - 3.5 * STEP, arm, 3.5 * STEP)
        brush.pen(theme.highlight, fill=theme.tint)
        painter.drawRoundedRect(level, 4.0, 4.0)
        glass = QRectF(0.0, 0.0, 0.5 * arm, 1.5 * STEP)
        glass.moveCenter(level.center())
        brush.pen(theme.highlight, fill=theme.base)
        painter.drawRoundedRect(glass, 6.0, 6.0)
        brush.pen(theme.highlight, fill=theme.highlight)
        painter.drawEllipse(glass.center(), 1.2 * STEP, 0.6 * STEP)
        foot = level.right() if self.turned else level.left()
        painter.drawRect(QRectF(foot - 3.0, level.top(), 6.0, level.height()))
        painter.restore()
        top = QPointF(room.center().x(), room.top() + 2.0 * STEP)
        known = tr("The encoder is not known yet")
        if self.now is not None:
            known = f"{math.degrees(math.remainder(self.now, 2 * math.pi)):+.2f}\u00b0"
        brush.words(top, known, theme.highlight, VALUE_PT)


@dataclass(frozen=True, slots=True)
class ProbeScene:
    """A probe, its target on the micrometer, and the position to set, um.

    indicated_um: the target's position by the calibration in use, NaN when not known. back: the
    micrometer is first turned back past the position.
    """

    probe: int
    position_um: float
    reach_um: float
    indicated_um: float = math.nan
    back: bool = False

    def paint(self, brush: Brush, room: QRectF) -> None:
        """Draw probe, target and micrometer, the scale below them, and the direction to turn."""
        theme, painter = brush.theme, brush.painter
        unit, level = room.width() / 12.0, room.top() + 0.4 * room.height()
        half = 0.13 * room.height()
        middle = room.left() + 6.0 * unit
        at = middle + 2.0 * unit * self._share(self.position_um)
        box = QRectF(room.left() + 0.4 * unit, level - 0.6 * half, 2.6 * unit, 1.2 * half)
        brush.boxed(box, tr("Probe {}", self.probe))
        brush.pen(theme.highlight, fill=theme.tint)
        painter.drawRect(QRectF(at, level - half, 0.5 * unit, 2.0 * half))
        brush.pen(theme.secondary, fill=theme.base)
        thimble = room.left() + 9.6 * unit
        painter.drawRect(QRectF(at + 0.5 * unit, level - 4.0, thimble - at - 0.5 * unit, 8.0))
        painter.drawRoundedRect(QRectF(thimble, level - half, 2.0 * unit, 2.0 * half), 4.0, 4.0)
        for tick in range(1, 6):
            x = thimble + tick * unit / 3.0
            painter.drawLine(QPointF(x, level - half), QPointF(x, level - half + STEP))
        self._scale(brush, room, middle, unit, level + 1.9 * half)
        text = f"{self.position_um:+g} \u00b5m".replace("-", "\u2212")
        brush.words(QPointF(at, room.top() + 2.0 * STEP), text, theme.highlight, VALUE_PT)
        high = level - 1.5 * half
        if self.back:
            brush.arrow(QPointF(at + unit, high), QPointF(at - 0.8 * unit, high), theme.muted)
        brush.arrow(
            QPointF(at - 0.8 * unit, high + STEP), QPointF(at + unit, high + STEP), theme.highlight
        )

    def _share(self, position_um: float) -> float:
        return min(max(position_um / self.reach_um, -1.1), 1.1)

    def _scale(self, brush: Brush, room: QRectF, middle: float, unit: float, level: float) -> None:
        theme, painter = brush.theme, brush.painter
        brush.pen(theme.secondary, THIN)
        painter.drawLine(QPointF(middle - 2.2 * unit, level), QPointF(middle + 2.2 * unit, level))
        for share in (-1.0, 0.0, 1.0):
            x = middle + 2.0 * unit * share
            brush.pen(theme.secondary, THIN)
            painter.drawLine(QPointF(x, level - 4.0), QPointF(x, level + 4.0))
            text = f"{share * self.reach_um:+g}" if share else "0"
            below = QPointF(x, level + 2.0 * STEP)
            brush.words(below, text.replace("-", "\u2212"), theme.muted)
        if math.isfinite(self.indicated_um):
            brush.pen(theme.text, fill=theme.base)
            brush.disc(QPointF(middle + 2.0 * unit * self._share(self.indicated_um), level), 5.0)
        x = middle + 2.0 * unit * self._share(self.position_um)
        brush.pen(theme.highlight, fill=theme.highlight)
        brush.disc(QPointF(x, level), 3.0)


@dataclass(frozen=True, slots=True)
class RollScene:
    """The spindle that turns slowly under the follower, with two perpendicular probes.

    words: speed or next step; turning: whether it turns now.
    """

    words: str
    turning: bool = False

    def paint(self, brush: Brush, room: QRectF) -> None:
        """Draw pin and bushing, the probes, and the turn."""
        theme = brush.theme
        radius = min(0.2 * room.height(), 0.15 * room.width())
        middle = room.center() + QPointF(0.0, 0.3 * radius)
        brush.pen(theme.secondary, fill=theme.base)
        brush.disc(middle, radius)
        brush.pen(theme.highlight, fill=theme.tint)
        brush.disc(middle + QPointF(0.06 * radius, 0.04 * radius), 0.72 * radius)
        colour = theme.highlight if self.turning else theme.strong
        brush.turn(middle, 1.35 * radius, math.radians(200), math.radians(220), colour)
        along, across = QPointF(2.4 * radius, 0.0), QPointF(0.0, -1.95 * radius)
        for number, away in enumerate((along, across), 1):
            box = QRectF(0.0, 0.0, 1.6 * radius, 0.5 * radius)
            box.moveCenter(middle + away)
            brush.boxed(box, tr("Probe {}", number))
        below = QPointF(room.center().x(), room.bottom() - 2.0 * STEP)
        brush.words(below, self.words, theme.highlight, VALUE_PT)


class Picture(QWidget):
    """Show a scene; the instruction above it has the same contents as text."""

    def __init__(self, name: str, spoken: Text, theme: Theme) -> None:
        super().__init__()
        named(self, name, spoken)
        self._theme = theme
        self.scene: Scene | None = None
        self._tallest = 0
        self.setMinimumSize(LEAST)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def show_scene(self, scene: Scene | None) -> None:
        """Show a scene; an unchanged one is not repainted."""
        if scene != self.scene:
            self.scene = scene
            self.update()

    def stay_within(self, tallest: int) -> None:
        """Limit the height, in pixels, so that the whole picture is visible."""
        self._tallest = max(tallest, LEAST.height())
        self.update()

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the background and the scene, if there is one."""
        if self.scene is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QColor(self._theme.hairline))
        painter.setBrush(QColor(self._theme.alternate))
        ground = QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5)
        ground.setHeight(min(ground.height(), self._tallest or ground.height()))
        painter.drawRoundedRect(ground, STEP, STEP)
        room = ground.adjusted(2 * STEP, 2 * STEP, -2 * STEP, -2 * STEP)
        self.scene.paint(Brush(painter, self._theme, self.font()), room)
        painter.end()
