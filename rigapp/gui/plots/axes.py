"""Stable axes: of a fixed width, with at most five ticks at round values."""

from __future__ import annotations

from typing import Any

import pyqtgraph as pg
from PySide6.QtWidgets import QGraphicsItem

from rigapp.gui.plots.marks import Tick, small_font
from rigapp.presentation.numbers import axis_number
from rigapp.presentation.tokens import STEP
from rigapp.viewer.ranges import round_places

MOST_TICKS = 5
"""Maximum number of ticks; more do not improve reading."""
ROWS_APART = 2.0
"""Minimum distance of two ticks of a vertical axis, in heights of a tick's text."""
TEXT_APART = "−00,000,000"
"""Text whose width is the minimum distance of two ticks of a horizontal axis."""
WIDEST = "−0.0000"
"""Widest text of a vertical axis, whose width is constant so that the plot does not move."""


class QuietAxis(pg.AxisItem):  # type: ignore[misc]
    """One axis: its width, ticks and caption; the plot paints them."""

    def __init__(self, side: str) -> None:
        super().__init__(side)
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemHasNoContents)
        self.flat = side == "bottom"
        self.text = ""
        self.caption("")

    def caption(self, text: str) -> None:
        """Set the caption: quantity and unit."""
        self.text = text
        row = small_font()[1].height()
        if self.flat:
            self.setHeight((2 if text else 1) * (row + STEP // 2) + STEP // 2)
        else:
            widest = small_font()[1].horizontalAdvance(WIDEST)
            self.setWidth(widest + STEP + (row + STEP if text else 0))

    def ticks(self) -> list[Tick]:
        """Return the values of the ticks and their texts."""
        if self._tickLevels is not None:
            return list(self._tickLevels[0])
        metrics = small_font()[1]
        size = self.width() if self.flat else self.height()
        apart = (
            metrics.horizontalAdvance(TEXT_APART) if self.flat else metrics.height() * ROWS_APART
        )
        most = min(MOST_TICKS, int(size / apart))
        low, high = self.range
        step, values = round_places(low, high, max(most, 2), 2 if self.flat else 3)
        return [(at, axis_number(at, step)) for at in values]

    def wheelEvent(self, event: Any) -> None:
        """Ignore the wheel, so that the plot receives it."""
        event.ignore()
