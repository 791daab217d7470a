"""Tests one after another on a real engine: a fault in the third, a restart in the first."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S
from stories import COMMAND, NEVER_OVER, RIG, end_soon, numbers, recipe, summary, until

from rigapp.config.loading import read_rig
from rigapp.queue.items import added
from rigapp.queue.store import QueueStore
from rigapp.schema.messages import Remedy, Reply, Request, RunState
from rigapp.schema.queue import ItemState
from rigapp.service.client import Client
from rigapp.service.host import EngineHost
from rigapp.service.launch import find_engine
from rigapp.service.registry import kept_of
from rigapp.service.simulated import parse_speed


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return tmp_path


def a_test(folder: Path, name: str, revolutions: int) -> Path:
    place = folder / name
    place.mkdir()
    return recipe(place, revolutions, twin=False).rename(place / f"{name}.toml")


@pytest.fixture
def host(folder: Path) -> Iterator[EngineHost]:
    document = read_rig(RIG)
    host = EngineHost(document, parse_speed(None, document))
    yield host
    host.close()


def ask(host: EngineHost, verb: str, **arguments: Any) -> Reply:
    return host.handle(Request(verb=verb, arguments=arguments, operator="Ada"))


def alarms(host: EngineHost) -> dict[str, str]:
    return {one.key: one.cause for one in host.engine.status().alarms}


def recover(host: EngineHost) -> None:
    """Do what the engine names as next until it names going on."""

    def recovered() -> bool:
        told = host.engine.status().recovery
        if told.verb and told.step is not Remedy.RESUME:
            ask(host, told.verb)
        return told.step is Remedy.RESUME

    until(recovered, "the way out leads to going on")


@pytest.mark.long
@pytest.mark.timeout(400)
def test_five_tests_with_a_fault_in_the_third_are_all_done(host: EngineHost, folder: Path) -> None:
    store = QueueStore(kept_of(RIG, "queues"), RIG)
    tests = [str(a_test(folder, name, NEVER_OVER if name == "c" else 6)) for name in "abcde"]
    store.change(lambda queue: added(queue, tests, str(folder / "results")))
    host.connect()
    begun = ask(host, "queue_start")
    assert begun.ok, begun.sentence
    again = ask(host, "queue_start")
    assert "runs already" in again.sentence

    def stages() -> list[ItemState]:
        return [one.state for one in store.read().items]

    until(lambda: stages()[2] is ItemState.RUNNING, "the third test runs", 2 * PATIENCE_S)
    third = Path(store.read().items[2].file)
    until(lambda: third.exists() and summary(third)["revolutions"] >= 5, "five are safe in it")
    pulled = ask(host, "inject_fault", kind="cable_pull", device="daq")
    assert pulled.ok, pulled.sentence
    until(lambda: stages()[2] is ItemState.STOPPED, "the queue has stopped")
    assert stages() == ["done", "done", "stopped", "waiting", "waiting"]
    until(lambda: "queue" in alarms(host), "it is told")
    assert "test 3, c.toml: " in alarms(host)["queue"]
    assert "2 more wait" in alarms(host)["queue"]
    assert ask(host, "clear_fault", kind="cable_pull").ok
    recover(host)
    gone_on = ask(host, "queue_start")
    assert gone_on.ok, gone_on.sentence
    assert not [one for one in host.engine.status().alarms if one.active]
    end_soon(RIG)
    until(lambda: stages() == ["done"] * 5, "all are done", 2 * PATIENCE_S)
    assert not store.read().working
    files = [Path(one.file) for one in store.read().items]
    assert [summary(one)["status"] for one in files] == ["complete"] * 5
    assert [len(numbers(one)) for one in files[:2]] == [6, 6]
    assert summary(files[2])["gaps"] >= 1
    assert sorted((folder / "results").glob("*.h5")) == sorted(files)
    assert host.engine.state is RunState.STOPPED


def rigapp(*arguments: str | Path, status: int = 0) -> str:
    """Run the command line to its end; return what it printed, or why it refused."""
    done = subprocess.run(
        [*COMMAND, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == status, done.stdout + done.stderr
    return done.stderr if status else done.stdout


@pytest.mark.long
@pytest.mark.timeout(400)
def test_a_queue_survives_the_computer_and_begins_nothing_by_itself(folder: Path) -> None:
    first, second = a_test(folder, "first", NEVER_OVER), a_test(folder, "second", 6)
    told = rigapp("queue", "add", first, second, "--rig", RIG, "--to", folder / "results")
    assert "2 to be done, the queue is paused" in told

    def listed() -> dict[str, Any]:
        return dict(json.loads(rigapp("queue", "list", "--rig", RIG, "--json")))

    def engine() -> subprocess.Popen[bytes]:
        process = subprocess.Popen([*COMMAND, "engine", str(RIG), "--stay"])
        until(lambda: find_engine(RIG), "the engine is there")
        return process

    process = engine()
    try:
        rigapp("queue", "start", "--rig", RIG, "--operator", "Ada")
        file = Path(listed()["items"][0]["file"])
        until(lambda: file.exists() and summary(file)["revolutions"] >= 3, "it records")
        process.kill()
        process.wait(10.0)
        process = engine()
        after = listed()
        assert not after["working"]
        assert [one["state"] for one in after["items"]] == ["stopped", "waiting"]
        entry = find_engine(RIG)
        assert entry is not None
        client = Client(entry, "Ada", look=False)
        until(lambda: client.request("status").result["state"] == "ready", "it is connected")
        keys = {one["key"] for one in client.request("status").result["alarms"]}
        client.close()
        assert {"queue", "cut_off"} <= keys
        before = len(numbers(file))
        rigapp("queue", "start", "--rig", RIG, "--operator", "Ada")
        end_soon(RIG)
        until(
            lambda: [one["state"] for one in listed()["items"]] == ["done", "done"],
            "both are done",
            2 * PATIENCE_S,
        )
        assert len(numbers(file)) > before
        assert "no test waits" in rigapp("queue", "start", "--rig", RIG, status=2).lower()
    finally:
        process.terminate()
        process.wait(60.0)


def test_a_test_that_the_rig_cannot_do_is_refused_when_it_is_added(folder: Path) -> None:
    fast = a_test(folder, "fast", 6)
    text = fast.read_text("utf-8")
    fast.write_text(text.replace("speed_rpm = ", "speed_rpm = 90", 1), "utf-8")
    assert "speed_rpm" in rigapp("queue", "add", fast, "--rig", RIG, status=2)
    assert "0 to be done" in rigapp("queue", "list", "--rig", RIG)
