"""Who is in command of the rig: seen at a glance, taken and given back with one key."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QPushButton, QSizePolicy, QWidget

from rigapp.gui.data.commanding import CommandHolder
from rigapp.gui.plots.palette import Theme

KEY = "F2"


class CommandLine(QWidget):
    """One line: who is in command, and a button to take command or give it back."""

    wanted = Signal(str, dict)
    take_over_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._holder: CommandHolder | None = None
        self._name = ""
        self.setObjectName("command_line")
        self.setAccessibleName("Who is in command")
        self.text = QLabel()
        self.text.setObjectName("command_text")
        self.text.setAccessibleName("Who is in command")
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.button = QPushButton()
        self.button.setObjectName("command_button")
        self.button.clicked.connect(self.act)
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.text)
        row.addWidget(self.button)
        self.show_holder(CommandHolder.NOBODY, "")

    def show_holder(self, holder: CommandHolder, name: str) -> None:
        """Show who is in command."""
        if (holder, name) == (self._holder, self._name):
            return
        self._holder, self._name = holder, name
        text, label, tip = {
            CommandHolder.NOBODY: (
                "Nobody is in command",
                "Take command",
                "Every window may operate the rig. In command, only this one does, apart from"
                " stopping and acknowledging",
            ),
            CommandHolder.THIS: (
                "You are in command",
                "Release command",
                "Let every window operate the rig again",
            ),
            CommandHolder.OTHER: (
                f"{name} is in command",
                "Take over…",
                f"{name} loses command; it is recorded in the log",
            ),
        }[holder]
        self.text.setText(text)
        self.button.setText(f"{label}  {KEY}")
        self.button.setAccessibleName(label.rstrip("…"))
        self.button.setToolTip(f"{tip} ({KEY})")

    def act(self) -> None:
        """Take command, release it, or ask whether it is to be taken over."""
        if self._holder is CommandHolder.OTHER:
            self.take_over_wanted.emit()
        else:
            verb = "release_command" if self._holder is CommandHolder.THIS else "take_command"
            self.wanted.emit(verb, {})


class ViewerBar(QFrame):
    """Say in large letters that this window only looks; take command over after a question."""

    wanted = Signal(str, dict)

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._name = ""
        self._asking = False
        self.setObjectName("viewer_bar")
        self.setAccessibleName("Viewing only")
        self.text = QLabel()
        self.text.setObjectName("viewer_text")
        self.text.setAccessibleName("Why this window only looks")
        self.text.setWordWrap(True)
        self.text.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
        self.confirm = self._button("viewer_take_over", "", self._take_over)
        self.cancel = self._button("viewer_cancel", "Go on viewing", self._cancel)
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 2, 8, 2)
        row.addWidget(self.text, 1)
        row.addWidget(self.confirm)
        row.addWidget(self.cancel)
        self.dress(theme)
        self.hide()

    def _button(self, name: str, text: str, call: Callable[[], Any]) -> QPushButton:
        button = QPushButton(text)
        button.setObjectName(name)
        button.setAccessibleName(text or "Take over command")
        button.clicked.connect(call)
        return button

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.setStyleSheet(
            f"#viewer_bar {{ background: {theme.base}; border: 3px double {theme.text};"
            " border-radius: 4px; } #viewer_text { font-weight: bold; }"
        )

    def show_holder(self, holder: CommandHolder, name: str) -> None:
        """Appear while another viewer is in command."""
        other = holder is CommandHolder.OTHER
        if not other or name != self._name:
            self._name, self._asking = name, False
        self._say()
        if self.isHidden() == other:
            self.setVisible(other)

    def ask(self) -> None:
        """Ask whether command is to be taken over, with the focus on going on viewing."""
        self._asking = True
        self._say()
        self.cancel.setFocus(Qt.FocusReason.OtherFocusReason)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Esc goes on viewing."""
        if event.key() == Qt.Key.Key_Escape and self._asking:
            self._cancel()
        else:
            super().keyPressEvent(event)

    def _say(self) -> None:
        name = self._name
        text = (
            f"VIEWING ONLY: {name} is in command of this rig. Stopping a test and acknowledging"
            " alarms are possible all the same."
        )
        if self._asking:
            text = f"Take command from {name}? {name} can then only look; the log records it."
        if text != self.text.text():
            self.text.setText(text)
            self.confirm.setText(f"Take command from {name}")
        self.confirm.setVisible(self._asking)
        self.cancel.setVisible(self._asking)

    def _take_over(self) -> None:
        self._asking = False
        self._say()
        self.wanted.emit("take_command", {"force": True})

    def _cancel(self) -> None:
        self._asking = False
        self._say()


def why_forbidden(holder: CommandHolder, name: str) -> str:
    """Return why this window may not change anything, empty when it may."""
    if holder is not CommandHolder.OTHER:
        return ""
    return f"{name} is in command of this rig; take command over first ({KEY})"
