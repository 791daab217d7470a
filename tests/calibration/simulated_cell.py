"""A simulated two-axis cell with hidden truth, to be calibrated."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import CellSettings, LoadCellSettings
from rigapp_calibration.load_cell.weights import Place, WeightSet, pin_force, weight_force

SETTINGS = LoadCellSettings(
    cell=CellSettings("pin load cell", 400.0, 2.0, "mV/V"),
    weights=WeightSet(),
    place=Place(9.8123, 1e-4),
    angle_offset=0.0,
    angle_uncertainty=float(np.radians(0.05)),
)


@dataclass(frozen=True)
class Cell:
    """The truth of a simulated cell; sensitivity in mV/V per N."""

    sensitivity: np.ndarray = field(
        default_factory=lambda: np.array([[0.00500, 0.00008], [-0.00006, 0.00495]])
    )
    zero: np.ndarray = field(default_factory=lambda: np.array([0.011, -0.007]))
    noise: float = 0.7
    step: float = 2.0
    hysteresis: float = 0.0
    drift: float = 0.0
    offset: float = 0.0
    scale: float = 1.0
    mass_scatter: float = 0.0

    def signal(self, force: np.ndarray, order: np.ndarray, rising: np.ndarray, rng) -> np.ndarray:
        size = np.hypot(*force.T)
        bend = self.hysteresis * np.sin(np.pi * np.clip(size / 400.0, 0, 1)) * ~rising
        direction = force / np.maximum(size, 1e-12)[:, None]
        felt = self.scale * force + direction * bend[:, None] + self.drift * (order - 0.5)[:, None]
        noisy = felt @ self.sensitivity.T + self.zero
        per_newton = np.abs(np.diag(self.sensitivity))
        noisy += rng.normal(0.0, 1.0, noisy.shape) * self.noise * per_newton
        if self.step:
            quantum = self.step * per_newton
            noisy = np.round(noisy / quantum) * quantum
        return noisy


def plan(angles: int = 8, steps: int = 5, heaviest: float = 40.0) -> tuple:
    up = np.linspace(0.0, heaviest, steps + 1)
    masses = np.concatenate((up, up[-2::-1]))
    series, step, mass, angle = [], [], [], []
    for number in range(angles):
        for index, value in enumerate(masses):
            series.append(str(number + 1))
            step.append(index + 1)
            mass.append(value)
            angle.append(2.0 * np.pi * number / angles)
    return tuple(series), np.array(step), np.array(mass), np.array(angle)


def take(
    cell: Cell, rng, angles: int = 8, steps: int = 5, heaviest: float = 40.0
) -> LoadCellReadings:
    series, step, mass, angle = plan(angles, steps, heaviest)
    weight = weight_force(mass, SETTINGS.weights, SETTINGS.place)
    force = pin_force(weight, angle, cell.offset)
    order = np.linspace(0.0, 1.0, len(mass))
    rising = np.tile(np.arange(2 * steps + 1) <= steps, angles)
    return LoadCellReadings(series, step, mass, angle, cell.signal(force, order, rising, rng))
