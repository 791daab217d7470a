"""The life of the joint: three trends, and the worn profile."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from rigapp.gui.data.channels import SIZE
from rigapp.gui.look.tokens import STEP
from rigapp.gui.panel import Host
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.plots.wearprofile import WearProfilePanel
from rigapp.gui.widgets.build import split
from rigapp.gui.widgets.reflow import FoldingSplitter

BESIDE_FROM = 90 * STEP
LEAST, TALL = 12 * STEP, 28 * STEP
"""Height of a plot at least, and of the last two where they stand below each other."""


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
    below = FoldingSplitter("trend_lower", BESIDE_FROM).divide(
        (lower, 700, TALL), (profile, 700, TALL)
    )
    for one in (upper, residual, lower, profile):
        one.plot.setMinimumHeight(LEAST)
    return split("trend_split", Qt.Orientation.Vertical, [270, 240, 270], upper, residual, below)
