"""How uncertain is a force that was predicted from the measured angle? Pure functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from model.dynamics import MechanismMotion
from model.history import AngleHistory
from model.history_uncertainty import motion_uncertainty

Array = NDArray[np.float64]
Compute = Callable[[Array, Array], MechanismMotion]

COVERAGE_FACTOR = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class PredictionUncertainty:
    """Hold the expanded uncertainty (k = 2, N) of the predicted force at crank angles.

    unfollowed: the largest angular acceleration (rad/s^2) that the angle shows and the prediction
    does not follow; 0 when none stands out of the noise of the angle.
    """

    curve: Array
    unfollowed: float

    @property
    def largest(self) -> float:
        """Return the largest of the revolution, N."""
        return float(self.curve.max())


def prediction_uncertainty(
    time: Array,
    angle: Array,
    history: AngleHistory,
    grid: Array,
    compute: Compute,
) -> PredictionUncertainty:
    """Return the uncertainty of the force that ``compute`` gives of speed and acceleration.

    time (s), angle (rad): as measured; history: what was fitted to them; grid: the crank angles
    (rad, one revolution evenly) at which ``compute`` takes speed and acceleration.
    """
    doubt = motion_uncertainty(time, angle, history)

    def at_grid(values: Array) -> Array:
        return np.asarray(np.interp(grid, angle, values, period=2.0 * np.pi), dtype=np.float64)

    speed, acceleration = at_grid(history.speed), at_grid(history.acceleration)
    force = compute(speed, acceleration).force_crank
    faster = compute(speed + at_grid(doubt.speed), acceleration).force_crank - force
    pushed = compute(speed, acceleration + at_grid(doubt.acceleration)).force_crank - force
    step = grid[1] - grid[0]
    turned = doubt.angle * (np.roll(force, -1, axis=-1) - np.roll(force, 1, axis=-1)) / (2.0 * step)
    parts = np.concatenate([np.asarray(part) for part in (faster, pushed, turned)])
    return PredictionUncertainty(
        COVERAGE_FACTOR * np.sqrt(np.sum(parts**2, axis=0)), doubt.unfollowed
    )
