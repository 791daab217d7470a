"""Unusable input, as an error of one sentence."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

from rigapp.texts import Sentence, SentenceError, joined, say


class UnusableInput(SentenceError):
    """The sentence says which file and key cannot be used, and what to do; exit status 2."""


_WORDS = {
    "float": say("a number"),
    "int": say("an integer"),
    "str": say("text"),
    "bool": say("true or false"),
    "null": say("nothing"),
    "object": say("a table"),
    "array": say("a list"),
}


def in_words(error: Exception) -> tuple[str, str]:
    """Return where a record does not match its type, as a dotted path, and what is wrong there.

    error: a ``msgspec.ValidationError``; its own names of types become plain words.
    """
    message, _, where = str(error).partition(" - at `$")
    where = where.rstrip("`").lstrip(".")
    missing = re.fullmatch(r"Object missing required field `(.+)`", message)
    if missing:
        return f"{where}.{missing[1]}" if where else missing[1], say("is missing")

    message = message[:1].lower() + message[1:]
    values = [_kind(match[1]) if match[1] else match[0] for match in _VALUES.finditer(message)]
    return where, Sentence(_VALUES.sub("{}", message), *values)


_VALUES = re.compile(r"`([a-z| ]+)`|'[^']*'|(?<= )-?[\d.]+(?:e[-+]?\d+)?\b")
"""The variable parts of a message of msgspec: kinds of values, and values."""


def _kind(names: str) -> str:
    known = names.removesuffix(" | null").split(" | ")
    return joined(say(" or "), (_WORDS.get(name, f"`{name}`") for name in known))


Extra = Literal["analysis", "page", "publish", "studies"]


@contextmanager
def from_extra(extra: Extra, what: str) -> Iterator[None]:
    """Import the packages of an extra inside it; raise UnusableInput with the way to install it.

    what: needs it; the beginning of the sentence.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        raise UnusableInput(
            "{} needs packages that are missing ‹{}›; install them: pip install 'rigapp[{}]'.",
            what,
            error,
            extra,
        ) from error
