"""A calibration that is open occupies the rig: nothing else turns it until it is ended."""

from __future__ import annotations

import json
import math
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from commandline import rigapp
from patience import PATIENCE_S
from stories import NEVER_OVER, RIG, Running, recipe, until

from rigapp.commands.live.engine_line import release_calibration
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.presentation.states import state_line, state_word
from rigapp.schema.messages import AT_REST, OpenCalibration, Reply, RunState, Snapshot, Status
from rigapp.service.calibration import stored_calibration
from rigapp.service.client import Client
from rigapp.service.host import EngineHost
from rigapp.service.registry import running_engines

OLD_STATES = [one.value for one in RunState if one is not RunState.CALIBRATING]


@pytest.fixture(scope="module", autouse=True)
def runtime(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    folder = tmp_path_factory.mktemp("run")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RIGAPP_RUNTIME_DIR", str(folder))
        yield folder


@pytest.fixture(scope="module")
def host(runtime: Path) -> Iterator[EngineHost]:
    """Return one engine of the simulated rig for all tests here."""
    host = EngineHost(read_rig(RIG), 20.0)
    host.connect()
    yield host
    host.close()


@pytest.fixture
def viewer(host: EngineHost) -> Iterator[Callable[[str], Client]]:
    """Return the maker of viewers; what they leave open or turning is ended."""
    made: list[Client] = []

    def make(name: str) -> Client:
        made.append(Client(running_engines()[-1], name))
        return made[-1]

    yield make
    last = make("the end")
    last.request("stop")
    if host.engine.state not in AT_REST:
        host.engine.wait((RunState.STOPPED,), PATIENCE_S)
    last.request("calibration_release")
    for client in made:
        client.close()


def begun(client: Client, what: str = "load cell", fastest_rpm: float = 0.0) -> str:
    """Let a viewer begin a calibration; return its key."""
    reply = client.request("calibration_begin", {"what": what, "fastest_rpm": fastest_rpm})
    assert reply.ok, reply.sentence
    return str(reply.result["key"])


def seen(client: Client) -> Status:
    """Return the newest status that a viewer was sent."""
    found: list[Snapshot] = []

    def came() -> bool:
        snapshot = client.poll()
        found.extend([snapshot] if snapshot is not None else [])
        return bool(found)

    until(came, "a snapshot")
    return found[-1].status


def is_calibrating(client: Client) -> bool:
    return seen(client).engine.state is RunState.CALIBRATING


def refused(reply: Reply) -> None:
    """Require the refusal that names who calibrates what, and how to end it."""
    assert not reply.ok
    for words in ("Ada is calibrating", "load cell", "rigapp calibrate release"):
        assert words in reply.sentence


def test_whatever_turns_the_spindle_is_refused_in_every_viewer(
    viewer: Callable[[str], Client], tmp_path: Path, host: EngineHost
) -> None:
    ada, bo = viewer("Ada"), viewer("Bo")
    key = begun(ada)
    for client in (ada, bo):
        until(partial(is_calibrating, client), "the state")
    status = seen(bo)
    assert status.engine.calibration is not None
    assert (status.engine.calibration.who, status.engine.calibration.what) == ("Ada", "load cell")
    assert state_word(status) == "Calibrating"
    assert "load cell, by Ada, since" in state_line(status, "F10")
    assert "(F10)" not in state_line(status, "F10")
    test = recipe(tmp_path, NEVER_OVER, twin=False)
    start = {"test": str(test), "out": str(tmp_path / "t.h5")}
    for client in (ada, bo):
        for verb, arguments in (
            ("start", start),
            ("start", {**start, "calibration": "not the key"}),
            ("resume", {}),
            ("resume_file", {"file": str(tmp_path / "t.h5")}),
            ("examine_file", {"file": str(tmp_path / "t.h5")}),
            ("zero", {}),
            ("calibration_begin", {"what": "probes"}),
        ):
            if (client, verb) != (ada, "resume"):
                refused(client.request(verb, arguments))
    assert not (tmp_path / "t.h5").exists()
    assert host.engine.state in AT_REST
    assert bo.request("drive_off").ok
    assert "nothing" not in bo.request("stop").sentence
    assert not bo.request("calibration_end", {"key": "not the key"}).ok
    assert ada.request("calibration_end", {"key": key}).ok
    until(lambda: not is_calibrating(bo), "the rig is free")
    assert not ada.request("calibration_end", {"key": key}).ok


@pytest.mark.long
def test_its_holder_alone_turns_the_spindle_as_fast_as_the_step_needs(
    viewer: Callable[[str], Client], tmp_path: Path, host: EngineHost
) -> None:
    ada, bo = viewer("Ada"), viewer("Bo")
    test = recipe(tmp_path, NEVER_OVER, twin=False)
    out = {"test": str(test), "out": str(tmp_path / "roll.h5")}
    key = begun(ada, "run-out of the load cell", 59.0)
    reply = ada.request("start", {**out, "calibration": key})
    assert "59 rpm at most" in reply.sentence
    assert ada.request("calibration_end", {"key": key}).ok
    key = begun(ada, "run-out of the load cell", 60.0)
    refused(bo.request("start", out))
    reply = ada.request("start", {**out, "calibration": key})
    assert reply.ok, reply.sentence
    host.engine.wait((RunState.RUNNING,), PATIENCE_S)
    assert "stop it first" in bo.request("calibration_release").sentence
    assert bo.request("pause").ok
    host.engine.wait((RunState.PAUSED,), PATIENCE_S)
    refused(bo.request("resume"))
    assert ada.request("resume").ok
    host.engine.wait((RunState.RUNNING,), PATIENCE_S)
    assert bo.request("stop").ok
    host.engine.wait((RunState.STOPPED,), PATIENCE_S)
    until(lambda: seen(bo).engine.state is RunState.CALIBRATING, "still occupied")
    assert ada.request("calibration_end", {"key": key}).ok


@pytest.mark.long
def test_the_queue_waits_and_fails_no_test(
    viewer: Callable[[str], Client], tmp_path: Path, host: EngineHost
) -> None:
    ada, bo = viewer("Ada"), viewer("Bo")
    test = recipe(tmp_path, 3, twin=False)
    assert bo.request("queue_add", {"tests": [str(test)], "folder": str(tmp_path)}).ok
    key = begun(ada)
    refused(bo.request("queue_start"))

    def states() -> list[str]:
        return [one["state"] for one in bo.request("status").result["queue"]]

    assert states() == ["waiting"]
    assert not bo.request("status").result["queue_works"]
    told = [one["cause"] for one in bo.request("status").result["alarms"]]
    assert any("Ada is calibrating" in one and "start the queue again" in one for one in told)
    assert ada.request("calibration_end", {"key": key}).ok
    reply = bo.request("queue_start")
    assert reply.ok, reply.sentence
    until(lambda: states() == ["done"], "the test of the queue")
    assert bo.request("queue_remove", {"numbers": [1]}).ok


@pytest.mark.long
@pytest.mark.timeout(300)
@pytest.mark.parametrize(
    "end", [pytest.param("calibration_end", marks=pytest.mark.long), "calibration_release"]
)
def test_the_crank_turns_after_a_training_that_ends_in_the_middle(
    viewer: Callable[[str], Client], tmp_path: Path, host: EngineHost, end: str
) -> None:
    """The simulated crank is locked while the follower is off; no reset takes the lock away."""
    ada = viewer("Ada")
    start = {"test": str(recipe(tmp_path, 3, twin=False))}

    def turns(name: str) -> None:
        reply = ada.request("start", {**start, "out": str(tmp_path / name)})
        assert reply.ok, reply.sentence
        host.engine.wait((RunState.STOPPED, RunState.FAULT), PATIENCE_S)
        outcome = host.engine.outcome
        assert outcome is not None
        assert outcome.status == "complete", outcome

    turns("before.h5")  # the rig has the mechanism of the test, and is not put up anew for it
    key = begun(ada)
    for what, details in (
        ("take_off_follower", {}),
        ("turn_pin", {"angle_deg": 90.0}),
        ("hang_weight", {"mass_kg": 32.5}),
    ):
        assert ada.request("hand", {"what": what, "details": details}).ok
    assert ada.request("inject_fault", {"kind": "swapped_bridges"}).ok
    assert ada.request(end, {"key": key}).ok
    turns("after.h5")


@pytest.mark.long
@pytest.mark.timeout(300)
def test_a_killed_holder_leaves_it_until_it_is_released_on_purpose(
    viewer: Callable[[str], Client], tmp_path: Path, running: Callable[..., Running]
) -> None:
    program = (
        "import sys, time\n"
        "from rigapp.service.client import Client\n"
        "from rigapp.service.registry import running_engines\n"
        "client = Client(running_engines()[-1], 'Ada')\n"
        "print(client.request('calibration_begin', {'what': 'load cell'}).ok, flush=True)\n"
        "time.sleep(600)\n"
    )
    command = [sys.executable, "-c", program]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline().strip() == "True"
        holder.send_signal(signal.SIGKILL)
    bo = viewer("Bo")
    until(lambda: seen(bo).engine.state is RunState.CALIBRATING, "it stays")
    # Another engine of this rig, as after a restart, refuses as well.
    test = recipe(tmp_path, 3, twin=False)
    alone = running("run", test, "--rig", RIG, "--out", tmp_path / "t.h5")
    alone.process.wait(PATIENCE_S)
    assert alone.process.returncode == 2
    assert "Ada is calibrating" in alone.complaint()
    assert "Traceback" not in alone.complaint()
    shown = rigapp("status", "--rig", RIG)
    assert shown.returncode == 0
    assert "Calibrating: load cell, by Ada, since" in shown.stdout
    shown = rigapp("status", "--rig", RIG, "--json")
    (one,) = json.loads(shown.stdout)
    assert (one["state"], one["calibration"]["who"]) == ("calibrating", "Ada")
    checked = rigapp("check", RIG, test)
    assert checked.returncode == 1
    assert "load cell, by Ada" in checked.stdout
    with pytest.raises(UnusableInput, match="stays open"):
        release_calibration(RIG, "", sure=False, read=lambda question: "yes")
    with pytest.raises(UnusableInput, match="--yes"):
        release_calibration(RIG, "", sure=False)
    other = {"since": one["calibration"]["since"] + 1.0}
    assert "nother calibration" in bo.request("calibration_release", other).sentence
    assert rigapp("calibrate", "release", "--rig", RIG, "--yes").returncode == 0
    until(lambda: not is_calibrating(bo), "the rig is free")
    assert rigapp("calibrate", "release", "--rig", RIG, "--yes").returncode == 0
    assert stored_calibration(RIG) is None


def test_another_engine_takes_it_up_and_its_holder_still_ends_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    rig = tmp_path / "rig.toml"
    rig.write_text(RIG.read_text("utf-8"), "utf-8")

    def engine(*, own: bool = False) -> EngineHost:
        return EngineHost(read_rig(rig), 20.0, own=own)

    def asked(host: EngineHost, verb: str, **arguments: Any) -> Reply:
        client = Client(running_engines()[-1], "Ada", look=False)
        try:
            return client.request(verb, arguments)
        finally:
            client.close()

    host = engine()
    key = asked(host, "calibration_begin", what="probes").result["key"]
    host.close()
    own = engine(own=True)  # of a practice: a rig of its own
    assert asked(own, "status").result["state"] == "idle"
    own.close()
    host = engine()
    try:
        assert asked(host, "status").result["state"] == "calibrating"
        assert asked(host, "calibration_end", key=key).ok
        assert asked(host, "status").result["state"] == "idle"
        asked(host, "calibration_begin", what="probes")
    finally:
        host.close()
    assert release_calibration(rig, "", sure=False, read=lambda question: "no") == 0
    assert stored_calibration(rig) is None


def test_a_viewer_of_before_can_read_the_status() -> None:
    """What is sent has no state that a viewer of an earlier version does not know."""
    shown = OpenCalibration("load cell", "Ada", time.time())
    for state in RunState:
        if state is RunState.CALIBRATING:
            continue
        sent = Status.of_flat({"state": state, "calibration": shown}).tree()
        assert sent["state"] in OLD_STATES
        status = Status.of_tree(sent).shown()
        occupied = state in AT_REST
        assert (status.engine.state is RunState.CALIBRATING) == occupied
        assert ("Calibrating" in state_line(status)) is True


@pytest.mark.parametrize("fastest", [math.nan, math.inf, -1.0, "fast"])
def test_a_speed_that_is_none_begins_nothing(viewer: Callable[[str], Client], fastest: Any) -> None:
    ada = viewer("Ada")
    reply = ada.request("calibration_begin", {"what": "run-out", "fastest_rpm": fastest})
    assert not reply.ok
    assert ada.request("status").result["calibration"] is None


@pytest.mark.long
def test_none_can_begin_while_a_test_is_under_way(
    viewer: Callable[[str], Client], tmp_path: Path, host: EngineHost
) -> None:
    ada = viewer("Ada")
    test = recipe(tmp_path, NEVER_OVER, twin=False)
    assert ada.request("start", {"test": str(test), "out": str(tmp_path / "t.h5")}).ok
    reply = ada.request("calibration_begin", {"what": "load cell"})
    assert "A test is running" in reply.sentence
