"""Control of the rig: display its holder, take and release it with one key."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QWidget

from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button, column, named
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.connection import CommandHolder

KEY = "F2"

_COMMANDING: dict[CommandHolder, tuple[Text, Text, Text]] = {
    CommandHolder.NOBODY: (
        "Nobody has control",
        "Take control",
        (
            "Every window can operate the rig. With control, only this one can; all can stop and"
            " acknowledge"
        ),
    ),
    CommandHolder.THIS: (
        "You have control",
        "Release control",
        "Let every window operate the rig again",
    ),
    CommandHolder.OTHER: (
        "{name} has control",
        "Take over…",
        "{name} loses control; it is recorded in the log",
    ),
}
"""Text, button and tool tip, by the holder of control."""


class CommandLine(QWidget):
    """One line with the holder of control, and a button to take or release it."""

    wanted = Signal(str, dict)
    take_over_wanted = Signal()

    def __init__(self) -> None:
        super().__init__()
        self._holder: CommandHolder | None = None
        self._name = ""
        named(self, "command_line", "Who has control")
        self.text = named(QLabel(), "command_text", "Who has control")
        self.text.setTextFormat(Qt.TextFormat.PlainText)
        self.button = button("command_button", "", self.act, rank="quiet")
        self.text.setProperty("role", "caption")
        column(None, self.text, self.button, None, on=self)
        self.show_holder(CommandHolder.NOBODY, "")

    def show_holder(self, holder: CommandHolder, name: str) -> None:
        """Show the holder of control."""
        if (holder, name) == (self._holder, self._name):
            return
        self._holder, self._name = holder, name
        text, label, tip = _COMMANDING[holder]
        self.text.setText(tr(text, name=name))
        self.button.setText(f"{tr(label)}  {KEY}")
        self.button.setAccessibleName(tr(label).rstrip("…"))
        self.button.setToolTip(f"{tr(tip, name=name)} ({KEY})")

    def act(self) -> None:
        """Take control, release it, or emit ``take_over_wanted``."""
        if self._holder is CommandHolder.OTHER:
            self.take_over_wanted.emit()
        else:
            mine = self._holder is CommandHolder.THIS
            self.wanted.emit("release_command" if mine else "take_command", {})


class ViewerBar(Bar):
    """Show in large letters that this window is read-only; take over control after confirmation."""

    wanted = Signal(str, dict)

    def __init__(self, theme: Theme) -> None:
        super().__init__("viewer", "Viewing only", "Why this window is read-only")
        self._name = ""
        self._asking = False
        self.confirm = button("viewer_take_over", "", self._take_over, "Take over control")
        self.cancel = button("viewer_cancel", "Continue viewing", self._cancel)
        self.lay_out((self.confirm, self.cancel))
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.paint(theme.tint, theme.text, "#viewer_text { font-weight: 600; }")

    def show_holder(self, holder: CommandHolder, name: str) -> None:
        """Show the bar while another viewer has control."""
        other = holder is CommandHolder.OTHER
        if not other or name != self._name:
            self._name, self._asking = name, False
        self._show()
        self.show_when(other)

    def ask(self) -> None:
        """Ask whether to take over control, with the focus on the button to keep viewing."""
        self._asking = True
        self._show()
        self.cancel.setFocus(Qt.FocusReason.OtherFocusReason)

    def _show(self) -> None:
        name = self._name
        text = tr(
            "VIEWING ONLY: {name} has control of this rig. Stopping a test and acknowledging"
            " alarms are possible all the same.",
            name=name,
        )
        if self._asking:
            text = tr(
                "Take control from {name}? {name} can then only look; the log records it.",
                name=name,
            )
        self.escape = self._cancel if self._asking else None
        self.say(text)
        self.confirm.setText(tr("Take control from {name}", name=name))
        self.confirm.setVisible(self._asking)
        self.cancel.setVisible(self._asking)

    def _take_over(self) -> None:
        self._cancel()
        self.wanted.emit("take_command", {"force": True})

    def _cancel(self) -> None:
        self._asking = False
        self._show()


def why_forbidden(holder: CommandHolder, name: str) -> str:
    """Return why this window may not send changes, empty when it may."""
    if holder is not CommandHolder.OTHER:
        return ""
    why = tr("{name} has control of this rig; take over control first", name=name)
    return f"{why} ({KEY})"
