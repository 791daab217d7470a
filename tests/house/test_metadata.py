"""What the package says of itself is complete, and the same in every place."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[2]
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def test_the_citation_is_that_of_the_package() -> None:
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    assert {"cff-version", "message", "title", "authors"} <= set(cited), "what the format requires"
    assert cited["version"] == PROJECT["version"]
    assert cited["license"] == PROJECT["license"]
    assert [one["name"] for one in cited["authors"]] == [one["name"] for one in PROJECT["authors"]]


def test_each_supported_python_is_a_classifier() -> None:
    low, high = (int(part.rpartition(".")[2]) for part in PROJECT["requires-python"].split(","))
    named = {one for one in PROJECT["classifiers"] if "Python :: 3." in one}
    assert named == {f"Programming Language :: Python :: 3.{minor}" for minor in range(low, high)}
    assert len(PROJECT["classifiers"]) == len(set(PROJECT["classifiers"]))


def test_an_installation_has_every_example_and_guide() -> None:
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    shipped = {
        path
        for patterns in settings["tool"]["setuptools"]["data-files"].values()
        for pattern in patterns
        for path in ROOT.glob(pattern)
    }
    examples = {
        path
        for path in (ROOT / "examples").rglob("*")
        if path.is_file() and path.suffix not in (".pyc", ".h5") and ".egg-info" not in str(path)
    }
    assert len(examples) > 30
    assert examples - shipped == set()
    assert set((ROOT / "docs").glob("*.md")) <= shipped
