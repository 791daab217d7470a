"""A drive that holds its emergency stop or a fault is released from the command line."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from rigapp.commands.status import reset_drive
from rigapp.config.toml import toml_text
from rigapp_drivers.api import DeviceFault, DeviceLost
from tests.engine.engine_doubles import MemoryRig


@pytest.fixture
def rig_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    path = tmp_path / "rig.toml"
    record = msgspec.to_builtins(MemoryRig().rig_file())
    del record["simulation"]  # refused in the file of a rig without simulated ports
    for device in record["devices"].values():
        device["port"] = "memory"
    path.write_text(toml_text(record), encoding="utf-8")
    return path


def test_a_latched_stop_is_reset_once_the_button_is_released(
    rig_file: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rig = MemoryRig()
    rig.spindle.latches_stop = rig.spindle.emergency_stop = True
    rig.spindle.status()
    rig.spindle.emergency_stop = False
    assert rig.spindle.status().emergency_stop, "the button is released, the drive holds its stop"
    assert reset_drive(rig_file, rig._load) == 0
    assert "the emergency stop was reset; the motor has no power" in capsys.readouterr().out
    assert not rig.spindle.status().emergency_stop
    assert reset_drive(rig_file, rig._load) == 0
    assert capsys.readouterr().out == "drive on memory: ready.\n"
    assert rig.spindle.commands == [], "nothing was turned"


def test_a_cause_that_remains_and_a_drive_that_is_gone_are_told(rig_file: Path) -> None:
    rig = MemoryRig()
    rig.spindle.faults, rig.spindle.cause_remains = ("overcurrent",), True
    with pytest.raises(DeviceFault, match="the cause is still there"):
        reset_drive(rig_file, rig._load)
    rig.spindle.lost = True
    with pytest.raises(DeviceLost, match="nothing answers"):
        reset_drive(rig_file, rig._load)
