"""A button that somebody else can forbid, and that says why it cannot be pressed."""

from __future__ import annotations

from PySide6.QtWidgets import QPushButton


class GuardedButton(QPushButton):
    """A button that changes something at the rig: closed while another viewer is in command.

    What the panel wants (``setEnabled``, ``setToolTip``) is kept and comes back afterwards.
    """

    def __init__(self, text: str = "") -> None:
        super().__init__(text)
        self._wanted = True
        self._tip = ""
        self._why = ""

    def setEnabled(self, enabled: bool) -> None:
        """Enable it, unless it is forbidden."""
        self._wanted = enabled
        allowed = enabled and not self._why
        if allowed != self.isEnabled():
            around = self.parentWidget()
            if not allowed and self.hasFocus() and around is not None:
                # Qt would give the focus to the next field, and scroll the page to it.
                around.setFocus()
            super().setEnabled(allowed)
            if allowed and around is not None and around.hasFocus():
                self.setFocus()

    def setToolTip(self, tip: str) -> None:
        """Take the tool tip; while forbidden, the reason is shown in its place."""
        self._tip = tip
        self._show()

    def forbid(self, why: str) -> None:
        """Close the button with a reason; an empty reason opens it again."""
        if why != self._why:
            self._why = why
            self.setEnabled(self._wanted)
            self._show()

    def _show(self) -> None:
        shown = self._why or self._tip
        if shown != self.toolTip():
            super().setToolTip(shown)
            self.setAccessibleDescription(shown)
