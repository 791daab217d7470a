"""The tab that prepares a test: form on the left, checks on the right."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QSplitter

from rigapp.config.rig import RigFile
from rigapp.engine.messages import Status
from rigapp.gui.palette import Theme
from rigapp.gui.preflight import DiskFacts, PreflightPanel, disk_facts, preflight
from rigapp.gui.recipe import RecipePanel
from rigapp.gui.tasks import Worker

DEFAULT_RATE_HZ = 1000.0


class PreparePanel(QSplitter):
    """Hold form and checks; the disk is looked at on a worker whenever the test changes."""

    def __init__(self, theme: Theme, results_folder: Path, worker: Worker) -> None:
        super().__init__(Qt.Orientation.Horizontal)
        self._folder = results_folder
        self._worker = worker
        self._rig: RigFile | None = None
        self._disk: DiskFacts | None = None
        self._asked: object = None
        self.setObjectName("prepare_split")
        self.setAccessibleName("Prepare a test")
        self.setChildrenCollapsible(False)
        self.recipe = RecipePanel(theme)
        self.checks = PreflightPanel(theme)
        right = QSplitter(Qt.Orientation.Vertical)
        right.setObjectName("prepare_right")
        right.setAccessibleName("Checks and limits")
        right.setChildrenCollapsible(False)
        right.addWidget(self.checks)
        right.addWidget(self.recipe.rules)
        right.setSizes([420, 220])
        self.addWidget(self.recipe)
        self.addWidget(right)
        self.setSizes([800, 600])

    def set_rig(self, rig: RigFile) -> None:
        """Take the rig file, for its ranges."""
        self._rig = rig

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.recipe.dress(theme)
        self.checks.dress(theme)

    def show_status(self, status: Status | None) -> None:
        """Check again."""
        rate = max((d.sample_rate_Hz for d in status.devices), default=0.0) if status else 0.0
        self._ask_disk(rate or DEFAULT_RATE_HZ)
        self.checks.show_checks(preflight(status, self.recipe.test, self._rig, self._disk))

    def _ask_disk(self, rate: float) -> None:
        test = self.recipe.test
        if test is None or (test, rate) == self._asked:
            return
        self._asked = (test, rate)
        self._worker.submit(
            lambda: disk_facts(test, rate, self._folder), self._got_disk, self._no_disk
        )

    def _got_disk(self, facts: DiskFacts) -> None:
        self._disk = facts

    def _no_disk(self, error: Exception) -> None:
        self._disk = DiskFacts(self._folder, 0, 0, f"cannot be judged: {error}")
