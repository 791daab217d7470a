"""Give the operator a PIN, where the rig file wants one for what changes limits."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QLineEdit, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.names import login_name
from rigapp.gui.look.preferences import Preference, Preferences
from rigapp.gui.widgets.build import button, column, edit, named, prose
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.details import error_text
from rigapp.service.pins import operators_file, pins_in, set_pin

NO_PINS: Final[Text] = (
    "This rig wants no PIN for limits. To want one, add [operators] with a file to the rig file."
)
FIRST: Final[Text] = "Nobody has a PIN yet: nobody can change limits of a running test."
HAVE: Final[Text] = "Have a PIN and may change limits: {}."


class PinPart(QWidget):
    """Say who has a PIN, and set that of the operator whom the settings name."""

    def __init__(self, rig: Path | None, choices: Preferences) -> None:
        super().__init__()
        self._rig, self._choices = rig, choices
        self._file: Path | None = None
        named(self, "pins", "PINs for limits")
        self.told = prose("pins_told", "Who has a PIN", role="caption")
        self.pin = edit("pin_new", "New PIN of the operator", self._enable, hint="New PIN")
        self.by_pin = edit("pin_present", "PIN of somebody who has one", hint="A present PIN")
        for field in (self.pin, self.by_pin):
            field.setEchoMode(QLineEdit.EchoMode.Password)
        self.set = button("pin_set", "Set PIN", self._set, "Set the PIN of the operator")
        self._fields = QWidget()
        flowing((self.pin, 1), (self.by_pin, 1), self.set, on=self._fields)
        column(self.told, self._fields, on=self, spacing=STEP)
        self._enable()

    def showEvent(self, event: QShowEvent) -> None:
        """Look who has a PIN now."""
        super().showEvent(event)
        self.look()

    def look(self) -> None:
        """Read the file of the operators, where the rig file names one."""
        try:
            self._file = operators_file(read_rig(self._rig)) if self._rig is not None else None
            names = list(pins_in(self._file)) if self._file is not None else []
        except UnusableInput as error:
            self._fields.hide()
            self.told.setText(translate(error_text(error, "The operators cannot be read.")))
            return
        self._fields.setVisible(self._file is not None)
        self.by_pin.setVisible(bool(names))
        if self._file is None:
            self.told.setText(tr(NO_PINS))
        else:
            self.told.setText(tr(HAVE, ", ".join(names)) if names else tr(FIRST))

    def _enable(self) -> None:
        self.set.setEnabled(bool(self.pin.text()))

    def _set(self) -> None:
        name = self._choices.get(Preference.OPERATOR) or login_name()
        assert self._file is not None
        try:
            set_pin(self._file, name, self.pin.text(), self.by_pin.text())
        except UnusableInput as error:
            self.told.setText(translate(error_text(error, "The PIN cannot be set.")))
            return
        finally:
            self.by_pin.clear()
        self.pin.clear()
        self.look()
