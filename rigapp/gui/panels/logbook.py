"""The log of the test: time, source and action, with values before and after."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Final

from PySide6.QtWidgets import QFrame, QLabel, QWidget

from rigapp.gui.panel import Host
from rigapp.gui.widgets.build import column, edit, named, row, styled_label
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.times import dated
from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.loglines import ALARM
from rigapp.schema.messages import Event
from rigapp.viewer.news import News, Takes

HEADINGS: Final[tuple[Text, ...]] = ("Time", "Cycle", "What", "Who", "Before", "After", "Text")
CODES: Final[tuple[Text, ...]] = (
    "alarm", "calibrating", "calibration", "command", "device", "disk", "limit", "limit changed",
    "message", "note", "rest", "specimen", "state", "step", "stopped", "suspended", "twin",
    "viewer", "zero", "engine", "limits", "messages", "operator", "drive",
)  # fmt: skip
"""Kinds and sources of log lines; names of devices and people are not translated."""
LOG_LINES, JOURNAL_LINES = 2000, 500
"""Numbers of newest lines shown; the file has all of them."""


class LogPanel(QWidget):
    """Show and search the log."""

    takes = Takes.HISTORY | Takes.LOG

    def __init__(self) -> None:
        super().__init__()
        self._events: Sequence[Event] = ()
        named(self, "log_panel", "Log of the test")
        self.filter = edit("log_filter", "Show only lines with this text", self._show)
        self.filter.setClearButtonEnabled(True)
        self.count = named(QLabel(tr("The log is empty.")), "log_count", "Lines of the log")
        self.table = PlainTable("log_table", "Log of the test, newest first", HEADINGS)
        top = row("F&ind", (self.filter, 1), (self.count, 1))
        column(top, (self.table, 1), on=self)

    def show_news(self, news: News) -> None:
        """Show the newest log."""
        if news.log_problem:
            self.count.setText(news.log_problem)
        elif news.events is not self._events:
            self._events = news.events
            self._show()

    def _show(self) -> None:
        wanted = self.filter.text().strip().lower()
        rows = []
        for event in reversed(self._events):
            texts = (
                time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(event.time)),
                str(event.revolution),
                tr(event.kind.replace("_", " ")),
                _who(event.source),
                tr(event.before),
                tr(event.after),
                translate(event.text),
            )
            if not wanted or any(wanted in text.lower() for text in texts):
                rows.append(texts)
        self.table.show_rows(rows[:LOG_LINES])
        self.count.setText(tr("{} of {} lines", len(rows), len(self._events)))


class AlarmJournal(QFrame):
    """Changes of the alarms of the test, newest first."""

    takes = Takes.HISTORY | Takes.LOG

    def __init__(self) -> None:
        super().__init__()
        self._events: Sequence[Event] = ()
        named(self, "alarm_journal", "Journal of the alarms", role="card")
        self.table = PlainTable(
            "journal_table", "Journal of the alarms", ("Time", "Cycle", "What happened", "Who")
        )
        column(
            styled_label("Journal", "title"),
            (self.table, 1),
            on=self,
            margins=(GAP, STEP, GAP, GAP),
            spacing=STEP,
        )

    def show_news(self, news: News) -> None:
        """Show the newest journal."""
        if news.events is self._events:
            return
        self._events = news.events
        lines = [event for event in reversed(news.events) if event.kind == ALARM][:JOURNAL_LINES]
        self.table.show_rows(
            [
                (
                    dated("%d %b %H:%M:%S", time.localtime(event.time)),
                    str(event.revolution),
                    translate(event.text),
                    _who(event.source),
                )
                for event in lines
            ]
        )


def _who(source: str) -> str:
    """Return the source of an event; all parts of the program have one name."""
    return tr("program") if source.startswith("rigapp") else tr(source)


def log_page(host: Host) -> QWidget:
    """Make the page of the log."""
    return host.add("log", LogPanel())
