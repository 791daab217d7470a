"""The daily check: does the calibration in use still tell the weight that hangs?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from calibration.arrays import Array
from calibration.load_cell.readings import LoadCellReadings
from calibration.load_cell.settings import LoadCellSettings
from calibration.load_cell.two_axis import forces
from calibration.load_cell.weights import pin_force, weight_force


@dataclass(frozen=True, slots=True)
class DailyCheck:
    """The result. deviation: (n, 2) N along and across the weight, zero of each series taken off.

    sensitivity: mean ratio of felt to applied force. cross_talk: mean share felt across. zero: (2,)
    mean zero less the calibration's, N. largest: the largest deviation, N. allowed: N. weight: the
    heaviest that hung, N.
    """

    passed: bool
    deviation: Array
    sensitivity: float
    cross_talk: float
    zero: Array
    largest: float
    allowed: float
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

    The limit is one resolution of the cell, or half a percent of the weight if that is more.
    Raises ValueError when a series has no zero or nothing hung.
    """
    weight = weight_force(readings.mass, settings.weights, settings.place)
    applied = pin_force(weight, readings.angle, settings.angle_offset)
    felt = forces(readings.signal, matrix, zero, quadratic)
    names = np.array(readings.series)
    empty = readings.mass == 0.0
    rest = np.empty_like(felt)
    for name in dict.fromkeys(readings.series):
        zeros = felt[(names == name) & empty]
        if not len(zeros):
            raise ValueError(f"series {name} has no reading without weights")
        rest[names == name] = zeros.mean(axis=0)
    loaded = ~empty
    if not loaded.any():
        raise ValueError("no reading has a weight on it")
    size = weight[loaded]
    along = applied[loaded] / size[:, None]
    across = np.stack((-along[:, 1], along[:, 0]), axis=-1)
    net = (felt - rest)[loaded]
    parallel, crossed = (net * along).sum(axis=1), (net * across).sum(axis=1)
    deviation = np.stack((parallel - size, crossed), axis=-1)
    largest = float(np.abs(deviation).max())
    allowed = max(settings.cell.resolution, 0.005 * float(size.max()))
    passed = largest <= allowed
    sentence = (
        f"The cell tells the weight within {largest:.2f} N ({allowed:.2f} N are allowed)."
        if passed
        else f"The cell is off by {largest:.2f} N, {allowed:.2f} N are allowed: check the weight"
        " that hung; if it was right, calibrate the load cell again."
    )
    return DailyCheck(
        passed=passed,
        deviation=deviation,
        sensitivity=float((parallel / size).mean()),
        cross_talk=float((crossed / size).mean()),
        zero=felt[empty].mean(axis=0),
        largest=largest,
        allowed=allowed,
        sentence=sentence,
        weight=float(size.max()),
    )
