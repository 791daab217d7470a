"""The panel of one revolution: overlay, hold, any stored revolution, numbers, vector, probes."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QLabel,
    QPushButton,
    QSpinBox,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rigapp.gui.data.comparison import RevolutionCurves, statistics
from rigapp.gui.data.frames import COMPONENT_NAMES, ForceFrame
from rigapp.gui.data.recording import StoredRevolution
from rigapp.gui.data.series import LiveData
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.palette import CHECKED, Theme
from rigapp.gui.plots.polar import PolarPanel
from rigapp.gui.plots.probes import ProbePanel

HEADINGS = tuple(
    f"{statistic}\n{kind}"
    for statistic in ("max", "min", "RMS")
    for kind in ("meas.", "model", "diff.")
)


class ValueTable(QTableWidget):
    """Repeat in numbers what the overlay shows, for eyes, ears and the clipboard."""

    def __init__(self, prefix: str) -> None:
        super().__init__(3, len(HEADINGS))
        self.setObjectName(f"{prefix}_values")
        self.setAccessibleName("Statistics of the revolution shown, in N")
        self.setHorizontalHeaderLabels(list(HEADINGS))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        for row in range(3):
            for column in range(len(HEADINGS)):
                item = QTableWidgetItem("–")
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                self.setItem(row, column, item)
        self._fit()

    def show_values(self, shown: RevolutionCurves | None, frame: ForceFrame) -> None:
        """Fill the table, with dashes when nothing is shown."""
        first, second = COMPONENT_NAMES[frame]
        self.setVerticalHeaderLabels(["|F| (N)", f"{first} (N)", f"{second} (N)"])
        unknown = [float("nan")] * len(HEADINGS)
        table = [unknown] * 3 if shown is None else [values for _, values in statistics(shown)]
        for row, values in enumerate(table):
            for column, value in enumerate(values):
                sign = "+" if column % 3 == 2 else ""
                text = "–" if value != value else f"{value:{sign}.2f}"
                item = self.item(row, column)
                if item is not None and item.text() != text:
                    item.setText(text)

    def _fit(self) -> None:
        height = self.horizontalHeader().sizeHint().height() + 4
        height += sum(self.sizeHintForRow(row) for row in range(3)) + 6
        self.setFixedHeight(height)


class CyclePanel(QSplitter):
    """Hold the overlay with its tools on the left, vector and probes on the right."""

    revolution_wanted = Signal(int)

    def __init__(self, theme: Theme) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self.setObjectName("cycle_split")
        self.setAccessibleName("One revolution")
        self.setChildrenCollapsible(False)
        self.overlay = OverlayPanel("cycle", theme)
        self.values = ValueTable("cycle")
        self.polar = PolarPanel("cycle", theme)
        self.probes = ProbePanel("cycle", theme)
        self._valued: RevolutionCurves | None = None
        self._add_tools()
        left = QWidget()
        column = QVBoxLayout(left)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.overlay, 1)
        column.addWidget(self.values)
        self.right = QSplitter(Qt.Orientation.Vertical)
        self.right.setObjectName("cycle_right")
        self.right.setAccessibleName("Vector and probes")
        self.right.setChildrenCollapsible(False)
        self.right.addWidget(self.polar)
        self.right.addWidget(self.probes)
        self.addWidget(left)
        self.addWidget(self.right)
        self.setSizes([860, 500])

    def _add_tools(self) -> None:
        self.hold = QPushButton("&Hold")
        self.hold.setObjectName("cycle_hold")
        self.hold.setAccessibleName("Hold the picture")
        self.hold.setCheckable(True)
        self.hold.setStyleSheet(CHECKED)
        self.hold.toggled.connect(self._held)
        self.stored = QSpinBox()
        self.stored.setObjectName("cycle_stored")
        self.stored.setAccessibleName("Stored revolution to compare with")
        self.stored.setRange(1, 1_000_000_000)
        caption = QLabel("Stored revol&ution")
        caption.setBuddy(self.stored)
        self.show_stored = QPushButton("Compare")
        self.show_stored.setObjectName("cycle_compare")
        self.show_stored.setAccessibleName("Compare with the stored revolution")
        self.show_stored.setCheckable(True)
        self.show_stored.setStyleSheet(CHECKED)
        self.show_stored.toggled.connect(self._compare)
        for widget in (self.hold, caption, self.stored, self.show_stored):
            self.overlay.tools.addWidget(widget)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        for panel in (self.overlay, self.polar, self.probes):
            panel.dress(theme)

    def show_newest(self, data: LiveData, *, stale: bool) -> None:
        """Draw the newest revolution."""
        self.overlay.refresh(data, stale=stale)
        shown = self.overlay.shown
        if shown is not self._valued:
            self._valued = shown
            self.values.show_values(shown, self.overlay.frame)
            self.polar.refresh(shown, self.overlay.frame)
        if not self.overlay.held:
            self.probes.refresh(data)

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
