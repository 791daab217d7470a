"""Notebooks and the guide's examples run from top to bottom, as a newcomer would let them run."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S
from report.report_samples import eventful
from twin.recorded_plants import RECORDED, record

from rigapp.twin.link import IdentificationTarget

EXAMPLES = Path(__file__).parents[2] / "examples"
NOTEBOOKS = sorted(path.name for path in (EXAMPLES / "notebooks").glob("*.ipynb"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with what the notebooks open."""
    folder = tmp_path_factory.mktemp("notebooks")
    eventful(folder / "test.h5")
    (folder / "results").mkdir()
    record(folder / "results/first.h5", 1.1, RECORDED)
    record(folder / "results/second.h5", 0.8, RECORDED, 100)
    shutil.copy(EXAMPLES / "parameters.toml", folder)
    (folder / "examples").symlink_to(EXAMPLES)
    return folder


def cells(name: str) -> list[str]:
    """Return the code of a notebook, which keeps no results."""
    tree = json.loads((EXAMPLES / "notebooks" / name).read_text("utf-8"))
    code = [one for one in tree["cells"] if one["cell_type"] == "code"]
    assert all(one["outputs"] == [] for one in code)
    return ["".join(one["source"]) for one in code]


def test_there_is_a_notebook_for_each_question() -> None:
    assert NOTEBOOKS == [
        "compare_specimens.ipynb",
        "first_look.ipynb",
        "identify_wear_coefficient.ipynb",
        "model_as_a_library.ipynb",
    ]


@pytest.mark.long
@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_runs(folder: Path, name: str) -> None:
    place = folder / "notebooks"
    place.mkdir(exist_ok=True)
    assert "nan" not in run(place, cells(name))


@pytest.mark.long
@pytest.mark.parametrize("name", ["compare_specimens.ipynb", "identify_wear_coefficient.ipynb"])
def test_a_notebook_runs_beside_the_first_test_of_a_new_folder(tmp_path: Path, name: str) -> None:
    place = tmp_path / "notebooks"
    place.mkdir()
    record(tmp_path / "test.h5", 1.1, IdentificationTarget(planned=400.0), 10)
    run(place, cells(name))


@pytest.mark.long
def test_the_examples_of_the_guide_run(folder: Path) -> None:
    guide = (EXAMPLES.parent / "docs/analysis.md").read_text("utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", guide, re.MULTILINE | re.DOTALL)
    assert len(blocks) == 5
    run(folder, blocks)


def run(folder: Path, blocks: list[str]) -> str:
    """Run code in a process of its own, warnings as errors; return what it prints."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", "\n\n".join(blocks)],
        cwd=folder,
        env={**os.environ, "MPLBACKEND": "agg"},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
