"""The limit rules of a test as a table: quantity, four levels, hysteresis, delay, actions."""

from __future__ import annotations

import typing
from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QGroupBox,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
)

from rigapp.config.recipe import Action
from rigapp.config.rules import BOUNDS, quantities
from rigapp.gui.data.channels import SIZE
from rigapp.gui.testfile.fields import show_value
from rigapp.gui.widgets.build import button, choice, filled, named, row
from rigapp.schema.channels import BASE, ChannelTable

LEVELS = tuple(reversed(BOUNDS))
COLUMNS = ("quantity", *LEVELS, "hysteresis", "delay_revolutions", "action_critical")
HEADINGS = (
    "Quantity",
    "Warn\nbelow",
    "Warn\nabove",
    "Critical\nbelow",
    "Critical\nabove",
    "Hyste-\nresis",
    "Delay\n(rev)",
    "Action at\ncritical",
)
FIRST = f"{SIZE}_max"
"""What a new limit is about until somebody chooses."""

NUMBERS = frozenset({*LEVELS, "hysteresis"})


class RuleTable(QGroupBox):
    """Edit the rules; empty cells mean that there is no such level."""

    changed = Signal()

    def __init__(self) -> None:
        super().__init__("Limits of this test")
        named(self, "section_rules", "Limits of this test")
        self._others: list[dict[str, Any]] = []
        self._table = BASE
        self._filling = False
        self.table = named(QTableWidget(0, len(COLUMNS)), "rule_table", "Limit rules")
        self.table.setHorizontalHeaderLabels(list(HEADINGS))
        self.table.verticalHeader().hide()
        self.table.setTabKeyNavigation(False)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(len(COLUMNS) - 1, QHeaderView.ResizeMode.ResizeToContents)
        self.table.setMinimumHeight(7 * self.fontMetrics().height())
        self.table.itemChanged.connect(self._edited)
        self.add = button("rule_add", "Add a limit", self._add)
        self.remove = button("rule_remove", "Remove", self._remove, "Remove the chosen limit")
        filled(QVBoxLayout(self), ((self.table, 1), row(self.add, self.remove, None)))

    def fill(self, rules: Sequence[dict[str, Any]]) -> None:
        """Show rules as a test file holds them."""
        self._filling = True
        self.table.setRowCount(0)
        self._others = []
        for rule in rules:
            self._append(dict(rule))
        self._filling = False

    def know(self, table: ChannelTable) -> None:
        """Offer limits on the channels of a rig."""
        if table == self._table:
            return
        self._table = table
        for place in range(self.table.rowCount()):
            box = self.table.cellWidget(place, 0)
            if isinstance(box, QComboBox):
                known = [box.itemText(at) for at in range(box.count())]
                box.addItems([one for one in quantities(table) if one not in known])

    def rules(self) -> list[dict[str, Any]]:
        """Return the rules; raise ValueError with one sentence."""
        return [self._rule(row) for row in range(self.table.rowCount())]

    def _rule(self, row: int) -> dict[str, Any]:
        rule = dict(self._others[row])
        for column, key in enumerate(COLUMNS):
            widget = self.table.cellWidget(row, column)
            if isinstance(widget, QComboBox):
                if key != "action_critical" or widget.currentText() != "stop":
                    rule[key] = widget.currentText()
                continue
            item = self.table.item(row, column)
            text = item.text().strip() if item is not None else ""
            if text:
                rule[key] = self._number(row, key, text)
        return rule

    def _number(self, row: int, key: str, text: str) -> float | int:
        name = key.replace("_", " ")
        try:
            return float(text) if key in NUMBERS else int(text)
        except ValueError:
            raise ValueError(f"Limit {row + 1}: {name} must be a number, not {text!r}") from None

    def _append(self, rule: dict[str, Any]) -> None:
        row = self.table.rowCount()
        self.table.insertRow(row)
        quantity = self._choice(
            tuple(quantities(self._table)), rule.pop("quantity", FIRST), row, "Quantity"
        )
        actions = typing.get_args(Action)
        action = self._choice(actions, rule.pop("action_critical", "stop"), row, "Action")
        self.table.setCellWidget(row, 0, quantity)
        self.table.setCellWidget(row, len(COLUMNS) - 1, action)
        for column, key in enumerate(COLUMNS):
            if self.table.cellWidget(row, column) is None:
                value = rule.pop(key, None)
                text = "" if value is None else show_value(value)
                self.table.setItem(row, column, QTableWidgetItem(text))
        self._others.append(rule)

    def _choice(self, texts: Sequence[str], chosen: str, row: int, spoken: str) -> QComboBox:
        box = choice(
            f"rule_{row}_{spoken.lower()}",
            f"{spoken} of limit {row + 1}",
            zip(texts, texts, strict=True),
        )
        if chosen not in texts:
            box.addItem(chosen)
        box.setCurrentText(chosen)
        box.currentIndexChanged.connect(self._edited)
        return box

    def _add(self) -> None:
        self._filling = True
        self._append({})
        self._filling = False
        self.changed.emit()

    def _remove(self) -> None:
        row = self.table.currentRow()
        if row >= 0:
            self.table.removeRow(row)
            del self._others[row]
            self.changed.emit()

    def _edited(self) -> None:
        if not self._filling:
            self.changed.emit()
