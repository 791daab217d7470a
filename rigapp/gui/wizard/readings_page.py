"""Third page: what to hang next, whether it is steady, record; all readings and what is left."""

from __future__ import annotations

import math

from calibration.load_cell.plans import StepKind
from calibration.load_cell.procedure import Procedure
from rigapp.calibrating.practice import Mistake
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.bench import Bench
from rigapp.gui.wizard.hands_panel import HandsPanel
from rigapp.gui.wizard.parts import ResidualPlot
from rigapp.gui.wizard.taking_page import RECORD, TakingPage, TakingWords

WORDS = TakingWords(
    prefix="",
    progress="calibration_progress",
    live="Signals now",
    reject="Reject the selected reading and repeat its series",
    reason="Rea&son",
    columns=("Series", "Step", "Mass (kg)", "Angle (deg)", "Signal 1", "Signal 2", "State"),
)
BUTTON = {StepKind.TURN: "The pin is &turned", StepKind.PRELOAD: "The preload is d&one"}


class ReadingsPage(TakingPage):
    """Take all readings of the plan."""

    _bench: Bench

    def __init__(self, bench: Bench, theme: Theme) -> None:
        super().__init__(bench, theme, WORDS)
        self.plot = ResidualPlot(theme)
        self.hands = HandsPanel(bench, Mistake)
        self.lay_out(self.plot, self.hands)
        self.listen(bench.take, self._look, self._move)

    def initializePage(self) -> None:
        """Show what is there; Enter records."""
        self.hands.setVisible(self._bench.rig.simulated)
        self._move()
        self._look()
        self.record.setFocus()

    def _move(self) -> None:
        session = self._bench.session
        if session is None:
            return
        procedure = session.procedure
        record = None if procedure.done else BUTTON.get(procedure.step.kind, RECORD)
        self.show_step(procedure, procedure.instruction, record)
        for widget in (self.stability, self.record):
            widget.setVisible(not procedure.done)
        self.fill(procedure, lambda row: _cells(procedure, row))
        self.plot.show_session(session)
        self.completeChanged.emit()

    def _look(self) -> None:
        session = self._bench.session
        if session is None or not self.isVisible():
            return
        readiness = self.show_readiness(session.procedure)
        if readiness is None or math.isnan(readiness.felt):
            self.live.setText("")
            return
        one, two = readiness.steadiness.mean
        unit = session.given.cell.signal_unit
        text = f"Signals {one:+.5f}, {two:+.5f} {unit}: the cell feels {readiness.felt:.1f} N"
        expected = session.expected_force()
        if not session.procedure.done and session.procedure.step.kind is not StepKind.TURN:
            text += f"; what should hang weighs {expected:.1f} N"
        self.live.setText(text + ".")


def _cells(procedure: Procedure, row: int) -> tuple[str, ...]:
    """Return series, step, mass, angle and signals of a reading in words."""
    one = procedure.taken[row]
    step = procedure.steps[one.step]
    return (
        step.series,
        str(step.number),
        f"{one.mass:g}",
        f"{math.degrees(one.angle):.1f}",
        f"{one.signal[0]:+.5f}",
        f"{one.signal[1]:+.5f}",
    )
