"""The pages on which readings are taken: with weights, and with a micrometer."""

from __future__ import annotations

import math
from typing import Any

from PySide6.QtWidgets import QFormLayout

from calibration.taking.procedure import StepKind
from calibration.taking.signals import Readiness
from rigapp.gui.look.tokens import Theme
from rigapp.gui.wizard.hands_panel import HandsPanel
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.parts import field, load_cell_plot, number, probe_plot
from rigapp.gui.wizard.taking_page import TakingPage, TakingWords

WEIGHING = TakingWords(
    prefix="",
    progress="calibration_progress",
    live="Signals now",
    reject="Reject the selected reading and repeat its series",
    reason="Rea&son",
    columns=("Series", "Step", "Mass (kg)", "Angle (deg)", "Signal 1", "Signal 2", "State"),
    buttons={StepKind.SET_UP: "The pin is &turned", StepKind.PRELOAD: "The preload is d&one"},
)
MEASURING = TakingWords(
    prefix="probe_",
    progress="probe_progress",
    live="Voltages now",
    reject="Reject the selected reading, repeat its series",
    reason="Re&ason",
    columns=("Series", "Step", "Position (µm)", "Probe 1 (V)", "Probe 2 (V)", "State"),
    buttons={StepKind.SET_UP: "The &target stands before the probe"},
)


class LoadCellReadingsPage(TakingPage):
    """What to hang next, whether it is steady, record; all readings and what is left."""

    def __init__(self, live: LiveCalibration, theme: Theme) -> None:
        super().__init__(live, theme, WEIGHING, load_cell_plot(theme))
        self.lay_out(HandsPanel(live))

    def live_words(self, readiness: Readiness) -> str:
        """Return signals, the force that is felt and the one that should hang."""
        session = self.live_calibration.session
        one, two = readiness.steadiness.mean
        unit = session.given.cell.signal_unit
        text = f"Signals {one:+.5f}, {two:+.5f} {unit}: the cell feels {readiness.felt:.1f} N"
        procedure = session.procedure
        if not procedure.done and procedure.step.kind is not StepKind.SET_UP:
            text += f"; what should hang weighs {session.expected_force():.1f} N"
        return text + "."

    def cells(self, reading: Any) -> tuple[str, ...]:
        """Return mass and angle of a reading in words."""
        return (f"{reading.value:g}", f"{math.degrees(reading.place):.1f}")


class ProbeReadingsPage(TakingPage):
    """Where to turn the micrometer, whether it is steady, record."""

    def __init__(self, live: LiveCalibration, theme: Theme) -> None:
        super().__init__(live, theme, MEASURING, probe_plot(theme))
        spoken = "Position that the micrometer shows"
        self.shown = number("probe_shown", spoken, -20000.0, 20000.0, 1, 1.0, "µm")
        form = QFormLayout()
        field(form, "Micrometer &shows", self.shown)
        self.lay_out(HandsPanel(live, "probe_hands", "T&urn the micrometer"), form)

    def read_off(self) -> float | None:
        """Return what the micrometer shows, m."""
        self.shown.interpretText()
        return 1e-6 * self.shown.value()

    def show_step(self) -> None:
        """Show the step under way and offer its position."""
        super().show_step()
        procedure = self.live_calibration.session.procedure
        reading = not procedure.done and procedure.step.kind is StepKind.READING
        if not procedure.done:
            self.shown.setValue(1e6 * procedure.step.value)
        self.shown.setEnabled(reading)

    def live_words(self, readiness: Readiness) -> str:
        """Return the voltages and where the probe stands."""
        procedure = self.live_calibration.session.procedure
        if procedure.done:
            return ""
        one, two = readiness.steadiness.mean
        return (
            f"Probe 1 {one:+.4f} V, probe 2 {two:+.4f} V. By the calibration in use probe"
            f" {procedure.step.set_up:g} stands at {1e6 * readiness.felt:+.1f} µm."
        )

    def cells(self, reading: Any) -> tuple[str, ...]:
        """Return the position of a reading in words."""
        return (f"{1e6 * reading.value:.1f}",)
