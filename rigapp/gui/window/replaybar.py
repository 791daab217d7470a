"""Play, place and speed of a replay, in the place of the commands: no rig is moved from here."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QPen,
    QShortcut,
)
from PySide6.QtWidgets import QFrame, QLabel, QSlider, QSpinBox

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.fonts import sized
from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.widgets.build import button, choice, named, whole_number
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.window.controls import BAR_HEIGHT, BUTTON_HEIGHT
from rigapp.presentation.tokens import GAP, MARGIN, RADIUS, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import tr
from rigapp.schema.messages import NO_TEST, RunState, Status

SPEEDS = (0.1, 1.0, 10.0, 100.0, 1000.0, 10_000.0)
FRAME = STEP // 2
"""Width of the frame around a replay."""

PLACE_WIDTH = 12 * STEP
STEPS = 1000
"""Places of the slider; the field beside it takes any revolution."""


class ReplayFrame(QFrame):
    """What the window is made on; around a replay it has a frame, seen from three metres."""

    def __init__(self) -> None:
        super().__init__()
        named(self, "body", "Window of the rig")
        self.colour = ""

    def paint(self, colour: str) -> None:
        """Paint the frame in a colour, none where it is empty."""
        width = FRAME if colour else 0
        layout = self.layout()
        if layout is not None:
            layout.setContentsMargins(width, width, width, width)
        self.colour = colour
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the frame."""
        super().paintEvent(event)
        if self.colour:
            painter = QPainter(self)
            painter.setPen(QPen(QColor(self.colour), 2 * FRAME))
            painter.drawRect(self.rect())


class ReplayBar(QFrame):
    """Play and pause, go to any revolution, change the speed, begin again."""

    wanted = Signal(str, dict)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._first, self._last = 1, 1
        self._playing = True
        named(self, "replay_bar", "Replay")
        self.setMinimumHeight(BAR_HEIGHT)
        self.word = named(QLabel(tr("REPLAY")), "replay_word", "Replay of a recorded test")
        self.word.setFont(sized(self.font(), VALUE_PT, QFont.Weight.DemiBold))
        self.word.setFixedHeight(BUTTON_HEIGHT)
        self.word.setToolTip(tr("A recorded test is played: no rig is moved"))
        self.play = button("replay_play", "", self._play, "Play or pause", rank="primary")
        self.play.setFixedSize(16 * STEP, BUTTON_HEIGHT)
        for key, playing in (("F6", True), ("F7", False)):
            QShortcut(QKeySequence(key), self, lambda playing=playing: self._play_when(playing))
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
        self.again.setFixedHeight(BUTTON_HEIGHT)
        self.place.setMinimumWidth(PLACE_WIDTH)
        whole = flowing(
            self.word,
            self.play,
            self.again,
            "Pl&ace", (self.place, 1),
            "Re&volution", self.revolution,
            "Spee&d", self.speed,
            on=self,
        )  # fmt: skip
        whole.setContentsMargins(MARGIN, 0, MARGIN, 0)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        dress_part(
            self,
            theme,
            f"#replay_bar {{ background: {theme.base}; border-top: 1px solid {theme.hairline}; }}"
            f" #replay_word {{ background: {theme.highlight}; color: {theme.highlighted_text};"
            f" border-radius: {RADIUS}px; padding: {STEP // 2}px {GAP}px; }}",
        )
        self.again.setIcon(icon(Icon.AGAIN, theme.text, theme.muted))
        self._show_playing()

    def show_status(self, status: Status, last_recorded: int) -> None:
        """Follow the replay, unless somebody is just moving the slider or typing."""
        test = status.test or NO_TEST
        playing = status.engine.state is RunState.RUNNING
        if playing != self._playing:
            self._playing = playing
            self._show_playing()
        first, last = test.first_revolution, max(last_recorded, 1)
        if (first, last) != (self._first, self._last):
            self._first, self._last = first, last
            self.revolution.setRange(0, last)
        span = max(1, self._last - self._first + 1)
        place = round(STEPS * (test.revolution - self._first + 1) / span)
        if not self.place.isSliderDown():
            _show(self.place, max(0, min(STEPS, place)))
        if not self.revolution.hasFocus():
            _show(self.revolution, test.revolution)

    def _show_playing(self) -> None:
        text = tr("Pause  F6") if self._playing else tr("Play  F7")
        meaning = Icon.PAUSE if self._playing else Icon.START
        self.play.setText(text)
        self.play.setIcon(icon(meaning, self._theme.highlighted_text))

    def _play(self) -> None:
        reason = {"reason": "asked by the operator"} if self._playing else {}
        self.wanted.emit("pause" if self._playing else "resume", reason)

    def _play_when(self, playing: bool) -> None:
        if playing is self._playing:
            self.play.click()

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
