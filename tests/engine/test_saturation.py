"""An input at the end of its range is told as that, and a weight without a test is no overload."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from rigapp.engine.judging.checks import BACK_S, STAYS_S, SaturationWatch
from rigapp.engine.samples.assembler import EncoderSetup
from rigapp.schema.messages import Alarm, FinishReason, Flag, RunState, Severity
from rigapp.schema.states import ENDED, Refused
from rigapp_drivers.api import InputFault, InputFaultKind
from tests.engine.calibrations import calibration_by_hand
from tests.engine.engine_doubles import BLOCK, COUNTS, RATE, MemoryRig, a_test, eventually

LONG = 1_000_000


@pytest.fixture
def rig() -> Iterator[MemoryRig]:
    memory = MemoryRig()
    memory.engine.connect()
    yield memory
    memory.engine.shutdown(20.0)


def alarms(rig: MemoryRig) -> dict[str, Alarm]:
    return {alarm.key: alarm for alarm in rig.engine.status().alarms}


def looked(rig: MemoryRig, blocks: int = 12) -> None:
    """Wait until the engine has seen some more blocks."""
    reads = rig.source.reads
    eventually(lambda: rig.source.reads > reads + blocks, 60.0)


@pytest.mark.parametrize(("row", "name"), [(0, "force_1"), (1, "force_2")])
def test_a_saturated_load_cell_ends_the_test_by_its_own_name_and_returns(
    rig: MemoryRig, row: int, name: str
) -> None:
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 3)
    rig.source.saturated = row
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.DEVICE
    assert f"{name} (analog_{row + 1} of daq) is at the end of its range, 3.5 mV/V" in (
        outcome.sentence
    )
    assert next(what for what, speed in rig.spindle.commands if speed == 0.0) == "off"
    assert rig.is_stationary
    key = f"saturated:{name}"
    assert set(alarms(rig)) == {key}  # and no overload of 735 N
    assert alarms(rig)[key].active
    with pytest.raises(Refused, match="still active"):
        rig.engine.reset("Ada")
    rig.source.saturated = None
    eventually(lambda: not alarms(rig)[key].active)
    rig.engine.acknowledge(operator="Ada")
    rig.engine.reset("Ada")
    rig.start(a_test(3))
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.COMPLETE


@pytest.mark.parametrize("at", [0, 20, BLOCK - 1])
def test_a_jam_beyond_the_range_is_an_overload_and_no_cable(rig: MemoryRig, at: int) -> None:
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 3)
    rig.source.jam_at = at
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.LIMIT
    assert "at least 73" in outcome.sentence  # 1.05 times 3.5 mV/V by 200 N
    assert set(alarms(rig)) == {"overload:beyond_range"}
    assert next(what for what, speed in rig.spindle.commands if speed == 0.0) == "off"
    rig.crank.jammed = False
    rig.engine.acknowledge(operator="Ada")
    rig.engine.reset("Ada")
    assert rig.engine.state is RunState.READY


def test_a_force_that_is_measured_stays_an_overload_though_a_probe_is_cut_off(
    rig: MemoryRig,
) -> None:
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 3)
    rig.source.saturated = 2
    rig.source.force_N = 390.0
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.LIMIT
    assert "390.0 N" in rig.engine.outcome.sentence


def test_a_saturated_probe_warns_while_it_is_and_the_test_goes_on(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 3)
    rig.source.saturated = 2
    eventually(lambda: "input_saturated:probe_1" in alarms(rig))
    raised = alarms(rig)["input_saturated:probe_1"]
    assert raised.severity is Severity.WARNING
    assert "analog_3 of daq" in raised.cause
    assert rig.engine.state is not RunState.STOPPING
    rig.source.saturated = None
    eventually(lambda: not alarms(rig)["input_saturated:probe_1"].active)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert np.any(rig.store.column("quality").astype(int) & Flag.SATURATED)


def test_a_weight_without_a_test_raises_no_overload_and_leaves_the_last_one(
    rig: MemoryRig,
) -> None:
    rig.source.force_N = 392.4  # 40 kg at rest, before any test
    looked(rig)
    assert not alarms(rig)
    with pytest.raises(Refused, match=r"the load cell shows 392 N, limits\.overload_N is 380 N"):
        rig.start(a_test(3))
    rig.source.force_N = 50.0
    eventually(lambda: rig.engine._connection.rig.processor.force_N < 60.0)  # type: ignore[union-attr]
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 3)
    rig.source.force_N = 392.4
    rig.engine.wait(ENDED, 60.0)
    assert alarms(rig)["overload"].state == "latched"  # the weight still hangs
    rig.engine.acknowledge(operator="Ada")
    rig.engine.reset("Ada")
    looked(rig)
    assert not alarms(rig)
    assert rig.engine.state is RunState.READY


def test_a_saturated_input_without_a_test_warns_keeps_from_starting_and_returns(
    rig: MemoryRig,
) -> None:
    rig.source.saturated = 0
    eventually(lambda: "input_saturated:force_1" in alarms(rig))
    assert alarms(rig)["input_saturated:force_1"].severity is Severity.WARNING
    assert rig.engine.state is RunState.READY
    assert "force_1 at the end of the range" in rig.engine.status().recovery.sentence
    with pytest.raises(Refused, match="force_1 at the end of the range"):
        rig.start(a_test(3))
    rig.source.saturated = None
    eventually(lambda: not alarms(rig)["input_saturated:force_1"].active)


def test_what_the_device_says_of_the_same_input_is_no_second_alarm(rig: MemoryRig) -> None:
    faults: list[InputFault] = []
    rig.source.input_faults = lambda: tuple(faults)  # type: ignore[attr-defined]
    faults.append(InputFault(InputFaultKind.SATURATED, ("analog_1",), "input saturated", 1))
    looked(rig)
    assert not alarms(rig)
    faults.append(InputFault(InputFaultKind.SATURATED, ("analog_7",), "input saturated", 1))
    eventually(lambda: bool(alarms(rig)))
    assert list(alarms(rig)) == ["input:saturated:analog_7"]


def test_a_spike_is_no_saturated_input() -> None:
    kind = calibration_by_hand(
        encoder=EncoderSetup(COUNTS), sample_rate_Hz=RATE, matrix=np.eye(2), sensitivity=np.ones(2)
    )
    watch = SaturationWatch(kind)
    stays, back = round(STAYS_S * RATE), round(BACK_S * RATE)
    full = np.zeros((4, stays - 1), np.bool_)
    full[1] = True
    assert not watch.look(full, stays - 1)
    assert not watch.look(None, 1)
    assert not watch.look(full, stays - 1)
    assert not watch.inputs
    assert watch.look(np.ones((4, 1), np.bool_), 1)
    assert watch.inputs == {"force_2"}
    assert not watch.look(None, back - 1)
    assert watch.look(None, 1)
    assert not watch.inputs
