"""Disturbances of the probes with a known shape: temperature, creep, a slow swing, and steps.

Each is a column over the bins times an amplitude with a standard normal prior:

- temperature: proportional to a sensor's reading relative to the first bin;
- creep: proportional to the logarithm of revolutions, as of polymers and of glued probes
  (W. N. Findley et al., Creep and Relaxation of Nonlinear Viscoelastic Materials, 1976, ch. 2);
- slow swing, as of the temperature of a room: a sine and a cosine of the same period, less their
  values at the first revolution, where the zero is taken;
- step, as of a probe that was touched: 1 from some bin on, with a fraction in the bin in which it
  occurs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CREEP = 1.0e-6
"""Standard uncertainty of the creep, m per unit of ln n: 2.3 um per decade."""
SWING = 0.8e-6
"""Standard uncertainty of sine and cosine each, m: an amplitude of 1.1 um, the effect of 1 to 2 K
on probes and frame."""
STEP = 3.0e-6
"""Standard uncertainty of a step, m."""
WITHIN = float(1.0 / np.sqrt(12.0))
"""Standard deviation of the fraction of a step in its own bin about 1/2: a uniform position."""
WARMTH = 0.7e-6
"""Standard uncertainty of the effect of a kelvin, m: 60 mm of steel between probe and joint."""
COLUMNS = 4
"""Columns of creep, a swing and temperature; each step adds two."""
HEAT = 3
"""Column of temperature."""
NO_PERIOD = 0.0
"""Period without a swing."""
NO_STEPS = np.zeros((0, 2))


@dataclass(frozen=True, slots=True, eq=False)
class Moments:
    """Bins (n,): revolutions before and at the end, and temperature relative to the first bin, K.

    A bin of length 0 is a single revolution. Without a temperature channel warm is 0.
    """

    begin: Array
    end: Array
    warm: Array


def shapes(period: Array, jump: Array, creeps: Array, steps: Array, at: Moments) -> Array:
    """Return the means of all columns over bins, (J, S, n), m: creep, swing or step, heat, steps.

    period (J,): of the swing, revolutions, NO_PERIOD for none; jump (J, 2): first and last
    revolution of a bin with a step instead of a swing, 0 for none; creeps (J,): 1 with creep, else
    0; steps (s, 2): as jump, of steps common to all.
    """
    begin, end = at.begin, at.end
    means = np.zeros((period.size, COLUMNS + 2 * len(steps), end.size))
    means[:, 0] = CREEP * creeps[:, None] * mean_logarithm(begin + 1.0, end)
    frequency = 1.0 / np.where(period > 0.0, period, np.inf)[:, None]
    angle = np.pi * frequency * (begin + end)
    attenuation = np.sinc(frequency * (end - begin))
    means[:, 1] = SWING * (attenuation * np.cos(angle) - 1.0)
    means[:, 2] = SWING * attenuation * np.sin(angle)
    without_swing = period <= 0.0
    means[without_swing, 1:HEAT] = _step(jump[without_swing], begin, end)
    means[:, HEAT] = WARMTH * at.warm
    means[:, COLUMNS:] = _step(steps, begin, end).reshape(-1, end.size)
    return means


def _step(jump: Array, begin: Array, end: Array) -> Array:
    """Return the columns (s, 2, n) of steps in bins (s, 2), 0 where the last revolution is 0."""
    first, last = jump[:, :1], jump[:, 1:]
    inside = (begin < last) & (end > first)
    after = np.where(inside, 0.5, end > last) * (last > 0.0)
    return np.stack([STEP * after, STEP * WITHIN * inside], axis=1)


def mean_logarithm(low: Array, high: Array) -> Array:
    """Return the mean of ln u, u uniform between low and high (n,)."""
    wide = np.maximum(high - low, 1e-6 * high)
    top = low + wide
    return np.asarray((top * np.log(top) - low * np.log(low)) / wide - 1.0)
