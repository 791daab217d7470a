"""An answer that is no number is no value: nothing is compared with it, and a limit says so."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from test_channels import ChannelRig, WiredSource, heard

from rigapp.config.parameters import PairingSection
from rigapp.config.recipe import LimitRule, StopSection
from rigapp.engine.drive.sequences import StandstillEvidence
from rigapp.engine.judging.criteria import StopMonitor
from rigapp.engine.judging.depthwatch import DepthWatch
from rigapp.engine.judging.jointwatch import STAYS, JointWatch
from rigapp.engine.judging.limits import LevelPassed, RuleMonitor
from rigapp.engine.samples import slow
from rigapp.engine.values.reduce import LANES, _extremes_and_moments
from rigapp.schema.channels import BASE
from rigapp.schema.messages import FinishReason
from rigapp.schema.states import ENDED
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

LONG = 1_000_000
NO_NUMBERS = (math.nan, math.inf, -math.inf)


@pytest.fixture
def rig(monkeypatch: pytest.MonkeyPatch) -> Iterator[ChannelRig]:
    monkeypatch.setattr(slow, "PERIOD_S", 0.01)
    monkeypatch.setattr(slow, "SILENT_S", 0.3)
    rig = ChannelRig()
    rig.engine.connect()
    yield rig
    rig.engine.shutdown()


def ends_without_a_value(rig: ChannelRig, quantity: str) -> None:
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.LIMIT
    assert f"{quantity} has had no value" in outcome.sentence
    assert rig.is_stationary


@pytest.mark.sampled
@pytest.mark.parametrize("answer", NO_NUMBERS)
def test_a_limited_slow_channel_that_tells_no_number(rig: ChannelRig, answer: float) -> None:
    eventually(heard(rig.engine, "room_temperature"))
    rule = LimitRule("room_temperature", critical_above=60.0, action_critical="stop")
    rig.start(a_test(LONG, rules=(rule,)))
    eventually(lambda: rig.store.rows)
    rig.thermometer.told = {"temperature_C": answer}
    ends_without_a_value(rig, "room_temperature")


@pytest.mark.sampled
@pytest.mark.parametrize("answer", NO_NUMBERS)
def test_a_limited_quantity_of_the_drive_that_is_no_number(rig: ChannelRig, answer: float) -> None:
    rule = LimitRule("motor_current", critical_above=60.0, action_critical="stop")
    rig.start(a_test(LONG, rules=(rule,)))
    eventually(lambda: rig.store.rows)
    status = rig.spindle.status
    rig.spindle.status = lambda: dataclasses.replace(  # type: ignore[method-assign]
        status(), current_A=answer
    )
    ends_without_a_value(rig, "motor_current")


@pytest.mark.parametrize("bad", [1, 48], ids=["one sample", "all"])
def test_a_limited_sampled_channel_that_is_no_number(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch, bad: int
) -> None:
    monkeypatch.setattr(slow, "SILENT_S", 1.5)
    rule = LimitRule("bushing_temperature_max", critical_above=60.0, action_critical="stop")
    rig.start(a_test(LONG, rules=(rule,)))
    eventually(lambda: rig.store.rows)
    read = rig.source.read

    def garbled(timeout_s: float) -> Any:
        block = read(timeout_s)
        if block is not None:
            block.values[5, -bad:] = math.nan
        return block

    assert isinstance(rig.source, WiredSource)
    rig.source.read = garbled  # type: ignore[method-assign]
    ends_without_a_value(rig, "bushing_temperature_max")


def test_a_passing_gap_of_numbers_is_no_alarm_and_limits_go_on() -> None:
    monitor = RuleMonitor((LimitRule("bushing_max", critical_above=60.0, critical_below=0.0),))

    def judged(time_s: float, value: float, mean: float = 1.0) -> list[tuple[bool, str]]:
        row = {"time": time_s, "bushing_max": value, "bushing_mean": mean}
        return [(one.active, one.cause.key) for one in monitor.judge(row)]

    assert judged(0.0, 20.0) == []
    assert judged(5.0, math.nan) == []
    assert judged(14.0, math.nan, math.nan) == []
    assert judged(14.5, 20.0) == []
    assert judged(20.0, 20.0, math.nan) == []  # one sample of the revolution was no number
    missing = [(True, f"rule:bushing_max:critical:{side}:missing") for side in ("above", "below")]
    assert sorted(judged(31.0, 20.0, math.nan)) == missing
    assert (True, "rule:bushing_max:critical:above") in judged(32.0, 70.0, math.nan)
    assert judged(33.0, math.nan) == []  # nothing has returned by it
    ended = judged(34.0, 20.0)
    assert {active for active, _ in ended} == {False}
    assert len(ended) == 3


@pytest.mark.parametrize("above", [True, False])
def test_an_infinite_value_passes_its_limit_and_never_comes_back_from_it(above: bool) -> None:
    rule = (
        LimitRule("x_max", critical_above=60.0) if above else LimitRule("x_max", critical_below=0.0)
    )
    monitor = RuleMonitor((rule,))
    beyond = math.inf if above else -math.inf

    def judged(value: float) -> list[LevelPassed]:
        return monitor.judge({"time": 0.0, "x_max": value})

    assert judged(-beyond) == []
    assert [one.active for one in judged(beyond)] == [True]
    assert judged(-beyond) == []
    assert [one.active for one in judged(20.0)] == [False]


@pytest.mark.parametrize("force_N", NO_NUMBERS)
def test_a_force_that_is_no_number_takes_the_power_off(force_N: float) -> None:
    rig = MemoryRig()
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: rig.store.rows)
    rig.source.force_N = force_N
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert "not a number" in rig.engine.outcome.sentence
    assert rig.is_stationary
    rig.source.force_N = 50.0
    rig.engine.shutdown()


@pytest.mark.parametrize("speed", NO_NUMBERS)
def test_a_drive_without_a_speed_is_no_witness_of_a_standstill(speed: float) -> None:
    rig = MemoryRig()
    rig.engine.connect()
    status = rig.spindle.status
    rig.spindle.status = lambda: dataclasses.replace(  # type: ignore[method-assign]
        status(), speed_rev_per_s=speed
    )
    connection = rig.engine._connection
    assert connection is not None
    before = rig.spindle.polls
    eventually(lambda: rig.spindle.polls > before + 2)
    seen: StandstillEvidence = connection.rig.control.seen()
    if math.isnan(speed):
        assert seen.drive_rpm is None
    else:
        assert seen.moves
        assert not seen.is_stationary
    rig.source.silent = True
    rig.engine.shutdown()


def test_a_criterion_is_not_met_by_a_value_that_is_no_number() -> None:
    monitor = StopMonitor(
        StopSection(
            force_N=100.0, force_revolutions=1, wear_depth_um=50.0, wear_depth_revolutions=1
        )
    )
    for number in range(1, 300):
        row = np.full(len(BASE.names), math.nan)
        for name, value in (("revolution", number), ("quality", 0), ("speed", 60.0), ("time", 1.0)):
            row[BASE.place[name]] = value
        row[BASE.place["force_max"]] = math.inf
        assert monitor.row(row) is None
        depth = {"measured_wear_depth": math.inf, "measured_wear_depth_uncertainty": 1e-3}
        assert monitor.prediction(number, depth) is None
    assert set(monitor.no_data()) == {"force_N", "wear_depth_um"}


def test_a_depth_that_is_infinite_is_not_what_others_are_compared_with() -> None:
    watch = DepthWatch()
    names = ("measured_wear_depth", "measured_wear_depth_uncertainty", "driven_wear_depth")

    def look(depth_mm: float) -> list[str]:
        values = dict(zip(names, (depth_mm, 1e-3, 0.01), strict=True))
        return [one.key for one in watch.look(1, values)]

    for depth_mm in (math.inf, -math.inf, math.nan, 0.01, math.inf, 0.01, 0.01, 0.01):
        assert look(depth_mm) == []
    assert not watch.doubtful


def test_a_pairing_that_has_left_its_range_is_not_back_by_values_that_are_none() -> None:
    watch = JointWatch(PairingSection(sliding_speed_high_m_per_s=1.0))
    others = ("pressure_velocity_max", "nominal_pressure_max", "wear_departure_revolution")

    def look(value: float) -> list[str]:
        row = dict.fromkeys(others, math.nan) | {"sliding_speed_max": value}
        return [one if isinstance(one, str) else one.key for one in watch.look(row)]

    told = [look(2.0) for _ in range(STAYS)]
    assert told[-1] == ["pairing_left"]
    assert all(look(math.nan) == [] for _ in range(3 * STAYS))
    assert [look(0.5) for _ in range(STAYS)][-1] == ["pairing_left"]


@pytest.mark.parametrize("samples", [9, 3 * LANES + 5])
def test_extremes_are_those_of_the_numbers_among_the_samples(samples: int) -> None:
    counts = np.arange(samples, dtype=np.int64)
    out, lanes = np.empty(5), np.empty((4, LANES))
    for place in range(samples):
        x = np.arange(float(samples))[::-1].copy()
        x[place] = math.nan
        _extremes_and_moments(x, samples, counts, 1.0, 0.0, lanes, out)
        assert out[:2].tolist() == [np.nanmax(x), np.nanmin(x)]
        assert np.isnan(out[2:4]).all(), "RMS and mean tell that one was none"
        assert out[4] == float(place == 0)
    nothing = np.full(samples, math.nan)
    _extremes_and_moments(nothing, samples, counts, 1.0, 0.0, lanes, out)
    assert np.isnan(out[:4]).all()
