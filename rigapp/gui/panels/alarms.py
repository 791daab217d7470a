"""The alarms: what is wrong, what it leads to, what to do; acknowledge and shelve."""

from __future__ import annotations

import time

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QWidget

from rigapp.gui.data.news import News, Takes
from rigapp.gui.look.tokens import Theme
from rigapp.gui.panel import Host
from rigapp.gui.panels.limits import LimitPanel
from rigapp.gui.widgets.build import button, column, edit, named, row, split, whole_number
from rigapp.gui.widgets.tables import Mark, PlainTable
from rigapp.schema.messages import NOTE_CHARACTERS, Alarm, RunState, Severity
from rigapp.schema.words import explained

COLUMNS = ("", "State", "Alarm", "Cause", "Consequence", "What to do", "Since", "Cycle")
MARKS = {Severity.WARNING: "▲ warning", Severity.CRITICAL: "◆ critical"}
COMPACT_LINES = 7
"""Height of the list on the overview, in lines of text: two alarms with their sentences."""


def order(alarms: tuple[Alarm, ...]) -> list[Alarm]:
    """Return the alarms to show: first-out, then unacknowledged, then worst, then oldest."""
    return sorted(
        (alarm for alarm in alarms if alarm.state != "normal"),
        key=lambda alarm: (
            not alarm.first_out,
            alarm.acknowledged,
            alarm.severity is not Severity.CRITICAL,
            alarm.raised_at,
        ),
    )


class AlarmPanel(QWidget):
    """List the alarms; emits requests as (verb, arguments)."""

    wanted = Signal(str, dict)
    takes = Takes.STATUS

    def __init__(self, prefix: str, theme: Theme, *, compact: bool = False) -> None:
        """Make the panel; compact: it takes one line while there is no alarm."""
        super().__init__()
        self._theme = theme
        self._compact = compact
        self._alarms: list[Alarm] = []
        named(self, f"{prefix}_alarm_panel", "Alarms")
        self.table = PlainTable(
            f"{prefix}_alarm_table", "List of alarms", COLUMNS, marked=0, stretch=(2, 3, 4, 5)
        )
        self.table.itemSelectionChanged.connect(self._enable)
        self.empty = named(QLabel("No alarms."), f"{prefix}_no_alarms", "No alarms")
        self.acknowledge = button(
            f"{prefix}_acknowledge",
            "Ac&knowledge",
            self._acknowledge,
            "Acknowledge the chosen alarm",
        )
        self.reason = edit(
            f"{prefix}_shelve_reason",
            "Reason for shelving",
            self._enable,
            hint="reason for shelving",
            most=NOTE_CHARACTERS,
        )
        self.minutes = whole_number(f"{prefix}_shelve_minutes", "Minutes of shelving", 1, 480)
        self.minutes.setValue(15)
        self.minutes.setSuffix(" min")
        self.shelve = button(
            f"{prefix}_shelve", "S&helve", self._shelve, "Shelve the chosen alarm", guarded=True
        )
        self.reset = button(
            f"{prefix}_reset",
            "Reset after trip",
            lambda: self.wanted.emit("reset", {}),
            "Reset after a trip",
            guarded=True,
            tip="The deliberate action before another start: every critical alarm must be"
            " acknowledged and its cause gone. Nothing moves.",
        )
        tools = row(
            (self.empty, 1),
            self.reset,
            self.acknowledge,
            (self.reason, 1),
            self.minutes,
            self.shelve,
        )
        column((self.table, 1), tools, on=self)
        self.dress(theme)
        self._enable()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.table.setStyleSheet(
            f"QTableWidget::item:selected {{ background: {theme.band}; color: {theme.text}; }}"
        )
        self._fill()
        self._fold()

    def show_news(self, news: News) -> None:
        """Show the alarms of a status."""
        if news.status is not None:
            self.show_alarms(news.status.alarms)
            self.show_state(news.status.state)

    def show_state(self, state: RunState | None) -> None:
        """Offer the reset after a trip, and whenever an alarm waits for it."""
        latched = any(one.severity is Severity.CRITICAL for one in self._alarms)
        self.reset.setEnabled(latched or state in (RunState.FAULT, RunState.STOPPED))

    def show_alarms(self, alarms: tuple[Alarm, ...]) -> None:
        """Show the alarms, keeping the selection; nothing is done when they are unchanged."""
        ordered = order(alarms)
        if ordered == self._alarms:
            return
        chosen = self.chosen()
        self._alarms = ordered
        self._fill()
        keys = [alarm.key for alarm in ordered]
        if ordered:
            known = chosen is not None and chosen.key in keys
            self.table.selectRow(keys.index(chosen.key) if known and chosen is not None else 0)
        self.empty.setText("" if ordered else "No alarms.")
        self._fold()
        self._enable()

    def chosen(self) -> Alarm | None:
        """Return the chosen alarm."""
        at = self.table.chosen()
        return self._alarms[at] if at is not None and at < len(self._alarms) else None

    def _fill(self) -> None:
        rows = [
            (
                MARKS[alarm.severity] + (", first" if alarm.first_out else ""),
                alarm.state,
                alarm.title,
                alarm.cause,
                alarm.consequence,
                alarm.action,
                time.strftime("%H:%M:%S", time.localtime(alarm.raised_at)),
                str(alarm.revolution),
            )
            for alarm in self._alarms
        ]
        self.table.show_rows(rows, [self._mark(alarm) for alarm in self._alarms], _tip)

    def _mark(self, alarm: Alarm) -> Mark:
        if alarm.acknowledged:
            return None
        return self._theme.mark(critical=alarm.severity is Severity.CRITICAL)

    def _fold(self) -> None:
        if not self._compact:
            return
        used = bool(self._alarms)
        for widget in (
            self.table,
            self.acknowledge,
            self.reason,
            self.minutes,
            self.shelve,
            self.reset,
        ):
            widget.setVisible(used)
        self.table.setFixedHeight(COMPACT_LINES * self.fontMetrics().height())

    def _enable(self) -> None:
        alarm = self.chosen()
        self.acknowledge.setEnabled(alarm is not None and not alarm.acknowledged)
        self.shelve.setEnabled(alarm is not None and bool(self.reason.text().strip()))

    def _acknowledge(self) -> None:
        alarm = self.chosen()
        if alarm is not None:
            self.wanted.emit("acknowledge", {"key": alarm.key})

    def _shelve(self) -> None:
        alarm = self.chosen()
        if alarm is None:
            return
        self.minutes.interpretText()
        reason, minutes = self.reason.text().strip(), self.minutes.value()
        self.reason.clear()
        self.wanted.emit("shelve", {"key": alarm.key, "reason": reason, "minutes": minutes})


def _tip(text: str) -> str:
    return explained("first" if text.endswith(", first") else text)


def alarm_page(host: Host) -> QWidget:
    """Make the page of alarms and limits."""
    alarms = host.add("alarms", AlarmPanel("all", host.theme))
    limits = host.add("limits", LimitPanel())
    for panel in (alarms, limits):
        panel.wanted.connect(host.ask)
    return split("alarm_split", Qt.Orientation.Vertical, [400, 300], alarms, limits)
