"""Each recipe of CONTRIBUTING.md works as it stands there, in no more files than it may."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest
from house.recipes import TOP, copy_of_the_source, files, follow, headings, inside
from patience import PATIENCE_S

EXAMPLES = TOP / "examples"
MOST_FILES = {
    "A channel": 1,
    "A driver": 2,
    "A joint technique": 2,
    "A stop criterion": 2,
    "A cause of alarms": 2,
    "A column": 2,
    "A panel": 2,
    "A verb": 2,
    "A subject of a calibration": 4,
}
"""What a change may cost; beyond it a list is written in one place too many."""

OF_ITS_OWN = ("A channel", "A driver")
"""Recipes that change nothing of the source."""


def test_no_recipe_touches_more_files_than_it_may() -> None:
    assert {title: len(files(title)) for title in headings()} == MOST_FILES


@pytest.fixture(scope="module")
def changed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a copy of the source in which all recipes were followed."""
    folder = copy_of_the_source(tmp_path_factory.mktemp("changed"))
    for title in MOST_FILES:
        if title not in OF_ITS_OWN:
            follow(title, folder)
    return folder


def run(folder: Path, code: str) -> str:
    """Run a few lines in a changed copy; return what they print."""
    done = inside(folder, "-c", code)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_technique_is_solved_predicted_and_named_by_the_help(changed: Path) -> None:
    where = ("--rpm", "30", "--clearance-mm", "0.5", "--to")
    for joint in ("fixed", "continuous"):
        asked = ("model", "forces", EXAMPLES / "parameters.toml", "--joint", joint, *where)
        done = inside(changed, "-m", "rigapp", *asked, f"{joint}.csv")
        assert done.returncode == 0, done.stderr
    assert (changed / "fixed.csv").read_text() == (changed / "continuous.csv").read_text()
    shown = inside(changed, "-m", "rigapp", "model", "wear", "--help").stdout
    assert "fixed" in shown


@pytest.fixture(scope="module")
def ended(changed: Path) -> subprocess.CompletedProcess[str]:
    """Return what was said of a test with the new channels, technique and criterion, ``t.h5``."""
    shutil.copy(EXAMPLES / "simulated.toml", changed / "rig.toml")
    follow("A channel", changed)
    text = (EXAMPLES / "quick.toml").read_text("utf-8")
    text = text.replace('joint = "continuous"', 'joint = "fixed"', 1)
    rule = '[[limits.rule]]\nquantity = "bushing_temperature_max"\nwarning_above = 15.0\n'
    stop = "[stop]\nforce_rms_N = 5.0\nforce_revolutions = 12\n"
    (changed / "test.toml").write_text(f"{text}\n{rule}\n{stop}", "utf-8")
    where = ("--rig", "rig.toml", "--out", "t.h5", "--speed", "max")
    return inside(changed, "-m", "rigapp", "run", "test.toml", *where)


@pytest.mark.long
def test_a_criterion_ends_a_test_and_says_so(ended: subprocess.CompletedProcess[str]) -> None:
    assert ended.returncode == 1, ended.stderr
    assert "The RMS of |F| was at or above 5 N in 12 revolutions" in ended.stdout + ended.stderr


@pytest.mark.long
def test_channels_are_recorded_limited_and_exported(
    changed: Path, ended: subprocess.CompletedProcess[str]
) -> None:
    with h5py.File(changed / "t.h5") as file:
        rows = file["/entry/revolutions"]
        committed = int(rows["committed"][()])
        assert committed > 12
        for statistic in ("max", "min", "rms", "mean"):
            one = rows[f"bushing_temperature_{statistic}"]
            assert one.attrs["units"] == "degC"
            assert np.all(np.abs(one[:committed] - 21.0) < 5.0)
        assert rows["sled_position_max"].attrs["units"] == "um"
        assert rows["motor_current"].attrs["units"] == "A"
        assert 0.0 <= rows["motor_current_age"][committed - 1] < PATIENCE_S
        assert {"bushing_temperature", "sled_position"} <= set(file["/entry/cycles"])
        events = [text.decode() for text in file["/entry/events/text"][:]]
        assert any("bushing_temperature_max" in text for text in events), events
    done = inside(changed, "-m", "rigapp", "export", "t.h5", "--to", "t.csv")
    assert done.returncode == 0, done.stderr
    named = (changed / "t.csv").read_text("utf-8").splitlines()[0].split(",")
    assert {"sled_position_mean_um", "motor_current_A", "motor_current_age_s"} <= set(named)
    done = inside(changed, "-m", "rigapp", "report", "t.h5", "--to", "t.html")
    assert done.returncode == 0, done.stderr
    report = (changed / "t.html").read_text("utf-8")
    assert all(one in report for one in ("bushing_temperature", "sled_position", "motor_current"))


@pytest.mark.long
def test_a_cause_raises_an_alarm_that_the_file_keeps(
    changed: Path, ended: subprocess.CompletedProcess[str]
) -> None:
    with h5py.File(changed / "t.h5") as file:
        keys = [key.decode() for key in file["/entry/events/key"][:]]
        texts = [text.decode() for text in file["/entry/events/text"][:]]
    assert any(
        "samples only" in texts[place] for place, key in enumerate(keys) if key == "few_samples"
    )


@pytest.mark.long
def test_a_subject_is_fitted_kept_and_certified(changed: Path) -> None:
    (changed / "settings.toml").write_text('schema = 1\n[thermometer]\nname = "T 1"\n', "utf-8")
    calibrate = ("-m", "rigapp", "calibrate")
    given = ("--settings", "settings.toml", "--readings", "readings.csv", "--to", "t.record")
    readings = changed / "readings.csv"
    readings.write_text("reference_degC,signal_V\n10,0.1\n20,0.2\n", "utf-8")
    refused = inside(changed, *calibrate, "thermometer", *given)
    assert refused.returncode == 1
    assert "2 different readings; take 3 or more." in refused.stderr
    readings.write_text("reference_degC,signal_V\n10,0.1\n20,0.2\n31,0.31\n", "utf-8")
    done = inside(changed, *calibrate, "thermometer", *given)
    assert done.returncode == 0, done.stderr
    assert "Temperature = 100 degC/V" in done.stdout
    done = inside(changed, *calibrate, "certificate", "t.record", "--to", "certificate.html")
    assert done.returncode == 0, done.stderr
    assert "Certificate of calibration: T 1" in (changed / "certificate.html").read_text("utf-8")


@pytest.mark.long
def test_a_column_is_stored_with_its_unit_and_sentence(
    changed: Path, ended: subprocess.CompletedProcess[str]
) -> None:
    with h5py.File(changed / "t.h5") as file:
        counted = file["/entry/revolutions/counted"]
        assert "turns of the crank" in counted.attrs["long_name"]
        committed = int(file["/entry/revolutions/committed"][()])
        np.testing.assert_allclose(counted[1:committed], 1.0, rtol=0.01)


@pytest.mark.long
def test_a_panel_is_a_tab_and_told_the_news(
    changed: Path, ended: subprocess.CompletedProcess[str]
) -> None:
    assert run(changed, LOOK_AT_THE_PANEL).strip().endswith(" rpm")


LOOK_AT_THE_PANEL = f"""
import time
from pathlib import Path
from PySide6.QtWidgets import QApplication
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest
from rigapp.gui.panels.steadiness import SteadinessPanel
from rigapp.presentation.tokens import LIGHT
from rigapp.gui.window.window import MainWindow
from rigapp.replay.client import ReplayClient
application = QApplication([])
client = ReplayClient(Path("t.h5"), at_end=True)
window = MainWindow(EngineConnection(lambda: client), ShownTest(), LIGHT)
window.show()
panel = window.findChild(SteadinessPanel)
window.tabs.setCurrentIndex(0)
deadline = time.monotonic() + {PATIENCE_S}
while not panel.text():
    assert time.monotonic() < deadline
    window.tick()
    application.processEvents()
print(panel.text())
window.close()
"""


@pytest.mark.long
def test_a_verb_is_carried_out_for_who_may(changed: Path) -> None:
    said = run(
        changed,
        "import logging\n"
        "from pathlib import Path\n"
        "from rigapp.config.loading import read_rig\n"
        "from rigapp.schema.messages import Request\n"
        "from rigapp.service.host import EngineHost\n"
        f"host = EngineHost(read_rig(Path({str(EXAMPLES / 'simulated.toml')!r})), 1.0)\n"
        "try:\n"
        "    heard, log = [], logging.getLogger('rigapp.engine.core')\n"
        "    log.setLevel(logging.INFO)\n"
        "    log.addFilter(lambda line: heard.append(line.args[2:]))\n"
        "    print(host.handle(Request('oiled', {'reason': 'It squeaked.'}, operator='Ada')).ok)\n"
        "    print(host.handle(Request('oiled', {'reason': 1})).sentence)\n"
        "    print(heard)\n"
        "finally:\n"
        "    host.close()\n",
    )
    done, refused, events = said.splitlines()
    assert done == "True"
    assert "reason" in refused
    assert events == "[('Ada', 'The guide was oiled. It squeaked.')]"


def test_a_driver_is_found_and_reads(tmp_path: Path) -> None:
    package = tmp_path / "package"
    package.mkdir()
    follow("A driver", package)
    site = tmp_path / "site"
    install = ("-m", "pip", "install", "--no-deps", "--no-build-isolation", "--no-index", "--quiet")
    done = inside(package, *install, "--target", site, package)
    assert done.returncode == 0, done.stderr
    said = run(
        site,
        "import os, pty, threading, tty\n"
        "from rigapp_drivers.api import SlowRequest\n"
        "from rigapp_drivers.registry import load_driver\n"
        "device, port = pty.openpty()\n"
        "tty.setraw(device)\n"
        "def answer():\n"
        "    while os.read(device, 16):\n"
        "        os.write(device, b'21.5\\n')\n"
        "threading.Thread(target=answer, daemon=True).start()\n"
        "found = load_driver('line_thermometer')\n"
        "one = found.factory('room', os.ttyname(port), {})\n"
        "one.open()\n"
        "one.configure(SlowRequest(found.quantities))\n"
        "print(one.read())\n"
        "one.close()\n",
    )
    assert said.strip() == "{'temperature_C': 21.5}"
