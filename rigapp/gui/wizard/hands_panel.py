"""Simulated hands: on a simulated rig a calibration can be practised, mistakes included."""

from __future__ import annotations

from PySide6.QtWidgets import QComboBox, QGroupBox, QHBoxLayout, QLabel, QPushButton

from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.parts import named


class HandsPanel(QGroupBox):
    """Do what the step asks, all by itself if wanted, with a mistake if wanted."""

    def __init__(
        self, live: LiveCalibration, name: str = "hands", do: str = "&Do this step"
    ) -> None:
        """Take the calibration; name: of the widgets; do: what the button says."""
        super().__init__("Simulated hands (practice: no waiting times)")
        self._live = live
        named(self, name, "Simulated hands")
        self.do = QPushButton(do)
        named(self.do, f"{name}_do", "Let the simulated hands do this step")
        self.ahead = QPushButton("Go a&head")
        self.ahead.setCheckable(True)
        named(self.ahead, f"{name}_ahead", "Do and record all further steps")
        mistakes = live.practice.mistakes
        self.mistake = QComboBox()
        for mistake in mistakes:
            self.mistake.addItem(str(mistake), mistake)
        named(self.mistake, f"{name}_mistake", "Mistake to practise")
        label = QLabel("&Mistake")
        label.setBuddy(self.mistake)
        row = QHBoxLayout(self)
        row.addWidget(self.do)
        row.addWidget(self.ahead)
        row.addStretch(1)
        row.addWidget(label)
        row.addWidget(self.mistake)
        self.do.clicked.connect(live.lend_a_hand)
        self.ahead.toggled.connect(self._ahead)
        self.mistake.currentIndexChanged.connect(
            lambda _: live.plant(mistakes(self.mistake.currentData()))
        )
        live.looked.connect(self._show)

    def _ahead(self, on: bool) -> None:
        self._live.goes_ahead = on

    def _show(self) -> None:
        if not self.isVisible():
            return
        live = self._live
        self.do.setEnabled(not live.hands_busy and not live.goes_ahead)
        if self.ahead.isChecked() != live.goes_ahead:
            self.ahead.setChecked(live.goes_ahead)
        index = self.mistake.findText(str(live.mistake))
        if index != self.mistake.currentIndex():
            self.mistake.setCurrentIndex(index)
