"""Ask what becomes of a running test when its window is closed; never in front of the state."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal

from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button


class CloseBar(Bar):
    """Offer to leave the test running, to stop it first, or to stay."""

    leave = Signal()
    stop_first = Signal()

    def __init__(self) -> None:
        super().__init__("close", "Close the window")
        self.escape = self.hide
        self.stay = button("close_stay", "Stay", self.hide, "Stay in the window")
        keep = button(
            "close_leave",
            "Close, the test goes on",
            self.leave.emit,
            "Close the window, the test goes on",
        )
        stop = button(
            "close_stop",
            "Stop test, then close",
            self._stop,
            "Stop the test, then close the window",
        )
        self.lay_out((keep, stop, self.stay))

    def ask(self) -> None:
        """Show the question with the focus on staying."""
        self.say("A test is under way. It goes on without this window.")
        self.show()
        self.stay.setFocus(Qt.FocusReason.OtherFocusReason)

    def _stop(self) -> None:
        self.say("Stopping the test; the window closes when the spindle stands.")
        self.stop_first.emit()
