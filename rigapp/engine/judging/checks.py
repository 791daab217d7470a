"""Look at every sample of a block before anything else: the fastest of the interlocks."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.assembler import Values
from rigapp.engine.values.bend import linearised
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.channels import LOAD_CELL
from rigapp_model.compiled import njit

Array = NDArray[np.float64]

_SIGNATURE = (
    "float64({0}[::1], {0}[::1], float64[:, ::1], float64[::1], float64[:, ::1],"
    " float64[:, ::1], float64, float64)"
)


def _peak(
    raw_1: Array,
    raw_2: Array,
    gain: Array,
    bias: Array,
    bend: Array,
    own: Array,
    count: float,
    step: float,
) -> float:
    largest = 0.0
    turn = own.shape[1]
    curved = False
    for j in range(3):
        curved = curved or bend[0, j] != 0.0 or bend[1, j] != 0.0
    for i in range(raw_1.shape[0]):
        x = gain[0, 0] * raw_1[i] + gain[0, 1] * raw_2[i] + bias[0]
        y = gain[1, 0] * raw_1[i] + gain[1, 1] * raw_2[i] + bias[1]
        if curved:
            x, y = linearised(x, y, bend)
        if turn > 0:
            k = math.floor(count + step * i) % turn
            x += own[0, k]
            y += own[1, k]
        square = x * x + y * y
        if not square <= largest:
            if math.isnan(square):
                return square
            largest = square
    return largest


_peak_kernel = njit(
    [_SIGNATURE.format("float32"), _SIGNATURE.format("int32")], cache=True, nogil=True
)(_peak)


NOTHING = np.zeros((2, 0))
"""Of a pin whose weight is not to be taken off."""


class PeakForce:
    """Find the largest joint force of a block, from the samples as they came."""

    def __init__(self, calibration: Calibration) -> None:
        self._rows = [calibration.rows[i] for i in calibration.place(LOAD_CELL)]
        self._gain, self._bias = calibration.force_gain()
        self._bend = calibration.load_cell.bend
        self._own = calibration.own_weight
        self.needs_angle = self._own.size > 0

    def of(self, values: Values, turning: tuple[float, float] | None = None) -> float:
        """Return the largest |F| of a block in N; NaN when a sample is not a number.

        turning: count of the first sample from the index, and counts from one to the next, for what
        the pin weighs; None where they are not known, and the weight stays in the force.
        """
        first, second = self._rows
        own = self._own if turning is not None else NOTHING
        square = _peak_kernel(
            values[first],
            values[second],
            self._gain,
            self._bias,
            self._bend,
            own,
            *(turning or (0.0, 0.0)),
        )
        return math.sqrt(square) if not math.isnan(square) else math.nan
