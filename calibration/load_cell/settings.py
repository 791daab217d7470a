"""What must be known beside the readings: cell, weights, place, angle reference. SI."""

from __future__ import annotations

from dataclasses import dataclass

from calibration.load_cell.weights import Place, WeightSet


@dataclass(frozen=True, slots=True)
class CellSettings:
    """Name a load cell: full scale (N), resolution (N), unit of its signal."""

    name: str
    full_scale: float
    resolution: float
    signal_unit: str


@dataclass(frozen=True, slots=True)
class LoadCellSettings:
    """Gather all settings of a load-cell calibration; angles in rad.

    gravity_stated: gravity was given as a value, not from latitude and height.
    gravity_expected: what latitude and height give, None when they are unknown.
    """

    cell: CellSettings
    weights: WeightSet
    place: Place
    angle_offset: float = 0.0
    angle_uncertainty: float = 0.0
    gravity_stated: bool = True
    gravity_expected: float | None = None
