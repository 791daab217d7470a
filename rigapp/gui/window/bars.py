"""The card that starts the selected test, and the bar of a replay."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QKeyEvent,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QPen,
    QShortcut,
)
from PySide6.QtWidgets import QFileDialog, QFrame, QLabel, QSlider, QSpinBox

from rigapp.config.names import new_result
from rigapp.config.ranges import RANGES
from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.fonts import sized
from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.testfile.recipe import RecipePanel
from rigapp.gui.testfile.unsaved import listed
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    edit,
    named,
    prose,
    set_property,
    whole_number,
)
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
"""Positions of the slider; the field beside it takes any revolution."""


class ReplayFrame(QFrame):
    """The body of the window; a replay has a frame around it that is visible from three metres."""

    def __init__(self) -> None:
        super().__init__()
        named(self, "body", "Window of the rig")
        self.colour = ""

    def paint(self, colour: str) -> None:
        """Set the colour of the frame; empty: no frame."""
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
    """Play and pause, go to any revolution, change the speed, restart."""

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
        self.slider = named(
            QSlider(Qt.Orientation.Horizontal), "replay_place", "Place in the recorded test"
        )
        self.slider.setRange(0, STEPS)
        self.slider.setPageStep(STEPS // 10)
        self.slider.setTracking(False)
        self.slider.valueChanged.connect(self._moved)
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
        self.slider.setMinimumWidth(PLACE_WIDTH)
        layout = flowing(
            self.word,
            self.play,
            self.again,
            "Pl&ace", (self.slider, 1),
            "Re&volution", self.revolution,
            "Spee&d", self.speed,
            on=self,
        )  # fmt: skip
        layout.setContentsMargins(MARGIN, 0, MARGIN, 0)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
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
        """Show the state of the replay, except fields that are being edited."""
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
        position = round(STEPS * (test.revolution - self._first + 1) / span)
        if not self.slider.isSliderDown():
            _show(self.slider, max(0, min(STEPS, position)))
        if not self.revolution.hasFocus():
            _show(self.revolution, test.revolution)

    def _show_playing(self) -> None:
        text = tr("Pause  F6") if self._playing else tr("Play  F7")
        meaning = Icon.PAUSE if self._playing else Icon.START
        self.play.setText(text)
        self.play.setIcon(icon(meaning, self._theme.highlighted_text))

    def _play(self) -> None:
        self.wanted.emit("pause" if self._playing else "resume", {})

    def _play_when(self, playing: bool) -> None:
        if playing is self._playing:
            self.play.click()

    def _moved(self, position: int) -> None:
        span = self._last - self._first + 1
        self.wanted.emit("seek", {"revolution": self._first - 1 + round(span * position / STEPS)})

    def _typed(self, revolution: int) -> None:
        self.wanted.emit("seek", {"revolution": revolution})

    def _changed(self) -> None:
        self.wanted.emit("replay", {"speed": self.speed.currentData()})


def _show(widget: QSlider | QSpinBox, value: int) -> None:
    if widget.value() != value:
        widget.blockSignals(True)
        widget.setValue(value)
        widget.blockSignals(False)


FILE_WIDTH, MESSAGE_WIDTH = 24 * STEP, 28 * STEP
MOST_REVOLUTIONS = int(RANGES["run.revolutions"].high)


class StartBar(QFrame):
    """Set length and file of the selected test on a card above the buttons.

    The selected test is that of the form (``RecipePanel.selected``); another one chosen here is
    opened there. Its file is read again before the start; differences are shown first.
    """

    started = Signal(dict)

    def __init__(self, recipe: RecipePanel, tests: Sequence[Path], results_folder: Path) -> None:
        super().__init__()
        self._recipe = recipe
        self._results = results_folder
        self._occupied = ""
        named(self, "start_bar", "Start a test")
        self.setProperty("role", "card")
        self.test = choice("start_test", "Selected test", ())
        self.test.activated.connect(self._chosen)
        self.out = edit("start_file", "File that the test is written to")
        self.revolutions = whole_number(
            "start_revolutions", "Revolutions, 0: as in the test", 0, MOST_REVOLUTIONS
        )
        self.revolutions.setSpecialValueText(tr("as in the test"))
        browse = button("start_browse", "&Browse…", self._browse, "Choose another test file")
        self.go = button("start_now", "Start no&w", self._go, guarded=True, rank="primary")
        cancel = button("start_cancel", "Cancel", self.hide, "Do not start")
        self.message = prose("start_told", "What is started")
        self.message.setMinimumSize(MESSAGE_WIDTH, 5 * STEP)
        self.read = button("start_read", "Read it again", self._read_again)
        self.save = button("start_save", "Save the changes", self._save)
        self.out.setMinimumWidth(FILE_WIDTH)
        fields = flowing(
            "Test &file", (self.test, 2), browse,
            "Re&volutions", (self.revolutions, 1),
            "Write t&o", (self.out, 3),
        )  # fmt: skip
        below = flowing((self.message, 1), self.read, self.save, self.go, cancel)
        column(fields, below, on=self).setContentsMargins(MARGIN, GAP, MARGIN, GAP)
        self.offer(tests)
        recipe.selection_changed.connect(self._show_selected)
        self._show_selected()
        self.hide()

    def offer(self, tests: Sequence[Path]) -> None:
        """List test files."""
        for path in tests:
            self._add(path)

    def show_occupied(self, words: str) -> None:
        """Disable the start while a calibration occupies the rig, with a text; empty: enable it."""
        if words != self._occupied:
            self._occupied = words
            self._show_selected()

    @property
    def first(self) -> Path | None:
        """Return the first test of the list, None without one."""
        path = self.test.itemData(0)
        return Path(path) if path else None

    def _add(self, path: Path) -> int:
        index = self.test.findData(str(path))
        if index < 0:
            self.test.addItem(path.name, str(path))
            index = self.test.count() - 1
        return index

    def choose(self, path: Path) -> bool:
        """Select a test file; False where it is unreadable or unsaved changes would be lost."""
        if path == self._recipe.path or self._recipe.open_wanted(path):
            self._show_selected()
            return self._recipe.path == path
        self._show_selected()
        return False

    def open(self) -> None:
        """Show the card with an unused file name and the focus on the test."""
        self._show_selected()
        self.show()
        self.test.setFocus(Qt.FocusReason.OtherFocusReason)

    def start(self, path: Path) -> None:
        """Start a test file unchanged, into a new file; show the card where that is impossible."""
        self.revolutions.setValue(0)
        if self.choose(path) and self.go.isEnabled():
            self._go()
        else:
            self.open()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Start by Enter, close the card by Esc."""
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._go()
        else:
            super().keyPressEvent(event)

    def _show_selected(self) -> None:
        """Show the selected test, with unsaved changes and changes on the disk."""
        selected = self._recipe.selected
        self.test.setCurrentIndex(-1 if selected is None else self._add(selected.path))
        changed = selected.on_disk() if selected is not None else []
        lost = self._recipe.unsaved()
        wrong = selected is None or bool(changed or selected.problem or self._occupied)
        text = self._sentence(changed, lost)
        if selected is not None and not wrong:
            self.out.setText(str(new_result(self._results, selected.path.stem)))
        self.message.setText(f"▲ {text}" if wrong else text)
        set_property(self.message, "role", "error" if wrong else "caution" if lost else "secondary")
        self.read.setVisible(bool(changed))
        self.save.setVisible(bool(lost) and not wrong)
        self.go.setEnabled(not wrong)

    def _sentence(self, changed: Sequence[str], lost: Sequence[str]) -> str:
        """Describe the test to start; changed: differences on the disk, lost: unsaved changes."""
        selected = self._recipe.selected
        if self._occupied:
            return self._occupied
        if selected is None:
            return tr("No test is selected. Choose a test file, or save the new one in Prepare.")
        name = selected.path.name
        if changed:
            return tr("{} is now another file on the disk: {}", name, listed(changed))
        if selected.problem:
            return tr("{} cannot be started: {}.", name, selected.problem)
        if lost:
            return tr("{} starts as it is saved. Not part of it: {}", name, listed(lost))
        if self._recipe.rules.draft is not None:
            return tr("{} starts as it is saved. One draft limit is not part of it.", name)
        return tr("{} starts as it is saved.", name)

    def _chosen(self) -> None:
        if not self.choose(Path(self.test.currentData())):
            text = tr("Changes in Prepare are not saved: save or discard them first.")
            self.message.setText(f"▲ {text}")
            set_property(self.message, "role", "error")

    def _read_again(self) -> None:
        path = self._recipe.path
        if path is not None:
            self._recipe.ask_before(f"reading {path.name} again", self._take_disk)
        self._show_selected()

    def _take_disk(self) -> None:
        if self._recipe.path is not None:
            self._recipe.open_file(self._recipe.path)

    def _save(self) -> None:
        if self._recipe.path is not None:
            self._recipe.save(self._recipe.path)
        self._show_selected()

    def _browse(self) -> None:
        dialog = QFileDialog(self, tr("Choose a test"), filter=tr("Tests (*.toml)"))
        dialog.setObjectName("choose_test")
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.setModal(False)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(lambda name: self.choose(Path(name)))
        dialog.show()

    def _go(self) -> None:
        """Start the test, unless the file has changed since it was selected."""
        self.revolutions.interpretText()
        out, selected = self.out.text().strip(), self._recipe.selected
        if selected is None or not out or selected.on_disk() or self._occupied:
            self._show_selected()
            return
        arguments: dict[str, Any] = {"test": str(selected.path), "out": out}
        if self.revolutions.value():
            arguments["revolutions"] = self.revolutions.value()
        self.hide()
        self.started.emit(arguments)
