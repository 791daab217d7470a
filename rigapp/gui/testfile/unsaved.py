"""Ask what becomes of changes that are not saved, by their names."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QSizePolicy

NAMED = 4
"""Changes named one by one; of more, the number is told."""


class UnsavedBar(QFrame):
    """Name the changes; save them, discard them, or go on editing, which is the default."""

    def __init__(self, save: Callable[[], bool]) -> None:
        super().__init__()
        self._save = save
        self._then: Callable[[], None] | None = None
        self.setObjectName("unsaved_bar")
        self.setAccessibleName("Changes that are not saved")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.text = QLabel()
        self.text.setObjectName("unsaved_text")
        self.text.setAccessibleName("Changes that would be lost")
        self.text.setWordWrap(True)
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        self.save = self._button("unsaved_save", "Save", self._save_first)
        self.discard = self._button("unsaved_discard", "Discard", self._go_on)
        self.stay = self._button("unsaved_stay", "Go on editing", self.put_away)
        row = QHBoxLayout(self)
        row.addWidget(self.text, 1)
        for button in (self.save, self.discard, self.stay):
            row.addWidget(button)
        self.hide()

    def _button(self, name: str, text: str, call: Callable[[], None]) -> QPushButton:
        button = QPushButton(text)
        button.setObjectName(name)
        button.setAccessibleName(text)
        button.clicked.connect(call)
        return button

    def ask(self, changes: Sequence[str], what: str, then: Callable[[], None]) -> None:
        """Ask before ``what`` is done; ``then`` does it, after saving or discarding."""
        self._then = then
        self.text.setText(f"Not saved before {what}: {named(changes)}")
        count = f"{len(changes)} change" + ("s" if len(changes) > 1 else "")
        self.discard.setText(f"Discard {count}")
        self.discard.setAccessibleName(f"Discard {count}")
        self.show()
        self.stay.setFocus(Qt.FocusReason.OtherFocusReason)

    def put_away(self) -> None:
        """Go on editing."""
        self._then = None
        self.hide()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc goes on editing."""
        if event.key() == Qt.Key.Key_Escape:
            self.put_away()
        else:
            super().keyPressEvent(event)

    def _save_first(self) -> None:
        if self._save():
            self._go_on()

    def _go_on(self) -> None:
        then = self._then
        self.put_away()
        if then is not None:
            then()


def named(changes: Sequence[str]) -> str:
    """Return changes in one sentence."""
    text = "; ".join(changes[:NAMED])
    more = len(changes) - NAMED
    return f"{text}; and {more} more." if more > 0 else f"{text}."
