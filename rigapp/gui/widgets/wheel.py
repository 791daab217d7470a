"""Fields that the mouse wheel changes only while they have the focus: a form scrolls over them."""

from __future__ import annotations

from typing import TypeVar

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtWidgets import QAbstractSpinBox, QComboBox, QWidget

from rigapp.gui.look.tokens import STEP

Field = TypeVar("Field", bound=QComboBox | QAbstractSpinBox)


class WheelGuard(QObject):
    """Leave the wheel over a field to the page unless the field has the focus."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep the wheel from a field without the focus."""
        if event.type() is not QEvent.Type.Wheel or not isinstance(watched, QWidget):
            return False
        if watched.hasFocus():
            return False
        event.ignore()
        return True


def steady_field(field: Field) -> Field:
    """Return a field that takes the wheel with the focus only, its number where texts begin."""
    field.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    field.installEventFilter(WheelGuard(field))
    if isinstance(field, QAbstractSpinBox):
        # A style sheet's padding does not reach the line inside.
        field.lineEdit().setTextMargins(STEP - 2, 0, 0, 0)
    return field
