"""First page: which plan, which weights, where they hang; begin anew or take up."""

from __future__ import annotations

from pathlib import Path

import msgspec
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWizardPage,
)

from calibration.load_cell.plans import make_plan, time_needed
from rigapp.calibrating.live_calibration import PLANS, Wish, heaviest_load, parse_pieces
from rigapp.config.calibration_settings import (
    CellSection,
    LoadCellFile,
    load_cell_meaning,
    read_load_cell_settings,
)
from rigapp.config.errors import UnusableInput
from rigapp.gui.wizard.bench import Bench
from rigapp.gui.wizard.parts import field, named, number, prose
from rigapp.gui.wizard.plan_parts import (
    choose_settings,
    chosen_journal,
    offer_journals,
    settings_row,
)

WORDS = {
    "daily": "Daily check: one weight at 4 pin angles",
    "routine": "Routine: 4 pin angles, 5 loads up and down",
    "full": "Full: 12 pin angles, 10 loads up and down",
}
ROUNDED_GRAVITY = 9.81
NEW = "Begin a new calibration"
JOURNALS = "calibration"


class PlanPage(QWizardPage):
    """Choose plan and weights, or a calibration to take up."""

    def __init__(self, bench: Bench, folder: Path, settings: Path | None) -> None:
        super().__init__()
        self._bench, self._folder = bench, folder
        self._given = LoadCellFile(schema=1, cell=CellSection(name="Load cell"))
        self.setTitle("Plan and weights")
        self.setSubTitle(
            "Every reading is saved at once. You can close the wizard at any time and take the"
            " calibration up again."
        )
        self.begin = QComboBox()
        named(self.begin, "calibration_begin", "Begin or take up")
        self.settings = QLineEdit(str(settings) if settings is not None else "")
        self.settings.setPlaceholderText("none: the fields below are enough")
        named(self.settings, "calibration_settings", "Settings file of the calibration")
        self.browse = QPushButton("Bro&wse…")
        named(self.browse, "calibration_browse", "Choose a settings file")
        self.cell = QLineEdit(self._given.cell.name)
        named(self.cell, "calibration_cell", "Name of the load cell")
        self.plan = QComboBox()
        for key, words in WORDS.items():
            self.plan.addItem(words, key)
        self.plan.setCurrentIndex(1)
        named(self.plan, "calibration_plan", "Plan")
        self.weights = QLineEdit("5x8, 2, 2, 1, 0.5")
        named(self.weights, "calibration_weights", "Weights, kilograms; 5x8 are eight of 5 kg")
        self.hanger = number(0.0, 20.0, 4, 0.1, "kg")
        named(self.hanger, "calibration_hanger", "Mass of the hanger, kilograms")
        self.gravity = number(9.76, 9.84, 5, 0.0001, "m/s²")
        self.gravity.setValue(ROUNDED_GRAVITY)
        named(self.gravity, "calibration_gravity", "Local gravity, metres per second squared")
        self.operator = QLineEdit(bench.rig.operator)
        named(self.operator, "calibration_operator", "Operator")
        self.summary = prose("calibration_summary", "What this means")
        self.problem = prose("plan_problem", "What is wrong on this page")
        self._build()
        self.read_settings()

    def _build(self) -> None:
        form = QFormLayout()
        field(form, "&Begin or take up", self.begin)
        settings_row(form, self.settings, self.browse)
        field(form, "&Load cell", self.cell)
        field(form, "&Plan", self.plan)
        field(form, "W&eights (kg)", self.weights)
        field(form, "&Hanger", self.hanger)
        field(form, "Local &gravity", self.gravity)
        field(form, "&Operator", self.operator)
        column = QVBoxLayout(self)
        column.addLayout(form)
        column.addWidget(self.summary)
        column.addStretch(1)
        column.addWidget(self.problem)
        self.plan.currentIndexChanged.connect(self._summarise)
        self.weights.textChanged.connect(self._summarise)
        self.hanger.valueChanged.connect(self._summarise)
        self.gravity.valueChanged.connect(self._summarise)
        self.begin.currentIndexChanged.connect(self._summarise)
        self.settings.editingFinished.connect(self.read_settings)
        self.browse.clicked.connect(self._browse)

    def initializePage(self) -> None:
        """Offer what can be taken up."""
        offer_journals(self.begin, NEW, self._folder, JOURNALS)
        self._summarise()

    def validatePage(self) -> bool:
        """Begin or take up; what is wrong is said below, with the focus where it is."""
        for box in (self.hanger, self.gravity):
            box.interpretText()
        try:
            journal = chosen_journal(self.begin, self._folder, JOURNALS)
            self._bench.open(self._settings(), journal, self._wish())
        except UnusableInput as error:
            self.problem.setText(str(error))
            self.weights.setFocus()
            return False
        self.problem.clear()
        return True

    def read_settings(self) -> None:
        """Take the fields from the settings file, if one is named."""
        name = self.settings.text().strip()
        if not name:
            return
        try:
            self._given, meaning = read_load_cell_settings(Path(name))
        except UnusableInput as error:
            self.problem.setText(str(error))
            return
        self.problem.clear()
        self.cell.setText(self._given.cell.name)
        self.hanger.setValue(meaning.weights.hanger_mass)
        self.gravity.setValue(meaning.place.gravity)
        self.operator.setText(self._given.paperwork.operator or self.operator.text())
        self._summarise()

    def _settings(self) -> LoadCellFile:
        given, replace = self._given, msgspec.structs.replace
        place = given.place
        if place.gravity_m_s2 is not None or place.latitude_deg is None:
            place = replace(place, gravity_m_s2=self.gravity.value())
        return replace(
            given,
            cell=replace(given.cell, name=self.cell.text().strip() or "Load cell"),
            weights=replace(given.weights, hanger_mass_kg=self.hanger.value()),
            place=place,
            paperwork=replace(given.paperwork, operator=self.operator.text().strip()),
        )

    def _wish(self) -> Wish | None:
        if self.begin.currentData():
            return None
        return Wish(PLANS[self.plan.currentData()], parse_pieces(self.weights.text()))

    def _summarise(self) -> None:
        anew = not self.begin.currentData()
        for widget in (self.plan, self.weights):
            widget.setEnabled(anew)
        if not anew:
            self.summary.setText("Plan, weights and all readings are those of the journal.")
            return
        try:
            pieces = parse_pieces(self.weights.text())
            settings = load_cell_meaning(self._settings(), "settings")
            heaviest = heaviest_load(pieces, settings)
            steps = make_plan(PLANS[self.plan.currentData()], heaviest, pieces)
        except (UnusableInput, ValueError) as error:
            self.summary.setText(str(error))
            return
        most = max(step.mass for step in steps)
        readings = sum(1 for step in steps if step.series)
        hours, minutes = divmod(round(time_needed(steps) / 60.0), 60)
        needed = f"{hours} h {minutes} min" if hours else f"{minutes} min"
        text = (
            f"{len(pieces)} pieces, {sum(pieces):g} kg in all. The heaviest load is {most:g} kg;"
            f" {readings} readings, about {needed}."
        )
        if settings.gravity_stated and abs(self.gravity.value() - ROUNDED_GRAVITY) < 1e-6:
            text += (
                "\n9.81 m/s² is a rounded value, up to 0.3 % off: write the gravity of this place,"
                " or name a settings file with latitude and height."
            )
        self.summary.setText(text)

    def _browse(self) -> None:
        choose_settings(self, "choose_calibration_settings", self._chosen)

    def _chosen(self, name: str) -> None:
        self.settings.setText(name)
        self.read_settings()
