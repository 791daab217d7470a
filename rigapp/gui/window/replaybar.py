"""Place, speed and start of a replay; shown only when the window plays a recorded test."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QFrame, QLabel, QSlider, QSpinBox

from rigapp.gui.language.words import tr
from rigapp.gui.widgets.build import button, choice, named, row, whole_number
from rigapp.schema.messages import Status

SPEEDS = (0.1, 1.0, 10.0, 100.0, 1000.0, 10_000.0)
STEPS = 1000
"""Places of the slider; the field beside it takes any revolution."""


class ReplayBar(QFrame):
    """Go to any revolution, change the speed, begin again."""

    wanted = Signal(str, dict)

    def __init__(self) -> None:
        super().__init__()
        self._first, self._last = 1, 1
        named(self, "replay_bar", "Replay")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.place = named(
            QSlider(Qt.Orientation.Horizontal), "replay_place", "Place in the recorded test"
        )
        self.place.setRange(0, STEPS)
        self.place.setPageStep(STEPS // 10)
        self.place.setTracking(False)
        self.place.valueChanged.connect(self._moved)
        self.revolution = whole_number("replay_revolution", "Go to a revolution", 0, 1)
        self.revolution.valueChanged.connect(self._typed)
        speeds = [(tr("{:g} times", speed), speed) for speed in SPEEDS]
        self.speed = choice("replay_speed", "Speed of the replay", speeds)
        self.speed.setCurrentIndex(self.speed.findData(10.0))
        self.speed.currentIndexChanged.connect(self._changed)
        self.again = button(
            "replay_again",
            "From the start",
            lambda: self.wanted.emit("rewind", {}),
            "Replay from the start",
        )
        note = named(
            QLabel(tr("Replay of a recorded test: no rig is moved.")), "replay_note", "Replay"
        )
        note.setToolTip(tr("F6 pauses the replay, F7 goes on"))
        row(
            note,
            "Pl&ace", (self.place, 1),
            "Re&volution", self.revolution,
            "Spee&d", self.speed,
            self.again,
            on=self,
        )  # fmt: skip

    def show_status(self, status: Status, last_recorded: int) -> None:
        """Follow the replay, unless somebody is just moving the slider or typing."""
        first, last = status.first_revolution, max(last_recorded, 1)
        if (first, last) != (self._first, self._last):
            self._first, self._last = first, last
            self.revolution.setRange(0, last)
        span = max(1, self._last - self._first + 1)
        place = round(STEPS * (status.revolution - self._first + 1) / span)
        if not self.place.isSliderDown():
            _show(self.place, max(0, min(STEPS, place)))
        if not self.revolution.hasFocus():
            _show(self.revolution, status.revolution)

    def _moved(self, place: int) -> None:
        span = self._last - self._first + 1
        self.wanted.emit("seek", {"revolution": self._first - 1 + round(span * place / STEPS)})

    def _typed(self, revolution: int) -> None:
        self.wanted.emit("seek", {"revolution": revolution})

    def _changed(self) -> None:
        self.wanted.emit("replay", {"speed": self.speed.currentData()})


def _show(widget: QSlider | QSpinBox, value: int) -> None:
    if widget.value() != value:
        widget.blockSignals(True)
        widget.setValue(value)
        widget.blockSignals(False)
