"""What is checked before a commit is what ``make lint`` checks."""

from __future__ import annotations

import re
from pathlib import Path

TOP = Path(__file__).parents[2]


def words(command: str) -> tuple[str, ...]:
    """Return the tool and its verb; options and files differ."""
    first, *rest = command.split()
    return (Path(first).name, *[word for word in rest if word.isalpha()])


def test_the_hooks_check_what_lint_checks() -> None:
    lint = re.search(
        r"^lint:.*\n((?:\t.*\n)+)", (TOP / "Makefile").read_text("utf-8"), re.MULTILINE
    )
    assert lint
    hooks = re.findall(r"entry: (.*)", (TOP / ".pre-commit-config.yaml").read_text("utf-8"))
    assert [words(one) for one in hooks] == [words(one) for one in lint[1].splitlines()]


def test_no_hook_downloads_anything() -> None:
    text = (TOP / ".pre-commit-config.yaml").read_text("utf-8")
    assert re.findall(r"repo: (.*)", text) == ["local"]
    assert set(re.findall(r"language: (.*)", text)) == {"system"}
