"""A quadrature input of a simulated GSV-8: shaft angle in, counts out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp_drivers.gsv8.protocol import CounterMode

HIGHEST_COUNT = (1 << 23) - 1
LOWEST_COUNT = -(1 << 23)
_SPAN = 1 << 24

Counts = NDArray[np.int64]


class QuadratureInput:
    """Count the edges of an encoder with an index.

    counts_per_revolution: edges of A and B, four for each line. At the index the counter takes the
    home value, in both directions; in between it goes on from where it is.
    """

    def __init__(self, counts_per_revolution: int) -> None:
        self.counts_per_revolution = counts_per_revolution
        self.last_count = 0
        self._edge: int | None = None
        self._origin = 0

    def slip(self, counts: int) -> None:
        """Let the counter be wrong by so many counts until the next index."""
        self._origin -= counts

    def clear(self, mode: CounterMode, value: int = 0) -> None:
        """Set the count where the shaft stands now."""
        divisor = 4 // mode.quadrature.counts_per_line
        self._origin = (self._edge or 0) // divisor - value
        self.last_count = value

    def advance(
        self, shaft_revolutions: NDArray[np.float64], mode: CounterMode, home: int, *, index: bool
    ) -> Counts:
        """Return the counts at these unwrapped angles; index: whether its pulses arrive."""
        # The tiny shift keeps an angle that rounding put just below an edge on its right side.
        edges = np.floor(shaft_revolutions * self.counts_per_revolution + 1e-6).astype(np.int64)
        divisor = 4 // mode.quadrature.counts_per_line
        counts = edges // divisor if divisor > 1 else edges.copy()
        if mode.use_index and index:
            counts -= self._origins(edges, divisor, home)
        else:
            counts -= self._origin
        self._edge = int(edges[-1])
        counts = self._limited(counts, mode)
        self.last_count = int(counts[-1])
        return counts

    def _origins(self, edges: Counts, divisor: int, home: int) -> Counts | int:
        """Return the count origin of each sample: it moves where an index pulse was passed."""
        before = np.empty_like(edges)
        before[0] = edges[0] if self._edge is None else self._edge
        before[1:] = edges[:-1]
        turn = self.counts_per_revolution
        last_forward = edges // turn * turn
        last_backward = -(-edges // turn) * turn
        forward = (edges > before) & (last_forward > before)
        backward = (edges < before) & (last_backward < before)
        passed = np.flatnonzero(forward | backward)
        if passed.size == 0:
            return self._origin
        pulses = np.where(forward[passed], last_forward[passed], last_backward[passed])
        origins = np.concatenate(([self._origin], pulses // divisor - home))
        lengths = np.diff(np.concatenate(([0], passed, [edges.size])))
        self._origin = int(origins[-1])
        return np.repeat(origins, lengths)

    def _limited(self, counts: Counts, mode: CounterMode) -> Counts:
        if counts.max() <= HIGHEST_COUNT and counts.min() >= LOWEST_COUNT:
            return counts
        if not mode.saturate:
            return (counts - LOWEST_COUNT) % _SPAN + LOWEST_COUNT
        over = np.maximum.accumulate(np.maximum(counts - HIGHEST_COUNT, 0))
        counts = counts - over
        under = np.maximum.accumulate(np.maximum(LOWEST_COUNT - counts, 0))
        self._origin += int(over[-1]) - int(under[-1])
        return counts + under
