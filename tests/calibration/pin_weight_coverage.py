"""A rig whose pin weighs something, calibrated on its bench; then the forces of a test, and truth.

From end to end without devices and without a clock: the simulated rig's plant gives the readings of
dead weights, which are fitted and sealed; a rig file names the record; another plant, whose cell
has changed within what the settings allow, turns upright; its samples go through the engine's own
assembler and calibration, and U is what the file of the test states.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import msgspec
import numpy as np

from rigapp.calibrating.records import keep_record
from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.config.loading import Document, parse_rig, read_rig, read_test
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import PlantSection, RigFile
from rigapp.engine.samples.assembler import Assembler
from rigapp.engine.values.calibrate import Calibration, calibrate, calibration_of
from rigapp.simulation import layout
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant, Samples
from rigapp_calibration.load_cell.force_uncertainty import (
    ForceUncertainty,
    noise_of_sample,
    stated_uncertainty,
)
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.weights import weight_force
from rigapp_drivers.api import Block, ChannelSpec, StreamSetup
from tests.calibration.calibrated_tests import GIVEN, SCALE, SETTINGS
from tests.calibration.test_commands import as_csv

EXAMPLES = Path(__file__).parents[2] / "examples"
RATE_HZ, SPEED = 960.0, math.pi
UPRIGHT = (0.0, -9.80665)
ANGLES = (0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 0.0, 90.0)
MASSES = (0.0, 8.0, 16.0, 24.0, 32.0, 40.0, 32.0, 24.0, 16.0, 8.0, 0.0)
HELD = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 1e3)
INPUTS = ("bridge_1", "bridge_2", "probe_1", "probe_2")


@dataclass(frozen=True)
class Used:
    """What a test shows of a revolution: forces told and true (2, n) N, U stated, the engine's."""

    told: np.ndarray
    truth: np.ndarray
    stated: ForceUncertainty
    kind: Calibration
    block: Block


def parameters(gravity: tuple[float, float]) -> ParameterFile:
    """Return the parameters of a test in a plane with so much gravity."""
    model = read_test(EXAMPLES / "quick.toml").record.model
    mechanism = msgspec.structs.replace(model.mechanism, gravity_m_s2=gravity)
    return msgspec.structs.replace(model, mechanism=mechanism)


def plant_of(rig: RigFile, seed: int, gravity: tuple[float, float], **effects: float) -> Plant:
    """Return the plant of a rig file; effects: of ``[simulation.plant]``, set otherwise."""
    assert rig.simulation is not None
    plant = msgspec.structs.replace(PlantSection(), **effects)
    simulated = msgspec.structs.replace(rig.simulation, plant=plant)
    rig = msgspec.structs.replace(rig, simulation=simulated)
    constants = plant_constants(parameters(gravity), rig)
    delay = plant.filter_delay_ms * 1e-3
    return Plant(constants, seed=seed, sample_rate_Hz=RATE_HZ, filter_delay_s=delay)


def readings_of(plant: Plant, rng: np.random.Generator) -> str:
    """Take a calibration on the bench; return the table that a technician writes."""
    scale, turn = 1.0 + rng.normal(0.0, SCALE), rng.normal(0.0, SETTINGS.angle_uncertainty)
    rows = []
    for number, degrees in enumerate(ANGLES, 1):
        angle = math.radians(degrees)
        for step, mass in enumerate(MASSES, 1):
            weight = float(weight_force(np.array([mass]), SETTINGS.weights, SETTINGS.place)[0])
            plant.bench(scale * weight, (0.0, 0.0))
            plant.turn_by_hand(angle + turn)
            plant.advance(4, HELD)  # the filters' past
            seen = plant.advance(120, HELD)
            signals = [float(np.mean(one)) for one in (seen.bridge_1, seen.bridge_2)]
            rows.append((str(number), step, mass, angle, signals))
    series, steps, masses, angles, pairs = zip(*rows, strict=True)
    return as_csv(
        LoadCellReadings(
            series, np.array(steps), np.array(masses), np.array(angles), np.array(pairs)
        )
    )


def block_of(samples: Samples) -> Block:
    """Return samples as a device sends them, in mV/V, V and counts."""
    values = np.empty((5, samples.bridge_1.size), np.float32)
    values[:4] = [getattr(samples, name) for name in INPUTS]
    values[4] = np.floor(3600.0 * samples.shaft_revolutions + 1e-9) % 3600.0
    return Block("daq", 0, 0, RATE_HZ, 0, values, np.zeros(values.shape[1], np.uint8))


def calibration(rig: RigFile) -> Calibration:
    """Return the engine's calibration of such blocks."""
    cell, probes = rig.load_cell, rig.probes
    names = (cell.input_1, cell.input_2, probes.input_1, probes.input_2, rig.encoder.input)
    units = ("mV/V", "mV/V", "V", "V", "count")
    channels = tuple(ChannelSpec(n, u) for n, u in zip(names, units, strict=True))
    return calibration_of(rig, StreamSetup(channels, RATE_HZ, {}))


def used(
    folder: Path,
    seed: int,
    pin_mass_kg: float,
    gravity: tuple[float, float] = UPRIGHT,
    zeroed: bool = False,
) -> Used:
    """Calibrate a rig, turn it, and return what the test shows of a revolution.

    zeroed: the zero is taken before the test, at any angle of the crank.
    """
    rng = np.random.default_rng(seed)
    given = msgspec.structs.replace(
        GIVEN, use=msgspec.structs.replace(GIVEN.use, zero_before_test=zeroed)
    )
    text = (EXAMPLES / "simulated.toml").read_text("utf-8")
    rig = read_rig(EXAMPLES / "simulated.toml").record
    true = {"cross_talk_percent": float(rng.normal(0.0, 1.5)), "pin_mass_kg": pin_mass_kg}
    gain = float(rng.normal(0.0, 1.0))
    bench = plant_of(rig, seed, gravity, cell_gain_error_percent=gain, **true)
    fit = SUBJECTS["load cell"].fit
    assert fit is not None
    table = readings_of(bench, rng)
    outcome = fit(table, given, "here", "")
    assert outcome.accepted, outcome.result["problems"]
    record = folder / "cell.json"
    record.unlink(missing_ok=True)
    keep_record(record, outcome.kind, table, given, outcome.result)
    head, tail = text.split("[probes]")
    named = f'{head}calibration = "cell.json"\n[probes]{tail}'
    records = with_records(Document(folder / "rig.toml", named, parse_rig(named, "rig.toml")))
    assert not records.blocking, records.blocking
    kind = calibration(records.rig.record)

    use, full = SETTINGS.use, SETTINGS.cell.full_scale
    change = sum(
        half * rng.uniform(-1.0, 1.0)
        for half in (use.gain_per_kelvin * use.temperature, use.creep, use.change)
    )
    gain = 100.0 * ((1.0 + gain / 100.0) * (1.0 + change) - 1.0)
    plant = plant_of(rig, seed + 1, gravity, cell_gain_error_percent=gain, **true)
    shift = use.zero_per_kelvin * use.temperature * full * rng.uniform(-1.0, 1.0, 2) / 200.0
    plant.constants = plant.constants._replace(zero_1=shift[0], zero_2=shift[1])
    empty = plant_of(rig, seed + 2, gravity, cell_gain_error_percent=gain, **true)
    empty.bench(0.0, (0.0, 0.0))
    angle = rng.uniform(0.0, 2.0 * math.pi)
    empty.turn_by_hand(angle)
    empty.advance(4, HELD)
    rest = empty.advance(400, HELD)
    signals = np.array([rest.bridge_1, rest.bridge_2])
    if zeroed:
        kind = kind.with_tare(signals.mean(axis=1) - kind.load_cell.zero, angle)
    kind = kind.under(gravity)
    samples = plant.advance(round(RATE_HZ * 6.0), Drive(layout.VELOCITY, SPEED, SPEED, 0, 48, 0))
    block = block_of(samples)
    assembler = Assembler(kind.encoder, kind.counter.row, RATE_HZ, kind.margins)
    revolution = assembler.push(block)[1]
    found = calibrate(revolution, kind)
    index = revolution.sample_indices()
    truth = np.array([samples.truth.force_e1_N[index], samples.truth.force_n1_N[index]])
    stated = stated_uncertainty(records.texts["load_cell"], None)
    assert stated is not None
    first, second = signals.std(axis=1, ddof=1).tolist()
    noise, _ = noise_of_sample(kind.load_cell.matrix, (first, second), 2.0)
    told = np.array([found["force_1"], found["force_2"]])
    return Used(told, truth, replace(stated, noise_N=noise), kind, block)


def held(folder: Path, seed: int, pin_mass_kg: float, zeroed: bool = False) -> dict[str, bool]:
    """Return what of one force of a test lay within U of the plant's truth."""
    found = used(folder, seed, pin_mass_kg, zeroed=zeroed)
    place = int(np.random.default_rng((seed, 2)).integers(found.told.shape[1]))
    told, truth = found.told[:, place], found.truth[:, place]
    size = float(np.hypot(*truth))
    of_size = float(found.stated.at(size, of_magnitude=True))
    return {
        "|F|": abs(float(np.hypot(*told)) - size) <= of_size,
        **{
            f"force_{axis + 1}": abs(float(told[axis] - truth[axis]))
            <= float(found.stated.at(size, component=float(truth[axis])))
            for axis in range(2)
        },
    }


def coverage(folder: Path, seeds: range, pin_mass_kg: float, zeroed: bool) -> dict[str, float]:
    """Return by name the part of the seeds whose force lay within U."""
    found = [held(folder, seed, pin_mass_kg, zeroed) for seed in seeds]
    return {name: float(np.mean([one[name] for one in found])) for name in found[0]}
