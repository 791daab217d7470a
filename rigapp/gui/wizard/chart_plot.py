"""The control chart of the daily checks in the window: values, U of the calibration, own limits."""

from __future__ import annotations

import numpy as np
import pyqtgraph as pg
from PySide6.QtWidgets import QWidget

from rigapp.calibrating.daily_history import DailyHistory, verdict_lines
from rigapp.gui.plots.palette import line_pen
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import column
from rigapp.gui.wizard.widgets import caption, sentence, taking_what_is_left
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr, translate


class ChartPlot(QWidget):
    """Show the sensitivity of all checks with the calibration in use, and what the rules say."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self.plot = QuietPlot("daily_chart", tr("Sensitivity of the daily checks"), theme)
        self.plot.label("bottom", tr("Check"))
        self._line = pg.PlotDataItem(symbol="o", symbolSize=8)
        self.plot.addItem(self._line)
        self._guides: list[pg.InfiniteLine] = []
        self._found: DailyHistory | None = None
        self.dress(theme)
        self.words = sentence("daily_words", "What the control charts say")
        column(
            caption("Felt / applied force"),
            (taking_what_is_left(self.plot), 1),
            self.words,
            on=self,
        )

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme, colour = theme, theme.curves["first"]
        self.plot.dress(theme)
        self._line.setPen(line_pen(colour))
        self._line.setSymbolPen(colour)
        self._line.setSymbolBrush(colour)
        if self._found is not None:
            self.show_history(self._found)

    def show_history(self, found: DailyHistory) -> None:
        """Show the checks, the limits, and the sentences."""
        self._found = found
        one = found.charts["sensitivity_ratio"]
        self._line.setData(np.arange(1.0, len(one.values) + 1.0), one.values)
        for guide in self._guides:
            self.plot.removeItem(guide)
        self._guides = []
        levels = [one.promised]
        self._level(one.promised, "what the calibration says")
        if one.expanded is not None:
            for sign in (-1.0, 1.0):
                levels.append(one.promised + sign * one.expanded)
                self._level(levels[-1], "its U", dotted=True)
        for limit in one.limits or ():
            levels.append(limit)
            self._level(limit, "limit of the history", dotted=True)
        low = min(float(one.values.min()), *levels)
        high = max(float(one.values.max()), *levels)
        margin = max(0.15 * (high - low), 1e-4)
        self.plot.setXRange(0.5, max(8.5, len(one.values) + 0.5), padding=0.0)
        self.plot.setYRange(low - margin, high + margin, padding=0.0)
        self.words.setText("\n".join(map(translate, verdict_lines(found))))

    def _level(self, value: float, words: Text, *, dotted: bool = False) -> None:
        pen = line_pen(self._theme.text, dotted=dotted)
        guide = pg.InfiniteLine(
            value,
            angle=0,
            pen=pen,
            label=tr(words),
            labelOpts={"position": 0.88, "color": self._theme.text},
        )
        self.plot.addItem(guide)
        self._guides.append(guide)
