"""The run-out map: choose the rolls, let the engine turn the spindle, see how far it is."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
from PySide6.QtWidgets import QProgressBar, QVBoxLayout, QWidget, QWizardPage

from rigapp.calibrating.rolls import ORDERS, REVOLUTIONS, RollPlan, roll_plan
from rigapp.config.calibration_settings import RunOutFile
from rigapp.config.errors import UnusableInput
from rigapp.gui.look.tokens import Theme
from rigapp.gui.widgets.build import button, edit, filled, named, row, whole_number
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.parts import field, sentence
from rigapp.gui.wizard.plan_page import PlanPage
from rigapp.schema.messages import Reply


class RollingCalibration(LiveCalibration):
    """Let the engine take one roll after the other; nothing here waits."""

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

    def tick(self) -> None:
        """Ask how the engine stands unless an answer is still due."""
        self._worker.deliver()
        if not self._asked:
            self._asked = True
            self._line("status", {}, self._heard)

    def _heard(self, reply: Reply) -> None:
        self._asked = False
        self.view = reply.result if reply.ok else None
        if not reply.ok:
            self.said.emit(reply.sentence)
        elif self.rolling and self.session is not None:
            self._go_on(self.session, reply.result)
        self.looked.emit()

    def _go_on(self, session: Any, status: Any) -> None:
        try:
            action = session.runs.go_on(status)
        except UnusableInput as error:
            self._end(str(error))
            return
        if action is not None:
            self._asked = True
            self._line(action.verb, dict(action.arguments), self._answered)
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
        self.said.emit(sentence)
        self.moved.emit()


class RollPlanPage(PlanPage):
    """Choose the speeds, how often, and the test file whose mechanism is in the rig."""

    def __init__(self, live: LiveCalibration, folder: Path, settings: Path | None) -> None:
        super().__init__(
            live,
            folder,
            settings,
            RunOutFile(schema=1),
            stem="run_out",
            journals="run-out",
            plans={
                "routine": "Routine: 12 revolutions at each speed",
                "full": "Full: 30 revolutions at each speed",
            },
            item=("name", "Name of the pin"),
        )
        self.setTitle("Rolls")
        self.setSubTitle(
            "The spindle turns slowly with the follower on the pin and an unworn bushing, whose"
            " probes then see the pin's own run-out. Two speeds tell inertia from run-out."
        )
        hint = "its mechanism tells the elastic motion, its limits stay"
        self.test = edit("run_out_test", "Test file of this mechanism", hint=hint)
        self.test.setText("" if live.rig.test is None else str(live.rig.test))
        self.speeds = edit("run_out_speeds", "Speeds of the rolls, revolutions per minute")
        self.speeds.setText("3, 6")
        self.orders = whole_number("run_out_orders", "Fourier orders of the map", 1, 32)
        self.orders.setValue(ORDERS)
        for text, widget in (
            ("Name of the &pin", self.item),
            ("P&lan", self.plan),
            ("Sp&eeds (rpm)", self.speeds),
            ("Or&ders of the map", self.orders),
            ("&Test file", self.test),
        ):
            field(self.form, text, widget)
        self.plan.setCurrentIndex(0)
        self.finish()
        self.speeds.textChanged.connect(self.summarise)

    @property
    def of_the_plan(self) -> tuple[QWidget, ...]:
        """Return speeds and orders."""
        return (self.speeds, self.orders)

    def show_settings(self) -> None:
        """Take the pin's name from the settings."""
        self.item.setText(self._given.pin.name)

    def stated(self) -> RunOutFile:
        """Return the settings with the pin's name."""
        pin = msgspec.structs.replace(self._given.pin, name=self.item.text().strip() or "pin")
        stated: RunOutFile = msgspec.structs.replace(self._given, pin=pin)
        return stated

    def wanted(self) -> RollPlan:
        """Return the plan that the fields say."""
        revolutions = REVOLUTIONS[self.plan.currentData()]
        return roll_plan(self.speeds.text(), revolutions, self.orders.value())

    def describe(self, plan: RollPlan) -> str:
        """Return what a plan means, in words."""
        text = f"The spindle turns for about {plan.seconds / 60.0:.0f} min."
        if len(plan.speeds) == 1:
            text += " With one speed only, what inertia adds to the run-out is not known."
        return text

    def validatePage(self) -> bool:
        """Take the test file, then begin or take up."""
        name = self.test.text().strip()
        live = self._live
        live.rig = replace(live.rig, test=Path(name) if name else None)
        return super().validatePage()


class RollingPage(QWizardPage):
    """Turn the spindle when the operator says so; tell how far it is; stop."""

    def __init__(self, live: RollingCalibration, theme: Theme) -> None:
        super().__init__()
        self._live = live
        self.setTitle("Slow rolls")
        self.setSubTitle(
            "Each roll is a test with all guards, and a file of its own. You can close the wizard:"
            " the roll under way goes on to its end, and the map can be taken up again."
        )
        self.instruction = sentence("roll_instruction", "What to do now", 1.5, bold=True)
        self.words = sentence("roll_words", "How far it is")
        self.progress = named(QProgressBar(), "roll_progress", "Progress of the rolls")
        self.progress.setTextVisible(False)
        self.roll = button("roll", "&Turn the spindle", live.roll)
        self.roll.setMinimumHeight(2 * self.roll.fontMetrics().height() + 8)
        self.stop = button("roll_stop", "&Stop the spindle", live.stop)
        self.problem = sentence("roll_problem", "What stands against it")
        buttons = row(self.roll, self.stop, None)
        shown = (self.instruction, self.words, self.progress, buttons, self.problem, None)
        filled(QVBoxLayout(self), shown)
        live.looked.connect(self._look)
        live.moved.connect(self._look)
        live.said.connect(self.problem.setText)

    def initializePage(self) -> None:
        """Offer to roll."""
        self._look()
        self.roll.setFocus()

    def isComplete(self) -> bool:
        """Tell whether every roll is recorded."""
        session = self._live.session
        return session is not None and bool(session.runs.done)

    def _look(self) -> None:
        session = self._live.session
        if session is None:
            return
        runs, rolling = session.runs, self._live.rolling
        told = "Is the follower on the pin, the bushing unworn, every hand away? Then begin."
        if runs.done:
            told = "All rolls are recorded."
        elif rolling:
            told = "The spindle turns. Keep your hands away."
        self.instruction.setText(told)
        self.words.setText(runs.words)
        self.progress.setRange(0, runs.planned)
        self.progress.setValue(runs.turned)
        self.roll.setEnabled(not rolling and not runs.done)
        self.stop.setEnabled(rolling)
        self.completeChanged.emit()
