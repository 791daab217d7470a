"""The end of a test: reason, result, and next actions."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from PySide6.QtCore import QSize
from PySide6.QtGui import QHideEvent, QShowEvent
from PySide6.QtWidgets import QFrame, QSizePolicy, QStackedWidget, QWidget

from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.panel import Act, Host
from rigapp.gui.panels.results import TRIPPED, ResultsPanel, ResultsPump, show_trip
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.plotting import LEAST_HEIGHT
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.results.documents import HTML, DocumentPanel
from rigapp.gui.results.resultcard import ResultCard
from rigapp.gui.widgets.build import button, column, named, styled_label
from rigapp.gui.widgets.labels import heading
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import GAP, MARGIN, STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import NO_TEST, HowEnded, Status
from rigapp.schema.results import RESUMABLE, TestResult
from rigapp.schema.states import ACTIVE
from rigapp.viewer.news import News, Takes

TALL = 5 * STEP
PAPERS_WIDTH, PLOT_WIDTH = 38 * STEP, 40 * STEP
"""Minimum widths of documents and plot; documents that do not fit beside the plot move below."""
RESUME: Final[Text] = "Resume the test in its own file"
READING: Final[Text] = "Reading the results …"


def has_result(news: News) -> bool:
    """Return whether the shown test has ended."""
    status = news.status
    if status is None or news.is_replay or not (status.test or NO_TEST).file:
        return False
    return _over(status)


def _over(status: Status) -> bool:
    return status.engine.state not in ACTIVE


class EndPage(QWidget):
    """Show the result of the test that ended last, and the next actions."""

    takes = Takes.STATUS

    def __init__(self, host: Host) -> None:
        super().__init__()
        self._host = host
        self._requested = ""
        self._status: Status | None = None
        named(self, "result_page", "Result of the test")
        theme = host.theme
        self.card = ResultCard("end_card", theme, across=4)
        self.documents = DocumentPanel("end", host.say)
        self.buttons = {
            "report": button(
                "end_report",
                "&Report",
                self._report,
                tip="Write the report of the test beside its file",
                rank="primary",
            ),
            "compare": button(
                "end_compare",
                "Co&mpare…",
                self._compare,
                tip="Compare it with the newest tests of its title",
            ),
            "trip": button(
                "end_trip",
                "Trip",
                self._trip,
                tip="Show the seconds around the trip",
            ),
            "new": button(
                "end_new", "New spec&imen…", self._new, tip="Prepare the test of the next specimen"
            ),
            "on": button("end_on", "Res&ume this test…", self._resume, tip=RESUME, guarded=True),
        }
        self._pump = ResultsPump(host.results, lambda: None, self)
        wear = host.add("result_wear", TrendPanel("result_wear", theme, "wear", leads=False))
        self.trip = host.add("result_trip", OverlayPanel("result", theme))
        self.trip.show_force_alone()
        # The plots use only the remaining height.
        for plot in (wear.plot, self.trip.plot):
            plot.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
            plot.setMinimumHeight(LEAST_HEIGHT)
        self.plots = QStackedWidget()
        for panel in (wear, self.trip):
            self.plots.addWidget(panel)
        self._lay_out(self.plots)
        self.dress(theme)

    def _lay_out(self, plot: QWidget) -> None:
        for control in self.buttons.values():
            control.setFixedHeight(TALL)
            control.setIconSize(QSize(20, 20))
        buttons = self.buttons
        acts = flowing(
            buttons["report"],
            buttons["compare"],
            buttons["trip"],
            None,
            styled_label("Then", "caption"),
            buttons["new"],
            buttons["on"],
        )
        acts.setSpacing(STEP)
        papers = QFrame()
        papers.setProperty("role", "card")
        column(
            heading("end_documents_title", "Documents"),
            self.documents,
            None,
            on=papers,
            margins=(MARGIN, GAP),
            spacing=STEP,
        )
        papers.setMinimumWidth(PAPERS_WIDTH)
        plot.setMinimumWidth(PLOT_WIDTH)
        below = flowing((plot, 1), papers)
        column(self.card, acts, (below, 1), on=self, spacing=GAP)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.card.dress(theme)
        signs = {
            "report": (Icon.FILE, theme.highlighted_text),
            "compare": (Icon.COMPARE, theme.text),
            "trip": (Icon.TRIPPED, theme.text),
            "new": (Icon.SPECIMEN, theme.text),
            "on": (Icon.NEXT, theme.text),
        }
        for name, (meaning, colour) in signs.items():
            self.buttons[name].setIcon(icon(meaning, colour, theme.muted))

    def showEvent(self, event: QShowEvent) -> None:
        """Start to collect results."""
        super().showEvent(event)
        self._pump.start()

    def hideEvent(self, event: QHideEvent) -> None:
        """Stop while the page is hidden."""
        super().hideEvent(event)
        self._pump.stop()

    def show_news(self, news: News) -> None:
        """Read the file of a test when it has ended, and after later changes of its state."""
        self._status = news.status
        tripped = news.trip is not None and news.trip.cycle is not None
        self.plots.setCurrentIndex(self.plots.indexOf(self.trip) if tripped else 0)
        if not has_result(news):
            self._requested = ""
            return
        test = news.status.test if news.status is not None else None
        assert test is not None
        wanted = f"{test.file} {test.committed}"
        if wanted == self._requested:
            return
        self._requested = wanted
        self.card.show_result(None, READING)
        self._enable(None)
        self._host.results.ask(Path(test.file), self._show)

    def _show(self, result: TestResult) -> None:
        test = self._status.test if self._status is not None else None
        if test is None or result.path != test.file:
            return
        self.card.show_result(result, "")
        self._enable(result)

    def _enable(self, result: TestResult | None) -> None:
        readable = result is not None and result.outcome is not HowEnded.NOT_READABLE
        path = Path(result.path) if result is not None and readable else None
        self.documents.show_test(path)
        for name in ("report", "compare"):
            self.buttons[name].setEnabled(readable)
        tripped = result is not None and result.outcome in TRIPPED
        self.buttons["trip"].setVisible(tripped)
        on = self.buttons["on"]
        on.setEnabled(result is not None and result.status in RESUMABLE)
        on.setToolTip(tr(RESUME))
        if result is not None and not on.isEnabled():
            on.setToolTip(tr("The test is complete; prepare the next one with New specimen"))

    def _report(self) -> None:
        self.documents.begin(HTML)

    def _compare(self) -> None:
        results = self._host.panels["results"]
        assert isinstance(results, ResultsPanel)
        self._host.do(Act.RESULTS)
        if self.card.result is not None:
            results.compare_with(self.card.result)

    def _trip(self) -> None:
        if self.card.result is not None:
            show_trip(self._host, self.card.result.path)

    def _new(self) -> None:
        self._host.do(Act.PREPARE)

    def _resume(self) -> None:
        if self.card.result is not None:
            self._host.ask("resume_file", {"file": self.card.result.path})


def result_page(host: Host) -> QWidget:
    """Make the page of the end of a test."""
    return host.add("result", EndPage(host))
