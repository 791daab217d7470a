"""First page for probes: which, how far, how many positions; begin anew or take up."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
    QWizardPage,
)

from calibration.load_cell.procedure import ProcedureError
from calibration.probes.procedure import FEWEST_POSITIONS, ProbePlan, make_probe_plan, time_needed
from rigapp.calibrating.live_probes import PROBE_PLANS, PROBES, plan_of, usual_reach_um
from rigapp.config.calibration_settings import ProbeFile, ProbeSection, read_probe_settings
from rigapp.config.errors import UnusableInput
from rigapp.gui.wizard.parts import field, named, number, prose
from rigapp.gui.wizard.plan_page import NEW
from rigapp.gui.wizard.plan_parts import (
    choose_settings,
    chosen_journal,
    offer_journals,
    settings_row,
)
from rigapp.gui.wizard.probe_bench import ProbeBench

PROBE_WORDS = {
    "1": "Probe 1, along the follower",
    "2": "Probe 2, across the follower",
    "both": "Both probes, and how they stand to each other",
}
PLAN_WORDS = {"routine": "Routine: once up and down", "full": "Full: three times up and down"}
JOURNALS = "probes"


class ProbePlanPage(QWizardPage):
    """Choose probe and plan, or a calibration to take up."""

    def __init__(self, bench: ProbeBench, folder: Path, probe: str, settings: Path | None) -> None:
        super().__init__()
        self._bench, self._folder = bench, folder
        self._given = ProbeFile(schema=1)
        self._reach_typed = False
        self.setTitle("Probe and plan")
        self.setSubTitle(
            "A micrometer moves the target in equal steps, up and down; the voltage is read at each"
            " step. Every reading is saved at once: close at any time and take it up again."
        )
        self.begin = QComboBox()
        named(self.begin, "probe_begin", "Begin or take up")
        self.settings = QLineEdit(str(settings) if settings is not None else "")
        self.settings.setPlaceholderText("none: the fields below are enough")
        named(self.settings, "probe_settings", "Settings file of the calibration")
        self.browse = QPushButton("Bro&wse…")
        named(self.browse, "probe_browse", "Choose a settings file")
        self.name = QLineEdit("Probe")
        named(self.name, "probe_name", "Name of the probe")
        self.probe = QComboBox()
        for key, words in PROBE_WORDS.items():
            self.probe.addItem(words, key)
        self.probe.setCurrentIndex(list(PROBES).index(probe))
        named(self.probe, "probe_which", "Which probe")
        self.plan = QComboBox()
        for key, words in PLAN_WORDS.items():
            self.plan.addItem(words, key)
        self.plan.setCurrentIndex(1)
        named(self.plan, "probe_plan", "Plan")
        self.positions = QSpinBox()
        self.positions.setRange(FEWEST_POSITIONS, 41)
        self.positions.setValue(11)
        self.positions.setMinimumHeight(24)
        named(self.positions, "probe_positions", "Positions of a run")
        self.reach = number(1.0, 10000.0, 1, 10.0, "µm")
        named(self.reach, "probe_reach", "Largest position, micrometres")
        self.micrometer = number(0.01, 100.0, 2, 0.1, "µm")
        self.micrometer.setValue(0.5)
        named(
            self.micrometer,
            "probe_micrometer",
            "Standard uncertainty of the micrometer, micrometres",
        )
        self.operator = QLineEdit(bench.rig.operator)
        named(self.operator, "probe_operator", "Operator")
        self.summary = prose("probe_summary", "What this means")
        self.problem = prose("probe_plan_problem", "What is wrong on this page")
        self._build()
        self.read_settings()

    def _build(self) -> None:
        form = QFormLayout()
        field(form, "&Begin or take up", self.begin)
        settings_row(form, self.settings, self.browse)
        field(form, "&Calibrate", self.probe)
        field(form, "N&ame", self.name)
        field(form, "&Plan", self.plan)
        field(form, "Posi&tions of a run", self.positions)
        field(form, "From − to + th&is position", self.reach)
        field(form, "u of the &micrometer", self.micrometer)
        field(form, "&Operator", self.operator)
        column = QVBoxLayout(self)
        column.addLayout(form)
        column.addWidget(self.summary)
        column.addStretch(1)
        column.addWidget(self.problem)
        for box in (self.begin, self.probe, self.plan):
            box.currentIndexChanged.connect(self._summarise)
        self.positions.valueChanged.connect(self._propose)
        self.reach.valueChanged.connect(self._summarise)
        self.reach.textChanged.connect(self._typed)
        self.settings.editingFinished.connect(self.read_settings)
        self.browse.clicked.connect(self._browse)
        self._bench.looked.connect(self._propose)

    def initializePage(self) -> None:
        """Offer what can be taken up."""
        offer_journals(self.begin, NEW, self._folder, JOURNALS)
        self._propose()
        self._summarise()

    def validatePage(self) -> bool:
        """Begin or take up; what is wrong is said below."""
        for box in (self.positions, self.reach, self.micrometer):
            box.interpretText()
        try:
            journal = chosen_journal(self.begin, self._folder, JOURNALS)
            self._bench.open(self._settings(), journal, self._wish())
        except UnusableInput as error:
            self.problem.setText(str(error))
            self.reach.setFocus()
            return False
        self.problem.clear()
        return True

    def read_settings(self) -> None:
        """Take the fields from the settings file, if one is named."""
        name = self.settings.text().strip()
        if not name:
            return
        try:
            self._given, _ = read_probe_settings(Path(name))
        except UnusableInput as error:
            self.problem.setText(str(error))
            return
        self.problem.clear()
        self.name.setText(self._given.probe.name)
        self.micrometer.setValue(self._given.probe.micrometer_standard_uncertainty_um)
        self.operator.setText(self._given.paperwork.operator or self.operator.text())
        self._summarise()

    def _settings(self) -> ProbeFile:
        given, replace = self._given, msgspec.structs.replace
        probe: ProbeSection = replace(
            given.probe,
            name=self.name.text().strip() or "Probe",
            micrometer_standard_uncertainty_um=self.micrometer.value(),
        )
        paper = replace(given.paperwork, operator=self.operator.text().strip())
        return replace(given, probe=probe, paperwork=paper)

    def _wish(self) -> ProbePlan | None:
        if self.begin.currentData():
            return None
        return plan_of(
            self.probe.currentData(),
            self.plan.currentData(),
            self.reach.value(),
            self.positions.value(),
            self.reach.value(),
        )

    def _typed(self) -> None:
        self._reach_typed = self._reach_typed or self.reach.hasFocus()

    def _propose(self) -> None:
        """Propose 80 % of the range, once the engine has told the sensitivity in use."""
        known = self._bench.sensitivity_um_per_V
        if self._reach_typed or self._bench.session is not None:
            return
        if known:
            range_V = self._given.probe.range_V
            self.reach.setValue(usual_reach_um(known, range_V, self.positions.value()))
        self._summarise()

    def _summarise(self) -> None:
        anew = not self.begin.currentData()
        for widget in (self.probe, self.plan, self.positions, self.reach):
            widget.setEnabled(anew)
        if not anew:
            self.summary.setText("Probe, plan and all readings are those of the journal.")
            return
        which, runs = PROBES[self.probe.currentData()], PROBE_PLANS[self.plan.currentData()]
        plan = ProbePlan(which, 1e-6 * self.reach.value(), self.positions.value(), runs)
        try:
            steps = make_probe_plan(plan)
        except ProcedureError as error:
            self.summary.setText(str(error))
            return
        readings = sum(1 for step in steps if step.series)
        size = 2.0 * self.reach.value() / (self.positions.value() - 1)
        minutes = math.ceil(time_needed(steps) / 60.0)
        self.summary.setText(
            f"Steps of {size:g} µm; {readings} readings, about {minutes} min. With both probes the"
            " stage moves along the follower first, then across it."
            if len(which) > 1
            else f"Steps of {size:g} µm; {readings} readings, about {minutes} min."
        )

    def _browse(self) -> None:
        choose_settings(self, "choose_probe_settings", self._chosen)

    def _chosen(self, name: str) -> None:
        self.settings.setText(name)
        self.read_settings()
