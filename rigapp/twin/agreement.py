"""Band of measured minus predicted within which a healthy rig agrees with its prediction.

The band contains the uncertainty of the angle, the tolerances of the mechanism, the joint's
friction, the index, the latency, the load cell, and the noise of the mean over a bin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import AGREEMENT_BIN_DEG
from rigapp.twin.predict import COVERAGE_FACTOR, GRID, MeasuredRevolution, PredictionUncertainty
from rigapp.twin.tolerances import (
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

SAME_DEPTH = 20e-6
"""Change of the wear, m, up to which tolerances have the same effect."""
REMEMBERED = 10.0
"""Revolutions over which the part by the angle is averaged: in a single one it is random."""
UNLIKE = 8.0
"""Ratio of variances from which a revolution differs from earlier ones: calmer after a run-up, or
with a jerk of the crank. Chance alone makes it 4."""


class BandRecord(msgspec.Struct, frozen=True):
    """The state of a band: variances as bytes (float64, N^2), empty where there are none."""

    speed: float
    depth: float
    seen: int
    tolerance: bytes
    left_open: bytes


@dataclass(slots=True)
class AgreementBand:
    """The band of a revolution, (GRID,), expanded (k = 2), N, averaged over similar ones.

    cell: uncertainty of the load cell, None where none is stated.
    """

    parameters: Parameters
    joint: str
    cell: CellDoubt | None = None
    _speed: float = math.nan
    _depth: float = math.nan
    _tolerance: Array | None = None
    _open: Array | None = None
    _seen: int = 0
    _now: Array = field(default_factory=lambda: np.full(GRID.size, np.nan))

    @property
    def left_open(self) -> Array:
        """Return the part by the angle, averaged, (GRID,), expanded (k = 2), N."""
        return np.asarray(COVERAGE_FACTOR * np.sqrt(self._now))

    def packed(self) -> BandRecord:
        """Return the state."""
        memory = _bytes(self._tolerance), _bytes(self._open)
        return BandRecord(self._speed, self._depth, self._seen, *memory)

    def restore(self, record: BandRecord) -> None:
        """Continue from the state of another one."""
        self._speed, self._depth, self._seen = record.speed, record.depth, record.seen
        self._tolerance, self._open = _array(record.tolerance), _array(record.left_open)

    def band(
        self,
        measured: MeasuredRevolution,
        motion: MechanismMotion,
        doubt: PredictionUncertainty,
        depth: float,
    ) -> Array:
        """Return the band of a revolution with its prediction, for a bushing worn by depth, m."""
        speed = float(np.mean(motion.speed))
        if not abs(speed - self._speed) <= SAME_SPEED * abs(speed):
            self._open, self._tolerance, self._seen = None, None, 0
        if self._tolerance is None or not abs(depth - self._depth) <= SAME_DEPTH:
            self._tolerance = sum(
                (part**2 for part in _tolerances(self.parameters, self.joint, motion, depth)),
                start=np.zeros(GRID.size),
            )
            self._depth = depth
        self._speed = speed
        left = (doubt.curve / COVERAGE_FACTOR) ** 2
        if self._open is not None and UNLIKE * left.mean() < self._open.mean():
            self._open, self._seen = None, 0
        self._seen += 1
        share = max(1.0 / self._seen, 1.0 / REMEMBERED)
        before = left if self._open is None else self._open
        usual = np.minimum(left, UNLIKE * before)
        self._open = before + share * (usual - before)
        # A jerk of the crank counts at once and in full, and in no later revolution.
        self._now = np.where(left > usual, left, self._open)
        cell = self.cell or UNSTATED_CELL
        force = np.asarray(motion.force_magnitude)
        gauge = (cell.constant + cell.relative * force) ** 2
        noise = _noise_of_a_bin(measured) ** 2
        return np.asarray(COVERAGE_FACTOR * np.sqrt(self._now + self._tolerance + gauge + noise))


def _bytes(values: Array | None) -> bytes:
    return b"" if values is None else values.astype("<f8").tobytes()


def _array(data: bytes) -> Array | None:
    return np.frombuffer(data, dtype="<f8").copy() if data else None


def _tolerances(
    parameters: Parameters, joint: str, motion: MechanismMotion, depth: float
) -> Iterator[Array]:
    """Yield the change of |F| by one standard tolerance of each parameter, (GRID,), N."""
    force = np.asarray(motion.force_magnitude)
    for tolerance in TOLERANCES:
        change = tolerance.off_by(parameters, joint, motion, depth)
        if change is not None:
            yield np.hypot(*(motion.force_crank + change)) - force
    steep = slope(force)
    yield INDEX * steep
    yield LATENCY_S * float(np.mean(motion.speed)) * steep


def _noise_of_a_bin(measured: MeasuredRevolution) -> float:
    """Return the standard deviation of a mean over a bin by the samples' own noise, N.

    Second differences hold little of the force itself; those of white noise have six times its
    variance.
    """
    size = np.hypot(measured.force_1, measured.force_2)
    noise = float(np.std(np.diff(size, 2))) / math.sqrt(6.0)
    return noise / math.sqrt(max(size.size * AGREEMENT_BIN_DEG / 360.0, 1.0))
