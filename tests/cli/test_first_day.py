"""A technician's first day: boxes that another program is behind, from an empty folder to a test.

The boxes are simulated devices on pseudo-terminals in a process that rigapp has not started: for
``init``, ``check`` and ``run`` they are ports like any other.
"""

from __future__ import annotations

import fcntl
import json
import os
import pty
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from patience import PATIENCE_S

EXAMPLES = Path(__file__).parents[2] / "examples"
HERE = Path(__file__).parent
PROGRAM = [sys.executable, "-P", "-m", "rigapp"]
RUN_S = 400.0
"""Fifty revolutions at 30 rpm take 100 s; a busy computer is slow, not wrong."""

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def boxes(tmp_path: Path) -> Iterator[dict[str, str]]:
    """Switch a GSV-8 and a RoboClaw on; return their ports."""
    rig = tmp_path / "boxes.toml"
    text = (EXAMPLES / "simulated.toml").read_text("utf-8")
    rig.write_text(text.replace("speed = 20.0", "speed = 1.0"), "utf-8")
    foreign = subprocess.Popen(
        [*PROGRAM, "sim", str(rig)],
        stdout=subprocess.PIPE,
        env={**os.environ, "RIGAPP_RUNTIME_DIR": str(tmp_path / "foreign")},
        text=True,
    )
    assert foreign.stdout is not None
    yield json.loads(foreign.stdout.readline())
    foreign.terminate()
    foreign.wait(PATIENCE_S)
    foreign.stdout.close()


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Return what runs a command of the program in the folder of the new rig."""
    env = {**os.environ, "RIGAPP_RUNTIME_DIR": str(tmp_path / "run"), "COLUMNS": "400"}

    def ran(*words: str, timeout_s: float = PATIENCE_S) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*PROGRAM, *words],
            cwd=tmp_path / "my-rig",
            env=env,
            capture_output=True,
            text=True,
            timeout=timeout_s,
            check=False,
        )

    return ran


@pytest.fixture
def rig(tmp_path: Path, boxes: dict[str, str]) -> Path:
    """Answer the questions of ``init --real`` on a terminal; return the rig file."""
    ours, theirs = pty.openpty()
    asking = subprocess.Popen(
        [*PROGRAM, "init", "--real", "my-rig"],
        cwd=tmp_path,
        stdin=theirs,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        os.write(ours, f"gsv8\n{boxes['daq']}\nroboclaw\n{boxes['drive']}\n".encode())
        said, _ = asking.communicate(timeout=PATIENCE_S)
    finally:
        asking.kill()
        os.close(ours)
        os.close(theirs)
    assert asking.returncode == 0, said
    return tmp_path / "my-rig" / "rig.toml"


def with_ports(rig: Path, name: str, **ports: str) -> str:
    """Write the rig file anew with other ports; return its name."""
    lines, device = [], ""
    for line in rig.read_text("utf-8").splitlines():
        if line.startswith("["):
            device = line.strip("[]").removeprefix("devices.")
        is_port = line.startswith("port = ") and device in ports
        lines.append(f"port = {json.dumps(ports[device])}" if is_port else line)
    (rig.parent / name).write_text("\n".join(lines), "utf-8")
    return name


def blocks(run: Run, rig: str) -> list[str]:
    """Return what keeps a test from starting on a rig, as ``check`` says it."""
    done = run("check", rig, "test.toml", "--json")
    assert "Traceback" not in done.stderr
    return [
        f"{one['what']} {one['finding']} {one['action']}"
        for one in json.loads(done.stdout)["checks"]
        if one["verdict"] == "blocks"
    ]


@pytest.mark.long
@pytest.mark.timeout(900)
def test_from_an_empty_folder_to_fifty_revolutions(rig: Path, run: Run) -> None:
    assert blocks(run, "rig.toml") == []
    done = run("run", "test.toml", "--rig", "rig.toml", "--out", "first.h5", timeout_s=RUN_S)
    assert done.returncode == 0, done.stderr
    told = json.loads(run("info", "first.h5", "--json").stdout)
    assert (told["status"], told["revolutions"], told["gaps"]) == ("complete", 50, 0)
    assert run("report", "first.h5", "--to", "first.html").returncode == 0


@pytest.mark.long
@pytest.mark.timeout(600)
def test_each_mistake_of_the_first_day_is_named_with_what_helps(
    rig: Path, run: Run, boxes: dict[str, str]
) -> None:
    exchanged = with_ports(rig, "exchanged.toml", daq=boxes["drive"], drive=boxes["daq"])
    told = blocks(run, exchanged)
    assert len(told) == 2, "both devices are named, not the first alone"
    assert "GSV-8 answers here (serial number 20123456)" in told[0]
    assert "Roboclaw 2x30a answers here" in told[1]
    assert all("troubleshooting.md#another-device-answers" in one for one in told)

    absent = with_ports(rig, "absent.toml", drive="/dev/ttyACM99")
    (told_absent,) = blocks(run, absent)
    assert "/dev/ttyACM99: there is no such port" in told_absent
    assert "troubleshooting.md#nothing-answers" in told_absent
    done = run("run", "test.toml", "--rig", absent, "--out", "absent.h5")
    assert done.returncode == 3
    assert done.stderr.endswith("    See troubleshooting.md#nothing-answers\n")
    assert not (rig.parent / "absent.h5").exists()

    with open(os.open(boxes["daq"], os.O_RDWR | os.O_NOCTTY), "rb") as held:
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        (told_held,) = blocks(run, "rig.toml")
    assert "in use by another program, " in told_held
    assert "troubleshooting.md#the-port-is-in-use" in told_held
    assert blocks(run, "rig.toml") == [], "nothing is left behind"


@pytest.mark.long
@pytest.mark.timeout(600)
def test_a_late_line_is_named_with_the_key_to_change_and_works_then(
    rig: Path, run: Run, boxes: dict[str, str]
) -> None:
    with subprocess.Popen(
        [sys.executable, str(HERE / "late_line.py"), boxes["drive"], "0.15"],
        stdout=subprocess.PIPE,
        text=True,
    ) as line:
        try:
            assert line.stdout is not None
            late = with_ports(rig, "late.toml", drive=line.stdout.readline().strip())
            done = run("check", late, "test.toml")
            assert done.returncode == 0, done.stdout
            (told,) = [one for one in done.stdout.splitlines() if "Device drive" in one]
            assert "answers come up to 0.1" in told
            assert "set reply_timeout_ms to" in told
            text = (rig.parent / late).read_text("utf-8")
            mended = text.replace("# reply_timeout_ms = 100.0", "reply_timeout_ms = 300.0")
            assert mended != text
            (rig.parent / late).write_text(mended, "utf-8")
            done = run("check", late, "test.toml")
            assert "reply_timeout_ms" not in done.stdout + done.stderr
            done = run(
                "run", "test.toml", "--rig", late, "--out", "late.h5", "--revolutions", "5",
                timeout_s=RUN_S,
            )  # fmt: skip
            assert done.returncode == 0, done.stderr
        finally:
            line.kill()
