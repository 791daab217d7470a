"""The first page: the newest revolution, its trends and the alarms."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from rigapp.gui.data.quantities import LARGEST
from rigapp.gui.panel import Host
from rigapp.gui.panels.alarms import AlarmPanel
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.trendview import TrendView
from rigapp.gui.widgets.build import page, split


def overview_page(host: Host) -> QWidget:
    """Make the first page."""
    theme = host.theme
    overlay = host.add("overview", OverlayPanel("overview", theme))
    view = TrendView()
    wear = host.add("overview_wear", TrendPanel("overview_wear", theme, "wear", view=view))
    trend = host.add(
        "overview_trend", TrendPanel("overview", theme, LARGEST, view=view, leads=False)
    )
    alarms = host.add("overview_alarms", AlarmPanel("overview", theme, compact=True))
    alarms.wanted.connect(host.ask)
    right = split("overview_right", Qt.Orientation.Vertical, [320, 320], wear, trend)
    upper = split("overview_split", Qt.Orientation.Horizontal, [700, 700], overlay, right)
    return page((upper, 1), alarms)
