"""The guide through a calibration in the window: chosen, opened, left, come back to and ended."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from getpass import getuser
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDialog, QLabel, QVBoxLayout, QWidget

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
    """One thing to choose: its name with an access key, how it is done, and the subject it is.

    what: how it is named where it occupies the rig. fields: what the first page says at the
    beginning, by the name of its field.
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
        "with a micrometer stage; finds how the probes stand as well",
        "both probes",
        "probes",
        {"which": "both"},
    ),
    "run-out": Choice(
        "&Run-out of the pin", "by slow rolls of the spindle", "run-out of the pin", "run-out"
    ),
}
"""What is chosen: the subject, or which of several things of it."""

WIDEST = 80 * STEP
"""Of a button: longer ones are read as lines, not pressed."""


class CalibrationChooser(QDialog):
    """Choose by letter, arrows or mouse; Esc closes."""

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("calibration_chooser")
        self.setWindowTitle(tr("Calibrate – rigapp"))
        self.setModal(False)
        heading = QLabel(tr("What shall be calibrated?"))
        heading.setFont(scaled_font(heading, 1.4, bold=True))
        self.buttons = {}
        for key, choice in CHOICES.items():
            text = f"{tr(choice.text)}\n{tr(choice.words)}"
            made = button(f"choose_{key.replace(' ', '_')}", text, partial(self._choose, key))
            made.setMaximumWidth(WIDEST)
            made.setStyleSheet(f"text-align: left; min-height: {6 * STEP}px;")
            self.buttons[key] = made
        whole = filled(QVBoxLayout(self), (heading, *self.buttons.values(), None))
        whole.setSpacing(GAP)
        self.setFocusProxy(self.buttons["load cell"])

    def _choose(self, which: str) -> None:
        self.accept()
        self.chosen.emit(which)


class CalibrationGuide(QObject):
    """Open one calibration at a time in the place of the pages; the rig is occupied by it."""

    moved = Signal()
    """A guide took the place of the pages, or left it."""
    said = Signal(object, bool)
    """An answer, and whether it is a good one."""
    occupied = Signal()
    """Refused: the rig is another calibration's."""

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
        """Make it; files: the rig file and the folder of results."""
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
        """Ask what to calibrate, or go back to the calibration under way; refused during a test."""
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
        # Fits and statistics are loaded while somebody chooses, not before, and not here.
        if self._make_wizard is None:
            self._reader.submit(_load_wizards, self._take_wizards, self._tell_problem)
        self.show(chooser)

    def choose(self, which: str) -> None:
        """Open the wizard for the load cell, a probe or both (see ``CHOICES``)."""
        if self._free() is None:
            self.end()
            return
        self._next = which
        if self._make_wizard is None:
            self.said.emit(tr("The calibration is being opened."), True)
            return
        from rigapp.calibrating.subjects import SUBJECTS

        self._next, choice = "", CHOICES[which]
        fastest = SUBJECTS[choice.subject].fastest_rpm
        arguments = {"what": choice.what, "fastest_rpm": fastest}
        self._connection.request("calibration_begin", arguments, partial(self._begun, which))

    def show(self, guide: QWidget) -> None:
        """Show a guide in the place of the rig's pages; strip, Stop and notes stay."""
        self._tabs.show_place(RailPlace.RIG)
        self._stage.guide(guide)
        self.moved.emit()

    def leave(self) -> None:
        """Go from the guide to the pages; it can be come back to."""
        self._stage.show_pages()
        self.moved.emit()

    def end(self) -> None:
        """Let the guide go; the pages are shown."""
        self.wizard, self._next = None, ""
        self._since, self._occupies = 0.0, False
        self._stage.end()
        self.moved.emit()

    def close(self) -> None:
        """Close what is open, which frees the rig."""
        if self.wizard is not None:
            self.wizard.reject()

    def take_status(self, status: Status) -> None:
        """Take which calibration occupies the rig; close ours when somebody else has ended it."""
        found = status.engine.calibration
        self.end_bar.take_status(status)
        ours = found is not None and found.since == self._since
        if self._occupies and not ours and self.wizard is not None:
            self.wizard.reject()
            self.said.emit(tr("The calibration was ended elsewhere. All readings are kept."), False)
        self._occupies = ours and self.wizard is not None

    def _begun(self, which: str, reply: Reply) -> None:
        """Open the wizard once the rig is this calibration's; say why where it is not."""
        from rigapp.calibrating.session import Rig

        status = self._connection.status
        if not reply.ok or status is None:
            self.end()
            self.said.emit(translate(reply.sentence), False)
            return
        begun = reply.result or {}
        self.said.emit("", True)
        self._since, self._occupies = begun.get("since", 0.0), False
        self._notice.own_calibration = self._since
        chosen = self._preferences.get(Preference.OPERATOR)
        operator = chosen or status.engine.operator or getuser()
        test = self._tabs.prepare.recipe.path
        choice = CHOICES[which]
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

    def _tell_problem(self, error: Exception) -> None:
        self.said.emit(error_text(error, "That did not work."), False)

    def _put_on_stage(self) -> None:
        if self.wizard is not None:
            self._stage.take(self.wizard)
            offer_menus(self.wizard, self.said.emit)
            self._turns.then((*self._stage.dress_calls(self._theme()), self._show_wizard))

    def _show_wizard(self) -> None:
        if self.wizard is not None:
            self.show(self.wizard)

    def _free(self) -> Status | None:
        """Return the status of a rig that may be calibrated now; say why it may not."""
        status = self._connection.status
        if self._connection.is_replay or status is None or status.engine.state in ACTIVE:
            why: Text = "Calibrating needs a running engine and no test under way."
            self.said.emit(tr(why), False)
            return None
        if status.engine.calibration is not None:
            self.occupied.emit()
            return None
        return status

    def _ask_end(self) -> None:
        if self._connection.status is not None:
            self.end_bar.ask(self._connection.status)


def _load_wizards() -> type[CalibrationWizard]:
    """Load what calibrates; on a worker, where a search for garbage would hold the window up."""
    begin_to_load()
    try:
        from rigapp.gui.wizard.wizard import CalibrationWizard
    finally:
        end_of_loading()
    return CalibrationWizard
