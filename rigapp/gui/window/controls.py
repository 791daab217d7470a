"""Start, pause, resume, stop and note: one row, never behind a dialog, each on one key."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from rigapp.gui.data.connection import ConnectionState
from rigapp.gui.plots.palette import Theme
from rigapp.gui.widgets.guarded import GuardedButton
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.window.command import CommandLine
from rigapp.schema.messages import ACTIVE_STATES, NOTE_CHARACTERS, Reply, RunState, Status, Step

Send = Callable[[str, dict[str, Any], Callable[[Reply], None]], None]


@dataclass(frozen=True, slots=True)
class Command:
    """One button: its verb, text with access key, key, and the states in which it applies."""

    verb: str
    text: str
    key: str
    states: frozenset[RunState]
    tip: str


STARTABLE = frozenset({RunState.IDLE, RunState.READY, RunState.STOPPED})
START_AFTER_CONNECT_S = 60.0
IDLE_BEFORE_START_S = 2.0
"""An idle engine is about to connect by itself; when it does not, the start makes it."""

COMMANDS = (
    Command(
        "connect",
        "&Connect",
        "F4",
        frozenset({RunState.IDLE, RunState.FAULT}),
        "Connect the devices of the rig",
    ),
    Command("start", "&Start test…", "F5", STARTABLE, "Choose test and file, then start"),
    Command(
        "pause",
        "&Pause",
        "F6",
        frozenset({RunState.STARTING, RunState.RUNNING}),
        "Stop at the safe angle; the test can be resumed",
    ),
    Command(
        "resume",
        "&Resume",
        "F7",
        frozenset({RunState.PAUSED}),
        "Go on with the paused test",
    ),
    Command(
        "stop",
        "S&top test",
        "F12",
        ACTIVE_STATES | {RunState.CONNECTING, RunState.FAULT},
        "End the test: controlled stop of the spindle, file closed. This is not the emergency stop",
    ),
)


class ControlRow(QWidget):
    """Hold the buttons, the line for reasons and notes, and the answer to the last command."""

    start_wanted = Signal()
    answered = Signal()

    def __init__(self, send: Send, theme: Theme) -> None:
        super().__init__()
        self._send = send
        self._theme = theme
        self._asked_why = ""
        self._good = True
        self._state: RunState | None = None
        self._waiting_start: tuple[dict[str, Any], float] | None = None
        self.setObjectName("controls")
        self.setAccessibleName("Control of the test")
        self.buttons: dict[str, QPushButton] = {}
        row = QHBoxLayout()
        row.setSpacing(6)
        for command in COMMANDS:
            row.addWidget(self._button(command))
        row.addSpacing(12)
        self.text = QLineEdit()
        self.text.setObjectName("reason_or_note")
        self.text.setAccessibleName("Reason or note")
        self.text.setClearButtonEnabled(True)
        self.text.setMaxLength(NOTE_CHARACTERS)
        self.text.returnPressed.connect(self.add_note)
        caption = QLabel("&Note (F8)")
        caption.setBuddy(self.text)
        self.note = GuardedButton("&Add note")
        self.note.setObjectName("add_note")
        self.note.setAccessibleName("Add note")
        self.note.setToolTip("Write the text into the log of the test (Enter)")
        self.note.clicked.connect(self.add_note)
        QShortcut(QKeySequence("F8"), self, self._to_text)
        for widget in (caption, self.text, self.note):
            row.addWidget(widget, 1 if widget is self.text else 0)
        self.answer = ElidedLabel("answer", "Answer to the last command")
        self.command_line = CommandLine()
        below = QHBoxLayout()
        below.addWidget(self.answer, 1)
        below.addWidget(self.command_line)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addLayout(row)
        column.addLayout(below)
        self._ask_nothing()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self._paint_answer()

    def show_status(
        self, status: Status | None, connection: ConnectionState, *, replay: bool = False
    ) -> None:
        """Enable what applies now; Stop stays enabled when the state is not known."""
        self._state = status.state if status is not None else None
        self._start_when_ready()
        for command in COMMANDS:
            applies = status is not None and self._applies(command, status)
            if command.verb == "stop":
                applies = applies or connection is not ConnectionState.ATTACHED
            elif connection is ConnectionState.LOST or (
                replay and command.verb in ("connect", "start")
            ):
                applies = False
            button = self.buttons[command.verb]
            button.setEnabled(applies)
            button.setToolTip(self._tip(command, applies, status))

    def _applies(self, command: Command, status: Status) -> bool:
        """Tell whether a command means something now; what the engine names as next always does."""
        if status.recovery.verb == command.verb:
            return True
        in_the_way = command.verb == "start" and Step.RESET in status.recovery.left
        return status.state in command.states and not in_the_way

    def act(self, verb: str) -> None:
        """Do what the button of a verb does."""
        if verb == "start":
            self.start_wanted.emit()
            return
        arguments: dict[str, Any] = {}
        if verb in ("pause", "stop"):
            reason = self.text.text().strip()
            arguments["reason"] = reason or "asked by the operator"
            if reason:
                self.text.clear()
            else:
                self._ask_why("paused" if verb == "pause" else "stopped")
        self.send(verb, arguments)

    def send(self, verb: str, arguments: dict[str, Any]) -> None:
        """Send a request and show the answer; the text goes along where a reason may be needed."""
        if verb == "resume_file" and self.text.text().strip():
            arguments = {**arguments, "reason": self.text.text().strip()}
            self.text.clear()
        label = verb.replace("_", " ")
        self.show_answer(f"{label} …", good=True)
        self._send(verb, arguments, partial(self._answered, label))

    def start_test(self, arguments: dict[str, Any]) -> None:
        """Start a test; devices that are still being connected are waited for."""
        self._waiting_start = (arguments, time.monotonic())
        self._start_when_ready()

    def _start_when_ready(self) -> None:
        if self._waiting_start is None:
            return
        arguments, since = self._waiting_start
        waited = time.monotonic() - since
        idle = self._state is RunState.IDLE and waited > IDLE_BEFORE_START_S
        if self._state in (RunState.READY, RunState.STOPPED) or idle:
            self._waiting_start = None
            self.send("start", arguments)
        elif self._state is RunState.FAULT or waited > START_AFTER_CONNECT_S:
            self._waiting_start = None
            self.show_answer("The test was not started: the devices are not ready.", good=False)
        elif waited < 1.0:
            self.show_answer("start: waiting for the devices …", good=True)

    def add_note(self) -> None:
        """Send the text as a note of the log."""
        text = self.text.text().strip()
        if not text:
            self._to_text()
            return
        if self._asked_why:
            text = f"Reason why the test was {self._asked_why}: {text}"
        self.send("note", {"text": text[:NOTE_CHARACTERS]})
        self.text.clear()
        self._ask_nothing()

    def show_answer(self, sentence: str, *, good: bool) -> None:
        """Show one sentence; a refusal is marked."""
        self.answer.show_text(sentence if good else f"▲ {sentence}")
        self._good = good
        self._paint_answer()

    def _paint_answer(self) -> None:
        colour = self._theme.muted if self._good else self._theme.critical
        weight = "" if self._good else " font-weight: bold;"
        self.answer.setStyleSheet(f"color: {colour};{weight}")

    def _answered(self, label: str, reply: Reply) -> None:
        self.answered.emit()
        stamp = time.strftime("%H:%M:%S")
        if reply.ok:
            self.show_answer(f"{stamp}  {label}: done. {reply.sentence}", good=True)
        else:
            self.show_answer(f"{stamp}  {label} refused: {reply.sentence}", good=False)

    def _tip(self, command: Command, applies: bool, status: Status | None) -> str:
        if applies:
            return f"{command.tip} ({command.key})"
        if status is not None and status.state in command.states:
            return f"{command.tip}. Not now. {status.recovery.sentence}"
        now = self._state.value if self._state is not None else "not known"
        states = sorted(state.value for state in command.states)
        return f"{command.tip}. Not now: the state is {now}; it must be {' or '.join(states)}"

    def _button(self, command: Command) -> QPushButton:
        # Stopping is for everybody, whoever is in command.
        kind = QPushButton if command.verb == "stop" else GuardedButton
        button = kind(f"{command.text}  {command.key}")
        button.setObjectName(command.verb)
        button.setAccessibleName(command.text.replace("&", ""))
        button.setToolTip(f"{command.tip} ({command.key})")
        button.setMinimumHeight(int(button.sizeHint().height() * 1.3))
        button.clicked.connect(partial(self.act, command.verb))
        shortcut = QShortcut(QKeySequence(command.key), self)
        shortcut.activated.connect(button.click)
        self.buttons[command.verb] = button
        return button

    def _to_text(self) -> None:
        self.text.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.text.selectAll()

    def _ask_why(self, what: str) -> None:
        self._asked_why = what
        self.text.setPlaceholderText(f"Why was the test {what}? Enter adds it to the log")
        self._to_text()

    def _ask_nothing(self) -> None:
        self._asked_why = ""
        self.text.setPlaceholderText("")
