"""Several recorded tests in one plot, against cycles or against wear."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.gui.data.pyramid import polyline
from rigapp.gui.data.quantities import compared_columns
from rigapp.gui.data.ranges import SteadyRange
from rigapp.gui.data.recording import StoredTest, load_history
from rigapp.gui.data.series import LiveData
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.look.tokens import Theme
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotting import LegendRow, PlotPanel, QuietPlot, clear
from rigapp.gui.widgets.build import choice, column, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.schema.channels import BASE

Floats = NDArray[np.float64]

CHOOSE = "Choose one or more tests above and press Compare."
MOST = 6
BUCKETS = 1500
COLOURS = {
    "light": ("#0072b2", "#d55e00", "#2ca25f", "#000000", "#a8497b", "#803000"),
    "dark": ("#3f9be0", "#f0a050", "#7fe0b0", "#ffffff", "#f0e442", "#e15759"),
}
AXES = {"cycle": "Cycle", "measured_wear_depth": "Measured wear depth (mm)"}


@dataclass(frozen=True, slots=True)
class ComparedTest:
    """One test of the comparison."""

    path: Path
    data: LiveData


def line_of(data: LiveData, quantity: str, axis: str) -> tuple[Floats, Floats]:
    """Return the points of one test to draw, extremes kept."""
    table = data.rows if quantity in data.rows.names else data.predictions
    if quantity not in table.names:
        return np.empty(0), np.empty(0)
    series = table.series(quantity)
    x, y = polyline(table.revolutions, series.envelope(0, len(series), BUCKETS))
    if axis == "cycle" or not len(data.predictions):
        return x, y
    depth = data.predictions.series(axis).values
    known = np.isfinite(depth)
    if not known.any():
        return np.empty(0), np.empty(0)
    at = np.interp(x, data.predictions.revolutions[known], depth[known].astype(np.float64))
    order = np.argsort(at, kind="stable")
    return at[order], y[order]


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
        self.plot = QuietPlot("compare_plot", "Comparison of tests", theme)
        self.plot.setMouseEnabled(x=True, y=False)
        self._curves: list[Any] = [self.plot.curve(LinePen("text")) for _ in range(MOST)]
        self.quantity = choice(
            "compare_quantity", "Quantity to compare", _items(compared_columns(BASE)), self._draw
        )
        self.axis = choice("compare_axis", "Axis to compare on", _items(AXES), self._draw)
        self.message = ElidedLabel("compare_message", "State of the comparison")
        self.message.show_text(CHOOSE)
        self.plot.empty(CHOOSE)
        self.legend = LegendRow("compare_legend", theme)
        top = row("&Quantity", self.quantity, "Against", self.axis, (self.message, 1))
        column(top, self.legend, (self.plot, 1), on=self)

    @property
    def runs(self) -> list[ComparedTest]:
        """Return the tests that are compared."""
        return self._runs

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        super().dress(theme)
        self._draw()

    def load(self, paths: Sequence[Path]) -> None:
        """Read tests on the worker and draw them when they are there."""
        self._wanted = list(paths[:MOST])
        self._runs = []
        self.message.show_text(f"Reading {len(self._wanted)} …")
        for path in self._wanted:
            self._worker.submit(
                lambda path=path: load_history(path),  # type: ignore[misc]
                lambda history, path=path: self._loaded(path, history),  # type: ignore[misc]
                lambda error, path=path: self._failed(path, error),  # type: ignore[misc]
            )
        if len(paths) > MOST:
            self.message.show_text(f"Only the first {MOST} are compared.")

    def _loaded(self, path: Path, history: StoredTest) -> None:
        if path in self._wanted and all(run.path != path for run in self._runs):
            self._runs.append(ComparedTest(path, history.data))
            self._runs.sort(key=lambda run: self._wanted.index(run.path))
            self._offer()
            if len(self._runs) == len(self._wanted):
                self.message.show_text("")
            self._draw()

    def _offer(self) -> None:
        """Offer what any of the tests has."""
        columns = {
            name: text
            for run in self._runs
            for name, text in compared_columns(run.data.channels).items()
        }
        for name, text in columns.items():
            if self.quantity.findData(name) < 0:
                self.quantity.addItem(text, name)

    def _failed(self, path: Path, error: Exception) -> None:
        self.message.show_text(f"{path.name} cannot be read: {error}")

    def _draw(self) -> None:
        quantity, axis = str(self.quantity.currentData()), str(self.axis.currentData())
        colours = COLOURS[self._theme.name]
        entries = []
        limits = [np.inf, -np.inf, np.inf, -np.inf]
        for index, curve in enumerate(self._curves):
            if index >= len(self._runs):
                clear(curve)
                continue
            run = self._runs[index]
            x, y = line_of(run.data, quantity, axis)
            pen = LinePen(colours[index])
            self.plot.draw_with(pen, curve)
            curve.setData(x, y, connect="finite")
            entries.append((run.path.stem, pen))
            if np.isfinite(y).any():
                limits = [
                    min(limits[0], float(np.nanmin(x))),
                    max(limits[1], float(np.nanmax(x))),
                    min(limits[2], float(np.nanmin(y))),
                    max(limits[3], float(np.nanmax(y))),
                ]
        self.legend.show_entries(entries)
        self.plot.label("left", self.quantity.currentText())
        self.plot.label("bottom", AXES[axis])
        if np.isfinite(limits).all():
            self._place(*limits)
        else:
            missing = f"None of the chosen tests has {self.quantity.currentText()}."
            self.plot.empty(missing if self._runs else CHOOSE)

    def _place(self, left: float, right: float, low: float, high: float) -> None:
        self.plot.setXRange(left, max(right, left + 1e-6), padding=0.02)
        self.plot.steady = SteadyRange(1e-6)
        self.plot.fit(low, high)
