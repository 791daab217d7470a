"""The pages of commands and keys have all there are, their tables are tables, pictures are new."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer

from rigapp.calibrating.subjects import SUBJECTS
from rigapp.cli.program import app
from rigapp.config.meanings import key_table
from rigapp.config.notify import NotifyFile
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import keys_of
from rigapp.config.recipe import TestFile
from rigapp.config.report import ReportFile
from rigapp.config.rig import RigFile
from rigapp.study.design import StudyFile
from rigapp.study.kinds import KINDS
from rigapp_drivers.registry import available_drivers, load_driver

DOCS = Path(__file__).parents[2] / "docs"


def leaves(group: Any, path: str = "rigapp") -> Iterator[tuple[str, Any]]:
    for name, verb in group.commands.items():
        if hasattr(verb, "commands"):
            yield from leaves(verb, f"{path} {name}")
        elif not verb.hidden:
            yield f"{path} {name}", verb


def loaded(name: str) -> Any:
    """Return a module of the folder of the guides."""
    spec = importlib.util.spec_from_file_location(name, DOCS / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    made = sys.modules[name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


def test_every_key_of_every_file_is_on_the_page() -> None:
    page = loaded("reference").key_reference()
    files = [RigFile, TestFile, ParameterFile, NotifyFile, ReportFile, StudyFile]
    files += [one.settings for one in SUBJECTS.values() if one.settings is not None]
    files += [one.settings for one in KINDS.values()]
    keys = {key.path for file in files for key in keys_of(file)}
    assert len(keys) > 300
    for key in keys:
        assert f"| `{key.replace('*', 'NAME')}` |" in page, key
    for name in available_drivers():
        part = page.split(f"## Rig file: settings of the driver {name}\n")[1].split("\n## ")[0]
        assert all(f"| `{key}` |" in part for key in load_driver(name).settings)
    table = key_table()
    for kind in ("calibration", "notify", "report", "study", "study_run"):
        assert set(table[kind]) <= keys, kind
        assert all(words.endswith(".") for words in table[kind].values())
    rows = [line for line in page.splitlines() if line.startswith("|")]
    assert {line.replace("\\|", "").count("|") for line in rows} == {5}


def test_the_pictures_of_the_wiring_are_those_of_their_script() -> None:
    made = loaded("wiring_pictures").pictures()
    assert len(made) == 2
    for name, text in made.items():
        assert (DOCS / "images" / name).read_text("utf-8") == text, "run docs/wiring_pictures.py"


def test_every_verb_and_option_is_on_the_page() -> None:
    page = loaded("reference").command_reference()
    verbs = dict(leaves(typer.main.get_command(app)))
    assert len(verbs) > 30
    for name, verb in verbs.items():
        start = page.index(f"# {name}\n\n{verb.help}\n")
        part = page[start:].split("\n#", 1)[0]
        for option in verb.params:
            assert option.opts[0] in part or option.metavar in part, (name, option.opts)
    rows = [line for line in page.splitlines() if line.startswith("|")]
    assert {line.replace("\\|", "").count("|") for line in rows} == {3}
