"""A bar across the window: it tells or asks something below the state and never covers it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QPushButton, QWidget

from rigapp.gui.widgets.build import named, prose, row


class Bar(QFrame):
    """A sentence with buttons beside it, hidden until there is something to say.

    escape: what the key Esc does while the bar is shown, nothing unless it is set.
    """

    def __init__(self, name: str, spoken: str, text_spoken: str = "") -> None:
        super().__init__()
        named(self, f"{name}_bar", spoken)
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.text = prose(f"{name}_text", text_spoken or spoken)
        self.escape: Callable[[], object] | None = None
        self._sheet = ""
        self.hide()

    def lay_out(self, buttons: Sequence[QPushButton]) -> None:
        """Put the buttons beside the sentence."""
        parts: list[QWidget | tuple[QWidget, int]] = [(self.text, 1), *buttons]
        row(*parts, on=self).setContentsMargins(8, 2, 8, 2)

    def say(self, text: str) -> None:
        """Show a sentence; nothing is laid out again when it is the one shown."""
        if text != self.text.text():
            self.text.setText(text)

    def show_when(self, wanted: bool) -> None:
        """Show or hide the bar; nothing is done when it is so already."""
        if self.isHidden() == wanted:
            self.setVisible(wanted)

    def frame_in(self, base: str, edge: str, more: str = "") -> None:
        """Paint the bar on a colour within an edge (CSS: width, style, colour)."""
        sheet = (
            f"#{self.objectName()} {{ background: {base}; border: {edge}; border-radius: 4px; }}"
            f" {more}"
        )
        if sheet != self._sheet:
            self._sheet = sheet
            self.setStyleSheet(sheet)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc leaves the bar."""
        if event.key() == Qt.Key.Key_Escape and self.escape is not None:
            self.escape()
        else:
            super().keyPressEvent(event)
