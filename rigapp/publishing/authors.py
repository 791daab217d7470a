"""Who is named as the author of published data."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rigapp.config.errors import UnusableInput


@dataclass(frozen=True, slots=True)
class Author:
    """A person by family name and given name, or whoever has one name alone: a laboratory."""

    family: str
    given: str = ""

    @property
    def name(self) -> str:
        """Return the name as one says it."""
        return f"{self.given} {self.family}".strip()

    @property
    def spellings(self) -> frozenset[str]:
        """Return how the author may stand in a file, in small letters."""
        both = (self.name, f"{self.family}, {self.given}")
        return frozenset(one.casefold() for one in both)


def authors_of(given: Sequence[str], operators: Iterable[str]) -> tuple[Author, ...]:
    """Return the authors that were named, else the operators of the tests; raise UnusableInput."""
    for text in given:
        if not text.strip(" ,"):
            raise UnusableInput(f"--author {text!r}: names nobody; write it as 'Family, Given'.")
    names = [*given] or [one for one in operators if one.strip()]
    if not names:
        raise UnusableInput(
            "No author is known, as the tests name no operator; give --author 'Family, Given'."
        )
    return tuple(dict.fromkeys(_author(one) for one in names))


def _author(text: str) -> Author:
    family, _, given = (part.strip() for part in text.partition(","))
    return Author(family, given) if family else Author(given)
