"""The panel of one revolution: overlay, hold, any stored revolution, numbers, vector, probes."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QWidget,
)

from rigapp.gui.data.comparison import RevolutionCurves, statistics
from rigapp.gui.data.frames import COMPONENT_NAMES, ForceFrame
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.recording import StoredRevolution
from rigapp.gui.language.words import Text, tr
from rigapp.gui.look.tokens import Theme
from rigapp.gui.panel import Host
from rigapp.gui.plots.channelcurves import ChannelCurvePanel
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.polar import PolarPanel
from rigapp.gui.widgets.build import button, named, page, row, split, whole_number

STATISTICS: Final[tuple[Text, ...]] = ("max", "min", "RMS")
KINDS: Final[tuple[Text, ...]] = ("meas.", "model", "diff.")


class ValueTable(QTableWidget):
    """Repeat in numbers what the overlay shows, for eyes, ears and the clipboard."""

    def __init__(self, prefix: str) -> None:
        headings = [f"{tr(one)}\n{tr(kind)}" for one in STATISTICS for kind in KINDS]
        super().__init__(3, len(headings))
        named(self, f"{prefix}_values", "Statistics of the revolution shown, in N")
        self.setHorizontalHeaderLabels(headings)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        for line in range(3):
            for column in range(len(headings)):
                item = QTableWidgetItem("–")
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                self.setItem(line, column, item)
        self._fit()

    def show_values(self, shown: RevolutionCurves | None, frame: ForceFrame) -> None:
        """Fill the table, with dashes when nothing is shown."""
        first, second = map(tr, COMPONENT_NAMES[frame])
        self.setVerticalHeaderLabels(["|F| (N)", f"{first} (N)", f"{second} (N)"])
        unknown = [float("nan")] * self.columnCount()
        table = [unknown] * 3 if shown is None else [values for _, values in statistics(shown)]
        for line, values in enumerate(table):
            for column, value in enumerate(values):
                sign = "+" if column % 3 == 2 else ""
                text = "–" if value != value else f"{value:{sign}.2f}"
                item = self.item(line, column)
                if item is not None and item.text() != text:
                    item.setText(text)

    def _fit(self) -> None:
        height = self.horizontalHeader().sizeHint().height() + 4
        height += sum(self.sizeHintForRow(row) for row in range(3)) + 6
        self.setFixedHeight(height)


class CyclePanel(QSplitter):
    """Hold the overlay with its tools on the left, vector and other channels on the right."""

    revolution_wanted = Signal(int)
    takes = Takes.REVOLUTION

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        named(self, "cycle_split", "One revolution")
        self.setChildrenCollapsible(False)
        self.overlay = OverlayPanel("cycle", theme)
        self.values = ValueTable("cycle")
        self.polar = PolarPanel("cycle", theme)
        self.channels = ChannelCurvePanel("cycle", theme)
        self._valued: RevolutionCurves | None = None
        self._add_tools()
        self.right = split(
            "cycle_right",
            Qt.Orientation.Vertical,
            [300, 300],
            self.polar,
            self.channels,
            spoken="Vector and other channels",
        )
        self.addWidget(page(self.tools, (self.overlay, 1), self.values))
        self.addWidget(self.right)
        self.setSizes([860, 500])

    def _add_tools(self) -> None:
        self.hold = button("cycle_hold", "&Hold", self._held, "Hold the picture", checkable=True)
        self.stored = whole_number(
            "cycle_stored", "Stored revolution to compare with", 1, 1_000_000_000
        )
        self.show_stored = button(
            "cycle_compare",
            "Compare",
            self._compare,
            "Compare with the stored revolution",
            checkable=True,
        )
        self.tools = row(self.hold, "Stored revol&ution", self.stored, self.show_stored, None)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        for panel in (self.overlay, self.polar, self.channels):
            panel.dress(theme)

    def show_news(self, news: News) -> None:
        """Draw the newest revolution."""
        self.overlay.show_news(news)
        shown = self.overlay.shown
        if shown is not self._valued:
            self._valued = shown
            self.values.show_values(shown, self.overlay.frame)
            self.polar.refresh(shown, self.overlay.frame)
        if not self.overlay.held:
            self.channels.show_news(news)

    def show_revolution(self, stored: StoredRevolution) -> None:
        """Compare with a stored revolution that has been read."""
        self.stored.setValue(stored.cycle.revolution)
        self.overlay.compare_with(stored)

    def no_revolution(self) -> None:
        """Take note that there is nothing to compare with."""
        self.show_stored.setChecked(False)

    def _held(self, held: bool) -> None:
        self.overlay.held = held

    def _compare(self, wanted: bool) -> None:
        if wanted:
            self.stored.interpretText()
            self.revolution_wanted.emit(self.stored.value())
        else:
            self.overlay.compare_with(None)


def cycle_page(host: Host) -> QWidget:
    """Make the page of one revolution."""
    panel = host.add("cycle", CyclePanel(host.theme))

    def failed(error: Exception) -> None:
        host.say(tr("No stored revolution: {}", error), False)
        panel.no_revolution()

    panel.revolution_wanted.connect(
        lambda revolution: host.read_revolution(revolution, panel.show_revolution, failed)
    )
    return panel
