"""Show what must be right before a test starts: one card each, what blocks first."""

from __future__ import annotations

from collections import Counter

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.gui.look.tokens import GAP, MARGIN, STEP
from rigapp.gui.widgets.build import column, named, prose, row, scrolling, tell
from rigapp.gui.widgets.details import FoldedDetails
from rigapp.presentation.told import retold
from rigapp.presentation.translation import marked, tr
from rigapp.schema.details import details_of
from rigapp.service.preflight import Check, Checked

MARKS = {Checked.GOOD: "✓", Checked.ATTENTION: "▲", Checked.BLOCKS: "◆"}
ROLES = {Checked.GOOD: "", Checked.ATTENTION: "attention", Checked.BLOCKS: "critical"}
ORDER = (Checked.BLOCKS, Checked.ATTENTION, Checked.GOOD)


class CheckRow(QFrame):
    """One check: its mark, what it is about, what was found and what to do."""

    def __init__(self, place: int) -> None:
        super().__init__()
        named(self, f"check_{place}", "Check")
        self.mark = QLabel()
        self.mark.setFixedWidth(2 * STEP)
        self.what, self.finding, self.action = (
            prose(f"check_{place}_{name}", spoken)
            for name, spoken in (
                ("what", "Check"),
                ("finding", marked("What was found")),
                ("action", marked("What to do")),
            )
        )
        self.what.setProperty("role", "title")
        self.finding.setProperty("role", "caption")
        self.details = FoldedDetails(f"check_{place}")
        texts = column(self.what, self.finding, self.action, self.details)
        texts.setSpacing(0)
        made = row(self.mark, (texts, 1), on=self)
        made.setAlignment(self.mark, Qt.AlignmentFlag.AlignTop)
        made.setContentsMargins(STEP, STEP // 2, STEP, STEP // 2)

    def show_check(self, check: Check) -> None:
        """Show a check."""
        good = check.verdict is Checked.GOOD
        tell(self, "role", ROLES[check.verdict])
        self.mark.setText(MARKS[check.verdict])
        what, finding, action = map(retold, (check.what, check.finding, check.action))
        verdict = tr(check.verdict.value)
        self.what.setText(what if good else f"{what}: {verdict}")
        self.finding.setText(finding)
        self.details.show_details(details_of(check.finding))
        self.action.setText(action)
        self.action.setVisible(bool(action))
        self.setAccessibleName(f"{what}: {verdict}, {finding} {action}")


class PreflightPanel(QFrame):
    """Show the checks."""

    def __init__(self) -> None:
        super().__init__()
        self.shown: list[Check] = []
        self.rows: list[CheckRow] = []
        named(self, "preflight_panel", "Checks before the start").setProperty("role", "card")
        self.title = named(QLabel(tr("Before the start")), "preflight_title", "Before the start")
        self.title.setProperty("role", "title")
        self.count = prose("preflight_count", "How many checks are good")
        self.count.setProperty("role", "caption")
        inside = QWidget()
        self._list = column(None, on=inside)
        self._list.setSpacing(STEP // 2)
        area = scrolling("preflight_area", "List of checks", inside)
        made = column(self.title, self.count, (area, 1), on=self)
        made.setContentsMargins(GAP, MARGIN, STEP, GAP)
        made.setSpacing(STEP // 2)

    @property
    def words(self) -> str:
        """Return how many checks are of which sort."""
        count = Counter(one.verdict for one in self.shown)
        numbers = (count[one] for one in (Checked.GOOD, Checked.ATTENTION, Checked.BLOCKS))
        return tr("{} good, {} for attention, {} block", *numbers)

    def show_checks(self, checks: list[Check]) -> None:
        """Show the checks, what blocks first."""
        ordered = sorted(checks, key=lambda one: ORDER.index(one.verdict))
        if ordered == self.shown:
            return
        self.shown = ordered
        self.count.setText(self.words)
        while len(self.rows) < len(ordered):
            self.rows.append(CheckRow(len(self.rows) + 1))
            self._list.insertWidget(len(self.rows) - 1, self.rows[-1])
        for line, check in zip(self.rows, ordered, strict=False):
            line.show_check(check)
        for place, line in enumerate(self.rows):
            line.setVisible(place < len(ordered))
