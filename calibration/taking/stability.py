"""Is a reading steady? Spread and slope of the last seconds, against what the cell can tell."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from calibration.arrays import Array

FEWEST_SAMPLES = 20
"""Means of 50 ms over a second: spread and slope are then known within some 15 %."""


@dataclass(frozen=True, slots=True)
class Steadiness:
    """The judgement of one window: mean (2,), spread and slope."""

    steady: bool
    reason: str
    mean: Array
    spread: float
    slope: float


def judge(
    time: ArrayLike, signal: ArrayLike, spread_limit: float, slope_limit: float
) -> Steadiness:
    """Judge a window of signals (n, 2) at times (s).

    spread_limit: largest standard deviation about a straight line; slope_limit: largest change a
    second; both in signal units. A swinging weight fails by its spread, a creeping or still moving
    one by its slope.
    """
    t = np.asarray(time, dtype=np.float64)
    values = np.asarray(signal, dtype=np.float64)
    if len(t) < FEWEST_SAMPLES or t[-1] <= t[0]:
        return Steadiness(False, "waiting for samples", np.full(2, np.nan), np.inf, np.inf)
    mean = values.mean(axis=0)
    centred = t - t.mean()
    slopes = centred @ (values - mean) / float(centred @ centred)
    rest = values - mean - centred[:, None] * slopes
    spread = float(rest.std(axis=0, ddof=2).max())
    slope = float(np.abs(slopes).max())
    slope_noise = spread / np.sqrt(float(centred @ centred))
    if not np.isfinite(values).all():
        return Steadiness(False, "the signal is not a number", mean, spread, slope)
    if spread > spread_limit:
        return Steadiness(False, "swinging: wait until it hangs still", mean, spread, slope)
    if slope > slope_limit + 3.0 * slope_noise:
        return Steadiness(False, "still changing", mean, spread, slope)
    return Steadiness(True, "steady", mean, spread, slope)
