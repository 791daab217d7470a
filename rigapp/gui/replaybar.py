"""Speed and start of a replay; shown only when the window plays a recorded test."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QFrame, QHBoxLayout, QLabel, QPushButton

SPEEDS = (1.0, 10.0, 100.0, 1000.0)


class ReplayBar(QFrame):
    """Ask for another speed or the start again."""

    wanted = Signal(str, dict)

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("replay_bar")
        self.setAccessibleName("Replay")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.speed = QComboBox()
        self.speed.setObjectName("replay_speed")
        self.speed.setAccessibleName("Speed of the replay")
        for speed in SPEEDS:
            self.speed.addItem(f"{speed:g} times", speed)
        self.speed.setCurrentIndex(1)
        self.speed.currentIndexChanged.connect(self._changed)
        self.again = QPushButton("From the start")
        self.again.setObjectName("replay_again")
        self.again.setAccessibleName("Replay from the start")
        self.again.clicked.connect(lambda: self.wanted.emit("rewind", {}))
        label = QLabel("This is a replay of a recorded test; no rig is moved.   Speed")
        label.setBuddy(self.speed)
        row = QHBoxLayout(self)
        row.addWidget(label)
        row.addWidget(self.speed)
        row.addWidget(self.again)
        row.addStretch(1)

    def _changed(self) -> None:
        self.wanted.emit("replay", {"speed": self.speed.currentData()})
