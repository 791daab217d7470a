"""Folded details of a text: a message of a library, a register, an address."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton, QWidget

from rigapp.gui.widgets.build import Called, button, column, prose, row


def details_button(name: str, unfolded: Called) -> QPushButton:
    """Return the button that unfolds details, hidden until there are any."""
    more = button(f"{name}_more", "Details", unfolded, checkable=True, rank="quiet")
    more.hide()
    return more


class FoldedDetails(QWidget):
    """Details below their text; hidden while there are none."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.details = prose(f"{name}_details", "Details", role="caption")
        self.details.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.details.hide()
        self.more = details_button(name, self.details.setVisible)
        column(row(self.more, None), self.details, on=self, margins=0)
        self.hide()

    def show_details(self, details: str) -> None:
        """Set the details, folded where they are new; without details nothing is shown."""
        if details != self.details.text():
            self.details.setText(details)
            self.more.setChecked(False)
        self.more.setVisible(bool(details))
        self.setVisible(bool(details))
