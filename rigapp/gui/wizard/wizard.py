"""The calibration wizard: plan, angle reference, readings, result, certificate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import QMargins, QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QWidget, QWizard

from rigapp.calibrating.session import Rig
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.gui.look.dress import dress_part
from rigapp.gui.widgets.build import column, named, prose, set_property
from rigapp.gui.widgets.steps import ShownStep, StepRow
from rigapp.gui.wizard.guide_page import GuidePage
from rigapp.gui.wizard.live_calibration import AskLater
from rigapp.gui.wizard.pages import SUBJECT_VIEWS, AnglePage
from rigapp.gui.wizard.plan_page import PlanPage
from rigapp.gui.wizard.result_page import CertificatePage, ChartPlot, ResultPage
from rigapp.gui.wizard.scenes import Picture
from rigapp.gui.wizard.widgets import ResidualPlot, Sign, prefix_of
from rigapp.presentation.tokens import MARGIN, STEP, TIGHT_WIDTH, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.texts import capitalised

WIDTH = 26 * STEP


class StepsColumn(QFrame):
    """Column with calibration type, steps, and the note that closing loses nothing."""

    def __init__(self, title: str, count: int, theme: Theme) -> None:
        """Make the column; title: calibration type, count: number of steps."""
        super().__init__()
        named(self, "wizard_steps", "Steps of the calibration").setProperty("role", "card")
        self._theme = theme
        self.setFixedWidth(WIDTH)
        what = prose("wizard_what", "What is calibrated")
        what.setText(title)
        what.setProperty("role", "title")
        self.rows = [StepRow("wizard", number) for number in range(count)]
        kept: Text = (
            "Every reading is saved when it is taken. You can close now and continue tomorrow."
        )
        note = prose("wizard_kept", "What is kept", kept)
        note.setProperty("role", "caption")
        layout = column(what, *self.rows, None, note, on=self)
        layout.setContentsMargins(MARGIN, MARGIN, MARGIN, MARGIN)
        layout.setSpacing(2 * STEP)
        self._shown: tuple[ShownStep, ...] = ()

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self.show_steps(self._shown)

    def show_steps(self, steps: Sequence[ShownStep]) -> None:
        """Show the steps."""
        self._shown = tuple(steps)
        for line, step in zip(self.rows, steps, strict=False):
            line.show_step(step, self._theme)


FORWARD = (
    QWizard.WizardButton.NextButton,
    QWizard.WizardButton.CommitButton,
    QWizard.WizardButton.FinishButton,
)
"""Buttons to the next page, which are primary on a complete page."""

SPACE = QWizard.WizardButton.Stretch

ORDER = (
    QWizard.WizardButton.BackButton,
    SPACE,
    QWizard.WizardButton.CancelButton,
    QWizard.WizardButton.CustomButton1,
    QWizard.WizardButton.CustomButton2,
    *FORWARD,
)
"""Order of the wizard's buttons, visible at any height; the forward buttons are the last."""

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
        fields: Mapping[str, str] | None = None,
        key: str = "",
    ) -> None:
        """Make the pages of a subject; fields: initial values of the first page.

        key: of the calibration that occupies the rig for this wizard; its end releases the rig.
        """
        super().__init__(parent)
        of, face = SUBJECTS[subject], SUBJECT_VIEWS[subject]
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
        self.live = face.live(line, rig, session)
        self.live.key = key
        self._held: QWidget | None = None
        self.live.evaluated.connect(self._hold_focus)
        self.plan = PlanPage(
            self.live, folder, settings, face.asks, of.plan, face.sketch, theme, fields
        )
        self.angle = AnglePage(self.live, theme) if face.angle else None
        self.readings: Any = face.readings(self.live, theme)
        plot = ResidualPlot(theme, face.plot) if face.fitted else None
        self.result_page = ResultPage(self.live, theme, folder, prefix, plot)
        self.certificate = CertificatePage(self.live, prefix, of.place)
        before: list[GuidePage] = [self.plan] if self.angle is None else [self.plan, self.angle]
        before[-1].setCommitPage(True)
        self._pages: tuple[GuidePage, ...] = (
            *before,
            self.readings,
            self.result_page,
            self.certificate,
        )
        self.steps = StepsColumn(
            capitalised(tr("Calibrate {}", tr(face.what))), len(self._pages), theme
        )
        self.setSideWidget(self.steps)
        for page in self._pages:
            page.completeChanged.connect(self._hold_focus)
            self.addPage(page)
            page.completeChanged.connect(self._mark)
        for button, (text, spoken) in BUTTONS.items():
            self.setButtonText(button, tr(text))
            widget = self.button(button)
            widget.setObjectName(f"wizard_{spoken.partition(';')[0].lower().replace(' ', '_')}")
            widget.setAccessibleName(tr(spoken))
        for button, (own, _) in zip(ORDER[3:5], self.readings.foot(), strict=True):
            self.setButton(button, own)
        self.setButtonLayout(ORDER)
        self.currentIdChanged.connect(self._mark)
        self.currentIdChanged.connect(self._make_room)
        self.currentIdChanged.connect(self._begin_page)
        self.live.moved.connect(self._mark)
        self.finished.connect(lambda _: self.live.close())
        if parent is None:  # else it is themed where it is shown, once
            dress_part(self, theme)
        self.resize(QSize(1040, 820))

    def parts(self) -> list[QWidget]:
        """Return the parts themed one by one; a style sheet on the wizard would hide its page."""
        buttons = [self.button(button) for button in ORDER if button is not SPACE]
        return [self.steps, *self._pages, *buttons]

    def dress(self, theme: Theme) -> None:
        """Set the colours of steps, pictures and plots, also of later ones."""
        self.result_page.theme = theme
        parts: list[Any] = [self.steps, *self.findChildren(Picture), *self.findChildren(Sign)]
        plots = (*self.findChildren(ResidualPlot), *self.findChildren(ChartPlot))
        for part in (*parts, *plots):
            part.dress(theme)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide the steps where the wizard is narrow."""
        super().resizeEvent(event)
        self._make_room()

    def _make_room(self) -> None:
        """Fit steps and page to the size of the wizard."""
        alone = self.width() < TIGHT_WIDTH - WIDTH
        # Qt keeps margins around hidden widgets.
        side: Any = self.steps.parentWidget()
        side.setVisible(not alone)
        for frame in (side, side.parentWidget()):
            frame.layout().setContentsMargins(QMargins())
        side_width = 0 if alone else WIDTH
        for page in self._pages:
            page.make_room(self.width() - side_width, self.height(), alone=alone)

    def _begin_page(self) -> None:
        """Give the focus to the page, and set the texts of the buttons for the readings.

        Qt hides all pages while it changes them, so that the focus leaves the wizard, and resets
        the texts of buttons.
        """
        page = self.currentPage()
        if isinstance(page, GuidePage):
            self.live.moved.emit()
            page.take_focus()
            self._mark()

    def _hold_focus(self) -> None:
        """Store the focused widget before Qt hides and shows it again."""
        widget = self.focusWidget()
        if widget is not None and widget.hasFocus():
            self._held = widget

    def _mark(self) -> None:
        """Mark the forward buttons, and the present step in the column."""
        page = self.currentPage()
        if not isinstance(page, GuidePage):
            return
        held, self._held = self._held, None
        if held is not None:
            held.setFocus()
        for button, wanted in self.readings.foot():
            left = button.hasFocus()
            button.setVisible(wanted and page is self.readings)
            if left and button.isHidden():
                page.setFocus()
        for kind in FORWARD:
            set_property(self.button(kind), "rank", "primary" if page.isComplete() else "")
            self.button(kind).updateGeometry()
        if self.readings.foot()[-1][1] and page is self.readings:
            self.button(QWizard.WizardButton.NextButton).hide()
        if page.isComplete() and page.hasFocus():
            next(button for button in map(self.button, FORWARD) if not button.isHidden()).setFocus()
        here = self._pages.index(page)
        self.steps.show_steps(
            [
                ShownStep(other.step, self._line(other), index < here, index == here)
                for index, other in enumerate(self._pages)
            ]
        )

    def _line(self, page: GuidePage) -> str:
        """Return the progress of the readings as text, empty for other pages."""
        session = self.live.session
        if page is not self.readings or session is None:
            return ""
        return str(page.progress_words())
