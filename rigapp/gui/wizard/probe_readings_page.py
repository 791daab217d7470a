"""Second page for probes: where to turn the micrometer, whether it is steady, record."""

from __future__ import annotations

import math

from PySide6.QtWidgets import QFormLayout

from calibration.probes.procedure import ProbeProcedure, ProbeStepKind
from rigapp.calibrating.probe_practice import ProbeMistake
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.hands_panel import HandsPanel
from rigapp.gui.wizard.parts import field, named, number
from rigapp.gui.wizard.probe_bench import ProbeBench
from rigapp.gui.wizard.probe_parts import ProbeResidualPlot
from rigapp.gui.wizard.taking_page import RECORD, TakingPage, TakingWords

WORDS = TakingWords(
    prefix="probe_",
    progress="probe_progress",
    live="Voltages now",
    reject="Reject the selected reading, repeat its series",
    reason="Re&ason",
    columns=("Series", "Step", "Position (µm)", "Probe 1 (V)", "Probe 2 (V)", "State"),
)
BUTTON = {
    ProbeStepKind.MOUNT: "The &target stands before the probe",
    ProbeStepKind.READING: RECORD,
}


class ProbeReadingsPage(TakingPage):
    """Take all readings of the plan."""

    _bench: ProbeBench

    def __init__(self, bench: ProbeBench, theme: Theme) -> None:
        super().__init__(bench, theme, WORDS)
        self.shown = number(-20000.0, 20000.0, 1, 1.0, "µm")
        named(self.shown, "probe_shown", "Position that the micrometer shows, micrometres")
        self.plot = ProbeResidualPlot(theme)
        self.hands = HandsPanel(bench, ProbeMistake, "probe_hands", "T&urn the micrometer")
        form = QFormLayout()
        field(form, "Micrometer &shows", self.shown)
        self.lay_out(self.plot, self.hands, form)
        self.listen(self._take, self._look, self._move)

    def initializePage(self) -> None:
        """Show the step under way, with the focus where it records."""
        self.hands.setVisible(self._bench.rig.simulated)
        self._move()
        self._look()
        self.record.setFocus()

    def _take(self) -> None:
        self.shown.interpretText()
        self._bench.take(1e-6 * self.shown.value())

    def _move(self) -> None:
        session = self._bench.session
        if session is None:
            return
        procedure = session.procedure
        record = None if procedure.done else BUTTON[procedure.step.kind]
        self.show_step(procedure, procedure.instruction.replace(" um", " µm"), record)
        if procedure.done:
            self.shown.setEnabled(False)
        else:
            self.shown.setValue(1e6 * procedure.step.position)
            self.shown.setEnabled(procedure.step.kind is ProbeStepKind.READING)
        self.fill(procedure, lambda row: _cells(procedure, row))
        self.plot.show_session(session)
        self.completeChanged.emit()

    def _look(self) -> None:
        session = self._bench.session
        if session is None or not self.isVisible():
            return
        readiness = self.show_readiness(session.procedure)
        if readiness is None or math.isnan(readiness.felt) or session.procedure.done:
            self.live.setText("")
            return
        one, two = readiness.steadiness.mean
        step = session.procedure.step
        self.live.setText(
            f"Probe 1 {one:+.4f} V, probe 2 {two:+.4f} V. By the calibration in use probe"
            f" {step.probe} stands at {1e6 * readiness.felt:+.1f} µm."
        )


def _cells(procedure: ProbeProcedure, row: int) -> tuple[str, ...]:
    """Return series, step, position and voltages of a reading in words."""
    one = procedure.taken[row]
    step = procedure.steps[one.step]
    return (
        step.series,
        str(step.number),
        f"{1e6 * one.position:.1f}",
        f"{one.signal[0]:+.5f}",
        f"{one.signal[1]:+.5f}",
    )
