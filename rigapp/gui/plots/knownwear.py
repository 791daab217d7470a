"""Pictures of what is known of the wear: depth with predicted bands, narrowing posterior."""

from __future__ import annotations

import numpy as np

from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.limitlines import limit_lines
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotting import NO_REVOLUTION, PlotPanel, QuietPlot, plot_heading, remark
from rigapp.gui.widgets.build import column
from rigapp.presentation.numbers import COEFFICIENT_SCALE, COEFFICIENT_UNIT, grouped
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.judged import EVERYTHING, Flagged, drawn
from rigapp.viewer.knownwear import COEFFICIENT, Floats, KnownWear
from rigapp.viewer.news import News
from rigapp.viewer.quantities import UM_PER_MM
from rigapp.viewer.ranges import SteadyRange

BUCKETS = 1200
"""Points of a line across: about one for each pixel."""
DEPTH = "measured_wear_depth"
EARLY, NEWEST, MEASURED = (
    LinePen("second", dashed=True),
    LinePen("model", dashed=True),
    LinePen("first"),
)


class ShadedCurve:
    """Draw a median with the area between two limits."""

    def __init__(self, plot: QuietPlot, pen: LinePen) -> None:
        self._band = plot.shade(pen)
        self.median = plot.curve(pen)

    def draw(self, x: Floats, low: Floats, median: Floats, high: Floats) -> None:
        """Draw what is finite of arrays (n,)."""
        known = np.isfinite(low) & np.isfinite(high)
        self.median.setData(x[known], median[known])
        self._band.setData(x, low, high)

    def clear(self) -> None:
        """Draw nothing."""
        clear(self.median, self._band)


class DepthBandPanel(PlotPanel):
    """Draw the measured depth to the planned end, with the bands predicted early and last."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("wear_band_panel", "Wear depth with its predicted band")
        self.plot = QuietPlot("wear_band_plot", "Wear depth against cycle, with bands", theme)
        self.plot.label("bottom", "Cycle")
        self.plot.steady = SteadyRange(2.0)
        self.early, self.newest = ShadedCurve(self.plot, EARLY), ShadedCurve(self.plot, NEWEST)
        self._measured = self.plot.curve(MEASURED)
        self.title = remark("wear_band_title", "Unit")
        self.title.setText(tr("µm, to the planned end; bands 95 %"))
        column(plot_heading("Wear depth"), self.title, (self.plot, 1), on=self)

    def draw(self, known: KnownWear, news: News, waiting: Text) -> None:
        """Draw what is known, over the newest measured depths; waiting: why there is nothing."""
        predictions = news.data.predictions
        names = []
        highest = 0.0
        for band, pen, shown in zip(
            (self.early, self.newest), (EARLY, NEWEST), self._bands(known), strict=True
        ):
            if shown is None:
                band.clear()
                continue
            band.draw(shown.revolution, shown.low, shown.median, shown.high)
            highest = max(highest, float(np.nanmax(shown.high, initial=0.0)))
            text = tr("from {} on", grouped(shown.after))
            names.append(CurveName(text, pen, float(shown.median[-1])))
        flagged = Flagged(news.data.rows, EVERYTHING, BUCKETS)
        line = drawn(predictions, DEPTH, flagged, EVERYTHING, BUCKETS, UM_PER_MM)
        self._measured.setData(line.x, line.y)
        seen = np.flatnonzero(np.isfinite(line.y))
        if not seen.size:
            self.plot.empty(waiting)
            return
        names.append(CurveName(tr("measured"), MEASURED, float(line.y[seen[-1]])))
        if np.isfinite(known.depth_um):
            highest = max(highest, known.depth_um)
        last = max(float(predictions.revolutions[-1]), float(known.planned), 1.0)
        self.plot.show_range("x", 0.0, last)
        self.plot.fit(min(line.low, 0.0), max(highest, line.high))
        limits = limit_lines(news, {DEPTH})
        self.plot.show_marks(names=tuple(names), limits=limits)

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
        self.plot.label("bottom", "Cycle, by decades")
        self.band = ShadedCurve(self.plot, MEASURED)
        self.title = remark("wear_narrowing_title", "Unit, and what the band is")
        self.title.setText(tr("{}; band 95 %", COEFFICIENT_UNIT))
        column(plot_heading("Wear coefficient"), self.title, (self.plot, 1), on=self)
        waiting = tr("what is known of the wear coefficient is drawn here.")
        self.plot.empty(f"{tr(NO_REVOLUTION)}: {waiting}")

    def draw(self, known: KnownWear, waiting: Text) -> None:
        """Draw the course of what was known; waiting: why there is nothing."""
        if not known.course:
            self.band.clear()
            self.plot.empty(waiting)
            return
        low, median, high = (
            COEFFICIENT_SCALE * known.course[f"{COEFFICIENT}{suffix}"]
            for suffix in ("_low", "", "_high")
        )
        x = np.log10(np.maximum(known.course["revolution"], 1.0))
        self.band.draw(x, low, median, high)
        self.plot.steady = SteadyRange(0.02 * float(median[-1]))
        self.plot.fit(float(low.min()), float(high.max()))
        first, last = np.floor(x[0]), np.ceil(x[-1] + 1e-9)
        self.plot.show_range("x", first, max(last, first + 1.0), 0.02)
        decades = range(int(first), int(last) + 1)
        ticks = [[(float(power), grouped(10**power)) for power in decades]]
        self.plot.getAxis("bottom").setTicks(ticks)
