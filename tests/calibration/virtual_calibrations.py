"""Virtual calibrations with known truth: how often does a stated uncertainty hold it?

Every calibration draws a cell and the errors that its settings state (weights, angle reference);
a scenario adds what only the readings can tell. A reading is taken with the same cell afterwards,
of a force of any size and direction, on either branch, at any moment of the drift.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp_calibration.load_cell.budget import (
    LoadUncertainty,
    element_uncertainties,
    uncertainty_at,
    zero_uncertainty,
)
from rigapp_calibration.load_cell.calibrate import fit_readings
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.weights import pin_force, relative_force_uncertainty, weight_force
from tests.calibration.simulated_cell import SETTINGS, Cell, plan

SCALE = relative_force_uncertainty(SETTINGS.weights, SETTINGS.place)
MEAN_OF = 25
"""Readings in the mean of which a force is judged as well."""


@dataclass(frozen=True)
class Scenario:
    """What the readings have beside noise. hysteresis, drift (sd) in N; angle_deg: sd per series.

    averaged: samples of which a reading is the mean.
    """

    name: str
    angles: int = 8
    averaged: int = 1
    hysteresis: float = 0.0
    angle_deg: float = 0.0
    drift: float = 0.0


SCENARIOS = (
    Scenario("ideal, 8 angles"),
    Scenario("ideal, 12 angles", 12),
    Scenario("means of 100", averaged=100),
    Scenario("hysteresis 0.3 %", hysteresis=1.2),
    Scenario("angle error per series", angle_deg=0.1),
    Scenario("drift", drift=1.0),
    Scenario("all together", averaged=100, hysteresis=1.2, angle_deg=0.1, drift=1.0),
)


def calibrate_once(scenario: Scenario, rng: np.random.Generator) -> dict[str, list[bool]]:
    """Return by name what of one calibration held the truth."""
    truth = np.array([[0.005, 0.0], [0.0, 0.005]]) * (1.0 + rng.normal(0.0, 0.01, (2, 2)))
    truth += rng.normal(0.0, 1e-4, (2, 2))
    cell = Cell(
        sensitivity=truth,
        zero=rng.normal(0.0, 0.01, 2),
        hysteresis=scenario.hysteresis,
        drift=rng.normal(0.0, scenario.drift),
        scale=1.0 + rng.normal(0.0, SCALE),
    )
    series, step, mass, angle = plan(scenario.angles)
    setting = np.radians(rng.normal(0.0, scenario.angle_deg, scenario.angles))
    turned = angle + rng.normal(0.0, SETTINGS.angle_uncertainty)
    turned += setting[np.array([int(name) - 1 for name in series])]
    weight = weight_force(mass, SETTINGS.weights, SETTINGS.place)
    rising = np.tile(np.arange(11) <= 5, scenario.angles)
    order = np.linspace(0.0, 1.0, len(mass))

    def take(force: np.ndarray, order: np.ndarray, rising: np.ndarray, count: int) -> np.ndarray:
        many = [np.repeat(one, count, axis=0) for one in (force, order, rising)]
        return cell.signal(*many, rng).reshape(len(force), count, 2).mean(axis=1)

    signal = take(pin_force(weight, turned, 0.0), order, rising, scenario.averaged)
    readings = LoadCellReadings(series, step, mass, angle, signal)
    fitted = fit_readings(readings, SETTINGS)
    found, parts = fitted.fit, fitted.parts
    error = found.matrix - np.linalg.inv(truth)
    held = {
        "matrix": [
            abs(off) <= one.expanded
            for off, one in zip(error.flat, element_uncertainties(parts, SETTINGS), strict=True)
        ],
        "zero": [
            abs(off) <= one.expanded
            for off, one in zip(
                found.zero - cell.zero, zero_uncertainty(parts, SETTINGS), strict=True
            )
        ],
    }
    size, way = rng.uniform(20.0, 400.0), rng.uniform(0.0, 2.0 * np.pi)
    force = size * np.array([[np.cos(way), np.sin(way)]])
    moment, branch = np.array([rng.random()]), np.array([rng.random() < 0.5])
    stated = uncertainty_at(parts, SETTINGS, size)
    for words, count in (("", 1), (f", mean of {MEAN_OF}", MEAN_OF)):
        felt = Cell(**{**vars(cell), "scale": 1.0})
        samples = scenario.averaged * count
        many = [np.repeat(one, samples, axis=0) for one in (force, moment, branch)]
        told = found.force(felt.signal(*many, rng).mean(axis=0, keepdims=True))[0]
        magnitude = abs(np.hypot(*told) - size)
        component = abs(told[0] - force[0, 0])
        held[f"|F|{words}"] = [magnitude <= stated.magnitude.of_mean(count).expanded]
        held[f"component{words}"] = [component <= component_at(stated, np.cos(way), count)]
    return held


def component_at(stated: LoadUncertainty, cosine: float, readings: float) -> float:
    """Return U of a component that stands so to the force, of a mean of so many readings."""
    along, across = (one.of_mean(readings).expanded for one in (stated.magnitude, stated.across))
    return float(np.hypot(along * cosine, across * np.sqrt(1.0 - cosine**2)))


def coverage(scenario: Scenario, count: int, seed: int) -> dict[str, tuple[float, int]]:
    """Return by name the part that held the truth, and of how many."""
    rng = np.random.default_rng(seed)
    total: dict[str, list[bool]] = {}
    for _ in range(count):
        for name, held in calibrate_once(scenario, rng).items():
            total.setdefault(name, []).extend(held)
    return {name: (float(np.mean(held)), len(held)) for name, held in total.items()}
