"""Parse TOML from users; deep nesting is refused, since it could exhaust stack or memory."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Final

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.schema.wire import tree_of
from rigapp.texts import Sentence, say

MAX_DEPTH: Final = 32
"""Maximum depth of nested tables and key parts; no file of this program has more than five."""

_TEXTS: Final = re.compile(
    r"""\"{3}[\s\S]*?\"{3}|'{3}[\s\S]*?'{3}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|\#[^\n]*"""
)


def toml_tree(text: str, where: str | Path) -> dict[str, Any]:
    """Return TOML as nested tables; raises UnusableInput naming the source ``where``."""
    depth = _depth(text)
    if depth > MAX_DEPTH:
        raise UnusableInput(
            "{}: nesting is {} levels deep; the maximum is {}. Check the brackets and the dots.",
            where,
            depth,
            MAX_DEPTH,
        )
    try:
        tree: dict[str, Any] = msgspec.toml.decode(text)
    except (msgspec.DecodeError, ValueError) as error:
        raise UnusableInput(
            "{}: not valid TOML: {}.{}", where, _in_words(error), _likely_cause(text)
        ) from error
    return tree


_DECIMAL_COMMA: Final = re.compile(r"^[^#=]*=\s*[+-]?\d+,\d+\s*(#.*)?$")
_TYPOGRAPHIC: Final = re.compile("[\u201c\u201d\u201e\u2018\u2019\u201a\u00ab\u00bb]")


def _likely_cause(text: str) -> Sentence | str:
    """Return the likely cause of an unreadable text, such as quotes of a word processor."""
    for number, line in enumerate(text.splitlines(), 1):
        if _DECIMAL_COMMA.match(line):
            return say(" Line {} has a decimal comma; write a point.", number)
        bare = _TEXTS.sub("", line)
        if _TYPOGRAPHIC.search(bare):
            return say(' Line {} has typographic quotation marks; write straight ones (").', number)
    return ""


def _in_words(error: Exception) -> Sentence:
    """Return the error of the TOML parser, with line and column as values."""
    at = re.fullmatch(r"(.+) \(at line (\d+), column (\d+)\)", str(error))
    if at:
        return say("{} (at line {}, column {})", Sentence(at[1]), at[2], at[3])
    words = str(error).removesuffix(" (at end of document)")
    return (
        say("{} (at end of document)", Sentence(words)) if words != str(error) else Sentence(words)
    )


def toml_text(record: Any) -> str:
    """Return a record or nested tables as TOML; None values are omitted."""
    import tomlkit

    return tomlkit.dumps(_stated(tree_of(record)))


def _stated(tree: Any) -> Any:
    if isinstance(tree, dict):
        return {key: _stated(value) for key, value in tree.items() if value is not None}
    if isinstance(tree, list | tuple):
        return [_stated(value) for value in tree]
    return tree


def _depth(text: str) -> int:
    """Return the largest depth of brackets or dotted keys; quoted text does not count."""
    depth = deepest = 0
    for line in _TEXTS.sub("_", text).splitlines():
        for mark in re.findall(r"[][{}]", line):
            depth = depth + 1 if mark in "[{" else max(0, depth - 1)
            deepest = max(deepest, depth)
        words = re.findall(r"[\w.-]+", re.sub(r"[ \t]*\.[ \t]*", ".", line))
        deepest = max([deepest, *(word.count(".") + 1 for word in words)])
    return deepest
