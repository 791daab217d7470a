"""The page that prepares a test: form on the left, checks of the selected test on the right."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.calibrating.records_in_use import with_records
from rigapp.checks.check import Check, CheckVerdict
from rigapp.checks.start import DiskFacts, preflight
from rigapp.config.channels import channel_table
from rigapp.config.loading import RigRecords, read_rig
from rigapp.config.recipe import TestFile
from rigapp.gui.panel import Host
from rigapp.gui.testfile.recipe import RecipePanel
from rigapp.gui.widgets.build import column, named, prose, row, scrolling, set_property
from rigapp.gui.widgets.details import FoldedDetails
from rigapp.presentation.tokens import GAP, MARGIN, STEP
from rigapp.presentation.translation import marked, tr, translate
from rigapp.schema.details import details_of, error_text
from rigapp.service.preflight import disk_facts
from rigapp.texts import say
from rigapp.viewer.news import News, Takes
from rigapp.viewer.tasks import TaskWorker

MARKS = {CheckVerdict.GOOD: "✓", CheckVerdict.ATTENTION: "▲", CheckVerdict.BLOCKS: "◆"}
ROLES = {
    CheckVerdict.GOOD: "",
    CheckVerdict.ATTENTION: "attention",
    CheckVerdict.BLOCKS: "critical",
}
ORDER = (CheckVerdict.BLOCKS, CheckVerdict.ATTENTION, CheckVerdict.GOOD)


class CheckRow(QFrame):
    """One check: mark, subject, finding and remedy."""

    def __init__(self, number: int) -> None:
        super().__init__()
        named(self, f"check_{number}", "Check")
        self.mark = QLabel()
        self.mark.setFixedWidth(2 * STEP)
        self.what, self.finding, self.action = (
            prose(f"check_{number}_{name}", spoken)
            for name, spoken in (
                ("what", "Check"),
                ("finding", marked("What was found")),
                ("action", marked("What to do")),
            )
        )
        self.what.setProperty("role", "title")
        self.finding.setProperty("role", "caption")
        self.details = FoldedDetails(f"check_{number}")
        texts = column(self.what, self.finding, self.action, self.details, spacing=0)
        layout = row(self.mark, (texts, 1), on=self, margins=(STEP, STEP // 2))
        layout.setAlignment(self.mark, Qt.AlignmentFlag.AlignTop)

    def show_check(self, check: Check) -> None:
        """Show a check."""
        good = check.verdict is CheckVerdict.GOOD
        set_property(self, "role", ROLES[check.verdict])
        self.mark.setText(MARKS[check.verdict])
        what, finding, action = map(translate, (check.name, check.sentence, check.advice))
        verdict = tr(check.verdict.value)
        self.what.setText(what if good else f"{what}: {verdict}")
        self.finding.setText(finding)
        self.details.show_details(details_of(check.sentence))
        self.action.setText(action)
        self.action.setVisible(bool(action))
        self.setAccessibleName(f"{what}: {verdict}, {finding} {action}")


class PreflightPanel(QFrame):
    """Show the checks."""

    def __init__(self) -> None:
        super().__init__()
        self.shown: list[Check] = []
        self.rows: list[CheckRow] = []
        named(self, "preflight_panel", "Checks before the start", role="card")
        self.title = named(
            QLabel(tr("Before the start")), "preflight_title", "Before the start", role="title"
        )
        self.count = prose("preflight_count", "Number of passed checks", role="caption")
        inside = QWidget()
        self._list = column(None, on=inside, spacing=STEP // 2)
        area = scrolling("preflight_area", "List of checks", inside)
        column(
            self.title,
            self.count,
            (area, 1),
            on=self,
            margins=(GAP, MARGIN, STEP, GAP),
            spacing=STEP // 2,
        )

    @property
    def words(self) -> str:
        """Return the number of checks of each kind."""
        count = Counter(check.verdict for check in self.shown)
        numbers = (
            count[kind] for kind in (CheckVerdict.GOOD, CheckVerdict.ATTENTION, CheckVerdict.BLOCKS)
        )
        return tr("{} passed, {} for attention, {} block", *numbers)

    def show_checks(self, checks: list[Check]) -> None:
        """Show the checks, blocking ones first."""
        ordered = sorted(checks, key=lambda check: ORDER.index(check.verdict))
        if ordered == self.shown:
            return
        self.shown = ordered
        self.count.setText(self.words)
        while len(self.rows) < len(ordered):
            self.rows.append(CheckRow(len(self.rows) + 1))
            self._list.insertWidget(len(self.rows) - 1, self.rows[-1])
        for line, check in zip(self.rows, ordered, strict=False):
            line.show_check(check)
        for index, line in enumerate(self.rows):
            line.setVisible(index < len(ordered))


DEFAULT_RATE_HZ = 1000.0  # for the estimate of disk space until a device reports its rate
NARROW = 136 * STEP
"""Minimum page width for the checks beside the form; the sentence of a limit needs this width."""
REREAD_S = 20.0
"""Period of reading the rig file, its calibration records and the disk space."""


class PreparePanel(QWidget):
    """Form and checks; disk and records are read periodically on a worker.

    The selected test is checked as it was read from its file; the form lists unsaved changes. Where
    there is no room beside the form, the checks are its last step.
    """

    takes = Takes.HISTORY

    def __init__(
        self,
        results_folder: Path,
        worker: TaskWorker,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        super().__init__()
        self._folder = results_folder
        self._worker = worker
        self._clock = clock
        self._rig: Path | None = None
        self._records: RigRecords | None = None
        self._problem = ""
        self._disk: DiskFacts | None = None
        self._requested: object = None
        self._requested_at = 0.0
        self._looked_at: float | None = None
        named(self, "prepare_page", "Prepare a test")
        self.recipe = RecipePanel()
        self.checks = PreflightPanel()
        self._layout = row((self.recipe, 3), on=self, margins=0, spacing=GAP)
        self._fit = QTimer(self, singleShot=True, interval=0)
        self._fit.timeout.connect(self._fit_checks)
        self._place_checks(narrow=False)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the checks where there is room, when the page has its final width."""
        super().resizeEvent(event)
        self._fit.start()

    def _fit_checks(self) -> None:
        self._place_checks(narrow=self.width() < NARROW)

    def _place_checks(self, *, narrow: bool) -> None:
        if narrow and self.recipe.pages.indexOf(self.checks) < 0:
            self._layout.removeWidget(self.checks)
            self.recipe.offer_checks(self.checks)
        elif not narrow and self._layout.indexOf(self.checks) < 0:
            self.recipe.offer_checks(None)
            self._layout.addWidget(self.checks, 1)
            self.checks.show()

    def parts(self) -> list[QWidget]:
        """Return the parts that are themed one by one."""
        return [self.checks, *self.recipe.parts()]

    def set_rig(self, rig: Path) -> None:
        """Use the ranges and the calibration records of a rig file."""
        self._rig = rig
        self._looked_at = None

    def show_news(self, news: News) -> None:
        """Repeat the checks."""
        status = news.status
        rate = max((d.sample_rate_Hz for d in status.rig.devices), default=0.0) if status else 0.0
        self._ask_disk(rate or DEFAULT_RATE_HZ)
        self._ask_records()
        checks = preflight(self._test, self._records, self._disk, status)
        if self._problem:
            checks.insert(
                1, Check(say("Rig file"), CheckVerdict.BLOCKS, self._problem, say("Correct it"))
            )
        self.checks.show_checks([*self._of_form(), *checks])
        blocking = sum(1 for check in self.checks.shown if check.verdict is CheckVerdict.BLOCKS)
        self.recipe.show_checks(self.checks.words, blocking)
        self.recipe.rules.show_usual(news)

    @property
    def _test(self) -> TestFile | None:
        selected = self.recipe.selected
        return selected.test if selected is not None else None

    def _of_form(self) -> Iterator[Check]:
        """Yield a check for unsaved changes of the form, or for a missing selected test."""
        selected = self.recipe.selected
        if selected is None:
            yield Check(
                say("Selected test"),
                CheckVerdict.BLOCKS,
                say("none"),
                say("Open a test, or save the new one"),
            )
            return
        if selected.problem:
            yield Check(
                say("File"),
                CheckVerdict.BLOCKS,
                selected.problem,
                say("Correct it in the form and save"),
            )
        count = len(self.recipe.unsaved())
        if count:
            name = selected.path.name
            finding = tr("1 change not part of {}", name)
            if count > 1:
                finding = tr("{} changes not part of {}", count, name)
            yield Check(say("Form"), CheckVerdict.ATTENTION, finding, say("Save, or start without"))
        if self.recipe.rules.draft is not None:
            yield Check(
                say("Draft limit"),
                CheckVerdict.ATTENTION,
                say("not part of the test"),
                say("Add or discard"),
            )

    def _ask_records(self) -> None:
        rig, now = self._rig, self._clock()
        if rig is None or (self._looked_at is not None and now < self._looked_at + REREAD_S):
            return
        self._looked_at = now
        self._worker.submit(
            lambda: with_records(read_rig(rig)), self._got_records, self._no_records
        )

    def _got_records(self, records: RigRecords) -> None:
        self._records, self._problem = records, ""
        self.recipe.rules.know(channel_table(records.rig.record))

    def _no_records(self, error: Exception) -> None:
        self._records = None
        self._problem = error_text(error, say("The test cannot be checked."))

    def _ask_disk(self, rate: float) -> None:
        test, now = self._test, self._clock()
        if test is None:
            return
        if (test, rate) == self._requested and now < self._requested_at + REREAD_S:
            return
        self._requested, self._requested_at = (test, rate), now
        self._worker.submit(
            lambda: disk_facts(test, rate, self._folder), self._got_disk, self._no_disk
        )

    def _got_disk(self, facts: DiskFacts) -> None:
        self._disk = facts

    def _no_disk(self, error: Exception) -> None:
        self._disk = DiskFacts(self._folder, 0, 0, say("cannot be evaluated ‹{}›", error))


def prepare_page(host: Host) -> QWidget:
    """Make the page that prepares a test."""
    return host.add("prepare", PreparePanel(host.results_folder, host.worker))
