"""The simulated rig as a process: URLs, signals, faults, truth, watchdog, a parent that dies."""

from __future__ import annotations

import json
import select
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import numpy as np
import pytest
import serial
from numpy.typing import NDArray
from patience import PATIENCE_S

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.simulation.process import SimulatedRig, main, start_simulated_rig
from rigapp_drivers.api import DriveRequest, Spindle
from rigapp_drivers.registry import load_driver

FRAME = 20
HERE = Path(__file__).parent


def wait_for(condition: Callable[[], bool], what: str, deadline_s: float = 60.0) -> None:
    end = time.monotonic() + deadline_s
    while not condition():
        assert time.monotonic() < end, f"waited {deadline_s} s for {what}"
        time.sleep(0.02)


@pytest.fixture
def plugged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Install the double as a third-party package for the processes that start here."""
    site = tmp_path / "site"
    info = site / "rigapp_double-1.0.dist-info"
    info.mkdir(parents=True)
    shutil.copy(HERE / "plugin" / "double_source.py", site)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: rigapp-double\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[rigapp.drivers]\ndouble = double_source:DRIVER\n")
    monkeypatch.setenv("PYTHONPATH", str(site))
    return site


@pytest.fixture
def rig_file(rig_path: Path, tmp_path: Path, plugged: Path) -> Path:
    text = rig_path.read_text("utf-8").replace('driver = "gsv8"', 'driver = "double"')
    path = tmp_path / "rig.toml"
    path.write_text(text, "utf-8")
    return path


@pytest.fixture
def start(rig_file: Path) -> Iterator[Callable[..., SimulatedRig]]:
    running: list[SimulatedRig] = []

    def run(speed: float | str = 1.0, **options: object) -> SimulatedRig:
        options = {"parameters": None, **options}
        rig = start_simulated_rig(rig_file, speed=speed, **options)  # type: ignore[arg-type]
        running.append(rig)
        return rig

    yield run
    for rig in running:
        rig.close()


def spindle(rig: SimulatedRig) -> Spindle:
    driver = load_driver("roboclaw").factory("drive", rig.urls["drive"], {})
    assert isinstance(driver, Spindle)
    driver.open()
    driver.configure(DriveRequest(3600, 1, 11.7, 0.5))
    return driver


def command(rig_file: Path, *options: str) -> list[str]:
    return [sys.executable, "-m", "rigapp.simulation.process", str(rig_file), *options]


@pytest.mark.long
@pytest.mark.parametrize(
    "number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.long)]
)
def test_prints_one_line_of_urls_and_ends_quietly(rig_file: Path, number: signal.Signals) -> None:
    process = subprocess.Popen(
        command(rig_file),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    assert process.stdout is not None
    assert select.select([process.stdout], [], [], 60.0)[0]
    urls = json.loads(process.stdout.readline())
    assert list(urls) == ["daq", "drive"]
    for url in urls.values():
        with serial.serial_for_url(url, timeout=0.1):
            pass
    process.send_signal(number)
    rest, complaints = process.communicate(timeout=PATIENCE_S)
    assert (process.returncode, rest, complaints) == (0, b"", b"")
    assert not any(Path(url).exists() for url in urls.values())


def test_unusable_rig_is_one_sentence(
    rig_file: Path,
    plugged: Path,
    capfd: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(plugged)
    text = rig_file.read_text("utf-8")
    wrong = rig_file.with_name("wrong.toml")
    for good, bad, culprit in (
        ('driver = "roboclaw"', 'driver = "robocalw"', "robocalw"),
        ('input_1 = "analog_1"', 'input_1 = "analog_2"', "each needs an input of its own"),
        ("[[200.0, 0.0], [0.0, 200.0]]", "[[200.0, 0.0], [200.0, 0.0]]", "matrix"),
    ):
        wrong.write_text(text.replace(good, bad), "utf-8")
        assert main([str(wrong)]) == 2
        out, complaint = capfd.readouterr()
        assert out == ""
        assert culprit in complaint
        assert complaint.count("\n") == 1
    assert main([str(rig_file), "--speed", "fast"]) == 2
    assert "--speed fast" in capfd.readouterr().err


def test_handle_raises_the_sentence_of_a_rig_that_cannot_start(tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match="there is no such file"):
        start_simulated_rig(tmp_path / "none.toml", speed=1.0, parameters=None)


def test_drive_turns_the_spindle_until_the_host_falls_silent(
    start: Callable[..., SimulatedRig], parameters: ParameterFile
) -> None:
    rig = start(parameters=parameters)
    drive = spindle(rig)
    drive.set_speed(0.8, 4.0)

    silent = 0.0

    def at_speed() -> bool:
        nonlocal silent
        silent = time.monotonic()
        return drive.status().speed_rev_per_s > 0.76

    wait_for(at_speed, "0.8 rev/s")
    state = rig.state()
    assert state["speed_rpm"] == pytest.approx(48.0, rel=0.1)
    assert state["drive_mode"] == "velocity"
    assert not state["watchdog_tripped"]
    wait_for(lambda: rig.state()["watchdog_tripped"], "the watchdog")
    assert time.monotonic() - silent > 0.3
    wait_for(lambda: abs(rig.state()["speed_rpm"]) < 0.01, "standstill")


def read_stream(host: serial.SerialBase, count: int) -> NDArray[np.float32]:
    data = b""
    deadline = time.monotonic() + 60.0
    while len(data) < count * FRAME:
        assert time.monotonic() < deadline, f"{len(data)} bytes came in 60 s"
        data += host.read(4096)
    whole = len(data) // FRAME * FRAME
    return np.frombuffer(data[:whole], "<f4").reshape(-1, 5)


def test_as_fast_as_the_host_reads_and_the_truth_is_told(
    start: Callable[..., SimulatedRig], tmp_path: Path
) -> None:
    truth = tmp_path / "truth.npz"
    rig = start("max", truth=truth)
    drive = spindle(rig)
    with serial.serial_for_url(rig.urls["daq"], timeout=0.01) as host:
        drive.set_speed(1.0, 4.0)
        host.write(b"S")
        frames = read_stream(host, 4800)
        state = rig.state()
        host.write(b"P")
    drive.drive_off()
    assert rig.state()["overruns"] == {"daq": 0, "drive": 0}
    assert state["time_s"] > 5.0
    rig.close()
    with np.load(truth) as table:
        shaft, force = table["shaft_revolutions"], table["force_n1_N"]
        told = np.interp(
            frames[-960:, 0], shaft[np.gradient(shaft) > 0], force[np.gradient(shaft) > 0]
        )
    # Force on the pin = 200 N/(mV/V) times signal = -F; filter delay, cross-talk, noise, 2 N steps.
    assert np.std(-200.0 * frames[-960:, 2] - told) < 3.0
    assert np.ptp(told) > 60.0


def test_faults_come_through_the_handle(start: Callable[..., SimulatedRig]) -> None:
    rig = start()
    drive = spindle(rig)
    rig.inject({"kind": "emergency_stop", "device": "drive"})
    wait_for(lambda: drive.status().emergency_stop, "the emergency stop")
    rig.clear("emergency_stop")
    rig.inject({"fault": "cable_pull", "device": "daq", "duration_s": 0.3})
    assert not Path(rig.urls["daq"]).exists()
    wait_for(lambda: Path(rig.urls["daq"]).exists(), "the cable to be back")
    with pytest.raises(UnusableInput, match="not in the rig"):
        rig.inject({"kind": "hang", "device": "nothing"})
    rig.hand("take_off_follower")
    rig.hand("turn_pin", angle_deg=90.0)
    assert rig.state()["angle_deg"] == pytest.approx(90.0)
    assert rig.alive()


@pytest.mark.long
def test_fault_file_and_mechanism_of_a_test(
    rig_file: Path, tmp_path: Path, parameters: ParameterFile
) -> None:
    faults = tmp_path / "faults.toml"
    faults.write_text(
        'schema = 1\n[[fault]]\nkind = "cable_pull"\ndevice = "daq"\nat_s = 0.2\n', "utf-8"
    )
    light = msgspec.structs.replace(parameters, spring=None)
    with start_simulated_rig(rig_file, speed=1.0, parameters=light, faults=faults) as rig:
        wait_for(lambda: not Path(rig.urls["daq"]).exists(), "the cable to be pulled")
        assert rig.state()["joint_force_N"] == pytest.approx(0.0, abs=1e-9)
    assert not rig.alive()


@pytest.mark.long
def test_sockets_in_place_of_ptys(rig_file: Path) -> None:
    process = subprocess.Popen(
        command(rig_file, "--sockets", "--exit-with-parent"),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
    )
    assert process.stdout is not None
    assert process.stdin is not None
    assert select.select([process.stdout], [], [], 60.0)[0]
    urls = json.loads(process.stdout.readline())
    with serial.serial_for_url(urls["daq"], timeout=0.05) as host:
        host.write(b"S")
        assert np.ptp(read_stream(host, 100)[:, 0]) == 0.0
    process.stdin.close()
    assert process.wait(60.0) == 0
    process.stdout.close()


def test_outlives_its_parent_until_the_spindle_stands_still(rig_file: Path) -> None:
    parent = (
        "import os, sys, json, pathlib, time\n"
        "from rigapp.simulation.process import start_simulated_rig\n"
        "from rigapp_drivers.registry import load_driver\n"
        "from rigapp_drivers.api import DriveRequest\n"
        "from rigapp.simulation.constants import packaged_parameters\n"
        "import msgspec\n"
        "light = msgspec.structs.replace(packaged_parameters(), spring=None)\n"
        "rig = start_simulated_rig(pathlib.Path(sys.argv[1]), speed='max', parameters=light)\n"
        "drive = load_driver('roboclaw').factory('drive', rig.urls['drive'], {})\n"
        "drive.open(); drive.configure(DriveRequest(3600, 1, 11.7, 0.5))\n"
        "drive.set_speed(0.5, 4.0)\n"
        "while drive.status().speed_rev_per_s < 0.4: pass\n"
        "print(rig.pid, time.monotonic(), flush=True); os._exit(9)\n"
    )
    started = subprocess.run(
        [sys.executable, "-c", parent, str(rig_file)],
        capture_output=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert started.returncode == 9, started.stderr.decode()
    pid, died = int(started.stdout.split()[0]), float(started.stdout.split()[1])
    wait_for(lambda: not running(pid), "the orphaned rig to end")
    assert time.monotonic() - died > 0.3, "it must go on until its watchdog has stopped the spindle"


def running(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"
