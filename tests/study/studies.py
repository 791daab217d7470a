"""Study files for tests, and a study as a process of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import msgspec

from rigapp.study.folder import IDENTITY
from rigapp.study.points import Batch, StudyRow, computed
from rigapp.study.running import read_study, write_power
from rigapp.study.table import sensitivities, write_tables

EXAMPLES = Path(__file__).parents[2] / "examples"
PRESSURE = """schema = 1
kind = "pressure"
parameters = "parameters.toml"
[run]
force_N = 100.0
[vary]
"joint.bushing_radius_mm" = { low = 9.6, high = 10.5 }
"run.force_N" = { low = 10.0, high = 300.0, scale = "log" }
[design]
kind = "sobol"
points = 64
"""


def written(folder: Path, text: str = PRESSURE) -> Path:
    """Write a study file beside the example's parameters; return its path."""
    folder.mkdir(exist_ok=True)
    shutil.copy(EXAMPLES / "parameters.toml", folder)
    path = folder / "study.toml"
    path.write_text(text, "utf-8")
    return path


def finished(folder: Path, text: str = PRESSURE, problems: Mapping[int, str] | None = None) -> Path:
    """Compute a study here and write its tables; problems: why points shall have no result."""
    study = read_study(written(folder.with_name(f"{folder.name}-file"), text))
    known, points = study.template, study.design.points
    rows = {
        one.number: one for one in computed(Batch(known.kind, known.parameters, known.run, points))
    }
    for number, why in (problems or {}).items():
        rows[number] = StudyRow(number, problem=why)
    folder.mkdir()
    (folder / IDENTITY).write_bytes(msgspec.json.encode(study.identity))
    shares = sensitivities(study.record, study.design, rows)
    write_tables(folder, study.record, study.design, study.identity, rows, shares)
    write_power(folder, study.record, study.design, rows)
    return folder


def command(study: Path, to: Path, *more: str) -> list[str]:
    """Return the command that runs a study with one worker."""
    return [sys.executable, "-m", "rigapp", "study", str(study), "--to", str(to), *more]


def started(study: Path, to: Path, *more: str) -> subprocess.Popen[str]:
    """Start a study."""
    return subprocess.Popen(
        command(study, to, *more),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
        start_new_session=True,
    )
