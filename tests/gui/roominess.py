"""Where a text has less room than its words need, in whatever is to be seen of a widget."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import (
    QAbstractButton,
    QCheckBox,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QTableView,
    QWidget,
)

from rigapp.gui.widgets.labels import ElidedLabel

SCALES = (1.0, 1.5, 2.0)
SIZES = ((1366, 768), (1920, 1080))

OF_ANY_LENGTH = {"identity", "identity_line", "answer", "state_detail", "alarms_detail"}
"""Labels of what others have named or told: cut with an ellipsis, whole in the tool tip."""


def cut_texts(top: QWidget) -> list[str]:
    """Return what has less room than its words need, of all that is to be seen."""
    return [
        f"{one.objectName() or type(one).__name__}: {why}"
        for one in top.findChildren(QWidget)
        if one.isVisibleTo(top) and (why := _cut(one))
    ]


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
        return one.text() if one.sizeHint().width() > one.width() + 1 else ""
    if isinstance(one, QComboBox):
        wide = metrics.horizontalAdvance(one.currentText())
        return one.currentText() if wide > one.width() - 24 else ""
    if isinstance(one, QLineEdit) and one.placeholderText():
        wide = metrics.horizontalAdvance(one.placeholderText())
        return one.placeholderText() if wide > one.width() - 16 else ""
    if isinstance(one, QTableView) and one.horizontalHeader().isVisible():
        return ", ".join(_cut_headings(one.horizontalHeader()))
    return ""


def _cut_headings(header: QHeaderView) -> Iterator[str]:
    for at in range(header.count()):
        if not header.isSectionHidden(at) and header.sectionSizeHint(at) > header.sectionSize(at):
            yield str(header.model().headerData(at, Qt.Orientation.Horizontal))
