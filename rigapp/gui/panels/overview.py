"""The first page: the newest revolution and its trends."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from rigapp.gui.data.quantities import LARGEST
from rigapp.gui.look.tokens import STEP
from rigapp.gui.panel import Host
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.widgets.build import split
from rigapp.gui.widgets.reflow import FoldingSplitter

BESIDE_FROM = 102 * STEP
FORCE, DIFFERENCE, TREND = 18 * STEP, 11 * STEP, 12 * STEP
"""Heights of the plots at least: a low window scrolls."""
OVERLAY, TRENDS = 45 * STEP, 50 * STEP
"""Heights of the plots where they stand below each other."""


def overview_page(host: Host) -> QWidget:
    """Make the first page."""
    theme = host.theme
    overlay = host.add("overview", OverlayPanel("overview", theme))
    view = TrendView()
    wear = host.add("overview_wear", TrendPanel("overview_wear", theme, "wear", view=view))
    trend = host.add(
        "overview_trend", TrendPanel("overview", theme, LARGEST, view=view, leads=False)
    )
    for plot, least in (
        (overlay.plot, FORCE),
        (overlay.residual_plot, DIFFERENCE),
        (wear.plot, TREND),
        (trend.plot, TREND),
    ):
        plot.setMinimumHeight(least)
    right = split("overview_right", Qt.Orientation.Vertical, [320, 320], wear, trend)
    return FoldingSplitter("overview_split", BESIDE_FROM).divide(
        (overlay, 700, OVERLAY), (right, 700, TRENDS)
    )
