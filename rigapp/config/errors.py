"""Unusable input as an error with one sentence."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

from rigapp.texts import Sentence, SentenceError, joined, say


class UnusableInput(SentenceError):
    """Raised for unusable input; the sentence names file, key and remedy. Exit status 2."""


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
    """Return the dotted path and the fault of a record that does not match its type.

    error: a ``msgspec.ValidationError``, whose type names are replaced by plain words.
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
    """Context for importing the packages of an extra; raises UnusableInput with the remedy.

    what: what needs the extra; the start of the sentence.
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
