"""Signs, latency and statistics, against what is known in closed form and against numpy."""

from __future__ import annotations

import math
from typing import Any

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.config.errors import UnusableInput
from rigapp.config.rig import RigFile
from rigapp.engine.judging.checks import PeakForce
from rigapp.engine.samples.assembler import Assembler, EncoderSetup, Revolution
from rigapp.engine.values.calibrate import Calibration, Measured, calibrate, calibration_of
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.channels import BASE, STATISTICS
from rigapp.schema.messages import Flag
from rigapp_drivers.api import Block, ChannelSpec, StreamSetup
from tests.engine.calibrations import calibration_by_hand
from tests.engine.engine_doubles import MemoryRig

RATE = 960.0


def calibration(**changes: Any) -> Calibration:
    values: dict[str, Any] = {
        "encoder": EncoderSetup(3600),
        "sample_rate_Hz": RATE,
        "matrix": np.array([[200.0, 3.0], [-4.0, 190.0]]),
        "zero": np.array([0.01, -0.02]),
        "sensitivity": np.array([100.0, 90.0]),
        "probe_offset": np.array([0.1, -0.1]),
    }
    return calibration_by_hand(**{**values, **changes})


def revolutions(
    kind: Calibration, turns: np.ndarray, analog: np.ndarray, dtype: Any = np.float32
) -> list[Revolution]:
    """Cut a signal: analog (4, samples) against the shaft's turns (samples,)."""
    turn = kind.encoder.counts_per_revolution
    values = np.empty((5, turns.size), dtype)
    values[:4] = analog
    values[4] = np.floor(turns * turn + 1e-9) % turn
    assembler = Assembler(kind.encoder, 4, kind.sample_rate_Hz, kind.margins)
    block = Block("daq", 0, 0, kind.sample_rate_Hz, 0, values, np.zeros(turns.size, np.uint8))
    return assembler.push(block)


def steady(rpm: float = 30.0, seconds: float = 10.0) -> tuple[np.ndarray, np.ndarray]:
    time = np.arange(int(seconds * RATE)) / RATE
    return time, 0.3 + rpm / 60.0 * time


# --- calibration ---------------------------------------------------------------------------------


def test_the_joint_force_is_minus_the_force_on_the_pin() -> None:
    # A weight pulling the pin along e1 with 100 N: the pin pulls the follower with -100 N.
    kind = calibration(matrix=200.0 * np.eye(2), zero=np.zeros(2))
    _, turns = steady()
    analog = np.zeros((4, turns.size))
    analog[0] = 0.5
    one = calibrate(revolutions(kind, turns, analog)[0], kind)
    np.testing.assert_allclose(one["force_1"], -100.0)
    np.testing.assert_allclose(one["force_2"], 0.0)
    np.testing.assert_allclose(one["force"], 100.0)


def test_calibration_is_the_formula_of_the_file() -> None:
    kind = calibration(
        scale=np.array([0.5, 0.25, 2.0, 3.0]),
        offset=np.array([0.1, 0.2, 0.3, 0.4]),
        tare=np.array([0.003, 0.004]),
    )
    rng = np.random.default_rng(1)
    _, turns = steady()
    analog = rng.normal(size=(4, turns.size)).astype(np.float32)
    revolution = revolutions(kind, turns, analog)[2]
    one = calibrate(revolution, kind)
    index = revolution.sample_indices()
    scale, offset = (
        np.array([[getattr(w, key)] for w in kind.wires]) for key in ("scale", "offset")
    )
    signal, cell = analog[:, index].astype(float) * scale + offset, kind.load_cell
    on_pin = cell.matrix @ (signal[:2] - cell.zero[:, None] - cell.tare[:, None])
    np.testing.assert_allclose(one["force_1"], -on_pin[0])
    np.testing.assert_allclose(one["force_2"], -on_pin[1])
    np.testing.assert_allclose(one["probe_1"], 100.0 * (signal[2] - 0.1))
    np.testing.assert_allclose(one["probe_2"], 90.0 * (signal[3] + 0.1))
    np.testing.assert_allclose(one.time_s, index / RATE)


def test_angles_follow_index_angle_direction_and_quantised_counts() -> None:
    kind = calibration(index_angle_rad=math.radians(40.0))
    _, turns = steady()
    revolution = revolutions(kind, turns, np.zeros((4, turns.size)))[0]
    angle = np.degrees(calibrate(revolution, kind).angle_rad)
    true = 40.0 + 360.0 * (turns[revolution.sample_indices()] - 1.0)
    assert np.all(true - angle >= -1e-9)
    assert np.all(true - angle < 0.1 + 1e-9)


@pytest.mark.parametrize("latency_ms", [0.0, 0.4, 1.0, 2.5, 25.0, -1.7])
@pytest.mark.parametrize("rpm", [30.0, 300.0])
def test_latency_is_taken_out(latency_ms: float, rpm: float) -> None:
    kind = calibration(latency_s=np.full(4, latency_ms * 1e-3), zero=np.zeros(2))
    time, turns = steady(rpm, 6.0)
    delayed = 2 * np.pi * (0.3 + rpm / 60.0 * (time - latency_ms * 1e-3))
    analog = np.tile(np.cos(delayed), (4, 1))
    found = revolutions(kind, turns, analog)
    assert len(found) >= 2
    for revolution in found:
        one = calibrate(revolution, kind)
        true = np.cos(2 * np.pi * turns[revolution.sample_indices()])
        tolerance = 0.02 * (rpm / 300.0) ** 2 + 1e-4
        np.testing.assert_allclose(one["probe_1"], 100.0 * (true - 0.1), atol=100 * tolerance)


def test_channels_have_latencies_of_their_own() -> None:
    latency = np.array([0.0, 1.0, 3.3, 10.0]) * 1e-3
    kind = calibration(latency_s=latency, matrix=200 * np.eye(2), zero=np.zeros(2))
    time, turns = steady(60.0)
    analog = np.stack([np.sin(2 * np.pi * (time - one)) for one in latency])
    revolution = revolutions(kind, turns, analog)[3]
    one = calibrate(revolution, kind)
    true = np.sin(2 * np.pi * time[revolution.sample_indices()])
    for got, factor, zero in (
        (one["force_1"], -200.0, 0.0),
        (one["force_2"], -200.0, 0.0),
        (one["probe_1"], 100.0, 0.1),
        (one["probe_2"], 90.0, -0.1),
    ):
        np.testing.assert_allclose(got, factor * (true - zero), atol=abs(factor) * 2e-3)


def rig_with(**sections: dict[str, Any]) -> RigFile:
    rig = MemoryRig().rig_file()
    for name, changes in sections.items():
        section = msgspec.structs.replace(getattr(rig, name), **changes)
        rig = msgspec.structs.replace(rig, **{name: section})
    return rig


SETUP = StreamSetup(
    tuple(
        ChannelSpec(name, unit)
        for name, unit in (
            ("analog_1", "mV/V"),
            ("analog_2", "mV/V"),
            ("analog_3", "V"),
            ("analog_4", "V"),
            ("counter_1", "count"),
        )
    ),
    480.0,
    {},
)


@pytest.mark.parametrize(
    ("section", "change", "words"),
    [
        ("load_cell", {"matrix_N_per_mV_per_V": ((1.0, 2.0), (2.0, 4.0))}, "cannot be inverted"),
        ("load_cell", {"matrix_N_per_mV_per_V": ((math.nan, 0.0), (0.0, 1.0))}, "not a finite"),
        ("load_cell", {"zero_mV_per_V": (math.inf, 0.0)}, "zero_mV_per_V"),
        ("load_cell", {"latency_ms": (1.0, 1000.0)}, "latency_ms"),
        ("load_cell", {"input_2": "analog_9"}, "load_cell.input_2 = 'analog_9'"),
        ("probes", {"sensitivity_um_per_V": (0.0, 1.0)}, "outside 0.001"),
        ("encoder", {"input": "counter_7"}, "encoder.input"),
    ],
)
def test_an_unusable_calibration_is_refused(
    section: str, change: dict[str, Any], words: str
) -> None:
    with pytest.raises(UnusableInput, match=words):
        calibration_of(rig_with(**{section: change}), SETUP)


def test_counts_before_quadrature_are_times_four() -> None:
    found = calibration_of(rig_with(encoder={"quadrature": "before"}), SETUP)
    assert found.encoder.counts_per_revolution == 4 * 360


# --- statistics ----------------------------------------------------------------------------------


def expected_row(revolution: Revolution, kind: Calibration) -> dict[str, float]:
    one = calibrate(revolution, kind)
    angle = np.degrees(one.angle_rad) % 360.0
    found: dict[str, float] = {}
    for name in [one.name for one in BASE.channels]:
        values = one[name]
        found[f"{name}_max"] = values.max()
        found[f"{name}_min"] = values.min()
        found[f"{name}_rms"] = math.sqrt(np.mean(values**2))
        found[f"{name}_mean"] = values.mean()
        found[f"{name}_angle_of_max"] = angle[values.argmax()]
    return found


@settings(max_examples=25, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.floats(20.0, 3000.0),
    st.sampled_from([0.0, 0.4e-3, 1e-3, -0.7e-3]),
    st.sampled_from([np.float32, np.int32]),
)
def test_statistics_agree_with_numpy(seed: int, rpm: float, latency_s: float, dtype: Any) -> None:
    rng = np.random.default_rng(seed)
    kind = calibration(
        latency_s=latency_s * np.array([1.0, 1.0, 0.5, 2.0]),
        index_angle_rad=rng.uniform(0, 6),
        scale=rng.uniform(0.1, 2, 4),
        offset=rng.normal(size=4),
    )
    _, turns = steady(rpm, 60 / rpm * 4)
    analog = rng.normal(scale=100, size=(4, turns.size))
    reducer = Reducer(kind)
    for revolution in revolutions(kind, turns, analog, dtype):
        row = reducer.reduce(Measured(revolution, kind))
        assert row[BASE.place["samples"]] == revolution.samples
        for name, value in expected_row(revolution, kind).items():
            assert row[BASE.place[name]] == pytest.approx(value, rel=1e-12, abs=1e-9), name


@pytest.mark.parametrize("rpm", [3.0, 30.0, 300.0, 2000.0])
def test_speed_is_not_a_difference_of_quantised_counts(rpm: float) -> None:
    kind = calibration()
    time = np.arange(int(60 / rpm * 6 * RATE)) / RATE
    ripple = 0.02
    rev_per_s = rpm / 60.0
    turns = 0.3 + rev_per_s * time
    turns = turns + ripple / (2 * np.pi) * np.sin(2 * np.pi * turns)
    second = revolutions(kind, turns, np.zeros((4, turns.size)))[1]
    row = Reducer(kind).reduce(Measured(second, kind))
    assert row[BASE.place["speed"]] == pytest.approx(rpm, rel=6e-4)
    if rpm <= 300.0:
        assert row[BASE.place["speed_max"]] == pytest.approx(rpm * (1 + ripple), rel=4e-3)
        assert row[BASE.place["speed_min"]] == pytest.approx(rpm * (1 - ripple), rel=4e-3)
        assert row[BASE.place["speed_rms"]] == pytest.approx(rpm, rel=1e-3)


def test_a_stand_counts_in_the_lowest_speed_and_not_in_the_mean() -> None:
    kind = calibration()
    rev_per_s = 2.0
    walk = np.arange(int(RATE * 1.2)) / RATE * rev_per_s
    turns = 0.3 + np.concatenate([walk, np.full(int(RATE * 30), walk[-1]), walk[-1] + walk])
    found = revolutions(kind, turns, np.zeros((4, turns.size)))
    row = Reducer(kind).reduce(Measured(next(r for r in found if r.flags & Flag.PAUSED), kind))
    assert row[BASE.place["speed_min"]] == 0.0
    assert row[BASE.place["speed_max"]] == pytest.approx(120.0, rel=5e-3)
    assert 20.0 < row[BASE.place["speed"]] < 40.0  # two seconds of the stand are kept


def test_a_missing_margin_holds_the_nearest_sample() -> None:
    kind = calibration(latency_s=np.full(4, 5e-3))
    time, turns = steady(60.0)
    values = np.zeros((5, turns.size), np.float32)
    values[0] = np.sin(time)
    values[4] = np.floor(turns * 3600) % 3600
    edge = int(np.flatnonzero(np.diff(np.floor(turns)) > 0)[3] + 1)
    assembler = Assembler(kind.encoder, 4, RATE, kind.margins)
    head = Block("daq", 0, 0, RATE, 0, values[:, : edge + 2].copy(), np.zeros(edge + 2, np.uint8))
    tail = Block(
        "daq", 1, edge + 42, RATE, 0, values[:, edge + 42 :].copy(),
        np.zeros(turns.size - edge - 42, np.uint8), 40,
    )  # fmt: skip
    found = assembler.push(head) + assembler.push(tail)
    last = next(r for r in found if r.end_sample == edge)
    assert last.values.shape[1] - last.before - last.samples == 2
    row = Reducer(kind).reduce(Measured(last, kind))
    expected = expected_row(last, kind)
    assert row[BASE.place["force_1_max"]] == pytest.approx(expected["force_1_max"])
    assert row[BASE.place["force_1_angle_of_max"]] == pytest.approx(
        expected["force_1_angle_of_max"]
    )


def test_the_peak_of_a_block_is_found_in_any_sample() -> None:
    kind = calibration(matrix=200 * np.eye(2), zero=np.zeros(2))
    values = np.zeros((5, 100), np.float32)
    values[0, 63], values[1, 63] = 1.2, -1.6
    assert PeakForce(kind).of(values) == pytest.approx(400.0)
    values[1, 99] = np.nan
    assert math.isnan(PeakForce(kind).of(values))
    whole = np.zeros((5, 10), np.int32)
    whole[0, 3] = 2
    assert PeakForce(kind).of(whole) == pytest.approx(400.0)


def test_statistics_are_where_the_columns_say() -> None:
    assert len(BASE.names) == 10 + len([one.name for one in BASE.channels]) * len(STATISTICS)
    assert BASE.place["force_1_max"] == 10
    assert BASE.place["probe_2_angle_of_max"] == len(BASE.names) - 1
