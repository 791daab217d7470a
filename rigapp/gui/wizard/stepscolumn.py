"""The steps of a calibration at the left of its page: done, now, later."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QFrame

from rigapp.gui.widgets.build import column, named, prose
from rigapp.gui.widgets.steps import ShownStep, StepRow
from rigapp.presentation.tokens import MARGIN, STEP, Theme
from rigapp.presentation.translation import Text

WIDTH = 26 * STEP


class StepsColumn(QFrame):
    """What is calibrated, its steps, and that nothing is lost by closing."""

    def __init__(self, title: str, count: int, theme: Theme) -> None:
        """Make the column; title: what is calibrated, count: of the steps."""
        super().__init__()
        named(self, "wizard_steps", "Steps of the calibration").setProperty("role", "card")
        self._theme = theme
        self.setFixedWidth(WIDTH)
        what = prose("wizard_what", "What is calibrated")
        what.setText(title)
        what.setProperty("role", "title")
        self.rows = [StepRow("wizard", number) for number in range(count)]
        kept: Text = "Every reading is saved as it is taken. You may close and go on tomorrow."
        note = prose("wizard_kept", "What is kept", kept)
        note.setProperty("role", "caption")
        made = column(what, *self.rows, None, note, on=self)
        made.setContentsMargins(MARGIN, MARGIN, MARGIN, MARGIN)
        made.setSpacing(2 * STEP)
        self._shown: tuple[ShownStep, ...] = ()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.show_steps(self._shown)

    def show_steps(self, steps: Sequence[ShownStep]) -> None:
        """Show the steps."""
        self._shown = tuple(steps)
        for line, step in zip(self.rows, steps, strict=False):
            line.show_step(step, self._theme)
