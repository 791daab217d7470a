"""Small parts of the wizard's pages: labelled fields, the stability sign, the residual plot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import (
    QComboBox,
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from calibration.taking.signals import Readiness, SignalState
from rigapp.calibrating.session import ResidualsSoFar
from rigapp.gui.plots.palette import Theme, line_pen
from rigapp.gui.plots.plotting import QuietPlot


def named(widget: QWidget, name: str, spoken: str) -> QWidget:
    """Give a widget its stable name and the one that is read aloud."""
    widget.setObjectName(name)
    widget.setAccessibleName(spoken)
    return widget


def field(form: QFormLayout, text: str, widget: QWidget) -> QLabel:
    """Add a row with an access key."""
    label = QLabel(text)
    label.setBuddy(widget)
    form.addRow(label, widget)
    return label


def number(low: float, high: float, decimals: int, step: float, unit: str) -> QDoubleSpinBox:
    """Return a spin box; its text counts while it is typed."""
    box = QDoubleSpinBox()
    box.setRange(low, high)
    box.setDecimals(decimals)
    box.setSingleStep(step)
    box.setSuffix(f" {unit}")
    box.setKeyboardTracking(True)
    box.setMinimumHeight(24)
    return box


def choice(words: Mapping[str, str], name: str, spoken: str, at: int) -> QComboBox:
    """Return a box to choose from, by word, with the one ``at`` a place chosen."""
    box = QComboBox()
    for key, text in words.items():
        box.addItem(text, key)
    box.setCurrentIndex(at)
    named(box, name, spoken)
    return box


def prose(name: str, spoken: str = "") -> QLabel:
    """Return a label for sentences: plain text, wrapped, can be selected."""
    label = QLabel()
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    label.setObjectName(name)
    if spoken:
        label.setAccessibleName(spoken)
    return label


def larger(label: QLabel, factor: float, *, bold: bool = False) -> None:
    """Set a label in larger type, relative to the application's."""
    font = label.font()
    font.setPointSizeF(font.pointSizeF() * factor)
    font.setBold(bold)
    label.setFont(font)


class Sign(QWidget):
    """Paint the state of the signal as a shape: ring, wave, filled square."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._state = SignalState.WAITING
        side = 2 * QFontMetrics(self.font()).height()
        self.setFixedSize(QSize(side, side))

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


WORDS = {
    SignalState.WAITING: "WAIT",
    SignalState.MOVING: "NOT STEADY",
    SignalState.STEADY: "STEADY",
}


class Stability(QWidget):
    """Tell in a shape and in words whether the signal is steady."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.sign = Sign(theme)
        self.word = prose("stability_word")
        larger(self.word, 1.5, bold=True)
        self.word.setWordWrap(False)
        self.why = prose("stability_why")
        named(self, "stability", "Stability of the signal")
        column = QVBoxLayout()
        column.setSpacing(0)
        column.addWidget(self.word)
        column.addWidget(self.why)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.sign)
        row.addLayout(column, 1)

    def show_readiness(self, readiness: Readiness | None, otherwise: str) -> None:
        """Show a judgement; ``otherwise`` is said when there is none."""
        state = readiness.state if readiness is not None else SignalState.WAITING
        words = readiness.words if readiness is not None else otherwise
        self.sign.show_state(state)
        self.word.setText(WORDS[state])
        self.why.setText("" if words == "steady" else words)
        self.setAccessibleDescription(f"{WORDS[state]}: {words}")


@dataclass(frozen=True, slots=True)
class PlotNames:
    """Of a residual plot: stem of the widgets' names, read aloud, unit, lower axis."""

    stem: str
    spoken: str
    unit: str
    bottom: str


class ResidualPlot(QWidget):
    """Show what the readings so far differ from their own fit: circles, then triangles."""

    def __init__(self, theme: Theme, names: PlotNames) -> None:
        """Make the plot with words below."""
        super().__init__()
        self.plot = QuietPlot(f"{names.stem}_plot", names.spoken, theme)
        self.plot.label("left", f"Residual ({names.unit})")
        self.plot.label("bottom", names.bottom)
        self.plot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.plot.guide(0.0, horizontal=True)
        self._points = []
        for role, symbol in (("first", "o"), ("second", "t")):
            colour = theme.curves[role]
            item = pg.ScatterPlotItem(size=8, symbol=symbol, pen=line_pen(colour), brush=colour)
            self.plot.addItem(item)
            self._points.append(item)
        self.words = prose(f"{names.stem}_words", "Residuals in words")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.plot, 1)
        column.addWidget(self.words)

    def show_residuals(self, found: ResidualsSoFar) -> None:
        """Show what is left of the readings so far."""
        for item, (x, residual) in zip(self._points, found.curves, strict=True):
            item.setData(x, residual)
        self.plot.setXRange(*found.span, padding=0.0)
        self.plot.setYRange(-found.reach, found.reach, padding=0.0)
        self.words.setText(found.words)


def load_cell_plot(theme: Theme) -> ResidualPlot:
    """Return the plot of the cell's residuals, N, in the order taken."""
    spoken = "Residuals of the readings so far, N"
    names = PlotNames("residual", spoken, "N", "Reading")
    return ResidualPlot(theme, names)


def probe_plot(theme: Theme) -> ResidualPlot:
    """Return the plot of the probes' residuals, µm, over the position."""
    spoken, bottom = "Residuals so far, micrometres", "Position (µm)"
    names = PlotNames("probe_residual", spoken, "µm", bottom)
    return ResidualPlot(theme, names)
