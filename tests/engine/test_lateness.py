"""A computer that is overloaded is late with everything; simulated devices are not blamed."""

from __future__ import annotations

import time

import msgspec
import pytest

from rigapp.engine.drive.timing import Timing
from rigapp.process.processclock import Lateness
from rigapp.schema.messages import RunState
from rigapp.schema.states import InFault
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

PERIOD_S = 0.05


def loop(lateness: Lateness, begin_s: float, passes: int, late_s: float) -> float:
    """Let a loop pass that is woken late; return when it is through."""
    for _ in range(passes):
        begin_s += PERIOD_S + late_s
        lateness.tick(begin_s, 0.0, PERIOD_S)
    return begin_s


def test_lateness_is_what_a_loop_waited_for_beyond_its_own_wait() -> None:
    lateness = Lateness(100.0, 0.0)
    idle_s = loop(lateness, 100.0, 100, 0.0)
    assert lateness.since(100.0, idle_s) == pytest.approx(0.0, abs=1e-9)
    loaded_s = loop(lateness, idle_s, 10, 0.3)
    assert lateness.since(idle_s, loaded_s) == pytest.approx(3.0)
    assert lateness.since(100.0, loaded_s) == pytest.approx(3.0)
    then_s = loop(lateness, loaded_s, 20, 0.0)
    assert lateness.since(loaded_s, then_s) == pytest.approx(0.0, abs=1e-9)


def test_a_pass_under_way_is_late_as_well() -> None:
    lateness = Lateness(100.0, 0.0)
    now_s = loop(lateness, 100.0, 10, 0.0)
    assert lateness.since(now_s, now_s + 0.02) == 0.0
    assert lateness.since(100.0, now_s + 4.0) == pytest.approx(4.0 - PERIOD_S)
    assert lateness.since(now_s + 3.0, now_s + 4.0) == pytest.approx(1.0 - PERIOD_S)


def test_no_more_is_late_than_has_passed() -> None:
    lateness = Lateness(100.0, 0.0)
    now_s = loop(lateness, 100.0, 3, 5.0)
    for since_s in (100.0, now_s - 4.0, now_s - 0.01, now_s):
        assert 0.0 <= lateness.since(since_s, now_s) <= now_s - since_s


@pytest.mark.parametrize("simulated", [True, False])
def test_data_that_come_late_with_the_whole_computer_are_no_fault_of_a_simulated_rig(
    simulated: bool,
) -> None:
    rig = MemoryRig(simulated=simulated, timing=Timing(silence=60.0, silence_commit=60.0))
    try:
        rig.engine.connect()
        connection = rig.engine._connection
        assert connection is not None
        connection.supervise.pause = (  # type: ignore[method-assign]
            lambda seconds: time.sleep(seconds + 0.3)  # woken late
        )
        # No test is under way, so that the limit is the default one; a shorter one proves the same.
        core = rig.engine._core
        core._no_limits = msgspec.structs.replace(core._no_limits, stale_data_s=1.0)
        rig.source.silent = True
        if not simulated:
            rig.engine.wait([RunState.FAULT], 60.0)
            with pytest.raises(InFault, match="has sent no samples for"):
                rig.start(a_test(2))
            return
        eventually(lambda: connection.rig.data_age_s() > 1.5)
        rig.source.silent = False
        eventually(lambda: connection.rig.data_age_s() < 0.3)
        assert rig.engine.state is RunState.READY
        assert not rig.engine._core.alarms.is_active("stale_data")
    finally:
        rig.source.silent = False
        rig.engine.shutdown(20.0)
