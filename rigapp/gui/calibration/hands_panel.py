"""Simulated hands: on a simulated rig a calibration can be practised, mistakes included."""

from __future__ import annotations

from PySide6.QtWidgets import QComboBox, QGroupBox, QHBoxLayout, QLabel, QPushButton

from rigapp.commands.practice import Mistake
from rigapp.gui.calibration.bench import Bench
from rigapp.gui.calibration.parts import named


class HandsPanel(QGroupBox):
    """Do what the step asks, all by itself if wanted, with a mistake if wanted."""

    def __init__(self, bench: Bench) -> None:
        super().__init__("Simulated hands (practice: no waiting times)")
        self._bench = bench
        named(self, "hands", "Simulated hands")
        self.do = QPushButton("&Do this step")
        named(self.do, "hands_do", "Let the simulated hands do this step")
        self.ahead = QPushButton("Go a&head")
        self.ahead.setCheckable(True)
        named(self.ahead, "hands_ahead", "Do and record all further steps")
        self.mistake = QComboBox()
        for mistake in Mistake:
            self.mistake.addItem(str(mistake), mistake)
        named(self.mistake, "hands_mistake", "Mistake to practise")
        label = QLabel("&Mistake")
        label.setBuddy(self.mistake)
        row = QHBoxLayout(self)
        row.addWidget(self.do)
        row.addWidget(self.ahead)
        row.addStretch(1)
        row.addWidget(label)
        row.addWidget(self.mistake)
        self.do.clicked.connect(bench.lend_a_hand)
        self.ahead.toggled.connect(self._ahead)
        self.mistake.currentIndexChanged.connect(self._plant)
        bench.looked.connect(self._show)

    def _ahead(self, on: bool) -> None:
        self._bench.goes_ahead = on

    def _plant(self) -> None:
        self._bench.plant(Mistake(self.mistake.currentData()))

    def _show(self) -> None:
        if not self.isVisible():
            return
        bench = self._bench
        self.do.setEnabled(not bench.hands_busy and not bench.goes_ahead)
        if self.ahead.isChecked() != bench.goes_ahead:
            self.ahead.setChecked(bench.goes_ahead)
        index = self.mistake.findText(str(bench.mistake))
        if index != self.mistake.currentIndex():
            self.mistake.setCurrentIndex(index)
