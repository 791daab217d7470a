"""Small parts of the wizard's pages: labelled fields, the stability sign, the residual plot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import (
    QBoxLayout,
    QDoubleSpinBox,
    QFormLayout,
    QFrame,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QWidget,
)

from rigapp.calibrating.session import ResidualsSoFar
from rigapp.gui.look.fonts import sized
from rigapp.gui.plots.palette import line_pen
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import column, named, prose, row, steady_field
from rigapp.gui.widgets.labels import FittedLabel, scaled_font
from rigapp.presentation.tokens import LARGE_PT, MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp_calibration.taking.signals import Readiness, SignalState

LEAST_PLOT = 15 * STEP
"""Minimum height of a plot in which residuals can be distinguished."""


def prefix_of(stem: str) -> str:
    """Return the prefix of a subject's widget names, empty for the load cell."""
    return "" if stem == "calibration" else f"{stem}_"


def field(form: QFormLayout, text: Text, widget: QWidget) -> None:
    """Add a row with an access key."""
    label = QLabel(tr(text))
    label.setBuddy(widget)
    form.addRow(label, widget)


def fields_form() -> QFormLayout:
    """Return an empty form; fields are below their captions where there is no room beside them."""
    form = QFormLayout()
    form.setVerticalSpacing(STEP)
    form.setRowWrapPolicy(QFormLayout.RowWrapPolicy.WrapLongRows)
    return form


def labelled(text: Text, widget: QWidget) -> QFormLayout:
    """Return a form with one field."""
    form = fields_form()
    field(form, text, widget)
    return form


def number(
    name: str, spoken: Text, low: float, high: float, decimals: int, step: float, unit: str
) -> QDoubleSpinBox:
    """Return a field for a number, whose value changes at every key."""
    aloud = f"{tr(spoken)}, {tr(UNIT_NAMES.get(unit, unit))}"
    box = named(steady_field(QDoubleSpinBox()), name, aloud)
    box.setRange(low, high)
    box.setDecimals(decimals)
    box.setSingleStep(step)
    box.setSuffix(f" {unit}")
    box.setKeyboardTracking(True)
    box.setMinimumHeight(24)
    return box


UNIT_NAMES: dict[str, Text] = {
    "kg": "kilograms",
    "m/s²": "metres per second squared",
    "µm": "micrometres",
    "°": "degrees",
}
"""Units whose sign is not read aloud."""


def sentence(name: str, spoken: Text, factor: float = 1.0, *, bold: bool = False) -> QLabel:
    """Return a label for selectable sentences; factor: of the font size."""
    label = prose(name, spoken)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    label.setFont(scaled_font(label, factor, bold=bold))
    return label


def taking_what_is_left(shown: QWidget, least: int = LEAST_PLOT) -> QHBoxLayout:
    """Return a layout in which a plot or table takes the remaining room, despite its size hint.

    least: minimum height in pixels; a lower page scrolls.
    """
    shown.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
    layout = row(shown)
    layout.addStrut(least)
    return layout


def caption(text: Text) -> QLabel:
    """Return the title of a plot (quantity and unit) as a label above it, where it is not cut."""
    label = QLabel(tr(text))
    label.setProperty("role", "caption")
    return label


class Sign(QWidget):
    """Paint the state of the signal as a shape: ring, wave, filled square, triangle."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._state = SignalState.WAITING
        side = 2 * QFontMetrics(self.font()).height()
        self.setFixedSize(QSize(side, side))

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self.update()

    def show_state(self, state: SignalState) -> None:
        """Show a state."""
        if state is not self._state:
            self._state = state
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the shape."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(QColor(self._theme.text))
        pen.setWidthF(3.0)
        painter.setPen(pen)
        side = float(self.width())
        box = QRectF(0.18 * side, 0.18 * side, 0.64 * side, 0.64 * side)
        if self._state is SignalState.STEADY:
            painter.setBrush(QColor(self._theme.highlight))
            painter.drawRect(box)
        elif self._state is SignalState.WRONG:
            pen.setColor(QColor(self._theme.critical))
            painter.setPen(pen)
            top = QPointF(box.center().x(), box.top())
            painter.drawPolygon(QPolygonF([top, box.bottomRight(), box.bottomLeft()]))
        elif self._state is SignalState.MOVING:
            across = np.linspace(0.1, 0.9, 25)
            points = [
                QPointF(x * side, side * (0.5 + 0.28 * np.sin(4.0 * np.pi * x))) for x in across
            ]
            pen.setColor(QColor(self._theme.critical))
            painter.setPen(pen)
            painter.drawPolyline(QPolygonF(points))
        else:
            painter.drawEllipse(box)
        painter.end()


WORDS: dict[SignalState, Text] = {
    SignalState.WAITING: "WAIT",
    SignalState.MOVING: "NOT STEADY",
    SignalState.STEADY: "STEADY",
    SignalState.WRONG: "CHECK",
}


class Stability(QWidget):
    """Shape and text of the signal's stability."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.sign = Sign(theme)
        self.word = sentence("stability_word", "", 1.5, bold=True)
        self.word.setWordWrap(False)
        self.why = sentence("stability_why", "")
        named(self, "stability", "Stability of the signal")
        row(self.sign, (column(self.word, self.why), 1), on=self).setContentsMargins(0, 0, 0, 0)

    def show_readiness(self, readiness: Readiness | None) -> None:
        """Show the readiness, or that it is unknown."""
        state, words = SignalState.WAITING, tr("no signals from the engine")
        if readiness is not None:
            state, words = readiness.state, readiness.words
        self.sign.show_state(state)
        self.word.setText(tr(WORDS[state]))
        words = "" if words == "steady" else translate(words)
        self.why.setText(words)
        self.setAccessibleDescription(f"{tr(WORDS[state])}: {words}")


class MeasuredCard(QFrame):
    """The measured value, legible from the rig: number, target, stability."""

    def __init__(self, name: str, title: Text, theme: Theme) -> None:
        super().__init__()
        named(self, f"{name}_measured", title).setProperty("role", "card")
        self.caption = caption(title)
        large = sized(self.font(), LARGE_PT, QFont.Weight.DemiBold)
        self.value = FittedLabel(f"{name}_measured_value", title, large)
        self.wanted = sentence(f"{name}_measured_wanted", "Expected value")
        self.wanted.setWordWrap(False)  # a line that wraps may be squeezed
        self.stability = Stability(theme)
        numbers = column(self.caption, self.value, self.wanted)
        self._halves = column((numbers, 1), self.stability, on=self)
        self.setMinimumWidth(30 * STEP)
        self.make_room(low=False)
        self.show_value("")

    def make_room(self, *, low: bool) -> None:
        """Place the stability beside the number, instead of below it, on a low page."""
        direction = QBoxLayout.Direction.LeftToRight if low else QBoxLayout.Direction.TopToBottom
        self._halves.setDirection(direction)
        self._halves.setContentsMargins(MARGIN, STEP, MARGIN, STEP)
        self._halves.setSpacing(STEP)
        self.caption.setHidden(low)
        points = VALUE_PT if low else LARGE_PT
        self.value.set_largest(sized(self.font(), points, QFont.Weight.DemiBold))

    def show_value(self, value: str, wanted: str = "") -> None:
        """Show a number with its unit, and its target; an empty one as a dash."""
        self.value.show_text(value or "–")
        if self.wanted.text() != wanted:
            self.wanted.setText(wanted)


@dataclass(frozen=True, slots=True)
class PlotNames:
    """Names of a residual plot: stem of widget names, accessible name, unit, x and y axis."""

    stem: str
    spoken: Text
    unit: str
    bottom: Text
    left: Text = "Residual"


class ResidualPlot(QWidget):
    """Show the residuals of the readings so far from their own fit: circles, then triangles."""

    def __init__(self, theme: Theme, names: PlotNames) -> None:
        """Make the plot with a text below."""
        super().__init__()
        self.plot = QuietPlot(f"{names.stem}_plot", tr(names.spoken), theme)
        self.plot.label("bottom", tr(names.bottom))
        self.plot.guide(0.0, horizontal=True)
        self._points = {
            role: pg.ScatterPlotItem(size=8, symbol=symbol)
            for role, symbol in (("first", "o"), ("second", "t"))
        }
        for item in self._points.values():
            self.plot.addItem(item)
        self.dress(theme)
        self.words = sentence(f"{names.stem}_words", "Residuals in words")
        self.title = caption(f"{tr(names.left)} ({names.unit})")
        column(self.title, (taking_what_is_left(self.plot), 1), self.words, on=self)

    def make_room(self, *, low: bool) -> None:
        """Hide the plot on a low page; the text has the largest residual."""
        for shown in (self.title, self.plot):
            shown.setHidden(low)
        height = QSizePolicy.Policy.Maximum if low else QSizePolicy.Policy.Preferred
        self.setSizePolicy(QSizePolicy.Policy.Preferred, height)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.plot.dress(theme)
        for role, item in self._points.items():
            item.setPen(line_pen(theme.curves[role]))
            item.setBrush(theme.curves[role])

    def show_residuals(self, residuals: ResidualsSoFar) -> None:
        """Show the residuals of the readings so far."""
        for item, (x, residual) in zip(self._points.values(), residuals.curves, strict=True):
            item.setData(x, residual)
        self.plot.setXRange(*residuals.span, padding=0.0)
        self.plot.setYRange(-residuals.reach, residuals.reach, padding=0.0)
        self.words.setText(translate(residuals.words))
