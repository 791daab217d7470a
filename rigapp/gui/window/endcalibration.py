"""Ask before a calibration is ended in place of its holder: weights may hang on the pin."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal

from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button
from rigapp.presentation.states import calibration_text
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import Status


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
        if status.calibration is None:
            return
        self._since = status.calibration.since
        words = calibration_text(status)
        text: Text = "Calibrating: {}. Look at the pin: take off what hangs on it, keep hands away."
        self.say(tr(text, words))
        self.show()
        self.keep.setFocus(Qt.FocusReason.OtherFocusReason)

    def take_status(self, status: Status) -> None:
        """Ask no longer about a calibration that is over."""
        found = status.calibration
        if not self.isHidden() and (found is None or found.since != self._since):
            self.hide()

    def _end(self) -> None:
        self.hide()
        self.wanted.emit("calibration_release", {"since": self._since})
