"""The page of all commands has every verb and option, and its tables are tables."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer

from rigapp.cli.program import app

SOURCE = Path(__file__).parents[2] / "docs" / "reference.py"


def leaves(group: Any, path: str = "rigapp") -> Iterator[tuple[str, Any]]:
    for name, verb in group.commands.items():
        if hasattr(verb, "commands"):
            yield from leaves(verb, f"{path} {name}")
        elif not verb.hidden:
            yield f"{path} {name}", verb


def test_every_verb_and_option_is_on_the_page() -> None:
    spec = importlib.util.spec_from_file_location("reference", SOURCE)
    assert spec is not None
    assert spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    page = made.command_reference()
    verbs = dict(leaves(typer.main.get_command(app)))
    assert len(verbs) > 30
    for name, verb in verbs.items():
        start = page.index(f"# {name}\n\n{verb.help}\n")
        part = page[start:].split("\n#", 1)[0]
        for option in verb.params:
            assert option.opts[0] in part or option.metavar in part, (name, option.opts)
    rows = [line for line in page.splitlines() if line.startswith("|")]
    assert {line.replace("\\|", "").count("|") for line in rows} == {3}
