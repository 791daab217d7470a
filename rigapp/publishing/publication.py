"""A publication: tests, authors and licence."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rigapp.config.errors import UnusableInput
from rigapp.publishing.packaged import PackagedTest


@dataclass(frozen=True, slots=True)
class Author:
    """A person by family name and given name, or an author with one name: a laboratory."""

    family: str
    given: str = ""

    @property
    def name(self) -> str:
        """Return the name in the spoken order."""
        return f"{self.given} {self.family}".strip()

    @property
    def spellings(self) -> frozenset[str]:
        """Return the spellings of the author in a file, in small letters."""
        both = (self.name, f"{self.family}, {self.given}")
        return frozenset(spelling.casefold() for spelling in both)


def authors_of(texts: Sequence[str], operators: Iterable[str]) -> tuple[Author, ...]:
    """Return the authors that were named, else the operators of the tests; raise UnusableInput."""
    for text in texts:
        if not text.strip(" ,"):
            raise UnusableInput(f"--author {text!r}: names nobody; write it as 'Family, Given'.")
    names = [*texts] or [operator for operator in operators if operator.strip()]
    if not names:
        raise UnusableInput(
            "No author is known, as the tests name no operator; give --author 'Family, Given'."
        )
    return tuple(dict.fromkeys(_author(name) for name in names))


def _author(text: str) -> Author:
    family, _, given = (part.strip() for part in text.partition(","))
    return Author(family, given) if family else Author(given)


@dataclass(frozen=True, slots=True)
class Licence:
    """One licence: its SPDX identifier, its name, the URL of its text."""

    identifier: str
    name: str
    url: str

    @property
    def text(self) -> str:
        """Return the content of the file LICENSE."""
        return (
            f"These data are published under the {self.name}.\n\n"
            f"SPDX-License-Identifier: {self.identifier}\n"
            f"The text of the licence: {self.url}\n"
        )


CREATIVE_COMMONS = "https://creativecommons.org"
DATA_COMMONS = "https://opendatacommons.org/licenses"
LICENCES = {
    licence.identifier: licence
    for licence in (
        Licence(
            "CC-BY-4.0",
            "Creative Commons Attribution 4.0 International licence",
            f"{CREATIVE_COMMONS}/licenses/by/4.0/",
        ),
        Licence(
            "CC-BY-SA-4.0",
            "Creative Commons Attribution-ShareAlike 4.0 International licence",
            f"{CREATIVE_COMMONS}/licenses/by-sa/4.0/",
        ),
        Licence(
            "CC-BY-NC-4.0",
            "Creative Commons Attribution-NonCommercial 4.0 International licence",
            f"{CREATIVE_COMMONS}/licenses/by-nc/4.0/",
        ),
        Licence(
            "CC0-1.0",
            "Creative Commons Zero 1.0 Universal dedication to the public domain",
            f"{CREATIVE_COMMONS}/publicdomain/zero/1.0/",
        ),
        Licence(
            "ODC-By-1.0",
            "Open Data Commons Attribution License 1.0",
            f"{DATA_COMMONS}/by/1-0/",
        ),
        Licence("ODbL-1.0", "Open Database License 1.0", f"{DATA_COMMONS}/odbl/1-0/"),
        Licence(
            "PDDL-1.0",
            "Open Data Commons Public Domain Dedication and License 1.0",
            f"{DATA_COMMONS}/pddl/1-0/",
        ),
    )
}
"""Licences that data repositories offer; those of programs do not cover data."""


def licence_of(identifier: str) -> Licence:
    """Return the licence of an identifier, in any case; raise UnusableInput."""
    for licence in LICENCES.values():
        if licence.identifier.casefold() == identifier.strip().casefold():
            return licence
    raise UnusableInput(
        f"--licence {identifier}: is none of the licences for data that are known here; give one"
        f" of {', '.join(LICENCES)}."
    )


VERSION = "1.0"
"""Version of the data: a package is published once, a corrected one is another publication."""
KEYWORDS = ("wear test", "slider-crank", "joint clearance", "bushing")


@dataclass(frozen=True, slots=True)
class Publication:
    """The tests of a package, their authors, and the licence."""

    tests: tuple[PackagedTest, ...]
    authors: tuple[Author, ...]
    licence: Licence

    @property
    def title(self) -> str:
        """Return the title: that of the test, or those of all."""
        titles = dict.fromkeys(test.title for test in self.tests)
        kind = "Wear test" if len(self.tests) == 1 else f"{len(self.tests)} wear tests"
        return f"{kind}: {'; '.join(titles)}"

    @property
    def day(self) -> str:
        """Return the day on which the last of the tests ended."""
        return max(test.day for test in self.tests)

    @property
    def summary(self) -> str:
        """Return a summary in one or two sentences."""
        total = sum(int(test.summary["revolutions"]) for test in self.tests)
        simulated = sum(bool(test.about["simulated"]) for test in self.tests)
        words = (
            "A hard pin turns in a soft bushing of a slider-crank mechanism; forces and the pin's"
            f" position are recorded for each of {total} revolutions"
        )
        if simulated == len(self.tests):
            return f"{words}. The rig was simulated: these are not measurements."
        if simulated:
            return f"{words}. The rig of {simulated} of the tests was simulated."
        return f"{words}."
