"""What must be known beside the readings: cell, weights, place, angle reference. SI."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp_calibration.load_cell.weights import Place, WeightSet


@dataclass(frozen=True, slots=True)
class CellSettings:
    """Name a load cell: full scale (N), resolution (N), unit of its signal."""

    name: str
    full_scale: float
    resolution: float
    signal_unit: str


@dataclass(frozen=True, slots=True)
class Use:
    """What changes between the calibration and a test; each a half width: at most so much.

    temperature: difference of the cell's temperature to that of the calibration, K. gain_per_kelvin
    relative; zero_per_kelvin: part of full scale, since the zero was taken last. creep: between
    seconds and minutes under load, part of the load; creep_measured: by this calibration. change:
    of the gain until the next calibration, relative.
    """

    temperature: float = 0.0
    gain_per_kelvin: float = 0.0
    zero_per_kelvin: float = 0.0
    creep: float = 0.0
    change: float = 0.0
    creep_measured: bool = False


@dataclass(frozen=True, slots=True)
class LoadCellSettings:
    """Gather all settings of a load-cell calibration; angles in rad.

    angle_stated: an angle reference was taken; else the offset is unknown. gravity_stated: it was
    given as a value, not from latitude and height. gravity_expected: what latitude and height give,
    None when they are unknown.
    """

    cell: CellSettings
    weights: WeightSet
    place: Place
    angle_offset: float = 0.0
    angle_uncertainty: float = 0.0
    angle_stated: bool = True
    gravity_stated: bool = True
    gravity_expected: float | None = None
    use: Use = Use()
