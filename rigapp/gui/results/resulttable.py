"""Table of recorded tests: sparkline of the wear, outcome, main figures."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from PySide6.QtCore import (
    QAbstractTableModel,
    QModelIndex,
    QPersistentModelIndex,
    QPointF,
    QRectF,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTableView,
)

from rigapp.gui.look.fonts import sized
from rigapp.gui.look.icons import icon
from rigapp.gui.results.resultcard import SHAPES, SMALL, colour_of
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.gui.widgets.build import named
from rigapp.presentation.numbers import coefficient_number, grouped
from rigapp.presentation.results import day, outcome_text
from rigapp.presentation.tokens import BODY_PT, CAPTION_PT, STEP, Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.messages import HowEnded
from rigapp.schema.results import TestResult

Index = QModelIndex | QPersistentModelIndex
Row = tuple[str, TestResult | None]
"""A file and its result, None before it was read."""

ROW_HEIGHT = 6 * STEP
TEST_WIDTH = 33 * STEP
"""Minimum width of a test, with room for its specimen and file name."""
EXTRA = 4
READING = "…"
ASCENDING, DESCENDING = Qt.SortOrder.AscendingOrder, Qt.SortOrder.DescendingOrder


def _number(value: float, digits: int = 1) -> str:
    return f"{value:.{digits}f}" if math.isfinite(value) else "–"


def _depth(result: TestResult) -> str:
    uncertainty = result.depth_uncertainty_um
    sure = f" ± {uncertainty:.1f}" if math.isfinite(uncertainty) else ""
    return _number(result.depth_um) + sure


@dataclass(frozen=True, slots=True)
class ResultColumn:
    """A column: heading, width (0: the rest), text of a cell, sorting key.

    rank: the highest is hidden first where there is no room; a short list has no extra columns.
    """

    title: Text
    width: int
    text: Callable[[TestResult], str]
    key: Callable[[TestResult], Any]
    right: bool = False
    tip: Text = ""
    rank: int = 0


LINE, TEST, ENDED = marked("Wear"), marked("Test"), marked("Ended")
COLUMNS = (
    ResultColumn(LINE, 96, lambda _: "", lambda test: test.depth_um, rank=3),
    ResultColumn(TEST, 0, lambda test: test.title, lambda test: test.title.lower()),
    ResultColumn("Began", 136, lambda test: day(test.started), lambda test: test.started, rank=1),
    ResultColumn(ENDED, 176, outcome_text, lambda test: test.outcome.value),
    ResultColumn(
        "Cycles",
        64,
        lambda test: grouped(test.revolutions),
        lambda test: test.revolutions,
        right=True,
        rank=EXTRA,
    ),
    ResultColumn(
        "|F| max, N",
        80,
        lambda test: _number(test.force_max_N),
        lambda test: test.force_max_N,
        right=True,
        rank=EXTRA,
    ),
    ResultColumn(
        "Depth, µm",
        104,
        _depth,
        lambda test: test.depth_um,
        right=True,
        rank=1,
        tip="Wear depth by the probes, with its expanded uncertainty (k = 2)",
    ),
    ResultColumn(
        "K, 10⁻⁶",
        72,
        lambda test: coefficient_number(test.coefficient),
        lambda test: test.coefficient,
        right=True,
        rank=2,
        tip="Wear coefficient in 10⁻⁶ mm³/(N m)",
    ),
)
TITLES = [column.title for column in COLUMNS]


def matches(row: Row, text: str, outcome: str | None) -> bool:
    """Return whether a file matches every word of a text, and the outcome."""
    path, result = row
    if result is None:
        known = Path(path).name
    else:
        known = " ".join(
            (Path(path).name, result.title, result.specimen, result.operator, result.reason)
        )
    wanted = all(word in known.lower() for word in text.lower().split())
    return wanted and (outcome is None or (result is not None and result.outcome == outcome))


class ResultModel(QAbstractTableModel):
    """Model of the shown rows, in order."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: list[Row] = []

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return the number of rows."""
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """Return the number of columns."""
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section: int, orientation: Qt.Orientation, role: int = 0) -> Any:
        """Return the heading of a column."""
        if orientation is not Qt.Orientation.Horizontal:
            return None
        if role == Qt.ItemDataRole.DisplayRole:
            return tr(COLUMNS[section].title)
        if role == Qt.ItemDataRole.ToolTipRole:
            return tr(COLUMNS[section].tip or COLUMNS[section].title)
        if role == Qt.ItemDataRole.TextAlignmentRole:
            side = (
                Qt.AlignmentFlag.AlignRight
                if COLUMNS[section].right
                else Qt.AlignmentFlag.AlignLeft
            )
            return side | Qt.AlignmentFlag.AlignVCenter
        return None

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> Any:
        """Return the text of a cell, the file of a row, or the alignment of a cell."""
        path, result = self.rows[index.row()]
        column = COLUMNS[index.column()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            if column.title == TEST:
                return (result.title if result else "") or Path(path).name
            return column.text(result) if result else READING
        if role == Qt.ItemDataRole.ToolTipRole:
            return f"{path}\n{translate(result.reason)}" if result else path
        if role == Qt.ItemDataRole.TextAlignmentRole and column.right:
            return Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        return None

    def show_rows(self, rows: list[Row]) -> bool:
        """Show rows; return whether rows or order have changed."""
        if [path for path, _ in rows] == [path for path, _ in self.rows]:
            changed = [
                index
                for index, row in enumerate(rows)
                if row is not self.rows[index] and row != self.rows[index]
            ]
            self.rows = rows
            if changed:
                last = len(COLUMNS) - 1
                self.dataChanged.emit(self.index(changed[0], 0), self.index(changed[-1], last))
            return False
        self.beginResetModel()
        self.rows = rows
        self.endResetModel()
        return True


class ResultDelegate(QStyledItemDelegate):
    """Paint the sparkline of the wear, test and specimen, and the shape of the outcome."""

    def __init__(self, theme: Theme, view: QTableView) -> None:
        super().__init__(view)
        self.theme = theme
        self._small = sized(view.font(), CAPTION_PT)
        self._bold = sized(view.font(), BODY_PT, QFont.Weight.DemiBold)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint a cell."""
        model = index.model()
        assert isinstance(model, ResultModel)
        path, result = model.rows[index.row()]
        title = COLUMNS[index.column()].title
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        if chosen:
            painter.fillRect(option.rect, QColor(self.theme.tint))
        painter.save()
        painter.setPen(QColor(self.theme.hairline))
        painter.drawLine(option.rect.bottomLeft(), option.rect.bottomRight())
        room = QRectF(option.rect).adjusted(STEP, 0, -STEP, 0)
        if title == TEST:
            self._paint_test(painter, room, path, result)
        elif result is not None and title == ENDED:
            self._paint_outcome(painter, room, result.outcome)
        elif result is not None and title == LINE:
            self._paint_line(painter, room.adjusted(0, STEP, 0, -STEP), result.depths_um)
        elif title != ENDED:
            side = index.data(Qt.ItemDataRole.TextAlignmentRole) or Qt.AlignmentFlag.AlignVCenter
            painter.setPen(QColor(self.theme.text))
            painter.drawText(room, side, str(index.data()))
        painter.restore()

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """Return a size that does not depend on the cell's text."""
        return QSize(COLUMNS[index.column()].width, ROW_HEIGHT)

    def _paint_test(
        self, painter: QPainter, room: QRectF, path: str, result: TestResult | None
    ) -> None:
        name = Path(path).name
        title = (result.title if result else "") or name
        below = "  ·  ".join(part for part in ((result.specimen if result else ""), name) if part)
        half = room.height() / 2.0
        for text, font, colour, top, side in (
            (title, self._bold, self.theme.text, room.top(), Qt.AlignmentFlag.AlignBottom),
            (below, self._small, self.theme.muted, room.top() + half, Qt.AlignmentFlag.AlignTop),
        ):
            painter.setFont(font)
            painter.setPen(QColor(colour))
            shown = painter.fontMetrics().elidedText(
                text, Qt.TextElideMode.ElideMiddle, int(room.width())
            )
            painter.drawText(QRectF(room.left(), top, room.width(), half), side, shown)

    def _paint_outcome(self, painter: QPainter, room: QRectF, outcome: HowEnded) -> None:
        colour = colour_of(outcome, self.theme)
        side = SMALL.width()
        square = QRectF(room.left(), room.center().y() - side / 2, side, side).toRect()
        icon(SHAPES[outcome], colour).paint(painter, square)
        painter.setPen(QColor(colour))
        rest = room.adjusted(side + STEP, 0, 0, 0)
        painter.drawText(rest, Qt.AlignmentFlag.AlignVCenter, tr(outcome.value))

    def _paint_line(self, painter: QPainter, room: QRectF, values: Sequence[float]) -> None:
        painter.setPen(QColor(self.theme.strong))
        painter.drawLine(room.bottomLeft(), room.bottomRight())
        if len(values) < 2:
            return
        top, low = max(max(values), 1e-9), min(min(values), 0.0)
        step = room.width() / (len(values) - 1)
        scale = room.height() / (top - low)
        points = [
            QPointF(room.left() + step * at, room.bottom() - scale * (value - low))
            for at, value in enumerate(values)
        ]
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(QPen(QColor(self.theme.curves["first"]), 1.0))
        painter.drawPolyline(QPolygonF(points))


class ResultTable(QTableView):
    """Show the tests of a shelf: filtered, sorted, each row as soon as it is read.

    most: maximum number of rows, 0 for all.
    """

    chosen_changed = Signal()
    opened = Signal(str)

    def __init__(self, name: str, shelf: ResultsIndex, theme: Theme, *, most: int = 0) -> None:
        super().__init__()
        named(self, name, "Recorded tests, newest first")
        self._shelf, self._most = shelf, most
        self._sorted: tuple[int, Qt.SortOrder] | None = None
        self._wanted: tuple[str, str | None] = ("", None)
        self.rows = ResultModel()
        self.setModel(self.rows)
        self._painter = ResultDelegate(theme, self)
        self.setItemDelegate(self._painter)
        self.setShowGrid(False)
        self.setTabKeyNavigation(False)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.verticalHeader().hide()
        self.verticalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Fixed)
        self.verticalHeader().setDefaultSectionSize(ROW_HEIGHT)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        for index, column in enumerate(COLUMNS):
            header.resizeSection(index, max(column.width, header.sectionSizeHint(index)))
        header.setSectionResizeMode(TITLES.index(TEST), QHeaderView.ResizeMode.Stretch)
        header.setSectionsClickable(not most)
        header.sectionClicked.connect(self.sort_by)
        self.selectionModel().selectionChanged.connect(lambda *_: self.chosen_changed.emit())
        self.doubleClicked.connect(lambda index: self.opened.emit(self.rows.rows[index.row()][0]))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Hide columns without room; the card of a selected test shows them all."""
        super().resizeEvent(event)
        header = self.horizontalHeader()
        left = self.viewport().width() - TEST_WIDTH
        for index in sorted(range(len(COLUMNS)), key=lambda index: COLUMNS[index].rank):
            wide = (
                0
                if COLUMNS[index].title == TEST
                else max(COLUMNS[index].width, header.sectionSizeHint(index))
            )
            hidden = wide > left or (bool(self._most) and COLUMNS[index].rank == EXTRA)
            left -= 0 if hidden else wide
            if self.isColumnHidden(index) != hidden:
                self.setColumnHidden(index, hidden)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._painter.theme = theme
        self.viewport().update()

    def filter(self, text: str, outcome: str | None) -> None:
        """Show only tests with every word of a text and this outcome."""
        self._wanted = text, outcome
        self.refresh()

    def sort_by(self, column: int) -> None:
        """Sort by a column, reversed at the second click, newest first at the third."""
        header = self.horizontalHeader()
        if self._sorted is None or self._sorted[0] != column:
            self._sorted = column, DESCENDING
        else:
            self._sorted = (column, ASCENDING) if self._sorted[1] is DESCENDING else None
        header.setSortIndicatorShown(self._sorted is not None)
        if self._sorted is not None:
            header.setSortIndicator(*self._sorted)
        self.refresh()

    def refresh(self) -> None:
        """Show the present rows of the shelf; the selection stays."""
        rows = [(path, self._shelf.result(path)) for path in self._shelf.paths]
        rows = [row for row in rows if matches(row, *self._wanted)]
        if self._sorted is not None:
            rows = self._in_order(rows, *self._sorted)
        kept = set(self.chosen_paths())
        if self.rows.show_rows(rows[: self._most] if self._most else rows) and kept:
            self.choose(kept)

    def _in_order(self, rows: list[Row], column: int, order: Qt.SortOrder) -> list[Row]:
        """Return rows sorted, unknown values last."""
        key = COLUMNS[column].key
        known = [row for row in rows if row[1] is not None and key(row[1]) == key(row[1])]
        known_paths = {path for path, _ in known}
        known.sort(key=lambda row: key(row[1]), reverse=order is DESCENDING)  # type: ignore[arg-type]
        return known + [row for row in rows if row[0] not in known_paths]

    def chosen_paths(self) -> list[str]:
        """Return the selected files in the order shown."""
        rows = sorted({index.row() for index in self.selectionModel().selectedRows()})
        return [self.rows.rows[at][0] for at in rows]

    def choose(self, paths: set[str]) -> None:
        """Select files."""
        self.clearSelection()
        model, flag = self.selectionModel(), self.selectionModel().SelectionFlag
        for index, (path, _) in enumerate(self.rows.rows):
            if path in paths:
                model.select(self.rows.index(index, 0), flag.Select | flag.Rows)

    def keyPressEvent(self, event: Any) -> None:
        """Open the selected test by Enter."""
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter) and self.chosen_paths():
            self.opened.emit(self.chosen_paths()[0])
            return
        super().keyPressEvent(event)
