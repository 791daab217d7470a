"""Show what must be right before a test starts: one line each, with what to do."""

from __future__ import annotations

from PySide6.QtWidgets import QGroupBox, QVBoxLayout

from rigapp.gui.look.tokens import Theme
from rigapp.gui.widgets.build import named
from rigapp.gui.widgets.tables import Mark, PlainTable
from rigapp.service.preflight import Check, Checked

MARKS = {Checked.GOOD: "✓", Checked.ATTENTION: "▲", Checked.BLOCKS: "◆"}
HEADINGS = ("", "Check", "Finding", "What to do")


class PreflightPanel(QGroupBox):
    """Show the checks."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("Before the start")
        self._theme = theme
        self.shown: list[Check] = []
        named(self, "preflight_panel", "Checks before the start")
        self.table = PlainTable(
            "preflight_table", "List of checks", HEADINGS, marked=0, stretch=(2, 3)
        )
        self.table.setSelectionMode(PlainTable.SelectionMode.NoSelection)
        QVBoxLayout(self).addWidget(self.table)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.show_checks(self.shown)

    def show_checks(self, checks: list[Check]) -> None:
        """Fill the table."""
        self.shown = checks
        rows = [
            (f"{MARKS[one.verdict]} {one.verdict}", one.what, one.finding, one.action)
            for one in checks
        ]
        self.table.show_rows(rows, [self._mark(one.verdict) for one in checks])

    def _mark(self, verdict: Checked) -> Mark:
        if verdict is Checked.GOOD:
            return None
        return self._theme.mark(critical=verdict is Checked.BLOCKS)
