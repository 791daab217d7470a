"""What the command line tells of itself: whole sentences at 80 columns, and completion."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import typer
from patience import PATIENCE_S
from typer.testing import CliRunner

from rigapp.cli.program import app, main

NARROW = {"COLUMNS": "80", "TERMINAL_WIDTH": "80"}


def groups() -> Iterator[tuple[str, ...]]:
    yield ()
    commands = typer.main.get_command(app).commands
    yield from ((name,) for name, command in commands.items() if hasattr(command, "commands"))


def sentences(words: str) -> str:
    return " ".join(words.split())


@pytest.mark.parametrize("path", list(groups()), ids=lambda path: " ".join(path) or "rigapp")
def test_the_list_of_verbs_is_not_cut(path: tuple[str, ...]) -> None:
    group = typer.main.get_command(app)
    for name in path:
        group = group.commands[name]
    shown = sentences(CliRunner().invoke(app, [*path, "--help"], env=NARROW).stdout)
    for name, verb in group.commands.items():
        first = sentences((verb.help or "").split("\n\n")[0])
        assert first
        assert (f"{name} {first}" in shown) is not verb.hidden


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("rigapp calib", "calibrate"),
        ("rigapp calibrate run", "run-out\nrunning-check"),
        ("rigapp export --cy", "--cycles"),
    ],
)
def test_bash_completes_verbs_and_options(typed: str, offered: str) -> None:
    asked = {
        "_RIGAPP_COMPLETE": "complete_bash",
        "COMP_WORDS": typed,
        "COMP_CWORD": str(len(typed.split()) - 1),
    }
    done = subprocess.run(
        [sys.executable, "-m", "rigapp"],
        env={**os.environ, **asked},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert (done.returncode, done.stdout.strip(), done.stderr) == (0, offered, "")


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_the_script_for_bash_completes_in_bash() -> None:
    script = """
        eval "$(_RIGAPP_COMPLETE=source_bash rigapp)"
        COMP_WORDS=(rigapp calib) COMP_CWORD=1
        _rigapp_completion rigapp
        echo "${COMPREPLY[@]}"
    """
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", script],
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert (done.stdout.strip(), done.stderr) == ("calibrate", "")


@pytest.mark.parametrize(
    ("typed", "verb"),
    [
        ("calibrate load-cell readings.csv", "rigapp calibrate load-cell"),
        ("run --foo", "rigapp run"),
        ("runn", "rigapp"),
    ],
)
def test_a_wrong_call_is_a_sentence_and_names_the_help_of_its_verb(
    typed: str, verb: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["rigapp", *typed.split()])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    first, _, rest = capsys.readouterr().err.partition(" See ")
    assert first.startswith("rigapp: ")
    assert first[-1] in ".?"
    assert rest == f"'{verb} --help'.\n"
