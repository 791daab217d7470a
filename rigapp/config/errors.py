"""Unusable input, said in one sentence."""

from __future__ import annotations

import re


class UnusableInput(Exception):
    """Say which file and key cannot be used, and what to do; exit status 2."""


_WORDS = {
    "float": "a number",
    "int": "a whole number",
    "str": "text",
    "bool": "true or false",
    "null": "nothing",
    "object": "a table",
    "array": "a list",
}


def in_words(error: Exception) -> tuple[str, str]:
    """Return where a record is not as its type says, as a dotted path, and what is wrong there.

    error: a ``msgspec.ValidationError``; its own names of types become plain words.
    """
    message, _, where = str(error).partition(" - at `$")
    where = where.rstrip("`").lstrip(".")
    missing = re.fullmatch(r"Object missing required field `(.+)`", message)
    if missing:
        return f"{where}.{missing[1]}" if where else missing[1], "is missing"

    def plain(kinds: re.Match[str]) -> str:
        names = kinds[1].removesuffix(" | null").split(" | ")
        return " or ".join(_WORDS.get(name, f"`{name}`") for name in names)

    message = re.sub(r"`([a-z| ]+)`", plain, message)
    return where, message[:1].lower() + message[1:]
