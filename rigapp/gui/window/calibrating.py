"""The calibration guide in the window: choose, open, leave, return to and end it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from getpass import getuser
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDialog, QLabel, QPushButton, QVBoxLayout, QWidget

from rigapp.gui.look.preferences import OFF, Preference, Preferences
from rigapp.gui.plots.plotmenu import offer_menus
from rigapp.gui.widgets.build import button, filled
from rigapp.gui.widgets.chunkedtask import ChunkedTask
from rigapp.gui.widgets.labels import scaled_font
from rigapp.gui.window.notice import EndCalibrationBar, NoticeBar
from rigapp.gui.window.pagestack import PageStack
from rigapp.gui.window.places import RailPlace
from rigapp.gui.window.tabs import Tabs
from rigapp.presentation.tokens import GAP, STEP, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.process.memory import begin_to_load, end_of_loading
from rigapp.schema.details import error_text
from rigapp.schema.messages import Reply, Status
from rigapp.schema.states import ACTIVE
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.tasks import TaskWorker

if TYPE_CHECKING:
    from rigapp.gui.wizard.wizard import CalibrationWizard


@dataclass(frozen=True, slots=True)
class Choice:
    """A calibration: name with an access key, procedure, and calibration type.

    what: its name while it occupies the rig. fields: initial values of the first page, by the name
    of the field.
    """

    text: Text
    words: Text
    what: Text
    subject: str
    fields: Mapping[str, str] = field(default_factory=dict)


CHOICES = {
    "load cell": Choice(
        "&Load cell", "with weights, at several pin angles", "load cell", "load cell"
    ),
    "daily": Choice(
        "&Daily check",
        "of the load cell, one weight at 4 pin angles",
        "daily check",
        "load cell",
        {"plan": "daily"},
    ),
    "1": Choice(
        "&Probe 1", "with a micrometer along the follower", "probe 1", "probes", {"which": "1"}
    ),
    "2": Choice(
        "Prob&e 2", "with a micrometer across the follower", "probe 2", "probes", {"which": "2"}
    ),
    "both": Choice(
        "&Both probes",
        "with a micrometer stage; also finds the angle between the probes",
        "both probes",
        "probes",
        {"which": "both"},
    ),
    "run-out": Choice(
        "&Run-out of the pin", "by slow rolls of the spindle", "run-out of the pin", "run-out"
    ),
}
"""Calibrations by name: types, or variants of one."""

WIDEST = 80 * STEP
"""Maximum width of a button; a wider one looks like a line of text."""


class CalibrationChooser(QDialog):
    """Choose a calibration by letter, arrow keys or mouse; Esc closes."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("calibration_chooser")
        self.setWindowTitle(tr("Calibrate – rigapp"))
        self.setModal(False)
        heading = QLabel(tr("What shall be calibrated?"))
        heading.setFont(scaled_font(heading, 1.4, bold=True))
        self.buttons: dict[str, QPushButton] = {}
        for key, choice in CHOICES.items():
            text = f"{tr(choice.text)}\n{tr(choice.words)}"
            name = f"choose_{key.replace(' ', '_')}"
            self.buttons[key] = button(name, text, partial(self._choose, key))
            self.buttons[key].setMaximumWidth(WIDEST)
            self.buttons[key].setStyleSheet(f"text-align: left; min-height: {6 * STEP}px;")
        layout = filled(QVBoxLayout(self), (heading, *self.buttons.values(), None))
        layout.setSpacing(GAP)
        self.setFocusProxy(self.buttons["load cell"])

    def _choose(self, key: str) -> None:
        self.accept()
        self.chosen.emit(key)


class CalibrationGuide(QObject):
    """Open one calibration at a time in place of the pages; it occupies the rig."""

    moved = Signal()
    """A guide replaced the pages, or the pages are shown again."""
    reported = Signal(object, bool)
    """An answer, and whether it reports success."""
    occupied = Signal()
    """Refused: another calibration occupies the rig."""

    def __init__(
        self,
        connection: EngineConnection,
        reader: TaskWorker,
        stage: PageStack,
        tabs: Tabs,
        notice: NoticeBar,
        preferences: Preferences,
        parent: QWidget,
        *,
        files: tuple[Path | None, Path],
        theme: Callable[[], Theme],
    ) -> None:
        """Make the guide; files: the rig file and the folder of results."""
        super().__init__(parent)
        self._connection, self._reader = connection, reader
        self._stage, self._tabs, self._notice = stage, tabs, notice
        self._preferences, self._window = preferences, parent
        (self._rig_file, self._results), self._theme = files, theme
        self._turns = ChunkedTask(self)
        self.end_bar = EndCalibrationBar()
        notice.end_wanted.connect(self._ask_end)
        self.wizard: CalibrationWizard | None = None
        self._make_wizard: type[CalibrationWizard] | None = None
        self._next = ""
        self._since, self._occupies = 0.0, False

    def open(self) -> None:
        """Show the chooser, or the calibration in progress; refused during a test."""
        if self.wizard is not None:
            self.show(self.wizard)
            return
        if self._free() is None:
            return
        chooser = CalibrationChooser(self._window)
        chooser.chosen.connect(self.choose)
        chooser.rejected.connect(self.end)
        self._stage.take(chooser)
        self._stage.dress(self._theme())
        # Fits and statistics are loaded on the worker while the operator chooses.
        if self._make_wizard is None:
            self._reader.submit(_load_wizards, self._take_wizards, self._report_problem)
        self.show(chooser)

    def choose(self, key: str) -> None:
        """Open the wizard for the load cell, a probe or both (see ``CHOICES``)."""
        if self._free() is None:
            self.end()
            return
        self._next = key
        if self._make_wizard is None:
            self.reported.emit(tr("The calibration is being opened."), True)
            return
        from rigapp.calibrating.subjects import SUBJECTS

        self._next, choice = "", CHOICES[key]
        fastest = SUBJECTS[choice.subject].fastest_rpm
        arguments = {"what": choice.what, "fastest_rpm": fastest}
        self._connection.request("calibration_begin", arguments, partial(self._begun, key))

    def show(self, guide: QWidget) -> None:
        """Show a guide in place of the rig's pages; state bar, Stop and notes stay."""
        self._tabs.show_place(RailPlace.RIG)
        self._stage.guide(guide)
        self.moved.emit()

    def leave(self) -> None:
        """Show the pages while the guide stays open."""
        self._stage.show_pages()
        self.moved.emit()

    def end(self) -> None:
        """Close the guide; the pages are shown."""
        self.wizard, self._next = None, ""
        self._since, self._occupies = 0.0, False
        self._stage.end()
        self.moved.emit()

    def close(self) -> None:
        """Close an open wizard, which releases the rig."""
        if self.wizard is not None:
            self.wizard.reject()

    def take_status(self, status: Status) -> None:
        """Update which calibration occupies the rig; close the own one when ended elsewhere."""
        running = status.engine.calibration
        self.end_bar.take_status(status)
        own = running is not None and running.since == self._since
        if self._occupies and not own and self.wizard is not None:
            self.wizard.reject()
            text: Text = "The calibration was ended elsewhere. All readings are kept."
            self.reported.emit(tr(text), False)
        self._occupies = own and self.wizard is not None

    def _begun(self, key: str, reply: Reply) -> None:
        """Open the wizard when this calibration occupies the rig, else report why not."""
        from rigapp.calibrating.session import Rig

        status = self._connection.status
        if not reply.ok or status is None:
            self.end()
            self.reported.emit(translate(reply.sentence), False)
            return
        begun = reply.result or {}
        self.reported.emit("", True)
        self._since, self._occupies = begun.get("since", 0.0), False
        self._notice.own_calibration = self._since
        chosen = self._preferences.get(Preference.OPERATOR)
        operator = chosen or status.engine.operator or getuser()
        test = self._tabs.prepare.recipe.path
        choice = CHOICES[key]
        assert self._make_wizard is not None
        self.wizard = self._make_wizard(
            self._connection.request,
            Rig(status.rig.name, status.rig.simulated, operator, self._rig_file, test),
            self._theme(),
            self._results,
            parent=self._window,
            subject=choice.subject,
            fields=choice.fields,
            key=begun.get("key", ""),
        )
        self.wizard.live.hands_offered = self._preferences.get(Preference.HANDS) != OFF
        self.wizard.finished.connect(self.end)
        self._turns.then((self._put_on_stage,))

    def _take_wizards(self, make: type[CalibrationWizard]) -> None:
        self._make_wizard = make
        if self._next:
            self.choose(self._next)

    def _report_problem(self, error: Exception) -> None:
        self.reported.emit(error_text(error, "That did not work."), False)

    def _put_on_stage(self) -> None:
        if self.wizard is not None:
            self._stage.take(self.wizard)
            offer_menus(self.wizard, self.reported.emit)
            self._turns.then((*self._stage.dress_calls(self._theme()), self._show_wizard))

    def _show_wizard(self) -> None:
        if self.wizard is not None:
            self.show(self.wizard)

    def _free(self) -> Status | None:
        """Return the status of a rig that can be calibrated now, else report why not."""
        status = self._connection.status
        if self._connection.is_replay or status is None or status.engine.state in ACTIVE:
            why: Text = "Calibrating needs a running engine and no running test."
            self.reported.emit(tr(why), False)
            return None
        if status.engine.calibration is not None:
            self.occupied.emit()
            return None
        return status

    def _ask_end(self) -> None:
        if self._connection.status is not None:
            self.end_bar.ask(self._connection.status)


def _load_wizards() -> type[CalibrationWizard]:
    """Import the wizard; on a worker, since a garbage collection would block the window."""
    begin_to_load()
    try:
        from rigapp.gui.wizard.wizard import CalibrationWizard
    finally:
        end_of_loading()
    return CalibrationWizard
