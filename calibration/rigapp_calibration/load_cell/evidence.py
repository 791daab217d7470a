"""What the checks of the second round look at: the readings through a robust fit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.characteristics import Loads, loads
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.two_axis import TwoAxisFit, robust_fit
from rigapp_calibration.load_cell.weights import force_per_mass, pin_force, weight_force

SURE = 5.0
"""Standard deviations from which on a difference is no noise."""


@dataclass(frozen=True, slots=True)
class Evidence:
    """What the second round looks at: readings, robust fit, noise (N), loads, N per kg.

    force (n, 2): applied to the pin, N.
    """

    readings: LoadCellReadings
    settings: LoadCellSettings
    found: TwoAxisFit
    noise: float
    loads: Loads
    newton_per_kg: float
    force: Array


def examine(readings: LoadCellReadings, settings: LoadCellSettings) -> Evidence:
    """Fit robustly; raise numpy.linalg.LinAlgError when the loads do not span both axes."""
    weight = weight_force(readings.mass, settings.weights, settings.place)
    applied = pin_force(weight, readings.angle, settings.angle_offset)
    found, noise = robust_fit(applied, readings.signal, settings.cell.resolution / np.sqrt(12.0))
    seen = loads(readings, applied, found.force(readings.signal))
    newton_per_kg = force_per_mass(settings.weights, settings.place)
    return Evidence(readings, settings, found, noise, seen, newton_per_kg, applied)
