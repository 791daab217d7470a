"""Every way to ask a test to end ends it, and its process; what a kill leaves is cleaned later."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from patience import PATIENCE_S
from stories import RIG, Running, recipe, summary, until

from rigapp.process.ending import (
    Background,
    ending_as_interrupt,
    shutdown_with_timeout,
    termination_signals,
)
from rigapp.process.stale_files import process_alive
from rigapp.schema.messages import RunState
from rigapp.service import launch
from rigapp.service.client import EngineUnreachable
from rigapp.service.host import EngineHost
from rigapp.service.registry import running_engines, runtime_folder, starting, starting_engine

HANGING_OPEN = """
import sys, time
from rigapp_drivers.roboclaw.driver import RoboClaw
import rigapp.commands.run as run
def hang(self):
    print("opening", flush=True)
    while True:
        time.sleep(1000.0)
RoboClaw.open = hang
run.HANGING_S = float(sys.argv.pop(1))
from rigapp.cli import main
main()
"""


@pytest.fixture(autouse=True)
def _signals_count() -> Iterator[None]:
    """Take signals as a program at a terminal does; ``nohup`` lets a hang-up be ignored."""
    usual = signal.signal(signal.SIGHUP, signal.SIG_DFL)
    yield
    signal.signal(signal.SIGHUP, usual)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    monkeypatch.setattr(tempfile, "tempdir", None)
    return tmp_path


@pytest.fixture
def running(folder: Path) -> Iterator[Running]:
    test = recipe(folder, 5000, twin=False)
    one = Running("run", test, "--rig", RIG, "--out", folder / "t.h5")
    yield one
    one.close()


@pytest.mark.long
def test_a_closed_terminal_ends_a_test_as_kill_does(running: Running, folder: Path) -> None:
    running.wait_for(lambda: "running" in running.states(), "the test runs")
    running.process.send_signal(signal.SIGHUP)
    end = running.end()
    assert running.process.returncode == 1
    assert end["reason"] == "operator"
    assert "SIGHUP" in end["sentence"]
    found = summary(folder / "t.h5")
    assert found["status"] == "stopped"
    assert "SIGHUP" in found["reason"]
    assert "Traceback" not in running.complaint()
    left = {path.name for path in runtime_folder().iterdir()}
    assert left <= {"last-tests", "queues", "calibrations"}, "nothing but what outlives an engine"
    assert list((folder / "temporary").glob("rigapp-sim-*")) == []


@pytest.mark.long
@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGTERM, signal.SIGINT])
def test_a_signal_while_the_program_is_still_loaded_ends_it_too(
    folder: Path, number: signal.Signals
) -> None:
    end_itself = f"""
import os, sys
from rigapp.cli import main
class AtFirstImport:
    def find_spec(self, name, *_):
        if name == "rigapp.commands.run":
            sys.meta_path.remove(self)
            os.kill(os.getpid(), {int(number)})
sys.meta_path.insert(0, AtFirstImport())
main()
"""
    test = recipe(folder, 5, twin=False)
    arguments = ("run", test, "--rig", RIG, "--out", folder / "t.h5")
    ended = subprocess.run(
        [sys.executable, "-c", end_itself, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert ended.returncode == 1
    assert ended.stderr == "rigapp: interrupted.\n"
    assert list(runtime_folder().iterdir()) == []


@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGTERM, signal.SIGINT])
def test_an_interrupt_that_is_swallowed_while_something_is_loaded_is_not_forgotten(
    number: signal.Signals,
) -> None:
    reached = []

    def load_and_begin() -> None:
        with suppress(KeyboardInterrupt):
            signal.raise_signal(number)
        reached.append("loaded")
        with termination_signals():
            reached.append("begun")

    with pytest.raises(KeyboardInterrupt), ending_as_interrupt():
        load_and_begin()
    assert reached == ["loaded"]


def test_a_swallowed_interrupt_ends_what_does_not_listen_for_signals() -> None:
    with pytest.raises(KeyboardInterrupt), ending_as_interrupt(), suppress(KeyboardInterrupt):
        signal.raise_signal(signal.SIGTERM)


def test_a_hang_up_that_is_ignored_stays_so() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with termination_signals() as asked:
            signal.raise_signal(signal.SIGHUP)
            signal.raise_signal(signal.SIGTERM)
            assert asked == ["SIGTERM"]
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.parametrize(
    ("patience", "times"), [("0.2", 1), pytest.param("1000", 2, marks=pytest.mark.long)]
)
def test_an_interruption_ends_a_start_that_hangs_in_a_device(
    folder: Path, patience: str, times: int
) -> None:
    test = recipe(folder, 50, twin=False)
    words = ("run", test, "--rig", RIG, "--out", folder / "t.h5", "--progress", "json")
    process = subprocess.Popen(
        [sys.executable, "-c", HANGING_OPEN, patience, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert any(line == "opening\n" for line in process.stdout)
        process.send_signal(signal.SIGINT)
        while times > 1 and process.poll() is None:
            # Two that come together count as one.
            time.sleep(0.05)
            process.send_signal(signal.SIGINT)
        out, complaint = process.communicate(timeout=PATIENCE_S)
    finally:
        process.kill()
        process.wait()
    assert process.returncode == 1
    assert "interrupted by SIGINT while connecting" in complaint
    assert "Traceback" not in complaint
    assert out == ""
    assert not (folder / "t.h5").exists()
    assert running_engines() == []


@pytest.mark.long
def test_an_interruption_while_connecting_starts_no_test(running: Running, folder: Path) -> None:
    running.wait_for(lambda: "connecting" in running.states(), "it connects")
    running.process.send_signal(signal.SIGINT)
    end = running.end()
    assert running.process.returncode == 1
    assert end["reason"] == "operator"
    # On a busy machine the test may have begun before the signal came.
    if "starting" not in running.states():
        assert end["sentence"] == "The test did not start: interrupted by SIGINT."
        assert not (folder / "t.h5").exists()


def test_what_hangs_at_the_end_is_left_after_some_time_or_when_asked_again(folder: Path) -> None:
    program = (
        "import threading\n"
        "from rigapp.process.ending import shutdown_with_timeout, termination_signals\n"
        "def hang():\n"
        "    print('closing', flush=True)\n"
        "    threading.Event().wait()\n"
        "with termination_signals() as asked:\n"
        "    shutdown_with_timeout(hang, asked, lambda: False,\n"
        "        lambda: print('given up', flush=True), {limit})\n"
    )
    for limit, number in ((0.2, None), (1000.0, signal.SIGINT), (1000.0, signal.SIGHUP)):
        process = subprocess.Popen(
            [sys.executable, "-c", program.format(limit=limit)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert process.stdout is not None
        assert process.stdout.readline() == "closing\n"
        if number is not None:
            process.send_signal(number)
        out, complaint = process.communicate(timeout=PATIENCE_S)
        assert (process.returncode, out) == (1, "given up\n")
        assert complaint == "rigapp: what was still open was not closed in time.\n"


def test_closing_that_does_not_hang_is_left_alone() -> None:
    done: list[int] = []
    shutdown_with_timeout(lambda: done.append(1), [], lambda: True, lambda: done.append(2), 60.0)
    assert done == [1]
    with pytest.raises(ValueError, match="its own"):
        shutdown_with_timeout(fail, [], lambda: True, lambda: None, 60.0)


def fail() -> None:
    raise ValueError("its own")


@pytest.mark.long
def test_what_a_killed_engine_leaves_is_cleaned_by_the_next_one(
    running: Running, folder: Path
) -> None:
    running.wait_for(lambda: "running" in running.states(), "the test runs")
    own = running.process.pid
    left = [path for path in runtime_folder().iterdir() if str(own) in path.name]
    assert len(left) == 3
    simulator = folder / "temporary" / "rigapp-sim-4194999-abc"
    simulator.mkdir()
    (simulator / "drive").symlink_to("/dev/null")
    running.kill()
    assert all(path.exists() or path.is_socket() for path in left)
    again = Running("run", folder / "test.toml", "--rig", RIG, "--out", folder / "again.h5")
    try:
        again.wait_for(lambda: "running" in again.states(), "the next test runs")
        assert [path for path in left if path.exists() or path.is_socket()] == []
        assert not simulator.exists()
        assert sum(str(again.process.pid) in path.name for path in runtime_folder().iterdir()) == 3
    finally:
        again.close()


# ------------------------------------------------------------------------------------ one engine


def test_a_window_waits_for_the_test_that_connects_and_attaches_to_it(running: Running) -> None:
    until(lambda: starting_engine(RIG) or running_engines(), "the process has announced itself")
    client = launch.attach(RIG, "Ada")
    try:
        assert client.entry.pid == running.process.pid
        assert client.request("status").ok
        assert [entry.pid for entry in running_engines()] == [running.process.pid]
        assert starting_engine(RIG) is None
    finally:
        client.close()


def test_a_rig_that_is_being_connected_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    from rigapp.config.loading import read_rig
    from rigapp.simulation.handle import SimulationFailed

    go_on = threading.Event()

    def slow(*_: object, **__: object) -> None:
        assert go_on.wait(60.0)
        raise SimulationFailed("enough")

    monkeypatch.setattr("rigapp.service.simulated.start_simulated_rig", slow)
    host = EngineHost(read_rig(RIG), 1.0)
    try:
        connecting = Background(host.connect, "connect")
        until(lambda: host.engine.state is RunState.CONNECTING, "it connects")
        client = launch.attach(RIG)
        assert client.request("status").result["state"] == "connecting"
        client.close()
        go_on.set()
        assert connecting.wait(60.0)
        assert isinstance(connecting.error, SimulationFailed)
        assert host.engine.state is RunState.FAULT
    finally:
        host.close()


def test_a_start_that_takes_long_starts_no_second_engine(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = folder / "slow-python"
    program.write_text(f'#!/bin/sh\necho "$$" >> {folder}/started\nexec sleep 1000 # python\n')
    program.chmod(0o755)
    monkeypatch.setattr("sys.executable", str(program))
    monkeypatch.setattr(launch, "START_S", 0.2)
    monkeypatch.setattr("rigapp.process.stale_files.pid_exists", lambda pid: True)
    for _ in range(3):
        with pytest.raises(EngineUnreachable, match=r"is still starting after 0\.2 s"):
            launch.attach(RIG)
    until((folder / "started").exists, "the engine was started")
    pids = [int(line) for line in (folder / "started").read_text().split()]
    found = starting_engine(RIG)
    for pid in pids:
        os.kill(pid, signal.SIGKILL)
    assert pids == [found]
    until(lambda: not process_alive(pids[0]), "its end was taken note of")


def test_windows_that_look_at_once_start_one_engine(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[Path] = []

    def start(rig: Path) -> tuple[int, Path]:
        started.append(rig)
        launch.announce_start(rig, os.getpid())
        return os.getpid(), folder / "log"

    monkeypatch.setattr(launch, "_start", start)
    monkeypatch.setattr(launch, "START_S", 0.2)
    attempts = [Background(lambda: launch.attach(RIG), f"window {n}") for n in range(5)]
    assert all(one.wait(60.0) for one in attempts)
    assert all(isinstance(one.error, EngineUnreachable) for one in attempts)
    assert len(started) == 1


def test_the_announcement_of_a_start_ends_with_it(folder: Path) -> None:
    with starting(RIG):
        assert starting_engine(RIG) == os.getpid()
        entry = json.loads((runtime_folder() / f"starting-{os.getpid()}.json").read_text())
        assert entry["rig"] == str(RIG.resolve())
    assert starting_engine(RIG) is None
