"""The log of the test: who did what when, with values before and after."""

from __future__ import annotations

import time
from pathlib import Path

from PySide6.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from rigapp.gui.data.recording import load_events
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.widgets.tables import PlainTable
from rigapp.schema.messages import Event

HEADINGS = ("Time", "Cycle", "What", "Who", "Before", "After", "Text")
READ_EVERY_S = 2.0
SHOWN = 2000
"""Newest lines shown; all of them are in the file."""


class LogPanel(QWidget):
    """Show the log; read from the file on a worker while the panel can be seen."""

    def __init__(self, worker: TaskWorker) -> None:
        super().__init__()
        self._worker = worker
        self._path: Path | None = None
        self._events: list[Event] = []
        self._reading = False
        self._next_at = 0.0
        self.setObjectName("log_panel")
        self.setAccessibleName("Log of the test")
        self.filter = QLineEdit()
        self.filter.setObjectName("log_filter")
        self.filter.setAccessibleName("Show only lines with this text")
        self.filter.setClearButtonEnabled(True)
        self.filter.textChanged.connect(self._show)
        label = QLabel("F&ind")
        label.setBuddy(self.filter)
        self.count = QLabel("The log is empty.")
        self.count.setObjectName("log_count")
        self.count.setAccessibleName("Lines of the log")
        self.table = PlainTable("log_table", "Log of the test, newest first", HEADINGS)
        row = QHBoxLayout()
        row.addWidget(label)
        row.addWidget(self.filter, 1)
        row.addWidget(self.count, 1)
        column = QVBoxLayout(self)
        column.addLayout(row)
        column.addWidget(self.table, 1)

    @property
    def events(self) -> list[Event]:
        """Return what was read last."""
        return self._events

    def follow(self, path: Path | None) -> None:
        """Read the log of a file, again every two seconds."""
        if path != self._path:
            self._path, self._events, self._next_at = path, [], 0.0
            self._show()
        now = time.monotonic()
        if path is None or self._reading or now < self._next_at:
            return
        self._reading = self._worker.submit(
            lambda: load_events(path), lambda events: self._got(path, events), self._failed
        )
        self._next_at = now + READ_EVERY_S

    def _got(self, path: Path, events: list[Event]) -> None:
        self._reading = False
        if path == self._path and len(events) != len(self._events):
            self._events = events
            self._show()

    def _failed(self, error: Exception) -> None:
        self._reading = False
        self.count.setText(f"The log cannot be read: {error}")

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
        self.count.setText(f"{len(rows)} of {len(self._events)} lines")
