"""Show what must be right before a test starts: one line each, with what to do."""

from __future__ import annotations

from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QGroupBox,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
)

from rigapp.gui.plots.palette import Theme
from rigapp.service.preflight import Check, Verdict

MARKS = {Verdict.GOOD: "✓", Verdict.ATTENTION: "▲", Verdict.BLOCKS: "◆"}
HEADINGS = ("", "Check", "Finding", "What to do")


class PreflightPanel(QGroupBox):
    """Show the checks."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("Before the start")
        self._theme = theme
        self._shown: list[Check] = []
        self.setObjectName("preflight_panel")
        self.setAccessibleName("Checks before the start")
        self.table = QTableWidget(0, len(HEADINGS))
        self.table.setObjectName("preflight_table")
        self.table.setAccessibleName("List of checks")
        self.table.setHorizontalHeaderLabels(list(HEADINGS))
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.table.setTabKeyNavigation(False)
        self.table.setWordWrap(True)
        self.table.verticalHeader().hide()
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(3, QHeaderView.ResizeMode.Stretch)
        column = QVBoxLayout(self)
        column.addWidget(self.table)

    @property
    def shown(self) -> list[Check]:
        """Return what is shown."""
        return self._shown

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        shown, self._shown = self._shown, []
        self.show_checks(shown)

    def show_checks(self, checks: list[Check]) -> None:
        """Fill the table; nothing is done when nothing changed."""
        if checks == self._shown:
            return
        self._shown = checks
        self.table.setRowCount(len(checks))
        theme = self._theme
        backs = {Verdict.ATTENTION: theme.warning, Verdict.BLOCKS: theme.critical}
        for row, check in enumerate(checks):
            texts = (
                f"{MARKS[check.verdict]} {check.verdict}",
                check.what,
                check.finding,
                check.action,
            )
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                item.setToolTip(text)
                if column == 0 and check.verdict in backs:
                    item.setBackground(QBrush(QColor(backs[check.verdict])))
                    dark_back = check.verdict is Verdict.BLOCKS and theme.name == "light"
                    item.setForeground(QBrush(QColor("#ffffff" if dark_back else "#000000")))
                self.table.setItem(row, column, item)
        self.table.resizeRowsToContents()
