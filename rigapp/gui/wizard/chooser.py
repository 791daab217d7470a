"""What shall be calibrated? One question before a wizard opens."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QLabel, QPushButton, QVBoxLayout, QWidget

from rigapp.gui.wizard.parts import larger, named


@dataclass(frozen=True, slots=True)
class Choice:
    """One thing to choose: its name with an access key, how it is done, and the subject it is."""

    text: str
    words: str
    subject: str


CHOICES = {
    "load cell": Choice("&Load cell", "with weights, at several pin angles", "load cell"),
    "1": Choice("Probe &1", "with a micrometer along the follower", "probes"),
    "2": Choice("Probe &2", "with a micrometer across the follower", "probes"),
    "both": Choice(
        "&Both probes", "with a micrometer stage; finds how the probes stand as well", "probes"
    ),
}
"""What is chosen: the subject, or which of several things of it."""


class CalibrationChooser(QDialog):
    """Choose by letter, arrows or mouse; Esc closes."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("calibration_chooser")
        self.setWindowTitle("Calibrate – rigapp")
        self.setModal(False)
        heading = QLabel("What shall be calibrated?")
        larger(heading, 1.4, bold=True)
        column = QVBoxLayout(self)
        column.addWidget(heading)
        self.buttons = {}
        for key, choice in CHOICES.items():
            text = f"{choice.text}: {choice.words}"
            button = QPushButton(text)
            named(button, f"choose_{key.replace(' ', '_')}", text.replace("&", ""))
            button.setMinimumHeight(2 * button.fontMetrics().height())
            button.setStyleSheet("text-align: left; padding-left: 1em; padding-right: 1em;")
            button.clicked.connect(lambda _=False, which=key: self._choose(which))
            column.addWidget(button)
            self.buttons[key] = button
        hint = QLabel(
            "The map of the pin's run-out is taken by a slow roll of the spindle:\n"
            "rigapp calibrate run-out, in the terminal."
        )
        column.addWidget(hint)
        self.buttons["load cell"].setFocus()

    def _choose(self, which: str) -> None:
        self.accept()
        self.chosen.emit(which)
