"""The shared view of the trends of a page: the visible cycles, and the cursor."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rigapp.gui.plots.plotting import NameRoom
from rigapp.schema.rownumbers import RowNumbers
from rigapp.viewer.ranges import nice_step

Floats = NDArray[np.float64]

FOLLOWED = 1000
"""Cycles of the view of the last ones: a quarter of an hour at 60 rpm."""
STEPS = 10
"""Of the axis: it moves so often while it is filled, and not at every cycle."""
WHOLE, LAST, FREE = "whole", "last", "free"


class TrendView:
    """The visible cycles of the trends of a page; ``changed`` are called at every move."""

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
        """Show cycles chosen by hand."""
        self.mode, self._free = FREE, (low, high)
        self._notify()

    def point_at(self, cycle: float | None) -> None:
        """Put the cursor at a cycle; None takes it away."""
        self.cursor = None if cycle is None else float(round(cycle))
        self._notify()

    def start_afresh(self) -> None:
        """Show the whole of another test, without a cursor."""
        self.mode, self.cursor = WHOLE, None
        self._notify()

    def range_of(self, known: Floats | RowNumbers) -> tuple[float, float] | None:
        """Return the cycles to show of the known ones, None where nothing is to be shown yet."""
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
