"""Pages of trends: the overview with the newest revolution, and the life of the joint."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from rigapp.gui.panel import Act, Host
from rigapp.gui.plots.knownwear import ForecastPanel
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.plots.wearprofile import WearProfilePanel
from rigapp.gui.widgets.build import split
from rigapp.gui.widgets.reflow import FoldingSplitter
from rigapp.presentation.tokens import STEP
from rigapp.viewer.channels import SIZE
from rigapp.viewer.quantities import LARGEST

OVERVIEW_BESIDE_FROM = 102 * STEP
OVERLAY, TRENDS = 45 * STEP, 50 * STEP
"""Heights of the plots of the overview where they stand below each other."""
TRENDS_BESIDE_FROM = 90 * STEP
TALL = 28 * STEP
"""Height of the last two plots where they stand below each other."""


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
            f"{place}_trend",
            TrendPanel(place, host.theme, quantity, view=view, leads=place == "upper"),
        )
        for place, quantity in (("upper", SIZE), ("residual", "residual"), ("lower", "wear"))
    )
    profile = host.add("profile", WearProfilePanel("trends", host.theme))
    below = FoldingSplitter("trend_lower", TRENDS_BESIDE_FROM).divide(
        (lower, 700, TALL), (profile, 700, TALL)
    )
    return split("trend_split", Qt.Orientation.Vertical, [270, 240, 270], upper, residual, below)
