"""Virtual calibrations and the tests after them: do forces lie within U of the plant's truth?

From end to end, without a clock: a cell is drawn, its readings are written as a table, fitted and
sealed; a rig file names the record, which is verified as before every use; samples of a test go
through the engine's own scaling; U is what the test's file states. Between calibration and test the
cell changes as its settings allow ([use]), each part evenly within its bounds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from rigapp.calibrating.records import keep_record
from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.config.calibration_settings import (
    CellSection,
    LoadCellFile,
    PlaceSection,
    load_cell_meaning,
)
from rigapp.config.loading import Document, RigRecords, parse_rig
from rigapp.config.rig import RigFile
from rigapp.engine.values.calibrate import Calibration, calibration_of
from rigapp_calibration.load_cell.force_uncertainty import (
    ForceUncertainty,
    force_uncertainty,
    noise_of_sample,
    stated_uncertainty,
    uncertainty_record,
)
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.weights import pin_force, relative_force_uncertainty, weight_force
from rigapp_drivers.api import ChannelSpec, StreamSetup
from tests.calibration.simulated_cell import Cell, plan
from tests.calibration.test_commands import as_csv

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
GIVEN = LoadCellFile(
    schema=1, cell=CellSection(name="pin load cell"), place=PlaceSection(gravity_m_s2=9.8123)
)
SETTINGS = load_cell_meaning(GIVEN, "here")
SCALE = relative_force_uncertainty(SETTINGS.weights, SETTINGS.place)
ANGLES, SAMPLES_OF_READING = 8, 20
SAMPLES_AT_REST = 500
MEAN_OF = 25
"""Samples of a test in the mean of which a force is judged as well."""


@dataclass(frozen=True)
class Bench:
    """A cell as it was calibrated, and the rig that uses its record."""

    cell: Cell
    records: RigRecords
    kind: Calibration


def calibrated(folder: Path, rng: np.random.Generator) -> Bench | None:
    """Calibrate a new cell in a folder and put its record to use; None where it was refused."""
    truth = np.array([[0.005, 0.0], [0.0, 0.005]]) * (1.0 + rng.normal(0.0, 0.01, (2, 2)))
    cell = Cell(
        sensitivity=truth + rng.normal(0.0, 1e-4, (2, 2)),
        zero=rng.normal(0.0, 0.01, 2),
        hysteresis=rng.uniform(0.0, 1.2),
        drift=rng.normal(0.0, 0.5),
        scale=1.0 + rng.normal(0.0, SCALE),
    )
    series, step, mass, angle = plan(ANGLES)
    setting = np.radians(rng.normal(0.0, 0.05, ANGLES))
    turned = angle + rng.normal(0.0, SETTINGS.angle_uncertainty)
    turned += setting[np.array([int(name) - 1 for name in series])]
    force = pin_force(weight_force(mass, SETTINGS.weights, SETTINGS.place), turned, 0.0)
    signal = means(cell, force, np.linspace(0.0, 1.0, len(mass)), rising(ANGLES), rng)
    text = as_csv(LoadCellReadings(series, step, mass, angle, signal))
    fit = SUBJECTS["load cell"].fit
    assert fit is not None
    outcome = fit(text, GIVEN, "here", "")
    if not outcome.accepted:
        return None
    record = folder / "cell.json"
    record.unlink(missing_ok=True)
    keep_record(record, outcome.kind, text, GIVEN, outcome.result)
    head, tail = RIG.read_text("utf-8").split("[probes]")
    rig = f'{head}calibration = "cell.json"\n[probes]{tail}'
    records = with_records(Document(folder / "rig.toml", rig, parse_rig(rig, "rig.toml")))
    assert not records.blocking, records.blocking
    return Bench(cell, records, frozen(records.rig.record))


def rising(angles: int) -> np.ndarray:
    return np.tile(np.arange(11) <= 5, angles)


def means(
    cell: Cell, force: np.ndarray, order: np.ndarray, up: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """Return readings, each the mean of some samples."""
    many = [np.repeat(one, SAMPLES_OF_READING, axis=0) for one in (force, order, up)]
    return cell.signal(*many, rng).reshape(len(force), SAMPLES_OF_READING, 2).mean(axis=1)


def frozen(rig: RigFile) -> Calibration:
    """Return the calibration of a test on inputs that tell signals themselves."""
    cell, probes = rig.load_cell, rig.probes
    names = (cell.input_1, cell.input_2, probes.input_1, probes.input_2, rig.encoder.input)
    units = ("mV/V", "mV/V", "V", "V", "count")
    channels = tuple(ChannelSpec(n, u) for n, u in zip(names, units, strict=True))
    return calibration_of(rig, StreamSetup(channels, 2000.0, {}))


def held(bench: Bench, rng: np.random.Generator) -> dict[str, bool]:
    """Run a test's worth of one force; return by name what lay within U of the truth."""
    use, full = SETTINGS.use, SETTINGS.cell.full_scale

    def within(half_width: float) -> float:
        return float(half_width * rng.uniform(-1.0, 1.0))

    change = within(use.gain_per_kelvin * use.temperature) + within(use.creep) + within(use.change)
    zero = np.array([within(use.zero_per_kelvin * use.temperature * full) for _ in range(2)])
    cell = replace(bench.cell, scale=1.0 + change)
    size, way = rng.uniform(20.0, 0.95 * full), rng.uniform(0.0, 2.0 * np.pi)
    force = size * np.array([np.cos(way), np.sin(way)])
    samples = MEAN_OF + SAMPLES_AT_REST
    # At rest and under load, at one moment of the drift and on one branch.
    pin = np.vstack((np.tile(force, (MEAN_OF, 1)), np.zeros((SAMPLES_AT_REST, 2))))
    moment, branch = np.full(samples, rng.random()), np.full(samples, rng.random() < 0.5)
    signal = cell.signal(pin + zero, moment, branch, rng)
    raw = np.zeros((len(bench.kind.wires), samples))
    raw[bench.kind.inputs_of("load_cell")] = signal.T
    told = bench.kind.engineering(raw)[bench.kind.inputs_of("load_cell"), :MEAN_OF]
    truth = -force  # the force on the follower by the pin
    stated = stated_in_file(bench, signal[MEAN_OF:])
    found = {}
    for words, count in (("one sample", 1), (f"mean of {MEAN_OF}", MEAN_OF)):
        mean = told[:, :count].mean(axis=1)
        of_size = float(stated.at(size, count, of_magnitude=True))
        found[f"|F|, {words}"] = abs(float(np.hypot(*mean)) - size) <= of_size
        of_component = float(stated.at(size, count, component=truth[0]))
        found[f"component, {words}"] = abs(float(mean[0] - truth[0])) <= of_component
    return found


def stated_in_file(bench: Bench, rest: np.ndarray) -> ForceUncertainty:
    """Return U as the file of a test states it after its signals at rest were seen."""
    cell = bench.records.rig.record.load_cell
    noise = tuple(rest.std(axis=0, ddof=1))
    seen = noise_of_sample(bench.kind.load_cell.matrix, noise, cell.resolution_N)
    stated = stated_uncertainty(bench.records.texts["load_cell"], cell.uncertainty_N)
    group = uncertainty_record(stated, *seen, cell.full_scale_N)
    found = force_uncertainty({"force_uncertainty": group}, {})
    assert found is not None
    return found


def coverage(folder: Path, seeds: range, forces: int = 1) -> dict[str, float]:
    """Return by name which part of the forces lay within U; forces: of each calibration.

    refused: which part of the calibrations was.
    """
    total: dict[str, list[bool]] = {}
    for seed in seeds:
        rng = np.random.default_rng(seed)
        bench = calibrated(folder, rng)
        total.setdefault("refused", []).append(bench is None)
        if bench is None:
            continue
        for _ in range(forces):
            for name, inside in held(bench, rng).items():
                total.setdefault(name, []).append(inside)
    return {name: float(np.mean(one)) for name, one in total.items()}
