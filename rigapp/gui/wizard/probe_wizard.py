"""The wizard for the probes: plan, readings, result, certificate."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QWidget, QWizard

from rigapp.calibrating.live_calibration import Rig
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.hands_queue import Line
from rigapp.gui.wizard.probe_bench import ProbeBench
from rigapp.gui.wizard.probe_plan_page import ProbePlanPage
from rigapp.gui.wizard.probe_readings_page import ProbeReadingsPage
from rigapp.gui.wizard.probe_result_pages import ProbeCertificatePage, ProbeResultPage
from rigapp.gui.wizard.wizard import dress, name_buttons


class ProbeWizard(QWizard):
    """Guide through the calibration of one or both probes. Closing loses no reading."""

    def __init__(
        self,
        line: Line,
        rig: Rig,
        theme: Theme,
        folder: Path,
        probe: str = "both",
        settings: Path | None = None,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        dress(self, "probe_wizard", "the probes")
        self.bench = ProbeBench(line, rig)
        self.plan = ProbePlanPage(self.bench, folder, probe, settings)
        self.plan.setCommitPage(True)
        self.readings = ProbeReadingsPage(self.bench, theme)
        self.result_page = ProbeResultPage(self.bench, theme)
        self.certificate = ProbeCertificatePage(self.bench)
        for page in (self.plan, self.readings, self.result_page, self.certificate):
            self.addPage(page)
        name_buttons(self)
        self.finished.connect(lambda _: self.bench.close())
        self.resize(QSize(1040, 820))
