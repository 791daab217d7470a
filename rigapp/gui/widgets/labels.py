"""Labels of one line: elided, or with a smaller font, where there is no room."""

from __future__ import annotations

from bisect import bisect_left

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QFont, QFontMetrics, QResizeEvent
from PySide6.QtWidgets import QLabel, QSizePolicy, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.presentation.tokens import BODY_PT
from rigapp.presentation.translation import Text, tr

WRAPPED = int(Qt.TextFlag.TextWordWrap)

SMALLEST = 0.5
"""Minimum font size of a value before it is elided, share of its normal size."""


def heading(name: str, text: Text, points: float = BODY_PT) -> QLabel:
    """Return the heading of a card, in the weight of headings."""
    label = QLabel(tr(text))
    label.setObjectName(name)
    label.setAccessibleName(label.text())
    label.setFont(sized(label.font(), points, QFont.Weight.DemiBold))
    return label


class ElidedLabel(QLabel):
    """Show one line, elided where it does not fit; the tool tip has the full text."""

    def __init__(self, name: str, spoken: Text) -> None:
        super().__init__()
        self._whole = self._short = ""
        self.setObjectName(name)
        self.setAccessibleName(tr(spoken))
        self.setTextFormat(Qt.TextFormat.PlainText)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)

    def show_text(self, text: Text, short: Text = "") -> None:
        """Show a text; an unchanged one is not repainted.

        short: replaces the text where there is no room for it.
        """
        text, short = tr(text), tr(short)
        if (text, short) != (self._whole, self._short):
            self._whole, self._short = text, short
            self.setToolTip(text)
            self._cut()

    @property
    def whole(self) -> str:
        """Return the complete text."""
        return self._whole

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Elide the text for the new width."""
        super().resizeEvent(event)
        self._cut()

    def _cut(self) -> None:
        metrics = QFontMetrics(self.font())
        room = max(self.contentsRect().width(), 1)
        cut = metrics.elidedText(self._whole, Qt.TextElideMode.ElideRight, room)
        if self._short and cut != self._whole:
            cut = metrics.elidedText(self._short, Qt.TextElideMode.ElideRight, room)
        self.setText(cut)


class ShortLabel(ElidedLabel):
    """Show one line, or its short text, which always fits."""

    def show_text(self, text: Text, short: Text = "") -> None:
        """Show a text; see ``ElidedLabel``."""
        margins = self.contentsMargins()
        needs = QFontMetrics(self.font()).horizontalAdvance(tr(short) or "–")
        self.setMinimumWidth(needs + margins.left() + margins.right() + 2)
        super().show_text(text, short)


class FewLinesLabel(ElidedLabel):
    """Show a sentence in a few lines; elided only where these are too few."""

    def __init__(self, name: str, spoken: Text, lines: int) -> None:
        super().__init__(name, spoken)
        self._lines = lines
        self.setWordWrap(True)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)

    def _cut(self) -> None:
        metrics = QFontMetrics(self.font())
        room = QRect(0, 0, max(self.contentsRect().width(), 1), self._lines * metrics.lineSpacing())

        def fits(text: str) -> bool:
            return room.height() >= metrics.boundingRect(room, WRAPPED, text).height()

        text = self._whole
        over = bisect_left(range(len(text)), True, key=lambda end: not fits(f"{text[:end]}…"))
        self.setText(text if fits(text) else f"{text[: max(over - 1, 0)].rstrip()}…")


class FittedLabel(ElidedLabel):
    """Show one line, smaller where it does not fit; elided only when half its size is too large."""

    def __init__(self, name: str, spoken: Text, font: QFont) -> None:
        super().__init__(name, spoken)
        self.set_largest(font)

    def set_largest(self, font: QFont) -> None:
        """Set the font for sufficient room."""
        self._largest = font
        self.setFont(font)
        self.setFixedHeight(QFontMetrics(font).height())
        self._cut()

    def _cut(self) -> None:
        font = QFont(self._largest)
        room = max(self.contentsRect().width(), 1)
        smallest = SMALLEST * font.pointSizeF()
        right = Qt.TextElideMode.ElideRight
        while (
            # By elision: a width in integer pixels may be slightly too small.
            QFontMetrics(font).elidedText(self._whole, right, room) != self._whole
            and font.pointSizeF() > smallest
        ):
            font.setPointSizeF(0.95 * font.pointSizeF())
        if font != self.font():
            self.setFont(font)
        super()._cut()


def scaled_font(widget: QWidget, factor: float, *, bold: bool = False) -> QFont:
    """Return the widget's font times a factor."""
    font = QFont(widget.font())
    font.setPointSizeF(font.pointSizeF() * factor)
    font.setBold(bold)
    return font
