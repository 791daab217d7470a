"""A bar in the message line: a non-modal statement or question."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QPushButton

from rigapp.gui.widgets.build import named, prose
from rigapp.gui.widgets.details import details_button
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import GAP, MARGIN, STEP
from rigapp.presentation.translation import Text, tr

TEXT_WIDTH = 34 * STEP
"""Minimum width of the sentence beside the buttons; with less room they are below it."""


class Bar(QFrame):
    """A sentence with buttons beside it, hidden until there is one.

    escape: called by the key Esc while the bar is shown, if set.
    """

    def __init__(self, name: str, spoken: Text, text_spoken: Text = "") -> None:
        super().__init__()
        named(self, f"{name}_bar", spoken)
        self.text = prose(f"{name}_text", text_spoken or spoken)
        self.more = details_button(name, lambda _: self._update_text())
        self._sentence = self._details = ""
        self.escape: Callable[[], object] | None = None
        self._sheet = ""
        self.hide()

    def lay_out(self, buttons: Sequence[QPushButton]) -> None:
        """Place the buttons beside the sentence."""
        self.text.setMinimumWidth(TEXT_WIDTH)
        flowing((self.text, 1), self.more, *buttons, on=self).setContentsMargins(MARGIN, 0, GAP, 0)

    def say(self, text: Text, details: str = "") -> None:
        """Show a sentence; the layout is kept when it is unchanged.

        details: replace the sentence while their button is down, so that the bar keeps its height.
        """
        if details != self._details:
            self._details = details
            self.more.setChecked(False)
            self.more.setVisible(bool(details))
        self._sentence = tr(text)
        self._update_text()

    def _update_text(self) -> None:
        text = self._details if self.more.isChecked() else self._sentence
        if text != self.text.text():
            self.text.setText(text)

    def show_when(self, wanted: bool) -> None:
        """Show or hide the bar, if that changes anything."""
        if self.isHidden() == wanted:
            self.setVisible(wanted)

    def paint(self, base: str, ink: str, more: str = "") -> None:
        """Set the colours of background and sentence; more: further rules of the style sheet."""
        name = self.objectName()
        sheet = f"#{name} {{ background: {base}; }} #{self.text.objectName()} {{ color: {ink}; }}"
        sheet = f"{sheet} {more}"
        if sheet != self._sheet:
            self._sheet = sheet
            self.setStyleSheet(sheet)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Call ``escape`` by Esc."""
        if event.key() == Qt.Key.Key_Escape and self.escape is not None:
            self.escape()
        else:
            super().keyPressEvent(event)
