"""Read-only tables."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor, QResizeEvent, QShowEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
)

from rigapp.gui.widgets.build import named
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr

Row = TypeVar("Row")
Index = QModelIndex | QPersistentModelIndex
Mark = tuple[str, str] | None
"""Background and text colour of a marked cell; None: not marked."""

HEADING_FRAME, WORD_FRAME = 2 * STEP, STEP
"""Horizontal space around a word of a heading and of a cell, pixels."""
LONG_WORD = 20
"""Number of characters above which a word may break; shorter ones, such as dates, do not."""
MEASURED_ROWS = 50
"""Number of first rows whose words determine the widths of columns."""
ROW_LINES = 1.5
"""Height of a row that does not wrap, in lines of text."""


class MarkDelegate(QStyledItemDelegate):
    """Paint a marked cell in its own colour, selected or not."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """Remove the selection from the options of a marked cell."""
        super().initStyleOption(option, index)
        if index.data(Qt.ItemDataRole.BackgroundRole) is not None:
            option.state &= ~QStyle.StateFlag.State_Selected


def shared(wanted: Mapping[int, int], least: Mapping[int, int], room: int) -> dict[int, int]:
    """Return a width for each column: as wanted, reduced for the widest where there is no room.

    All in pixels; least: the minimum widths.
    """
    over = sum(wanted.values()) > room
    low, cap = 0, max(wanted.values(), default=0)
    while over and cap - low > 1:
        middle = (low + cap) // 2
        taken = sum(max(min(wide, middle), least[column]) for column, wide in wanted.items())
        low, cap = (low, middle) if taken > room else (middle, cap)
    cap = low if over else cap
    return {column: max(min(wide, cap), least[column]) for column, wide in wanted.items()}


def _unbroken(word: str) -> list[str]:
    """Return the unbreakable parts of a word; a path can break after its slashes.

    After a hyphen a line breaks before letters only (Unicode line breaking, rule LB25).
    """
    return re.split(r"(?<=/)|(?<=-)(?=[^\W\d])", word) if len(word) > LONG_WORD else [word]


class PlainTable(QTableWidget):
    """A read-only table: rows of texts, repainted only where a text changed.

    It does not scroll horizontally: texts wrap where there is no room. marked: the column coloured
    by a mark. stretch: columns that share the remaining width, by default the last one. cut:
    columns of names chosen by users, which may be elided; tool tips have the full names.
    """

    def __init__(
        self,
        name: str,
        spoken: Text,
        headings: Sequence[Text],
        *,
        marked: int = 1,
        stretch: Sequence[int] = (),
        cut: Sequence[int] = (),
    ) -> None:
        super().__init__(0, len(headings))
        named(self, name, spoken)
        self._marked = marked
        self._wraps = False
        self.setHorizontalHeaderLabels([tr(heading) for heading in headings])
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self._delegate = MarkDelegate(self)
        self.setItemDelegateForColumn(marked, self._delegate)
        self.verticalHeader().hide()
        header = self.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._stretch = tuple(stretch) or (len(headings) - 1,)
        self._cut = frozenset(cut)
        self._fitted: object = None
        self.verticalHeader().setDefaultSectionSize(self._line_height)
        self.verticalScrollBar().valueChanged.connect(self._fit_rows)

    def show_rows(
        self,
        rows: Sequence[Sequence[str]],
        marks: Sequence[Mark] = (),
        tip: Callable[[str], str] = str,
    ) -> None:
        """Show rows; marks: one for each row, or none. tip: makes the tool tip of a text."""
        changed = self.rowCount() != len(rows)
        if changed:
            self.setRowCount(len(rows))
        for row, texts in enumerate(rows):
            for column, text in enumerate(texts):
                item = self.item(row, column) or self._new_item(row, column)
                if item.text() != text:
                    item.setText(text)
                    item.setToolTip(tip(text))
                    changed = True
            if marks:
                self._mark(row, marks[row])
        if changed:
            self._fit()

    @property
    def _line_height(self) -> int:
        return int(ROW_LINES * self.fontMetrics().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Distribute the new width."""
        super().resizeEvent(event)
        self._fit()

    def showEvent(self, event: QShowEvent) -> None:
        """Distribute the width for the present style."""
        super().showEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Set the column widths for the texts; where there is no room, they wrap."""
        if not self.isVisible():
            return
        header, room = self.horizontalHeader(), self.viewport().width()
        shown = [column for column in range(self.columnCount()) if not self.isColumnHidden(column)]
        wanted = {at: max(self.sizeHintForColumn(at), header.sectionSizeHint(at)) for at in shown}
        widths = shared(wanted, {at: self._longest_word(at) for at in shown}, room)
        greedy = [column for column in self._stretch if column in shown] or shown[-1:]
        more = max(room - sum(widths.values()), 0) // max(len(greedy), 1)
        for column in greedy:
            widths[column] += more
        self._wraps = any(widths[column] < wanted[column] for column in shown)
        for column, wide in widths.items():
            header.resizeSection(column, wide)
        if not self._wraps and self._fitted:
            for row in range(self.rowCount()):
                self.setRowHeight(row, self._line_height)
        self._fitted = self._wraps
        self._fit_rows()

    def _fit_rows(self) -> None:
        """Set the heights of the visible rows to those of their wrapped texts."""
        if not self._wraps:
            return
        first, last = max(self.rowAt(0), 0), self.rowAt(self.viewport().height())
        for row in range(first, (self.rowCount() if last < 0 else last + 1)):
            tall = max(self.sizeHintForRow(row), self._line_height)
            if self.rowHeight(row) != tall:
                self.setRowHeight(row, tall)

    def _longest_word(self, column: int) -> int:
        """Return the width of the longest word of a column, pixels."""
        rows = 0 if column in self._cut else min(self.rowCount(), MEASURED_ROWS)
        cells = [self.item(row, column) for row in range(rows)]
        wide = HEADING_FRAME + self._widest([self.horizontalHeaderItem(column)])
        return max(wide, WORD_FRAME + self._widest(cells))

    def _widest(self, items: Sequence[QTableWidgetItem | None]) -> int:
        texts = [item.text() for item in items if item is not None]
        words = {part for text in texts for word in text.split() for part in _unbroken(word)}
        return max(map(self.fontMetrics().horizontalAdvance, words), default=0)

    def _new_item(self, row: int, column: int) -> QTableWidgetItem:
        item = QTableWidgetItem()
        item.setTextAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.setItem(row, column, item)
        return item

    def _mark(self, row: int, mark: Mark) -> None:
        item = self.item(row, self._marked)
        if item is not None:
            back, ink = (QBrush(QColor(colour)) for colour in mark) if mark else (None, None)
            item.setData(Qt.ItemDataRole.BackgroundRole, back)
            item.setData(Qt.ItemDataRole.ForegroundRole, ink)

    def all_chosen(self) -> list[int]:
        """Return the selected rows in order."""
        return sorted({index.row() for index in self.selectedIndexes()})

    def chosen(self) -> int | None:
        """Return the selected row, the first of several; None without one."""
        return next(iter(self.all_chosen()), None)

    def chosen_of(self, rows: Sequence[Row]) -> Row | None:
        """Return the object of the selected row; rows: the shown objects, in order."""
        index = self.chosen()
        return rows[index] if index is not None and index < len(rows) else None

    def texts(self) -> list[list[str]]:
        """Return the shown texts."""
        return [
            [
                item.text() if (item := self.item(row, column)) is not None else ""
                for column in range(self.columnCount())
            ]
            for row in range(self.rowCount())
        ]
