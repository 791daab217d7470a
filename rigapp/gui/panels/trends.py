"""Pages of trends: overview with the newest revolution, wear, and all trends."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import Qt
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.panel import Act, Host
from rigapp.gui.plots.curves import clear
from rigapp.gui.plots.knownwear import DepthBandPanel, ForecastPanel, NarrowingPanel
from rigapp.gui.plots.marks import CurveName
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.palette import MODEL, LinePen
from rigapp.gui.plots.plotpanel import PlotPanel, plot_heading, remark
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.widgets.build import column, named, prose, split
from rigapp.gui.widgets.reflow import FoldingSplitter
from rigapp.presentation.numbers import grouped, with_uncertainty
from rigapp.presentation.tokens import BODY_PT, STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.channels import SIZE
from rigapp.viewer.knownwear import WearReader
from rigapp.viewer.news import News, Takes
from rigapp.viewer.quantities import LARGEST, UM_PER_MM
from rigapp.viewer.ranges import SteadyRange
from rigapp.viewer.series import ANGLES_DEG as RECORDED_DEG
from rigapp.viewer.series import ShownProfile

Floats = NDArray[np.float64]

COEFFICIENT_LATER: Final[Text] = "The wear coefficient is drawn here once it is known."
NO_DEPTH: Final[Text] = "No depth of wear known yet: the worn profile of the bushing is drawn here."
MEASURED = LinePen("first")
ANGLES_DEG = np.linspace(-180.0, 180.0, 721)


MEASURED_DEPTH: Final[tuple[Text, Text]] = ("measured {}", "measured: not known")
MODEL_DEPTH: Final[tuple[Text, Text]] = ("model {}", "model: not known")
"""Label of a curve with its largest depth, and without one."""


@dataclass(frozen=True, slots=True)
class Entry:
    """The label at a curve; not known: there is no depth at which to place it."""

    text: str
    known: bool = True


def worn_profile(depth_mm: float, pin_radius_mm: float, bushing_radius_mm: float) -> Floats:
    """Return the depth of wear in mm at ANGLES_DEG from the contact point.

    The pin's circle penetrates the bushing by ``depth_mm`` at the contact point; the part beyond
    the bushing's original circle is worn. Valid where wear is much larger than elastic indentation
    and the force keeps its direction.
    """
    centre = bushing_radius_mm - pin_radius_mm + depth_mm
    angle = np.radians(ANGLES_DEG)
    root = np.maximum(pin_radius_mm**2 - (centre * np.sin(angle)) ** 2, 0.0)
    surface = centre * np.cos(angle) + np.sqrt(root)
    return np.maximum(surface - bushing_radius_mm, 0.0)


class WearProfilePanel(PlotPanel):
    """Draw the worn profile in the follower frame; without a recorded one, the pin's circle."""

    takes = Takes.HISTORY

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__(f"{prefix}_profile_panel", "Worn profile of the bushing")
        self._drawn: tuple[object, ...] | None = None
        self.plot = QuietPlot(f"{prefix}_profile_plot", "Worn profile of the bushing", theme)
        self.plot.label("bottom", "Angle from the contact point, follower frame")
        self.plot.show_range("x", -180.0, 180.0)
        ticks = [(float(angle), f"{angle}°".replace("-", "−")) for angle in range(-180, 181, 90)]
        self.plot.getAxis("bottom").setTicks([ticks])
        self._band = self.plot.shade(MEASURED)
        self._measured = self.plot.curve(MEASURED)
        self._model = self.plot.curve(MODEL)
        self.plot.steady = SteadyRange(2.0)
        self.title = remark(
            f"{prefix}_profile_title", ("Depths, and which part of the bushing was reached")
        )
        column(plot_heading("Worn profile"), self.title, (self.plot, 1), on=self)
        self._start_afresh()

    def show_news(self, news: News) -> None:
        """Draw the newest recorded profile, or one computed from the newest depths."""
        data = news.data
        if self.take_data(data):
            self._start_afresh()
        joint = news.recipe.model.joint if news.recipe is not None else None
        if data.profile is not None:
            self._refresh_recorded(data.profile)
            return
        measured = data.predictions.last("measured_wear_depth")
        predicted = data.predictions.last("wear_depth")
        token = (repr(measured), repr(predicted), joint)
        if joint is None or token == self._drawn:
            return
        self._drawn = token
        deepest = np.nan
        self._draw_band(None)
        for curve, depth in ((self._measured, measured), (self._model, predicted)):
            if math.isfinite(depth):
                sunk = max(depth, 0.0)
                profile = worn_profile(sunk, joint.pin_radius_mm, joint.bushing_radius_mm)
                curve.setData(ANGLES_DEG, UM_PER_MM * profile)
                deepest = np.fmax(deepest, depth)
            else:
                clear(curve)
        if math.isnan(deepest):
            self.plot.empty(NO_DEPTH)
        self.plot.fit(0.0, UM_PER_MM * deepest)
        self._show_entries(
            _depth(MEASURED_DEPTH, measured),
            _depth(MODEL_DEPTH, predicted),
            tr("no profile is recorded: the pin's circle sunk in by the depth"),
        )

    def _start_afresh(self) -> None:
        """Clear the plot: the profile was of another test."""
        self._drawn = None
        clear(self._measured, self._model, self._band)
        self._show_entries(_depth(MEASURED_DEPTH, math.nan), _depth(MODEL_DEPTH, math.nan), "")
        self.plot.empty(NO_DEPTH)

    def _refresh_recorded(self, profile: ShownProfile) -> None:
        if self._drawn == (profile,):
            return
        self._drawn = (profile,)
        seen = np.isfinite(profile.measured)
        self._measured.setData(RECORDED_DEG, UM_PER_MM * profile.measured)
        self._model.setData(RECORDED_DEG, UM_PER_MM * profile.predicted)
        self._draw_band(profile)
        self.plot.fit(0.0, UM_PER_MM * profile.deepest)
        if seen.any():
            index = int(np.nanargmax(profile.measured))
            most = UM_PER_MM * profile.measured[index]
            depth = with_uncertainty(most, UM_PER_MM * profile.uncertainty[index], "µm")
            extent = RECORDED_DEG[seen]
            words = tr(
                "reached {:.0f}° to {:.0f}°, cycle {}", extent[0], extent[-1], profile.revolution
            )
            measured = Entry(tr("measured {}", depth))
        else:
            text = tr("measured: not known yet, cycle {}", profile.revolution)
            measured, words = Entry(text, known=False), ""
        deepest = float(np.nanmax(profile.predicted, initial=-1.0))
        model = _depth(MODEL_DEPTH, deepest if deepest >= 0.0 else math.nan)
        self._show_entries(measured, model, words)

    def _draw_band(self, profile: ShownProfile | None) -> None:
        if profile is None or not np.isfinite(profile.measured).any():
            clear(self._band)
            return
        seen = np.isfinite(profile.measured)
        angle, depth = RECORDED_DEG[seen], UM_PER_MM * profile.measured[seen]
        uncertainty = UM_PER_MM * profile.uncertainty[seen]
        self._band.setData(angle, np.maximum(depth - uncertainty, 0.0), depth + uncertainty)

    def _show_entries(self, measured: Entry, model: Entry, words: str) -> None:
        """Label both curves at their largest depth, and show the measured depth."""
        names = [
            CurveName(entry.text, pen, np.nanmax(curve.y, initial=0.0))
            for entry, pen, curve in (
                (measured, MEASURED, self._measured),
                (model, MODEL, self._model),
            )
            if entry.known
        ]
        self.plot.show_marks(names=tuple(names))
        unknown = [entry.text for entry in (measured, model) if not entry.known]
        self.title.setText(", ".join(("µm", *unknown, *filter(None, (words,)))))


def _depth(texts: tuple[Text, Text], depth: float) -> Entry:
    known = math.isfinite(depth)
    return Entry(tr(texts[0], f"{UM_PER_MM * depth:.1f} µm") if known else tr(texts[1]), known)


BESIDE_FROM, PLOTS_TALL = 90 * STEP, 35 * STEP
"""Width for both plots beside each other, height of each below the other."""


class WearPanel(QWidget):
    """Show the evaluated wear as text and plots."""

    takes = Takes.HISTORY

    def __init__(self, theme: Theme, reader: WearReader) -> None:
        super().__init__()
        named(self, "wear_panel", "Wear")
        self._reader = reader
        self.sentence = prose("wear_sentence", "What is known of the wear")
        self.sentence.setFont(sized(self.sentence.font(), BODY_PT, QFont.Weight.DemiBold))
        self.bands, self.narrowing = DepthBandPanel(theme), NarrowingPanel(theme)
        plots = FoldingSplitter("wear_split", BESIDE_FROM).divide(
            (self.bands, 800, PLOTS_TALL), (self.narrowing, 600, TALL)
        )
        column(self.sentence, (plots, 1), on=self)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.bands.dress(theme)
        self.narrowing.dress(theme)

    def show_news(self, news: News) -> None:
        """Draw the evaluated wear, and request a new evaluation when there are new rows."""
        self._reader.look(news)
        known = self._reader.known
        waiting = tr(
            "No revolution measured yet: the wear depth with its predicted band is drawn here."
        )
        if len(news.data.rows):
            waiting = tr("The wear results are being computed …")
        sentence = self._reader.sentence
        if known.after:
            sentence += tr(" (By cycle {}.)", grouped(known.after))
        self.sentence.setText(sentence or waiting)
        self.bands.draw(known, news, waiting)
        self.narrowing.draw(known, COEFFICIENT_LATER if len(news.data.rows) else waiting)


def wear_page(host: Host) -> QWidget:
    """Make the page of the wear."""
    return host.add("wear", WearPanel(host.theme, host.wear))


OVERVIEW_BESIDE_FROM = 102 * STEP
OVERLAY, TRENDS = 45 * STEP, 50 * STEP
"""Heights of the plots of the overview where they are below each other."""
TRENDS_BESIDE_FROM = 90 * STEP
TALL = 28 * STEP
"""Height of the last two plots where they are below each other."""


def overview_page(host: Host) -> QWidget:
    """Make the first page."""
    theme = host.theme
    overlay = host.add("overview", OverlayPanel("overview", theme))
    view = TrendView()
    forecast = host.add(
        "forecast", ForecastPanel(theme, host.wear, partial(host.do, Act.CALIBRATE))
    )
    trend = host.add("overview_trend", TrendPanel("overview", theme, LARGEST, view=view))
    right = split("overview_right", Qt.Orientation.Vertical, [340, 300], forecast, trend)
    return FoldingSplitter("overview_split", OVERVIEW_BESIDE_FROM).divide(
        (overlay, 700, OVERLAY), (right, 700, TRENDS)
    )


def trend_page(host: Host) -> QWidget:
    """Make the page of trends."""
    view = TrendView()
    upper, residual, lower = (
        host.add(
            f"{name}_trend",
            TrendPanel(name, host.theme, quantity, view=view, leads=name == "upper"),
        )
        for name, quantity in (("upper", SIZE), ("residual", "residual"), ("lower", "wear"))
    )
    profile = host.add("profile", WearProfilePanel("trends", host.theme))
    below = FoldingSplitter("trend_lower", TRENDS_BESIDE_FROM).divide(
        (lower, 700, TALL), (profile, 700, TALL)
    )
    return split("trend_split", Qt.Orientation.Vertical, [270, 240, 270], upper, residual, below)
