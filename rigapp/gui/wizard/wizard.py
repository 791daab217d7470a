"""The calibration wizard: plan, angle reference, readings, result, certificate."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QWidget, QWizard, QWizardPage

from rigapp.calibrating.session import Rig
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.gui.language.words import Text, tr
from rigapp.gui.look.dress import dress_window
from rigapp.gui.look.tokens import Theme
from rigapp.gui.wizard.angle_page import AnglePage
from rigapp.gui.wizard.certificate_page import CertificatePage
from rigapp.gui.wizard.faces import FACES
from rigapp.gui.wizard.live_calibration import AskLater
from rigapp.gui.wizard.parts import ResidualPlot, prefix_of
from rigapp.gui.wizard.plan_page import PlanPage
from rigapp.gui.wizard.result_page import ResultPage

BUTTONS: dict[QWizard.WizardButton, tuple[Text, Text]] = {
    QWizard.WizardButton.CommitButton: ("Begin &readings", "Begin readings"),
    QWizard.WizardButton.NextButton: ("&Next", "Next"),
    QWizard.WizardButton.BackButton: ("&Back", "Back"),
    QWizard.WizardButton.FinishButton: ("&Finish", "Finish"),
    QWizard.WizardButton.CancelButton: ("Close", "Close; all readings are kept"),
}


class CalibrationWizard(QWizard):
    """Guide through the calibration of a subject. Closing loses no reading."""

    def __init__(
        self,
        line: AskLater,
        rig: Rig,
        theme: Theme,
        folder: Path,
        settings: Path | None = None,
        parent: QWidget | None = None,
        *,
        subject: str = "load cell",
        which: str = "",
    ) -> None:
        """Make the pages of a subject; which: of several things of it."""
        super().__init__(parent)
        of, face = SUBJECTS[subject], FACES[subject]
        session: Any = face.session or of.session
        assert of.place is not None
        assert of.plan is not None
        stem, prefix = face.asks.stem, prefix_of(face.asks.stem)
        self.setObjectName(f"{stem}_wizard")
        self.setWindowTitle(tr("Calibrate {} – rigapp", tr(face.what)))
        self.setAccessibleName(tr("Calibration of {}", tr(face.what)))
        self.setWizardStyle(QWizard.WizardStyle.ClassicStyle)
        self.setOption(QWizard.WizardOption.NoBackButtonOnStartPage)
        self.setModal(False)
        dress_window(self, theme)
        self.live = face.live(line, rig, session)
        self.plan = PlanPage(self.live, folder, settings, face.asks, of.plan, which)
        self.angle = AnglePage(self.live, theme) if face.angle else None
        self.readings: Any = face.readings(self.live, theme)
        plot = ResidualPlot(theme, face.plot) if face.fitted else None
        self.result_page = ResultPage(self.live, theme, folder, prefix, plot)
        self.certificate = CertificatePage(self.live, prefix, of.place)
        before: list[QWizardPage] = [self.plan] if self.angle is None else [self.plan, self.angle]
        before[-1].setCommitPage(True)
        for page in (*before, self.readings, self.result_page, self.certificate):
            self.addPage(page)
        for button, (text, spoken) in BUTTONS.items():
            self.setButtonText(button, tr(text))
            widget = self.button(button)
            widget.setObjectName(f"wizard_{spoken.partition(';')[0].lower().replace(' ', '_')}")
            widget.setAccessibleName(tr(spoken))
        self.finished.connect(lambda _: self.live.close())
        self.resize(QSize(1040, 820))
