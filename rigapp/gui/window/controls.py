"""Bar of commands: start, pause, resume, stop and note, each on one key, never behind a dialog."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QFont, QKeySequence, QShortcut
from PySide6.QtWidgets import QFrame, QPushButton, QSizePolicy, QStackedWidget, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.fonts import sized
from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.widgets.build import button, column, edit, filled, named, row
from rigapp.gui.widgets.details import details_button
from rigapp.gui.widgets.labels import ElidedLabel, FewLinesLabel
from rigapp.gui.window.command import CommandLine
from rigapp.gui.window.headline import identity
from rigapp.presentation.states import occupied_text
from rigapp.presentation.tokens import MARGIN, MESSAGE_LINES, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.details import details_of, marked_details, sentence_of
from rigapp.schema.messages import AT_REST, NOTE_CHARACTERS, Remedy, Reply, RunState, Status
from rigapp.schema.states import ACTIVE, Trigger, is_untimely
from rigapp.viewer.connection import ConnectionState

Send = Callable[[str, dict[str, Any], Callable[[Reply], None]], None]


@dataclass(frozen=True, slots=True)
class ButtonSpec:
    """One button: verb, text with access key, key, and the states in which it applies."""

    verb: str
    text: Text
    key: str
    states: frozenset[RunState]
    tip: Text
    icon: Icon

    @property
    def spoken(self) -> str:
        """Return the text for screen readers."""
        return tr(self.text).replace("&", "")


STARTABLE = AT_REST
NOTHING_TURNS = AT_REST | {RunState.CALIBRATING}
"""States in which there is nothing to stop."""
START_AFTER_CONNECT_S = 60.0  # the slowest device is identified and configured in half the time
IDLE_BEFORE_START_S = 2.0
"""Time in which an idle engine usually connects; afterwards the start requests it."""

STOP_KEY = "F12"

BUTTONS = (
    ButtonSpec(
        "connect",
        "&Connect",
        "F4",
        frozenset({RunState.IDLE, RunState.FAULT}),
        "Connect the devices of the rig",
        Icon.CONNECT,
    ),
    ButtonSpec("start", "&Start…", "F5", STARTABLE, "Choose test and file, then start", Icon.START),
    ButtonSpec(
        "pause",
        "&Pause",
        "F6",
        frozenset({RunState.STARTING, RunState.RUNNING}),
        "Stop at the safe angle; the test can be resumed",
        Icon.PAUSE,
    ),
    ButtonSpec(
        "resume",
        "&Resume",
        "F5",
        frozenset({RunState.PAUSED}),
        "Resume the paused test",
        Icon.START,
    ),
    ButtonSpec(
        "stop",
        "S&top",
        STOP_KEY,
        ACTIVE | {RunState.CONNECTING, RunState.FAULT},
        "End the test: controlled stop of the spindle, file closed. This is not the emergency stop",
        Icon.STOP,
    ),
)


NOTE_HINT: Text = "Note or reason (F8)"

BAR_HEIGHT = 8 * STEP
BUTTON_HEIGHT = 5 * STEP
STOP_SIZE = QSize(22 * STEP, 6 * STEP)
TIGHT_STOP_SIZE = QSize(15 * STEP, 6 * STEP)


RANKS = {"stop": "dangerous", "start": "primary", "resume": "primary"}
"""Ranks of the buttons that are not ordinary."""


def icon_colour(verb: str, theme: Theme) -> str:
    """Return the colour of a button's icon, in contrast to the button."""
    inks = {"dangerous": theme.critical, "primary": theme.highlighted_text}
    return inks.get(RANKS.get(verb, ""), theme.text)


class ControlRow(QFrame):
    """The bar at the bottom: running test, buttons at fixed positions, Stop apart from them.

    Start and Resume share a position, since only one of them can apply.
    """

    start_wanted = Signal()
    answered = Signal()
    refused = Signal(bool)
    """Emitted with whether the newest answer is a refusal, whose reason needs room."""

    def __init__(self, send: Send, theme: Theme) -> None:
        super().__init__()
        self._send = send
        self._theme = theme
        self._reason_for = self._answer = self._details = ""
        self._selected_name = ""
        self._good = True
        self._tight = False
        self._suspended = False
        self._state: RunState | None = None
        self._occupied = ""
        self._waiting_start: tuple[dict[str, Any], float] | None = None
        named(self, "controls", "Control of the test")
        self.setFixedHeight(BAR_HEIGHT)
        self.buttons = {spec.verb: self._button(spec) for spec in BUTTONS}
        self.text = edit("reason_or_note", "Reason or note", most=NOTE_CHARACTERS)
        self.text.setClearButtonEnabled(True)
        self.text.returnPressed.connect(self.add_note)
        self.note = button(
            "add_note",
            "&Note",
            self.add_note,
            "Add note",
            guarded=True,
            tip="Write the text into the log of the test (Enter)",
        )
        QShortcut(QKeySequence("F8"), self, self._to_text)
        for key in dict.fromkeys(spec.key for spec in BUTTONS):
            shortcut = QShortcut(QKeySequence(key), self, partial(self._press, key))
            if key == STOP_KEY:  # in the window of the help too
                shortcut.setContext(Qt.ShortcutContext.ApplicationShortcut)
        self.answer = FewLinesLabel("answer", "Answer to the last command", MESSAGE_LINES)
        self.answer_more = details_button("answer", lambda _: self._show_answer())
        self.answer_place = QWidget()
        answer_row = row((self.answer, 1), self.answer_more, on=self.answer_place)
        answer_row.setContentsMargins(MARGIN, 0, 0, 0)
        self.answer_place.hide()
        self.test = ElidedLabel("identity", "Test")
        self.test.setProperty("role", "title")
        self.line = ElidedLabel("identity_line", "Rig, speed and file of the test")
        self.line.setProperty("role", "caption")
        self.command_line = CommandLine()
        self._lay_out()
        self._clear_question()
        self.dress(theme)

    def _lay_out(self) -> None:
        identity = column(None, self.test, self.line, None)
        identity.setSpacing(0)
        self.start_place = QStackedWidget()
        self.start_place.setFixedHeight(BUTTON_HEIGHT)
        self.start_place.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        for verb in ("start", "resume"):
            self.start_place.addWidget(self.buttons[verb])
        self.note.setFixedHeight(BUTTON_HEIGHT)
        self.text.setFixedHeight(BUTTON_HEIGHT)
        stop = self.buttons["stop"]
        stop.setFixedSize(STOP_SIZE)
        stop.setFont(sized(stop.font(), VALUE_PT, QFont.Weight.DemiBold))
        requested = (self.buttons["connect"], self.start_place, self.buttons["pause"])
        layout = row((identity, 3), *requested, (self.text, 3), self.note, on=self)
        layout.addSpacing(STEP)
        filled(layout, (self.command_line,))
        layout.addSpacing(STEP)
        filled(layout, (stop,))
        layout.setContentsMargins(MARGIN, 0, MARGIN, 0)
        layout.setSpacing(STEP)

    def make_room(self, *, tight: bool) -> None:
        """Hide in a tight window the running test, the keys, and texts replaced by an icon."""
        for spec in BUTTONS:
            words = "" if tight and spec.verb == "connect" else self._words(spec.text)
            self.buttons[spec.verb].setText(words if tight else f"{words}  {spec.key}")
        self.note.setText("" if tight else self._words("&Note"))
        self.buttons["stop"].setFixedSize(TIGHT_STOP_SIZE if tight else STOP_SIZE)
        for part in (self.test, self.line, self.command_line):
            part.setVisible(not tight)
        self._tight = tight
        self._show_hint()
        self.start_place.updateGeometry()

    def suspend_access_keys(self, suspended: bool) -> None:
        """Remove the access keys of the buttons while a guide needs them; function keys stay."""
        if suspended is not self._suspended:
            self._suspended = suspended
            self.make_room(tight=self._tight)

    def _words(self, text: Text) -> str:
        return tr(text).replace("&", "") if self._suspended else tr(text)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        dress_part(
            self,
            theme,
            f"#controls {{ background: {theme.base}; border-top: 1px solid {theme.hairline}; }}",
        )
        for spec in BUTTONS:
            colour = icon_colour(spec.verb, theme)
            self.buttons[spec.verb].setIcon(icon(spec.icon, colour, theme.muted))
        self.note.setIcon(icon(Icon.NOTE, theme.text, theme.muted))
        self._paint_answer()

    def show_status(self, status: Status | None, connection: ConnectionState) -> None:
        """Enable the commands that apply now; Stop is always allowed."""
        self._state = status.engine.state if status is not None else None
        self._occupied = (
            occupied_text(status) if status is not None and status.engine.calibration else ""
        )
        self._start_when_ready()
        self._show_identity(status)
        for command in BUTTONS:
            applies = status is not None and self._applies(command, status)
            if command.verb == "stop":
                applies = True
            elif connection is ConnectionState.LOST:
                applies = False
            self.buttons[command.verb].setEnabled(applies)
            self.buttons[command.verb].setToolTip(self._tip(command, applies, status))

    def show_selected(self, name: str) -> None:
        """Set the name of the selected test, shown while no test is running; empty: none."""
        self._selected_name = name

    def _show_identity(self, status: Status | None) -> None:
        test, line = identity(status) if status is not None else ("", "")
        if status is not None and status.engine.state not in ACTIVE and self._selected_name:
            test = tr("{}, selected", self._selected_name)  # the test to start, not an ended one
        self.test.show_text(test)
        self.line.show_text(line)
        # Pressing Start or Resume disables it: the other one is shown only when it applies.
        paused = status is not None and status.engine.state is RunState.PAUSED
        self.start_place.setCurrentIndex(int(paused))

    def _applies(self, command: ButtonSpec, status: Status) -> bool:
        """Return whether a command applies now; the engine's next step always does."""
        if status.recovery.verb == command.verb:
            return True
        in_the_way = command.verb == "start" and Remedy.RESET in status.recovery.left
        return status.engine.state in command.states and not in_the_way

    def act(self, verb: str) -> None:
        """Perform the action of a verb's button."""
        if verb == "start":
            self.start_wanted.emit()
            return
        arguments: dict[str, Any] = {}
        if verb == "stop" and self._state in NOTHING_TURNS:
            # Sent in any case: a test may have started since the newest status.
            arguments["reason"] = self.text.text().strip()
            self._send(verb, arguments, self._stopped_at_rest)
            return
        if verb in ("pause", "stop"):
            reason = self.text.text().strip()
            arguments["reason"] = reason
            if reason:
                self.text.clear()
            else:
                self._ask_why("paused" if verb == "pause" else "stopped")
        self.send(verb, arguments)

    def send(self, verb: str, arguments: dict[str, Any]) -> None:
        """Send a request and show the answer; add the typed text where a reason may be needed."""
        if verb == "resume_file" and self.text.text().strip():
            arguments = {**arguments, "reason": self.text.text().strip()}
            self.text.clear()
        label = tr(verb.replace("_", " "))
        starting = tr("The test is being started: this takes a few seconds.")
        self.show_answer(starting if verb == "start" else f"{label} …", good=True)
        self._send(verb, arguments, partial(self._answered, label))

    def start_test(self, arguments: dict[str, Any]) -> None:
        """Start a test, after waiting for devices that are still being connected."""
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
        elif self._occupied:
            self._waiting_start = None
            self.report_occupied()
        elif self._state is RunState.FAULT or waited > START_AFTER_CONNECT_S:
            self._waiting_start = None
            self.show_answer("The test was not started: the devices are not ready.", good=False)
        elif waited < 1.0:
            self.show_answer("start: waiting for the devices …", good=True)

    def report_occupied(self) -> None:
        """Show why the spindle cannot be started while a calibration is open."""
        if self._occupied:
            self.show_answer(self._occupied, good=False)

    def add_note(self) -> None:
        """Send the text as a note for the log."""
        text = self.text.text().strip()
        if not text:
            self._to_text()
            return
        if self._reason_for:
            text = f"Reason why the test was {self._reason_for}: {text}"
        self.send("note", {"text": text[:NOTE_CHARACTERS]})
        self.text.clear()
        self._clear_question()

    def show_answer(self, sentence: Text, *, good: bool) -> None:
        """Show one sentence; a refusal is marked."""
        text = sentence_of(tr(sentence))
        self._answer, self._details = text if good else f"▲ {text}", details_of(sentence)
        self.answer_more.setChecked(False)
        self.answer_more.setVisible(bool(self._details))
        self._show_answer()
        self.answer_place.setVisible(bool(text))
        self._good = good
        self._paint_answer()
        self.refused.emit(not good)

    def _show_answer(self) -> None:
        """Show the answer, or its details while their button is down."""
        self.answer.show_text(self._details if self.answer_more.isChecked() else self._answer)

    def _paint_answer(self) -> None:
        colour = self._theme.secondary if self._good else self._theme.critical
        weight = "" if self._good else " font-weight: 600;"
        self.answer.setStyleSheet(f"color: {colour};{weight}")

    def _answered(self, label: str, reply: Reply) -> None:
        self.answered.emit()
        stamp = time.strftime("%H:%M:%S")
        if reply.ok:
            text = tr("{}: done. {}", label, translate(reply.sentence))
        else:
            text = tr("{} refused: {}", label, translate(reply.sentence))
        self.show_answer(f"{stamp}  {text}{marked_details(reply.sentence)}", good=reply.ok)

    def _stopped_at_rest(self, reply: Reply) -> None:
        """Show that nothing runs where the engine answers so; show any other refusal."""
        if is_untimely(reply.sentence, Trigger.STOP):
            self.show_answer("Nothing is running, so there is nothing to stop.", good=True)
        else:
            self._answered(tr("stop"), reply)

    def _tip(self, command: ButtonSpec, applies: bool, status: Status | None) -> str:
        tip = tr(command.tip)
        if applies:
            return f"{tip} ({command.key})"
        if self._occupied and command.verb in ("start", "resume"):
            return tr("{}. Not now. {}", tip, self._occupied)
        if status is not None and status.engine.state in command.states:
            return tr("{}. Not now. {}", tip, translate(status.recovery.sentence))
        now = tr(self._state.value if self._state is not None else "not known")
        states = tr(" or ").join(sorted(tr(state.value) for state in command.states))
        return tr("{}. Not now: the state is {}; it must be {}", tip, now, states)

    def _button(self, spec: ButtonSpec) -> QPushButton:
        control = button(
            spec.verb,
            f"{tr(spec.text)}  {spec.key}",
            partial(self.act, spec.verb),
            spec.spoken,
            tip=f"{tr(spec.tip)} ({spec.key})",
            # Stopping is always allowed, without control too.
            guarded=spec.verb != "stop",
            rank=RANKS.get(spec.verb, ""),
        )
        control.setFixedHeight(BUTTON_HEIGHT)
        return control

    def _press(self, key: str) -> None:
        """Press the button of a key; of Start and Resume, the one that applies."""
        for spec in BUTTONS:
            if spec.key == key and self.buttons[spec.verb].isEnabled():
                self.buttons[spec.verb].click()
                return
        if any(spec.key == key and spec.verb == "start" for spec in BUTTONS):
            self.report_occupied()

    def _to_text(self) -> None:
        self.text.setFocus(Qt.FocusReason.ShortcutFocusReason)
        self.text.selectAll()

    def _ask_why(self, what: str) -> None:
        self._reason_for = what
        self._show_hint()
        self._to_text()

    def _clear_question(self) -> None:
        self._reason_for = ""
        self._show_hint()

    def _show_hint(self) -> None:
        hint = tr(NOTE_HINT)
        if self._reason_for:
            hint = tr("Why was the test {}? Enter adds it to the log", tr(self._reason_for))
        short: Text = "Why?" if self._reason_for else "Note"
        self.text.setPlaceholderText(tr(short) if self._tight else hint)
        shown = tr(short) if self._tight else tr(NOTE_HINT)
        room = self.text.fontMetrics().horizontalAdvance(shown)
        self.text.setMinimumWidth(room + 4 * STEP)
        self.text.setToolTip(hint)
