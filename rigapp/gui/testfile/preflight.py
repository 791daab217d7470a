"""Show what must be right before a test starts: one card each, what blocks first."""

from __future__ import annotations

from collections import Counter

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.checks.check import Check, CheckVerdict
from rigapp.gui.widgets.build import column, named, prose, row, scrolling, tell
from rigapp.gui.widgets.details import FoldedDetails
from rigapp.presentation.tokens import GAP, MARGIN, STEP
from rigapp.presentation.translation import marked, tr, translate
from rigapp.schema.details import details_of

MARKS = {CheckVerdict.GOOD: "✓", CheckVerdict.ATTENTION: "▲", CheckVerdict.BLOCKS: "◆"}
ROLES = {
    CheckVerdict.GOOD: "",
    CheckVerdict.ATTENTION: "attention",
    CheckVerdict.BLOCKS: "critical",
}
ORDER = (CheckVerdict.BLOCKS, CheckVerdict.ATTENTION, CheckVerdict.GOOD)


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
        texts = column(self.what, self.finding, self.action, self.details, spacing=0)
        made = row(self.mark, (texts, 1), on=self, margins=(STEP, STEP // 2))
        made.setAlignment(self.mark, Qt.AlignmentFlag.AlignTop)

    def show_check(self, check: Check) -> None:
        """Show a check."""
        good = check.verdict is CheckVerdict.GOOD
        tell(self, "role", ROLES[check.verdict])
        self.mark.setText(MARKS[check.verdict])
        what, finding, action = map(translate, (check.name, check.sentence, check.advice))
        verdict = tr(check.verdict.value)
        self.what.setText(what if good else f"{what}: {verdict}")
        self.finding.setText(finding)
        self.details.show_details(details_of(check.sentence))
        self.action.setText(action)
        self.action.setVisible(bool(action))
        self.setAccessibleName(f"{what}: {verdict}, {finding} {action}")


class PreflightPanel(QFrame):
    """Show the checks."""

    def __init__(self) -> None:
        super().__init__()
        self.shown: list[Check] = []
        self.rows: list[CheckRow] = []
        named(self, "preflight_panel", "Checks before the start", role="card")
        self.title = named(
            QLabel(tr("Before the start")), "preflight_title", "Before the start", role="title"
        )
        self.count = prose("preflight_count", "How many checks are good", role="caption")
        inside = QWidget()
        self._list = column(None, on=inside, spacing=STEP // 2)
        area = scrolling("preflight_area", "List of checks", inside)
        column(
            self.title,
            self.count,
            (area, 1),
            on=self,
            margins=(GAP, MARGIN, STEP, GAP),
            spacing=STEP // 2,
        )

    @property
    def words(self) -> str:
        """Return how many checks are of which sort."""
        count = Counter(one.verdict for one in self.shown)
        numbers = (
            count[one] for one in (CheckVerdict.GOOD, CheckVerdict.ATTENTION, CheckVerdict.BLOCKS)
        )
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
