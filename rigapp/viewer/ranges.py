"""Steady axis ranges: 1-2-5 steps with hysteresis instead of automatic ranging."""

from __future__ import annotations

import math


def nice_step(span: float, parts: int = 5) -> float:
    """Return the smallest 1, 2 or 5 times a power of ten of which ``parts`` cover ``span``."""
    if not math.isfinite(span) or span <= 0.0:
        return 1.0
    raw = span / parts
    power = 10.0 ** math.floor(math.log10(raw))
    for factor in (1.0, 2.0, 5.0, 10.0):
        if factor * power >= raw * (1.0 - 1e-9):
            return factor * power
    return 10.0 * power


def round_places(low: float, high: float, parts: int, least: int = 3) -> tuple[float, list[float]]:
    """Return the distance of round values from low to high, and them: about ``parts`` + 1.

    There are at least ``least`` of them, also where that takes more parts.
    """
    while True:
        step = nice_step(high - low, parts)
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        if last - first + 1 >= least:
            return step, [step * number for number in range(first, last + 1)]
        parts += 1


FILLED_LEAST = 0.45
"""Part of an axis: a range filled less by the data shrinks to the next step below."""
SPARE, SPARE_BOTH = 1.02, 1.06
"""Margin beyond the largest value, on one side and on both: a line does not lie on the edge."""


class SteadyRange:
    """An axis range: grows at once, shrinks only when the data fill less than 45 % of it.

    minimum_span: the smallest range shown, so that noise is not enlarged to the full height.
    symmetric: keep zero in the middle (residuals).
    """

    def __init__(self, minimum_span: float, *, symmetric: bool = False) -> None:
        self._minimum_span = minimum_span
        self._symmetric = symmetric
        self._range: tuple[float, float] | None = None

    @property
    def range(self) -> tuple[float, float] | None:
        """Return the present range, None before the first data."""
        return self._range

    def update(self, low: float, high: float) -> bool:
        """Take the extremes of the data; return whether the range changed."""
        if not (math.isfinite(low) and math.isfinite(high)):
            return False
        wanted = self._wanted(low, high)
        if self._range is not None:
            bottom, top = self._range
            inside = bottom <= low and high <= top
            if inside and (wanted[1] - wanted[0]) >= FILLED_LEAST * (top - bottom):
                return False
        changed = wanted != self._range
        self._range = wanted
        return changed

    def forget(self) -> None:
        """Start again: the next data set the range."""
        self._range = None

    def _wanted(self, low: float, high: float) -> tuple[float, float]:
        if self._symmetric:
            bound = max(abs(low), abs(high), self._minimum_span / 2.0)
            step = nice_step(bound, 4)
            top = step * math.ceil(bound * SPARE / step)
            return -top, top
        span = max(high - low, self._minimum_span)
        middle = (low + high) / 2.0
        step = nice_step(span * SPARE_BOTH)
        bottom = step * math.floor(min(low, middle - span / 2.0) / step)
        top = step * math.ceil(max(high, middle + span / 2.0) / step)
        return bottom, top
