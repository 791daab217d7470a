"""The daily check: does the calibration in use still tell the weight that hangs, and its zero?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.characteristics import loads
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.two_axis import forces
from rigapp_calibration.load_cell.weights import pin_force, weight_force
from rigapp_calibration.taking.readings import each_series

WEIGHT_SHARE = 0.005
"""Of the weight: half of what class 2 of ISO 376 allows between angles and up and down together."""
ZERO_SHARE = 0.01
"""Of full scale: five times what 20 K make of a good cell. More is an overload, or a gauge that
comes off; less is taken off before each test."""


@dataclass(frozen=True, slots=True)
class DailyCheck:
    """The result. deviation: (n, 2) N along and across the weight, zero of each series taken off.

    elements (2, 2): felt force = elements applied force, by least squares; the identity when the
    calibration in use is right. sensitivity: mean ratio of felt to applied force. cross_talk: mean
    share felt across. zero: (2,) mean zero less the calibration's, N. largest: the largest
    deviation, N. allowed, zero_allowed: N. weight: the heaviest that hung, N.
    """

    passed: bool
    deviation: Array
    elements: Array
    sensitivity: float
    cross_talk: float
    zero: Array
    largest: float
    allowed: float
    zero_allowed: float
    sentence: str
    weight: float


def daily_check(
    readings: LoadCellReadings,
    settings: LoadCellSettings,
    matrix: Array,
    zero: Array,
    quadratic: Array | None = None,
) -> DailyCheck:
    """Compare the forces that the calibration in use tells with the weights that hung.

    The limit is one resolution of the cell, or half a percent of the weight if that is more; of the
    zero, one resolution or a percent of full scale. Raises ValueError when a series has no zero,
    nothing hung, or the weight hung along one axis only.
    """
    weight = weight_force(readings.mass, settings.weights, settings.place)
    applied = pin_force(weight, readings.angle, settings.angle_offset)
    felt = forces(readings.signal, matrix, zero, quadratic)
    empty = readings.mass == 0.0
    rest = np.empty_like(felt)
    for name, members in each_series(readings.series):
        zeros = felt[members & empty]
        if not len(zeros):
            raise ValueError(f"series {name} has no reading without weights")
        rest[members] = zeros.mean(axis=0)
    loaded = ~empty
    if not loaded.any():
        raise ValueError("no reading has a weight on it")
    net, size = felt - rest, weight[loaded]
    seen = loads(readings, applied, net)
    along, parallel, crossed = (one[loaded] for one in (seen.direction, seen.along, seen.across))
    deviation = np.stack((parallel - size, crossed), axis=-1)
    if np.linalg.matrix_rank(along, tol=0.1) < 2:
        raise ValueError("the weight hung along one axis only; hang it at angles of both")
    elements = np.linalg.lstsq(applied[loaded], net[loaded], rcond=None)[0].T
    zero = felt[empty].mean(axis=0)
    largest = float(np.abs(deviation).max())
    resolution = settings.cell.resolution
    allowed = max(resolution, WEIGHT_SHARE * float(size.max()))
    zero_allowed = max(resolution, ZERO_SHARE * settings.cell.full_scale)
    told, at_rest = largest <= allowed, float(np.abs(zero).max()) <= zero_allowed
    return DailyCheck(
        passed=told and at_rest,
        deviation=deviation,
        elements=np.asarray(elements, np.float64),
        sensitivity=float((parallel / size).mean()),
        cross_talk=float((crossed / size).mean()),
        zero=zero,
        largest=largest,
        allowed=allowed,
        zero_allowed=zero_allowed,
        sentence=_sentence(elements, largest, allowed, zero, zero_allowed),
        weight=float(size.max()),
    )


def _sentence(
    elements: Array, largest: float, allowed: float, zero: Array, zero_allowed: float
) -> str:
    """Say whether the cell tells the weight, where not, and whether its zero stands."""
    words = f"The cell tells the weight within {largest:.2f} N ({allowed:.2f} N are allowed)."
    if largest > allowed:
        off = elements - np.eye(2)
        row, of = divmod(int(np.abs(off).argmax()), 2)
        words = (
            f"The cell is off by {largest:.2f} N, {allowed:.2f} N are allowed: axis {row + 1} tells"
            f" {100.0 * float(off[row, of]):+.2f} % of the force along axis {of + 1}"
            f"{' too much' if row == of else ''}. Check the weight that hung; if it was right,"
            " calibrate the load cell again."
        )
    axis = int(np.abs(zero).argmax())
    if abs(float(zero[axis])) > zero_allowed:
        words += (
            f" The zero of axis {axis + 1} stands {float(zero[axis]):+.2f} N off that of the"
            f" calibration, {zero_allowed:.2f} N are allowed: was the cell overloaded, or is a"
            " cable off? Zero it; if it moves again, have it looked after."
        )
    return words
