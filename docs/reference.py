"""The page of all commands, made from the command line itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import typer

from rigapp.cli.program import app

OPENING = """# Commands

`rigapp VERB --help` says the same on a terminal. `rigapp --install-completion` lets the shell
complete verbs and options.

Exit status: 0 done, 1 the test or check failed or was stopped by a limit, 2 unusable input, 3 a
device failed. What went wrong is one sentence on standard error; `rigapp --debug VERB ...` shows
where.
"""


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
    records = [found for one in verb.params if (found := one.get_help_record(context))]
    lines = [f"| `{_cell(flag)}` | {_cell(words)} |" for flag, words in records]
    return "\n".join(["| option | |", "| --- | --- |", *lines, ""]) if lines else ""


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
