"""First page: plan and settings of a new calibration, or selection of one to resume."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from operator import attrgetter
from pathlib import Path
from typing import Any

import msgspec
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QComboBox,
    QFileDialog,
    QLabel,
    QLineEdit,
    QVBoxLayout,
)

from rigapp.config.calibration_settings import CalibrationFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document
from rigapp.gui.widgets.build import button, choice, edit, filled, fit_hint, prose, row
from rigapp.gui.wizard.guide_page import TWO, GuidePage
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp.gui.wizard.scenes import Picture, Scene
from rigapp.gui.wizard.widgets import field, fields_form, prefix_of, sentence
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.texts import sentence_of_error

NEW: Text = "Begin a new calibration"
PLAN, RIG = "plan", "rig"
"""Targets of a field that is not a setting: the plan, stored in the journal, or the rig."""

Values = Mapping[str, Any]
"""Values of the fields of a plan, by name."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field of the page.

    name: of the widget, after the stem. text: its caption. make (name, read aloud): makes the
    widget. start: its initial value. kept: ``PLAN``, ``RIG``, or section.key of the settings.
    spoken: by default its caption.
    """

    name: str
    text: Text
    make: Callable[[str, str], Any]
    start: Any
    kept: str = PLAN
    spoken: Text = ""


def _nothing(*_: Any) -> Values:
    return {}


@dataclass(frozen=True, slots=True)
class Questions:
    """The first page of a subject.

    stem: of the widgets' names; journals: of the files in the folder. defaults: the settings
    without a file. culprit: the field that is probably wrong when a plan is invalid. describe
    (plan, values, settings): returns a summary of a plan. derived (settings): returns values of
    settings that depend on others. propose (answer of the engine, values, settings): returns values
    for fields that were not edited.
    """

    stem: str
    journals: str
    title: Text
    subtitle: Text
    defaults: CalibrationFile
    fields: tuple[Field, ...]
    culprit: str
    describe: Callable[[Any, Values, Any], str]
    derived: Callable[[Any], Values] = _nothing
    propose: Callable[[Any, Values, Any], Values] = _nothing


OPERATOR = Field("operator", "&Operator", edit, "", "paperwork.operator")


class PlanPage(GuidePage):
    """Choose plan and settings, or a calibration to resume."""

    def __init__(
        self,
        live: LiveCalibration,
        folder: Path,
        settings: Path | None,
        asks: Questions,
        planned: Callable[[Values, Any], Any],
        sketch: Scene,
        theme: Theme,
        chosen: Values | None = None,
    ) -> None:
        """Make the fields of a subject; planned: returns its plan; chosen: initial values.

        sketch: picture of the procedure.
        """
        super().__init__(asks.title)
        self._live, self._folder, self.asks, self._planned = live, folder, asks, planned
        self._record: Any = asks.defaults
        stem = asks.stem
        self.subtitle = prose(f"{stem}_subtitle", "What this is", asks.subtitle)
        self.subtitle.setProperty("role", "secondary")
        self.picture = Picture(f"{stem}_sketch", "Next actions", theme)
        self.picture.show_scene(sketch)
        self.begin = choice(f"{stem}_begin", "Begin or continue", (), self.summarise)
        spoken, hint = (
            marked("Settings file of the calibration"),
            marked("none: the fields below are enough"),
        )
        self.settings = edit(f"{stem}_settings", spoken, hint=hint)
        fit_hint(self.settings)
        self.settings.setText(str(settings) if settings is not None else "")
        choose: Text = "Choose a settings file"
        self.browse = button(f"{stem}_browse", "Bro&wse…", self._browse, choose)
        self.summary = sentence(f"{stem}_summary", "Meaning")
        spoken = "What is wrong on this page"
        self.problem = sentence(f"{prefix_of(stem)}plan_problem", spoken)
        form = fields_form()
        field(form, "&Begin or continue", self.begin)
        label = QLabel(tr("&Settings file"))
        label.setBuddy(self.settings)
        form.addRow(label, row((self.settings, 1), self.browse))
        self._fields = (*asks.fields, OPERATOR)
        self._typed: set[str] = set()
        self.fields: dict[str, Any] = {}
        values = {"operator": live.rig.operator, "test": live.rig.test, **(chosen or {})}
        for spec in self._fields:
            spoken = tr(spec.spoken) or tr(spec.text).replace("&", "")
            widget = spec.make(f"{stem}_{spec.name}", spoken)
            self.fields[spec.name] = widget
            if isinstance(widget, QLineEdit):
                fit_hint(widget)
            show_value(widget, values.get(spec.name) or spec.start)
            field(form, spec.text, widget)
            for signal in ("textChanged", "valueChanged", "currentIndexChanged"):
                if hasattr(widget, signal):
                    getattr(widget, signal).connect(self._changed)
        left = filled(QVBoxLayout(), (form, self.summary, None, self.problem))
        both = self.beside(TWO, (left, 3), (self.picture, 2))
        self.hold(self.subtitle, (both, 1))
        self.settings.editingFinished.connect(self.read_settings)
        live.looked.connect(self._propose)
        self._take_settings()

    def _changed(self) -> None:
        """Handle a changed field; an edited value is no longer proposed."""
        self._typed.update(name for name, widget in self.fields.items() if widget.hasFocus())
        self._propose()
        self.summarise()

    # --- the fields ------------------------------------------------------------------------------

    @property
    def values(self) -> Values:
        """Return the values of the fields, by name."""
        return {name: value_of(widget) for name, widget in self.fields.items()}

    def settings_now(self) -> Any:
        """Return the settings with the values of the fields.

        A setting that depends on others stays unchanged.
        """
        settings, derived, values = self._record, self.asks.derived(self._record), self.values
        for spec in self._fields:
            if spec.kept in (PLAN, RIG):
                continue
            if spec.name in derived and attrgetter(spec.kept)(settings) is None:
                continue
            section, _, key = spec.kept.partition(".")
            changed = {key: spec.start if values[spec.name] == "" else values[spec.name]}
            inner = msgspec.structs.replace(getattr(settings, section), **changed)
            settings = msgspec.structs.replace(settings, **{section: inner})
        return settings

    def wanted(self) -> Any:
        """Return the plan from the fields; raises UnusableInput or ValueError."""
        return self._planned(self.values, self.settings_now())

    def read_settings(self) -> None:
        """Fill the fields from the settings file, if one is named, and show the summary."""
        if self._take_settings():
            self.summarise()

    def _take_settings(self) -> bool:
        name = self.settings.text().strip()
        if name:
            try:
                self._record = read_document(Path(name), type(self._record)).record
                self._show_settings()
            except UnusableInput as error:
                self.problem.setText(translate(sentence_of_error(error)))
                return False
            self.problem.clear()
        return True

    def _show_settings(self) -> None:
        derived = self.asks.derived(self._record)
        for spec in self._fields:
            if spec.kept not in (PLAN, RIG):
                stated = attrgetter(spec.kept)(self._record)
                value = derived.get(spec.name) if stated is None else stated
                if value not in (None, ""):
                    show_value(self.fields[spec.name], value)

    # --- the page --------------------------------------------------------------------------------

    def initializePage(self) -> None:
        """List a new calibration and every journal without a record, the newest first."""
        self.begin.clear()
        self.begin.addItem(tr(NEW), None)
        for path in sorted(self._folder.glob(f"{self.asks.journals}-*.journal"), reverse=True):
            if not path.with_suffix(".json").exists():
                self.begin.addItem(tr("Continue {}", path.stem), str(path))
        self._propose()
        self.summarise()

    def validatePage(self) -> bool:
        """Start or resume; show an error with the focus on its field."""
        for box in self.findChildren(QAbstractSpinBox):
            box.interpretText()
        chosen = self.begin.currentData()
        stamp = time.strftime("%Y%m%d-%H%M%S")
        new = self._folder / f"{self.asks.journals}-{stamp}.journal"
        live, values = self._live, self.values
        if "test" in values:
            live.rig = replace(live.rig, test=Path(values["test"]) if values["test"] else None)
        try:
            plan = None if chosen else self.wanted()
            live.open(self.settings_now(), Path(chosen) if chosen else new, plan)
        except UnusableInput as error:
            self.problem.setText(translate(sentence_of_error(error)))
            self.fields[self.asks.culprit].setFocus()
            return False
        self.problem.clear()
        return True

    def summarise(self) -> None:
        """Show a summary of the plan."""
        anew = not self.begin.currentData()
        for spec in self._fields:
            self.fields[spec.name].setEnabled(anew or spec.kept != PLAN)
        if not anew:
            self.summary.setText(tr("The plan and all readings are those of the journal."))
            return
        try:
            summary = self.asks.describe(self.wanted(), self.values, self.settings_now())
        except (UnusableInput, ValueError) as error:
            summary = sentence_of_error(error)
        self.summary.setText(translate(summary))

    def _propose(self) -> None:
        """Propose values from the engine's answer for fields that were not edited."""
        if self._live.session is not None or self._live.view is None:
            return
        proposed = self.asks.propose(self._live.view, self.values, self._record)
        for name in proposed.keys() - self._typed:
            show_value(self.fields[name], proposed[name])

    def _browse(self) -> None:
        """Open the dialog for a settings file."""
        dialog = QFileDialog(self, tr("Choose settings"), filter=tr("Settings (*.toml)"))
        dialog.setObjectName(f"choose_{self.asks.stem}_settings")
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.setModal(False)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(self._chosen)
        dialog.show()

    def _chosen(self, name: str) -> None:
        self.settings.setText(name)
        self.read_settings()


def value_of(widget: Any) -> Any:
    """Return the value of a field."""
    if isinstance(widget, QComboBox):
        return widget.currentData()
    return widget.text().strip() if isinstance(widget, QLineEdit) else widget.value()


def show_value(widget: Any, value: Any) -> None:
    """Set the value of a field."""
    if isinstance(widget, QComboBox):
        widget.setCurrentIndex(widget.findData(value))
    elif isinstance(widget, QLineEdit):
        widget.setText(str(value))
    else:
        widget.setValue(value)
