"""Studies of the results folder: parameters, results, and sensitivities."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Final

from PySide6.QtCore import QProcess, Qt, QTimer, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QFileDialog, QWidget

from rigapp.gui.panel import Host
from rigapp.gui.plots.studyplot import StudyPlot, parameter_title
from rigapp.gui.widgets.build import (
    button,
    choose_paths,
    column,
    named,
    page,
    prose,
    row,
    split,
)
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.reflow import FoldingSplitter, WrappingGrid, flowing
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.numbers import axis_number, grouped
from rigapp.presentation.times import MOMENT, dated
from rigapp.presentation.tokens import GAP, STEP, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.process.children import module_command
from rigapp.study.folder import PowerRow, StudyResults, points_done, studies_in
from rigapp.viewer.news import News, Takes
from rigapp.viewer.tasks import TaskWorker

NO_STUDIES: Final[Text] = (
    "No study is in {}. Compute one from a study file, or open the folder of another."
)
POLL_MS = 2000
"""Period of checks of a study's progress."""
ALL_DONE: Final[Text] = "{} points, each with a result."
SOME_FAILED: Final[Text] = (
    "{} of {} points have a result. The reasons for the others are listed below."
)
SOME_WAIT: Final[Text] = (
    "{} of {} points have a result; {} are still to be computed; without a result: {}."
)
POWER_TITLE: Final[Text] = (
    "Number of revolutions after which a wear coefficient other than the model's is"
    " detected, by share of the tests:"
)
DEPENDS: Final[tuple[Text, ...]] = ("Parameter", "Alone", "With all others")
FAILED: Final[tuple[Text, ...]] = ("Point", "Why there is no result, or remarks on it")
HEADINGS: Final[tuple[Text, ...]] = ("Factor", "Tests")
BESIDE_FROM, SUMMARY_WIDTH, TABLE_WIDTH = 110 * STEP, 40 * STEP, 40 * STEP
TABLE_HEIGHT, STUDY_HEIGHT = 16 * STEP, 90 * STEP
"""Width of list and study beside each other; heights below each other."""
DEPENDS_MOST: Final[Text] = "Depends most on {}. Shares of the variance, with 95 % limits:"
TOO_FEW: Final[Text] = (
    "Too few points to say what it depends on. Shares of the variance, with 95 % limits:"
)
MOST_FAILED = 200
"""Maximum number of listed reasons; the column ``problem`` of the table has all."""


class StudyRun(QWidget):
    """Compute a study in a separate process, which is interrupted when the window closes.

    Finished points are saved, and the same file resumes. One core is left to rig and window.
    """

    ended = Signal(Path)

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._folder = folder
        self.target = folder
        named(self, "study_run", "Compute a study")
        self.compute = button(
            "study_compute",
            "Comp&ute a study…",
            self._choose,
            tip="Select a study file. An interrupted study continues",
        )
        self.interrupt = button(
            "study_interrupt",
            "Interrupt",
            self.close_run,
            tip="Computed points are kept; the same file continues the study",
        )
        self.progress = ElidedLabel("study_run_told", "Progress of the study")
        self.progress.setProperty("role", "caption")
        row(self.compute, self.interrupt, (self.progress, 1), on=self, margins=0, spacing=GAP)
        self._process = QProcess(self)
        self._process.finished.connect(self._finished)
        self._look = QTimer(self, interval=POLL_MS)
        self._look.timeout.connect(self._show)
        self._show()

    @property
    def running(self) -> bool:
        """Return whether a study is being computed."""
        return self._process.state() is not QProcess.ProcessState.NotRunning

    def begin(self, file: str) -> None:
        """Compute the study of a file into a folder of its name; resume an existing one."""
        if self.running:
            return
        self.target = self._folder / Path(file).stem
        workers = max(1, (os.cpu_count() or 2) - 1)
        program, *arguments = module_command(
            "rigapp", "study", file, "--to", self.target, "--workers", workers
        )
        self._process.start(program, arguments)
        self._look.start()
        self._show()

    def close_run(self) -> None:
        """Interrupt the study; finished points are saved."""
        if self.running:
            self._process.terminate()
            if not self._process.waitForFinished(POLL_MS):
                self._process.kill()
                self._process.waitForFinished(POLL_MS)

    def _choose(self) -> None:
        choose_paths(
            self,
            "Choose a study",
            lambda files: self.begin(files[0]),
            QFileDialog.FileMode.ExistingFile,
            "Studies (*.toml)",
        )

    def _show(self) -> None:
        self.compute.setEnabled(not self.running)
        self.interrupt.setEnabled(self.running)
        if self.running:
            done = grouped(points_done(self.target))
            self.progress.show_text(tr("{}: {} points are computed.", self.target.name, done))

    def _finished(self, status: int, how: QProcess.ExitStatus) -> None:
        self._look.stop()
        self._show()
        process = self._process
        errors = bytes(process.readAllStandardError().data()).decode(errors="replace").strip()
        output = bytes(process.readAllStandardOutput().data()).decode(errors="replace").strip()
        lines = (output or errors).splitlines()
        text = lines[0].removeprefix("rigapp: ") if lines else ""
        if how is QProcess.ExitStatus.CrashExit:
            done = grouped(points_done(self.target))
            text = tr("{}: interrupted after {} points.", self.target.name, done)
        self.progress.show_text(text)
        self.ended.emit(self.target)


class StudiesPanel(QWidget):
    """List the studies on the left, the selected one on the right: points, dependence, power."""

    reported = Signal(str, bool)
    takes = Takes(0)

    def __init__(self, theme: Theme, folder: Path, worker: TaskWorker) -> None:
        super().__init__()
        self._folder, self._worker = folder, worker
        self._opened: tuple[Path, ...] = ()
        self._studies: tuple[StudyResults, ...] = ()
        self._shown: StudyResults | None = None
        self._wanted: Path | None = None
        named(self, "studies", "Studies")
        self.summary = ElidedLabel("studies_told", "Studies in the folder")
        self.summary.setProperty("role", "caption")
        self.another = button("studies_open", "Open another stud&y…", self._choose_folder)
        self.again = button("studies_again", "Refres&h", self.look, tip="Read the folders again")
        self.run = StudyRun(folder)
        self.run.ended.connect(lambda target: self.open_folder(str(target)))
        self.list = PlainTable(
            "study_list", "List of studies", ("Study", "Computes", "Points", "Changed"), cut=(0,)
        )
        self.list.itemSelectionChanged.connect(self._choose)
        self.sentence = prose("study_sentence", "Results of the study")
        self.plot = StudyPlot(theme)
        self.plot.result.currentIndexChanged.connect(self._show_dependence)
        self.depends = PlainTable("study_depends", "What the result depends on", DEPENDS, cut=(0,))
        self.power = PlainTable(
            "study_power", "Number of revolutions until it is detected", HEADINGS
        )
        self.failed = PlainTable(
            "study_failed", "Points without a result, and with notes", FAILED, stretch=(1,)
        )
        self._lay_out()

    def _lay_out(self) -> None:
        self.depends_title = prose("study_depends_title", "What the result depends on most")
        power_title = prose(
            "study_power_title", "What the table of the detection power shows", POWER_TITLE
        )
        self._power = page(power_title, (self.power, 1))
        self._depends = page(self.depends_title, (self.depends, 1))
        below = WrappingGrid(TABLE_WIDTH)
        for part in (self._depends, self._power, self.failed):
            part.setMinimumHeight(TABLE_HEIGHT)
            below.addWidget(part)
        self._under = QWidget()
        self._under.setLayout(below)
        parts = split("study_parts", Qt.Orientation.Vertical, [420, 200], self.plot, self._under)
        right = page(self.sentence, (parts, 1))
        both = FoldingSplitter("studies_split", BESIDE_FROM).divide(
            (self.list, 360, TABLE_HEIGHT), (right, 960, STUDY_HEIGHT)
        )
        self.summary.setMinimumWidth(SUMMARY_WIDTH)
        head = flowing((self.summary, 1), self.another, self.again)
        column(head, self.run, (both, 1), on=self, spacing=GAP)
        self._show(None)

    def showEvent(self, event: QShowEvent) -> None:
        """Read the studies."""
        super().showEvent(event)
        self.look()

    def show_news(self, news: News) -> None:
        """Ignore the news: a study does not depend on the running test."""

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.plot.dress(theme)

    def look(self) -> None:
        """Read the studies again, on the worker."""
        folders = (self._folder, *self._opened)
        self._worker.submit(lambda: _existing(folders), self._list, self._not_read)

    def open_folder(self, folder: str) -> None:
        """List the studies of one more folder, and select the newest of them."""
        path = Path(folder)
        if path not in self._opened:
            self._opened = (path, *self._opened)
        self._wanted = path
        self.look()

    def _choose_folder(self) -> None:
        choose_paths(
            self,
            "Open another study",
            lambda folders: self.open_folder(folders[0]),
            QFileDialog.FileMode.Directory,
        )

    def _list(self, studies: tuple[StudyResults, ...]) -> None:
        """List studies; keep the shown or requested one selected, else select the newest."""
        wanted = self._wanted
        near = [wanted in (study.folder, study.folder.parent) for study in studies]
        index = near.index(True) if True in near else None
        if index is None and wanted in self._opened:
            self.reported.emit(tr("There is no study in {}.", wanted), False)
        self._studies = studies
        self.list.blockSignals(True)
        self.list.show_rows([_row(study) for study in studies])
        self.list.clearSelection()
        if studies:
            self.list.selectRow(index or 0)
        self.list.blockSignals(False)
        count = tr("Studies in {}: {}", self._folder, grouped(len(studies)))
        self.summary.show_text(count if studies else tr(NO_STUDIES, self._folder))
        self._choose()

    def _not_read(self, error: Exception) -> None:
        self.summary.show_text(tr("{} cannot be read: {}", self._folder, error))

    def _choose(self) -> None:
        self._show(self.list.chosen_of(self._studies))

    def _show(self, study: StudyResults | None) -> None:
        self._shown = study
        self._wanted = study.folder if study is not None else self._wanted
        self.sentence.setText(_sentence(study) if study is not None else "")
        failed = (*study.failed, *study.noted)[:MOST_FAILED] if study is not None else ()
        self.failed.show_rows([(grouped(number), translate(why)) for number, why in failed])
        self.failed.setVisible(bool(failed))
        self._show_power(study.power if study is not None else ())
        self.plot.show_study(study)
        self._show_dependence()

    def _show_power(self, power: Sequence[PowerRow]) -> None:
        """Show a row for each factor and a column for each share of the tests."""
        shares = sorted({entry.share for entry in power})
        self.power.setColumnCount(len(HEADINGS) + len(shares))
        percents = [f"{100.0 * share:.0f} %" for share in shares]
        self.power.setHorizontalHeaderLabels([*(tr(heading) for heading in HEADINGS), *percents])
        self.power.show_rows(
            [
                (f"{factor:g}", grouped(rows[0].tests), *(_revolutions(entry) for entry in rows))
                for factor, rows in _by_factor(power)
            ]
        )
        self._power.setVisible(bool(power))

    def _show_dependence(self) -> None:
        """Show the sensitivities of the drawn result, where the design allows it."""
        study, result = self._shown, self.plot.column
        dependence = _dependence(study, result.name) if study and result else []
        self.depends.show_rows([texts for _, texts in dependence])
        self._depends.setVisible(bool(dependence))
        parts = (self._depends, self._power, self.failed)
        self._under.setVisible(any(part.isVisibleTo(self._under) for part in parts))
        if dependence:
            most = max(dependence, key=lambda entry: entry[0])[1][0]
            clear = study is None or result is None or _resolved(study, result.name)
            title = tr(DEPENDS_MOST, most) if clear else tr(TOO_FEW)
            self.depends_title.setText(title)


def _existing(folders: Sequence[Path]) -> tuple[StudyResults, ...]:
    """Return the studies of the existing folders, each once."""
    studies = (study for folder in folders if folder.is_dir() for study in studies_in(folder))
    return tuple({study.folder: study for study in studies}.values())


def _row(study: StudyResults) -> tuple[str, ...]:
    changed = dated(MOMENT, time.localtime(study.changed))
    points = grouped(len(study.problems)) if study.problems else "–"
    return study.folder.name, study.kind or "–", points, changed


def _resolved(study: StudyResults, result: str) -> bool:
    """Return whether there are enough points for the sensitivities of a result."""
    known, keys = (study.sensitivities or {}).get(result), len(study.parameters)
    return known is None or not known.points_needed(max(len(study.problems) // (keys + 2), 1))


def _sentence(study: StudyResults) -> str:
    """Return the number of points with a result, or why there is no table."""
    if study.reason:
        return translate(study.reason)
    points, waiting, failed = len(study.problems), study.waiting, len(study.failed)
    done = grouped(points - waiting - failed)
    if waiting:
        sentence = tr(SOME_WAIT, done, grouped(points), grouped(waiting), grouped(failed))
    elif failed:
        sentence = tr(SOME_FAILED, done, grouped(points))
    else:
        sentence = tr(ALL_DONE, done)
    return sentence


def _by_factor(power: Sequence[PowerRow]) -> list[tuple[float, list[PowerRow]]]:
    """Return the rows of each factor, in the order of their shares."""
    ordered = sorted(power, key=lambda entry: (entry.factor, entry.share))
    return [(factor, list(rows)) for factor, rows in groupby(ordered, lambda entry: entry.factor)]


def _revolutions(entry: PowerRow) -> str:
    known = math.isfinite(entry.revolutions)
    return grouped(round(entry.revolutions)) if known else tr("not in time")


def _dependence(study: StudyResults, result: str) -> list[tuple[float, tuple[str, ...]]]:
    """Return each parameter's total share of a result's variance, and the texts of its row."""
    known = (study.sensitivities or {}).get(result)
    if known is None:
        return []
    first = zip(known.first_order, known.first_order_low, known.first_order_high, strict=True)
    total = zip(known.total, known.total_low, known.total_high, strict=True)
    titles = [parameter_title(parameter, study) for parameter in study.parameters]
    return [
        (float(with_others[0]), (title, _share(*alone), _share(*with_others)))
        for title, alone, with_others in zip(titles, first, total, strict=True)
    ]


def _share(middle: float, low: float, high: float) -> str:
    shares = (axis_number(100.0 * share, 1.0) for share in (middle, low, high))
    return tr("{} % ({} to {})", *shares)


def studies_page(host: Host) -> QWidget:
    """Make the page of the studies."""
    panel = host.add("studies", StudiesPanel(host.theme, host.results_folder, host.worker))
    panel.reported.connect(host.say)
    return panel
