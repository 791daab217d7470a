"""Follow a table of a transducer: linear between its points and beyond its ends."""

# mypy: disable-error-code="untyped-decorator"
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp_model.compiled import njit

Array = NDArray[np.float64]


@njit("void(float64[::1], int64, float64[:, ::1])", cache=True, nogil=True, error_model="numpy")
def follow(x: Array, n: int, table: Array) -> None:
    """Replace signals x[:n] by the values of a table (2, points); without points, do nothing.

    Beyond an end the first, or the last, two points go on: a signal somewhat outside of what was
    calibrated is told as what it would be, not as the end of the table.
    """
    points = table.shape[1]
    if points < 2:
        return
    for i in range(n):
        low, high = 0, points - 2
        while low < high:
            middle = (low + high + 1) // 2
            if x[i] >= table[0, middle]:
                low = middle
            else:
                high = middle - 1
        step = table[0, low + 1] - table[0, low]
        slope = (table[1, low + 1] - table[1, low]) / step
        x[i] = table[1, low] + slope * (x[i] - table[0, low])
