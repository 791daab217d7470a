"""Page on which readings are taken: instruction, stability, record, reject."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QHeaderView,
    QProgressBar,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
)

from rigapp.config.errors import UnusableInput
from rigapp.gui.look.fonts import sized
from rigapp.gui.widgets.build import button, edit, filled, fit_hint, named, prose, row, set_property
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.wizard.guide_page import FOUR, TWO, GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration, Question
from rigapp.gui.wizard.scenes import Picture, RollScene, Scene
from rigapp.gui.wizard.simulated_operator import SimulatedOperatorPanel
from rigapp.gui.wizard.widgets import (
    MeasuredCard,
    PlotNames,
    ResidualPlot,
    labelled,
    number,
    prefix_of,
    sentence,
    taking_what_is_left,
)
from rigapp.presentation.tokens import CAPTION_PT, GAP, Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.messages import Reply
from rigapp.texts import capitalised, sentence_of_error
from rigapp_calibration.taking.procedure import StepKind
from rigapp_calibration.taking.signals import Readiness


class RollingCalibration(LiveCalibration):
    """Make the engine record one roll after the other, without blocking."""

    question: Question = ("status", {})
    rolling = False

    def roll(self) -> None:
        """Start rolling, or continue."""
        self.rolling = self.session is not None
        self.reported.emit("")
        self.moved.emit()

    def stop(self) -> None:
        """Stop the spindle under control; recorded data stay."""
        self.rolling = False
        self._line("stop", {"reason": "the slow roll was stopped in the wizard"}, self._answered)

    def _received(self, reply: Reply) -> None:
        self._requested = False
        self.view = reply.result if reply.ok else None
        if not reply.ok:
            self.reported.emit(translate(reply.sentence))
        elif self.rolling and self.session is not None:
            self._continue(self.session, reply.result)
        self.looked.emit()

    def _continue(self, session: Any, status: Any) -> None:
        try:
            action = session.runs.go_on(status)
        except UnusableInput as error:
            self._end(sentence_of_error(error))
            return
        if action is not None:
            self._requested = True
            requested = {**action.arguments, "calibration": self.key}
            self._line(action.verb, requested, self._answered)
        elif session.runs.done:
            self._end("")

    def _answered(self, reply: Reply) -> None:
        self._requested = False
        if not reply.ok:
            if self.session is not None:
                self.session.runs.forget()
            self._end(reply.sentence)

    def _end(self, sentence: str) -> None:
        self.rolling = False
        self.reported.emit(translate(sentence))
        self.moved.emit()


class RollingPage(GuidePage):
    """Turn the spindle at the operator's command, show the progress, stop."""

    def __init__(self, live: RollingCalibration, theme: Theme) -> None:
        super().__init__("Slow rolls")
        self._live = live
        why: Text = (
            "Each roll is a test with all limits active and its own file. You can close the"
            " wizard: the roll continues to its end, and the map can be continued later."
        )
        self.why = prose("roll_why", "What a roll is", why)
        self.why.setProperty("role", "secondary")
        self.instruction = self.asking("roll_instruction")
        self.picture = Picture("roll_picture", "What it looks like", theme)
        self.measured = MeasuredCard("roll", "Revolutions turned", theme)
        self.measured.stability.hide()
        self.words = sentence("roll_words", "Progress")
        self.progress = named(QProgressBar(), "roll_progress", "Progress of the rolls")
        self.progress.setTextVisible(False)
        self.roll = button("roll", "&Turn the spindle", live.roll, rank="primary")
        self.stop = button("roll_stop", "&Stop the spindle", live.stop)
        self.problem = sentence("roll_problem", "What prevents it")
        how = (self.measured, self.words, self.progress)
        now = filled(QVBoxLayout(), (*how, None, self.problem))
        now.setSpacing(GAP)
        look = self.beside(TWO, (self.picture, 5), (now, 4))
        self.hold(self.instruction, self.why, (look, 1))
        live.looked.connect(self._look)
        live.moved.connect(self._look)
        live.reported.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Show the button that starts rolling."""
        self._look()

    def take_focus(self) -> None:
        """Put the focus on the enabled button: turn or stop the spindle."""
        offered = (control for control in (self.roll, self.stop) if control.isEnabled())
        next(offered, self).setFocus()

    def isComplete(self) -> bool:
        """Return whether every roll is recorded."""
        session = self._live.session
        return session is not None and bool(session.runs.done)

    def foot(self) -> tuple[tuple[QAbstractButton, bool], ...]:
        """Return the buttons that stop and turn the spindle, shown until all rolls are recorded."""
        return ((self.stop, not self.isComplete()), (self.roll, not self.isComplete()))

    def progress_words(self) -> str:
        """Return the progress in revolutions as text."""
        runs = self._live.session.runs
        return tr("{} of {}", runs.turned, runs.planned)

    def _look(self) -> None:
        session = self._live.session
        if session is None:
            return
        runs, rolling = session.runs, self._live.rolling
        text: Text = "Is the follower on the pin, the bushing unworn, every hand away? Then begin."
        if runs.done:
            text = tr("All rolls are recorded.")
        elif rolling:
            text = tr("The spindle turns. Keep your hands away.")
        self.instruction.setText(tr(text))
        self.words.setText(translate(runs.words))
        self.measured.show_value(self.progress_words())
        speeds = ", ".join(f"{rpm:g}" for rpm in session.plan.speeds)
        self.picture.show_scene(RollScene(f"{speeds} rpm", turning=rolling))
        set_property(self.roll, "rank", "" if runs.done else "primary")
        self.progress.setRange(0, runs.planned)
        self.progress.setValue(runs.turned)
        waits = self.roll.hasFocus() or self.stop.hasFocus()
        self.roll.setEnabled(not rolling and not runs.done)
        self.stop.setEnabled(rolling)
        if waits:
            self.take_focus()
        self.say_complete(runs.turned)


RECORD: Text = "&Record"
LEAVE_OUT: Text = "Lea&ve the creep out"
LOADED: Text = "The &load is still"


@dataclass(frozen=True, slots=True)
class TakingWords:
    """Names and texts of the page.

    stem: of the widgets' names; columns: of the table; buttons: kind of a step -> text of the
    button instead of ``RECORD``. measured: caption of the number, which is multiplied by ``factor``
    and shown in ``unit``. scene (session, window, readiness): returns the picture of the step. do:
    action of the simulated operator. read_off: whether the operator enters a position.
    """

    stem: str
    live: Text
    measured: Text
    unit: str
    scene: Callable[[Any, Any, Any], Scene]
    reject: Text
    reason: Text
    columns: tuple[Text, ...]
    buttons: Mapping[StepKind, Text] = field(default_factory=dict)
    factor: float = 1.0
    do: Text = "&Do this step"
    read_off: bool = False


class TakingPage(GuidePage):
    """Take all readings of the plan; the widgets show the state of the session."""

    def __init__(
        self, live: LiveCalibration, theme: Theme, words: TakingWords, plot: PlotNames
    ) -> None:
        """Make the widgets; plot: names for the plot of the residuals so far."""
        super().__init__("Readings")
        self.live_calibration, self._words, self.plot = live, words, ResidualPlot(theme, plot)
        prefix = prefix_of(words.stem)
        self.instruction = self.asking(f"{prefix}instruction", 2)
        self.progress = named(
            QProgressBar(), f"{words.stem}_progress", "Progress of the calibration"
        )
        self.progress.setTextVisible(False)
        self.left = sentence(f"{prefix}time_left", "Progress and time left")
        self.picture = Picture(f"{prefix}picture", "What it looks like", theme)
        self.measured = MeasuredCard(words.stem, words.measured, theme)
        self.stability = self.measured.stability
        self.live = sentence(f"{prefix}live_signal", words.live)
        self.live.setProperty("role", "caption")
        self.record = button(f"{prefix}record", RECORD, self._record, rank="primary")
        self.leave_out = button(f"{prefix}leave_out", LEAVE_OUT, self._leave_out)
        self.problem = sentence(f"{prefix}reading_problem", "What prevents it")
        self.table = _readings_table(f"{prefix}readings_table", words.columns)
        spoken, hint = (marked("Reason or note"), marked("reason, or a note for the record"))
        self.reason = edit(f"{prefix}reject_reason", spoken, self._enable, hint=hint)
        fit_hint(self.reason)
        text: Text = "Re&ject and repeat its series"
        self.reject_button = button(f"{prefix}reject", text, self._reject, words.reject)
        again: Text = "Repeat the newest reading; the others of its series are kept"
        self.back = button(f"{prefix}back", "One step &back", self._back, again)
        noting: Text = "Save the text with the readings; the certificate shows it"
        self.note = button(f"{prefix}note", "&Note", self._note, noting)
        position: Text = "Position that the micrometer shows"
        self.shown = number(f"{prefix}shown", position, -20000.0, 20000.0, 1, 1.0, "µm")
        self._entered = labelled("Micrometer &shows", self.shown) if words.read_off else None
        self.hands = SimulatedOperatorPanel(live, f"{prefix}hands", words.do)
        beside = [part for part in (self.measured, self.live, self._entered) if part is not None]
        now = filled(QVBoxLayout(), (*beside, None, self.problem))
        look = self.beside(TWO, (self.picture, 5), (now, 4))
        how_far = row((self.left, 1), (self.progress, 2))
        left = filled(QVBoxLayout(), (self.instruction, (look, 1), how_far))
        why = flowing(words.reason, (self.reason, 1), self.back, self.note, self.reject_button)
        taken = taking_what_is_left(self.table, 6 * self.table.fontMetrics().height())
        right = filled(QVBoxLayout(), ((self.plot, 3), (taken, 4), why))
        for layout in (left, right, now):
            layout.setSpacing(GAP)
        both = self.beside(FOUR, (left, 1), (right, 1))
        self.hold((both, 1), self.hands)
        self.table.itemSelectionChanged.connect(self._enable)
        live.looked.connect(self._look)
        live.moved.connect(self._move)
        live.reported.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Show the present step, and the button to record it."""
        self.hands.setVisible(self.live_calibration.trains)
        self._move()
        self._look()

    def take_focus(self) -> None:
        """Put the focus on Record as soon as it is enabled."""
        (self.record if self.record.isEnabled() else self).setFocus()

    def isComplete(self) -> bool:
        """Return whether all readings are taken."""
        session = self.live_calibration.session
        return session is not None and bool(session.procedure.done)

    def foot(self) -> tuple[tuple[QAbstractButton, bool], ...]:
        """Return the buttons to record, shown until the last reading, and to skip a step."""
        session = self.live_calibration.session
        under_way = session is not None and not session.procedure.done
        optional = under_way and session.procedure.step.optional
        return ((self.leave_out, optional), (self.record, under_way))

    def progress_words(self) -> str:
        """Return the number of valid and of planned readings as text."""
        procedure = self.live_calibration.session.procedure
        wanted = sum(step.kind is StepKind.READING for step in procedure.steps)
        return tr("{} of {}", len(procedure.standing(of=lambda step: True)), wanted)

    def _show_step(self) -> None:
        """Show instruction and progress, and enter the position of the step."""
        procedure = self.live_calibration.session.procedure
        self.instruction.setText(translate(procedure.instruction).replace(" um", " µm"))
        self.progress.setRange(0, len(procedure.steps))
        self.progress.setValue(procedure.position)
        self.measured.setVisible(not procedure.done)
        if self._entered is not None:
            self._entered.setRowVisible(0, not procedure.done)
        set_property(self.record, "rank", "" if procedure.done else "primary")
        self._show_scene()
        if procedure.done:
            self.left.setText(tr("All steps are done."))
            return
        if self._words.read_off:
            self.shown.setValue(1e6 * procedure.step.value)
            self.shown.setEnabled(procedure.step.kind is StepKind.READING)
        progress = translate(procedure.progress)
        self.left.setText(capitalised(progress))
        button = tr(self._words.buttons.get(procedure.step.kind, RECORD))
        if procedure.step.kind is StepKind.PRELOAD and procedure.step.optional:
            button = tr(LOADED)
        self.record.setText(button)
        self.record.setAccessibleName(button.replace("&", ""))

    def _move(self) -> None:
        if self.live_calibration.session is None:
            return
        self._show_step()
        self._fill()
        self.plot.show_residuals(self.live_calibration.session.residuals())
        self.completeChanged.emit()

    def _look(self) -> None:
        """Show whether the signal is steady and enable Record accordingly; keep the focus."""
        live = self.live_calibration
        if live.session is None or not self.isVisible():
            return
        readiness = live.readiness
        shown = None if readiness is None else live.session.compared(readiness)
        self.stability.show_readiness(shown)
        usable = readiness is not None and readiness.ready and not live.session.procedure.done
        waits = self.hasFocus() or self.record.hasFocus()
        self.record.setEnabled(usable and not live.goes_ahead and not live.hands_busy)
        if waits:
            self.take_focus()
        known = readiness is not None and not math.isnan(readiness.felt)
        self.live.setText(translate(live.session.live_words(readiness)) if known else "")
        self._show_measured(readiness if known else None)
        self._show_scene()

    def _show_measured(self, readiness: Readiness | None) -> None:
        """Show the measured value, and its target where there is one."""
        session, words = self.live_calibration.session, self._words
        if readiness is None:
            self.measured.show_value("")
            return
        text = f"{words.factor * readiness.felt:.1f} {words.unit}".replace("-", "\u2212")
        wanted = ""
        if not session.procedure.done and session.procedure.step.kind is not StepKind.SET_UP:
            wanted = tr("It should be {:.1f} {}", words.factor * session.expected(), words.unit)
        self.measured.show_value(text, wanted.replace("-", "\u2212"))

    def _show_scene(self) -> None:
        live, scene = self.live_calibration, None
        if not live.session.procedure.done:
            scene = self._words.scene(live.session, live.window, live.readiness)
        self.picture.show_scene(scene)

    def _fill(self) -> None:
        """Show all readings."""
        session = self.live_calibration.session
        procedure = session.procedure
        taken, last = procedure.taken, len(self._words.columns) - 1
        self.table.setRowCount(len(taken))
        for index, reading in enumerate(taken):
            state = tr("rejected: {}", reading.rejected) if reading.rejected else tr("valid")
            known = self.table.item(index, last)
            if known is not None and known.text() == state and index != len(taken) - 1:
                continue
            step = procedure.steps[reading.step]
            signals = (f"{signal:+.5f}" for signal in reading.signal)
            texts = (step.series, str(step.number), *session.cells(reading), *signals, state)
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                font = item.font()
                font.setStrikeOut(bool(reading.rejected) and column < last)
                item.setFont(font)
                self.table.setItem(index, column, item)
        self.table.scrollToBottom()
        self._enable()

    def _record(self) -> None:
        self.shown.interpretText()
        self.live_calibration.take(1e-6 * self.shown.value() if self._words.read_off else None)

    def _leave_out(self) -> None:
        self.live_calibration.attempt(lambda session: session.leave_out())

    def _reject(self) -> None:
        number = self.table.currentRow()
        if number >= 0 and self.live_calibration.reject(number, self.reason.text()):
            self.reason.clear()
            self.table.clearSelection()

    def _back(self) -> None:
        self._use_words(lambda session, words: session.back(words))

    def _note(self) -> None:
        self._use_words(lambda session, words: session.note(words))

    def _use_words(self, act: Callable[[Any, str], object]) -> None:
        """Call a function with the typed text, and clear the text."""
        if self.live_calibration.attempt(lambda session: act(session, self.reason.text())):
            self.reason.clear()

    def _enable(self) -> None:
        typed = bool(self.reason.text().strip())
        self.back.setEnabled(typed and self.table.rowCount() > 0)
        self.note.setEnabled(typed)
        selected = self.table.currentRow() >= 0 and bool(self.table.selectedItems())
        self.reject_button.setEnabled(selected and typed)


def _readings_table(name: str, columns: tuple[str, ...]) -> QTableWidget:
    table = named(QTableWidget(0, len(columns)), name, "Readings")
    table.setHorizontalHeaderLabels([tr(heading) for heading in columns])
    table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
    table.setFont(sized(table.font(), CAPTION_PT))
    table.setTabKeyNavigation(False)
    table.verticalHeader().setAccessibleName(tr("Number of the reading"))
    table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    table.horizontalHeader().setStretchLastSection(True)
    return table
