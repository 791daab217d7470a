"""What of the tests is private, each finding as one sentence that says where it stands."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from rigapp.publishing.authors import Author
from rigapp.publishing.packaged import PackagedTest
from rigapp.publishing.places import TEST, passages
from rigapp.publishing.private import found_in
from rigapp.schema.messages import Event

PROGRAM = frozenset(
    {"", "engine", "limits", "drive", "storage", "twin", "messages", "queue", "operator"}
)
"""Who writes into a log without being a person, and a person who gave no name."""
DEVICE = "device"
"""Kind of the events whose source is a device of the rig."""
PEOPLE_OF_A_RECORD = ("operator", "reviewer")
MOST_PLACES = 6


@dataclass(frozen=True, slots=True)
class Finding:
    """Something private. what: as the object of a sentence. places: where it stands in the file."""

    file: str
    what: str
    places: tuple[str, ...]

    @property
    def sentence(self) -> str:
        """Return the finding as one sentence."""
        shown = list(self.places[:MOST_PLACES])
        if more := len(self.places) - len(shown):
            shown.append(f"{more} more")
        where = shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"
        return f"{self.file}: {where} {'holds' if len(shown) == 1 else 'hold'} {self.what}."


def findings(
    tests: Iterable[PackagedTest], authors: Iterable[Author], computers: frozenset[str]
) -> list[Finding]:
    """Return what is private in tests, in the order in which it stands there.

    computers: names of computers to look for, beside what looks like one.
    """
    named = frozenset(spelling for one in authors for spelling in one.spellings)
    found: list[Finding] = []
    for test in tests:
        people = frozenset(one for one in people_of(test) if one.casefold() not in named)
        by_what: dict[str, dict[str, None]] = {}
        for passage in passages(test):
            for what in found_in(passage, computers, people):
                by_what.setdefault(what, {})[passage.place] = None
        found += [Finding(test.path.name, what, tuple(at)) for what, at in by_what.items()]
    return found


def people_of(test: PackagedTest) -> frozenset[str]:
    """Return the names of people in a test: its operators, and those of its calibrations."""
    texts = dict(test.texts)
    names = [test.operator, *_operator_of(texts.get(TEST, ""))]
    names += [one.source for one in test.events if _is_person(one)]
    for values in test.calibration.values():
        names += _people_of_record(values)
    return frozenset(one.strip() for one in names) - PROGRAM


def _is_person(event: Event) -> bool:
    return event.source not in PROGRAM and event.kind != DEVICE


def _operator_of(text: str) -> Iterator[str]:
    try:
        given = tomllib.loads(text).get("metadata", {})
    except tomllib.TOMLDecodeError:
        return
    if isinstance(given, dict):
        yield str(given.get("operator", ""))


def _people_of_record(values: Any) -> Iterator[str]:
    """Yield who made and reviewed a calibration, where a value is its sealed record."""
    try:
        record = json.loads(values["record"])
    except (TypeError, KeyError, ValueError):
        return
    yield from _named(record)


def _named(tree: Any) -> Iterator[str]:
    if isinstance(tree, dict):
        for key, value in tree.items():
            if key in PEOPLE_OF_A_RECORD and isinstance(value, str):
                yield value
            else:
                yield from _named(value)
    elif isinstance(tree, list):
        for one in tree:
            yield from _named(one)
