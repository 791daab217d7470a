"""The joint's friction coefficient from the force that a frictionless model does not explain.

Friction in the joint is a couple M = s rho |F| on the follower about the pin's centre, with
rho = R1 sin(atan mu) the radius of the friction circle and s the direction of sliding. The wrist
transmits no couple, so M adds M / L to the force across the follower. The force along it is that
of the slider's mass and the spring. So only the force across the follower depends on friction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.errors import require_not_negative

Array = NDArray[np.float64]

COVERAGE_FACTOR = 2.0  # 95 % of a normal distribution
LEAST_COUPLE = 1e-9
"""Friction force, N per unit of sin(atan mu), below which the joint counts as unloaded."""
LEAST_NOISE = 1e-12  # N: residual by rounding where the forces are the model's own
ROUNDS = 2  # the first counts all of the unexplained force as noise, the second the residual
MOST_CORRELATED = 0.98
"""Largest correlation of neighbouring samples that is used: 100 samples then count as one.

More is not noise, but a slow component that one revolution cannot determine.
"""


@dataclass(frozen=True, slots=True)
class CellDoubt:
    """Standard uncertainty of a component of the measured force: constant + relative |F|.

    constant: N, of the zero in the load cell's frame; relative: of each element of its matrix,
    which includes its direction on the crank. Both are constant over a revolution.
    """

    constant: float
    relative: float

    def __post_init__(self) -> None:
        require_not_negative("constant", self.constant, "N")
        require_not_negative("relative", self.relative)


@dataclass(frozen=True, slots=True)
class Friction:
    """Friction coefficient and its expanded uncertainty (k = 2); NaN if unknown."""

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
    across (n,): its component across the follower in the frictionless model, N; turn (n,):
    crank angle less follower angle, rad; sense (n,): sign of crank speed less follower speed;
    lever: pin radius over follower length. Least squares for the couple and the errors of the load
    cell (zero and matrix), each with its uncertainty as prior; the residual counts as noise,
    including its correlation from sample to sample. A relative uncertainty u of the cell causes
    about u / lever in the coefficient: its direction on the crank has the same effect as friction.
    """
    s, c = np.sin(turn), np.cos(turn)
    first, second = measured
    couple = sense * np.hypot(first, second) * lever
    if not np.abs(couple).max(initial=0.0) > LEAST_COUPLE:
        return Friction()
    columns = np.stack([couple, s, c, s * first, s * second, c * first, c * second], axis=1)
    target = s * first + c * second - across
    prior = np.array([np.inf, *[doubt.constant] * 2, *[doubt.relative] * 4])
    uncertain = prior > 0.0
    columns, prior = columns[:, uncertain], prior[uncertain]
    noise = float(target.std())
    for _ in range(ROUNDS):  # the residual noise sets the weight of the cell's errors
        weight = max(noise, LEAST_NOISE) ** -2.0
        covariance = np.linalg.inv(weight * (columns.T @ columns) + np.diag(prior**-2.0))
        solution = weight * (covariance @ (columns.T @ target))
        noise = _equivalent_noise(target - columns @ solution)
    sine, sine_error = float(solution[0]), float(np.sqrt(covariance[0, 0]))
    if not abs(sine) < 1.0:
        return Friction()
    cosine = np.sqrt(1.0 - sine * sine)
    return Friction(sine / cosine, COVERAGE_FACTOR * sine_error / cosine**3)


def _equivalent_noise(residual: Array) -> float:
    """Return the standard deviation of the equivalent uncorrelated noise."""
    centred = residual - residual.mean()
    power = float(centred @ centred)
    correlation = float(centred @ np.roll(centred, 1)) / power if power > 0.0 else 0.0
    correlation = min(max(correlation, 0.0), MOST_CORRELATED)
    return float(np.sqrt(np.mean(residual * residual) * (1.0 + correlation) / (1.0 - correlation)))
