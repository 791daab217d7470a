"""Parts of the probe wizard's pages: residual plot over the position, simulated hands."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import (
    QComboBox,
    QGroupBox,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from rigapp.commands.live_probes import LiveProbeSession
from rigapp.commands.probe_practice import ProbeMistake
from rigapp.gui.calibration.parts import named, prose
from rigapp.gui.calibration.probe_bench import ProbeBench
from rigapp.gui.palette import Theme, line_pen
from rigapp.gui.plotting import QuietPlot

LEAST_UM = 1.0


class ProbeResidualPlot(QWidget):
    """Show how far each reading lies from the line of all readings so far, µm over position."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.plot = QuietPlot("probe_residual_plot", "Residuals so far, micrometres", theme)
        self.plot.label("left", "Residual (µm)")
        self.plot.label("bottom", "Position (µm)")
        self.plot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.plot.guide(0.0, horizontal=True, theme=theme)
        self._points = []
        for role, symbol in (("probe_1", "o"), ("probe_2", "t")):
            colour = theme.curves[role]
            item = pg.ScatterPlotItem(size=8, symbol=symbol, pen=line_pen(colour), brush=colour)
            self.plot.addItem(item)
            self._points.append(item)
        self.words = prose("probe_residual_words", "Residuals in words")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.plot, 1)
        column.addWidget(self.words)
        self.show_session(None)

    def show_session(self, session: LiveProbeSession | None) -> None:
        """Show what the lines of the readings so far leave."""
        found = session.preliminary() if session is not None else None
        reach = 1e6 * session.procedure.plan.reach if session is not None else 1000.0
        self.plot.setXRange(-1.1 * reach, 1.1 * reach, padding=0.0)
        if found is None:
            for item in self._points:
                item.setData([], [])
            self.plot.setYRange(-LEAST_UM, LEAST_UM, padding=0.0)
            self.words.setText("Residuals are shown from the third position on.")
            return
        position, residual, which = found
        um = 1e6 * residual
        for number, item in enumerate(self._points, 1):
            item.setData(1e6 * position[which == number], um[which == number])
        high = max(LEAST_UM, 1.2 * float(np.abs(um).max()))
        self.plot.setYRange(-high, high, padding=0.0)
        worst = int(np.abs(um).argmax())
        self.words.setText(
            f"Circle: probe 1, triangle: probe 2. Last {um[-1]:+.2f} µm; largest {um[worst]:+.2f}"
            f" µm at {1e6 * position[worst]:g} µm of probe {which[worst]}."
        )


class ProbeHandsPanel(QGroupBox):
    """Turn the simulated micrometer, all by itself if wanted, with a mistake if wanted."""

    def __init__(self, bench: ProbeBench) -> None:
        super().__init__("Simulated hands (practice: no waiting times)")
        self._bench = bench
        named(self, "probe_hands", "Simulated hands")
        self.do = QPushButton("T&urn the micrometer")
        named(self.do, "probe_hands_do", "Let the simulated hands do this step")
        self.ahead = QPushButton("Go a&head")
        self.ahead.setCheckable(True)
        named(self.ahead, "probe_hands_ahead", "Do and record all further steps")
        self.mistake = QComboBox()
        for mistake in ProbeMistake:
            self.mistake.addItem(str(mistake), mistake)
        named(self.mistake, "probe_hands_mistake", "Mistake to practise")
        label = QLabel("&Mistake")
        label.setBuddy(self.mistake)
        row = QHBoxLayout(self)
        row.addWidget(self.do)
        row.addWidget(self.ahead)
        row.addStretch(1)
        row.addWidget(label)
        row.addWidget(self.mistake)
        self.do.clicked.connect(bench.lend_a_hand)
        self.ahead.toggled.connect(self._ahead)
        self.mistake.currentIndexChanged.connect(self._plant)
        bench.looked.connect(self._show)

    def _ahead(self, on: bool) -> None:
        self._bench.goes_ahead = on

    def _plant(self) -> None:
        self._bench.plant(ProbeMistake(self.mistake.currentData()))

    def _show(self) -> None:
        if not self.isVisible():
            return
        bench = self._bench
        self.do.setEnabled(not bench.hands_busy and not bench.goes_ahead)
        if self.ahead.isChecked() != bench.goes_ahead:
            self.ahead.setChecked(bench.goes_ahead)
