"""A row for one of several steps: done, now or later, as sign and text."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QWidget

from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.widgets.build import named, signed
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.presentation.tokens import STEP, Theme
from rigapp.presentation.translation import Text, marked, tr

SIGN = QSize(2 * STEP + 4, 2 * STEP + 4)


@dataclass(frozen=True, slots=True)
class ShownStep:
    """One step: name, state as text, and whether it is done or in progress."""

    name: Text
    line: Text
    done: bool = False
    now: bool = False


class StepRow(QWidget):
    """A sign for done, now or later, the step, and its state."""

    def __init__(self, prefix: str, number: int) -> None:
        super().__init__()
        named(self, f"{prefix}_step_{number}", "Step")
        self._shown: tuple[ShownStep, str] | None = None
        self.name = ElidedLabel(f"{prefix}_name_{number}", "Step")
        self.line = ElidedLabel(f"{prefix}_line_{number}", "State")
        self.sign = signed(SIGN, self.name, self.line, self)

    def show_step(self, step: ShownStep, theme: Theme) -> None:
        """Show a step; an unchanged one is not redrawn."""
        if (step, theme.name) == self._shown:
            return
        self._shown = step, theme.name
        meaning, colour, word = Icon.LATER, theme.muted, marked("later")
        if step.done:
            meaning, colour, word = Icon.COMPLETE, theme.secondary, marked("done")
        elif step.now:
            meaning, colour, word = Icon.NOW, theme.highlight, marked("now")
        self.sign.setPixmap(icon(meaning, colour).pixmap(SIGN))
        self.name.show_text(tr(step.name))
        self.line.show_text(tr(step.line))
        self.line.setVisible(bool(step.line))
        self.setAccessibleDescription(f"{tr(step.name)}: {tr(word)}, {tr(step.line)}")
