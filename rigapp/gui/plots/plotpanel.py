"""A panel of plots with labels: titles, units, remarks."""

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
"""Start of the sentence shown in a plot before the first revolution."""


class PlotPanel(QWidget):
    """A panel of plots, which are redrawn in a new theme.

    The drawn data are referenced weakly, so that a hidden panel does not keep an ended test.
    """

    def __init__(self, name: str, spoken: Text) -> None:
        super().__init__()
        self._data: ref[LiveData] | None = None
        named(self, name, spoken, role="card")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setContentsMargins(GAP, STEP, GAP, STEP)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        for plot in self.findChildren(QuietPlot):
            plot.dress(theme)

    def minimumSizeHint(self) -> QSize:
        """Return the minimum size at this width: a splitter does not consider wrapped texts."""
        least, layout = super().minimumSizeHint(), self.layout()
        if layout is not None and layout.hasHeightForWidth():
            least.setHeight(max(least.height(), layout.totalMinimumHeightForWidth(self.width())))
        return least

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Update the size hint, since texts wrap differently."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def take_data(self, data: LiveData) -> bool:
        """Set the data to draw; return whether they are other data."""
        other = self._data is None or data is not self._data()
        if other:
            self._data = ref(data)
        return other

    def showEvent(self, event: QShowEvent) -> None:
        """Clear the plots of an ended test; the new one is drawn later in the event loop."""
        if self._data is not None and self._data() is None:
            for plot in self.findChildren(QuietPlot):
                plot.empty(NO_REVOLUTION)
        super().showEvent(event)


def plot_heading(text: Text) -> QLabel:
    """Return the title of a card, or of a part of it."""
    label = QLabel(tr(text))
    label.setFont(sized(label.font(), BODY_PT, QFont.Weight.DemiBold))
    return label


def remark(name: str, spoken: Text) -> QLabel:
    """Return a wrapping label for a short text below a title."""
    return prose(name, spoken, role="caption")


def detail(name: str, spoken: Text) -> ShortLabel:
    """Return a label beside a title, for unit or revolution; its short text always fits."""
    label = ShortLabel(name, spoken)
    label.setProperty("role", "secondary")
    label.setContentsMargins(STEP // 2, 0, STEP // 2, 0)
    return label
