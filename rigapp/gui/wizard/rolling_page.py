"""The run-out map: let the engine turn the spindle, see how far it is."""

from __future__ import annotations

from typing import Any

from PySide6.QtWidgets import QAbstractButton, QProgressBar, QVBoxLayout

from rigapp.config.errors import UnusableInput
from rigapp.gui.widgets.build import button, filled, named, prose, tell
from rigapp.gui.wizard.guide_page import TWO, GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration, Question
from rigapp.gui.wizard.scenes import Picture, RollScene
from rigapp.gui.wizard.widgets import MeasuredCard, sentence
from rigapp.presentation.tokens import GAP, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.messages import Reply
from rigapp.texts import sentence_of_error


class RollingCalibration(LiveCalibration):
    """Let the engine take one roll after the other; nothing here waits."""

    question: Question = ("status", {})
    rolling = False

    def roll(self) -> None:
        """Begin to roll, or go on with it."""
        self.rolling = self.session is not None
        self.said.emit("")
        self.moved.emit()

    def stop(self) -> None:
        """Stop the spindle under control; what is recorded stays."""
        self.rolling = False
        self._line("stop", {"reason": "the slow roll was stopped in the wizard"}, self._answered)

    def _heard(self, reply: Reply) -> None:
        self._asked = False
        self.view = reply.result if reply.ok else None
        if not reply.ok:
            self.said.emit(translate(reply.sentence))
        elif self.rolling and self.session is not None:
            self._go_on(self.session, reply.result)
        self.looked.emit()

    def _go_on(self, session: Any, status: Any) -> None:
        try:
            action = session.runs.go_on(status)
        except UnusableInput as error:
            self._end(sentence_of_error(error))
            return
        if action is not None:
            self._asked = True
            asked = {**action.arguments, "calibration": self.key}
            self._line(action.verb, asked, self._answered)
        elif session.runs.done:
            self._end("")

    def _answered(self, reply: Reply) -> None:
        self._asked = False
        if not reply.ok:
            if self.session is not None:
                self.session.runs.forget()
            self._end(reply.sentence)

    def _end(self, sentence: str) -> None:
        self.rolling = False
        self.said.emit(translate(sentence))
        self.moved.emit()


class RollingPage(GuidePage):
    """Turn the spindle when the operator says so; tell how far it is; stop."""

    def __init__(self, live: RollingCalibration, theme: Theme) -> None:
        super().__init__("Slow rolls")
        self._live = live
        why: Text = (
            "Each roll is a test with all guards, and a file of its own. You can close the"
            " wizard: the roll under way goes on to its end, and the map can be taken up again."
        )
        self.why = prose("roll_why", "What a roll is", why)
        self.why.setProperty("role", "secondary")
        self.instruction = self.asking("roll_instruction")
        self.picture = Picture("roll_picture", "What it looks like", theme)
        self.measured = MeasuredCard("roll", "Revolutions turned", theme)
        self.measured.stability.hide()
        self.words = sentence("roll_words", "How far it is")
        self.progress = named(QProgressBar(), "roll_progress", "Progress of the rolls")
        self.progress.setTextVisible(False)
        self.roll = button("roll", "&Turn the spindle", live.roll, rank="primary")
        self.stop = button("roll_stop", "&Stop the spindle", live.stop)
        self.problem = sentence("roll_problem", "What stands against it")
        how = (self.measured, self.words, self.progress)
        now = filled(QVBoxLayout(), (*how, None, self.problem))
        now.setSpacing(GAP)
        look = self.beside(TWO, (self.picture, 5), (now, 4))
        self.hold(self.instruction, self.why, (look, 1))
        live.looked.connect(self._look)
        live.moved.connect(self._look)
        live.said.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Offer to roll."""
        self._look()

    def take_focus(self) -> None:
        """Wait with the focus for what can be pressed: the spindle turns, or it stops."""
        offered = (one for one in (self.roll, self.stop) if one.isEnabled())
        next(offered, self).setFocus()

    def isComplete(self) -> bool:
        """Tell whether every roll is recorded."""
        session = self._live.session
        return session is not None and bool(session.runs.done)

    def foot(self) -> tuple[tuple[QAbstractButton, bool], ...]:
        """Return what stops and turns the spindle, until all rolls are recorded."""
        return ((self.stop, not self.isComplete()), (self.roll, not self.isComplete()))

    def progress_words(self) -> str:
        """Return how many revolutions are turned, of how many."""
        runs = self._live.session.runs
        return tr("{} of {}", runs.turned, runs.planned)

    def _look(self) -> None:
        session = self._live.session
        if session is None:
            return
        runs, rolling = session.runs, self._live.rolling
        told: Text = "Is the follower on the pin, the bushing unworn, every hand away? Then begin."
        if runs.done:
            told = tr("All rolls are recorded.")
        elif rolling:
            told = tr("The spindle turns. Keep your hands away.")
        self.instruction.setText(tr(told))
        self.words.setText(translate(runs.words))
        self.measured.show_value(self.progress_words())
        speeds = ", ".join(f"{rpm:g}" for rpm in session.plan.speeds)
        self.picture.show_scene(RollScene(f"{speeds} rpm", turning=rolling))
        tell(self.roll, "rank", "" if runs.done else "primary")
        self.progress.setRange(0, runs.planned)
        self.progress.setValue(runs.turned)
        waits = self.roll.hasFocus() or self.stop.hasFocus()
        self.roll.setEnabled(not rolling and not runs.done)
        self.stop.setEnabled(rolling)
        if waits:
            self.take_focus()
        self.say_complete(runs.turned)
