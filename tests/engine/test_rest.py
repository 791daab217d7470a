"""A regular end brings the crank to where the spring does not drive it before the power goes."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import pytest

from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.parameters import to_parameters
from rigapp.config.recipe import TestFile
from rigapp.engine.drive.driving import apart_deg
from rigapp.engine.engine import Engine
from rigapp.schema.messages import RunState
from rigapp.schema.states import ENDED
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.simulation.constants import packaged_parameters
from rigapp_model.dynamics import rest_angle
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
LONG = 1_000_000


def test_spring_and_weight_say_where_a_crank_rests() -> None:
    mechanism = to_parameters(packaged_parameters()).mechanism
    angle = rest_angle(mechanism)
    assert angle is not None
    assert apart_deg(math.degrees(angle), 0.0) < 1.0  # the spring pushes the slider outwards
    free = msgspec.structs.replace(packaged_parameters(), spring=None)
    assert rest_angle(to_parameters(free).mechanism) is None
    heavy = msgspec.structs.replace(
        free, mechanism=msgspec.structs.replace(free.mechanism, gravity_m_s2=(0.0, -9.81))
    )
    angle = rest_angle(to_parameters(heavy).mechanism)
    assert angle is not None
    assert apart_deg(math.degrees(angle), 270.0) < 5.0


def without_spring(test: Document[TestFile]) -> Document[TestFile]:
    model = msgspec.structs.replace(test.record.model, spring=None)
    return Document(test.path, test.text, msgspec.structs.replace(test.record, model=model))


@pytest.mark.long
def test_the_spring_does_not_swing_a_crank_that_was_brought_to_its_rest(tmp_path: Path) -> None:
    text = (EXAMPLES / "simulated.toml").read_text("utf-8")
    path = tmp_path / "rig.toml"
    # Nothing here is about the watchdog, and a busy computer may be late by more than 0.5 s.
    path.write_text(text.replace("watchdog_timeout_s = 0.5", "watchdog_timeout_s = 20.0"), "utf-8")
    rig, test = read_rig(path), read_test(EXAMPLES / "quick.toml")
    devices = SimulatedDevices(rig, parse_speed("5", rig))
    peaks: list[float] = []
    seen: list[bool] = []
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        # A model without a spring: the first stop shows where the crank rests, the second uses it.
        for number, run in enumerate((test, without_spring(test), without_spring(test))):
            engine.start(run, tmp_path / f"{number}.h5", operator="Ada")
            engine.wait({RunState.RUNNING}, 60.0)
            engine.pause("Ada")  # at 90 deg, where the spring drives it most
            engine.wait({RunState.PAUSED}, 60.0)
            engine.stop("Ada")
            peaks.append(0.0)
            seen.clear()
            while engine.state not in ENDED:
                state = devices.process.state()
                seen.append(engine.status().rig.coasting)
                if state["drive_mode"] == "off":
                    peaks[-1] = max(peaks[-1], abs(state["speed_rpm"]))
            assert any(seen) or number != 1
            engine.reset("Ada")
        engine.shutdown()
    finally:
        devices.close()
    assert peaks[0] < 15.0
    assert peaks[1] > 30.0
    assert peaks[2] < 15.0


def test_a_fault_on_the_way_to_the_rest_ends_it() -> None:
    rig = MemoryRig()
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 2)
    rig.crank.deaf = True  # it does not slow down to the creep
    rig.engine.stop("Ada")
    what, rev_per_s = rig.spindle.commands[-1]
    assert what == "speed"
    # Slower than 10 rpm where the time of the rig runs faster than the clock, as measured.
    assert 1.0 / 60.0 < rev_per_s < 10.1 / 60.0
    rig.crank.deaf = False
    rig.source.lost = True
    rig.engine.wait(ENDED, 60.0)
    commands = rig.spindle.commands
    assert commands[-1] == ("off", 0.0)
    # The power-off is repeated while the crank turns.
    assert [one for one in commands if one != ("off", 0.0)][-1] == ("speed", 0.0)
    rig.engine.shutdown(20.0)


def test_a_blocked_crank_does_not_keep_its_power() -> None:
    rig = MemoryRig()
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 2)
    with rig.crank.lock:
        rig.crank.jammed = True
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert not rig.crank.powered
    assert rig.spindle.commands[-1][0] == "off"
    rig.engine.shutdown(20.0)


@pytest.mark.sampled
@pytest.mark.parametrize("limit_rpm", [5.0, 200.0])
def test_the_way_to_the_rest_stays_below_the_overspeed_limit(limit_rpm: float) -> None:
    rig = MemoryRig()
    rig.engine.connect()
    test = a_test(LONG, rpm=4.0)
    limits = msgspec.structs.replace(test.limits, overspeed_rpm=limit_rpm)
    rig.start(msgspec.structs.replace(test, limits=limits))
    eventually(lambda: len(rig.store.rows) >= 1)
    before = len(rig.spindle.commands)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    speeds = [60.0 * speed for what, speed in rig.spindle.commands[before:] if what == "speed"]
    assert max(speeds) <= 0.8 * limit_rpm
    assert not rig.engine.status().alarms
    rig.engine.shutdown(20.0)
