"""`rigapp init --real`: files for boxes that are there, not there, or asked for at a terminal."""

from __future__ import annotations

import io
import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S

from rigapp.commands.init import prepare_real_folder
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig, read_test
from rigapp.prepare.real_rig import Box, lasting_name, real_files
from rigapp_drivers.api import DriverKind
from rigapp_drivers.registry import available_drivers, load_driver

DRIVERS = [load_driver(name) for name in available_drivers()]
NOTHING = {"daq": ("", ""), "drive": ("", "")}


def of_kind(kind: DriverKind) -> list[str]:
    return [one.name for one in DRIVERS if one.kind is kind]


@pytest.mark.parametrize("daq", of_kind(DriverKind.DATA_SOURCE))
@pytest.mark.parametrize("drive", of_kind(DriverKind.SPINDLE))
def test_the_files_of_all_boxes_can_be_read(daq: str, drive: str, tmp_path: Path) -> None:
    boxes = [Box("daq", load_driver(daq), "/dev/ttyACM7"), Box("drive", load_driver(drive), "can0")]
    files = {str(one.path): one.text for one in real_files(boxes)}
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, "utf-8")
    rig = read_rig(tmp_path / "rig.toml").record
    assert (rig.devices["daq"].driver, rig.devices["daq"].port) == (daq, "/dev/ttyACM7")
    assert (rig.devices["drive"].driver, rig.devices["drive"].port) == (drive, "can0")
    assert rig.simulation is None
    assert read_test(tmp_path / "test.toml").record.run.revolutions == 50
    assert files["rig.toml"].startswith("#:schema ./rig.schema.json\n")
    assert "../rig.toml" in files["calibration/run_out.toml"]


def test_a_box_that_answers_nowhere_leaves_its_port_open_and_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ports = {"daq": ("gsv8", "/dev/ttyACM7"), "drive": ("roboclaw", "")}
    assert prepare_real_folder(tmp_path / "rig", ports) == 0
    said = capsys.readouterr().out
    assert "write its port at [devices.drive] in rig.toml" in said
    assert "[devices.daq]" not in said
    assert "NOT-FOUND" in read_rig(tmp_path / "rig" / "rig.toml").record.devices["drive"].port
    with pytest.raises(UnusableInput, match=r"rig\.toml.* already; nothing was written"):
        prepare_real_folder(tmp_path / "rig", ports)


@pytest.mark.parametrize(
    ("named", "words"),
    [
        (NOTHING, "Say --daq dataq or gsv8; there is no terminal to ask on"),
        ({**NOTHING, "daq": ("gsv8", "x")}, "Say --drive cia402 or roboclaw"),
        ({**NOTHING, "daq": ("roboclaw", "x")}, "--daq roboclaw: is no driver of a data acquis"),
    ],
)
def test_what_is_missing_is_said_where_nobody_can_be_asked(
    named: dict[str, tuple[str, str]], words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO())
    with pytest.raises(UnusableInput, match=words):
        prepare_real_folder(tmp_path / "rig", named)
    assert not (tmp_path / "rig").exists()


def test_it_is_asked_for_at_a_terminal(tmp_path: Path) -> None:
    ours, theirs = pty.openpty()
    folder = tmp_path / "rig"
    asking = subprocess.Popen(
        [sys.executable, "-m", "rigapp", "init", "--real", str(folder)],
        stdin=theirs, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        # A wrong word, a number, a port; then the drive's name, and Enter leaves its port open.
        os.write(ours, b"gsv9\n2\n/dev/ttyACM3\nroboclaw\n\n")
        said, _ = asking.communicate(timeout=PATIENCE_S)
    finally:
        asking.kill()
        os.close(ours)
        os.close(theirs)
    assert asking.returncode == 0, said
    assert "gsv9 is none of these" in said
    devices = read_rig(folder / "rig.toml").record.devices
    assert (devices["daq"].driver, devices["daq"].port) == ("gsv8", "/dev/ttyACM3")
    assert devices["drive"].driver == "roboclaw"
    assert "write its port at [devices.drive]" in said


def test_a_port_is_named_as_it_is_after_a_restart(tmp_path: Path) -> None:
    port = tmp_path / "ttyACM0"
    port.touch()
    (tmp_path / "by-id").mkdir()
    link = tmp_path / "by-id" / "usb-ME_GSV-8_20123456-if00"
    link.symlink_to(port)
    assert lasting_name(str(port), tmp_path / "by-id") == str(link)
    assert lasting_name("/dev/ttyS0", tmp_path / "by-id") == "/dev/ttyS0"
    assert lasting_name("/dev/ttyS0", tmp_path / "nowhere") == "/dev/ttyS0"
