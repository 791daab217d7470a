"""First page: which plan, with what, for which item; begin anew or take up."""

from __future__ import annotations

import time
from abc import abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QFileDialog,
    QFormLayout,
    QLabel,
    QVBoxLayout,
    QWidget,
    QWizardPage,
)

from calibration.load_cell.plans import LoadCellPlan
from calibration.load_cell.plausible import GRAVITY
from calibration.probes.plans import ProbePlan
from calibration.probes.readings import FEWEST_POSITIONS
from calibration.taking.procedure import duration_words
from rigapp.calibrating.load_cell_session import load_cell_plan
from rigapp.calibrating.probe_session import PROBES, probe_plan, usual_reach_um
from rigapp.config.calibration_settings import (
    CalibrationFile,
    CellSection,
    LoadCellFile,
    ProbeFile,
    load_cell_meaning,
)
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document
from rigapp.gui.widgets.build import button, choice, edit, filled, row, whole_number
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.parts import field, number, sentence

NEW = "Begin a new calibration"
MOST_POSITIONS = 41
"""More than an operator takes at a window; the command line takes more."""
ROUNDED_GRAVITY = 9.81


class PlanPage(QWizardPage):
    """Choose plan and settings, or a calibration to take up; a subject adds its own fields."""

    def __init__(
        self,
        live: LiveCalibration,
        folder: Path,
        settings: Path | None,
        given: CalibrationFile,
        *,
        stem: str,
        journals: str,
        plans: Mapping[str, str],
        item: tuple[str, str],
    ) -> None:
        """Make what all plans have.

        given: the settings without a file. stem: of the widgets' names; journals: of the files in
        ``folder``; plans: word -> what it is; item: name of the widget's and read aloud, of what is
        calibrated.
        """
        super().__init__()
        self._live, self._folder, self._journals = live, folder, journals
        self._given: Any = given
        self._stem = stem
        self.begin = choice(f"{stem}_begin", "Begin or take up", (), self.summarise)
        spoken, hint = "Settings file of the calibration", "none: the fields below are enough"
        self.settings = edit(f"{stem}_settings", spoken, hint=hint)
        self.settings.setText(str(settings) if settings is not None else "")
        spoken = "Choose a settings file"
        self.browse = button(f"{stem}_browse", "Bro&wse…", self._browse, spoken)
        self.item = edit(f"{stem}_{item[0]}", item[1])
        items = ((text, word) for word, text in plans.items())
        self.plan = choice(f"{stem}_plan", "Plan", items)
        self.plan.setCurrentIndex(1)
        self.operator = edit(f"{stem}_operator", "Operator")
        self.operator.setText(live.rig.operator)
        self.summary = sentence(f"{stem}_summary", "What this means")
        problem = "plan_problem" if stem == "calibration" else f"{stem}_plan_problem"
        self.problem = sentence(problem, "What is wrong on this page")
        self.form = QFormLayout()
        field(self.form, "&Begin or take up", self.begin)
        label = QLabel("&Settings file")
        label.setBuddy(self.settings)
        self.form.addRow(label, row((self.settings, 1), self.browse))
        filled(QVBoxLayout(self), (self.form, self.summary, None, self.problem))
        self.plan.currentIndexChanged.connect(self.summarise)
        self.settings.editingFinished.connect(self.read_settings)

    def finish(self) -> None:
        """Add the last row and take the settings; a subject has added its fields."""
        field(self.form, "&Operator", self.operator)
        self.show_settings()
        self.read_settings()

    # --- what a subject says ---------------------------------------------------------------------

    @property
    @abstractmethod
    def of_the_plan(self) -> tuple[QWidget, ...]:
        """Return the fields that a journal has decided already; the first is the likely culprit."""

    @abstractmethod
    def show_settings(self) -> None:
        """Take the fields from the settings."""

    @abstractmethod
    def stated(self) -> Any:
        """Return the settings with what the fields say, the operator aside."""

    @abstractmethod
    def wanted(self) -> Any:
        """Return the plan that the fields say; raise UnusableInput or ValueError."""

    @abstractmethod
    def describe(self, plan: Any) -> str:
        """Return what a plan means, in words."""

    # --- the page --------------------------------------------------------------------------------

    def initializePage(self) -> None:
        """Offer a new calibration and every journal without a record, the newest first."""
        self.begin.clear()
        self.begin.addItem(NEW, None)
        for path in sorted(self._folder.glob(f"{self._journals}-*.journal"), reverse=True):
            if not path.with_suffix(".json").exists():
                self.begin.addItem(f"Take up {path.stem}", str(path))
        self.summarise()

    def validatePage(self) -> bool:
        """Begin or take up; what is wrong is said below, with the focus where it is."""
        for box in self.findChildren(QAbstractSpinBox):
            box.interpretText()
        chosen = self.begin.currentData()
        stamp = time.strftime("%Y%m%d-%H%M%S")
        journal = Path(chosen) if chosen else self._folder / f"{self._journals}-{stamp}.journal"
        try:
            self._live.open(self.settings_now(), journal, None if chosen else self.wanted())
        except UnusableInput as error:
            self.problem.setText(str(error))
            self.of_the_plan[0].setFocus()
            return False
        self.problem.clear()
        return True

    def settings_now(self) -> Any:
        """Return the settings with what all fields say."""
        given, replace = self.stated(), msgspec.structs.replace
        paper = replace(given.paperwork, operator=self.operator.text().strip())
        return replace(given, paperwork=paper)

    def read_settings(self) -> None:
        """Take the fields from the settings file, if one is named."""
        name = self.settings.text().strip()
        if name:
            try:
                self._given = read_document(Path(name), type(self._given)).record
                self.show_settings()
            except UnusableInput as error:
                self.problem.setText(str(error))
                return
            self.problem.clear()
            self.operator.setText(self._given.paperwork.operator or self.operator.text())
        self.summarise()

    def summarise(self) -> None:
        """Say what the fields mean."""
        anew = not self.begin.currentData()
        for widget in (self.plan, *self.of_the_plan):
            widget.setEnabled(anew)
        if not anew:
            self.summary.setText("The plan and all readings are those of the journal.")
            return
        try:
            self.summary.setText(self.describe(self.wanted()))
        except (UnusableInput, ValueError) as error:
            self.summary.setText(str(error))

    def _browse(self) -> None:
        """Open the dialog for a settings file."""
        dialog = QFileDialog(self, "Choose settings", filter="Settings (*.toml)")
        dialog.setObjectName(f"choose_{self._stem}_settings")
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.setModal(False)
        dialog.fileSelected.connect(self._chosen)
        dialog.show()

    def _chosen(self, name: str) -> None:
        self.settings.setText(name)
        self.read_settings()


class LoadCellPlanPage(PlanPage):
    """Choose plan, weights and the place where they hang."""

    def __init__(self, live: LiveCalibration, folder: Path, settings: Path | None) -> None:
        super().__init__(
            live,
            folder,
            settings,
            LoadCellFile(schema=1, cell=CellSection(name="Load cell")),
            stem="calibration",
            journals="calibration",
            plans={
                "daily": "Daily check: one weight at 4 pin angles",
                "routine": "Routine: 4 pin angles, 5 loads up and down",
                "full": "Full: 12 pin angles, 10 loads up and down",
            },
            item=("cell", "Name of the load cell"),
        )
        self.setTitle("Plan and weights")
        self.setSubTitle(
            "Every reading is saved at once. You can close the wizard at any time and take the"
            " calibration up again."
        )
        spoken = "Weights, kilograms; 5x8 are eight of 5 kg"
        self.weights = edit("calibration_weights", spoken)
        self.weights.setText("5x8, 2, 2, 1, 0.5")
        spoken = "Mass of the hanger"
        self.hanger = number("calibration_hanger", spoken, 0.0, 20.0, 4, 0.1, "kg")
        least, most = GRAVITY.low, GRAVITY.high
        spoken = "Local gravity"
        self.gravity = number("calibration_gravity", spoken, least, most, 5, 0.0001, "m/s²")
        self.gravity.setValue(ROUNDED_GRAVITY)
        for text, widget in (
            ("&Load cell", self.item),
            ("&Plan", self.plan),
            ("W&eights (kg)", self.weights),
            ("&Hanger", self.hanger),
            ("Local &gravity", self.gravity),
        ):
            field(self.form, text, widget)
        self.finish()
        self.weights.textChanged.connect(self.summarise)
        self.hanger.valueChanged.connect(self.summarise)
        self.gravity.valueChanged.connect(self.summarise)

    @property
    def of_the_plan(self) -> tuple[QWidget, ...]:
        """Return the weights."""
        return (self.weights,)

    def show_settings(self) -> None:
        """Take cell, hanger and gravity from the settings."""
        self.item.setText(self._given.cell.name)
        place = self._given.place
        if place.gravity_m_s2 is not None or place.latitude_deg is not None:
            meaning = load_cell_meaning(self._given, "settings")
            self.hanger.setValue(meaning.weights.hanger_mass)
            self.gravity.setValue(meaning.place.gravity)

    def stated(self) -> LoadCellFile:
        """Return the settings with cell, hanger and gravity."""
        given, replace = self._given, msgspec.structs.replace
        place = given.place
        if place.gravity_m_s2 is not None or place.latitude_deg is None:
            place = replace(place, gravity_m_s2=self.gravity.value())
        stated: LoadCellFile = replace(
            given,
            cell=replace(given.cell, name=self.item.text().strip() or "Load cell"),
            weights=replace(given.weights, hanger_mass_kg=self.hanger.value()),
            place=place,
        )
        return stated

    def wanted(self) -> LoadCellPlan:
        """Return the plan that the fields say."""
        settings = load_cell_meaning(self.settings_now(), "settings")
        return load_cell_plan(self.plan.currentData(), self.weights.text(), settings)

    def describe(self, plan: LoadCellPlan) -> str:
        """Return what a plan means, in words."""
        steps = plan.steps()
        most = max(step.value for step in steps)
        readings = sum(1 for step in steps if step.series)
        text = (
            f"{len(plan.pieces)} pieces, {sum(plan.pieces):g} kg in all. The heaviest load is"
            f" {most:g} kg; {readings} readings, about {duration_words(steps)}."
        )
        place = self.stated().place
        stated = place.gravity_m_s2 is not None
        if stated and abs(self.gravity.value() - ROUNDED_GRAVITY) < 1e-6:
            text += (
                "\n9.81 m/s² is a rounded value, up to 0.3 % off: write the gravity of this place,"
                " or name a settings file with latitude and height."
            )
        return text


class ProbePlanPage(PlanPage):
    """Choose probe, positions and how far they reach."""

    def __init__(
        self, live: LiveCalibration, folder: Path, settings: Path | None, probe: str
    ) -> None:
        super().__init__(
            live,
            folder,
            settings,
            ProbeFile(schema=1),
            stem="probe",
            journals="probes",
            plans={"routine": "Routine: once up and down", "full": "Full: three times up and down"},
            item=("name", "Name of the probe"),
        )
        self._reach_typed = False
        self.setTitle("Probe and plan")
        self.setSubTitle(
            "A micrometer moves the target in equal steps, up and down; the voltage is read at each"
            " step. Every reading is saved at once: close at any time and take it up again."
        )
        words = {
            "1": "Probe 1, along the follower",
            "2": "Probe 2, across the follower",
            "both": "Both probes, and how they stand to each other",
        }
        items = ((text, word) for word, text in words.items())
        self.probe = choice("probe_which", "Which probe", items)
        self.probe.setCurrentIndex(list(PROBES).index(probe))
        least, most = FEWEST_POSITIONS, MOST_POSITIONS
        self.positions = whole_number("probe_positions", "Positions of a run", least, most)
        self.positions.setValue(11)
        self.reach = number("probe_reach", "Largest position", 1.0, 10000.0, 1, 10.0, "µm")
        spoken = "Standard uncertainty of the micrometer"
        self.micrometer = number("probe_micrometer", spoken, 0.01, 100.0, 2, 0.1, "µm")
        for text, widget in (
            ("&Calibrate", self.probe),
            ("N&ame", self.item),
            ("&Plan", self.plan),
            ("Posi&tions of a run", self.positions),
            ("From − to + th&is position", self.reach),
            ("u of the &micrometer", self.micrometer),
        ):
            field(self.form, text, widget)
        self.finish()
        self.item.setText("Probe")
        self.probe.currentIndexChanged.connect(self.summarise)
        self.positions.valueChanged.connect(self._propose)
        self.reach.valueChanged.connect(self.summarise)
        self.reach.textChanged.connect(self._typed)
        live.looked.connect(self._propose)

    @property
    def of_the_plan(self) -> tuple[QWidget, ...]:
        """Return reach, probe and positions."""
        return (self.reach, self.probe, self.positions)

    def initializePage(self) -> None:
        """Offer what can be taken up, and a reach."""
        super().initializePage()
        self._propose()

    def show_settings(self) -> None:
        """Take name and micrometer from the settings."""
        self.item.setText(self._given.probe.name)
        self.micrometer.setValue(self._given.probe.micrometer_standard_uncertainty_um)

    def stated(self) -> ProbeFile:
        """Return the settings with name and micrometer."""
        probe = msgspec.structs.replace(
            self._given.probe,
            name=self.item.text().strip() or "Probe",
            micrometer_standard_uncertainty_um=self.micrometer.value(),
        )
        stated: ProbeFile = msgspec.structs.replace(self._given, probe=probe)
        return stated

    def wanted(self) -> ProbePlan:
        """Return the plan that the fields say."""
        which, plan = self.probe.currentData(), self.plan.currentData()
        return probe_plan(which, plan, self.reach.value(), self.positions.value())

    def describe(self, plan: ProbePlan) -> str:
        """Return what a plan means, in words."""
        steps = plan.steps()
        readings = sum(1 for step in steps if step.series)
        text = (
            f"Steps of {1e6 * plan.step_size:g} µm; {readings} readings, about"
            f" {duration_words(steps)}."
        )
        if len(plan.probes) > 1:
            text += " With both probes the stage moves along the follower first, then across it."
        return text

    def _typed(self) -> None:
        self._reach_typed = self._reach_typed or self.reach.hasFocus()

    def _propose(self) -> None:
        """Propose 80 % of the range, once the engine has told the sensitivity in use."""
        view = self._live.view
        if self._reach_typed or self._live.session is not None:
            return
        if view is not None:
            known, range_V = view["sensitivity_um_per_V"], self._given.probe.range_V
            self.reach.setValue(usual_reach_um(known, range_V, self.positions.value()))
        self.summarise()
