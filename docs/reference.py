"""Generate the pages of all commands and all keys from the command line and the schema."""

from __future__ import annotations

import datetime
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec
import typer

from rigapp.calibrating.subjects import SUBJECTS
from rigapp.cli.program import app
from rigapp.config.commented import toml_value
from rigapp.config.meanings import described, key_table, meanings
from rigapp.config.notify import NotifyFile
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import Key, keys_of
from rigapp.config.recipe import TestFile
from rigapp.config.report import ReportFile
from rigapp.config.rig import RigFile
from rigapp.study.design import StudyFile
from rigapp.study.kinds import KINDS
from rigapp_drivers.registry import available_drivers, load_driver

OPENING = """# Commands

`rigapp VERB --help` says the same on a terminal. `rigapp --install-completion` lets the shell
complete verbs and options.

Exit status: 0 done, 1 the test or check failed or was stopped by a limit, 2 unusable input, 3 a
device failed. What went wrong is one sentence on standard error; `rigapp --debug VERB ...` shows
where.
"""


KEYS_OPENING = """# Keys of all files

Every key of every file, from the same tables by which the program reads them. `NAME` stands for a
name of your own. `rigapp init --real` writes rig and test file with all of this as comments.
"""
WORDS_OF_TYPES = {
    bool: "true or false", int: "whole number", float: "number", str: "text",
    datetime.date: "date",
}  # fmt: skip


OTHER_TYPE = "list or table"


def key_reference() -> str:
    """Return every key of every file as Markdown: type, default, meaning."""
    known, table = meanings(), key_table()
    parts = [
        KEYS_OPENING,
        _keys("Rig file", RigFile, known[RigFile]),
        *_settings(),
        _keys("Test file", TestFile, known[TestFile]),
        _keys("Parameter file", ParameterFile, known[ParameterFile]),
    ]
    files = dict.fromkeys(subject.settings for subject in SUBJECTS.values())
    for kind in filter(None, files):
        verbs = [name for name, subject in SUBJECTS.items() if subject.settings is kind]
        title = f"Settings of a calibration: {', '.join(verbs)}"
        parts.append(_keys(title, kind, table["calibration"]))
    messages = "Messages: notify.toml, and these tables of a rig file"
    parts.append(_keys(messages, NotifyFile, table["notify"]))
    parts.append(_keys("Reports: report.toml", ReportFile, table["report"]))
    parts.append(_keys("Study file", StudyFile, table["study"]))
    for name, study in KINDS.items():
        parts.append(_keys(f"Study file: [run] of kind {name}", study.settings, table["study_run"]))
    return "\n".join(parts)


def _keys(title: str, kind: type[msgspec.Struct], words: Mapping[str, str]) -> str:
    rows = [
        f"| `{key.path.replace('*', 'NAME')}` | {_type(key)} | {_default(key)} |"
        f" {_cell(described(words[key.path], key))} |"
        for key in keys_of(kind)
    ]
    return "\n".join([f"## {title}\n", *KEY_HEAD, *rows, ""])


KEY_HEAD = ("| key | type | default | meaning |", "| --- | --- | --- | --- |")


def _settings() -> Iterator[str]:
    """Yield the settings of each driver for [devices.NAME.settings] of a rig file."""
    for name in available_drivers():
        info = load_driver(name)
        rows = [
            f"| `{key}` | {WORDS_OF_TYPES.get(spec.kind, 'value')} | `{toml_value(spec.default)}` |"
            f" {_cell(spec.sentence)} |"
            for key, spec in info.settings.items()
        ]
        title = f"## Rig file: settings of the driver {name}\n"
        yield "\n".join([title, *KEY_HEAD, *rows, ""])


def _type(key: Key) -> str:
    if key.choices:
        return "one of its words"
    return WORDS_OF_TYPES.get(key.value_type, OTHER_TYPE)


def _default(key: Key) -> str:
    if key.default is msgspec.NODEFAULT:
        return "" if _type(key) == OTHER_TYPE else "must be there"
    plain = isinstance(key.default, bool | int | float | str)
    return f"`{toml_value(key.default)}`" if plain and key.default != "" else ""


def command_reference() -> str:
    """Return every verb with its arguments and options as Markdown."""
    program = typer.main.get_command(app)
    return "\n".join([OPENING, _options(program), *_verbs(program, "rigapp")])


def _verbs(group: Any, path: str) -> Iterator[str]:
    for name, verb in group.commands.items():
        if verb.hidden:
            continue
        whole = f"{path} {name}"
        yield f"{'#' * len(whole.split())} {whole}\n\n{verb.help}\n"
        if hasattr(verb, "commands"):
            yield from _verbs(verb, whole)
        else:
            context = verb.make_context(name, [], resilient_parsing=True)
            usage = " ".join(verb.collect_usage_pieces(context))
            yield f"    {whole} {usage}\n"
            yield _options(verb)


def _options(verb: Any) -> str:
    context = verb.make_context(verb.name, [], resilient_parsing=True)
    records = [
        record for parameter in verb.params if (record := parameter.get_help_record(context))
    ]
    lines = [f"| `{_cell(flag)}` | {_cell(words)} |" for flag, words in records]
    return "\n".join(["| option | |", "| --- | --- |", *lines, ""]) if lines else ""


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
