"""What shall be calibrated? One question before a wizard opens."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QLabel, QVBoxLayout, QWidget

from rigapp.gui.widgets.build import button, filled
from rigapp.gui.widgets.labels import scaled_font
from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, tr


@dataclass(frozen=True, slots=True)
class Choice:
    """One thing to choose: its name with an access key, how it is done, and the subject it is.

    what: how it is named where it occupies the rig. fields: what the first page says at the
    beginning, by the name of its field.
    """

    text: Text
    words: Text
    what: Text
    subject: str
    fields: Mapping[str, str] = field(default_factory=dict)


CHOICES = {
    "load cell": Choice(
        "&Load cell", "with weights, at several pin angles", "load cell", "load cell"
    ),
    "daily": Choice(
        "&Daily check",
        "of the load cell, one weight at 4 pin angles",
        "daily check",
        "load cell",
        {"plan": "daily"},
    ),
    "1": Choice(
        "&Probe 1", "with a micrometer along the follower", "probe 1", "probes", {"which": "1"}
    ),
    "2": Choice(
        "Prob&e 2", "with a micrometer across the follower", "probe 2", "probes", {"which": "2"}
    ),
    "both": Choice(
        "&Both probes",
        "with a micrometer stage; finds how the probes stand as well",
        "both probes",
        "probes",
        {"which": "both"},
    ),
    "run-out": Choice(
        "&Run-out of the pin", "by slow rolls of the spindle", "run-out of the pin", "run-out"
    ),
}
"""What is chosen: the subject, or which of several things of it."""

WIDEST = 80 * STEP
"""Of a button: longer ones are read as lines, not pressed."""


class CalibrationChooser(QDialog):
    """Choose by letter, arrows or mouse; Esc closes."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("calibration_chooser")
        self.setWindowTitle(tr("Calibrate – rigapp"))
        self.setModal(False)
        heading = QLabel(tr("What shall be calibrated?"))
        heading.setFont(scaled_font(heading, 1.4, bold=True))
        self.buttons = {}
        for key, choice in CHOICES.items():
            text = f"{tr(choice.text)}\n{tr(choice.words)}"
            made = button(f"choose_{key.replace(' ', '_')}", text, partial(self._choose, key))
            made.setMaximumWidth(WIDEST)
            made.setStyleSheet(f"text-align: left; min-height: {6 * STEP}px;")
            self.buttons[key] = made
        whole = filled(QVBoxLayout(self), (heading, *self.buttons.values(), None))
        whole.setSpacing(GAP)
        self.setFocusProxy(self.buttons["load cell"])

    def _choose(self, which: str) -> None:
        self.accept()
        self.chosen.emit(which)
