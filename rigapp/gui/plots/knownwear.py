"""Pictures of what is known of the wear: depth with predicted bands, narrowing posterior."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtGui import QColor

from rigapp.gui.data.knownwear import COEFFICIENT, UNIT, Floats, KnownWear
from rigapp.gui.data.pyramid import polyline
from rigapp.gui.data.ranges import SteadyRange
from rigapp.gui.data.series import SeriesTable
from rigapp.gui.data.texts import grouped
from rigapp.gui.look.tokens import Theme
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotting import NO_REVOLUTION, LegendRow, PlotPanel, QuietPlot, clear
from rigapp.gui.widgets.build import column

BUCKETS = 1200
UM_PER_MM = 1e3
EARLY, NEWEST, MEASURED = (
    LinePen("second", dashed=True),
    LinePen("model", dashed=True),
    LinePen("first"),
)
BINS = LinePen("main")
SHADE = 70
"""Opacity of a band, of 255: two of them over each other can still be told apart."""


class ShadedCurve:
    """Draw a median with the area between two limits."""

    def __init__(self, plot: QuietPlot, pen: LinePen) -> None:
        self._plot, self._pen = plot, pen
        self.median = plot.curve(pen)
        self._low, self._high = (plot.curve(LinePen("band")) for _ in range(2))
        self._fill = pg.FillBetweenItem(self._low, self._high)
        self._fill.setZValue(-5)
        plot.addItem(self._fill)

    def dress(self) -> None:
        """Take the plot's theme."""
        colour = QColor(self._pen.of(self._plot.theme).color())
        colour.setAlpha(SHADE)
        self._fill.setBrush(colour)

    def draw(self, x: Floats, low: Floats, median: Floats, high: Floats) -> None:
        """Draw what is finite of arrays (n,)."""
        known = np.isfinite(low) & np.isfinite(high)
        for curve, values in ((self._low, low), (self.median, median), (self._high, high)):
            curve.setData(x[known], values[known])

    def clear(self) -> None:
        """Draw nothing."""
        clear(self._low, self.median, self._high)


class DepthBandPanel(PlotPanel):
    """Draw the measured depth to the planned end, with the bands predicted early and last."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("wear_band_panel", "Wear depth with its predicted band")
        self.plot = QuietPlot("wear_band_plot", "Wear depth against cycle, with bands", theme)
        self.plot.label("left", "Wear depth (µm)")
        self.plot.label("bottom", "Cycle")
        self.plot.steady = SteadyRange(2.0)
        self.early, self.newest = ShadedCurve(self.plot, EARLY), ShadedCurve(self.plot, NEWEST)
        self._measured = self.plot.curve(MEASURED)
        self._end = self.plot.guide(0.0, horizontal=True)
        self.plot.draw_with(LinePen("text"), self._end)
        self.legend = LegendRow("wear_band_legend", theme)
        column(self.legend, (self.plot, 1), on=self)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        super().dress(theme)
        for band in (self.early, self.newest):
            band.dress()

    def draw(self, known: KnownWear, predictions: SeriesTable, waiting: str) -> None:
        """Draw what is known, over the newest measured depths; waiting: why there is nothing."""
        entries = []
        highest = 0.0
        for band, pen, shown in zip(
            (self.early, self.newest), (EARLY, NEWEST), self._bands(known), strict=True
        ):
            if shown is None:
                band.clear()
                continue
            band.draw(shown.revolution, shown.low, shown.median, shown.high)
            highest = max(highest, float(np.nanmax(shown.high, initial=0.0)))
            entries.append((f"95 % from {grouped(shown.after)} on", pen))
        depth = predictions.series("measured_wear_depth")
        x, y = polyline(predictions.revolutions, depth.envelope(0, len(depth), BUCKETS))
        self._measured.setData(x, UM_PER_MM * y, connect="finite")
        entries.append(("measured", MEASURED))
        self._end.setVisible(bool(np.isfinite(known.depth_um)))
        if np.isfinite(known.depth_um):
            self._end.setValue(known.depth_um)
            highest = max(highest, known.depth_um)
            entries.append((f"end at {known.depth_um:.4g} µm", LinePen("text")))
        self.legend.show_entries(entries)
        if not np.isfinite(y).any():
            self.plot.empty(waiting)
            return
        highest = max(highest, UM_PER_MM * float(np.nanmax(y)))
        last = max(float(predictions.revolutions[-1]), float(known.planned), 1.0)
        self.plot.setXRange(0.0, last, padding=0.0)
        self.plot.fit(min(UM_PER_MM * float(np.nanmin(y)), 0.0), highest)

    def _bands(self, known: KnownWear) -> tuple:  # type: ignore[type-arg]
        early = known.bands[0] if len(known.bands) > 1 else None
        return early, (known.bands[-1] if known.bands else None)


class NarrowingPanel(PlotPanel):
    """Draw the wear coefficient with its limits against the cycle at which it was known."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("wear_narrowing_panel", "Wear coefficient against cycle")
        self.plot = QuietPlot(
            "wear_narrowing_plot", "Wear coefficient with limits against cycle", theme
        )
        self.plot.label("left", f"Wear coefficient (10⁻⁶ {UNIT})")
        self.plot.label("bottom", "Cycle, by decades")
        self.band = ShadedCurve(self.plot, MEASURED)
        self.legend = LegendRow("wear_narrowing_legend", theme)
        self.legend.show_entries([("median, and between the 95 % limits", MEASURED)])
        column(self.legend, (self.plot, 1), on=self)
        self.plot.empty(f"{NO_REVOLUTION}: what is known of the wear coefficient is drawn here.")
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        super().dress(theme)
        self.band.dress()

    def draw(self, known: KnownWear, waiting: str) -> None:
        """Draw the course of what was known; waiting: why there is nothing."""
        if not known.course:
            self.band.clear()
            self.plot.empty(waiting)
            return
        low, median, high = (
            1e6 * known.course[f"{COEFFICIENT}{suffix}"] for suffix in ("_low", "", "_high")
        )
        x = np.log10(np.maximum(known.course["revolution"], 1.0))
        self.band.draw(x, low, median, high)
        self.plot.steady = SteadyRange(0.02 * float(median[-1]))
        self.plot.fit(float(low.min()), float(high.max()))
        first, last = np.floor(x[0]), np.ceil(x[-1] + 1e-9)
        self.plot.setXRange(first, max(last, first + 1.0), padding=0.02)
        decades = range(int(first), int(last) + 1)
        ticks = [[(float(power), grouped(10**power)) for power in decades]]
        self.plot.getAxis("bottom").setTicks(ticks)
