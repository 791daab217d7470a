"""Which inputs stay at the end of their range, from the samples that the device flags."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.values.calibrate import Calibration
from rigapp_drivers.api import Block, Quality

AT_THE_END: Final = 0.98
"""A flagged sample belongs to every input whose signal is beyond this share of its range."""

STAYS_S: Final = 0.1
"""An input counts as saturated after so long without a sound sample: a spike is none."""

FLAG: Final = int(Quality.SATURATED)
"""The flag as a plain number: numpy asks an enumeration for its protocols at every use."""

BACK_S: Final = 0.5
"""It counts as sound again after so long without a saturated one."""


class SaturationWatch:
    """Follow the inputs of one connection, block by block."""

    def __init__(self, calibration: Calibration) -> None:
        self._names = calibration.names
        self._stays = max(1, round(STAYS_S * calibration.sample_rate_Hz))
        self._back = max(1, round(BACK_S * calibration.sample_rate_Hz))
        self._full = [0] * len(self._names)
        self._sound = [0] * len(self._names)
        self._calm = True
        self.inputs: frozenset[str] = frozenset()

    def mark(self, inputs: Iterable[str]) -> None:
        """Count inputs as saturated at once."""
        self.inputs |= frozenset(inputs)
        self._calm = False

    def look(self, full: NDArray[np.bool_] | None, samples: int) -> bool:
        """Take a block, ``full_samples`` of it; return whether ``inputs`` has changed."""
        if full is None:
            if self._calm:
                return False
            full = np.zeros((len(self._names), samples), np.bool_)
        for i, row in enumerate(full):
            self._full[i] = _trailing(row, self._full[i])
            self._sound[i] = _trailing(~row, self._sound[i])
        before = self.inputs
        for i, name in enumerate(self._names):
            if self._full[i] >= self._stays:
                self.inputs |= {name}
            elif self._sound[i] >= self._back:
                self.inputs -= {name}
        self._calm = not self.inputs and not any(self._full)
        return self.inputs != before


def full_samples(block: Block, calibration: Calibration) -> NDArray[np.bool_] | None:
    """Return where each input is saturated, (inputs, samples); None where none is flagged."""
    if not np.bitwise_or.reduce(block.quality) & FLAG:
        return None
    share = np.abs(calibration.signals(block.values)) / calibration.ranges[:, None]
    return np.asarray((share >= AT_THE_END) & ((block.quality & FLAG) != 0), np.bool_)


def _trailing(condition: NDArray[np.bool_], before: int) -> int:
    """Return for how many samples up to the last one a condition has held."""
    broken = np.flatnonzero(~condition)
    if broken.size == 0:
        return int(before + condition.size)
    return int(condition.size - 1 - broken[-1])
