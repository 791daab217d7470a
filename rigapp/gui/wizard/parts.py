"""Small parts of the wizard's pages: labelled fields, the stability sign, the residual plot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import (
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from calibration.load_cell.live import Readiness, Verdict
from rigapp.calibrating.live_calibration import LiveSession
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
        self._verdict = Verdict.WAITING
        side = 2 * QFontMetrics(self.font()).height()
        self.setFixedSize(QSize(side, side))

    def show_verdict(self, verdict: Verdict) -> None:
        """Show a state."""
        if verdict is not self._verdict:
            self._verdict = verdict
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
        if self._verdict is Verdict.STEADY:
            painter.setBrush(QColor(self._theme.highlight))
            painter.drawRect(box)
        elif self._verdict is Verdict.MOVING:
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


WORDS = {Verdict.WAITING: "WAIT", Verdict.MOVING: "NOT STEADY", Verdict.STEADY: "STEADY"}


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
        verdict = readiness.verdict if readiness is not None else Verdict.WAITING
        words = readiness.words if readiness is not None else otherwise
        self.sign.show_verdict(verdict)
        self.word.setText(WORDS[verdict])
        self.why.setText("" if words == "steady" else words)
        self.setAccessibleDescription(f"{WORDS[verdict]}: {words}")


@dataclass(frozen=True, slots=True)
class ScatterNames:
    """Names of a residual plot: stem of the widgets' names, read aloud, unit, lower axis."""

    stem: str
    spoken: str
    unit: str
    bottom: str


def residual_scatter(
    on: QWidget, theme: Theme, names: ScatterNames, roles: tuple[str, str]
) -> tuple[QuietPlot, list[pg.ScatterPlotItem], QLabel]:
    """Lay a residual plot with words below out on a widget: circles for one role, then triangles.

    Return the plot, the points of the two roles, and the label for the words.
    """
    plot = QuietPlot(f"{names.stem}_plot", names.spoken, theme)
    plot.label("left", f"Residual ({names.unit})")
    plot.label("bottom", names.bottom)
    plot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
    plot.guide(0.0, horizontal=True, theme=theme)
    points = []
    for role, symbol in zip(roles, ("o", "t"), strict=True):
        colour = theme.curves[role]
        item = pg.ScatterPlotItem(size=8, symbol=symbol, pen=line_pen(colour), brush=colour)
        plot.addItem(item)
        points.append(item)
    words = prose(f"{names.stem}_words", "Residuals in words")
    column = QVBoxLayout(on)
    column.setContentsMargins(0, 0, 0, 0)
    column.addWidget(plot, 1)
    column.addWidget(words)
    return plot, points, words


class ResidualPlot(QWidget):
    """Show what each reading differs from a fit of all readings so far, N, in the order taken."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.plot, self._points, self.words = residual_scatter(
            self,
            theme,
            ScatterNames("residual", "Residuals of the readings so far, N", "N", "Reading"),
            ("first", "second"),
        )
        self.clear()

    def clear(self) -> None:
        """Show nothing."""
        for item in self._points:
            item.setData([], [])
        self.plot.setXRange(0.0, 12.0, padding=0.0)
        self.plot.setYRange(-2.0, 2.0, padding=0.0)
        self.words.setText("Residuals are shown when two pin angles are known.")

    def show_session(self, session: LiveSession) -> None:
        """Fit the readings so far and show what is left."""
        found = session.preliminary()
        if found is None:
            self.clear()
            return
        residual = found[0].residual
        count = np.arange(1, len(residual) + 1)
        for axis, item in enumerate(self._points):
            item.setData(count, residual[:, axis])
        reach = max(2.0, 1.2 * float(np.abs(residual).max()))
        self.plot.setXRange(0.0, max(12.0, len(count) + 1.0), padding=0.0)
        self.plot.setYRange(-reach, reach, padding=0.0)
        worst = int(np.abs(residual).max(axis=1).argmax())
        last = ", ".join(f"{value:+.2f}" for value in residual[-1])
        self.words.setText(
            f"Circle: axis 1, triangle: axis 2. Last {last} N; largest"
            f" {np.abs(residual[worst]).max():.2f} N at reading {worst + 1} of those that stand."
        )
