"""The log of the test: who did what when, with values before and after."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Final

from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from rigapp.gui.data.news import News, Takes
from rigapp.gui.panel import Host
from rigapp.gui.widgets.build import edit, filled, named, row
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import Event

HEADINGS: Final[tuple[Text, ...]] = ("Time", "Cycle", "What", "Who", "Before", "After", "Text")
SHOWN = 2000
"""Newest lines shown; all of them are in the file."""


class LogPanel(QWidget):
    """Show the log, and find lines in it."""

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
        filled(QVBoxLayout(self), (top, (self.table, 1)))

    def show_news(self, news: News) -> None:
        """Show the log as it was read last."""
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
                event.kind,
                event.source,
                event.before,
                event.after,
                event.text,
            )
            if not wanted or any(wanted in text.lower() for text in texts):
                rows.append(texts)
        self.table.show_rows(rows[:SHOWN])
        self.count.setText(tr("{} of {} lines", len(rows), len(self._events)))


def log_page(host: Host) -> QWidget:
    """Make the page of the log."""
    return host.add("log", LogPanel())
