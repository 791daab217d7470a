"""Revolutions of the simulated rig's plant, driven without devices and without a clock."""

from __future__ import annotations

from pathlib import Path

import msgspec
import numpy as np

from rigapp.config.loading import read_rig, read_test
from rigapp.config.parameters import ParameterFile, to_parameters
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Prediction, as_array
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.layout import VELOCITY, Drive
from rigapp.simulation.plant import Plant
from rigapp.twin.predict import MeasuredRevolution

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = read_rig(EXAMPLES / "simulated.toml").record
TEST = read_test(EXAMPLES / "quick.toml").record
PARAMETERS = to_parameters(TEST.model)
SPEED = 2.0 * np.pi


def measured_revolutions(
    wear: float,
    number: int,
    *,
    seed: int = 3,
    speed: float = SPEED,
    counts: int = 0,
    model: ParameterFile = TEST.model,
    **effects_off: float,
) -> list[tuple[MeasuredRevolution, float]]:
    """Run the plant, its wear so many times the model's; return revolutions and true depths, m.

    Everything that the simulated rig has is on: noise, friction, cross-talk, run-out, ripple;
    ``effects_off`` sets some of it otherwise, model the mechanism. counts: of the encoder in a
    turn, 0 for exact angles.
    """
    assert RIG.simulation is not None
    effects = msgspec.structs.replace(
        RIG.simulation.plant, wear_coefficient_factor=wear, **effects_off
    )
    simulation = msgspec.structs.replace(RIG.simulation, plant=effects)
    rig = msgspec.structs.replace(RIG, simulation=simulation)
    plant = Plant(plant_constants(model, rig), seed=seed, sample_rate_Hz=960.0)
    samples_due = round(960 * (number * 2.0 * np.pi / speed + 3.0))
    samples = plant.advance(samples_due, Drive(VELOCITY, speed, speed, 0.0, 48.0, 0.0))
    turns = samples.shaft_revolutions
    if counts:
        turns = np.floor(counts * turns) / counts
    force = -np.array(RIG.load_cell.matrix_N_per_mV_per_V) @ np.stack(
        [samples.bridge_1, samples.bridge_2]
    )
    probes = 1e-4 * np.stack([samples.probe_1, samples.probe_2])
    found = []
    for index in range(number):
        part = np.flatnonzero(np.floor(turns) == index)
        measured = MeasuredRevolution(
            index + 1,
            samples.truth.time_s[part],
            2.0 * np.pi * (turns[part] - index),
            *force[:, part],
            *probes[:, part],
        )
        found.append((measured, float(samples.truth.wear_depth_m[part].mean())))
    return found


def column(prediction: Prediction, name: str) -> float:
    names = [one.name for one in prediction_columns()]
    return float(as_array(prediction.values, "<f8")[names.index(name)])


def moved(measured: MeasuredRevolution) -> MeasuredRevolution:
    """Return a revolution without the samples at which the counter stood."""
    on = np.diff(measured.angle, prepend=-1.0) > 0.0
    curves = ("time", "angle", "force_1", "force_2", "probe_1", "probe_2")
    return MeasuredRevolution(
        measured.revolution, *(getattr(measured, name)[on] for name in curves)
    )
