"""How far the instruments reach: what a test must keep to, known before any device is opened."""

from __future__ import annotations

import numpy as np

from rigapp.config.rig import RigFile

FEWEST_SAMPLES = 16
"""Samples that a revolution must have at least."""


def load_cell_reach_N(rig: RigFile) -> float:
    """Return the force up to which the load cell's inputs are not full, in any direction."""
    matrix = np.array(rig.load_cell.matrix_N_per_mV_per_V, np.float64)
    zero = np.array(rig.load_cell.zero_mV_per_V, np.float64)
    # A force has the signals inverse(matrix) force: the longest row fills its input first.
    rows = np.linalg.norm(np.linalg.inv(matrix), axis=1)
    return float(np.min((rig.load_cell.range_mV_per_V - np.abs(zero)) / rows))
