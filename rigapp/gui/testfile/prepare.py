"""The tab that prepares a test: form on the left, checks on the right."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter, QWidget

from rigapp.calibrating.records_in_use import RigRecords, with_records
from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.look.tokens import Theme
from rigapp.gui.panel import Host
from rigapp.gui.testfile.preflight import PreflightPanel
from rigapp.gui.testfile.recipe import RecipePanel
from rigapp.gui.widgets.build import named, split
from rigapp.service.preflight import Check, Checked, DiskFacts, disk_facts, preflight

DEFAULT_RATE_HZ = 1000.0  # to judge the disk by, until a device tells its own
LOOK_AGAIN_S = 20.0
"""The rig file, its calibration records and the disk are looked at so often."""


class PreparePanel(QSplitter):
    """Hold form and checks; disk and records are looked at on a worker, again and again."""

    takes = Takes.HISTORY

    def __init__(
        self,
        theme: Theme,
        results_folder: Path,
        worker: TaskWorker,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._folder = results_folder
        self._worker = worker
        self._clock = clock
        self._rig: Path | None = None
        self._records: RigRecords | None = None
        self._problem = ""
        self._disk: DiskFacts | None = None
        self._asked: object = None
        self._asked_at = 0.0
        self._looked_at: float | None = None
        named(self, "prepare_split", "Prepare a test")
        self.setChildrenCollapsible(False)
        self.recipe = RecipePanel(theme)
        self.checks = PreflightPanel(theme)
        right = split(
            "prepare_right",
            Qt.Orientation.Vertical,
            [420, 220],
            self.checks,
            self.recipe.rules,
            spoken="Checks and limits",
        )
        self.addWidget(self.recipe)
        self.addWidget(right)
        self.setSizes([800, 600])

    def set_rig(self, rig: Path) -> None:
        """Take the rig file, for its ranges and its calibration records."""
        self._rig = rig
        self._looked_at = None

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.recipe.dress(theme)
        self.checks.dress(theme)

    def show_news(self, news: News) -> None:
        """Check again."""
        status = news.status
        rate = max((d.sample_rate_Hz for d in status.devices), default=0.0) if status else 0.0
        self._ask_disk(rate or DEFAULT_RATE_HZ)
        self._ask_records()
        found = preflight(self.recipe.test, self._records, self._disk, status)
        if self._problem:
            found.insert(1, Check("Rig file", Checked.BLOCKS, self._problem, "Correct it"))
        self.checks.show_checks(found)

    def _ask_records(self) -> None:
        rig, now = self._rig, self._clock()
        if rig is None or (self._looked_at is not None and now < self._looked_at + LOOK_AGAIN_S):
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
        self._problem = str(error) if isinstance(error, UnusableInput) else repr(error)

    def _ask_disk(self, rate: float) -> None:
        test, now = self.recipe.test, self._clock()
        if test is None:
            return
        if (test, rate) == self._asked and now < self._asked_at + LOOK_AGAIN_S:
            return
        self._asked, self._asked_at = (test, rate), now
        self._worker.submit(
            lambda: disk_facts(test, rate, self._folder), self._got_disk, self._no_disk
        )

    def _got_disk(self, facts: DiskFacts) -> None:
        self._disk = facts

    def _no_disk(self, error: Exception) -> None:
        self._disk = DiskFacts(self._folder, 0, 0, f"cannot be judged: {error}")


def prepare_page(host: Host) -> QWidget:
    """Make the page that prepares a test."""
    panel = host.add("prepare", PreparePanel(host.theme, host.results_folder, host.worker))
    panel.recipe.start_wanted.connect(host.offer_start)
    return panel
