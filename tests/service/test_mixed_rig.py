"""A rig of real and simulated devices: each is what its port says, and the file tells which."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from commandline import program
from service.stories import EXAMPLES, recipe

from rigapp.config.loading import read_rig
from rigapp.simulation.handle import start_simulated_rig
from rigapp.storage import open_test

CHANNELS = EXAMPLES / "simulated_channels.toml"
CLIMATE = 'driver = "modbus_sensor"\n'


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return tmp_path


@pytest.fixture
def mixed(folder: Path) -> Iterator[Path]:
    """A rig file whose thermometer is on a port of its own, the rest simulated."""
    text = CHANNELS.read_text("utf-8")
    assert CLIMATE in text
    with start_simulated_rig(CHANNELS, speed=1.0, parameters=None) as laboratory:
        port = f'port = "{laboratory.urls["climate"]}"'
        path = folder / "rig.toml"
        path.write_text(text.replace(f'{CLIMATE}port = "simulated"', CLIMATE + port), "utf-8")
        yield path


@pytest.mark.long
def test_a_real_thermometer_on_the_simulated_rig(folder: Path, mixed: Path) -> None:
    out = folder / "t.h5"
    done = program("run", recipe(folder, 40, twin=False), "--rig", mixed, "--out", out)
    assert done.returncode == 0, done.stderr
    with open_test(out) as reader:
        assert reader.committed() == 40
        assert np.nanmedian(reader.column("room_temperature")) == pytest.approx(21.0, abs=0.2)
        assert reader.metadata()["simulated"]
    page = folder / "report.html"
    assert program("report", out, "--to", page).returncode == 0
    said = page.read_text("utf-8")
    assert "daq and drive were simulated: these are not measurements." in said


@pytest.mark.long
def test_a_simulated_thermometer_on_a_real_rig_is_alone_in_the_process(folder: Path) -> None:
    text = CHANNELS.read_text("utf-8")
    for name in ("gsv8", "roboclaw"):
        text = text.replace(
            f'driver = "{name}"\nport = "simulated"', f'driver = "{name}"\nport = "/dev/{name}"'
        )
    path = folder / "rig.toml"
    path.write_text(text.replace("analog_5", "thermocouple"), "utf-8")  # of no simulator
    rig = read_rig(path).record
    assert (rig.simulated, rig.simulated_samples) == (False, False)
    with start_simulated_rig(path, speed=1.0, parameters=None) as running:
        assert list(running.urls) == ["climate"]
        assert running.state()["speed_rpm"] == 0.0
    refused = program(
        "run", EXAMPLES / "quick.toml", "--rig", path, "--out", folder / "t.h5", "--speed", "2"
    )
    assert refused.returncode == 2
    assert "is not a simulated rig; leave --speed out" in refused.stderr


def test_simulation_in_the_file_of_a_real_rig_is_refused(folder: Path) -> None:
    path, out = folder / "rig.toml", folder / "t.h5"
    path.write_text(
        re.sub('port = "simulated"', 'port = "/dev/ttyACM0"', CHANNELS.read_text("utf-8"))
    )
    done = program("run", EXAMPLES / "quick.toml", "--rig", path, "--out", out)
    assert done.returncode == 2
    assert "remove the line [simulation] and the keys below it" in done.stderr
    assert not out.exists()
