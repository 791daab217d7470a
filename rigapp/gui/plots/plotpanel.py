"""A panel of plots, and what is written beside them: titles, units, remarks."""

from __future__ import annotations

from typing import Final
from weakref import ref

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFont, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QLabel, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.widgets.build import named, prose
from rigapp.gui.widgets.labels import ShortLabel
from rigapp.presentation.tokens import BODY_PT, GAP, STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.series import LiveData

NO_REVOLUTION: Final[Text] = "No revolution measured yet"
"""The beginning of the sentence of a plot that waits for the first one."""


class PlotPanel(QWidget):
    """A panel of plots: in a new theme every plot on it is drawn anew.

    The data that is drawn is held weakly: a panel that nobody looks at keeps no test that is over.
    """

    def __init__(self, name: str, spoken: Text) -> None:
        super().__init__()
        self._data: ref[LiveData] | None = None
        named(self, name, spoken, role="card")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setContentsMargins(GAP, STEP, GAP, STEP)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        for plot in self.findChildren(QuietPlot):
            plot.dress(theme)

    def minimumSizeHint(self) -> QSize:
        """Return what it needs at its width: a splitter does not ask how its texts wrap."""
        least, layout = super().minimumSizeHint(), self.layout()
        if layout is not None and layout.hasHeightForWidth():
            least.setHeight(max(least.height(), layout.totalMinimumHeightForWidth(self.width())))
        return least

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Take note that texts wrap otherwise now."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def take_data(self, data: LiveData) -> bool:
        """Take the data that is drawn from now on; return whether it is other than before."""
        other = self._data is None or data is not self._data()
        if other:
            self._data = ref(data)
        return other

    def showEvent(self, event: QShowEvent) -> None:
        """Show nothing of a test that is over: what is new is drawn in a turn of its own."""
        if self._data is not None and self._data() is None:
            for plot in self.findChildren(QuietPlot):
                plot.empty(NO_REVOLUTION)
        super().showEvent(event)


def plot_heading(text: Text) -> QLabel:
    """Return the title of a card, or of a part of it."""
    made = QLabel(tr(text))
    made.setFont(sized(made.font(), BODY_PT, QFont.Weight.DemiBold))
    return made


def remark(name: str, spoken: Text) -> QLabel:
    """Return what is said in a few words below a title; it wraps."""
    return prose(name, spoken, role="caption")


def detail(name: str, spoken: Text) -> ShortLabel:
    """Return what stands beside a title: unit, revolution; its short text has always room."""
    made = ShortLabel(name, spoken)
    made.setProperty("role", "secondary")
    made.setContentsMargins(STEP // 2, 0, STEP // 2, 0)
    return made
