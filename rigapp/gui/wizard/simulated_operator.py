"""Simulated operator: training of a calibration on a simulated rig, mistakes included."""

from __future__ import annotations

from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.gui.widgets.build import button, choice, named, row
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, tr


class SimulatedOperatorPanel(QFrame):
    """Perform a step or all further steps, optionally with a mistake."""

    def __init__(
        self, live: LiveCalibration, name: str = "hands", do: Text = "&Do this step"
    ) -> None:
        """Set the calibration; name: of the widgets; do: text of the button."""
        super().__init__()
        self._live = live
        named(self, name, "Simulated operator").setProperty("role", "card")
        title = QLabel(tr("Simulated operator"))
        title.setProperty("role", "title")
        title.setToolTip(tr("Training mode: no waiting times"))
        spoken: Text = "Let the simulated operator do this step"
        self.do = button(f"{name}_do", do, live.perform_step, spoken)
        all_steps: Text = "Do and record all further steps"
        self.ahead = button(f"{name}_ahead", "Go a&head", self._ahead, all_steps, checkable=True)
        mistakes = live.practice.mistakes
        self.mistake = choice(
            f"{name}_mistake",
            "Mistake to simulate",
            ((str(kind), kind) for kind in mistakes),
            lambda _: live.plant(mistakes(self.mistake.currentData())),
        )
        mistake = QWidget()
        row(None, "&Mistake", self.mistake, on=mistake).setContentsMargins(0, 0, 0, 0)
        tools = flowing(title, self.do, self.ahead, (mistake, 1))
        row(tools, on=self).setContentsMargins(GAP, STEP, GAP, STEP)
        live.looked.connect(self._show)

    def _ahead(self, on: bool) -> None:
        self._live.goes_ahead = on

    def _show(self) -> None:
        if not self.isVisible():
            return
        live = self._live
        self.do.setEnabled(not live.hands_busy and not live.goes_ahead)
        if self.ahead.isChecked() != live.goes_ahead:
            self.ahead.setChecked(live.goes_ahead)
        index = self.mistake.findData(str(live.mistake))
        if index != self.mistake.currentIndex():
            self.mistake.setCurrentIndex(index)
