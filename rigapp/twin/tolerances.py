"""The tolerances of a healthy rig against its parameter file, and their effects.

One list for the band within which a healthy rig agrees, and for the causes of a deviation.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rigapp.twin.predict import GRID
from rigapp_model.dynamics import MechanismMotion
from rigapp_model.friction_circle import CellDoubt
from rigapp_model.parameters import Joint, Mechanism, Parameters, Spring
from rigapp_model.wear.techniques import solve_of

Array = NDArray[np.float64]

MASS, STIFFNESS = 0.01, 0.01
"""Relative standard tolerances: parts are weighed with screws and cables on or off; springs of a
catalogue are within 2 %."""
SPRING_PLACE = 5e-4
"""Standard uncertainty of the spring's free position, m: set with a rule."""
FRICTION = 0.05
"""Standard uncertainty of the friction coefficient: polymers on steel have 0.05 to 0.25, and few
parameter files state it."""
CLEARANCE = 50e-6
"""Standard tolerance of the bushing's radius, m: a turned polymer."""
INDEX = math.radians(0.1)
"""Standard uncertainty of the crank angle at the encoder's index, rad, if it was set with care."""
LATENCY_S = 2e-4
"""Standard uncertainty of the stated latency: a fifth of a usual filter's delay."""
UNSTATED_CELL = CellDoubt(0.3, 0.01)
"""A load cell without a record: a data sheet's sensitivity and cross-talk are within 2 %."""
GUIDE_N = 0.3
"""Standard friction of the slider's guide, N, which the model lacks: friction of ball guides is
0.5 % of their load."""
CELL_TURN = math.radians(0.05)
"""Standard uncertainty of the load cell's direction on the crank, rad, by its calibration."""
SAME_SPEED = 0.01
"""Relative change of the mean speed up to which revolutions count as similar."""

Change = Callable[[Parameters], Parameters | None]


@dataclass(frozen=True, slots=True)
class Tolerance:
    """The tolerance of a parameter, in the unit that ``DEVIATIONS`` has for its name.

    vary: returns the parameters with a given error of it, None if the part is missing.
    """

    name: str
    standard: float
    vary: Change

    def off_by(
        self, parameters: Parameters, joint: str, motion: MechanismMotion, depth: float
    ) -> Array | None:
        """Return its change of the force, (2, GRID), N, crank frame; None for none."""
        changed = self.vary(parameters)
        if changed is None:
            return None
        solve = solve_of(joint)
        force = solve(changed, GRID, motion.speed, motion.acceleration, depth)[0].force_crank
        return np.asarray(force - motion.force_crank)


def _mechanism(change: Callable[[Mechanism], Mechanism | None]) -> Change:
    def vary(parameters: Parameters) -> Parameters | None:
        changed = change(parameters.mechanism)
        return None if changed is None else replace(parameters, mechanism=changed)

    return vary


def _spring(change: Callable[[Spring], Spring]) -> Change:
    def vary(mechanism: Mechanism) -> Mechanism | None:
        spring = mechanism.spring
        return None if spring is None else replace(mechanism, spring=change(spring))

    return _mechanism(vary)


def _joint(change: Callable[[Joint], Joint]) -> Change:
    return lambda parameters: replace(parameters, joint=change(parameters.joint))


def _clearance(joint: Joint) -> Joint:
    outer = max(joint.bushing_outer_radius, joint.bushing_radius + 2.0 * CLEARANCE)
    radius = joint.bushing_radius + CLEARANCE
    return replace(joint, bushing_radius=radius, bushing_outer_radius=outer)


TOLERANCES = (
    Tolerance(
        "slider mass",
        100.0 * MASS,
        _mechanism(lambda m: replace(m, slider_mass=(1.0 + MASS) * m.slider_mass)),
    ),
    Tolerance(
        "follower mass",
        100.0 * MASS,
        _mechanism(lambda m: replace(m, follower_mass=(1.0 + MASS) * m.follower_mass)),
    ),
    Tolerance(
        "spring stiffness",
        100.0 * STIFFNESS,
        _spring(lambda spring: replace(spring, stiffness=(1.0 + STIFFNESS) * spring.stiffness)),
    ),
    Tolerance(
        "free position of the spring",
        1e3 * SPRING_PLACE,
        _spring(lambda spring: replace(spring, free_position=spring.free_position + SPRING_PLACE)),
    ),
    Tolerance(
        "friction coefficient",
        FRICTION,
        _joint(lambda j: replace(j, friction_coefficient=j.friction_coefficient + FRICTION)),
    ),
    Tolerance("clearance", 1e6 * CLEARANCE, _joint(_clearance)),
)
"""The parameters of the file with their standard tolerances."""


def slope(curve: Array) -> Array:
    """Return the derivative of curves (..., GRID) by the crank angle, per rad."""
    step = 2.0 * (GRID[1] - GRID[0])
    return np.asarray((np.roll(curve, -1, axis=-1) - np.roll(curve, 1, axis=-1)) / step)
