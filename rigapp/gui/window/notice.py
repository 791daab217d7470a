"""Bars of the message line: state and next step; questions before an end."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal

from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button
from rigapp.gui.window.recover import KEY as RECOVER_KEY
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import calibration_text, state_details, state_line
from rigapp.presentation.times import duration
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.messages import NO_TEST, RunState, Status
from rigapp.schema.states import ACTIVE
from rigapp.viewer.connection import ConnectionState


class NoticeBar(Bar):
    """Show the reason of a state and the next step, or that the engine does not answer.

    A restart is shown until it is acknowledged, or until a test is running again.
    own_calibration: start time of the calibration open in this window, which its guide ends.
    """

    end_wanted = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__("notice", "What happened")
        self.own_calibration = 0.0
        self._theme = theme
        self._last: Status | None = None
        self._silent = self._restart = ""
        self._bad = False
        self.away = button("notice_away", "Understood", self._put_away, "Close the notice")
        self.end = button(
            "end_calibration",
            "End calibration…",
            self.end_wanted.emit,
            "End the calibration that occupies the rig",
            guarded=True,
        )
        self.lay_out((self.end, self.away))

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self._paint()

    def take_status(self, status: Status, *, replay: bool = False) -> None:
        """Update to the newest status; for a replay show that nothing moves."""
        test = status.test or NO_TEST
        if replay:
            self.say(tr("{}: no rig is connected, no spindle turns.", translate(test.title)))
            self.away.hide()
            self.end.hide()
            self.show_when(True)
            return
        last, self._last = self._last, status
        if last is not None and last.engine.pid != status.engine.pid:
            self._restart = restart_sentence(last)
        if status.engine.state in ACTIVE:
            self._restart = ""
        self._show()

    def take_connection(self, connection: ConnectionState, silence_s: float) -> None:
        """Update to the state of the connection; silence replaces an older notice."""
        silent = silence_sentence(connection, silence_s, self._last)
        if silent != self._silent:
            self._silent = silent
            self._show()

    def _show(self) -> None:
        status, silent = self._last, self._silent
        text = (
            silent
            or self._restart
            or (state_line(status, RECOVER_KEY) if status is not None else "")
        )
        bad = bool(text) and (
            bool(silent or self._restart)
            or (status is not None and status.engine.state is RunState.FAULT)
        )
        self.away.setVisible(bool(self._restart) and not silent)
        running = status.engine.calibration if status is not None and not silent else None
        self.end.setVisible(running is not None and running.since != self.own_calibration)
        described = status if status is not None and not (silent or self._restart) else None
        self.say(text, state_details(described) if described is not None else "")
        self.setToolTip(text)
        self.show_when(bool(text))
        if bad != self._bad:
            self._bad = bad
            self._paint()

    def _paint(self) -> None:
        theme = self._theme
        if self._bad:
            self.paint(theme.critical_tint, theme.critical, "#notice_text { font-weight: 600; }")
        else:
            self.paint(theme.alternate, theme.text)

    def _put_away(self) -> None:
        self._restart = ""
        self._show()


def silence_sentence(connection: ConnectionState, silence_s: float, last: Status | None) -> str:
    """Return the notice while the engine does not answer, else an empty text."""
    if last is None or connection not in (ConnectionState.SILENT, ConnectionState.LOST):
        return ""
    text = tr("The engine has not answered for {}: every value is old.", duration(silence_s))
    if last.engine.state in (RunState.IDLE, RunState.READY, RunState.STOPPED):
        return text
    more = tr("Press the emergency stop before you reach into the rig.")
    return f"{text}  {more}"


def restart_sentence(last: Status) -> str:
    """Return the notice that another engine process answers than before."""
    if last.engine.state not in ACTIVE:
        return ""
    test = last.test or NO_TEST
    return tr(
        (
            "The engine ended while {test} was {state}, and a new one was started. The drive's"
            " own watchdog stops the spindle. {saved} revolutions are saved in {file}. To"
            " resume: Results (Ctrl+8), Resume test."
        ),
        test=test.title or tr("a test"),
        state=tr(last.engine.state.value),
        saved=grouped(test.committed),
        file=test.file,
    )


class CloseBar(Bar):
    """Ask whether to leave the test running, to stop it first, or to keep the window open."""

    leave = Signal()
    stop_first = Signal()

    def __init__(self) -> None:
        super().__init__("close", "Close the window")
        self.escape = self.hide
        self.stay = button("close_stay", "Stay", self.hide, "Stay in the window")
        keep = button(
            "close_leave",
            "Close, the test continues",
            self.leave.emit,
            "Close the window, the test continues",
        )
        stop = button(
            "close_stop",
            "Stop test, then close",
            self._stop,
            "Stop the test, then close the window",
        )
        self.lay_out((keep, stop, self.stay))

    def ask(self) -> None:
        """Show the question with the focus on keeping the window open."""
        self.say("A test is running. It continues without this window.")
        self.show()
        self.stay.setFocus(Qt.FocusReason.OtherFocusReason)

    def _stop(self) -> None:
        self.say("Stopping the test. The window closes when the spindle is at rest.")
        self.stop_first.emit()


class EndCalibrationBar(Bar):
    """Show operator and type of a calibration, ask whether the pin is free, and end it."""

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
            "The pin carries no weight: end the calibration",
            guarded=True,
        )
        self.lay_out((self.keep, self.confirm))

    def ask(self, status: Status) -> None:
        """Show the question with the focus on keeping the calibration open."""
        if status.engine.calibration is None:
            return
        self._since = status.engine.calibration.since
        words = calibration_text(status)
        text: Text = "Calibrating: {}. Check the pin: remove the weights and keep your hands away."
        self.say(tr(text, words))
        self.show()
        self.keep.setFocus(Qt.FocusReason.OtherFocusReason)

    def take_status(self, status: Status) -> None:
        """Withdraw the question when the calibration has ended."""
        running = status.engine.calibration
        if not self.isHidden() and (running is None or running.since != self._since):
            self.hide()

    def _end(self) -> None:
        self.hide()
        self.wanted.emit("calibration_release", {"since": self._since})
