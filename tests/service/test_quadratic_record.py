"""A record with quadratic terms: every force that the engine tells is the calibration's own."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import msgspec
import numpy as np
import pytest

from rigapp.calibrating.load_cell_result import load_cell_result
from rigapp.calibrating.records_in_use import with_records
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig
from rigapp.config.rig import RigFile
from rigapp.engine.judging.checks import PeakForce
from rigapp.engine.processing import Processor
from rigapp.engine.resting import _quadratic
from rigapp.engine.samples.assembler import Assembler
from rigapp.engine.values.calibrate import Calibration, Measured, calibrate, calibration_of
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.channels import BASE
from rigapp_calibration.load_cell.calibrate import LoadCellCalibration, calibrate_load_cell
from rigapp_calibration.records import seal
from rigapp_drivers.api import Block, ChannelSpec, StreamSetup
from tests.calibration.simulated_cell import SETTINGS, Cell, take

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
BEND = np.array([[1.5e-7, -4e-8, 6e-8], [5e-8, 3e-8, -1.2e-7]])
RATE = 2000.0


@pytest.fixture(scope="module")
def found() -> LoadCellCalibration:
    """Return the calibration of a bent cell."""
    cell = Cell(noise=0.02, step=0.0)
    readings = take(cell, np.random.default_rng(5), angles=12)
    x, y = calibrate_load_cell(readings, SETTINGS).applied.T
    bent = readings.signal + np.column_stack((x * x, x * y, y * y)) @ BEND.T
    result = calibrate_load_cell(replace(readings, signal=bent), SETTINGS)
    assert result.accepted, [one.sentence for one in result.problems]
    assert result.fit is not None
    assert result.fit.quadratic == pytest.approx(BEND, abs=2e-9)
    return result


@pytest.fixture
def rig(found: LoadCellCalibration, tmp_path: Path) -> Document[RigFile]:
    """Return a rig that uses its record."""
    content = {
        "kind": "load cell",
        "calibrated_at": "2026-01-01T00:00:00Z",
        "due_at": "2027-01-01T00:00:00Z",
        "settings": {"cell": {"signal_unit": "mV/V"}},
        "result": load_cell_result(found, SETTINGS),
    }
    (tmp_path / "cell.json").write_bytes(seal(content))
    head, tail = RIG.read_text().split("[probes]")
    (tmp_path / "rig.toml").write_text(f'{head}calibration = "cell.json"\n[probes]{tail}')
    return with_records(read_rig(tmp_path / "rig.toml"), 1780000000.0).rig


def frozen(rig: RigFile, latency: bool = False) -> Calibration:
    cell, probes = rig.load_cell, rig.probes
    names = (cell.input_1, cell.input_2, probes.input_1, probes.input_2, rig.encoder.input)
    units = ("mV/V", "mV/V", "V", "V", "count")
    channels = tuple(ChannelSpec(n, u) for n, u in zip(names, units, strict=True))
    if not latency:
        cell = msgspec.structs.replace(cell, latency_ms=(0.0, 0.0))
        probes = msgspec.structs.replace(probes, latency_ms=(0.0, 0.0))
        rig = msgspec.structs.replace(rig, load_cell=cell, probes=probes)
    return calibration_of(rig, StreamSetup(channels, RATE, {}))


def block(kind: Calibration, turns: float = 3.0) -> Block:
    """Return random signals of up to some 400 N while the crank turns."""
    n = int(turns * RATE)
    values = np.zeros((5, n), np.float32)
    values[:4] = np.random.default_rng(8).uniform(-1.9, 1.9, (4, n))
    turn = kind.encoder.counts_per_revolution
    values[kind.counter.row] = np.floor(np.arange(n) / RATE * turn) % turn
    return Block("daq", 0, 0, RATE, 0, values, np.zeros(n, np.uint8))


def test_every_force_of_the_engine_is_the_calibrations_own(
    found: LoadCellCalibration, rig: Document[RigFile]
) -> None:
    kind = frozen(rig.record)
    data = block(kind)
    assert found.fit is not None
    truth = -found.fit.force(data.values[list(kind.rows[:2])].T.astype(np.float64)).T
    size = np.hypot(*truth)
    cell = kind.load_cell
    linear = -cell.matrix @ (data.values[list(kind.rows[:2])] - cell.zero[:, None])
    assert np.abs(linear - truth).max() > 3.0, "the terms matter"

    assembler = Assembler(kind.encoder, kind.counter.row, RATE, kind.margins)
    revolution = assembler.push(data)[-1]
    span = slice(revolution.first_sample, revolution.first_sample + revolution.samples)
    told = calibrate(revolution, kind)
    near = pytest.approx
    assert np.stack((told["force_1"], told["force_2"])) == near(truth[:, span], rel=1e-9, abs=1e-9)
    assert told["force"] == near(size[span], rel=1e-9)
    row = Reducer(kind).reduce(Measured(revolution, kind))
    for name, values in (("force_1", truth[0, span]), ("force", size[span])):
        assert row[BASE.place[f"{name}_max"]] == near(values.max(), rel=1e-9)
        assert row[BASE.place[f"{name}_min"]] == near(values.min(), rel=1e-9)
        assert row[BASE.place[f"{name}_rms"]] == near(math.sqrt(np.mean(values**2)), rel=1e-9)
    assert PeakForce(kind).of(data.values) == near(size.max(), rel=1e-9)


def test_live_values_tare_and_overload_use_the_terms(
    found: LoadCellCalibration, rig: Document[RigFile]
) -> None:
    kind = frozen(rig.record)
    data = block(kind)
    seen: list[float] = []
    judge = SimpleNamespace(
        overload=lambda force_N, beyond_range: seen.append(force_N),
        **{
            name: lambda *_: None
            for name in ("begun", "calm", "motion", "revolution", "lost", "missing")
        },
    )
    processor = Processor(kind, lambda: 1.0, False)
    processor.monitor = judge
    tare = np.array([0.02, -0.01])
    processor.set_tare(tare.tolist())
    processor.handle(data)
    assert found.fit is not None
    signals = data.values[list(kind.rows[:2])].T.astype(np.float64)
    truth = -found.fit.force(signals - tare)
    assert processor.live is not None
    live = processor.live.values
    assert [live["force_1"], live["force_2"]] == pytest.approx(truth[-1], rel=1e-9)
    assert seen == [pytest.approx(np.hypot(*truth.T).max(), rel=1e-9)]
    assert np.array(_quadratic(kind)) == pytest.approx(found.fit.quadratic, rel=1e-9)
    spoilt = data.values.copy()
    spoilt[kind.rows[0], 7] = np.nan
    assert math.isnan(PeakForce(kind).of(spoilt))


def test_terms_that_cannot_be_inverted_are_refused(rig: Document[RigFile]) -> None:
    cell = rig.record.load_cell
    assert cell.quadratic_mV_per_V_per_N2 is not None
    steep = tuple(tuple(50.0 * one for one in row) for row in cell.quadratic_mV_per_V_per_N2)
    for quadratic, words in (
        (steep, "two forces"),
        (((math.nan,) * 3,) * 2, "not a finite number"),
    ):
        section = msgspec.structs.replace(cell, quadratic_mV_per_V_per_N2=quadratic)
        with pytest.raises(UnusableInput, match=words):
            frozen(msgspec.structs.replace(rig.record, load_cell=section))
