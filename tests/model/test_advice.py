"""What the model's sentences advise exists: options of the verb, or keys of the parameter file."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
import typer

from rigapp.cli.files import model_verbs
from rigapp.config.parameters import ParameterFile

ROOT = Path(__file__).parents[2]
OPTION = re.compile(r"(?<![\w-])--[A-Za-z][\w-]*")
ADVICE = re.compile(
    r"\b(?:raise|lower|reduce|increase|(?:give|use) (?:a )?(?:larger|smaller|fewer|more|longer))"
    r" (?:the )?([a-z]+)(?: or the (\w+))?"
)


def verbs() -> dict[str, set[str]]:
    """Return the options of each verb of `rigapp model`."""
    group = typer.main.get_command(model_verbs)
    return {
        name: {option for p in command.params for option in p.opts if option.startswith("--")}
        for name, command in group.commands.items()
    }


def keys(kind: type) -> Iterator[str]:
    """Yield the keys of a parameter file's record and of those inside it."""
    for field in msgspec.structs.fields(kind):
        yield field.name
        for inner in (field.type, *getattr(field.type, "__args__", ())):
            if isinstance(inner, type) and issubclass(inner, msgspec.Struct):
                yield from keys(inner)


def sentences(path: Path) -> Iterator[str]:
    """Yield every text in a module that is no docstring; blanks stand for numbers."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    skipped = {
        id(node.value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    }
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and id(node) not in skipped
        ):
            yield node.value


@pytest.mark.parametrize(
    ("module", "names"),
    [
        ("rigapp/commands/model/forces.py", ("forces",)),
        ("rigapp/commands/model/wear.py", ("wear", "pressure", "paper")),
        ("rigapp/commands/progress.py", ("forces", "wear", "paper")),
        ("rigapp/report/paper/__init__.py", ("paper",)),
        ("rigapp/report/paper/pages.py", ("paper",)),
        ("rigapp/report/paper/table2.py", ("paper",)),
    ],
)
def test_options_named_exist(module: str, names: tuple[str, ...]) -> None:
    options = verbs()
    named = {found for text in sentences(ROOT / module) for found in OPTION.findall(text)}
    assert named
    for name in named:
        # A module that serves several verbs may name what only one of them has.
        having = [verb for verb in names if name in options[verb]]
        assert having, f"{module} advises {name}, which none of {names} has"
        if module.endswith("progress.py"):
            assert len(having) == len(names)


def test_what_the_model_advises_can_be_given() -> None:
    words = {word for found in verbs().values() for name in found for word in name[2:].split("-")}
    words |= {word for key in keys(ParameterFile) for word in key.split("_")}
    assert {"tolerance", "cycles", "modulus", "mass"} <= words
    advised = {
        (path.name, noun)
        for path in sorted((ROOT / "model/rigapp_model").rglob("*.py"))
        for text in sentences(path)
        for found in ADVICE.findall(text)
        for noun in found
        if noun
    }
    assert ("impact.py", "tolerance") in advised
    assert not {(name, noun) for name, noun in advised if noun not in words}
