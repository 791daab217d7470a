"""The twin: predicts each revolution and lets two bushings wear beside the real one.

One is worn by the forces that the model predicts, from the first cycle on and by nothing measured;
the other by the forces that the load cell measures. The real one is seen by the probes.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from model.dynamics import Motion
from model.errors import ModelError
from model.frames import into_frame
from model.parameters import Parameters
from model.wear.state import WearState, unworn_state
from rigapp.engine.messages import Prediction
from rigapp.twin.predict import GRID, Measured, Wear, compare, measured_force, predict_motion

Array = NDArray[np.float64]

STEP_SHARE = 0.02
"""A bushing is worn on once this share of the cycles so far has come together."""
CATCH_UP_STEPS = 12
NEW_REVOLUTIONS = 5
FIRST_STEADY = 3
"""The pin's position in the new bushing is the mean of so many revolutions from this one on."""

log = logging.getLogger(__name__)


@dataclass(slots=True)
class Bushing:
    """A bushing that wears with the test, by cycles gathered into steps."""

    state: WearState | None = None
    failed: str = ""

    def wear_to(self, cycles: float, force: Array, slip: Array, parameters: Parameters) -> None:
        """Wear on to a number of cycles when enough have come together; force: follower frame."""
        if self.failed:
            return
        try:
            if self.state is None:
                largest = float(np.hypot(*force).max())
                self.state = unworn_state(parameters, max(largest, 1e-3))
            pending = cycles - self.state.cycles
            if pending >= max(1.0, STEP_SHARE * self.state.cycles):
                self.state = _advanced(self.state, force, slip, cycles)
        except (ModelError, ValueError, ArithmeticError) as error:
            self.failed = str(error)
            log.warning("The twin's bushing is not worn on: %s", error)

    @property
    def depth(self) -> float:
        """Return the depth at the contact point, m; NaN when the model cannot tell."""
        if self.failed:
            return float("nan")
        return self.state.depth_at_contact if self.state is not None else 0.0


def _advanced(state: WearState, force: Array, slip: Array, cycles: float) -> WearState:
    """Wear on to so many cycles; a long way (a resumed test) in growing steps."""
    start = state.cycles
    if cycles - start <= max(10.0, 2.0 * STEP_SHARE * start):
        return state.advance(force, slip, cycles - start)
    stops = np.geomspace(max(start, 1.0), cycles, CATCH_UP_STEPS + 1)[1:]
    for stop in stops:
        if stop > state.cycles:
            state = state.advance(force, slip, float(stop - state.cycles))
    return state


@dataclass(slots=True)
class Twin:
    """Predict revolutions in the order in which they come; gaps in the numbers count as worn."""

    parameters: Parameters
    joint: str
    new_position_um: tuple[float, float] | None = None
    predicted: Bushing = field(default_factory=Bushing)
    driven: Bushing = field(default_factory=Bushing)
    _first_positions: list[tuple[float, float]] = field(default_factory=list)

    def predict(self, measured: Measured) -> Prediction:
        """Predict a revolution, wear the bushings on, compare."""
        depth = self.predicted.depth
        motion = predict_motion(
            self.parameters, self.joint, measured, 0.0 if np.isnan(depth) else depth
        )
        slip = motion.slip_increments(self.parameters.joint.pin_radius)
        cycles = float(measured.revolution)
        self.predicted.wear_to(cycles, motion.force_follower, slip, self.parameters)
        self.driven.wear_to(cycles, _in_follower(measured, motion), slip, self.parameters)
        wear = Wear(self.predicted.depth, self.driven.depth, self._measured_depth(measured))
        return compare(measured, motion, wear)

    def _measured_depth(self, measured: Measured) -> float:
        """Return by how much the pin has moved out of the middle since the bushing was new, m.

        The mean over a revolution leaves out the pin's run-out, which turns once a revolution.
        """
        position = (float(measured.probe_1.mean()), float(measured.probe_2.mean()))
        if self.new_position_um is not None:
            new = 1e-6 * np.array(self.new_position_um)
        else:
            if FIRST_STEADY <= measured.revolution < FIRST_STEADY + NEW_REVOLUTIONS:
                self._first_positions.append(position)
            if len(self._first_positions) < NEW_REVOLUTIONS:
                return float("nan")
            new = np.mean(self._first_positions, axis=0)
        return float(np.hypot(*position) - np.hypot(*new))


def _in_follower(measured: Measured, motion: Motion) -> Array:
    """Turn the measured force from the crank frame into the follower's at ``GRID``."""
    turn = motion.follower_angle - GRID
    return np.asarray(
        into_frame(measured_force(measured), np.cos(turn), np.sin(turn)), dtype=np.float64
    )
