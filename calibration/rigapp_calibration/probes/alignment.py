"""Alignment of the pair of probes to the follower: directions, non-orthogonality, 2 x 2 matrix.

The micrometer's stage moves the target along the follower's axis (e2), then across it (n2). Both
probes are read at every step. The slope of a probe against the two motions is its direction::

    probe 1 = cos a1 x + sin a1 y        probe 2 = -sin a2 x + cos a2 y

The sensitivity of each probe belongs to its own motion (it contains cos a), so that::

    (x, y) = matrix (probe 1, probe 2),  matrix = inverse of [[1, tan a1], [-tan a2, 1]]

A cylindrical target shows a motion d of the other axis as d^2 / (2 R) as well; over steps that lie
symmetrically about 0 this is an offset, not a slope.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.probes.calibrate import ProbeCalibration, calibrate_probe
from rigapp_calibration.probes.readings import ProbeReadings
from rigapp_calibration.probes.settings import ProbeSettings
from rigapp_calibration.problems import Problem, blocked

LARGEST_ANGLE = math.radians(15.0)
"""A probe that is mounted by eye stands within five degrees; three times that is a mistake."""


@dataclass(frozen=True, slots=True, eq=False)
class Alignment:
    """How the probes stand, rad; each with its standard uncertainty.

    angle (2,): of probe 1 against e2 and of probe 2 against n2, positive from e2 towards n2.
    orthogonality: angle between the probes less 90 degrees. matrix (2, 2): position of the pin in
    (e2, n2) from the two calibrated probes; matrix_uncertainty (2, 2).
    """

    angle: Array
    angle_uncertainty: Array
    orthogonality: float
    orthogonality_uncertainty: float
    matrix: Array
    matrix_uncertainty: Array


@dataclass(frozen=True, slots=True, eq=False)
class PairCalibration:
    """Both probes and how they stand; alignment is None while a probe is refused."""

    probes: tuple[ProbeCalibration, ProbeCalibration]
    alignment: Alignment | None
    problems: tuple[Problem, ...]

    @property
    def accepted(self) -> bool:
        """Tell whether nothing blocks the pair."""
        return self.alignment is not None and not blocked(self.problems)


def calibrate_pair(
    readings: tuple[ProbeReadings, ProbeReadings], settings: tuple[ProbeSettings, ProbeSettings]
) -> PairCalibration:
    """Calibrate both probes and find how they stand; the problems name the probe."""
    one, two = (
        calibrate_probe(taken, given) for taken, given in zip(readings, settings, strict=True)
    )
    problems = [
        Problem(problem.code, f"Probe {number}: {problem.sentence}", problem.blocks)
        for number, found in enumerate((one, two), 1)
        for problem in found.problems
    ]
    if not (one.accepted and two.accepted):
        return PairCalibration((one, two), None, tuple(problems))
    if readings[0].other is None or readings[1].other is None:
        problems.append(
            Problem("no_other", "The other probe was not read; the alignment is unknown.")
        )
        return PairCalibration((one, two), None, tuple(problems))
    alignment = align(readings, (settings[0].direction, settings[1].direction))
    if np.abs(alignment.angle).max() > LARGEST_ANGLE:
        worst = math.degrees(float(np.abs(alignment.angle).max()))
        problems.append(
            Problem("crooked", f"A probe stands {worst:.1f} degrees off its axis; mount it again.")
        )
    return PairCalibration((one, two), alignment, tuple(problems))


def align(
    readings: tuple[ProbeReadings, ProbeReadings], direction: tuple[float, float]
) -> Alignment:
    """Return how the probes stand, from readings along e2 and along n2.

    direction: standard uncertainty (rad) of the two motions' directions against the follower; no
    reading shows an error of it, it only adds to the uncertainty.
    """
    along, across = readings
    assert along.other is not None
    assert across.other is not None
    own_1, _ = _slope(along.position, along.signal)
    own_2, _ = _slope(across.position, across.signal)
    cross_1, spread_1 = _slope(across.position, across.other)
    cross_2, spread_2 = _slope(along.position, along.other)
    tangent = np.array([cross_1 / own_1, -cross_2 / own_2])
    spread = np.array([spread_1 / abs(own_1), spread_2 / abs(own_2)])
    uncertainty = np.hypot(spread, np.array(direction))
    forward = np.array([[1.0, tangent[0]], [-tangent[1], 1.0]])
    matrix = np.linalg.inv(forward)
    off = np.array([[0.0, uncertainty[0]], [uncertainty[1], 0.0]])
    # d(inverse) = -inverse d(forward) inverse, the two off-diagonal elements independent
    variance = matrix**2 @ off**2 @ matrix**2
    angle = np.arctan(tangent)
    return Alignment(
        angle=angle,
        angle_uncertainty=uncertainty,
        orthogonality=float(angle[1] - angle[0]),
        orthogonality_uncertainty=float(np.hypot(*uncertainty)),
        matrix=np.asarray(matrix, np.float64),
        matrix_uncertainty=np.asarray(np.sqrt(variance), np.float64),
    )


def _slope(position: Array, signal: Array) -> tuple[float, float]:
    """Return the slope of a straight line and its standard uncertainty."""
    centred = position - position.mean()
    square = float(centred @ centred)
    slope = float(centred @ signal) / square
    rest = signal - signal.mean() - slope * centred
    return slope, math.sqrt(float(rest @ rest) / (len(rest) - 2) / square)


def split_pair(readings: ProbeReadings) -> tuple[ProbeReadings, ProbeReadings]:
    """Return the readings of both probes from one table: the series are 1.x and 2.x."""
    series = np.array(readings.series)
    one, two = (
        replace(
            readings,
            series=tuple(series[rows].tolist()),
            step=readings.step[rows],
            position=readings.position[rows],
            signal=readings.signal[rows],
            other=None if readings.other is None else readings.other[rows],
        )
        for rows in (np.char.startswith(series, "1."), np.char.startswith(series, "2."))
    )
    return one, two
