"""The one cause that explains why a rig differs from its model by more than its tolerances.

The mean of measured minus predicted, both components against the crank angle, contains the effect
of each tolerance, the errors of the load cell, and noise. Under this
covariance the amplitude of each cause is estimated; one whose amplitude is beyond its limits (by
Baarda's test of outliers for this number of causes) explains the difference. The clearance hardly
changes a force: it follows from the position of the pin in the new bushing.
"""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass, field

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.special import ndtri

from rigapp.schema.deviations import (
    CLEARANCE_CAUSE,
    DEVIATIONS,
    NO_CAUSE,
    deviation_sentence,
)
from rigapp.texts import say
from rigapp.twin.pinpath import Reference
from rigapp.twin.predict import COVERAGE_FACTOR, GRID
from rigapp.twin.tolerances import (
    CELL_TURN,
    CLEARANCE,
    GUIDE_N,
    INDEX,
    LATENCY_S,
    SAME_SPEED,
    TOLERANCES,
    UNSTATED_CELL,
    slope,
)
from rigapp_model.dynamics import MechanismMotion
from rigapp_model.friction_circle import CellDoubt
from rigapp_model.parameters import Parameters

Array = NDArray[np.float64]

log = logging.getLogger(__name__)

POINTS = 120
"""Parts of the revolution whose means are compared; three of ``GRID``."""
AVERAGED = 20.0
"""Number of revolutions over which the difference is averaged."""
EACH = 10
"""Number of revolutions between two searches for a cause."""
FALSE_ALARM = 0.01
"""Probability that a healthy rig is reported to differ, over all causes."""
LIMIT = float(-ndtri(0.5 * FALSE_ALARM / (len(DEVIATIONS) - 1)))
NEARLY = 4.0
"""Difference of squared scores up to which another cause explains nearly as much: odds of 7."""
ALIKE_RAD = math.radians(12.0)
"""Correlation length of the unmodelled force, by crank angle."""
UNMODELLED_N = 0.1
"""Standard size of the unmodelled force where none is seen, N."""
HIDDEN_N = 2.0
"""An uncertainty by the angle of this size, standard, N, hides a fault of 2 N."""
HANGING_N = 0.2
"""Standard uncertainty of the weight outboard of the load cell's gauges, N: 20 g."""
UPWARD = np.array([0.0, 1.0])
"""Away from the weight where the parameter file has no gravity in the plane."""
LEAN = 0.1
"""More than this (rad) between the new pin and the force: the probes' zero is elsewhere."""
PLACE_DOUBT = 20e-6
"""Standard uncertainty of a probe's zero that was set at the bushing's centre, m."""


@dataclass(frozen=True, slots=True)
class Deviation:
    """The cause of a difference: a name of ``DEVIATIONS``, value and U (k = 2) in its unit.

    score: how far that is beyond tolerances and chance, in standard deviations.
    alternative: another cause that explains it nearly as well.
    """

    name: str = NO_CAUSE
    value: float = math.nan
    uncertainty: float = math.nan
    score: float = 0.0
    alternative: str = NO_CAUSE

    @property
    def columns(self) -> dict[str, float]:
        """Return the columns of a revolution."""
        places = {str(name): float(index) for index, name in enumerate(DEVIATIONS)}
        return {
            "deviation_cause": places[self.name],
            "deviation": self.value,
            "deviation_uncertainty": self.uncertainty,
            "deviation_alternative": places[self.alternative],
        }


class DeviationRecord(msgspec.Struct, frozen=True):
    """The state of the average: (2, POINTS) as bytes, float64, N."""

    speed: float
    seen: int
    mean: bytes
    noise: float
    reported: tuple[str, float, float, float, str] = msgspec.field(name="told")


@dataclass(slots=True)
class DeviationWatch:
    """Average measured minus predicted force, and find its cause.

    cell: uncertainty of the load cell, None where none is stated.
    """

    parameters: Parameters
    joint: str
    cell: CellDoubt | None = None
    reported: Deviation = field(default_factory=Deviation)
    _speed: float = math.nan
    _seen: int = 0
    _mean: Array = field(default_factory=lambda: np.zeros((2, POINTS)))
    _noise: float = 0.0

    def packed(self) -> DeviationRecord:
        """Return the state."""
        last = self.reported
        mean = self._mean.astype("<f8").tobytes()
        words = last.name, last.value, last.uncertainty, last.score, last.alternative
        return DeviationRecord(self._speed, self._seen, mean, self._noise, words)

    def restore(self, record: DeviationRecord) -> None:
        """Continue from the state of another one."""
        self._speed, self._seen, self._noise = record.speed, record.seen, record.noise
        self._mean = np.frombuffer(record.mean, dtype="<f8").reshape(2, POINTS).copy()
        self.reported = Deviation(*record.reported)

    def take(
        self, force: Array, motion: MechanismMotion, left_open: Array, depth: float,
        reference: Reference | None,
    ) -> Deviation:  # fmt: skip
        """Take a revolution and return the cause of the difference so far.

        force (2, GRID): measured, N, crank frame; left_open (GRID,): standard, N, by the measured
        angle, alike in each revolution; depth: of the predicted wear, m; reference: of the new
        bushing, once it is known.
        """
        speed = float(np.mean(motion.speed))
        if not abs(speed - self._speed) <= SAME_SPEED * abs(speed):
            self._speed, self._seen, self._noise = speed, 0, 0.0
        off = _means(force - motion.force_crank)
        self._seen += 1
        share = max(1.0 / self._seen, 1.0 / AVERAGED)
        step = off - self._mean if self._seen > 1 else off
        if self._seen == 1:
            self._mean = off
        else:
            self._noise += share * (float(np.mean(step**2)) * (1.0 - share) - self._noise)
            self._mean = self._mean + share * step
        if self._seen % EACH == 0:
            candidates = [of_clearance(reference)]
            if float(np.sqrt(np.mean(left_open**2))) < HIDDEN_N:
                candidates.append(self._by_force(motion, left_open, depth))
            before = self.reported
            self.reported = max(candidates, key=lambda cause: abs(cause.score))
            if self.reported.name not in (before.name, NO_CAUSE):
                sentence = deviation_sentence(*self.reported.columns.values())
                log.warning(say("Measurement and model differ {}.", sentence))
        return self.reported

    def _by_force(self, motion: MechanismMotion, left_open: Array, depth: float) -> Deviation:
        cell = self.cell or UNSTATED_CELL
        names, standards, columns = _causes(
            self.parameters, self.joint, motion, depth, cell.relative
        )
        held = _cell_columns(np.asarray(motion.force_crank), cell)
        every = np.concatenate([columns, held])
        wanted = self._mean.ravel()
        chance = self._noise * max(1.0 / self._seen, 1.0 / AVERAGED)
        left = wanted - every.T @ np.linalg.lstsq(every.T, wanted, rcond=None)[0]
        size = max(float(np.mean(left**2)) - chance, UNMODELLED_N**2)
        spread = np.sqrt(size + _means(left_open[np.newaxis])[0] ** 2)
        near = _alike(spread)
        covariance = np.kron(np.eye(2), near) + chance * np.eye(2 * POINTS) + every.T @ every
        factor = cho_factor(covariance)
        solved = cho_solve(factor, columns.T)
        precision = np.sum(columns.T * solved, axis=0)
        amplitude = (wanted @ solved) / precision
        score = amplitude * np.sqrt(precision)
        strongest = int(np.argmax(np.abs(score)))
        if abs(score[strongest]) < LIMIT:
            return Deviation()
        second = int(np.argsort(np.abs(score))[-2])
        near_by = score[strongest] ** 2 - score[second] ** 2 < NEARLY
        # Its own tolerance is in the covariance, but no part of the uncertainty of its value.
        doubt = math.sqrt(max(1.0 / precision[strongest] - 1.0, 0.0))
        unit = standards[strongest]
        return Deviation(
            names[strongest],
            float(unit * amplitude[strongest]),
            COVERAGE_FACTOR * unit * doubt,
            float(score[strongest]),
            names[second] if near_by else NO_CAUSE,
        )


def of_clearance(reference: Reference | None) -> Deviation:
    """Return the deviation of the clearance by the pin's position in the new bushing.

    Where the probes' zero is the bushing's centre, the new pin lies the clearance away from it, in
    the direction of the force; beyond it where the clearance is larger.
    """
    if reference is None or not abs(reference.lean) < LEAN:
        return Deviation()
    doubt = math.hypot(reference.radial, PLACE_DOUBT)
    score = reference.beyond / math.hypot(CLEARANCE, doubt)
    if abs(score) < LIMIT:
        return Deviation()
    return Deviation(CLEARANCE_CAUSE, 1e6 * reference.beyond, 1e6 * COVERAGE_FACTOR * doubt, score)


def _causes(
    parameters: Parameters, joint: str, motion: MechanismMotion, depth: float, gain: float
) -> tuple[list[str], list[float], Array]:
    """Return names, standard tolerances and their effects, (causes, 2 POINTS), N."""
    causes: list[tuple[str, float, Array]] = []
    for tolerance in TOLERANCES:
        change = tolerance.off_by(parameters, joint, motion, depth)
        if change is not None and tolerance.name != CLEARANCE_CAUSE:
            causes.append((tolerance.name, tolerance.standard, change))
    force = np.asarray(motion.force_crank)
    along = np.sign(motion.slider_velocity) * GUIDE_N
    across = along * np.tan(motion.follower_angle)
    c, s = np.cos(GRID), np.sin(GRID)
    guide = np.stack([c * along + s * across, c * across - s * along])
    causes.append(("friction of the slider's guide", GUIDE_N, guide))
    turn = math.hypot(INDEX, LATENCY_S * float(np.mean(motion.speed)))
    causes.append(("crank angle at the index", math.degrees(turn), turn * slope(force)))
    causes.append(("gain of the load cell", 100.0 * gain, gain * force))
    down = np.array(parameters.mechanism.gravity)
    x, y = -down / np.hypot(*down) if down.any() else UPWARD
    weight = HANGING_N * np.stack([x * c + y * s, y * c - x * s])
    causes.append(("weight of the pin at the load cell", HANGING_N, weight))
    names, standards, changes = zip(*causes, strict=True)
    return list(names), list(standards), np.stack([_means(change).ravel() for change in changes])


def _cell_columns(force: Array, cell: CellDoubt) -> Array:
    """Return the errors of the cell except its gain, (columns, 2 POINTS), N.

    Its zero, a difference of gains, cross-talk, and a turn on the crank.
    """
    first, second = force
    ones, zeros = np.ones(GRID.size), np.zeros(GRID.size)
    share, zero = cell.relative, cell.constant
    changes = (
        (zero * ones, zeros),
        (zeros, zero * ones),
        (share * first, -share * second),
        (share * second, share * first),
        (CELL_TURN * second, -CELL_TURN * first),
    )
    return np.stack([_means(np.stack(change)).ravel() for change in changes])


def _means(curves: Array) -> Array:
    """Return the means (..., POINTS) of curves (..., GRID) over its parts."""
    return np.asarray(curves.reshape(*curves.shape[:-1], POINTS, -1).mean(axis=-1))


def _alike(spread: Array) -> Array:
    """Return the covariance (POINTS, POINTS) of errors correlated along the angle."""
    angle = np.arange(POINTS) * (2.0 * math.pi / POINTS)
    chord = 2.0 * np.sin(0.5 * (angle[:, None] - angle[None, :]))
    return np.asarray(np.outer(spread, spread) * np.exp(-0.5 * (chord / ALIKE_RAD) ** 2))
