"""Tell direction and index from the digital lines of scans that the encoder clocks; pure.

A scan stands at a rising edge of encoder line A. Line B is low there when the shaft turns forward
and high when it turns back, where line A rises in the middle between its forward edges. Line Z is
high at one edge of a turn; it must be as long as a whole line, or lie at line A's rising edge.

So the count goes up and down by one with each scan. Where the shaft turns round, no scan tells
whether it did so before or behind the next edge of line A: each time the count may be one off. The
index sets it to 0; nothing else does, so that a missing index shows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]

_PULSES = (1 << 32) - 1


@dataclass(slots=True)
class Sense:
    """Follow direction and index from block to block.

    direction_line, index_line: numbers of the digital lines of B and Z; None: not there.
    """

    direction_line: int | None = None
    index_line: int | None = None
    _count: int = 0
    _pulses: int | None = None
    _index_was_high: bool = False

    def counts(self, lines: Ints, pulses: Ints) -> NDArray[np.int32]:
        """Return the count of each scan.

        lines: (n,) states of the digital lines as bits. pulses: (n,) pulses of line A so far,
        modulo 2**32; those of lost scans count in the direction of the scan behind.
        """
        before = pulses[0] - 1 if self._pulses is None else self._pulses
        steps = np.diff(pulses, prepend=before) & _PULSES
        if self.direction_line is not None:
            steps = np.where(lines >> self.direction_line & 1, -steps, steps)
        count = self._count + np.cumsum(steps)
        if self.index_line is not None:
            count -= self._set_to_zero(count, (lines >> self.index_line & 1).astype(np.bool_))
        self._count, self._pulses = int(count[-1]), int(pulses[-1])
        return count.astype(np.int32)

    def _set_to_zero(self, count: Ints, high: NDArray[np.bool_]) -> Ints:
        """Return what the latest index takes off each count; 0 before the first."""
        before = np.concatenate(([self._index_was_high], high[:-1]))
        self._index_was_high = bool(high[-1])
        place = np.maximum.accumulate(np.where(high & ~before, np.arange(count.size), -1))
        return np.where(place >= 0, count[place], 0)
