"""The texts of a test in pieces that somebody can find again: a line, a key, an event."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from rigapp.publishing.packaged import PackagedTest

RIG, TEST = "/entry/configuration/rig", "/entry/configuration/test"
SETTINGS = {RIG: "rig file", TEST: "test file"}
"""TOML texts of a test file, and what people call them."""

_TABLE = re.compile(r"\s*\[{1,2}\s*([A-Za-z_][\w.\" -]*?)\s*\]{1,2}\s*(?:#.*)?")
_KEY = re.compile(r"\s*([A-Za-z_\"][\w.\" -]*?)\s*=")


@dataclass(frozen=True, slots=True)
class Passage:
    """A piece of text. place: where it stands, for people; path, key: for programs."""

    place: str
    path: str
    key: str
    text: str


def passages(test: PackagedTest) -> Iterator[Passage]:
    """Yield everything that a test file says, its name included."""
    yield Passage("its name", "", "", test.path.name)
    for path, text in test.texts:
        yield from _pieces(path, text)
    for number, event in enumerate(test.events, 1):
        for text in (event.source, event.text, event.before, event.after, *_leaves(event.data)):
            if text:
                yield Passage(f"event {number}", "/entry/events", event.kind, text)


def _pieces(path: str, text: str) -> Iterator[Passage]:
    if path in SETTINGS:
        yield from _lines(path, text)
        return
    tree = _tree(text)
    if tree is None:
        yield Passage(path, path, path.rpartition("/")[2], text)
        return
    for key, leaf in _branches(tree):
        yield Passage(f"{path} ({key})", path, key, leaf)


def _lines(path: str, text: str) -> Iterator[Passage]:
    """Yield the lines of a TOML text, each with the table and key to which it belongs."""
    table = key = ""
    for number, line in enumerate(text.splitlines(), 1):
        if head := _TABLE.fullmatch(line):
            table, key = f"{head[1]}.", ""
        elif found := _KEY.match(line):
            key = found[1].strip('"')
        where = f" ({table}{key})" if key else ""
        yield Passage(f"{SETTINGS[path]} line {number}{where}", path, f"{table}{key}", line)


def _tree(text: str) -> Any:
    """Return the value of a text that is a JSON object or list, else None."""
    if text[:1] not in ("{", "["):
        return None
    try:
        return json.loads(text)
    except ValueError:
        return None


def _branches(tree: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """Yield the texts of nested values with their keys, the keys themselves left out."""
    if isinstance(tree, str):
        yield key, tree
    elif isinstance(tree, dict | list):
        pairs = tree.items() if isinstance(tree, dict) else enumerate(tree, 1)
        for name, value in pairs:
            yield from _branches(value, f"{key}.{name}" if key else str(name))


def _leaves(tree: Any) -> list[str]:
    return [text for _, text in _branches(tree)]
