"""What reads, analyses, models and calibrates from files needs no module of POSIX systems alone."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from commandline import program
from patience import PATIENCE_S

pytestmark = pytest.mark.long

EXAMPLES = Path(__file__).parents[2] / "examples"
CALIBRATION = EXAMPLES / "calibration"
CODE = """
import builtins, sys

POSIX = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "termios", "tty"}
OURS = {"rigapp", "rigapp_drivers", "rigapp_model", "rigapp_calibration"}
imported = builtins.__import__


def refusing(name, globals=None, locals=None, fromlist=(), level=0):
    by = (globals or {}).get("__name__", "").partition(".")[0]
    if level == 0 and name in POSIX and by in OURS:
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)
    return imported(name, globals, locals, fromlist, level)


builtins.__import__ = refusing
"""
VERBS = """
import json
from pathlib import Path
from rigapp.cli import main

ended = []
for words in json.loads(sys.argv[1]):
    sys.argv[1:] = words
    try:
        main()
    except SystemExit as end:
        ended.append(end.code)
    Path("ended.json").write_text(json.dumps(ended))
"""
"""One verb after another, in one process."""

ANALYSIS = """
import rigapp
test, many = rigapp.open(sys.argv[1]), rigapp.open_many(sys.argv[1])
print(test.status, test.revolutions.sizes["revolution"], many.table.sizes["test"])
"""
READING = {
    "info --json": "",
    "export --to t.csv": "t.csv",
    "export --to t.parquet": "t.parquet",
    "export --to cycles.csv --cycles": "cycles.csv",
    "report --to t.html": "t.html",
    "report --to t.pdf": "t.pdf",
    "identify": "",
    "picture --to t.png": "t.png",
    "package --to t.zip --allow-private": "t.zip",
}
"""What is asked of a recorded test, and the file that comes of it."""

MODEL = {
    "forces {parameters} --rpm 30 --to forces.csv": "forces.csv",
    "wear {parameters} --rpm 30 --cycles 1000 --to wear.csv": "wear.csv",
    "pressure {parameters} --force-N 100 --to pressure.csv": "pressure.csv",
}


def elsewhere(folder: Path, code: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run a few lines where these modules cannot be imported by the program."""
    return subprocess.run(
        [sys.executable, "-c", CODE + code, *map(str, arguments)],
        cwd=folder,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


def ended(folder: Path, *verbs: list[str]) -> tuple[list[int], str]:
    """Run verbs there, in a folder; return how each ended, and what was complained."""
    done = elsewhere(folder, VERBS, json.dumps(verbs))
    statuses: list[int] = json.loads((folder / "ended.json").read_text())
    assert len(statuses) == len(verbs), done.stderr
    return statuses, done.stderr


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the file of a short test, recorded as on any other day."""
    path = tmp_path_factory.mktemp("recorded") / "t.h5"
    plan, rig = EXAMPLES / "quick.toml", EXAMPLES / "simulated.toml"
    asked = ("--rig", rig, "--out", path, "--revolutions", "20", "--speed", "max")
    done = program("run", plan, *asked)
    assert done.returncode == 0, done.stderr
    return path


@pytest.fixture(scope="module")
def read(recorded: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[int], str]:
    """Return where everything was asked of the recorded test, and how each ended."""
    folder = tmp_path_factory.mktemp("read")
    asked = [line.split() for line in READING]
    return folder, *ended(folder, *([verb, str(recorded), *more] for verb, *more in asked))


@pytest.mark.parametrize("asked", READING)
def test_a_recorded_test_is_read(read: tuple[Path, list[int], str], asked: str) -> None:
    folder, statuses, complaint = read
    # Of so short a test no wear coefficient can be told, which is status 1.
    status = statuses[list(READING).index(asked)]
    assert status == (1 if asked == "identify" else 0), complaint
    made = READING[asked]
    assert not made or (folder / made).stat().st_size > 0


def test_it_is_analysed(recorded: Path, tmp_path: Path) -> None:
    done = elsewhere(tmp_path, ANALYSIS, recorded)
    assert (done.stdout, done.stderr) == ("complete 20 1\n", "")


def test_the_model_is_computed(tmp_path: Path) -> None:
    asked = (one.format(parameters=EXAMPLES / "parameters.toml").split() for one in MODEL)
    statuses, complaint = ended(tmp_path, *(["model", *words] for words in asked))
    assert statuses == [0, 0, 0], complaint
    assert all((tmp_path / made).stat().st_size > 0 for made in MODEL.values())


def test_readings_are_fitted_and_a_record_is_verified_and_certified(tmp_path: Path) -> None:
    verbs = []
    for subject in ("load_cell", "probes", "channel"):
        record, files = f"{subject}.json", str(CALIBRATION / subject)
        taken = ("--settings", f"{files}.toml", "--readings", f"{files}.csv")
        verbs += [
            [subject.replace("_", "-"), *taken, "--to", record],
            ["verify", record],
            ["certificate", record, "--to", f"{subject}.pdf"],
        ]
    statuses, complaint = ended(tmp_path, *(["calibrate", *words] for words in verbs))
    assert statuses == [0] * 9, complaint
