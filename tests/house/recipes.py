"""Follow the recipes of CONTRIBUTING.md to the letter, in a copy of the source."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from patience import PATIENCE_S

TOP = Path(__file__).parents[2]
SOURCES = ("drivers", "model", "calibration")
"""Folders of the top that are no package themselves: each holds one."""

STEP = re.compile(
    r"^(?:New file `(?P<made>[^`]+)`|At the end of `(?P<end>[^`]+)`"
    r"|(?:In `(?P<file>[^`]+)`,|and) after `(?P<after>[^\n]+)`)"
    r":\n\n```\w*\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True, slots=True)
class Step:
    """One step of a recipe: a new file or the end of one, or lines behind one that is there."""

    file: str
    after: str
    text: str
    is_addition: bool


def recipe(title: str) -> list[Step]:
    """Return the steps below a heading."""
    text = (TOP / "CONTRIBUTING.md").read_text("utf-8")
    section = text.split(f"\n### {title}\n", 1)[1]
    section = re.split(r"^##+ ", section, maxsplit=1, flags=re.MULTILINE)[0]
    steps: list[Step] = []
    for found in STEP.finditer(section):
        file = found["made"] or found["end"] or found["file"] or steps[-1].file
        steps.append(Step(file, found["after"] or "", found["text"], bool(found["end"])))
    assert len(steps) == section.count("```") // 2, f"a step of {title!r} is not understood"
    return steps


def files(title: str) -> set[str]:
    """Return the files that a recipe touches."""
    return {step.file for step in recipe(title)}


def follow(title: str, folder: Path) -> None:
    """Do what a recipe says, in a folder."""
    for step in recipe(title):
        path = folder / step.file
        if not step.after:
            assert path.exists() == step.is_addition, path
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("a", encoding="utf-8") as file:
                file.write(step.text)
            continue
        lines = path.read_text("utf-8").splitlines(keepends=True)
        (place,) = [n for n, line in enumerate(lines, 1) if line.strip() == step.after]
        margin = lines[place][: len(lines[place]) - len(lines[place].lstrip(" "))]
        new = [margin + line if line.strip() else line for line in step.text.splitlines(True)]
        path.write_text("".join([*lines[:place], *new, *lines[place:]]), "utf-8")


def copy_of_the_source(folder: Path) -> Path:
    """Return a copy of all packages, compiled kernels with them."""
    for name in ("rigapp", *SOURCES):
        shutil.copytree(TOP / name, folder / name)
    return folder


def inside(folder: Path, *command: str | Path) -> subprocess.CompletedProcess[str]:
    """Run Python in a folder, with the packages that lie there."""
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(folder), *(str(folder / name) for name in SOURCES)]),
        "RIGAPP_RUNTIME_DIR": str(folder / "run"),
        "QT_QPA_PLATFORM": "offscreen",
    }
    return subprocess.run(
        [sys.executable, *map(str, command)],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )


def headings() -> Iterator[str]:
    """Yield the titles of all recipes."""
    text = (TOP / "CONTRIBUTING.md").read_text("utf-8")
    yield from re.findall(r"^### (.+)$", text, re.MULTILINE)
