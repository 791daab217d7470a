"""Plots of the evaluated wear: depth with predicted bands, narrowing posterior."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Final

import numpy as np
from PySide6.QtGui import QFont

from rigapp.gui.look.fonts import sized
from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.marks import CurveName, limit_lines
from rigapp.gui.plots.palette import LinePen
from rigapp.gui.plots.plotpanel import NO_REVOLUTION, PlotPanel, detail, plot_heading, remark
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import button, column, prose, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.presentation.numbers import COEFFICIENT_SCALE, COEFFICIENT_UNIT, grouped
from rigapp.presentation.tokens import BODY_PT, GAP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import Status
from rigapp.viewer.knownwear import (
    COEFFICIENT,
    REMAINING,
    REST_S,
    Floats,
    KnownWear,
    WearBand,
    WearReader,
    wear_of,
)
from rigapp.viewer.lines import EVERYTHING, Flagged, drawn
from rigapp.viewer.news import News, Takes
from rigapp.viewer.quantities import UM_PER_MM
from rigapp.viewer.ranges import SteadyRange

BUCKETS = 1200
"""Maximum number of points of a line: about one for each pixel."""
DEPTH, MODEL_DEPTH = "measured_wear_depth", "wear_depth"
PROBES: Final = ("probe_1", "probe_2")
NO_RECORD: Final[Text] = "No forecast: the probes have no calibration record. Calibrate them."
FORECAST_REST_S = 60.0
"""Minimum time between two evaluations for the overview: each occupies a core for seconds."""
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
        """Draw the finite values of arrays (n,)."""
        known = np.isfinite(low) & np.isfinite(high)
        self.median.setData(x[known], median[known])
        self._band.setData(x, low, high)

    def clear(self) -> None:
        """Clear the curve."""
        clear(self.median, self._band)


class DepthPlot(QuietPlot):
    """The measured depth to the planned end, with predicted bands, else with the model."""

    def __init__(self, name: str, theme: Theme) -> None:
        super().__init__(name, "Wear depth against cycle, with bands", theme)
        self.label("bottom", "Cycle")
        self.steady = SteadyRange(2.0)
        self.early, self.newest = ShadedCurve(self, EARLY), ShadedCurve(self, NEWEST)
        self._model = self.curve(NEWEST)
        self._measured = self.curve(MEASURED)

    def draw(self, known: KnownWear, news: News, waiting: Text, *, early: bool = True) -> None:
        """Draw the evaluated wear with the newest measured depths.

        waiting: reason for a missing evaluation. early: draw the first predicted band, too.
        """
        predictions, names, highest = news.data.predictions, [], 0.0
        for band, pen, shown in zip(
            (self.early, self.newest), (EARLY, NEWEST), _bands(known, early=early), strict=True
        ):
            if shown is None:
                band.clear()
                continue
            band.draw(shown.revolution, shown.low, shown.median, shown.high)
            highest = max(highest, float(np.nanmax(shown.high, initial=0.0)))
            text = tr("from {} on", grouped(shown.after)) if early else tr("forecast, 95 %")
            names.append(CurveName(text, pen, float(shown.median[-1])))
        flagged = Flagged(news.data.rows, EVERYTHING, BUCKETS)
        line = drawn(predictions, DEPTH, flagged, EVERYTHING, BUCKETS, UM_PER_MM)
        self._measured.setData(line.x, line.y)
        seen = np.flatnonzero(np.isfinite(line.y))
        lowest, alone = min(line.low, 0.0), not known.bands and not early
        clear(self._model)
        if alone:
            model = drawn(predictions, MODEL_DEPTH, flagged, EVERYTHING, BUCKETS, UM_PER_MM)
            self._model.setData(model.x, model.y)
            if np.isfinite(model.high):
                highest = max(highest, model.high)
                lowest = min(model.low, 0.0) if not seen.size else lowest
                names.append(CurveName(tr("model"), NEWEST, float(model.y[-1])))
        if not seen.size and not names:
            self.empty(waiting)
            return
        if seen.size:
            names.append(CurveName(tr("measured"), MEASURED, float(line.y[seen[-1]])))
            highest = max(highest, line.high)
        if np.isfinite(known.depth_um):
            highest = max(highest, known.depth_um)
        test = news.status.test if news.status is not None else None
        planned = max(known.planned, test.planned if test is not None else 0)
        last = max(float(predictions.revolutions[-1]), float(planned), 1.0)
        self.show_range("x", 0.0, last)
        self.fit(lowest, highest)
        self.show_marks(names=tuple(names), limits=limit_lines(news, {DEPTH}))


def _bands(known: KnownWear, *, early: bool) -> tuple[WearBand | None, WearBand | None]:
    first = known.bands[0] if len(known.bands) > 1 and early else None
    return first, (known.bands[-1] if known.bands else None)


class DepthBandPanel(PlotPanel):
    """Draw the measured depth to the planned end, with the bands predicted early and last."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("wear_band_panel", "Wear depth with its predicted band")
        self.plot = DepthPlot("wear_band_plot", theme)
        self.title = remark("wear_band_title", "Unit")
        self.title.setText(tr("µm, to the planned end; bands 95 %"))
        column(plot_heading("Wear depth"), self.title, (self.plot, 1), on=self)

    def draw(self, known: KnownWear, news: News, waiting: Text) -> None:
        """Draw the evaluated wear; waiting: reason for a missing evaluation."""
        self.plot.draw(known, news, waiting)


class ForecastPanel(PlotPanel):
    """Draw the depth to the planned end with its forecast; show the remaining life or a reason.

    calibrate: called by the button that is shown where the probes have no calibration record.
    """

    takes = Takes.HISTORY

    def __init__(self, theme: Theme, reader: WearReader, calibrate: Callable[[], None]) -> None:
        super().__init__("forecast_panel", "Wear depth with its forecast")
        self._reader = reader
        self.plot = DepthPlot("forecast_plot", theme)
        self.unit = detail("forecast_unit", "Unit")
        self.unit.show_text(tr("µm, to the planned end"), "µm")
        self.remains = ElidedLabel("forecast_remains", "What remains")
        bold = sized(self.remains.font(), BODY_PT, QFont.Weight.DemiBold)
        self.remains.setFont(bold)
        self.why = prose("forecast_why", "Why there is no forecast", role="secondary")
        self.calibrate_button = button(
            "forecast_mend",
            "Calibrate the probes",
            calibrate,
            guarded=True,
        )
        head = row(plot_heading("Wear depth"), (self.unit, 1))
        below = row((self.why, 1), self.calibrate_button, spacing=GAP)
        column(head, self.remains, below, (self.plot, 1), on=self)

    def show_news(self, news: News) -> None:
        """Draw the evaluated wear; the forecast is updated once a minute."""
        self._reader.look(news, FORECAST_REST_S if self._reader.known.bands else REST_S)
        known, status = self._reader.known, news.status
        waiting = tr(
            "The wear depth with its forecast is drawn here."
            if len(news.data.rows)
            else "No revolution measured yet: the wear depth with its forecast is drawn here."
        )
        self.plot.draw(known, news, waiting, early=False)
        remaining = [number for number in wear_of(news, time.time()) if number.name == REMAINING]
        remains = [f"{number.title}: {number.value} · {number.detail}" for number in remaining]
        self.remains.setVisible(bool(remains))
        self.remains.show_text("".join(remains))
        record_missing = status is not None and not news.is_replay and probes_lack_record(status)
        why = "" if remains else tr(NO_RECORD) if record_missing else self._reader.sentence
        if not why and not remains and len(news.data.rows):
            why = tr("The forecast is being computed …")
        self.why.setText(why)
        self.why.setVisible(bool(why))
        self.calibrate_button.setVisible(record_missing and not remains)


def probes_lack_record(status: Status) -> bool:
    """Return whether a probe has no stated uncertainty, without which there is no forecast."""
    probes = [channel for channel in status.rig.channels if channel.name in PROBES]
    return bool(probes) and any(probe.uncertainty is None for probe in probes)


class NarrowingPanel(PlotPanel):
    """Draw the wear coefficient with its limits against the cycle of its evaluation."""

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
        """Draw the course of the evaluation; waiting: reason for a missing one."""
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
