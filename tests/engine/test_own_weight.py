"""What the pin itself weighs is no force of the joint: it is taken off by the angle, everywhere."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from rigapp.config.loading import read_rig
from rigapp.engine.judging.checks import PeakForce
from rigapp.engine.processing import Processor
from rigapp.engine.recording.store import calibration_record
from rigapp.engine.samples.assembler import Assembler, EncoderSetup
from rigapp.engine.values.calibrate import Calibration, Measured, calibrate
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.channels import BASE
from rigapp_drivers.api import Block
from tests.engine.calibrations import calibration_by_hand

WEIGHT_N = 20.0
UPRIGHT = (0.0, -9.80665)
RATE = 960.0


def cell(weight_N: float = WEIGHT_N, bend: float = 0.0) -> Calibration:
    kind = calibration_by_hand(
        encoder=EncoderSetup(3600),
        sample_rate_Hz=RATE,
        matrix=np.array([[200.0, 3.0], [-4.0, 190.0]]),
        sensitivity=np.array([100.0, 90.0]),
        zero=np.array([0.01, -0.02]),
        quadratic_terms=np.full((2, 3), bend),
        index_angle_rad=0.3,
    )
    return replace(kind, load_cell=replace(kind.load_cell, pin_weight=weight_N))


def felt(kind: Calibration, angle: np.ndarray, joint: tuple[float, float]) -> np.ndarray:
    """Return the signals (2, n) of a cell that feels a joint force and a weight that hangs down.

    By the calibration's own law: a weight has the force W (-sin t, -cos t) on the pin.
    """
    on_pin = -np.array(joint)[:, None] - WEIGHT_N * np.array([np.sin(angle), np.cos(angle)])
    force = -on_pin
    one, two = force
    linear = force - kind.load_cell.quadratic_terms @ np.array([one * one, one * two, two * two])
    return np.linalg.solve(kind.load_cell.matrix, -linear) + kind.load_cell.zero[:, None]


def turning(kind: Calibration, joint: tuple[float, float], seconds: float = 3.0) -> Block:
    count = np.floor(np.arange(round(seconds * RATE)) / RATE * 3600.0)
    values = np.zeros((5, count.size), np.float32)
    angle = kind.index_angle_rad + count * (2.0 * math.pi / 3600.0)
    values[:2] = felt(kind, angle, joint)
    values[4] = count % 3600.0
    return Block("daq", 0, 0, RATE, 0, values, np.zeros(count.size, np.uint8))


@pytest.mark.parametrize("bend", [0.0, 2e-5])
def test_revolution_row_live_value_and_overload_have_the_joint_s_force(bend: float) -> None:
    kind = cell(bend=bend).under(UPRIGHT)
    joint = (60.0, -80.0)
    block = turning(kind, joint)
    revolution = Assembler(kind.encoder, 4, RATE, kind.margins).push(block)[0]
    told = calibrate(revolution, kind)
    near = pytest.approx
    assert told["force_1"] == near(60.0, abs=1e-3)
    assert told["force_2"] == near(-80.0, abs=1e-3)
    assert told["force"] == near(100.0, abs=1e-3)
    row = Reducer(kind).reduce(Measured(revolution, kind))
    for name, value in (("force_1", 60.0), ("force_2", -80.0), ("force", 100.0)):
        for statistic in ("max", "min", "mean"):
            assert row[BASE.place[f"{name}_{statistic}"]] == near(value, abs=1e-3)

    seen: list[float] = []
    names = ("begun", "calm", "motion", "revolution", "lost", "saturated")
    monitor = SimpleNamespace(
        overload=lambda force_N, beyond_range: seen.append(force_N),
        **{name: lambda *_: None for name in names},
    )
    processor = Processor(kind, lambda: 99.0, False)
    processor.monitor = monitor
    for first in range(0, block.values.shape[1], 96):
        part = block.values[:, first : first + 96].copy()
        processor.handle(Block("daq", first // 96, first, RATE, 0, part, np.zeros(96, np.uint8)))
    assert seen[-1] == near(100.0, abs=0.2)
    assert processor.live is not None
    live = processor.live.values
    assert [live["force_1"], live["force_2"]] == near([60.0, -80.0], abs=1e-3)
    # What the angle is not known of yet stays in the force.
    assert PeakForce(kind).of(block.values) == near(120.0, abs=0.1)


@pytest.mark.parametrize("gravity", [(0.0, -9.80665), (9.80665, 0.0), (-4.0, 3.0), (0.0, 0.0)])
def test_the_plane_of_a_test_says_how_much_of_the_weight_acts(gravity: tuple[float, float]) -> None:
    kind = cell().under(gravity)
    angle = np.linspace(0.0, 6.0, 7)
    x, y = np.array(gravity) * WEIGHT_N / 9.80665
    c, s = np.cos(angle), np.sin(angle)
    np.testing.assert_allclose(
        kind.load_cell.own_weight(angle), [x * c + y * s, y * c - x * s], atol=1e-12
    )
    if gravity == (0.0, 0.0):
        assert kind.own_weight.shape == (2, 0)


@pytest.mark.parametrize("degrees", [0.0, 77.0, 200.0])
def test_a_zero_holds_the_weight_at_its_own_angle(degrees: float) -> None:
    angle = math.radians(degrees)
    kind = cell()
    at_rest = felt(kind, np.array([angle]), (0.0, 0.0))[:, 0]
    kind = kind.with_tare(at_rest - kind.load_cell.zero, angle).under(UPRIGHT)
    revolution = Assembler(kind.encoder, 4, RATE, kind.margins).push(turning(kind, (30.0, 40.0)))[0]
    told = calibrate(revolution, kind)
    assert told["force_1"] == pytest.approx(30.0, abs=1e-3)
    assert told["force_2"] == pytest.approx(40.0, abs=1e-3)
    # A later tare, of which the angle is not known, takes nothing off.
    assert kind.with_tare([0.0, 0.0]).load_cell.tare_angle is None


def test_the_file_tells_what_was_taken_off() -> None:
    kind = cell().with_tare([0.01, 0.02], math.radians(30.0)).under(UPRIGHT)
    told = calibration_record(kind)["load_cell"]
    assert told["pin_weight_in_plane_N"] == pytest.approx([0.0, -WEIGHT_N])
    assert told["tare_crank_angle_deg"] == pytest.approx(30.0)
    assert "tare_crank_angle_deg" not in calibration_record(cell())["load_cell"]


def test_a_rig_without_a_record_may_state_the_weight() -> None:
    rig = Path(__file__).parents[2] / "examples" / "simulated.toml"
    assert read_rig(rig).record.load_cell.pin_weight_N == 0.0
