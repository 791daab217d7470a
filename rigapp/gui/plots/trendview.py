"""Common view of the trends of a page: visible cycles and cursor."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rigapp.gui.plots.plotting import NameRoom
from rigapp.schema.rownumbers import RowNumbers
from rigapp.viewer.ranges import nice_step

Floats = NDArray[np.float64]

FOLLOWED = 1000
"""Number of cycles in the view of the last cycles: a quarter of an hour at 60 rpm."""
STEPS = 10
"""Number of moves of the axis while the view fills, instead of one at every cycle."""
WHOLE, LAST, FREE = "whole", "last", "free"


class TrendView:
    """Visible cycles of the trends of a page; ``changed``: functions called at every move."""

    def __init__(self) -> None:
        self.mode = WHOLE
        self.cursor: float | None = None
        self.changed: list[Callable[[], None]] = []
        self.room = NameRoom()
        self._free: tuple[float, float] = (0.0, 1.0)

    def show(self, mode: str) -> None:
        """Show the whole test, or follow the last cycles."""
        self.mode = mode
        self._notify()

    def move(self, low: float, high: float) -> None:
        """Show a manually selected range of cycles."""
        self.mode, self._free = FREE, (low, high)
        self._notify()

    def point_at(self, cycle: float | None) -> None:
        """Place the cursor at a cycle; None removes it."""
        self.cursor = None if cycle is None else float(round(cycle))
        self._notify()

    def start_afresh(self) -> None:
        """Reset the view for another test: all cycles, no cursor."""
        self.mode, self.cursor = WHOLE, None
        self._notify()

    def range_of(self, known: Floats | RowNumbers) -> tuple[float, float] | None:
        """Return the range of cycles to show, None where there are none yet."""
        if self.mode == FREE:
            return self._free
        if len(known) == 0:
            return None
        first, last = float(known[0]), float(known[-1])
        if self.mode == LAST:
            step = FOLLOWED / STEPS
            high = float(step * np.ceil((last + 1) / step))
            return high - FOLLOWED, high
        step = nice_step(max(last - first, 10.0), STEPS)
        return first, float(first + step * np.ceil((last - first + 1) / step))

    def _notify(self) -> None:
        for follow in self.changed:
            follow()
