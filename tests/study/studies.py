"""Study files for tests, and a study as a process of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

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
