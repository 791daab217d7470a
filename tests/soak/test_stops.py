"""From the trip to a crank that stands, over wire bytes: each drive with each of its faults.

The table is printed (``pytest -s``): seconds from the trip to standing, and whether the drive's
watchdog has fired.
"""

from __future__ import annotations

import contextlib
import threading
import time
from pathlib import Path

import pytest
from drive_faults import CASES, DRIVES, Case, Drive, faults_of
from stories import NEVER_OVER, recipe, until

from rigapp.config.loading import read_rig
from rigapp.engine.drive.timing import Timing
from rigapp.engine.engine import Engine
from rigapp.schema.messages import Remedy, RunState
from rigapp.schema.states import ENDED, Refused
from rigapp.service.host import read_test
from rigapp.simulation.handle import SimulatedRig, start_simulated_rig
from rigapp_drivers.api import DeviceError

BOUND_S = Timing().coast + 0.5 + 1.0
"""Coast time, watchdog time and 1 s."""
STANDS_S = 1.0
HANGS_S = 2.0
"""As long as a simulated drive's slow command."""
IGNORED_BOUND_S = 6.0
"""Two turns at 60 rpm, the watchdog and a loaded computer."""
QUICK = {"ignores everything"}


def is_stationary(simulated: SimulatedRig) -> bool:
    """Tell whether the crank is stationary and nothing would turn it."""
    state = simulated.state()
    return abs(state["speed_rpm"]) < 0.01 and state["setpoint_rpm"] == 0.0


def stands_since(simulated: SimulatedRig) -> float:
    """Wait until the crank is stationary; return since when, no turning point of a swing."""
    since: float | None = None

    def long_enough() -> bool:
        nonlocal since
        if not is_stationary(simulated):
            since = None
        elif since is None:
            since = time.monotonic()
        return since is not None and time.monotonic() - since > STANDS_S

    until(long_enough, "the crank to stand")
    assert since is not None
    return since


def is_ready_after_next_step(engine: Engine) -> bool:
    """Take the step that the engine names; tell whether the next one is to start a test."""
    step = engine.status().recovery.step
    if step is Remedy.RESUME and engine.state is RunState.READY:
        return True
    with contextlib.suppress(DeviceError, Refused):
        if step is Remedy.CONNECT:
            engine.connect()
        elif step is Remedy.ACKNOWLEDGE:
            engine.acknowledge(operator="Ada")
        elif step in (Remedy.RESET, Remedy.RESUME):
            engine.reset("Ada")
    return False


@pytest.mark.parametrize("drive", DRIVES, ids=lambda one: one.name)
@pytest.mark.parametrize(
    "case",
    [
        pytest.param(
            one, id=one.name, marks=pytest.mark.long if one.name in QUICK else pytest.mark.soak
        )
        for one in CASES
    ],
)
def test_every_drive_stands_in_time_whatever_it_confirms(
    tmp_path: Path, drive: Drive, case: Case
) -> None:
    document = read_rig(drive.rig)
    with start_simulated_rig(drive.rig, speed=1.0, parameters=None) as simulated:
        engine = Engine(document, ports=simulated.urls)
        try:
            engine.connect()
            if case.state is RunState.RUNNING:
                plan = read_test(recipe(tmp_path, NEVER_OVER, twin=False))
                engine.start(plan, tmp_path / "t.h5", operator="Ada")
                engine.wait((RunState.RUNNING, *ENDED), 60.0)
                until(lambda: simulated.state()["speed_rpm"] > 55.0, "the set speed")
            for fault in faults_of(drive, case):
                simulated.inject(fault)
            if case.state is RunState.READY:
                until(lambda: not is_stationary(simulated), "the crank to turn by itself")
            tripped = time.monotonic()
            if case.state is RunState.RUNNING:
                engine.stop("Ada") if case.ramp else engine.drive_off("Ada")
            took_s = stands_since(simulated) - tripped
            fired = simulated.state()["watchdog_tripped"]
            print(f"\n| {drive.name} | {case.name} | {took_s:.1f} | {'yes' if fired else 'no'} |")
            assert took_s < BOUND_S
            assert case.fires is None or fired == case.fires
            if case.fires:
                assert took_s < IGNORED_BOUND_S
            else:
                told = [one.key for one in engine.status().alarms]
                assert "will_not_stop" not in told, "a crank that coasts is not driven"
            if case.state is RunState.RUNNING:
                engine.wait(ENDED, 30.0)
            assert is_stationary(simulated)
            assert case.unseen == any(one.key == "stop_unseen" for one in engine.status().alarms)
            for fault in case.faults:
                simulated.clear(fault["kind"])
            until(lambda: is_ready_after_next_step(engine), "the steps to lead to Ready")
        finally:
            with contextlib.suppress(Exception):
                engine.shutdown(20.0)


@pytest.mark.soak
@pytest.mark.parametrize("drive", DRIVES, ids=lambda one: one.name)
def test_a_power_off_passes_a_command_that_hangs(tmp_path: Path, drive: Drive) -> None:
    document = read_rig(drive.rig)
    with start_simulated_rig(drive.rig, speed=1.0, parameters=None) as simulated:
        engine = Engine(document, ports=simulated.urls)
        try:
            engine.connect()
            plan = read_test(recipe(tmp_path, NEVER_OVER, twin=False))
            engine.start(plan, tmp_path / "t.h5", operator="Ada")
            until(lambda: simulated.state()["speed_rpm"] > 55.0, "the set speed")
            simulated.inject({"kind": "slow_command", "device": "drive", "target": drive.ramp})
            engine.pause("Ada")
            connection = engine._connection
            assert connection is not None
            until(connection.control._commanding.locked, "a command that hangs")
            tripped = time.monotonic()
            off = threading.Thread(target=engine.drive_off, args=("Ada",))
            off.start()
            until(lambda: simulated.state()["drive_mode"] == "off", "no power")
            took_s = time.monotonic() - tripped
            print(f"\n| {drive.name} | power-off past a hanging command | {took_s:.2f} |")
            assert took_s < HANGS_S / 2.0
            off.join(60.0)
            engine.wait(ENDED, 60.0)
            assert is_stationary(simulated)
        finally:
            simulated.clear("slow_command")
            with contextlib.suppress(Exception):
                engine.shutdown(20.0)
