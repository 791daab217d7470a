"""The calibration wizard: plan, angle reference, readings, result, certificate."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QWidget, QWizard

from rigapp.calibrating.live_calibration import Rig
from rigapp.gui.plots.palette import Theme
from rigapp.gui.wizard.angle_page import AnglePage
from rigapp.gui.wizard.bench import Bench
from rigapp.gui.wizard.hands_queue import Line
from rigapp.gui.wizard.plan_page import PlanPage
from rigapp.gui.wizard.readings_page import ReadingsPage
from rigapp.gui.wizard.result_pages import CertificatePage, ResultPage

BUTTONS = {
    QWizard.WizardButton.CommitButton: ("Begin &readings", "Begin readings"),
    QWizard.WizardButton.NextButton: ("&Next", "Next"),
    QWizard.WizardButton.BackButton: ("&Back", "Back"),
    QWizard.WizardButton.FinishButton: ("&Finish", "Finish"),
    QWizard.WizardButton.CancelButton: ("Close", "Close; all readings are kept"),
}


def dress(wizard: QWizard, name: str, what: str) -> None:
    """Give a wizard for the calibration of something its name, title and style."""
    wizard.setObjectName(name)
    wizard.setWindowTitle(f"Calibrate {what} – rigapp")
    wizard.setAccessibleName(f"Calibration of {what}")
    wizard.setWizardStyle(QWizard.WizardStyle.ClassicStyle)
    wizard.setOption(QWizard.WizardOption.NoBackButtonOnStartPage)
    wizard.setModal(False)


def name_buttons(wizard: QWizard) -> None:
    """Give the buttons of a wizard their words and names."""
    for which, (text, spoken) in BUTTONS.items():
        wizard.setButtonText(which, text)
        button = wizard.button(which)
        button.setObjectName(f"wizard_{spoken.partition(';')[0].lower().replace(' ', '_')}")
        button.setAccessibleName(spoken)


class CalibrationWizard(QWizard):
    """Guide through the calibration of the load cell. Closing loses no reading."""

    def __init__(
        self,
        line: Line,
        rig: Rig,
        theme: Theme,
        folder: Path,
        settings: Path | None = None,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        dress(self, "calibration_wizard", "the load cell")
        self.bench = Bench(line, rig)
        self.plan = PlanPage(self.bench, folder, settings)
        self.angle = AnglePage(self.bench, theme)
        self.readings = ReadingsPage(self.bench, theme)
        self.result_page = ResultPage(self.bench, theme, folder)
        self.certificate = CertificatePage(self.bench)
        for page in (
            self.plan,
            self.angle,
            self.readings,
            self.result_page,
            self.certificate,
        ):
            self.addPage(page)
        name_buttons(self)
        self.finished.connect(lambda _: self.bench.close())
        self.resize(QSize(1040, 820))
