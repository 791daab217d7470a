"""Several recorded tests in one plot, against cycles or against wear."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.marks import CurveName, Spot
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotpanel import PlotPanel
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import add_group, choice, choose, column, searched
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.channels import BASE
from rigapp.viewer.lines import EVERYTHING, Drawn, Flagged, drawn
from rigapp.viewer.quantities import compared_columns, grouped_quantities, scale_of
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.recording import StoredTest, load_history
from rigapp.viewer.series import LiveData
from rigapp.viewer.tasks import TaskWorker

CHOOSE: Final[Text] = "Choose one or more tests above and press Compare."
MESSAGE_WIDTH = 30 * STEP
MOST = 6
BUCKETS = 1500
COLOURS = {
    "light": ("#0072b2", "#8d6a0b", "#852aed", "#000000", "#43522c", "#4d0f56"),
    "dark": ("#3f9be0", "#f0a050", "#7fe0b0", "#ffffff", "#f0e442", "#e15759"),
}
CYCLE = "cycle"
AXES: Final[dict[str, Text]] = {
    CYCLE: "Cycle",
    "measured_wear_depth": "Measured wear depth (µm)",
}
AXIS_BUCKETS = 4096
"""Buckets of a wear depth as an axis, finer than any screen; a shorter test is drawn row by row."""
NOTHING = Drawn(np.empty(0), np.empty(0))


@dataclass(frozen=True, slots=True)
class ComparedTest:
    """One test of the comparison."""

    path: Path
    data: LiveData


def line_of(data: LiveData, quantity: str, axis: str) -> Drawn:
    """Return the line of one test to draw, extremes kept, in the displayed units."""
    table = data.rows if quantity in data.rows.names else data.predictions
    if quantity not in table.names:
        return NOTHING
    line = drawn(
        table,
        quantity,
        Flagged(data.rows, EVERYTHING, BUCKETS),
        EVERYTHING,
        BUCKETS,
        scale_of(quantity),
    )
    if axis == CYCLE or not len(data.predictions):
        return line
    predictions = data.predictions
    depth = predictions.series(axis).envelope(0, len(predictions), AXIS_BUCKETS)
    known = np.isfinite(depth.low)
    if not known.any():
        return NOTHING
    revolutions = predictions.revolutions[depth.first[known]]
    depths = scale_of(axis) * 0.5 * (depth.low[known].astype(np.float64) + depth.high[known])
    at = np.interp(line.x, revolutions, depths)
    order = np.argsort(at, kind="stable")
    beyond = [
        None if point is None else (float(np.interp(point[0], revolutions, depths)), point[1])
        for point in (line.above, line.under)
    ]
    return Drawn(at[order], line.y[order], line.low, line.high, *beyond)


def _items(texts: dict[str, str]) -> list[tuple[str, str]]:
    return [(text, key) for key, text in texts.items()]


class ComparePanel(PlotPanel):
    """Draw one quantity of each chosen test."""

    def __init__(self, theme: Theme, worker: TaskWorker) -> None:
        super().__init__("compare_panel", "Comparison of tests")
        self._theme = theme
        self._worker = worker
        self._runs: list[ComparedTest] = []
        self._wanted: list[Path] = []
        self._offered: list[str] = []
        self.plot = QuietPlot("compare_plot", "Comparison of tests", theme)
        self.plot.setMouseEnabled(x=True, y=False)
        self._curves: list[Any] = [self.plot.curve(LinePen("text")) for _ in range(MOST)]
        self.quantity = searched(choice("compare_quantity", "Quantity to compare", (), self._draw))
        self._offer()
        self.axis = choice("compare_axis", "Axis to compare on", _items(AXES), self._draw)
        self.message = ElidedLabel("compare_message", "State of the comparison")
        self.message.show_text(CHOOSE)
        self.plot.empty(CHOOSE)
        self.message.setMinimumWidth(MESSAGE_WIDTH)
        top = flowing("&Quantity", self.quantity, "Against", self.axis, (self.message, 1))
        column(top, (self.plot, 1), on=self)

    @property
    def runs(self) -> list[ComparedTest]:
        """Return the tests that are compared."""
        return self._runs

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        super().dress(theme)
        self._draw()

    def load(self, paths: Sequence[Path]) -> None:
        """Read tests on the worker and draw each as soon as it is read."""
        self._wanted = list(paths[:MOST])
        self._runs = []
        self.message.show_text(tr("Reading {} …", len(self._wanted)))
        for path in self._wanted:
            self._worker.submit(
                lambda path=path: load_history(path),  # type: ignore[misc]
                lambda history, path=path: self._loaded(path, history),  # type: ignore[misc]
                lambda error, path=path: self._failed(path, error),  # type: ignore[misc]
            )
        if len(paths) > MOST:
            self.message.show_text(tr("Only the first {} are compared.", MOST))

    def _loaded(self, path: Path, history: StoredTest) -> None:
        if path in self._wanted and all(run.path != path for run in self._runs):
            self._runs.append(ComparedTest(path, history.data))
            self._runs.sort(key=lambda run: self._wanted.index(run.path))
            self._offer()
            if len(self._runs) == len(self._wanted):
                self.message.show_text("")
            self._draw()

    def _offer(self) -> None:
        """List the quantities that any of the tests has."""
        tables = [run.data.channels for run in self._runs] or [BASE]
        columns = {name: text for table in tables for name, text in compared_columns(table).items()}
        if list(columns) == self._offered:
            return
        self._offered = list(columns)
        chosen = self.quantity.currentData()
        self.quantity.blockSignals(True)
        self.quantity.clear()
        most = max(tables, key=lambda table: len(table.channels))
        for names in grouped_quantities(columns, most):
            add_group(self.quantity, {name: columns[name] for name in names})
        choose(self.quantity, chosen)
        self.quantity.blockSignals(False)

    def _failed(self, path: Path, error: Exception) -> None:
        self.message.show_text(tr("{} cannot be read: {}", path.name, error))

    def _draw(self) -> None:
        quantity, axis = str(self.quantity.currentData()), str(self.axis.currentData())
        colours = COLOURS[self._theme.name]
        names, spots, lines = [], [], []
        for index, curve in enumerate(self._curves):
            if index >= len(self._runs):
                clear(curve)
                continue
            run = self._runs[index]
            line = line_of(run.data, quantity, axis)
            pen = LinePen(colours[index])
            self.plot.draw_with(pen, curve)
            curve.setData(line.x, line.y)
            known = np.flatnonzero(np.isfinite(line.y))
            if not known.size:
                continue
            lines.append(line)
            names.append(CurveName(run.path.stem, pen, float(line.y[known[-1]])))
            spots += [
                Spot(*at, f"{at[1]:.4g}", pen) for at in (line.above, line.under) if at is not None
            ]
        self.plot.label("bottom", AXES[axis])
        if lines:
            self._place(lines)
            bottom, top = self.plot.viewRange()[1]
            spots = [spot for spot in spots if not bottom <= spot.y <= top]
        else:
            missing = tr("None of the chosen tests has {}.", self.quantity.currentText())
            self.plot.empty(missing if self._runs else CHOOSE)
        self.plot.show_marks(names=tuple(names), spots=tuple(spots))

    def _place(self, lines: Sequence[Drawn]) -> None:
        """Fit the axes to all lines; flagged revolutions do not extend the vertical axis."""
        left = min(float(line.x.min()) for line in lines)
        right = max(float(line.x.max()) for line in lines)
        self.plot.show_range("x", left, max(right, left + 1e-6))
        self.plot.steady = SteadyRange(1e-6)
        self.plot.fit(min(line.low for line in lines), max(line.high for line in lines))
