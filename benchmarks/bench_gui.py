"""Time of a frame of the window's plots against plain pyqtgraph, side by side in one run.

Run with ``QT_QPA_PLATFORM=offscreen python benchmarks/bench_gui.py``. Prints the median processor
time of new data + complete repaint, in ms, the ratio plain / own, and the budget of a frame
of four overlays with band, residual, limits and names, and the trend of 10^6 cycles together.
"""

from __future__ import annotations

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
os.environ.setdefault("QT_LOGGING_RULES", "qt.qpa.*=false")

import statistics
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pyqtgraph as pg
from budgets import measured, size
from PySide6.QtWidgets import QApplication, QGridLayout, QWidget

from rigapp.config.loading import read_test
from rigapp.gui.look.dress import apply_theme
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.trend import TrendPanel
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.channels import BASE
from rigapp.schema.columns import prediction_columns
from rigapp.viewer.comparison import CURVES
from rigapp.viewer.news import News
from rigapp.viewer.series import LiveData, MeasuredCycle, PredictedCycle

EXAMPLE = Path(__file__).parents[1] / "examples" / "quick.toml"
FRAMES = size(25, 1)
POINTS = 3600
SIZE = (1280, 800)
BUDGET_ROWS = size(1_000_000, 30_000)


def cycles(count: int) -> list[tuple[MeasuredCycle, PredictedCycle]]:
    """Return measured and predicted revolutions with noise."""
    random = np.random.default_rng(1)
    angle = np.linspace(0.0, 360.0, POINTS, endpoint=False)
    coarse = np.arange(360.0)
    cycles = []
    for number in range(count):
        noise = random.normal(0.0, 0.7, (2, POINTS))
        first, second = forces(angle)
        first, second = first + noise[0], second + noise[1]
        channels = {"force_1": first, "force_2": second, "force": np.hypot(first, second)}
        model_1, model_2 = forces(coarse)
        curves = {"force_1": model_1, "force_2": model_2, "force": np.hypot(model_1, model_2)}
        cycles.append(
            (
                MeasuredCycle(
                    number,
                    angle.astype("<f4"),
                    {name: values.astype("<f4") for name, values in channels.items()},
                ),
                PredictedCycle(
                    number,
                    coarse,
                    {name: values.astype("<f4") for name, values in curves.items()},
                ),
            )
        )
    return cycles


def forces(angle_deg: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return approximate force components of a spring-loaded slider-crank."""
    turn = np.radians(angle_deg)
    pull = 61.0 - 35.0 * np.cos(turn)
    return -pull * np.cos(1.37 * np.sin(turn)), pull * np.sin(1.37 * np.sin(turn))


def median_ms(application: QApplication, widget: QWidget, update: Callable[[int], None]) -> float:
    """Return the median processor time of update + repaint."""
    widget.resize(*SIZE)
    widget.show()
    application.processEvents()
    times = []
    for frame in range(FRAMES + 3):
        start = time.thread_time()
        update(frame)
        widget.grab()
        times.append(1000.0 * (time.thread_time() - start))
    widget.hide()
    return statistics.median(times[3:])


def own_overlays(application: QApplication) -> float:
    """Time four overlay panels with residual strips, bands, limits and names."""
    data = cycles(4)
    recipe = read_test(EXAMPLE).record
    shown = [LiveData() for _ in data]
    for curves in shown:
        rows = np.full((len(data), len(prediction_columns())), 1.0)
        rows[:, 0] = np.arange(len(data))
        curves.predictions.extend(rows)
    box = QWidget()
    grid = QGridLayout(box)
    panels = [OverlayPanel(f"bench{index}", LIGHT) for index in range(4)]
    for index, panel in enumerate(panels):
        grid.addWidget(panel, index // 2, index % 2)

    def update(frame: int) -> None:
        for index, (panel, curves) in enumerate(zip(panels, shown, strict=True)):
            curves.cycle, curves.prediction = data[(frame + index) % 4]
            panel.show_news(News(data=curves, recipe=recipe))

    return median_ms(application, box, update)


def plain_overlays(application: QApplication) -> float:
    """Time the same content in plain pyqtgraph: automatic downsampling, clip, grid."""
    data = cycles(4)
    view = pg.GraphicsLayoutWidget()
    upper, lower = [], []
    for index in range(4):
        row, column = 2 * (index // 2), index % 2
        for plots, at in ((upper, row), (lower, row + 1)):
            plot = view.addPlot(at, column)
            plot.setDownsampling(auto=True, mode="peak")
            plot.setClipToView(True)
            plot.showGrid(x=True, y=True)
            plots.append([plot.plot() for _ in range(6 if plots is upper else 3)])

    def update(frame: int) -> None:
        for index in range(4):
            cycle, model = data[(frame + index) % 4]
            angle = cycle.angle_deg.astype(np.float64)
            for row, name in enumerate(CURVES):
                predicted = model.at(angle, name)
                upper[index][row].setData(angle, cycle.channels[name])
                upper[index][row + 3].setData(angle, predicted)
                lower[index][row].setData(angle, cycle.channels[name] - predicted)

    return median_ms(application, view, update)


def life(rows: int) -> tuple[np.ndarray, np.ndarray]:
    """Return revolution numbers and six series."""
    random = np.random.default_rng(2)
    revolution = np.arange(1.0, rows + 1.0)
    levels = np.array([97.0, 71.0, 26.0, 96.0, 70.0, 27.0])
    series = levels[:, None] + random.normal(0.0, 0.4, (6, rows)).astype(np.float32)
    return revolution, series


LINES = ("force_max", "force_rms", "force_min")


def own_trend(application: QApplication, rows: int) -> float:
    """Time a trend of six series, one new cycle a frame."""
    revolution, series = life(rows)
    data = LiveData(rows)
    data.load_rows({"revolution": revolution, **dict(zip(LINES, series[:3], strict=True))})
    data.predictions.load({"revolution": revolution, **dict(zip(LINES, series[3:], strict=True))})
    panel = TrendPanel("bench", LIGHT)
    row = np.full((1, len(BASE.revolution_columns)), 50.0)
    prediction = np.full((1, len(prediction_columns())), 50.0)

    def update(frame: int) -> None:
        row[0, 0] = prediction[0, 0] = rows + frame + 1
        data.rows.extend(row)
        data.predictions.extend(prediction)
        panel.show_news(News(data=data))

    return median_ms(application, panel, update)


def plain_trend(application: QApplication, rows: int) -> float:
    """Time the same six series in plain pyqtgraph: automatic downsampling by peak, clip, grid."""
    revolution, series = life(rows)
    plot = pg.PlotWidget()
    plot.setDownsampling(auto=True, mode="peak")
    plot.setClipToView(True)
    plot.showGrid(x=True, y=True)
    plot.disableAutoRange()
    plot.setRange(xRange=(0, rows), yRange=(20, 100))
    items = [plot.plot(skipFiniteCheck=True) for _ in range(6)]

    def update(frame: int) -> None:
        for item, values in zip(items, series, strict=True):
            values[frame] = 50.0
            item.setData(revolution, values)

    return median_ms(application, plot, update)


def main() -> None:
    """Print the table."""
    application = QApplication([])
    apply_theme(application, LIGHT)
    print(f"{'frame':<44}{'own ms':>9}{'plain ms':>10}{'plain / own':>13}")
    own, plain = own_overlays(application), plain_overlays(application)
    overlays, peer_overlays = own, plain
    show("4 overlays, 3600 points + model + residual", own, plain)
    for rows in (23_000, BUDGET_ROWS, size(10_000_000, 50_000)):
        own, plain = own_trend(application, rows), plain_trend(application, rows)
        show(f"trend of 6 series, {rows:,} cycles", own, plain)
        if rows == BUDGET_ROWS:
            frame = overlays + own
            peers = peer_overlays + plain
    measured("frame", frame, "plain pyqtgraph", peers / frame)


def show(name: str, own: float, plain: float) -> None:
    """Print one line."""
    print(f"{name:<44}{own:9.1f}{plain:10.1f}{plain / own:13.1f}")


if __name__ == "__main__":
    main()
