"""Axes that keep still: of a fixed width, with at most five ticks at round places."""

from __future__ import annotations

from typing import Any

import pyqtgraph as pg
from PySide6.QtWidgets import QGraphicsItem

from rigapp.gui.plots.marks import Tick, small_font
from rigapp.presentation.numbers import axis_number
from rigapp.presentation.tokens import STEP
from rigapp.viewer.ranges import round_places

MOST_TICKS = 5
"""More ticks do not improve reading."""
ROWS_APART = 2.0
"""Heights of a tick's text between two ticks of a vertical axis."""
TEXT_APART = "−00,000,000"
"""At least the width of this between two ticks of a horizontal axis."""
WIDEST = "−0.0000"
"""Of the texts at a vertical axis: its room never changes, so that the plot keeps still."""


class QuietAxis(pg.AxisItem):  # type: ignore[misc]
    """One axis: its width beside the plot, its ticks and its caption, which the plot paints."""

    def __init__(self, side: str) -> None:
        super().__init__(side)
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemHasNoContents)
        self.flat = side == "bottom"
        self.text = ""
        self.caption("")

    def caption(self, text: str) -> None:
        """Set the quantity along it, with its unit."""
        self.text = text
        row = small_font()[1].height()
        if self.flat:
            self.setHeight((2 if text else 1) * (row + STEP // 2) + STEP // 2)
        else:
            widest = small_font()[1].horizontalAdvance(WIDEST)
            self.setWidth(widest + STEP + (row + STEP if text else 0))

    def ticks(self) -> list[Tick]:
        """Return the places of the ticks, and their texts."""
        if self._tickLevels is not None:
            return list(self._tickLevels[0])
        metrics = small_font()[1]
        size = self.width() if self.flat else self.height()
        apart = (
            metrics.horizontalAdvance(TEXT_APART) if self.flat else metrics.height() * ROWS_APART
        )
        most = min(MOST_TICKS, int(size / apart))
        low, high = self.range
        step, places = round_places(low, high, max(most, 2), 2 if self.flat else 3)
        return [(at, axis_number(at, step)) for at in places]

    def wheelEvent(self, event: Any) -> None:
        """Leave the wheel to the plot."""
        event.ignore()
