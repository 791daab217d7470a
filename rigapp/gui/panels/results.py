"""Recorded tests of a folder: search, show, compare, write documents."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QHideEvent, QKeySequence, QResizeEvent, QShortcut, QShowEvent
from PySide6.QtWidgets import QFrame, QScrollArea, QWidget

from rigapp.gui.panel import Act, Host
from rigapp.gui.panels.compare import MOST, ComparePanel
from rigapp.gui.panels.trip import TripPage
from rigapp.gui.results.documents import DocumentPanel, Launch, launch_process
from rigapp.gui.results.resultcard import ResultCard
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.gui.results.resulttable import ResultTable
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    edit,
    fit_hint,
    named,
    prose,
    row,
    split,
)
from rigapp.gui.widgets.labels import heading
from rigapp.gui.widgets.reflow import FoldingSplitter, flowing
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import OUTCOMES
from rigapp.presentation.tokens import GAP, MARGIN, STEP, Theme
from rigapp.presentation.translation import Text, marked, tr
from rigapp.schema.messages import HowEnded
from rigapp.schema.results import RESUMABLE, TestResult
from rigapp.viewer.news import News, Takes
from rigapp.viewer.tasks import TaskWorker

PUMP_MS = 50
"""Period of checks for results while the folder is being read."""
QUIET_PUMP_MS = 250
"""Period of checks while nothing is being read: an idle window needs little processor time."""
SETTLED_MS = 300
"""Time after which a selected test is evaluated in detail, which takes another process a second."""
CARD_WIDTH = 42 * STEP
BESIDE_FROM, LIST_HEIGHT, CARD_HEIGHT = 112 * STEP, 44 * STEP, 60 * STEP
"""Width of list and card beside each other; height of each below the other."""
BOTH_HEIGHT = 70 * STEP
"""Height of list and comparison below each other; the list is hidden on a lower page."""
NO_CHOICE: Final[Text] = "Select a test to see its results."
TRIPPED = frozenset({HowEnded.TRIPPED, HowEnded.FAULT})
"""Outcomes of tests whose file may have the seconds around a trip."""


def show_trip(host: Host, path: str) -> None:
    """Open the trip page of a test."""
    page = host.panels["trip"]
    assert isinstance(page, TripPage)
    page.show_test(Path(path))
    host.do(Act.TRIP)


class ResultsPump(QTimer):
    """Collect the results that the shelf has read, and call ``changed`` after changes."""

    def __init__(self, shelf: ResultsIndex, changed: Callable[[], None], parent: QWidget) -> None:
        super().__init__(parent)
        self._shelf, self._changed = shelf, changed
        self._version = -1
        self.setInterval(PUMP_MS)
        self.timeout.connect(self.pump)

    def pump(self) -> None:
        """Check once, and more often while results are pending."""
        self._shelf.pump()
        self.setInterval(PUMP_MS if self._shelf.reading else QUIET_PUMP_MS)
        if self._shelf.version != self._version:
            self._version = self._shelf.version
            self._changed()


class ResultsPanel(QWidget):
    """List the tests at the left, the result of the chosen one at the right, a comparison below."""

    wanted = Signal(str, dict)
    reported = Signal(str, bool)
    trip_wanted = Signal(str)
    takes = Takes(0)

    def __init__(
        self, theme: Theme, shelf: ResultsIndex, worker: TaskWorker, launch: Launch = launch_process
    ) -> None:
        super().__init__()
        self._shelf, self._launch = shelf, launch
        named(self, "results", "Recorded tests")
        self.table = ResultTable("result_table", shelf, theme)
        self.table.chosen_changed.connect(self._choose)
        self.table.opened.connect(self._open)
        self.words = edit("result_filter", "Show only tests with these words", self._filter)
        self.words.setPlaceholderText(tr("Title, specimen, file, operator, reason"))
        self.words.setClearButtonEnabled(True)
        QShortcut(QKeySequence.StandardKey.Find, self, self.words.setFocus)
        endings = [(marked("All"), None), *((OUTCOMES[ending], ending) for ending in HowEnded)]
        self.ending = choice(
            "result_ending", "Show only tests that ended so", endings, self._filter
        )
        self.count = prose("result_count", "Tests in the folder", role="caption")
        self.again = button("result_again", "Refres&h", self.look, tip="Read the folder again")
        self.card = ResultCard("result_card", theme, across=2)
        self.documents = DocumentPanel("result", self.reported.emit)
        self.buttons = {
            "open": button(
                "result_open",
                "Open",
                self._open_chosen,
                tip="Replay the complete test in a separate window (Enter)",
                rank="primary",
            ),
            "compare": button(
                "result_compare",
                "Co&mpare",
                self._compare,
                tip=tr("Draw up to {} chosen tests in one plot", MOST),
            ),
            "trip": button(
                "result_trip",
                "Trip",
                self._trip,
                tip="Show the seconds around the trip of the chosen test",
            ),
            "resume": button(
                "result_resume",
                "&Resume test",
                self._resume,
                tip="Resume an interrupted or stopped test",
                guarded=True,
            ),
        }
        self.compare = ComparePanel(theme, worker)
        self.away = button("compare_away", "Close the comparison", self._close_comparison)
        self._settled = QTimer(self, singleShot=True, interval=SETTLED_MS)
        self._settled.timeout.connect(self._request_details)
        self._pump = ResultsPump(shelf, self._changed, self)
        self._lay_out()
        self._choose()

    def _lay_out(self) -> None:
        fit_hint(self.words)
        top = flowing("Find", (self.words, 2), "Ended", self.ending, self.again)
        card = QFrame()
        card.setProperty("role", "card")
        column(
            heading("documents_title", "Documents"),
            self.documents,
            on=card,
            margins=(MARGIN, GAP),
            spacing=STEP,
        )
        acts = row((self.buttons["open"], 1), (self.buttons["compare"], 1), spacing=STEP)
        inside = QWidget()
        more = row((self.buttons["resume"], 1), (self.buttons["trip"], 1), spacing=STEP)
        column(acts, more, self.card, card, None, on=inside, spacing=GAP)
        area = named(QScrollArea(), "result_side", "The chosen test")
        area.setWidgetResizable(True)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it scrolls to the focused widget
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(inside)
        area.setMinimumWidth(CARD_WIDTH)
        self._compared = QWidget()
        column(row(None, self.away), (self.compare, 1), on=self._compared)
        self._compared.hide()
        both = split(
            "results_split", Qt.Orientation.Vertical, [260, 340], self.table, self._compared
        )
        left = QWidget()
        column(top, self.count, (both, 1), on=left, spacing=STEP)
        self._parts = FoldingSplitter("results_fold", BESIDE_FROM).divide(
            (left, 900, LIST_HEIGHT), (area, CARD_WIDTH, CARD_HEIGHT)
        )
        self._parts.setStretchFactor(0, 1)
        column(self._parts, on=self)

    def showEvent(self, event: QShowEvent) -> None:
        """Read the folder and start to collect results."""
        super().showEvent(event)
        self._pump.start()
        self.look()

    def hideEvent(self, event: QHideEvent) -> None:
        """Stop while the page is hidden; results already read are kept."""
        super().hideEvent(event)
        self._pump.stop()

    def show_news(self, news: News) -> None:
        """Ignore the news: the folder is read when the page is shown."""

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.table.dress(theme)
        self.card.dress(theme)
        self.compare.dress(theme)

    def look(self) -> None:
        """Read the folder again."""
        self._shelf.look()

    def compare_with(self, test: TestResult) -> None:
        """Compare a test with the newest tests of the same title."""
        self.look()
        path, title = test.path, test.title
        alike = [
            other
            for other in self._shelf.paths
            if (result := self._shelf.result(other)) is not None and result.title == title
        ]
        self.table.choose({path, *alike[:MOST]})
        self._draw([path, *(other for other in alike if other != path)])

    def chosen(self) -> list[TestResult]:
        """Return the results of the selected tests, as far as they are read."""
        known = (self._shelf.result(path) for path in self.table.chosen_paths())
        return [result for result in known if result is not None]

    def _changed(self) -> None:
        self.table.refresh()
        shown, listed = len(self.table.rows.rows), len(self._shelf.paths)
        text = tr("{} of {} tests in {}", grouped(shown), grouped(listed), self._shelf.folder)
        unread = len(self._shelf.unread)
        if unread:
            text = tr("{} still to be read; {}", grouped(unread), text)
        self.count.setText(tr(self._shelf.problem or text))
        if self._shelf.problem:
            self.reported.emit(self._shelf.problem, False)
        newest = self.chosen()
        if self.card.result is None or (newest and newest[0].modified != self.card.result.modified):
            self._choose()

    def _filter(self, *_: object) -> None:
        self.table.filter(self.words.text(), self.ending.currentData())
        self._changed()

    def _choose(self) -> None:
        chosen = self.chosen()
        first = chosen[0] if chosen else None
        readable = bool(chosen) and HowEnded.NOT_READABLE not in {test.outcome for test in chosen}
        single = readable and len(chosen) == 1
        if first is None or self.card.result is None or first.path != self.card.result.path:
            self.card.show_result(first, NO_CHOICE)
        self.documents.show_test(Path(first.path) if first is not None and single else None)
        self.buttons["open"].setEnabled(single)
        self.buttons["compare"].setEnabled(readable)
        resumable = first is not None and first.status in RESUMABLE
        self.buttons["resume"].setEnabled(single and resumable)
        tripped = first is not None and first.outcome in TRIPPED
        self.buttons["trip"].setEnabled(single and tripped)
        if single:
            self._settled.start()

    def _request_details(self) -> None:
        shown = self.card.result
        if shown is not None and self.isVisible():
            self._shelf.ask(Path(shown.path), self._show_details)

    def _show_details(self, result: TestResult) -> None:
        if self.card.result is not None and self.card.result.path == result.path:
            self.card.show_result(result, "")

    def _open_chosen(self) -> None:
        self._open(self.chosen()[0].path)

    def _open(self, path: str) -> None:
        known = self._shelf.result(path)
        if known is not None and known.outcome is not HowEnded.NOT_READABLE:
            self._launch(["replay", path])

    def _compare(self) -> None:
        self._draw([result.path for result in self.chosen()])

    def _draw(self, paths: list[str]) -> None:
        self._compared.show()
        self._fold()
        self.compare.load([Path(path) for path in paths])

    def _close_comparison(self) -> None:
        self._compared.hide()
        self._fold()

    def _fold(self) -> None:
        """Hide the list on a low page; the compared curves show the names of their tests."""
        low = self._parts.folded or self.height() < BOTH_HEIGHT
        self.table.setHidden(low and not self._compared.isHidden())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show list and comparison where there is room for both."""
        super().resizeEvent(event)
        self._fold()

    def _trip(self) -> None:
        self.trip_wanted.emit(self.chosen()[0].path)

    def _resume(self) -> None:
        self.wanted.emit("resume_file", {"file": self.chosen()[0].path})


def results_page(host: Host) -> QWidget:
    """Make the page of the recorded tests."""
    panel = host.add("results", ResultsPanel(host.theme, host.results, host.worker))
    panel.wanted.connect(host.ask)
    panel.reported.connect(host.say)
    panel.trip_wanted.connect(partial(show_trip, host))
    return panel
