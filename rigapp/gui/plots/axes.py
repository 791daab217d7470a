"""Axes with few round ticks: no lines, whole thousands apart, a true minus."""

from __future__ import annotations

from typing import Any

import pyqtgraph as pg
from PySide6.QtGui import QFont, QFontMetrics

from rigapp.gui.data.ranges import round_places
from rigapp.gui.data.texts import axis_number
from rigapp.gui.look.fonts import sized
from rigapp.gui.look.tokens import CAPTION_PT, STEP

MOST_TICKS = 5
"""More are read no better, and each is painted at every frame."""
ROWS_APART = 2.0
"""Heights of a tick's text between two ticks of a vertical axis."""
TEXT_APART = "−00,000,000"
"""At least the width of this between two ticks of a horizontal axis."""
WIDEST = "−0.0000"
"""Of the texts at a vertical axis: its room never changes, so that the plot keeps still."""


class QuietAxis(pg.AxisItem):  # type: ignore[misc]
    """One axis; ``places`` tells where its ticks are, for the lines that the plot paints there."""

    def __init__(self, side: str) -> None:
        super().__init__(side, maxTickLength=0)
        font = sized(QFont(), CAPTION_PT)
        self._metrics = QFontMetrics(font)
        self.setTickFont(font)
        self.setStyle(tickLength=0, tickTextOffset=STEP // 2, autoExpandTextSpace=False)
        self.enableAutoSIPrefix(False)
        self.label.setFont(font)
        self._give_room(named=False)

    def caption(self, text: str) -> None:
        """Write what is drawn along it, with its unit."""
        self.setLabel(text)
        self._give_room(named=True)

    def places(self) -> list[float]:
        """Return where the ticks are."""
        if self._tickLevels is not None:
            return [at for at, _ in self._tickLevels[0]]
        size = self.width() if self.orientation == "bottom" else self.height()
        low, high = self.range
        return self.tickValues(low, high, size)[0][1]

    def tickValues(self, low: float, high: float, size: float) -> list[tuple[float, list[float]]]:
        """Return the distance of the ticks and their places."""
        flat = self.orientation == "bottom"
        apart = self._metrics.horizontalAdvance(TEXT_APART) if flat else self._row * ROWS_APART
        most = min(MOST_TICKS, int(size / apart)) if apart else MOST_TICKS
        return [round_places(low, high, max(most, 2), 2 if flat else 3)]

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """Return what stands at the ticks."""
        return [axis_number(value, spacing) for value in values]

    @property
    def _row(self) -> int:
        return self._metrics.height()

    def _give_room(self, *, named: bool) -> None:
        if self.orientation == "bottom":
            self.setHeight((2 if named else 1) * (self._row + STEP // 2) + STEP // 2)
        else:
            widest = self._metrics.horizontalAdvance(WIDEST)
            self.setWidth(widest + STEP + (self._row + STEP if named else 0))

    def wheelEvent(self, event: Any) -> None:
        """Leave the wheel to the plot."""
        event.ignore()
