"""What reads, analyses, models and calibrates from files needs no module of POSIX systems alone."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S

EXAMPLES = Path(__file__).parents[2] / "examples"
CALIBRATION = EXAMPLES / "calibration"
CODE = """
import builtins, sys

POSIX = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "termios", "tty"}
OURS = {"rigapp", "drivers", "model", "calibration"}
imported = builtins.__import__


def refusing(name, globals=None, locals=None, fromlist=(), level=0):
    by = (globals or {}).get("__name__", "").partition(".")[0]
    if level == 0 and name in POSIX and by in OURS:
        raise ModuleNotFoundError(f"No module named {name!r}", name=name)
    return imported(name, globals, locals, fromlist, level)


builtins.__import__ = refusing
"""
VERB = "from rigapp.cli import main\nmain()\n"
ANALYSIS = """
import rigapp
test, many = rigapp.open(sys.argv[1]), rigapp.open_many(sys.argv[1])
print(test.status, test.revolutions.sizes["revolution"], many.table.sizes["test"])
"""


def elsewhere(
    folder: Path, *arguments: str | Path, code: str = VERB
) -> subprocess.CompletedProcess[str]:
    """Run a verb where these modules cannot be imported by the program."""
    return subprocess.run(
        [sys.executable, "-c", CODE + code, *map(str, arguments)],
        cwd=folder,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the file of a short test, recorded as on any other day."""
    path = tmp_path_factory.mktemp("recorded") / "t.h5"
    plan, rig = EXAMPLES / "quick.toml", EXAMPLES / "simulated.toml"
    asked = ["run", plan, "--rig", rig, "--out", path, "--revolutions", "20", "--speed", "max"]
    done = subprocess.run(
        [sys.executable, "-m", "rigapp", *map(str, asked)],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return path


@pytest.mark.parametrize(
    ("arguments", "made"),
    [
        ("info --json", ""),
        ("export --to t.csv", "t.csv"),
        ("export --to t.parquet", "t.parquet"),
        ("export --to cycles.csv --cycles", "cycles.csv"),
        ("report --to t.html", "t.html"),
        ("report --to t.pdf", "t.pdf"),
        ("identify", ""),
        ("picture --to t.png", "t.png"),
        ("package --to t.zip --allow-private", "t.zip"),
    ],
)
def test_a_recorded_test_is_read(recorded: Path, tmp_path: Path, arguments: str, made: str) -> None:
    verb, *options = arguments.split()
    done = elsewhere(tmp_path, verb, recorded, *options)
    # Of so short a test no wear coefficient can be told, which is status 1.
    assert done.returncode == (1 if verb == "identify" else 0), done.stderr
    assert not made or (tmp_path / made).stat().st_size > 0


def test_it_is_analysed(recorded: Path, tmp_path: Path) -> None:
    done = elsewhere(tmp_path, recorded, code=ANALYSIS)
    assert (done.stdout, done.stderr) == ("complete 20 1\n", "")


@pytest.mark.parametrize(
    "arguments",
    [
        "forces {parameters} --rpm 30 --to made.csv",
        "wear {parameters} --rpm 30 --cycles 1000 --to made.csv",
        "pressure {parameters} --force-N 100 --to made.csv",
    ],
)
def test_the_model_is_computed(tmp_path: Path, arguments: str) -> None:
    words = arguments.format(parameters=EXAMPLES / "parameters.toml").split()
    done = elsewhere(tmp_path, "model", *words)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "made.csv").stat().st_size > 0


def test_readings_are_fitted_and_a_record_is_verified_and_certified(tmp_path: Path) -> None:
    for subject in ("load_cell", "probes", "channel"):
        files = ("--settings", CALIBRATION / f"{subject}.toml")
        readings = ("--readings", CALIBRATION / f"{subject}.csv")
        record = tmp_path / f"{subject}.json"
        verb = ("calibrate", subject.replace("_", "-"))
        done = elsewhere(tmp_path, *verb, *files, *readings, "--to", record)
        assert done.returncode == 0, done.stderr
        for more in (("verify", record), ("certificate", record, "--to", f"{subject}.pdf")):
            done = elsewhere(tmp_path, "calibrate", *more)
            assert done.returncode == 0, done.stderr
