"""Records of the probes in use: pair, run-out map and U reach the engine's samples and its file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from rigapp.calibrating.records_in_use import with_records
from rigapp.calibrating.run_out import _as_read, _with_elastic
from rigapp.config.consistency import number_faults
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig
from rigapp.config.rig import RigFile
from rigapp.engine.recording.store import calibration_record
from rigapp.engine.samples.assembler import Assembler, EncoderSetup, Revolution
from rigapp.engine.values.calibrate import Calibration, Measured, calibrate
from rigapp.engine.values.corrections import probe_correction
from rigapp.engine.values.reduce import Reducer
from rigapp.report.testreport.facts import stated_uncertainties
from rigapp.schema.channels import BASE
from rigapp.simulation import layout
from rigapp.simulation.constants import packaged_parameters, plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant
from rigapp_calibration.probes.calibrate import calibrate_pair
from rigapp_calibration.probes.plans import MEASURING, ProbePlan, probe_readings
from rigapp_calibration.probes.readings import ProbeSettings
from rigapp_calibration.records import seal
from rigapp_calibration.taking.procedure import begin
from rigapp_calibration.turning.run_out import SlowRevolution, evaluate
from rigapp_drivers.api import Block
from tests.engine.calibrations import calibration_by_hand

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
IN_TIME, TOO_LATE = 1780000000.0, 1800000000.0
DATES = {"calibrated_at": "2026-01-01T00:00:00Z", "due_at": "2027-01-01T00:00:00Z"}
COS, SIN = [[3.0, 0.5], [0.0, -0.25]], [[0.0, 0.1], [3.0, 0.0]]
MATRIX = [[1.0, 0.02], [-0.01, 1.0]]


def one_probe(sensitivity: float, offset: float) -> dict[str, Any]:
    return {
        "sensitivity_um_per_V": sensitivity,
        "offset_V": offset,
        "expanded_uncertainty_um": 1.2,
    }


PAIR = {
    "kind": "probe pair",
    **DATES,
    "settings": {"probe": {"name": "pair"}},
    "result": {
        "probes": [one_probe(101.0, 0.1), one_probe(98.0, -0.2)],
        "alignment": {"matrix": MATRIX},
    },
}
MAP = {
    "kind": "run-out map",
    **DATES,
    "settings": {"pin": {"name": "pin"}},
    "result": {"cos_um": COS, "sin_um": SIN, "expanded_uncertainties_um": [0.5, 0.9]},
}


def rig_with(folder: Path, lines: str) -> Document[RigFile]:
    (folder / "pair.json").write_bytes(seal(PAIR))
    (folder / "map.json").write_bytes(seal(MAP))
    path = folder / "rig.toml"
    path.write_text(RIG.read_text().replace("[probes]\n", f"[probes]\n{lines}\n"))
    return read_rig(path)


def test_pair_and_map_take_the_place_of_the_rig_files_numbers(tmp_path: Path) -> None:
    rig = rig_with(tmp_path, 'calibration = "pair.json"\nrun_out = "map.json"')
    found = with_records(rig, IN_TIME)
    probes = found.rig.record.probes
    assert probes.sensitivity_um_per_V == (101.0, 98.0)
    assert probes.offset_V == (0.1, -0.2)
    assert probes.alignment == ((1.0, 0.02), (-0.01, 1.0))
    assert probes.run_out_cos_um == ((3.0, 0.5), (0.0, -0.25))
    # The uncertainties of the line and of the map add as squares.
    assert probes.uncertainty_um == pytest.approx((1.3, 1.5))
    assert set(found.texts) == {"probes", "run_out"}
    assert all("holds no readings" in one for one in found.blocking.values())


def test_expired_map_blocks_a_start_unless_overridden_with_a_reason(tmp_path: Path) -> None:
    late = with_records(rig_with(tmp_path, 'run_out = "map.json"'), TOO_LATE)
    assert "expired on 2027-01-01" in late.blocking["run_out"]
    used = with_records(
        rig_with(tmp_path, 'run_out = "map.json"\nrun_out_override = "the roll is tomorrow"'),
        TOO_LATE,
    )
    assert not used.blocking
    assert "the roll is tomorrow" in used.remarks["run_out"]


def test_records_in_each_others_place_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match="record of a probe pair, not of a run-out map"):
        with_records(rig_with(tmp_path, 'run_out = "pair.json"'), IN_TIME)
    with pytest.raises(UnusableInput, match="not of a probe or a probe pair"):
        with_records(rig_with(tmp_path, 'calibration = "map.json"'), IN_TIME)
    with pytest.raises(UnusableInput, match="not of a probe"):
        with_records(rig_with(tmp_path, 'calibration = ["pair.json", "pair.json"]'), IN_TIME)


def calibration(index_angle: float = 0.0, **changes: Any) -> Calibration:
    section = read_rig(RIG).record.probes
    section = msgspec.structs.replace(
        section, alignment=MATRIX, run_out_cos_um=COS, run_out_sin_um=SIN
    )
    values: dict[str, Any] = {
        "encoder": EncoderSetup(3600),
        "index_angle_rad": index_angle,
        "sample_rate_Hz": 1000.0,
        "matrix": np.diag([200.0, 190.0]),
        "zero": np.zeros(2),
        "sensitivity": np.array([100.0, 90.0]),
        "probe_offset": np.array([0.1, -0.1]),
        "latency_s": np.array([0.0, 0.0, 1.4e-3, 1.4e-3]),
        "correction": probe_correction(section, 3600, index_angle),
        "uncertainty_um": (1.3, 1.5),
    }
    return calibration_by_hand(**{**values, **changes})


def shown_by(kind: Calibration, position: np.ndarray) -> list[Revolution]:
    """Return revolutions of a pin at ``position`` (2,), um, by crooked probes, with run-out."""
    turns = np.arange(4000) / 1000.0 * 0.97 + 0.3
    sensed = turns - 1.4e-3 * 0.97  # the analog path is late
    angle = kind.index_angle_rad + 2.0 * math.pi * sensed
    interleaved = np.array([[3.0, 0.0, 0.5, 0.1], [0.0, 3.0, -0.25, 0.0]])
    read = np.linalg.solve(np.array(MATRIX), np.repeat(position[:, None], 4000, axis=1))
    read = read + evaluate(interleaved, angle)
    values = np.zeros((5, 4000))
    values[2:4] = read / kind.probes.sensitivity[:, None] + kind.probes.offset[:, None]
    values[4] = np.floor(turns * 3600.0 + 1e-9) % 3600.0
    assembler = Assembler(kind.encoder, 4, kind.sample_rate_Hz, kind.margins)
    good = np.zeros(4000, np.uint8)
    return assembler.push(Block("daq", 0, 0, 1000.0, 0, values.astype(np.float32), good))


@pytest.mark.parametrize("index_angle", [0.0, 1.1])
def test_map_and_alignment_leave_the_position_in_samples_and_statistics(index_angle: float) -> None:
    kind = calibration(index_angle)
    position = np.array([-420.0, 25.0])
    revolutions = shown_by(kind, position)
    assert len(revolutions) >= 2
    plain = Reducer(calibration(index_angle, correction=None))
    reducer = Reducer(kind)
    for revolution in revolutions[:2]:
        values = calibrate(revolution, kind)
        # One count of the encoder is 0.1 deg: 3 um of run-out change by 0.005 um.
        assert values["probe_1"] == pytest.approx(np.full(revolution.samples, -420.0), abs=0.05)
        assert values["probe_2"] == pytest.approx(np.full(revolution.samples, 25.0), abs=0.05)
        row = dict(
            zip(BASE.names, reducer.reduce(Measured(revolution, kind)).tolist(), strict=True)
        )
        assert row["probe_1_max"] == pytest.approx(values["probe_1"].max(), abs=1e-9)
        assert row["probe_2_min"] == pytest.approx(values["probe_2"].min(), abs=1e-9)
        assert row["probe_2_rms"] == pytest.approx(25.0, abs=0.02)
        assert row["probe_1_mean"] == pytest.approx(-420.0, abs=0.02)
        assert row["probe_1_max"] - row["probe_1_min"] < 0.1
        before = plain.reduce(Measured(revolution, plain.calibration))
        assert before[BASE.place["probe_1_max"]] - before[BASE.place["probe_1_min"]] > 5.5
        # Forces are what they were.
        assert row["force_max"] == pytest.approx(before[BASE.place["force_max"]])


def test_live_value_is_corrected_where_the_angle_is_known() -> None:
    correction = calibration(0.4).probes.correction
    assert correction is not None
    read = np.array([10.0, 20.0])
    angle = 0.4 + 2.0 * math.pi * 900 / 3600
    interleaved = np.array([[3.0, 0.0, 0.5, 0.1], [0.0, 3.0, -0.25, 0.0]])
    expected = np.array(MATRIX) @ (read - evaluate(interleaved, np.array([angle]))[:, 0])
    assert correction.at(angle, 0.4, read) == pytest.approx(expected)
    assert correction.at(None, 0.4, read) == pytest.approx(np.array(MATRIX) @ read)


def test_file_tells_what_was_applied_and_a_roll_takes_it_back() -> None:
    kind = calibration()
    kept = calibration_record(kind)["probes"]
    assert kept["alignment"] == MATRIX
    assert kept["run_out_cos_um"] == COS
    assert kept["uncertainty_um"] == [1.3, 1.5]
    angle = np.linspace(0.0, 6.0, 50)
    interleaved = np.array([[3.0, 0.0, 0.5, 0.1], [0.0, 3.0, -0.25, 0.0]])
    read = np.array([[1.0], [2.0]]) + evaluate(interleaved, angle)
    shown = np.array(MATRIX) @ (read - evaluate(interleaved, angle))
    assert _as_read(shown, angle, kept) == pytest.approx(read)
    assert _as_read(read, angle, {}) == pytest.approx(read)
    plain = calibration_record(calibration(correction=None, uncertainty_um=None))["probes"]
    assert not {"alignment", "run_out_cos_um", "uncertainty_um"} & set(plain)


def test_elastic_motion_is_told_as_the_probes_read_it() -> None:
    angle = np.linspace(0.0, 2.0 * math.pi, 60, endpoint=False)
    turn, force = (
        SlowRevolution(1, angle, np.zeros((2, 60))),
        np.array([-60.0 - 20.0 * np.cos(angle)] * 2),
    )
    roll = Path("roll.h5")
    plain = _with_elastic([turn], [force], packaged_parameters(), {}, roll)[0].elastic
    aligned = {"alignment": MATRIX}
    read = _with_elastic([turn], [force], packaged_parameters(), aligned, roll)[0].elastic
    assert plain is not None
    assert read is not None
    assert np.ptp(plain) > 10e-6
    assert np.array(MATRIX) @ read == pytest.approx(plain, abs=1e-12)
    force[0, 3] = math.nan
    with pytest.raises(UnusableInput, match=r"roll\.h5: the elastic motion .* --test"):
        _with_elastic([turn], [force], packaged_parameters(), {}, roll)


@pytest.mark.parametrize(
    ("changes", "needle"),
    [
        ({"run_out_cos_um": ((1.0,), (1.0,))}, "has 1 orders and"),
        ({"run_out_cos_um": ((1.0,), ()), "run_out_sin_um": ((1.0,), ())}, "other orders for one"),
        ({"alignment": ((1.0, 1.0), (1.0, 1.0))}, "cannot be inverted"),
        ({"alignment": ((1.0, 0.0), (1.0, 0.01))}, "cannot be inverted"),
        ({"alignment": ((math.nan, 0.0), (0.0, 1.0))}, "not a finite number"),
    ],
)
def test_senseless_corrections_are_refused(changes: dict[str, Any], needle: str) -> None:
    rig = read_rig(RIG).record
    section = msgspec.structs.replace(rig.probes, **changes)
    assert needle in next(number_faults(msgspec.structs.replace(rig, probes=section)))


def test_plain_probes_have_no_correction() -> None:
    assert probe_correction(read_rig(RIG).record.probes, 3600, 0.0) is None


def test_pair_calibrated_on_the_plants_bench_tells_the_true_position_in_use() -> None:
    """The plant's probes are crooked and wrong in sensitivity; the record puts both right."""
    rig = read_rig(RIG).record
    section = msgspec.structs.replace(
        rig.simulation.plant,
        probe_misalignment_deg=(1.5, -0.8),
        probe_sensitivity_error_percent=(1.0, -1.5),
    )
    rig = msgspec.structs.replace(
        rig, simulation=msgspec.structs.replace(rig.simulation, plant=section)
    )
    plant = Plant(plant_constants(packaged_parameters(), rig), sample_rate_Hz=200.0)
    still = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 0.0)

    def volts(x_um: float, y_um: float) -> np.ndarray:
        plant.bench(0.0, (1e-6 * x_um, 1e-6 * y_um))
        samples = plant.advance(round(0.5 / plant.step_s), still)
        return np.array([samples.probe_1[5:].mean(), samples.probe_2[5:].mean()])

    procedure = begin(MEASURING, ProbePlan((1, 2), 800e-6, 11, 1))
    while not procedure.done:
        step = procedure.step
        if not step.series:
            procedure = procedure.set_up()
            continue
        at = 1e6 * step.value
        signal = volts(at, 0.0) if step.set_up == 1 else volts(0.0, at)
        procedure = procedure.record(signal, 0.0, 0.0)
    given = ProbeSettings("pair", 10.0, 0.5e-6, nominal=100e-6)
    pair = calibrate_pair(
        (probe_readings(procedure, 1), probe_readings(procedure, 2)), (given, given)
    )
    assert pair.accepted, pair.problems
    assert np.degrees(pair.alignment.angle) == pytest.approx([1.5, -0.8], abs=0.02)
    read = [
        found.sensitivity * (voltage - found.offset)
        for found, voltage in zip(pair.probes, volts(-500.0, 26.0), strict=True)
    ]
    told = 1e6 * (pair.alignment.matrix @ read)
    assert told == pytest.approx([-500.0, 26.0], abs=0.3)
    assert abs(1e6 * read[1] - 26.0) > 5.0


def test_report_takes_u_of_positions_from_the_file() -> None:
    kept = calibration_record(calibration())
    assert stated_uncertainties(kept) == pytest.approx({"probe_1": 1.3, "probe_2": 1.5})
    for unknown in ({}, {"probes": {}}, {"probes": {"uncertainty_um": [math.nan, math.nan]}}):
        assert stated_uncertainties(unknown) == {}
