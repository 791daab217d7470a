"""The recorded tests of a folder: what they are, go on, replay, report, compare."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QSplitter, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.data.texts import grouped
from rigapp.gui.look.tokens import Theme
from rigapp.gui.panel import Host
from rigapp.gui.panels.compare import ComparePanel
from rigapp.gui.widgets.build import button, named, page, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.tables import PlainTable

HEADINGS = ("File", "State", "Title", "Specimen", "Revolutions", "Cycles", "Started", "Reason")
REPORT_TIMEOUT_S = 300.0  # a report that takes longer has hung
RESUMABLE = ("interrupted", "stopped")

Launch = Callable[[Sequence[str]], None]


@dataclass(frozen=True, slots=True)
class Recorded:
    """One test file in a few words; problem: why it cannot be read."""

    path: Path
    status: str
    title: str = ""
    specimen: str = ""
    revolutions: int = 0
    cycles: int = 0
    started: str = ""
    reason: str = ""


def list_tests(folder: Path) -> list[Recorded]:
    """Return the test files of a folder, newest first; reads each, call it on a worker."""
    paths = sorted(folder.glob("*.h5"), key=lambda path: path.stat().st_mtime, reverse=True)
    return [_recorded(path) for path in paths]


def _recorded(path: Path) -> Recorded:
    from rigapp.storage import open_test

    try:
        with open_test(path) as test:
            summary, metadata = test.summary(), test.metadata()
    except UnusableInput as error:
        return Recorded(path, "not readable", reason=str(error))
    return Recorded(
        path,
        summary["status"],
        metadata["title"],
        metadata["specimen"],
        summary["revolutions"],
        summary["cycles_saved"],
        summary["started"][:19].replace("T", " "),
        summary["reason"],
    )


def launch_process(arguments: Sequence[str]) -> None:
    """Start another rigapp on its own, which lives on when this window closes."""
    subprocess.Popen(
        [sys.executable, "-m", "rigapp", *arguments],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def make_report(path: Path) -> Path:
    """Write the report of a test beside it and return its path; call it on a worker."""
    target = path.with_suffix(".html")
    done = subprocess.run(
        [sys.executable, "-m", "rigapp", "report", str(path), "--to", str(target)],
        capture_output=True,
        text=True,
        timeout=REPORT_TIMEOUT_S,
        check=False,
    )
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"exit status {done.returncode}")
    return target


class BrowserPanel(QSplitter):
    """List the files above, compare the chosen ones below."""

    wanted = Signal(str, dict)
    takes = Takes(0)
    said = Signal(str, bool)

    def __init__(
        self, theme: Theme, folder: Path, worker: TaskWorker, launch: Launch = launch_process
    ) -> None:
        super().__init__(Qt.Orientation.Vertical)
        self._theme = theme
        self._folder = folder
        self._worker = worker
        self._launch = launch
        self._found: list[Recorded] = []
        named(self, "browser_split", "Recorded tests")
        self.setChildrenCollapsible(False)
        self.table = PlainTable("file_table", "Recorded tests", HEADINGS)
        self.table.setSelectionMode(PlainTable.SelectionMode.ExtendedSelection)
        self.table.itemSelectionChanged.connect(self._enable)
        self.where = ElidedLabel("results_folder", "Folder of the recorded tests")
        self.where.show_text(str(folder))
        self.buttons = {
            name: button(f"browser_{name}", text, call, tip, tip=tip, guarded=name == "resume")
            for name, text, tip, call in (
                ("refresh", "&Look again", "Read the folder again", self.look),
                ("compare", "Co&mpare", "Compare the chosen tests", self._compare),
                (
                    "replay",
                    "Repla&y",
                    "Replay the chosen test in a window of its own",
                    self._replay,
                ),
                ("report", "Report", "Write the report of the chosen test", self._report),
                (
                    "resume",
                    "&Go on with it",
                    "Go on with an interrupted or stopped test",
                    self._resume,
                ),
            )
        }
        self.compare = ComparePanel(theme, worker)
        self.addWidget(page(row((self.where, 1), *self.buttons.values()), (self.table, 1)))
        self.addWidget(self.compare)
        self.setSizes([260, 340])
        self._enable()

    def showEvent(self, event: QShowEvent) -> None:
        """Look what is there."""
        super().showEvent(event)
        self.look()

    def show_news(self, news: News) -> None:
        """Take nothing: a folder changes when somebody looks at it."""

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.compare.dress(theme)
        self._fill()

    def look(self) -> None:
        """Read the folder on the worker."""
        folder = self._folder
        self._worker.submit(lambda: list_tests(folder), self._found_tests, self._cannot)

    def chosen(self) -> list[Recorded]:
        """Return the chosen files."""
        return [self._found[at] for at in self.table.all_chosen() if at < len(self._found)]

    def _found_tests(self, found: list[Recorded]) -> None:
        if found != self._found:
            self._found = found
            self._fill()
        self._enable()

    def _fill(self) -> None:
        rows = [
            (
                one.path.name,
                one.status,
                one.title,
                one.specimen,
                grouped(one.revolutions),
                str(one.cycles),
                one.started,
                one.reason,
            )
            for one in self._found
        ]
        odd = {"interrupted", "not readable"}
        warning = self._theme.mark(critical=False)
        self.table.show_rows(rows, [warning if one.status in odd else None for one in self._found])

    def _cannot(self, error: Exception) -> None:
        self.said.emit(f"{self._folder} cannot be read: {error}", False)

    def _enable(self) -> None:
        chosen = self.chosen()
        readable = bool(chosen) and all(one.status != "not readable" for one in chosen)
        self.buttons["compare"].setEnabled(readable)
        for name in ("replay", "report"):
            self.buttons[name].setEnabled(readable and len(chosen) == 1)
        open_ended = len(chosen) == 1 and chosen[0].status in RESUMABLE
        self.buttons["resume"].setEnabled(open_ended)

    def _compare(self) -> None:
        self.compare.load([one.path for one in self.chosen()])

    def _replay(self) -> None:
        self._launch(["replay", str(self.chosen()[0].path)])

    def _resume(self) -> None:
        self.wanted.emit("resume_file", {"file": str(self.chosen()[0].path)})

    def _report(self) -> None:
        path = self.chosen()[0].path
        self.said.emit(f"Writing the report of {path.name} …", True)
        self._worker.submit(
            lambda: make_report(path),
            lambda target: self.said.emit(f"The report is in {target}", True),
            lambda error: self.said.emit(f"No report of {path.name}: {error}", False),
        )


def browser_page(host: Host) -> QWidget:
    """Make the page of the recorded tests."""
    panel = host.add("browser", BrowserPanel(host.theme, host.results_folder, host.worker))
    panel.wanted.connect(host.ask)
    panel.said.connect(host.say)
    return panel
