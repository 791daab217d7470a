"""The life of the joint: three trends, and the worn profile."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from rigapp.gui.data.channels import SIZE
from rigapp.gui.panel import Host
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.plots.wearprofile import WearProfilePanel
from rigapp.gui.widgets.build import split


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
    below = split("trend_lower", Qt.Orientation.Horizontal, [700, 700], lower, profile)
    return split("trend_split", Qt.Orientation.Vertical, [270, 240, 270], upper, residual, below)
