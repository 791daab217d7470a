"""The arrays of calibrations: readings, forces, residuals; and which of them are meant."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
Marks = NDArray[np.bool_]

ACROSS = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""A row vector times this is turned by a right angle."""
