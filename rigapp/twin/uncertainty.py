"""How uncertain is a force that was predicted from the measured angle? Pure functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.dynamics import MechanismMotion
from rigapp_model.history_uncertainty import MotionUncertainty
from rigapp_model.recurrent_motion import RecurrentMotion

Array = NDArray[np.float64]
Compute = Callable[[Array, Array], MechanismMotion]

COVERAGE_FACTOR = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class PredictionUncertainty:
    """Hold the expanded uncertainty (k = 2, N) of the predicted force at crank angles.

    unfollowed: the largest angular acceleration (rad/s^2) that the angle shows and the prediction
    does not follow; 0 when none stands out of the noise of the angle. lasting: part of the curve
    that is alike in each revolution, and does not average out. recurrent: what comes again
    in each revolution, this one among them.
    """

    curve: Array
    lasting: float
    unfollowed: float
    recurrent: RecurrentMotion

    @property
    def largest(self) -> float:
        """Return the largest of the revolution, N."""
        return float(self.curve.max())


def prediction_uncertainty(
    doubt: MotionUncertainty,
    on_grid: Callable[[Array], Array],
    motion: MechanismMotion,
    compute: Compute,
) -> PredictionUncertainty:
    """Return the uncertainty of the force of a motion that ``compute`` gave.

    doubt: of the angles as they were measured; on_grid: from there to the angles of the motion (one
    revolution evenly), at which ``compute`` takes speed and acceleration.
    """
    speed, acceleration, force = motion.speed, motion.acceleration, motion.force_crank
    faster = compute(speed + on_grid(doubt.speed), acceleration).force_crank - force
    pushed = compute(speed, acceleration + on_grid(doubt.acceleration)).force_crank - force
    step = motion.angle[1] - motion.angle[0]
    angle = on_grid(doubt.angle)
    turned = angle * (np.roll(force, -1, axis=-1) - np.roll(force, 1, axis=-1)) / (2.0 * step)
    parts = np.concatenate([np.asarray(part) for part in (faster, pushed, turned)])
    return PredictionUncertainty(
        COVERAGE_FACTOR * np.sqrt(np.sum(parts**2, axis=0)),
        doubt.lasting,
        doubt.unfollowed,
        doubt.recurrent,
    )
