"""Wear tests from the command line, as a person runs them: the whole chain over real wire bytes."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from commandline import program, rigapp
from patience import PATIENCE_S

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated.toml"
QUICK = EXAMPLES / "quick.toml"
COMMAND = [sys.executable, "-m", "rigapp"]
NEVER_OVER = ("--revolutions", "5000")


@pytest.fixture(autouse=True)
def _own_runtime_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))


class Running:
    """A test in progress with its milestones."""

    def __init__(self, *arguments: str | Path) -> None:
        self.process = subprocess.Popen(
            [*COMMAND, *map(str, arguments), "--progress", "json"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.events: list[dict[str, Any]] = []

    def until(self, wanted: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            event = json.loads(line)
            self.events.append(event)
            if wanted(event):
                return event
        raise AssertionError(f"it ended before: {self.events[-3:]} {self.complaint()}")

    def committed(self, revolutions: int) -> int:
        event = self.until(lambda e: e["event"] == "committed" and e["revolutions"] >= revolutions)
        return int(event["revolutions"])

    def complaint(self) -> str:
        assert self.process.stderr is not None
        return self.process.stderr.read()

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


def info(path: Path) -> dict[str, Any]:
    done = rigapp("info", path, "--json")
    assert done.returncode == 0, done.stderr
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def until(condition: Callable[[], bool], what: str, seconds: float = PATIENCE_S) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"not within {seconds:g} s: {what}"
        time.sleep(0.02)


def test_complete_run_is_exact_and_agrees_with_the_model(
    tmp_path: Path, running: Callable[..., Running]
) -> None:
    out = tmp_path / "t.h5"
    test = running("run", QUICK, "--rig", RIG, "--out", out, "--revolutions", "40")
    test.committed(20)
    with h5py.File(out) as live:
        assert live["/entry/revolutions/committed"][()] >= 20
    import xarray

    with xarray.open_dataset(out, group="/entry/revolutions", engine="h5netcdf") as data:
        assert "force_max" in data
    if shutil.which("h5dump"):
        subprocess.run(
            ["h5dump", "-H", str(out)], check=True, capture_output=True, timeout=PATIENCE_S
        )
    end = test.until(lambda e: e["event"] == "finished")
    assert end["reason"] == "complete"
    assert test.process.wait(PATIENCE_S) == 0
    counts = [e["revolutions"] for e in test.events if e["event"] == "committed"]
    assert counts == sorted(counts)
    summary = info(out)
    assert summary["status"] == "complete"
    assert summary["revolutions"] == 40
    assert summary["first_revolution"] == 1
    assert summary["last_revolution"] == 40
    assert summary["gaps"] == 0
    assert summary["cycles_saved"] >= 4
    with h5py.File(out) as data:
        rows = data["/entry/revolutions"]
        count = int(rows["committed"][()])
        assert count == 40
        assert np.array_equal(rows["revolution"][:count], np.arange(1, 41))
        steady = slice(20, count)
        twin = data["/entry/prediction"]
        predicted = int(twin["committed"][()])
        assert predicted > 20
        number = twin["revolution"][:predicted]
        at = {int(n): i for i, n in enumerate(rows["revolution"][:count])}
        keep = np.array([n in at and at[n] >= 20 for n in number])
        place = [at[int(n)] for n in number[keep]]
        for name, allowed in (("force_rms", 2.5), ("force_1_rms", 2.5), ("force_2_rms", 4.0)):
            measured = rows[name][:count][place]
            assert np.abs(measured - twin[name][:predicted][keep]).mean() < allowed, name
        assert np.median(twin["residual_1_rms"][:predicted][keep]) < 5.0
        assert np.median(twin["residual_2_rms"][:predicted][keep]) < 5.0
        assert rows["speed"][steady].mean() == pytest.approx(60.0, rel=0.02)


@pytest.mark.long
def test_killed_engine_leaves_every_committed_revolution(
    tmp_path: Path, running: Callable[..., Running]
) -> None:
    out = tmp_path / "t.h5"
    test = running("run", QUICK, "--rig", RIG, "--out", out, *NEVER_OVER)
    announced = test.committed(15)
    test.process.send_signal(signal.SIGKILL)
    test.process.wait(10)
    summary = info(out)
    assert summary["status"] == "interrupted"
    assert summary["revolutions"] >= announced
    again = running("resume", out, "--rig", RIG)
    again.committed(summary["revolutions"] + 5)
    again.process.send_signal(signal.SIGINT)
    assert again.until(lambda e: e["event"] == "finished")["reason"] == "operator"
    assert again.process.wait(PATIENCE_S) == 1
    after = info(out)
    assert after["status"] == "stopped"
    assert after["gaps"] >= 1
    with h5py.File(out) as data:
        rows = data["/entry/revolutions"]
        number = rows["revolution"][: int(rows["committed"][()])]
        assert np.all(np.diff(number) > 0)


@pytest.fixture
def outside_rig(tmp_path: Path) -> Iterator[tuple[Path, subprocess.Popen[str], dict[str, str]]]:
    """A simulated rig in a process of its own, and a rig file that names its ports."""
    process = subprocess.Popen(
        [*COMMAND, "sim", str(RIG)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    urls = json.loads(process.stdout.readline())
    text = RIG.read_text()
    for name in ("daq", "drive"):
        head, tail = text.split(f"[devices.{name}]", 1)
        tail = tail.replace('port = "simulated"', f'port = "{urls[name]}"', 1)
        text = f"{head}[devices.{name}]{tail}"
    path = tmp_path / "rig.toml"
    path.write_text(re.sub(r"(?m)^\[simulation\]\n(?:(?!\[).*\n)*", "", text))
    yield path, process, urls
    process.kill()
    process.communicate()


def state_of(simulation: subprocess.Popen[str]) -> dict[str, Any]:
    """Ask the simulated rig itself: any byte to the drive would feed its watchdog."""
    assert simulation.stdin is not None
    assert simulation.stdout is not None
    simulation.stdin.write('{"query": "state"}\n')
    simulation.stdin.flush()
    state: dict[str, Any] = json.loads(simulation.stdout.readline())
    return state


@pytest.mark.long
def test_dead_engine_stops_the_spindle_by_the_drives_watchdog(
    tmp_path: Path,
    running: Callable[..., Running],
    outside_rig: tuple[Path, subprocess.Popen[str], dict[str, str]],
) -> None:
    rig, simulation, _ = outside_rig
    test = running("run", QUICK, "--rig", rig, "--out", tmp_path / "t.h5")
    test.committed(2)
    test.process.send_signal(signal.SIGKILL)
    test.process.wait(10)
    until(lambda: state_of(simulation)["watchdog_tripped"], "the drive's watchdog fires")
    until(lambda: abs(state_of(simulation)["speed_rpm"]) < 0.1, "the spindle is stationary")


@pytest.mark.long
def test_lost_daq_stops_the_spindle_and_names_the_port(
    tmp_path: Path,
    running: Callable[..., Running],
    outside_rig: tuple[Path, subprocess.Popen[str], dict[str, str]],
) -> None:
    rig, simulation, urls = outside_rig
    out = tmp_path / "t.h5"
    test = running("run", QUICK, "--rig", rig, "--out", out)
    announced = test.committed(2)
    simulation.send_signal(signal.SIGKILL)
    end = test.until(lambda e: e["event"] == "finished")
    assert end["reason"] == "device"
    assert test.process.wait(PATIENCE_S) == 3
    complaint = test.complaint()
    assert urls["daq"] in complaint or urls["drive"] in complaint
    assert "Traceback" not in complaint
    assert info(out)["revolutions"] >= announced
    assert info(out)["status"] == "stopped"


@pytest.mark.long
def test_interrupt_stops_under_control(tmp_path: Path, running: Callable[..., Running]) -> None:
    out = tmp_path / "t.h5"
    test = running("run", QUICK, "--rig", RIG, "--out", out, *NEVER_OVER)
    test.committed(5)
    os.kill(test.process.pid, signal.SIGTERM)
    assert test.until(lambda e: e["event"] == "finished")["reason"] == "operator"
    assert test.process.wait(PATIENCE_S) == 1
    assert info(out)["status"] == "stopped"


@pytest.mark.long
def test_limit_stops_the_test(tmp_path: Path) -> None:
    text = QUICK.read_text().replace("overload_N = 380.0", "overload_N = 60.0")
    recipe = tmp_path / "tight.toml"
    recipe.write_text(text)
    out = tmp_path / "t.h5"
    done = program("run", recipe, "--rig", RIG, "--out", out)
    assert done.returncode == 1, done.stderr
    summary = info(out)
    assert summary["status"] == "stopped"
    assert "60" in summary["reason"]


@pytest.mark.parametrize(
    ("prepare", "arguments", "needle"),
    [
        (lambda p: p.write_bytes(b"precious"), (), "not overwritten"),
        (lambda p: None, ("--speed", "fast"), "--speed fast"),
        (lambda p: None, ("--speed", "-1"), "--speed -1"),
        (lambda p: None, ("--speed", "1e300"), "--speed 1e+300 is outside 0.001 to 10000"),
        (lambda p: None, ("--progress", "xml"), "--progress xml"),
    ],
    ids=["existing", "speed", "negative speed", "endless speed", "progress"],
)
def test_unusable_input_is_one_sentence(
    tmp_path: Path, prepare: Callable[[Path], Any], arguments: tuple[str, ...], needle: str
) -> None:
    out = tmp_path / "t.h5"
    prepare(out)
    before = out.read_bytes() if out.exists() else None
    done = rigapp("run", QUICK, "--rig", RIG, "--out", out, *arguments)
    assert done.returncode == 2
    assert needle in done.stderr
    assert "Traceback" not in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert (out.read_bytes() if out.exists() else None) == before


@pytest.mark.long
def test_port_that_does_not_exist_is_a_device_failure(tmp_path: Path) -> None:
    text = RIG.read_text().replace('port = "simulated"', 'port = "/dev/ttyNOWHERE"', 1)
    rig = tmp_path / "rig.toml"
    rig.write_text(text)
    done = program("run", QUICK, "--rig", rig, "--out", tmp_path / "t.h5")
    assert done.returncode == 3
    assert "/dev/ttyNOWHERE" in done.stderr
    assert "daq" in done.stderr
    assert not (tmp_path / "t.h5").exists()


@pytest.mark.long
def test_check_shows_a_table_and_blocks_on_a_bad_speed(tmp_path: Path) -> None:
    good = rigapp("check", RIG, QUICK)
    assert good.returncode == 0, good.stdout + good.stderr
    recipe = tmp_path / "fast.toml"
    text = QUICK.read_text().replace("speed_rpm = 60.0", "speed_rpm = 900.0")
    recipe.write_text(text.replace("overspeed_rpm = 90.0", "overspeed_rpm = 999.0"))
    bad = rigapp("check", RIG, recipe)
    assert bad.returncode == 1
    assert "BLOCKS" in bad.stdout


def test_help_is_quick_to_read_and_wrong_calls_are_told() -> None:
    assert "Run one test without a window" in program("--help").stdout
    wrong = program("run")
    assert wrong.returncode == 2
    assert "Traceback" not in wrong.stderr


@pytest.mark.long
def test_a_pin_that_weighs_something_leaves_the_forces_as_they_are(tmp_path: Path) -> None:
    """9.8 N turn about the cell; the rig file states them, the test's mechanism is upright."""
    test = tmp_path / "test.toml"
    text = QUICK.read_text().replace("[0.0, 0.0]  ", "[0.0, -9.80665]  ", 1)
    assert "-9.80665]  " in text
    test.write_text(text)
    found = {}
    for name, mass, stated in (("light", 0.0, 0.0), ("heavy", 1.0, 9.80665), ("left", 1.0, 0.0)):
        rig, out = tmp_path / f"{name}.toml", tmp_path / f"{name}.h5"
        plain = RIG.read_text()
        head, tail = plain.split("[probes]")
        named = f"{head}pin_weight_N = {stated}\n[probes]{tail}"
        rig.write_text(
            named.replace(
                "[devices.daq]", f"[simulation.plant]\npin_mass_kg = {mass}\n[devices.daq]", 1
            )
        )
        rigapp("run", test, "--rig", rig, "--out", out, "--revolutions", "8", "--speed", "max")
        with h5py.File(out) as file:
            cycle = file["entry/cycles"]
            held = slice(0, cycle["count"][0])
            angle = np.radians(cycle["angle"][held])
            one, two = (cycle[f"force_{axis}"][held] for axis in (1, 2))
            found[name] = 2.0 * np.array(
                [np.mean(one * np.sin(angle)), np.mean(two * np.cos(angle))]
            )
    assert found["heavy"] == pytest.approx(found["light"], abs=0.2)
    assert found["left"] - found["light"] == pytest.approx(9.81, abs=0.2)
