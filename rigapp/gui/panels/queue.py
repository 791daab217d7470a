"""The queue of tests of the rig: add, remove, start, stop."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path, PurePath
from typing import Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFileDialog, QWidget

from rigapp.gui.panel import Host
from rigapp.gui.widgets.build import button, choose_paths, column, named, prose
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.tokens import GAP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.queue import ItemState, QueuedTest
from rigapp.viewer.news import News, Takes

NO_TESTS: Final[Text] = (
    "No test is in the queue. Add test files: each is recorded into a file of its own, and the next"
    " one begins when one is complete."
)
QUEUE_PAUSED: Final[Text] = "Queue paused; {} to be done."
QUEUE_RUNNING: Final[Text] = "Queue running: the next test starts by itself; {} to be done."
STOPPED: Final[Text] = (
    "Test {} did not end as planned, so the queue stopped. Start the queue to resume it"
    " in its own file, or remove it."
)
STATES: Final[dict[ItemState, Text]] = {
    ItemState.WAITING: "waiting",
    ItemState.RUNNING: "running",
    ItemState.DONE: "done",
    ItemState.STOPPED: "stopped",
}


class QueuePanel(QWidget):
    """List the queue and change it through requests to the engine, which holds it."""

    wanted = Signal(str, dict)
    takes = Takes.HISTORY

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._folder = folder
        self._tests: tuple[QueuedTest, ...] = ()
        named(self, "queue_panel", "Queue")
        self.summary = prose("queue_told", "What the queue does")
        self.list = PlainTable(
            "queue_list",
            "Tests of the queue",
            ("Number", "State", "Test", "File", "How it ended"),
            stretch=(4,),
            cut=(2, 3),
        )
        self.list.itemSelectionChanged.connect(self._offer)
        self.begin = button(
            "queue_start",
            "Start the &queue",
            lambda: self.wanted.emit("queue_start", {}),
            tip="Begin the next test, or resume the one that stopped",
            guarded=True,
            rank="primary",
        )
        self.halt = button(
            "queue_stop",
            "Stop &after this test",
            lambda: self.wanted.emit("queue_stop", {}),
            tip="The running test continues to its end; no other one starts",
            guarded=True,
        )
        self.add = button("queue_add", "A&dd test files…", self._choose, guarded=True)
        self.take_out = button(
            "queue_remove",
            "Re&move",
            self._remove,
            tip="Remove the selected test from the queue; its recording is kept",
            guarded=True,
        )
        buttons = flowing(self.begin, self.halt, None, self.add, self.take_out)
        column(self.summary, (self.list, 1), buttons, on=self, spacing=GAP)
        self._show((), works=False)

    def show_news(self, news: News) -> None:
        """Show the queue of the engine."""
        status = news.status
        if status is not None:
            self._show(status.engine.queue, works=status.engine.queue_works)

    def add_files(self, paths: Sequence[str]) -> None:
        """Request to append test files to the queue."""
        if paths:
            folder = str(self._folder.resolve())
            self.wanted.emit("queue_add", {"tests": list(paths), "folder": folder})

    def _show(self, tests: tuple[QueuedTest, ...], *, works: bool) -> None:
        self._tests = tests
        self.list.show_rows([_texts(test) for test in tests])
        left = [test for test in tests if test.state is not ItemState.DONE]
        running = any(test.state is ItemState.RUNNING for test in tests)
        stopped = next((test for test in tests if test.state is ItemState.STOPPED), None)
        summary = tr(QUEUE_RUNNING if works else QUEUE_PAUSED, len(left)) if tests else tr(NO_TESTS)
        if stopped is not None and not running:
            summary = tr(STOPPED, stopped.number)
        self.summary.setText(summary)
        self.begin.setEnabled(bool(left) and not running)
        self.halt.setEnabled(works)
        self._offer()

    def _offer(self) -> None:
        chosen = self._chosen()
        self.take_out.setEnabled(chosen is not None and chosen.state is not ItemState.RUNNING)

    def _chosen(self) -> QueuedTest | None:
        return self.list.chosen_of(self._tests)

    def _remove(self) -> None:
        chosen = self._chosen()
        if chosen is not None:
            self.wanted.emit("queue_remove", {"numbers": [chosen.number]})

    def _choose(self) -> None:
        mode = QFileDialog.FileMode.ExistingFiles
        choose_paths(self, "Choose tests", self.add_files, mode, "Tests (*.toml)")


def _texts(test: QueuedTest) -> tuple[str, ...]:
    name, file = PurePath(test.test).name, PurePath(test.file).name if test.file else ""
    return str(test.number), tr(STATES[test.state]), name, file, translate(test.sentence)


def queue_page(host: Host) -> QWidget:
    """Make the page of the queue."""
    panel = host.add("queue", QueuePanel(host.results_folder))
    panel.wanted.connect(host.ask)
    return panel
