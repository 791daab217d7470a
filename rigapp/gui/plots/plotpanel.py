"""A panel of plots, and the labels beside them: titles, units, remarks."""

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
"""Begin of the sentence of a plot without a revolution yet."""


class PlotPanel(QWidget):
    """A panel of plots: in a new theme every plot on it is drawn anew.

    The data that is drawn is held weakly: a hidden panel keeps no test that is over.
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
        """Return what it needs at its width: a splitter does not consider how its texts wrap."""
        least, layout = super().minimumSizeHint(), self.layout()
        if layout is not None and layout.hasHeightForWidth():
            least.setHeight(max(least.height(), layout.totalMinimumHeightForWidth(self.width())))
        return least

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Update the size hint: texts wrap differently now."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self.updateGeometry()

    def take_data(self, data: LiveData) -> bool:
        """Set the data that is drawn; return whether it has changed."""
        other = self._data is None or data is not self._data()
        if other:
            self._data = ref(data)
        return other

    def showEvent(self, event: QShowEvent) -> None:
        """Empty the plots of a test that is over; the new one is drawn in a later turn."""
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
    """Return a label for a few words below a title; it wraps."""
    return prose(name, spoken, role="caption")


def detail(name: str, spoken: Text) -> ShortLabel:
    """Return a label beside a title, for unit or revolution; its short text always has room."""
    label = ShortLabel(name, spoken)
    label.setProperty("role", "secondary")
    label.setContentsMargins(STEP // 2, 0, STEP // 2, 0)
    return label
