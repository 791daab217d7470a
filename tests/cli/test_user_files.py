"""A user's files in the working folder are no modules of the program, whatever they are called."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from commandline import Done
from patience import PATIENCE_S
from study.studies import written

import rigapp as package
from rigapp.gui.results.results_index import ResultReader
from rigapp.service.launch import attach
from rigapp.storage import open_test

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated.toml"
NAMES = ["model", "drivers", "rigapp", "signal", "calibration", "statistics", "queue", "numpy"]
MODULE = 'raise SystemExit(f"{__file__} was imported")\n'


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder of a user, with files that are called as modules are."""
    for name in NAMES:
        (tmp_path / f"{name}.py").write_text(MODULE)
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def installed(*arguments: str | Path) -> Done:
    """Run the installed program, as a user does, in the working folder."""
    done = subprocess.run(
        [str(Path(sys.executable).parent / "rigapp"), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert "imported" not in done.stdout + done.stderr, done.stdout + done.stderr
    return done


@pytest.mark.long
def test_a_test_runs_with_model_and_messages_and_its_results_are_read(folder: Path) -> None:
    told, out = folder / "told.json", folder / "test.h5"
    keep = folder / "keep.sh"
    keep.write_text(f"#!/bin/sh\ncat > {told}\n")
    keep.chmod(0o755)
    rig = folder / "rig.toml"
    rig.write_text(f'{RIG.read_text()}\n[[notify]]\ncommand = ["{keep}"]\nwhen = ["end"]\n')
    done = installed(
        "run", EXAMPLES / "quick.toml", "--rig", rig, "--out", out, "--revolutions", "60"
    )
    assert done.returncode == 0, done.stderr
    with open_test(out) as reader:
        assert reader.committed("prediction") > 0
    reader = ResultReader([out])
    reader._thread.join(PATIENCE_S)
    assert [result.revolutions for result in reader.take()] == [60], reader.problem
    reader.close()
    for verb, *options in (("report", "--to", folder / "report.html"), ("identify", "--json")):
        assert installed(verb, out, *options).returncode in (0, 1)
    assert (folder / "report.html").exists()


def test_an_engine_is_started_for_a_window_and_a_calibration(folder: Path) -> None:
    client = attach(RIG, "Ada")
    try:
        assert client.request("connect").ok
    finally:
        client.request("shutdown")
        client.close()


@pytest.mark.long
def test_a_study_has_its_workers_and_the_window_is_tested(folder: Path) -> None:
    study = written(folder / "study")
    done = installed("study", study, "--to", folder / "table", "--workers", "1")
    assert done.returncode == 0, done.stderr
    assert "Window self test" in installed("doctor").stdout


def test_only_one_module_starts_python() -> None:
    """Whoever starts Python another way forgets that the working folder is no place for modules."""
    root = Path(package.__file__).parent
    starting = {
        str(path.relative_to(root))
        for path in root.rglob("*.py")
        if "sys.executable" in path.read_text(encoding="utf-8")
        or "import multiprocessing" in path.read_text(encoding="utf-8")
    }
    assert starting == {"process/children.py"}
