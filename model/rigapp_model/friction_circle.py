"""The joint's friction coefficient from the force that a model without friction leaves.

Friction in the joint is a couple M = s rho |F| on the follower about the pin's centre, with
rho = R1 sin(atan mu) the radius of the friction circle and s the sense of sliding. The wrist bears
no couple, so that M appears as M / L across the follower, and not along it, where the slider's mass
and the spring decide. So only the force across the follower shows friction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.errors import require_not_negative

Array = NDArray[np.float64]

COVERAGE_FACTOR = 2.0  # 95 % of a normal distribution
LEAST_COUPLE = 1e-9
"""A lever of friction, N per unit of sin(atan mu), below which there is no force to rub."""
LEAST_NOISE = 1e-12  # N: a model that explains its own forces leaves rounding
ROUNDS = 2  # the first takes all that is not explained for noise, the second what is left
MOST_CORRELATED = 0.98
"""Largest correlation of neighbours that counts: 100 samples are worth one.

More is no noise, but a slow part whose size cannot be determined from a revolution.
"""


@dataclass(frozen=True, slots=True)
class CellDoubt:
    """The standard uncertainty of a component of the measured force: constant + relative |F|.

    constant: N, of the zero in the load cell's own frame; relative: of every element of its matrix,
    which contains its direction on the crank. Both stay the same over a revolution.
    """

    constant: float
    relative: float

    def __post_init__(self) -> None:
        require_not_negative("constant", self.constant, "N")
        require_not_negative("relative", self.relative)


@dataclass(frozen=True, slots=True)
class Friction:
    """A friction coefficient and its expanded uncertainty (k = 2); NaN when not known."""

    coefficient: float = float("nan")
    uncertainty: float = float("nan")


def friction_of(
    measured: Array,
    across: Array,
    turn: Array,
    sense: Array,
    lever: float,
    doubt: CellDoubt,
) -> Friction:
    """Fit the friction coefficient to one revolution.

    measured (2, n): force on the follower by the pin, N, crank frame, at equal steps of the crank;
    across (n,): its component across the follower by the model without friction, N; turn (n,):
    crank angle less follower angle, rad; sense (n,): +1 or -1, of crank speed less follower speed;
    lever: pin radius over follower length. Least squares with the errors of the load cell (its zero
    and its matrix) beside the couple, each with its own uncertainty as prior; the rest counts as
    noise, its correlation from sample to sample included. A cell whose relative uncertainty is
    u leaves about u / lever in the coefficient: its direction on the crank looks like friction.
    """
    s, c = np.sin(turn), np.cos(turn)
    first, second = measured
    couple = sense * np.hypot(first, second) * lever
    if not np.abs(couple).max(initial=0.0) > LEAST_COUPLE:
        return Friction()
    columns = np.stack([couple, s, c, s * first, s * second, c * first, c * second], axis=1)
    wanted = s * first + c * second - across
    held = np.array([np.inf, *[doubt.constant] * 2, *[doubt.relative] * 4])
    free = held > 0.0
    columns, held = columns[:, free], held[free]
    noise = float(wanted.std())
    for _ in range(ROUNDS):  # the remaining noise decides the weight of the cell's own errors
        weight = max(noise, LEAST_NOISE) ** -2.0
        spread = np.linalg.inv(weight * (columns.T @ columns) + np.diag(held**-2.0))
        solution = weight * (spread @ (columns.T @ wanted))
        noise = _correlated(wanted - columns @ solution)
    sine, doubted = float(solution[0]), float(np.sqrt(spread[0, 0]))
    if not abs(sine) < 1.0:
        return Friction()
    cosine = np.sqrt(1.0 - sine * sine)
    return Friction(sine / cosine, COVERAGE_FACTOR * doubted / cosine**3)


def _correlated(rest: Array) -> float:
    """Return the standard deviation of the equivalent uncorrelated noise."""
    centred = rest - rest.mean()
    power = float(centred @ centred)
    near = float(centred @ np.roll(centred, 1)) / power if power > 0.0 else 0.0
    near = min(max(near, 0.0), MOST_CORRELATED)
    return float(np.sqrt(np.mean(rest * rest) * (1.0 + near) / (1.0 - near)))
