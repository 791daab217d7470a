"""Disturbances of the probes that have a shape: creep, a slow swing, and steps.

Each is a column over the bins times an amplitude that is standard normal beforehand:

- temperature moves the probes in proportion to a sensor's reading beside the first bin;
- creep grows with the logarithm of revolutions, as that of polymers and of glued probes does
  (W. N. Findley et al., Creep and Relaxation of Nonlinear Viscoelastic Materials, 1976, ch. 2);
- a slow swing, as the temperature of a room has, is a sine and a cosine of some period, less their
  values at the first revolution, where the zero is taken;
- a step, as that of a probe that was touched, is one from some bin on, with a part of it in the bin
  in which it happened.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CREEP = 1.0e-6
"""Standard uncertainty of the creep, m per unit of ln n: 2.3 um a decade."""
SWING = 0.8e-6
"""Of sine and cosine each, m: an amplitude of 1.1 um, what 1 to 2 K do to probes and frame."""
STEP = 3.0e-6
"""Of a step, m."""
WITHIN = float(1.0 / np.sqrt(12.0))
"""Of the part of a step in its own bin about the half of it: it is anywhere in there."""
WARMTH = 0.7e-6
"""Of what a kelvin moves the readings by, m: 60 mm of steel between probe and joint."""
COLUMNS = 4
"""Of creep, a swing and temperature; each step has two more."""
HEAT = 3
"""Column of temperature."""
NO_PERIOD = 0.0
"""Period of no swing at all."""
NO_STEPS = np.zeros((0, 2))


@dataclass(frozen=True, slots=True, eq=False)
class Moments:
    """Bins (n,): revolutions before and at the end, and temperature beside the first one, K.

    A bin without length is a moment. Without a temperature channel it is 0 everywhere.
    """

    begin: Array
    end: Array
    warm: Array


def shapes(period: Array, jump: Array, creeps: Array, steps: Array, at: Moments) -> Array:
    """Return the means of all columns over bins, (J, S, n), m: creep, swing or step, heat, steps.

    period (J,): of the swing, revolutions, NO_PERIOD for none; jump (J, 2): first and last
    revolution of the bin in which there is a step in its place, 0 for none; creeps (J,): 1 where
    there is creep, else 0; steps (s, 2): as jump, of steps that all have.
    """
    begin, end = at.begin, at.end
    means = np.zeros((period.size, COLUMNS + 2 * len(steps), end.size))
    means[:, 0] = CREEP * creeps[:, None] * mean_logarithm(begin + 1.0, end)
    turned = 1.0 / np.where(period > 0.0, period, np.inf)[:, None]
    angle = np.pi * turned * (begin + end)
    flat = np.sinc(turned * (end - begin))
    means[:, 1] = SWING * (flat * np.cos(angle) - 1.0)
    means[:, 2] = SWING * flat * np.sin(angle)
    still = period <= 0.0
    means[still, 1:HEAT] = _step(jump[still], begin, end)
    means[:, HEAT] = WARMTH * at.warm
    means[:, COLUMNS:] = _step(steps, begin, end).reshape(-1, end.size)
    return means


def _step(jump: Array, begin: Array, end: Array) -> Array:
    """Return the columns (s, 2, n) of steps in bins (s, 2), none where the last revolution is 0."""
    first, last = jump[:, :1], jump[:, 1:]
    inside = (begin < last) & (end > first)
    after = np.where(inside, 0.5, end > last) * (last > 0.0)
    return np.stack([STEP * after, STEP * WITHIN * inside], axis=1)


def mean_logarithm(low: Array, high: Array) -> Array:
    """Return the mean of ln u, u evenly between low and high (n,)."""
    wide = np.maximum(high - low, 1e-6 * high)
    top = low + wide
    return np.asarray((top * np.log(top) - low * np.log(low)) / wide - 1.0)
