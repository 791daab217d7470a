"""Whatever fault the simulated rig offers, the steps that the engine names lead back to a test."""

from __future__ import annotations

import contextlib
import os
import random
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from drive_faults import CASES, DRIVES, Case, Drive, faults_of
from stories import RIG, numbers, recipe, until

from rigapp.config.loading import read_rig
from rigapp.schema.messages import FinishReason, Remedy, Request, RunState
from rigapp.schema.states import ACTIVE, ENDED, Refused
from rigapp.service.faults import FaultChoice, fault_choices
from rigapp.service.host import EngineHost, read_test
from rigapp_drivers.api import DeviceError

CHOICES = fault_choices((("daq", "gsv8"), ("drive", "roboclaw")))
LONG = 5000
SEEN_S = 4.0
WALKS = int(os.environ.get("RIGAPP_SOAK_WALKS", "150"))
ACTIONS = ("pause", "resume", "stop", "drive_off", "acknowledge", "reset", "connect")
STEPS_AT_MOST = 12


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    host = EngineHost(read_rig(RIG), 5.0)
    yield host
    host.close()


def ask(host: EngineHost, verb: str, **arguments: object) -> str:
    """Ask as a window does; return the sentence of a refusal."""
    reply = host.handle(Request(verb=verb, arguments=dict(arguments), operator="Ada"))
    return "" if reply.ok else reply.sentence


def begin(host: EngineHost, path: Path) -> None:
    """Start a test and wait for its first revolution."""
    host.start(read_test(recipe(path.parent, LONG, twin=False)), path, "Ada", resume=False)
    until(
        lambda: host.engine.status().test.revolution >= 1 or host.engine.state in ENDED,
        "the test runs",
    )
    if host.engine.state in ENDED:
        raise TimeoutError(host.engine.status().engine.reason)


def begin_anyhow(host: EngineHost, path: Path) -> None:
    """Start a test on a rig that a loaded computer may have tripped before."""
    for _ in range(3):
        to_ready(host)
        with contextlib.suppress(DeviceError, Refused, TimeoutError):
            begin(host, path)
            return
        path.unlink(missing_ok=True)
    raise AssertionError(host.engine.status())


def strike(host: EngineHost, choice: FaultChoice) -> None:
    """Let a fault begin."""
    where = {"channel": "force_1"} if choice.where == "signal" else {"device": choice.where}
    assert not ask(host, "inject_fault", kind=choice.kind, **where)


def recovers(host: EngineHost, choice: FaultChoice, folder: Path) -> None:
    """Let a fault happen in a test, mend it, follow the steps, and go on to the end."""
    begin(host, folder / "t.h5")
    strike(host, choice)
    with contextlib.suppress(TimeoutError):
        host.engine.wait(ENDED, SEEN_S)
    ask(host, "clear_fault", kind=choice.kind)
    leads_back(host, folder / "t.h5")


def to_ready(host: EngineHost) -> list[str]:
    """Follow the steps that the engine names until it is ready; return them."""
    engine = host.engine
    if engine.state in ACTIVE:  # a fault that a test lives with
        ask(host, "stop")
        engine.wait(ENDED, 60.0)
    steps: list[str] = []
    while engine.state is not RunState.READY or engine.status().recovery.step is not Remedy.RESUME:
        until(lambda: engine.status().recovery.step is not Remedy.NONE, f"a step after {steps}")
        told = engine.status().recovery
        steps.append(told.step.value)
        assert len(steps) <= STEPS_AT_MOST, (steps, engine.status())
        if told.step is Remedy.CAUSE:
            until(lambda: engine.status().recovery.step is not Remedy.CAUSE, "the cause goes")
        else:
            ask(host, "reset" if told.step is Remedy.RESUME else told.verb)
            time.sleep(0.05)
    return steps


def leads_back(host: EngineHost, path: Path) -> None:
    """Follow the steps from wherever a test is to Ready, resume it, and go on to its end.

    A loaded computer may trip the watchdogs of a rig that is in order: so again from there, and
    each time is printed.
    """
    engine = host.engine
    for last in (False, False, True):
        steps = to_ready(host)
        refused = ask(host, "resume_file", file=str(path), reason="the fault is mended")
        if not refused:
            engine.wait(frozenset({RunState.RUNNING}) | ENDED, 60.0)
            with contextlib.suppress(Refused):
                engine.extend(engine.status().test.revolution + 4)
            engine.wait(ENDED, 60.0)
            outcome = engine.outcome
            assert outcome is not None
            if outcome.reason is FinishReason.COMPLETE:
                return
            refused = outcome.sentence
        print(f"tripped while nothing was wrong: {refused}", flush=True)
        assert not last, (steps, refused)


@pytest.mark.long
def test_the_steps_lead_back_from_an_emergency_stop(host: EngineHost, tmp_path: Path) -> None:
    recovers(host, FaultChoice("emergency_stop", "drive"), tmp_path)


@pytest.mark.soak
@pytest.mark.parametrize("choice", CHOICES, ids=lambda one: f"{one.where}-{one.kind}")
def test_the_steps_lead_back_from_every_fault_of_the_simulated_rig(
    host: EngineHost, choice: FaultChoice, tmp_path: Path
) -> None:
    recovers(host, choice, tmp_path)


@pytest.mark.soak
@pytest.mark.timeout(0)
@pytest.mark.parametrize("drive", DRIVES, ids=lambda one: one.name)
def test_ready_is_reached_from_every_walk_of_faults_and_actions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, drive: Drive
) -> None:
    """The number of walks of each rig is set by RIGAPP_SOAK_WALKS (150)."""
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    document = read_rig(drive.rig)
    choices = fault_choices(tuple((n, one.driver) for n, one in document.record.devices.items()))
    choices_of_drive = [one for one in choices if one.where == "drive"]
    seed = time.time_ns()
    chance = random.Random(seed)
    host = EngineHost(document, 5.0)
    try:
        for walk in range(WALKS):
            path, deeds = tmp_path / f"{walk}.h5", [f"seed {seed}, walk {walk}"]
            begin_anyhow(host, path)
            safe = 0
            for _ in range(chance.randint(1, 6)):
                deed = chance.choice(chance.choice([choices, choices_of_drive, CASES, ACTIONS]))
                deeds.append(deed.name if isinstance(deed, Case) else str(deed))
                if isinstance(deed, FaultChoice):
                    strike(host, deed)
                elif isinstance(deed, Case):
                    for fault in faults_of(drive, deed):
                        assert not ask(host, "inject_fault", **fault)
                else:
                    ask(host, deed)
                time.sleep(chance.uniform(0.0, 1.5))  # the walk itself: nothing is waited for
                safe = max(safe, host.engine.status().test.committed)
            for choice in choices:
                ask(host, "clear_fault", kind=choice.kind)
            print(deeds, flush=True)
            leads_back(host, path)
            found = numbers(path)
            assert len(found) >= safe, deeds
            assert np.all(np.diff(found) > 0), deeds
    finally:
        host.close()
