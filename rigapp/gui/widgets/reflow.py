"""Rows and splitters that wrap in a window that is too narrow for them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from string import Formatter
from typing import Self

from PySide6.QtCore import QEvent, QMargins, QRect, QSize, Qt
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QLabel, QLayout, QLayoutItem, QSpacerItem, QSplitter, QWidget

from rigapp.gui.widgets.build import Item, named, row
from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, tr

Line = list[tuple[QLayoutItem, QSize]]


class WrappingRow(QLayout):
    """Widgets side by side at their own widths; those without room wrap to the next line.

    Items with a stretch take the rest of their line; without them a spacer does.
    """

    def __init__(self, on: QWidget | None = None) -> None:
        super().__init__(on)
        self._items: list[QLayoutItem] = []
        self._stretching: set[QWidget] = set()
        self._tall = 0
        # Queried hundreds of times while a page is laid out; Qt's own layouts cache it, too.
        self._heights: dict[int, int] = {}
        self.setContentsMargins(QMargins())
        self.setSpacing(GAP)

    def add(self, widget: QWidget, stretch: int) -> None:
        """Append a widget; with a stretch it takes the rest of its line."""
        self.addWidget(widget)
        if stretch:
            self._stretching.add(widget)

    def addItem(self, item: QLayoutItem) -> None:
        """Append an item."""
        self._items.append(item)

    def count(self) -> int:
        """Return the number of items."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem | None:
        """Return an item, None beyond the last."""
        return self._items[index] if 0 <= index < len(self._items) else None

    def takeAt(self, index: int) -> QLayoutItem | None:
        """Remove and return an item, None beyond the last."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None

    def expandingDirections(self) -> Qt.Orientation:
        """Return horizontal, and vertical where an item expands vertically."""
        seen = [(item, QSize()) for item in self._seen() if item.spacerItem() is None]
        tall = Qt.Orientation.Vertical if _grows(seen) else Qt.Orientation(0)
        return Qt.Orientation.Horizontal | tall

    def hasHeightForWidth(self) -> bool:
        """Return True: the height depends on the width."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines at a width, in pixels."""
        if width not in self._heights:
            margins = self.contentsMargins()
            lines = self._lines(width - margins.left() - margins.right())
            gaps = self.spacing() * max(len(lines) - 1, 0)
            high = sum(map(_height, lines)) + gaps + margins.top() + margins.bottom()
            self._heights[width] = high
        return self._heights[width]

    def invalidate(self) -> None:
        """Drop the cached heights, since an item has another size."""
        self._heights.clear()
        super().invalidate()

    def sizeHint(self) -> QSize:
        """Return the size of a single line."""
        sizes = [_wanted(item) for item in self._seen() if item.spacerItem() is None]
        gaps = self.spacing() * max(len(sizes) - 1, 0)
        return self._framed(sum(size.width() for size in sizes) + gaps, sizes)

    def minimumSize(self) -> QSize:
        """Return the width of the widest item, and the height of the present lines.

        This is also correct for parents that do not query the height for a width, such as a
        splitter.
        """
        seen = self._seen()
        wide = max((item.minimumSize().width() for item in seen), default=0)
        least = self._framed(
            wide, [item.minimumSize() for item in seen if not item.hasHeightForWidth()]
        )
        return least.expandedTo(QSize(0, self._tall))

    def _framed(self, width: int, sizes: Sequence[QSize]) -> QSize:
        margins = self.contentsMargins()
        height = max((size.height() for size in sizes), default=0)
        return QSize(
            width + margins.left() + margins.right(), height + margins.top() + margins.bottom()
        )

    def setGeometry(self, rect: QRect) -> None:
        """Place the lines below each other."""
        super().setGeometry(rect)
        room = rect.marginsRemoved(self.contentsMargins())
        y = room.y()
        lines = self._lines(room.width())
        growing = [line for line in lines if _grows(line)]
        over = max(rect.height() - self.heightForWidth(rect.width()), 0) // max(len(growing), 1)
        if not growing:
            y += (rect.height() - self.heightForWidth(rect.width())) // 2
        for line in lines:
            height = _height(line) + (over if line in growing else 0)
            self._lay(line, QRect(room.x(), y, room.width(), height))
            y += height + self.spacing()
        tall, on = self.heightForWidth(rect.width()), self.parentWidget()
        # Widths are not final before the window is shown.
        if tall != self._tall and on is not None and on.window().isVisible():
            self._tall = tall
            self.update()

    def _seen(self) -> list[QLayoutItem]:
        return [item for item in self._items if item.spacerItem() is not None or not item.isEmpty()]

    def _lines(self, width: int) -> list[Line]:
        lines: list[Line] = []
        left = 0
        for item in self._seen():
            size = _wanted(item)
            size.setWidth(min(size.width(), max(width, item.minimumSize().width())))
            if not lines or size.width() > left:
                if item.spacerItem() is not None:
                    continue
                lines.append([])
                left = width
            lines[-1].append((item, size))
            left -= size.width() + (self.spacing() if item.spacerItem() is None else 0)
        return [self._filled(line, width) for line in lines]

    def _filled(self, line: Line, width: int) -> Line:
        """Return a line whose items share the remaining width."""
        parts = [size.width() for item, size in line if item.spacerItem() is None]
        over = width - sum(parts) - self.spacing() * (len(parts) - 1)
        greedy = [item for item, _ in line if item.widget() in self._stretching]
        greedy = greedy or [item for item, _ in line if item.spacerItem() is not None]
        more = max(over, 0) // max(len(greedy), 1)
        return [
            (item, QSize(size.width() + more, size.height()))
            if any(item is stretched for stretched in greedy)
            else (item, size)
            for item, size in line
        ]

    def _lay(self, line: Line, room: QRect) -> None:
        height, x = room.height(), room.x()
        for item, size in line:
            if item.spacerItem() is not None:
                x += size.width()
                continue
            grows = bool(item.expandingDirections() & Qt.Orientation.Vertical)
            tall = height if grows or item.hasHeightForWidth() else min(size.height(), height)
            item.setGeometry(QRect(x, room.y() + (height - tall) // 2, size.width(), tall))
            x += size.width() + self.spacing()


def _wanted(item: QLayoutItem) -> QSize:
    return item.sizeHint().expandedTo(item.minimumSize())


def _height(line: Line) -> int:
    return max(
        max(item.heightForWidth(size.width()), item.minimumHeightForWidth(size.width()))
        if item.hasHeightForWidth()
        else size.height()
        for item, size in line
    )


def _grows(line: Line) -> bool:
    """Return whether a line can use additional height."""
    return any(item.expandingDirections() & Qt.Orientation.Vertical for item, _ in line)


def flowing(*items: Item | tuple[Item, int], on: QWidget | None = None) -> WrappingRow:
    """Return a wrapping row of items; see ``build.filled``.

    A caption stays with the next widget.
    """
    layout = WrappingRow(on)
    caption: Text = ""
    for entry in items:
        item, stretch = entry if isinstance(entry, tuple) else (entry, 0)
        if item is None:
            layout.addItem(QSpacerItem(0, 0))
        elif isinstance(item, str):
            caption = item
        elif isinstance(item, QWidget):
            layout.add(_captioned(caption, item, stretch) if caption else item, stretch)
            caption = ""
    return layout


SentencePart = tuple[QWidget, QWidget | None, bool]
"""A field, its unit, and whether the field takes the rest of the line."""


def sentence_row(
    sentence: str, field_of: Callable[[str], SentencePart], before: QWidget | None = None
) -> WrappingRow:
    """Return a sentence with fields in place of its braces; it wraps between them.

    The words before a field and the unit after it stay with it. before: the first widget.
    """
    layout = WrappingRow()
    layout.setSpacing(STEP)
    if before is not None:
        layout.add(before, 0)
    for words, name, _, _ in Formatter().parse(sentence):
        label = QLabel(words.strip())
        if name is None:
            layout.add(label, 0)
            continue
        field, unit, wide = field_of(name)
        label.setBuddy(field)
        before = label if label.text() else None
        layout.add(together(before, (field, int(wide)), unit), int(wide))
    return layout


def together(*parts: QWidget | tuple[QWidget, int] | None) -> QWidget:
    """Return a row that does not wrap; parts that are None are omitted."""
    shown = [part for part in parts if part is not None]
    if len(shown) == 1:
        return shown[0][0] if isinstance(shown[0], tuple) else shown[0]
    widget = QWidget()
    row(*shown, on=widget, margins=0, spacing=STEP)
    return widget


def _captioned(caption: Text, field: QWidget, stretch: int) -> QWidget:
    """Return a field with its caption."""
    label = QLabel(tr(caption))
    label.setBuddy(field)
    return together(label, (field, stretch))


class WrappingGrid(WrappingRow):
    """Cards of equal width side by side: as many as their minimum width allows, up to ``most``."""

    def __init__(self, least: int, most: int = 2, on: QWidget | None = None) -> None:
        super().__init__(on)
        self._least, self._most = least, most

    def _lines(self, width: int) -> list[Line]:
        seen = self._seen()
        fits = (width + self.spacing()) // (self._least + self.spacing())
        across = max(1, min(fits, self._most, len(seen)))
        wide = (width - (across - 1) * self.spacing()) // across
        cards = [(item, QSize(wide, _wanted(item).height())) for item in seen]
        return [cards[first : first + across] for first in range(0, len(cards), across)]


class FoldingSplitter(QSplitter):
    """Panels side by side with movable borders; below each other in a narrow window.

    width: required for the panels side by side, pixels.
    """

    def __init__(self, name: str, width: int, spoken: Text = "Divided panels") -> None:
        super().__init__(Qt.Orientation.Horizontal)
        named(self, name, spoken)
        self._least = width
        self._sizes: list[int] = []
        self._heights: tuple[int, ...] = ()
        self.setChildrenCollapsible(False)
        self.setHandleWidth(GAP)
        self.splitterMoved.connect(self._moved)

    def divide(self, *parts: tuple[QWidget, int, int]) -> Self:
        """Add panels, each with its width side by side and its height below each other."""
        for part, _, _ in parts:
            self.addWidget(part)
        self._sizes = [width for _, width, _ in parts]
        self._heights = tuple(height for _, _, height in parts)
        self.setSizes(self._sizes)
        return self

    @property
    def folded(self) -> bool:
        """Return whether the panels are below each other."""
        return self.orientation() is Qt.Orientation.Vertical

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Change the orientation where the panels need it."""
        super().resizeEvent(event)
        if (self.width() < self._least) is not self.folded:
            self._turn(folded=not self.folded)

    def minimumSizeHint(self) -> QSize:
        """Return the width of the widest panel, since the others can be below it."""
        least = super().minimumSizeHint()
        parts = [part for index in range(self.count()) if (part := self.widget(index)) is not None]
        wide = max((part.minimumSizeHint().width() for part in parts), default=0)
        return QSize(wide, least.height())

    def event(self, event: QEvent) -> bool:
        """Set the minimum height of each panel to that of its wrapped texts."""
        if event.type() is QEvent.Type.LayoutRequest:
            self._hold_heights()
        return super().event(event)

    def _moved(self) -> None:
        if not self.folded:
            self._sizes = self.sizes()

    def _hold_heights(self) -> None:
        for at, height in enumerate(self._heights):
            part = self.widget(at)
            least = max(height, part.minimumSizeHint().height()) if part and self.folded else 0
            if part is not None and part.minimumHeight() != least:
                part.setMinimumHeight(least)

    def _turn(self, *, folded: bool) -> None:
        self.setOrientation(Qt.Orientation.Vertical if folded else Qt.Orientation.Horizontal)
        self._hold_heights()
        self.setSizes(list(self._heights) if folded else self._sizes)
        self.updateGeometry()
