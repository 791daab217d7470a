"""Array types of calibrations: readings, forces, residuals, and masks that select them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Whole = NDArray[np.int64]
Marks = NDArray[np.bool_]

ACROSS = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""Rotates a row vector by a right angle when multiplied from the right."""
