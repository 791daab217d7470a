"""Every command of README and guides is one: its verb is there, and so is each of its options."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import pytest
import typer

from rigapp.cli.program import app
from rigapp.schema.messages import RunState, Status

TOP = Path(__file__).parents[2]
PAGES = [TOP / "README.md", *sorted((TOP / "docs").glob("*.md"))]
LINE = re.compile(r"^\s*(?:\$ )?(?:[A-Z_]+=\S+ )*(?:\S*/)?rigapp((?: [^\s#`]+)+)", re.MULTILINE)
INLINE = re.compile(r"`(?:\.venv/bin/)?rigapp ([^`\n]+)`")


def commands(text: str) -> list[str]:
    """Return what stands after `rigapp` in blocks of commands, and in the midst of sentences."""
    blocks = re.findall(r"^```(?:\w*)\n(.*?)^```|^((?:    .*\n)+)", text, re.MULTILINE | re.DOTALL)
    joined = "\n".join("".join(one) for one in blocks).replace("\\\n", " ")
    return [one.strip() for one in [*LINE.findall(joined), *INLINE.findall(text)]]


def refused(words: list[str]) -> str:
    """Return what is wrong with a command, nothing for a good one."""
    verb: Any = typer.main.get_command(app)
    while hasattr(verb, "commands"):
        if not words or words[0].startswith("-"):
            break
        if words[0] not in verb.commands:
            return f"no verb {words[0]}"
        verb, words = verb.commands[words[0]], words[1:]
    known = {option for one in verb.params for option in one.opts} | {"--help", "-h"}
    given = [one.split("=")[0] for one in words if one.startswith("-")]
    return ", ".join(f"no option {one}" for one in given if one not in known)


@pytest.mark.sampled
@pytest.mark.parametrize("page", PAGES, ids=lambda path: path.name)
def test_the_program_knows_what_the_page_says(page: Path) -> None:
    found = commands(page.read_text("utf-8"))
    wrong = {}
    for one in found:
        plain = one.replace("[", " ").replace("]", " ").replace("...", "").replace("|", " ")
        try:
            words = shlex.split(plain)
        except ValueError:
            continue
        if words and "VERB" not in words and (why := refused(words)):
            wrong[one] = why
    assert wrong == {}


def test_the_pages_have_commands() -> None:
    assert sum(len(commands(page.read_text("utf-8"))) for page in PAGES) > 60


def test_every_state_of_a_run_is_documented() -> None:
    page = (TOP / "docs" / "service.md").read_text("utf-8")
    table = page.partition("| state | means |")[2].partition("\n\n")[0]
    documented = re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)
    assert {one.value for one in RunState} <= set(documented)
    assert len(documented) == len(set(documented))
    named = set(re.findall(r"`(\w+_\w+|outcome|resting|coasting)`", table))
    assert named <= Status.of_flat({"state": RunState.IDLE}).flat().keys()
