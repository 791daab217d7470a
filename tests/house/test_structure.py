"""The house as a whole: rooms of a size to know, one name for one idea, words explained."""

from __future__ import annotations

import ast
import re
import tomllib
from collections import Counter, defaultdict
from functools import cache
from pathlib import Path

from house.imports import MODULES, ROOTS, TOP
from setuptools import find_packages

NAMES = {path: name for name, path in MODULES.items()}
PACKAGES = sorted(path.parent for path in NAMES if path.name == "__init__.py")
MOST_MODULES = 20
"""What one can keep in mind of a folder after reading its names once."""


def dotted(path: Path) -> str:
    return NAMES[path if path.suffix else path / "__init__.py"]


@cache
def classes() -> dict[str, set[str]]:
    """Return the public classes by name, with the packages in which they stand."""
    found: dict[str, set[str]] = defaultdict(set)
    for package in PACKAGES:
        for path in package.glob("*.py"):
            for node in ast.parse(path.read_text("utf-8")).body:
                if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                    found[node.name].add(dotted(package))
    return found


def test_no_package_has_more_modules_than_one_can_know() -> None:
    sizes = {dotted(one): len(list(one.glob("*.py"))) - 1 for one in PACKAGES}
    assert {name: size for name, size in sizes.items() if size > MOST_MODULES} == {}


def test_every_package_says_what_it_is_for() -> None:
    silent = [
        dotted(one)
        for one in PACKAGES
        if not ast.get_docstring(ast.parse((one / "__init__.py").read_text("utf-8")))
    ]
    assert silent == []


EACH_DEVICE_HAS_ITS_OWN = "each device has its own, and one package never meets the other"
SAME_NAME = dict.fromkeys(
    [
        "Command",
        "Decoder",
        "Entry",
        "Link",
        "Plan",
        "Readings",
        "Registers",
        "Run",
        "Setup",
        "Tally",
        "Volatile",
    ],
    EACH_DEVICE_HAS_ITS_OWN,
)
"""Class names that stand in two packages or more, each with its reason."""


def test_one_name_stands_for_one_idea() -> None:
    doubled = {name: places for name, places in classes().items() if len(places) > 1}
    assert {name: places for name, places in doubled.items() if name not in SAME_NAME} == {}
    assert SAME_NAME.keys() - doubled == set(), "take out what has its own name by now"


def test_a_name_is_a_word() -> None:
    assert [name for name in classes() if len(name) < 3] == []


def words_of_glossary() -> list[tuple[str, str]]:
    """Return the rows of the glossary: the word, and what it means."""
    text = (TOP / "docs/glossary.md").read_text("utf-8")
    rows = re.findall(r"^\| (.+?) \| (.+) \|$", text, re.MULTILINE)
    return [row for row in rows if row[0] not in ("word", "---")]


def test_each_word_is_explained_once() -> None:
    words = Counter(part for word, _ in words_of_glossary() for part in word.split(", "))
    assert len(words) > 50
    assert [word for word, times in words.items() if times > 1] == []


def test_what_the_glossary_names_is_there() -> None:
    named = [name for _, text in words_of_glossary() for name in re.findall(r"→ `(.+?)`", text)]
    assert len(named) > 20
    known = classes().keys() | {dotted(path) for root in PACKAGES for path in root.glob("*.py")}
    assert [name for name in named if name not in known] == []


def test_what_is_installed_has_one_unique_name() -> None:
    """A user's ``model.py`` must not hide ours, nor ours a package of somebody else."""
    settings = tomllib.loads((TOP / "pyproject.toml").read_text("utf-8"))
    found = settings["tool"]["setuptools"]["packages"]["find"]
    packages = [
        one
        for place in found["where"]
        for one in find_packages(TOP / place, include=found["include"])
    ]
    assert {name.partition(".")[0] for name in packages} == set(ROOTS)
    assert len(packages) == len(PACKAGES)


SHOWN_IN_A_LANGUAGE = ("engine", "service", "checks", "queue", "config", "twin")


def puts_sentence_into_text(node: ast.AST) -> bool:
    """Tell whether an f-string swallows a sentence, whose parts nobody can translate after that."""
    return isinstance(node, ast.JoinedStr) and any(
        isinstance(one, ast.FormattedValue)
        and (
            (isinstance(one.value, ast.Attribute) and one.value.attr == "sentence")
            or (isinstance(one.value, ast.Name) and one.value.id == "sentence")
        )
        for one in node.values
    )


def test_no_sentence_loses_its_parts_on_its_way_to_the_window() -> None:
    # Descriptions of keys are made before any language is set.
    allowed = {"rigapp.config.parameters", "rigapp.config.recipe"}
    found = [
        f"{name}:{node.lineno}"
        for path, name in NAMES.items()
        if name.partition(".")[2].partition(".")[0] in SHOWN_IN_A_LANGUAGE and name not in allowed
        if re.search(r"sentence\s*[!:}]", text := path.read_text("utf-8"))
        for node in ast.walk(ast.parse(text))
        if puts_sentence_into_text(node)
    ]
    assert found == []
