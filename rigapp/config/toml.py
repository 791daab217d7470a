"""Parse TOML that somebody wrote: what lies too deep would use up stack or memory."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Final

import msgspec

from rigapp.config.errors import UnusableInput

DEEPEST: Final = 32
"""Tables within tables, and parts of a key; no file of this program has more than five."""

_TEXTS: Final = re.compile(
    r"""\"{3}[\s\S]*?\"{3}|'{3}[\s\S]*?'{3}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|\#[^\n]*"""
)


def toml_tree(text: str, where: str | Path) -> dict[str, Any]:
    """Return TOML as nested tables; raise UnusableInput naming ``where`` it comes from."""
    depth = _depth(text)
    if depth > DEEPEST:
        raise UnusableInput(
            f"{where}: tables, lists or keys lie {depth} deep, {DEEPEST} at most; check the"
            " brackets and the dots."
        )
    try:
        tree: dict[str, Any] = msgspec.toml.decode(text)
    except (msgspec.DecodeError, ValueError) as error:
        raise UnusableInput(f"{where}: not valid TOML: {error}.") from error
    return tree


def toml_text(record: Any) -> str:
    """Return a record, or nested tables, as TOML; what is None is left out."""
    import tomlkit

    return tomlkit.dumps(_stated(msgspec.to_builtins(record)))


def _stated(tree: Any) -> Any:
    if isinstance(tree, dict):
        return {key: _stated(value) for key, value in tree.items() if value is not None}
    if isinstance(tree, list | tuple):
        return [_stated(value) for value in tree]
    return tree


def _depth(text: str) -> int:
    """Return how deep brackets or dotted keys go at most; what stands in quotes does not count."""
    depth = deepest = 0
    for line in _TEXTS.sub("_", text).splitlines():
        for mark in re.findall(r"[][{}]", line):
            depth = depth + 1 if mark in "[{" else max(0, depth - 1)
            deepest = max(deepest, depth)
        words = re.findall(r"[\w.-]+", re.sub(r"[ \t]*\.[ \t]*", ".", line))
        deepest = max([deepest, *(word.count(".") + 1 for word in words)])
    return deepest
