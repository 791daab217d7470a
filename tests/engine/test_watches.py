"""Old samples and broken sensors end a test, and say why."""

from __future__ import annotations

import threading
from dataclasses import replace

import msgspec
import numpy as np
import pytest

from rigapp.config.recipe import TestFile
from rigapp.engine.samples.assembler import Assembler, EncoderSetup
from rigapp.engine.watches import DriveWatch
from rigapp.schema.messages import Alarm, FinishReason, Flag, RunState, Severity
from rigapp.schema.states import ENDED
from rigapp_drivers.api import Block, InputFault, InputFaultKind, Quality
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

LONG = 1_000_000


def slow_thinking(simulated: bool) -> MemoryRig:
    rig = MemoryRig(simulated=simulated)
    rig.engine._core.timing = replace(rig.timing, queue_age=600.0, silence=60.0)
    rig.engine.connect()
    return rig


def hold_up(rig: MemoryRig) -> threading.Event:
    """Let the processing thread wait with a block in its hand until the event is set."""
    connection = rig.engine._connection
    assert connection is not None
    free, real = threading.Event(), connection.rig.processor.handle

    def handle(block: Block) -> None:
        free.wait(60.0)
        real(block)

    connection.rig.processor.handle = handle  # type: ignore[method-assign]
    return free


def patient(revolutions: int) -> TestFile:
    """Return a test that forgives a reader that is held up."""
    test = a_test(revolutions)
    return msgspec.structs.replace(
        test, limits=msgspec.structs.replace(test.limits, stale_data_s=60.0)
    )


def limit_age(rig: MemoryRig) -> None:
    rig.engine._core.timing = replace(rig.engine._core.timing, queue_age=0.2)


def alarm(rig: MemoryRig, start: str) -> Alarm | None:
    return next((a for a in rig.engine.status().alarms if a.key.startswith(start)), None)


@pytest.mark.parametrize(("simulated", "silent_s"), [(False, 0.3), (True, 0.6)])
def test_a_simulated_drive_may_be_late_by_as_much_as_its_own_watchdog(
    simulated: bool, silent_s: float
) -> None:
    rig = MemoryRig(simulated=simulated)
    rig.engine.connect()
    connection = rig.engine._connection
    assert connection is not None
    watch = DriveWatch(rig.engine._core, connection.rig, 0.5)
    connection.rig.age_s = lambda since_s: silent_s - 0.01  # type: ignore[method-assign]
    connection.rig.control.poll = lambda: None  # type: ignore[method-assign]
    watch.ask()
    assert alarm(rig, "drive_silent") is None
    connection.rig.age_s = lambda since_s: silent_s + 0.01  # type: ignore[method-assign]
    watch.ask()
    assert alarm(rig, "drive_silent") is not None
    rig.engine.shutdown()


@pytest.mark.parametrize("simulated", [False, True])
def test_old_samples_switch_the_drive_off(simulated: bool) -> None:
    rig = slow_thinking(simulated)
    rig.start(patient(LONG))
    eventually(lambda: rig.engine.state is RunState.RUNNING, 60.0)
    free = hold_up(rig)
    limit_age(rig)
    eventually(lambda: ("off", 0.0) in rig.spindle.commands, 60.0)
    raised = alarm(rig, "queue_age")
    free.set()
    rig.engine.wait(ENDED, 60.0)
    assert raised is None or raised.severity is Severity.CRITICAL
    raised = alarm(rig, "queue_age")
    assert raised is not None
    assert all((raised.cause, raised.consequence, raised.action))
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.INTERNAL
    assert "waited" in outcome.sentence
    assert rig.is_stationary
    rig.engine.shutdown()


def test_simulated_samples_wait_on_the_wire_and_none_is_refused() -> None:
    rig = slow_thinking(simulated=True)
    connection = rig.engine._connection
    assert connection is not None
    connection.rig.paced_samples = 200
    rig.start(patient(LONG))
    eventually(lambda: rig.engine.state is RunState.RUNNING, 60.0)
    free = hold_up(rig)
    eventually(lambda: connection.rig.backed_up, 60.0)
    received = connection.rig.received_s
    eventually(lambda: connection.rig.queue_age_s() > 1.0, 60.0)
    assert connection.rig.received_s == received
    rows = len(rig.store.rows)
    free.set()
    eventually(lambda: len(rig.store.rows) > rows + 3, 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert (
        connection.rig.queue.refused_blocks == connection.rig.processor.assembler.lost_samples == 0
    )
    rig.engine.shutdown()


def supervised(rig: MemoryRig) -> list[InputFault]:
    faults: list[InputFault] = []
    rig.source.input_faults = lambda: tuple(faults)  # type: ignore[attr-defined]
    return faults


def test_a_broken_bridge_wire_ends_the_test() -> None:
    rig = MemoryRig()
    faults = supervised(rig)
    rig.engine.connect()
    rig.start(patient(LONG))
    eventually(lambda: len(rig.store.rows) >= 3, 60.0)
    words = "the bridge of analog_1 is broken"
    faults.append(InputFault(InputFaultKind.SENSOR_BROKEN, ("analog_1",), words, 1))
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.DEVICE
    assert words in outcome.sentence
    raised = alarm(rig, "input:")
    assert raised is not None
    assert raised.severity is Severity.CRITICAL
    assert "force_1" in raised.cause
    assert rig.is_stationary
    faults.clear()
    rig.engine.connect()
    cleared = alarm(rig, "input:")
    assert cleared is not None
    assert not cleared.active
    rig.engine.shutdown()


@pytest.mark.parametrize(
    ("kind", "inputs", "when", "title"),
    [
        (InputFaultKind.SENSOR_BROKEN, ("analog_3",), 1, "Sensor broken"),
        (InputFaultKind.SENSOR_BROKEN, ("analog_1",), 0, "Sensor broken before"),
        (InputFaultKind.STUCK, ("analog_2",), 1, "Input stuck"),
        (InputFaultKind.OUT_OF_RANGE, (), 1, "Input out of range"),
    ],
)
def test_other_faults_of_inputs_warn(
    kind: InputFaultKind, inputs: tuple[str, ...], when: int, title: str
) -> None:
    rig = MemoryRig()
    faults = supervised(rig)
    rig.engine.connect()
    rig.start(patient(8))
    eventually(lambda: len(rig.store.rows) >= 1, 60.0)
    faults.append(InputFault(kind, inputs, "something is wrong", when))
    eventually(lambda: alarm(rig, "input:") is not None, 60.0)
    raised = alarm(rig, "input:")
    assert raised is not None
    assert (raised.title, raised.severity) == (title, Severity.WARNING)
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.COMPLETE
    rig.engine.shutdown()


def test_the_alarm_of_a_saturated_further_input_ends_when_the_input_returns() -> None:
    rig = MemoryRig()
    faults = supervised(rig)
    rig.engine.connect()
    for time_ns in (1, 2):
        rig.source.quality = Quality.SATURATED
        faults.append(InputFault(InputFaultKind.SATURATED, ("analog_7",), "above", time_ns))
        eventually(lambda: any(one.active for one in rig.engine.status().alarms))
        processor = rig.engine._connection.rig.processor  # type: ignore[union-attr]
        later = processor.next_sample + 2000
        eventually(lambda p=processor, n=later: p.next_sample > n)  # type: ignore[misc]
        raised = alarm(rig, "input:saturated")
        assert raised is not None
        assert raised.active
        rig.source.quality = Quality.GOOD
        eventually(lambda: not any(one.active for one in rig.engine.status().alarms))
    rig.engine.shutdown()


def test_samples_of_a_broken_sensor_flag_their_revolution() -> None:
    turns = np.arange(4000) / 1000.0 + 0.3
    values = np.zeros((5, 4000), np.float32)
    values[4] = np.floor(turns * 360) % 360
    quality = np.zeros(4000, np.uint8)
    quality[1900:] = Quality.SENSOR_FAULT
    found = Assembler(EncoderSetup(360), 4, 960.0).push(
        Block("daq", 0, 0, 960.0, 0, values, quality)
    )
    assert [bool(one.flags & Flag.SENSOR_FAULT) for one in found] == [False, True, True]
