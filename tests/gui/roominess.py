"""Where a text has less room than its words need, in whatever is to be seen of a widget."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractScrollArea,
    QAbstractSpinBox,
    QCheckBox,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QScrollArea,
    QTableView,
    QTableWidget,
    QWidget,
)

from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.presentation.catalogue import LANGUAGES
from rigapp.presentation.translation import ENGLISH

LONGEST_FIRST = (
    *sorted(LANGUAGES.keys() - {ENGLISH}),
    pytest.param(ENGLISH, marks=pytest.mark.long),
)
"""German needs more room than English, which is looked at before a release."""
SCALES = (1.0, 1.5, 2.0)
SIZES = ((1366, 768), (1920, 1080))

OF_ANY_LENGTH = {
    "identity",
    "identity_line",
    "answer",
    "state_detail",
    "alarms_detail",
    "studies_told",
} | {"step_specimen_words"}
"""Labels of what others have named or told: cut with an ellipsis, whole in the tool tip."""

HEADING_FRAME, CELL_FRAME, BUTTON_FRAME, ROWS = 16, 6, 8, 40
"""Around a heading, a cell and the words of a button, in pixels; rows that are looked at."""
NAMES = {"channel_table": (0, 4), "study_depends": (0,), "study_list": (0,), "queue_list": (2, 3)}
"""Columns of names that others have chosen."""
WRAPPED = Qt.TextFlag.TextWordWrap

FLOATING = {"start_bar"}
"""What is shown above others on purpose."""


def cut_texts(top: QWidget) -> list[str]:
    """Return what has less room than its words need, of all that is to be seen."""
    return [
        f"{one.objectName() or type(one).__name__}: {why}"
        for one in _seen(top)
        if (why := _cut(one))
    ]


def _seen(top: QWidget) -> Iterator[QWidget]:
    """Yield what is to be seen of a widget, without looking into what is hidden."""
    for one in top.children():
        if isinstance(one, QWidget) and not one.isHidden() and not one.isWindow():
            yield one
            yield from _seen(one)


def badly_placed(top: QWidget) -> list[str]:
    """Return what sticks out of its parent sideways, and what lies on another of the same parent.

    A page may scroll up and down; what can only be seen by scrolling it sideways sticks out.
    """
    found, kin = [], defaultdict(list)
    for one in _seen(top):
        parent = one.parentWidget()
        if not _is_inside(parent):
            name = one.objectName() or type(one).__name__
            place = one.geometry()
            if place.left() < 0 or place.right() >= parent.width():
                found.append(f"{name}: {place.left()} to {place.right()} of {parent.width()}")
            if isinstance(one, QTableView) and one.horizontalHeader().length() > one.width():
                found.append(f"{name} scrolls sideways")
            if place.isValid() and one.objectName() not in FLOATING:
                kin[parent].append((name, place))
    for placed in kin.values():
        for (name, place), (other, there) in combinations(placed, 2):
            if place.intersects(there):
                found.append(f"{name} lies on {other}")
    return found


def _is_inside(parent: QWidget) -> bool:
    """Tell whether the parts of a widget are placed by itself, not by a layout of ours."""
    own = (QAbstractSpinBox, QComboBox, QLineEdit, QHeaderView)
    scrolls = isinstance(parent, QAbstractScrollArea) and not isinstance(parent, QScrollArea)
    table = isinstance(parent.parentWidget(), QAbstractScrollArea) and not isinstance(
        parent.parentWidget(), QScrollArea
    )
    return isinstance(parent, own) or scrolls or table


def _cut(one: QWidget) -> str:
    metrics, room = QFontMetrics(one.font()), one.contentsRect().width()
    if isinstance(one, ElidedLabel):
        cut = one.text().endswith("…") and not one.whole.endswith("…")
        return one.text() if cut and one.objectName() not in OF_ANY_LENGTH else ""
    if isinstance(one, QLabel) and one.text():
        if one.wordWrap():
            return one.text() if one.heightForWidth(one.width()) > one.height() + 1 else ""
        plain = one.textFormat() is Qt.TextFormat.RichText
        wide = metrics.size(Qt.TextFlag.TextShowMnemonic, one.text()).width()
        return "" if plain or wide <= room + 1 else one.text()
    if isinstance(one, QCheckBox | QAbstractButton) and one.text():
        bold = QFont(one.font())
        if one.isChecked() or one.property("rank") in ("primary", "dangerous"):
            bold.setWeight(QFont.Weight.DemiBold)
        wide = QFontMetrics(bold).size(Qt.TextFlag.TextShowMnemonic, one.text()).width()
        cut = one.sizeHint().width() > one.width() + 1 or wide > one.width() - BUTTON_FRAME
        return one.text() if cut else ""
    if isinstance(one, QComboBox):
        wide = metrics.horizontalAdvance(one.currentText())
        return one.currentText() if wide > one.width() - 24 else ""
    if isinstance(one, QLineEdit) and one.placeholderText():
        wide = metrics.horizontalAdvance(one.placeholderText())
        return one.placeholderText() if wide > one.width() - 16 else ""
    if isinstance(one, QTableView) and one.horizontalHeader().isVisible():
        return ", ".join((*_cut_headings(one.horizontalHeader()), *_cut_cells(one)))
    return ""


def _cut_cells(table: QTableView) -> Iterator[str]:
    """Yield the cells that are seen in part; one that wraps has the height for it."""
    if not isinstance(table, QTableWidget):
        return
    for row in range(max(table.rowAt(0), 0), min(table.rowCount(), ROWS)):
        for at in range(table.columnCount()):
            item = table.item(row, at)
            if item is None or at in NAMES.get(table.objectName(), ()):
                continue
            if table.rowViewportPosition(row) > table.viewport().height():
                continue
            needs = QFontMetrics(table.font()).boundingRect(
                0, 0, table.columnWidth(at) - CELL_FRAME, 0, WRAPPED, item.text()
            )
            if needs.width() > table.columnWidth(at) or needs.height() > table.rowHeight(row):
                yield item.text()


def _cut_headings(header: QHeaderView) -> Iterator[str]:
    for at in range(header.count()):
        text = str(header.model().headerData(at, Qt.Orientation.Horizontal))
        words = max(map(QFontMetrics(header.font()).horizontalAdvance, text.split()), default=0)
        if not header.isSectionHidden(at) and words + HEADING_FRAME > header.sectionSize(at):
            yield str(header.model().headerData(at, Qt.Orientation.Horizontal))
