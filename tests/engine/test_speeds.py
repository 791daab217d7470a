"""Drive and encoder are compared at the set speed, and in ramps where lateness explains nothing."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from rigapp.engine.judging.checks import ANSWERS, LATE_S, SpeedComparison
from rigapp.schema.messages import FinishReason, RunState
from rigapp.schema.states import ENDED
from rigapp_drivers.api import Block
from tests.engine.engine_doubles import BLOCK, RATE, MemoryRig, a_test

TARGET_RPM = 60.0


def ramp(ratio: float, rpm_per_s: float, late_s: float, period_s: float = 0.1) -> float | None:
    """Return the rpm at which a ramp is found wrong; the drive's speed is late_s old."""
    one = SpeedComparison()
    one.begin()
    time_s = period_s
    while rpm_per_s * time_s <= TARGET_RPM:
        true_rpm, drive_rpm = rpm_per_s * time_s, rpm_per_s * max(0.0, time_s - late_s)
        if one.differs(time_s, ratio * true_rpm, drive_rpm, TARGET_RPM, rpm_per_s * LATE_S):
            return true_rpm
        time_s += period_s
    return None


@given(st.floats(1.0, 300.0), st.floats(-0.1, LATE_S))
def test_a_right_ramp_is_never_found_wrong(rpm_per_s: float, late_s: float) -> None:
    assert ramp(1.0, rpm_per_s, late_s) is None


@pytest.mark.parametrize("ratio", [0.25, 0.5, 2.0, 4.0])
def test_a_wrong_number_of_counts_is_found_in_the_ramp(ratio: float) -> None:
    found = ramp(ratio, 20.0, 0.15)
    assert found is not None
    assert found < TARGET_RPM


def test_agreement_in_a_ramp_decides_nothing() -> None:
    one = SpeedComparison()
    one.begin()
    for answer in range(3 * ANSWERS):
        assert not one.differs(answer + 0.5, 30.0, 30.0, TARGET_RPM, 15.0)
    assert not one.decided
    wrong = [one.differs(100.0 + answer, 60.0, 45.0, TARGET_RPM) for answer in range(ANSWERS)]
    assert wrong == [False] * (ANSWERS - 1) + [True]


def test_a_test_that_ends_in_its_ramp_ends_by_the_speeds(monkeypatch: pytest.MonkeyPatch) -> None:
    rig = MemoryRig()
    read = rig.source.read

    def in_real_time(timeout_s: float) -> Block | None:
        time.sleep(BLOCK / RATE)
        return read(timeout_s)

    monkeypatch.setattr(rig.source, "read", in_real_time)
    rig.spindle.tells_ratio = 0.25
    rig.engine.connect()
    test = a_test(2)
    test = replace(test, run=replace(test.run, acceleration_rpm_per_s=30.0))
    rig.start(test)
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.DEVICE
    assert "encoder.counts_per_revolution" in rig.engine.outcome.sentence
    assert RunState.RUNNING not in [event.after for event in rig.store.events]
    rig.engine.shutdown()
