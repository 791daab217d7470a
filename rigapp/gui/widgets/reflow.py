"""A row that goes on in a next line where the window is too narrow for it."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QMargins, QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QLayout, QLayoutItem, QWidget

from rigapp.gui.look.tokens import GAP

Line = list[tuple[QLayoutItem, QSize]]


class WrappingRow(QLayout):
    """Widgets beside each other, at their own widths; those that find no room go to a next line.

    stretching: these take what is left of their line.
    """

    def __init__(self, *widgets: QWidget, stretching: Sequence[QWidget] = ()) -> None:
        super().__init__()
        self._items: list[QLayoutItem] = []
        self._stretching = tuple(stretching)
        self.setContentsMargins(QMargins())
        self.setSpacing(GAP)
        for one in widgets:
            self.addWidget(one)

    def addItem(self, item: QLayoutItem) -> None:
        """Take an item at the end."""
        self._items.append(item)

    def count(self) -> int:
        """Return how many items there are."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:
        """Return an item, None beyond the last."""
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:
        """Give an item back, None beyond the last."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def expandingDirections(self) -> Qt.Orientation:
        """Take the width that there is."""
        return Qt.Orientation.Horizontal

    def hasHeightForWidth(self) -> bool:
        """Say that the height follows from the width."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines at a width, in pixels."""
        lines = self._lines(width)
        return sum(_height(line) for line in lines) + self.spacing() * max(len(lines) - 1, 0)

    def sizeHint(self) -> QSize:
        """Return the size of a single line."""
        sizes = [item.sizeHint() for item in self._seen()]
        gaps = self.spacing() * max(len(sizes) - 1, 0)
        wide = sum(size.width() for size in sizes) + gaps
        return QSize(wide, max((size.height() for size in sizes), default=0))

    def minimumSize(self) -> QSize:
        """Return the width of the widest item, and the height of a line."""
        sizes = [item.minimumSize() for item in self._seen()]
        wide = max((size.width() for size in sizes), default=0)
        return QSize(wide, max((size.height() for size in sizes), default=0))

    def setGeometry(self, rect: QRect) -> None:
        """Lay the lines below each other."""
        super().setGeometry(rect)
        y = rect.y()
        for line in self._lines(rect.width()):
            self._lay(line, QPoint(rect.x(), y), rect.width())
            y += _height(line) + self.spacing()

    def _seen(self) -> list[QLayoutItem]:
        return [item for item in self._items if not item.isEmpty()]

    def _lines(self, width: int) -> list[Line]:
        lines: list[Line] = []
        left = 0
        for item in self._seen():
            size = item.sizeHint().expandedTo(item.minimumSize())
            size.setWidth(min(size.width(), max(width, item.minimumSize().width())))
            if not lines or size.width() > left:
                lines.append([])
                left = width
            lines[-1].append((item, size))
            left -= size.width() + self.spacing()
        return lines

    def _lay(self, line: Line, at: QPoint, width: int) -> None:
        taken = sum(size.width() for _, size in line) + self.spacing() * (len(line) - 1)
        greedy = [item for item, _ in line if item.widget() in self._stretching]
        more = max(width - taken, 0) // max(len(greedy), 1)
        height, x = _height(line), at.x()
        for item, size in line:
            wide = size.width() + (more if item in greedy else 0)
            grows = bool(item.expandingDirections() & Qt.Orientation.Vertical)
            tall = height if grows or item.hasHeightForWidth() else min(size.height(), height)
            item.setGeometry(QRect(x, at.y() + (height - tall) // 2, wide, tall))
            x += wide + self.spacing()


def _height(line: Line) -> int:
    return max(
        item.heightForWidth(size.width()) if item.hasHeightForWidth() else size.height()
        for item, size in line
    )
