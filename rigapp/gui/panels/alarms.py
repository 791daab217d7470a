"""The alarms: what is wrong, what it leads to, what to do; acknowledge and shelve."""

from __future__ import annotations

import time
from typing import Any

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt, Signal
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from rigapp.gui.plots.palette import Theme
from rigapp.gui.widgets.guarded import GuardedButton
from rigapp.schema.messages import NOTE_CHARACTERS, Alarm, RunState, Severity
from rigapp.schema.words import explained

Index = QModelIndex | QPersistentModelIndex

COLUMNS = ("", "State", "Alarm", "Cause", "Consequence", "What to do", "Since", "Cycle")
MARKS = {Severity.WARNING: "▲ warning", Severity.CRITICAL: "◆ critical"}


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


class SignalDelegate(QStyledItemDelegate):
    """Paint the mark of an alarm in its own colour, chosen or not."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """Leave the selection out of the mark's own colours."""
        super().initStyleOption(option, index)
        if index.data(Qt.ItemDataRole.BackgroundRole) is not None:
            option.state &= ~QStyle.StateFlag.State_Selected


class AlarmPanel(QWidget):
    """List the alarms; emits requests as (verb, arguments)."""

    wanted = Signal(str, dict)

    def __init__(self, prefix: str, theme: Theme, *, compact: bool = False) -> None:
        """Make the panel; compact: it takes one line while there is no alarm."""
        super().__init__()
        self._theme = theme
        self._compact = compact
        self._alarms: list[Alarm] = []
        self.setObjectName(f"{prefix}_alarm_panel")
        self.setAccessibleName("Alarms")
        self.table = QTableWidget(0, len(COLUMNS))
        self.table.setObjectName(f"{prefix}_alarm_table")
        self.table.setAccessibleName("List of alarms")
        self.table.setHorizontalHeaderLabels(list(COLUMNS))
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setWordWrap(True)
        self.table.setTabKeyNavigation(False)
        self.table.verticalHeader().hide()
        self.table.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        for column in (2, 3, 4, 5):
            header.setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        self._marks = SignalDelegate(self.table)
        self.table.setItemDelegateForColumn(0, self._marks)
        self.table.itemSelectionChanged.connect(self._enable)
        self._build(prefix)
        self.dress(theme)
        self._enable()

    def _build(self, prefix: str) -> None:
        self.empty = QLabel("No alarms.")
        self.empty.setObjectName(f"{prefix}_no_alarms")
        self.acknowledge = QPushButton("Ac&knowledge")
        self.acknowledge.setObjectName(f"{prefix}_acknowledge")
        self.acknowledge.setAccessibleName("Acknowledge the chosen alarm")
        self.acknowledge.clicked.connect(self._acknowledge)
        self.reason = QLineEdit()
        self.reason.setMaxLength(NOTE_CHARACTERS)
        self.reason.setObjectName(f"{prefix}_shelve_reason")
        self.reason.setAccessibleName("Reason for shelving")
        self.reason.setPlaceholderText("reason for shelving")
        self.reason.textChanged.connect(self._enable)
        self.minutes = QSpinBox()
        self.minutes.setObjectName(f"{prefix}_shelve_minutes")
        self.minutes.setAccessibleName("Minutes of shelving")
        self.minutes.setRange(1, 480)
        self.minutes.setValue(15)
        self.minutes.setSuffix(" min")
        self.shelve = GuardedButton("S&helve")
        self.shelve.setObjectName(f"{prefix}_shelve")
        self.shelve.setAccessibleName("Shelve the chosen alarm")
        self.shelve.clicked.connect(self._shelve)
        self.reset = GuardedButton("Reset after trip")
        self.reset.setObjectName(f"{prefix}_reset")
        self.reset.setAccessibleName("Reset after a trip")
        self.reset.setToolTip(
            "The deliberate action before another start: every critical alarm must be acknowledged"
            " and its cause gone. Nothing moves."
        )
        self.reset.clicked.connect(lambda: self.wanted.emit("reset", {}))
        row = QHBoxLayout()
        row.addWidget(self.empty, 1)
        for widget in (self.reset, self.acknowledge, self.reason, self.minutes, self.shelve):
            row.addWidget(widget, 1 if widget is self.reason else 0)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.table, 1)
        column.addLayout(row)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self.table.setStyleSheet(
            f"QTableWidget::item:selected {{ background: {theme.band}; color: {theme.text}; }}"
        )
        alarms, self._alarms = self._alarms, []
        self.show_alarms(tuple(alarms))
        self._fold()

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
        self.table.setRowCount(len(ordered))
        for row, alarm in enumerate(ordered):
            self._fill(row, alarm)
        keys = [alarm.key for alarm in ordered]
        if chosen is not None and chosen.key in keys:
            self.table.selectRow(keys.index(chosen.key))
        elif ordered:
            self.table.selectRow(0)
        self.empty.setText("" if ordered else "No alarms.")
        self._fold()
        self._enable()

    def _fold(self) -> None:
        if not self._compact:
            return
        used = bool(self._alarms)
        for widget in (self.table, self.acknowledge, self.reason, self.minutes, self.shelve):
            widget.setVisible(used)
        self.reset.setVisible(used)
        self.table.setFixedHeight(int(7 * self.fontMetrics().height()))

    def chosen(self) -> Alarm | None:
        """Return the chosen alarm."""
        rows = {index.row() for index in self.table.selectedIndexes()}
        row = min(rows, default=-1)
        return self._alarms[row] if 0 <= row < len(self._alarms) else None

    def _fill(self, row: int, alarm: Alarm) -> None:
        mark = MARKS[alarm.severity] + (", first" if alarm.first_out else "")
        since = time.strftime("%H:%M:%S", time.localtime(alarm.raised_at))
        texts = (
            mark,
            alarm.state,
            alarm.title,
            alarm.cause,
            alarm.consequence,
            alarm.action,
            since,
            str(alarm.revolution),
        )
        theme = self._theme
        back = theme.critical if alarm.severity is Severity.CRITICAL else theme.warning
        ink = "#ffffff" if back == theme.critical and theme.name == "light" else theme.on_signal
        for column, text in enumerate(texts):
            item = QTableWidgetItem(text)
            item.setToolTip(explained("first") if text.endswith(", first") else explained(text))
            item.setTextAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
            if column == 0 and not alarm.acknowledged:
                item.setBackground(QBrush(QColor(back)))
                item.setForeground(QBrush(QColor(ink)))
            self.table.setItem(row, column, item)

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
        arguments: dict[str, Any] = {
            "key": alarm.key,
            "reason": self.reason.text().strip(),
            "minutes": self.minutes.value(),
        }
        self.reason.clear()
        self.wanted.emit("shelve", arguments)
