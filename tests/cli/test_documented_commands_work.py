"""Every command of README and guides is run as it is written, or is run by a story of its own."""

from __future__ import annotations

import re
import shlex
import shutil
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
import typer
from house.test_documented_commands import PAGES, commands
from twin.recorded_plants import RECORDED, record

from rigapp.cli.program import app
from rigapp.commands.init import start_folder

TOP = Path(__file__).parents[2]

ELSEWHERE = {
    "calibrate load-cell --rig": "tests/gui_calibration/test_live_session.py",
    "calibrate probes --rig": "tests/gui_calibration/test_taken_up.py",
    "calibrate run-out": "tests/calibration/test_probe_roll.py",
    "calibrate running-check": "tests/calibration/test_running_check.py",
    "close": "tests/storage/test_checksums.py",
    "doctor --port": "tests/cli/test_doctor.py",
    "gui": "tests/gui/test_story.py",
    "init --real": "tests/prepare/test_real_files.py",
    "--install-completion": "tests/cli/test_help.py",
    "model forces --revolutions": "tests/model/mechanics/test_forces_table.py",
    "notify": "tests/notify/test_story.py",
    "package": "tests/publishing/test_package.py",
    "page": "tests/page/test_access.py",
    "queue": "tests/service/test_queue_story.py",
    "replay": "tests/gui/test_replay.py",
    "resume": "tests/gui/test_results.py",
    "reset": "tests/engine/test_reset_drive.py",
    "run": "tests/prepare/test_starting_files.py",
    "salvage": "tests/storage/test_checksums.py",
    "service": "tests/cli/test_service.py",
    "study": "tests/study/test_running.py",
    "wire": "tests/drivers/wire/test_wire.py",
}
"""Beginnings of commands that want hands, a screen or another process, and where they are run."""
NAMES = {
    "RIG.toml": "rig.toml",
    "TEST.toml": "test.toml",
    "PARAMS.toml": "parameters.toml",
    "FILE...": "test.h5",
    "FILE.h5...": "test.h5",
    "FILE.h5": "test.h5",
    "F": "60",
    "N": "2",
    "quick.h5": "test.h5",
    "first.h5": "test.h5",
}
"""What stands for a file or a number of the reader's -> what it is here."""
CHANNEL = {
    "readings.csv": "calibration/channel.csv",
    "settings.toml": "calibration/channel.toml",
}
"""The same of a scalar channel's calibration."""
TARGETS = ("--to", "--out")


def plain(command: str) -> list[str]:
    """Return the words of a command without what may be left out, with names of this folder."""
    words = shlex.split(re.sub(r"\[[^\]]*\]", "", command))
    names = NAMES | (CHANNEL if "channel" in words else {})
    return [names.get(one, one) for one in words]


def arguments(words: list[str]) -> list[str]:
    """Return what follows the verb but switches: without that a verb is only spoken of."""
    verb: Any = typer.main.get_command(app)
    while words and words[0] in getattr(verb, "commands", {}):
        verb, words = verb.commands[words[0]], words[1:]
    return [one for one in words if not one.startswith("-")]


def elsewhere(command: str) -> str:
    """Return the tests that run a command, nothing for one that is to be run here."""
    found = [one for one in ELSEWHERE if command.startswith(one)]
    return ELSEWHERE[max(found, key=len)] if found else ""


@pytest.fixture(scope="module")
def prepared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with what a reader of the guides has: rig, tests, readings, a recording."""
    made = tmp_path_factory.mktemp("reader")
    start_folder(made)
    record(made / "test.h5", 1.0, RECORDED)
    for name, source in {
        "readings.csv": "load_cell.csv",
        "settings.toml": "load_cell.toml",
        "probe.csv": "probes.csv",
        "probe.toml": "probes.toml",
    }.items():
        shutil.copy(made / "calibration" / source, made / name)
    return made


@pytest.fixture
def folder(prepared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a copy of it for one page, where the commands are typed."""
    made = shutil.copytree(prepared, tmp_path / "reader")
    monkeypatch.chdir(made)
    return made


def run(words: list[str], folder: Path) -> Any:
    """Run a command here; what it writes must not be there yet."""
    for option, target in pairwise(words):
        if option in TARGETS:
            (folder / target).unlink(missing_ok=True)
    return app(args=words, prog_name="rigapp", standalone_mode=False)


@pytest.mark.long
@pytest.mark.sampled
@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_the_commands_of_the_page_do_what_it_says(page: Path, folder: Path) -> None:
    failed = {}
    for command in commands(page.read_text("utf-8")):
        words = plain(command)
        if not arguments(words) or "VERB" in words or elsewhere(command):
            continue
        if status := run(words, folder):
            failed[command] = status
    assert failed == {}


def test_what_is_run_elsewhere_is_there() -> None:
    assert {place for place in ELSEWHERE.values() if not (TOP / place).is_file()} == set()
