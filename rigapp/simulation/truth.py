"""Record the plant's true values for end-to-end tests, thinned to bound the memory."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from rigapp.simulation.layout import Array
from rigapp.simulation.plant import Samples

COLUMNS = (
    "sample",
    "time_s",
    "shaft_revolutions",
    "angle_rad",
    "speed_rad_per_s",
    "force_e1_N",
    "force_n1_N",
    "wear_depth_m",
)
_NO_TRUTH = ("sample", "shaft_revolutions")
ROOM = 1 << 20  # rows, 64 MB; then every second row is dropped


class TruthRecorder:
    """Record every n-th sample; at the memory limit drop every second row and double n."""

    def __init__(self, path: Path, stride: int = 4, room: int = ROOM) -> None:
        self._path = path
        self._stride = stride
        self._rows = np.empty((len(COLUMNS), room))
        self._count = 0

    def take(self, samples: Samples) -> None:
        """Record the true values of a chunk."""
        number = samples.first_sample + np.arange(samples.shaft_revolutions.size)
        truth = [getattr(samples.truth, name) for name in COLUMNS if name not in _NO_TRUTH]
        rows = np.vstack([number, truth[0], samples.shaft_revolutions, *truth[1:]])
        block = rows[:, number % self._stride == 0]
        while self._count + block.shape[1] > self._rows.shape[1]:
            self._thin()
            block = block[:, block[0] % self._stride == 0]
        self._rows[:, self._count : self._count + block.shape[1]] = block
        self._count += block.shape[1]

    def arrays(self) -> dict[str, Array]:
        """Return the recorded columns by name."""
        return {name: self._rows[i, : self._count] for i, name in enumerate(COLUMNS)}

    def save(self) -> None:
        """Write the file under a temporary name, then rename it."""
        fresh = self._path.with_name(self._path.name + ".new")
        with fresh.open("wb") as file:
            np.savez(file, allow_pickle=False, **self.arrays())
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(self._path)

    def _thin(self) -> None:
        self._stride *= 2
        kept = self._rows[:, : self._count][:, self._rows[0, : self._count] % self._stride == 0]
        self._count = kept.shape[1]
        self._rows[:, : self._count] = kept
