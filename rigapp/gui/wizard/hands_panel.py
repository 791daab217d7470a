"""Simulated hands: on a simulated rig a calibration can be practised, mistakes included."""

from __future__ import annotations

from enum import Enum
from typing import Protocol, TypeVar

from PySide6.QtCore import SignalInstance
from PySide6.QtWidgets import QComboBox, QGroupBox, QHBoxLayout, QLabel, QPushButton

from rigapp.gui.wizard.parts import named

M = TypeVar("M", bound=Enum)


class Practice(Protocol[M]):
    """What the panel needs of a bench whose hands make mistakes of kind ``M``."""

    mistake: M
    goes_ahead: bool

    @property
    def hands_busy(self) -> bool:
        """Tell whether the simulated hands are at work."""
        ...

    @property
    def looked(self) -> SignalInstance:
        """Tell after each look at the signals."""
        ...

    def lend_a_hand(self) -> None:
        """Let the simulated hands do what the step asks."""
        ...

    def plant(self, mistake: M, /) -> None:
        """Let the simulated hands make a mistake."""
        ...


class HandsPanel(QGroupBox):
    """Do what the step asks, all by itself if wanted, with a mistake if wanted."""

    def __init__(
        self,
        bench: Practice[M],
        mistakes: type[M],
        name: str = "hands",
        do: str = "&Do this step",
    ) -> None:
        super().__init__("Simulated hands (practice: no waiting times)")
        self._bench = bench
        named(self, name, "Simulated hands")
        self.do = QPushButton(do)
        named(self.do, f"{name}_do", "Let the simulated hands do this step")
        self.ahead = QPushButton("Go a&head")
        self.ahead.setCheckable(True)
        named(self.ahead, f"{name}_ahead", "Do and record all further steps")
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
        self.do.clicked.connect(bench.lend_a_hand)
        self.ahead.toggled.connect(self._ahead)
        self.mistake.currentIndexChanged.connect(
            lambda _: bench.plant(mistakes(self.mistake.currentData()))
        )
        bench.looked.connect(self._show)

    def _ahead(self, on: bool) -> None:
        self._bench.goes_ahead = on

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
