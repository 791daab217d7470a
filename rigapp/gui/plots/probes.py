"""Position of the pin in the bushing over one revolution, from the two probes."""

from __future__ import annotations

import numpy as np
from PySide6.QtWidgets import QWidget

from rigapp.gui.data.news import News
from rigapp.gui.data.pyramid import thinned
from rigapp.gui.data.ranges import SteadyRange
from rigapp.gui.plots.palette import Theme, measured_pen
from rigapp.gui.plots.plotting import LegendEntry, LegendRow, QuietPlot
from rigapp.gui.widgets.build import column, named

PROBES = {"probe_1": "probe 1, along follower", "probe_2": "probe 2, across follower"}


class ProbePanel(QWidget):
    """Draw both probes against crank angle."""

    def __init__(self, prefix: str, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._means: dict[str, float] = {}
        self._drawn = -1
        named(self, f"{prefix}_probe_panel", "Pin position over one revolution")
        self.plot = QuietPlot(f"{prefix}_probe_plot", "Pin position against crank angle", theme)
        self.plot.label("left", "Position − mean (µm)")
        self.plot.guide(0.0, horizontal=True, theme=theme)
        self.plot.show_crank_angle(theme)
        self._curves = {name: self.plot.curve(measured_pen(theme, name)) for name in PROBES}
        self._range = SteadyRange(5.0, symmetric=True)
        self.legend = LegendRow(f"{prefix}_probe_legend")
        column(self.legend, (self.plot, 1), on=self)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.plot.dress(theme)
        for name, curve in self._curves.items():
            curve.setPen(measured_pen(theme, name))
        self._theme = theme
        self._show_legend()

    def _show_legend(self) -> None:
        entries = []
        for name, text in PROBES.items():
            mean = self._means.get(name)
            shown = text if mean is None else f"{text}, mean {mean:.1f} µm"
            entries.append(LegendEntry(shown, measured_pen(self._theme, name)))
        self.legend.show_entries(entries)

    def show_news(self, news: News) -> None:
        """Draw the newest revolution if it is not drawn yet."""
        cycle = news.data.cycle
        if cycle is None and self._drawn >= 0:
            self._drawn = -1
            for curve in self._curves.values():
                curve.setData([], [])
        if cycle is None or cycle.revolution == self._drawn:
            return
        self._drawn = cycle.revolution
        angle = cycle.angle_deg.astype(np.float64)
        values = {}
        for name, curve in self._curves.items():
            position = cycle.channels[name].astype(np.float64)
            self._means[name] = float(position.mean())
            values[name] = position - self._means[name]
            curve.setData(*thinned(angle, values[name], max(self.plot.width(), 200)))
        self._show_legend()
        low = min(float(array.min()) for array in values.values())
        high = max(float(array.max()) for array in values.values())
        if self._range.update(low, high) and self._range.range is not None:
            self.plot.setYRange(*self._range.range, padding=0.0)
