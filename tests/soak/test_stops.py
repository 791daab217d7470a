"""From the trip to a crank that stands, over wire bytes: each drive with each of its faults.

The table is printed (``pytest -s``): seconds from the trip to standing, and whether the drive's
watchdog has fired.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from stories import EXAMPLES, NEVER_OVER, recipe, until

from rigapp.config.loading import read_rig
from rigapp.engine.drive.timing import Timing
from rigapp.engine.engine import Engine
from rigapp.schema.messages import RunState
from rigapp.schema.states import ENDED
from rigapp.service.host import read_test
from rigapp.simulation.handle import SimulatedRig, start_simulated_rig

BOUND_S = Timing().coast + 0.5 + 1.0
"""Coast time, watchdog time and 1 s."""
STANDS_S = 1.0
IGNORED_BOUND_S = 6.0
"""Two turns at 60 rpm, the watchdog and a loaded computer."""


@dataclass(frozen=True)
class Drive:
    """A drive's rig, and the targets of its commands."""

    name: str
    rig: Path
    off: int
    ramp: int


DRIVES = (
    Drive("roboclaw", EXAMPLES / "simulated.toml", off=32, ramp=38),
    Drive("cia402", EXAMPLES / "simulated_alternate.toml", off=0x6040, ramp=0x60FF),
)


@dataclass(frozen=True)
class Case:
    """What the drive does, and whether only its watchdog can stop it."""

    name: str
    faults: tuple[Mapping[str, Any], ...] = ()
    fires: bool = False
    ramp: bool = False
    state: RunState = RunState.RUNNING


IGNORES_ALL = {"kind": "ignored_command"}
CASES = (
    Case("obeys"),
    Case("ignores one power-off", ({"kind": "ignored_command", "target": "off", "count": 1},)),
    Case("ignores five", ({"kind": "ignored_command", "target": "off", "count": 5},)),
    Case("ignores every power-off", ({"kind": "ignored_command", "target": "off"},), fires=True),
    Case("ignores everything", (IGNORES_ALL,), fires=True),
    Case("and says it has no power", (IGNORES_ALL, {"kind": "false_readback"}), fires=True),
    Case(
        "and the encoder is stale",
        (IGNORES_ALL, {"kind": "false_readback"}, {"kind": "hang", "device": "daq"}),
        fires=True,
    ),
    Case("ignores the ramp", ({"kind": "ignored_command", "target": "ramp"},), ramp=True),
    Case(
        "confirms late, ignores one",
        (
            {"kind": "slow_command", "value": 0.15, "count": 4},
            {"kind": "ignored_command", "target": "off", "count": 1},
        ),
    ),
    Case("turns by itself in Ready", ({"kind": "turns_by_itself"},), state=RunState.READY),
    Case(
        "and ignores everything",
        (IGNORES_ALL, {"kind": "turns_by_itself"}),
        fires=True,
        state=RunState.READY,
    ),
)
QUICK = {"ignores everything", "and says it has no power"}


def strike(simulated: SimulatedRig, drive: Drive, case: Case) -> None:
    """Let the faults of a case begin."""
    for fault in case.faults:
        target = fault.get("target")
        given = {"target": getattr(drive, target)} if target else {}
        simulated.inject({"device": "drive", **fault, **given})


def is_stationary(simulated: SimulatedRig) -> bool:
    """Tell whether the crank stands and nothing would turn it."""
    state = simulated.state()
    return abs(state["speed_rpm"]) < 0.01 and state["setpoint_rpm"] == 0.0


def stands_since(simulated: SimulatedRig) -> float:
    """Wait until the crank stands; return since when, which no turning point of a swing is."""
    since: float | None = None

    def stands() -> bool:
        nonlocal since
        if not is_stationary(simulated):
            since = None
        elif since is None:
            since = time.monotonic()
        return since is not None and time.monotonic() - since > STANDS_S

    until(stands, "the crank to stand")
    assert since is not None
    return since


@pytest.mark.parametrize("drive", DRIVES, ids=lambda one: one.name)
@pytest.mark.parametrize(
    "case",
    [
        pytest.param(one, id=one.name, marks=() if one.name in QUICK else pytest.mark.soak)
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
            strike(simulated, drive, case)
            if case.state is RunState.READY:
                until(lambda: not is_stationary(simulated), "the crank to turn by itself")
            tripped = time.monotonic()
            if case.state is RunState.RUNNING:
                engine.stop("Ada") if case.ramp else engine.drive_off("Ada")
            took_s = stands_since(simulated) - tripped
            fired = simulated.state()["watchdog_tripped"]
            print(f"\n| {drive.name} | {case.name} | {took_s:.1f} | {'yes' if fired else 'no'} |")
            assert took_s < BOUND_S
            assert fired == case.fires
            if case.fires:
                assert took_s < IGNORED_BOUND_S
            else:
                told = [one.key for one in engine.status().alarms]
                assert "will_not_stop" not in told, "a crank that coasts is not driven"
            if case.state is RunState.RUNNING:
                engine.wait(ENDED, 30.0)
            assert is_stationary(simulated)
        finally:
            for fault in case.faults:
                simulated.clear(fault["kind"])
            with contextlib.suppress(Exception):
                engine.shutdown(20.0)
