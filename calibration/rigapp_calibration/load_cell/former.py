"""The fit of records of the evaluations 1 and 2: one zero of all series, and its drift.

Kept so that these records still follow from their own readings; nothing new is fitted so.
"""

from __future__ import annotations

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.two_axis import Terms, TwoAxisFit, better_by, design, enough, fit


def common_zero_fit(force: Array, signal: Array, drift: bool | None = None) -> TwoAxisFit:
    """Return the fit with the terms that the readings justify; drift: None leaves it to them."""
    if drift is None:
        drift = _supported(force, Terms(drift=True))
    chosen = fit(force, signal, Terms(drift=drift))
    curved = Terms(quadratic=True, drift=drift)
    if _supported(force, curved):
        larger = fit(force, signal, curved)
        if better_by(chosen, larger) > 0.0:
            return larger
    return chosen


def _supported(force: Array, terms: Terms) -> bool:
    rows = design(force, terms)
    size = float(np.max(np.abs(force)))
    if terms.quadratic and np.max(np.abs(rows[:, 4])) < 0.02 * size * size:
        return False
    scaled = rows / np.maximum(np.abs(rows).max(axis=0), 1e-300)
    return enough(force, terms) and bool(np.linalg.cond(scaled) < 1e4)
