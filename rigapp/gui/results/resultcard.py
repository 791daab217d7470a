"""A card with the outcome of a test, its results, and their validity."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.widgets.build import column, named, prose, row, signed
from rigapp.gui.widgets.labels import ElidedLabel, FittedLabel
from rigapp.gui.widgets.reflow import WrappingGrid
from rigapp.presentation.results import (
    KeyNumber,
    TrustLine,
    file_line,
    key_numbers,
    origin_of,
    outcome_text,
    reason_of,
    trust_lines,
)
from rigapp.presentation.tokens import BODY_PT, CAPTION_PT, GAP, MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import HowEnded
from rigapp.schema.results import TestResult

SHAPES = {
    HowEnded.COMPLETE: Icon.COMPLETE,
    HowEnded.OPERATOR: Icon.ENDED,
    HowEnded.TRIPPED: Icon.TRIPPED,
    HowEnded.FAULT: Icon.CRITICAL,
    HowEnded.INTERRUPTED: Icon.WARNING,
    HowEnded.RUNNING: Icon.START,
    HowEnded.NOT_READABLE: Icon.UNREADABLE,
}
"""Shape of each outcome, distinguishable without colour."""

FAILED = frozenset({HowEnded.TRIPPED, HowEnded.FAULT})
MOST_TRUST = 6
SHAPE = QSize(6 * STEP, 6 * STEP)
NUMBER_WIDTH = 17 * STEP
"""Minimum width of a number with its texts."""
SMALL = QSize(2 * STEP, 2 * STEP)


def colour_of(outcome: HowEnded, theme: Theme) -> str:
    """Return the colour of an outcome: ink, except for failures."""
    if outcome in FAILED:
        return theme.critical
    return theme.warning_text if outcome is HowEnded.INTERRUPTED else theme.text


class NumberTile(QWidget):
    """A caption, a number, and a line about its basis."""

    def __init__(self, name: str, number: int) -> None:
        super().__init__()
        named(self, f"{name}_number_{number}", "Number of the result")
        small = sized(self.font(), CAPTION_PT)
        self.caption = prose(f"{name}_caption_{number}", "What the number is")
        bold = sized(self.font(), VALUE_PT, QFont.Weight.DemiBold)
        self.value = FittedLabel(f"{name}_value_{number}", "Value", bold)
        self.line = prose(f"{name}_line_{number}", "Basis of the result")
        for label in (self.caption, self.line):
            label.setFont(small)
            label.setProperty("role", "caption")
        column(self.caption, self.value, self.line, on=self)

    def show_number(self, number: KeyNumber) -> None:
        """Show a number."""
        self.caption.setText(tr(number.caption))
        self.value.show_text(number.value)
        self.line.setText(tr(number.line))
        self.setAccessibleDescription(f"{number.caption}: {number.value}, {number.line}")


class TrustRow(QWidget):
    """A tick or a warning sign, its subject, and its state."""

    def __init__(self, name: str, number: int) -> None:
        super().__init__()
        named(self, f"{name}_trust_{number}", "Whether the result can be trusted")
        self.text = prose(f"{name}_trust_text_{number}", "What was checked")
        self.line = prose(f"{name}_trust_line_{number}", "State")
        self.sign = signed(SMALL, self.text, self.line, self)

    def show_line(self, line: TrustLine, theme: Theme) -> None:
        """Show a line."""
        self.text.setText(tr(line.text))
        self.line.setText(tr(line.line))
        sign = icon(
            Icon.FINE if line.good else Icon.WARNING,
            theme.secondary if line.good else theme.warning_text,
        )
        self.sign.setPixmap(sign.pixmap(SMALL))
        self.sign.setAccessibleName(tr("good") if line.good else tr("attention"))


class ResultCard(QFrame):
    """Show one result; across: number of columns of figures."""

    def __init__(self, name: str, theme: Theme, across: int) -> None:
        super().__init__()
        self._theme = theme
        self.result: TestResult | None = None
        named(self, name, "Result of the test", role="card")
        self.shape = named(QLabel(), f"{name}_shape", "How the test ended")
        self.shape.setFixedSize(SHAPE)
        self.headline = FittedLabel(
            f"{name}_headline",
            "How the test ended",
            sized(self.font(), VALUE_PT, QFont.Weight.DemiBold),
        )
        self.reason = prose(f"{name}_reason", "Why the test ended")
        self.origin = prose(f"{name}_origin", "Specimen, cycles and times", role="caption")
        self.numbers = [NumberTile(name, number) for number in range(4)]
        self.trust = [TrustRow(name, number) for number in range(MOST_TRUST)]
        self.file = ElidedLabel(f"{name}_file", "File of the test")
        self.file.setFont(sized(self.font(), BODY_PT, QFont.Weight.DemiBold))
        self.about = prose(f"{name}_about", "What the file holds", role="caption")
        self._body = QWidget()
        self._lay_out(across)
        self.show_result(None, "")

    def _lay_out(self, across: int) -> None:
        words = column(self.headline, self.reason, self.origin, spacing=STEP // 2)
        head = row((self.shape, 0), (words, 1), spacing=MARGIN)
        head.setAlignment(self.shape, Qt.AlignmentFlag.AlignTop)
        grid = WrappingGrid(NUMBER_WIDTH, across)
        trust = WrappingGrid(NUMBER_WIDTH, across if across > 2 else 1)
        for layout, parts in ((grid, self.numbers), (trust, self.trust)):
            for part in parts:
                layout.addWidget(part)
        column(grid, trust, column(self.file, self.about), on=self._body, spacing=GAP)
        column(head, self._body, on=self, margins=(MARGIN, MARGIN, MARGIN, GAP), spacing=MARGIN)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self.show_result(self.result, self.reason.text())

    def show_result(self, result: TestResult | None, waiting: Text) -> None:
        """Show a result, or a sentence while there is none."""
        self.result = result
        self._body.setVisible(result is not None)
        self.shape.setVisible(result is not None)
        self.origin.setVisible(result is not None)
        if result is None:
            self.headline.show_text("")
            self.headline.setVisible(False)
            self.reason.setText(tr(waiting))
            self._frame(critical=False)
            return
        outcome = result.outcome
        self.headline.setVisible(True)
        self.headline.show_text(outcome_text(result))
        self.headline.setStyleSheet(f"color: {colour_of(outcome, self._theme)};")
        shape = icon(SHAPES[outcome], colour_of(outcome, self._theme))
        self.shape.setPixmap(shape.pixmap(SHAPE))
        self.shape.setAccessibleDescription(tr(outcome.value))
        self.reason.setText(reason_of(result))
        self.origin.setText(origin_of(result))
        for tile, number in zip(self.numbers, key_numbers(result), strict=True):
            tile.show_number(number)
        lines = list(trust_lines(result))[: len(self.trust)]
        for index, line in enumerate(self.trust):
            line.setVisible(index < len(lines))
            if index < len(lines):
                line.show_line(lines[index], self._theme)
        self.file.show_text(Path(result.path).name)
        self.file.setToolTip(result.path)
        self.about.setText(tr(file_line(result)))
        self._frame(critical=outcome in FAILED)

    def _frame(self, *, critical: bool) -> None:
        sheet = ""
        if critical:
            sheet = f"#{self.objectName()} {{ border: 2px solid {self._theme.critical}; }}"
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)
