"""Ask before a test is left alone, or a calibration ended for another; never before the state."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal

from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button
from rigapp.presentation.states import calibration_text
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import Status


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


class EndCalibrationBar(Bar):
    """Say who calibrates what, ask whether the pin is free, and end just that calibration."""

    wanted = Signal(str, dict)

    def __init__(self) -> None:
        super().__init__("end_calibration", "End the calibration")
        self._since = 0.0
        self.escape = self.hide
        self.keep = button("calibration_keep", "Keep it open", self.hide, "Keep the calibration")
        self.confirm = button(
            "calibration_release",
            "The pin is free: end it",
            self._end,
            "Nothing hangs on the pin: end the calibration",
            guarded=True,
        )
        self.lay_out((self.keep, self.confirm))

    def ask(self, status: Status) -> None:
        """Show the question with the focus on keeping it open."""
        if status.engine.calibration is None:
            return
        self._since = status.engine.calibration.since
        words = calibration_text(status)
        text: Text = "Calibrating: {}. Look at the pin: take off what hangs on it, keep hands away."
        self.say(tr(text, words))
        self.show()
        self.keep.setFocus(Qt.FocusReason.OtherFocusReason)

    def take_status(self, status: Status) -> None:
        """Ask no longer about a calibration that is over."""
        found = status.engine.calibration
        if not self.isHidden() and (found is None or found.since != self._since):
            self.hide()

    def _end(self) -> None:
        self.hide()
        self.wanted.emit("calibration_release", {"since": self._since})
