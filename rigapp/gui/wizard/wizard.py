"""The calibration wizard: plan, angle reference, readings, result, certificate."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QWidget, QWizard, QWizardPage

from rigapp.calibrating.rolls import RollSession
from rigapp.calibrating.session import Rig
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.gui.look.tokens import Theme
from rigapp.gui.wizard.angle_page import AnglePage
from rigapp.gui.wizard.certificate_page import CertificatePage
from rigapp.gui.wizard.hands_queue import AskLater
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.parts import ResidualPlot, probe_plot, run_out_plot
from rigapp.gui.wizard.plan_page import LoadCellPlanPage, PlanPage, ProbePlanPage
from rigapp.gui.wizard.readings_page import LoadCellReadingsPage, ProbeReadingsPage
from rigapp.gui.wizard.result_page import ResultPage
from rigapp.gui.wizard.rolling_page import RollingCalibration, RollingPage, RollPlanPage
from rigapp.gui.wizard.taking_page import TakingPage

BUTTONS = {
    QWizard.WizardButton.CommitButton: ("Begin &readings", "Begin readings"),
    QWizard.WizardButton.NextButton: ("&Next", "Next"),
    QWizard.WizardButton.BackButton: ("&Back", "Back"),
    QWizard.WizardButton.FinishButton: ("&Finish", "Finish"),
    QWizard.WizardButton.CancelButton: ("Close", "Close; all readings are kept"),
}


PlanMaker = Callable[[LiveCalibration, Path, Path | None, str], PlanPage]


@dataclass(frozen=True, slots=True)
class SubjectPages:
    """The pages of a subject of ``SUBJECTS``.

    name: of the wizard; what: in its title; prefix: of the widgets' names. plan (calibration,
    folder, settings file, which of several), readings, and angle if there is an angle reference;
    plot: of the residuals beside the result, if there is one. session: where it has no steps.
    live: what listens to the engine for the pages.
    """

    name: str
    what: str
    prefix: str
    plan: PlanMaker
    readings: Callable[[Any, Theme], TakingPage | RollingPage]
    angle: Callable[[LiveCalibration, Theme], AnglePage] | None = None
    plot: Callable[[Theme], ResidualPlot] | None = None
    session: type[RollSession] | None = None
    live: type[LiveCalibration] = LiveCalibration


PAGES = {
    "load cell": SubjectPages(
        name="calibration_wizard",
        what="the load cell",
        prefix="",
        plan=lambda live, folder, settings, _: LoadCellPlanPage(live, folder, settings),
        readings=LoadCellReadingsPage,
        angle=AnglePage,
    ),
    "probes": SubjectPages(
        name="probe_wizard",
        what="the probes",
        prefix="probe_",
        plan=ProbePlanPage,
        readings=ProbeReadingsPage,
        plot=probe_plot,
    ),
    "run-out": SubjectPages(
        name="run_out_wizard",
        what="the pin's run-out",
        prefix="run_out_",
        plan=lambda live, folder, settings, _: RollPlanPage(live, folder, settings),
        readings=RollingPage,
        plot=run_out_plot,
        session=RollSession,
        live=RollingCalibration,
    ),
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
        of, pages = SUBJECTS[subject], PAGES[subject]
        session: Any = pages.session or of.session
        assert of.place is not None
        self.setObjectName(pages.name)
        self.setWindowTitle(f"Calibrate {pages.what} – rigapp")
        self.setAccessibleName(f"Calibration of {pages.what}")
        self.setWizardStyle(QWizard.WizardStyle.ClassicStyle)
        self.setOption(QWizard.WizardOption.NoBackButtonOnStartPage)
        self.setModal(False)
        self.live = pages.live(line, rig, session)
        self.plan = pages.plan(self.live, folder, settings, which)
        self.angle = None if pages.angle is None else pages.angle(self.live, theme)
        self.readings: Any = pages.readings(self.live, theme)
        plot = None if pages.plot is None else pages.plot(theme)
        self.result_page = ResultPage(self.live, theme, folder, pages.prefix, plot)
        self.certificate = CertificatePage(self.live, pages.prefix, of.place)
        before: list[QWizardPage] = [self.plan] if self.angle is None else [self.plan, self.angle]
        before[-1].setCommitPage(True)
        for page in (*before, self.readings, self.result_page, self.certificate):
            self.addPage(page)
        for button, (text, spoken) in BUTTONS.items():
            self.setButtonText(button, text)
            widget = self.button(button)
            widget.setObjectName(f"wizard_{spoken.partition(';')[0].lower().replace(' ', '_')}")
            widget.setAccessibleName(spoken)
        self.finished.connect(lambda _: self.live.close())
        self.resize(QSize(1040, 820))
