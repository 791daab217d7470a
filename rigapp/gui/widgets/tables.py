"""Tables to read."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, Qt
from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableWidget,
    QTableWidgetItem,
)

from rigapp.gui.language.words import Text, tr
from rigapp.gui.widgets.build import named

Index = QModelIndex | QPersistentModelIndex
Mark = tuple[str, str] | None
"""Background and ink of a marked cell; None: it has no colour of its own."""

ROW_LINES = 1.5
"""Height of a row that does not wrap, in lines of text: room above and below it."""


class MarkDelegate(QStyledItemDelegate):
    """Paint a marked cell in its own colour, chosen or not."""

    def initStyleOption(self, option: QStyleOptionViewItem, index: Index) -> None:
        """Leave the selection out of the mark's own colours."""
        super().initStyleOption(option, index)
        if index.data(Qt.ItemDataRole.BackgroundRole) is not None:
            option.state &= ~QStyle.StateFlag.State_Selected


class PlainTable(QTableWidget):
    """A table to read: rows of texts, repainted only where a text changed.

    marked: the column that a mark colours. stretch: columns that share what room is left, in the
    place of the last one; their texts are wrapped.
    """

    def __init__(
        self,
        name: str,
        spoken: Text,
        headings: Sequence[Text],
        *,
        marked: int = 1,
        stretch: Sequence[int] = (),
    ) -> None:
        super().__init__(0, len(headings))
        named(self, name, spoken)
        self._marked = marked
        self._wraps = bool(stretch)
        self.setHorizontalHeaderLabels([tr(one) for one in headings])
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setTabKeyNavigation(False)
        self._delegate = MarkDelegate(self)
        self.setItemDelegateForColumn(marked, self._delegate)
        self.verticalHeader().hide()
        header, fit = self.horizontalHeader(), QHeaderView.ResizeMode.ResizeToContents
        header.setSectionResizeMode(fit)
        header.setStretchLastSection(not stretch)
        for at in stretch:
            header.setSectionResizeMode(at, QHeaderView.ResizeMode.Stretch)
        if stretch:
            self.setWordWrap(True)
            self.verticalHeader().setSectionResizeMode(fit)
        else:
            height = int(ROW_LINES * self.fontMetrics().height())
            self.verticalHeader().setDefaultSectionSize(height)

    def show_rows(
        self,
        rows: Sequence[Sequence[str]],
        marks: Sequence[Mark] = (),
        tip: Callable[[str], str] = str,
    ) -> None:
        """Show rows; marks: one a row, or none. tip: what a text's tool tip says."""
        if self.rowCount() != len(rows):
            self.setRowCount(len(rows))
        for row, texts in enumerate(rows):
            for at, text in enumerate(texts):
                item = self.item(row, at) or self._new_item(row, at)
                if item.text() != text:
                    item.setText(text)
                    item.setToolTip(tip(text))
            if marks:
                self._mark(row, marks[row])

    def _new_item(self, row: int, at: int) -> QTableWidgetItem:
        item = QTableWidgetItem()
        if self._wraps:
            item.setTextAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop)
        self.setItem(row, at, item)
        return item

    def _mark(self, row: int, mark: Mark) -> None:
        item = self.item(row, self._marked)
        if item is not None:
            back, ink = (QBrush(QColor(one)) for one in mark) if mark else (None, None)
            item.setData(Qt.ItemDataRole.BackgroundRole, back)
            item.setData(Qt.ItemDataRole.ForegroundRole, ink)

    def all_chosen(self) -> list[int]:
        """Return the chosen rows in order."""
        return sorted({index.row() for index in self.selectedIndexes()})

    def chosen(self) -> int | None:
        """Return the chosen row, the first one of several; None where none is."""
        return next(iter(self.all_chosen()), None)

    def texts(self) -> list[list[str]]:
        """Return what is shown."""
        return [
            [
                item.text() if (item := self.item(row, at)) is not None else ""
                for at in range(self.columnCount())
            ]
            for row in range(self.rowCount())
        ]
