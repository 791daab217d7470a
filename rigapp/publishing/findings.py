"""Find private data in the texts of a test, and where.

A finding is a suspicion, not a proof; a person decides.
"""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

from rigapp.config.notify import REFERENCE
from rigapp.publishing.packaged import PackagedTest
from rigapp.publishing.private import (
    HOME,
    IPV4,
    IPV6,
    LOCAL_NAME,
    MAIL,
    NO_HOST,
    PROGRAM,
    ROOT,
    URL,
    address_of,
    is_elsewhere,
)
from rigapp.publishing.publication import Author

RIG, TEST = "/entry/configuration/rig", "/entry/configuration/test"
SETTINGS = {RIG: "rig file", TEST: "test file"}
"""TOML texts of a test file, and their names."""

_TABLE = re.compile(r"\s*\[{1,2}\s*([A-Za-z_][\w.\" -]*?)\s*\]{1,2}\s*(?:#.*)?")
_KEY = re.compile(r"\s*([A-Za-z_\"][\w.\" -]*?)\s*=")


@dataclass(frozen=True, slots=True)
class Passage:
    """A piece of text. where: its location, for people; path, key: for programs."""

    where: str
    path: str
    key: str
    text: str


def passages(test: PackagedTest) -> Iterator[Passage]:
    """Yield all texts of a test file, its name included."""
    yield Passage("its name", "", "", test.path.name)
    for path, text in test.texts:
        yield from _pieces(path, text)
    for number, event in enumerate(test.events, 1):
        data = (text for _, text in _branches(event.data))
        for text in (event.source, event.text, event.before, event.after, *data):
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
        elif match := _KEY.match(line):
            key = match[1].strip('"')
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
    """Yield the texts of nested values with their keys, without the keys themselves."""
    if isinstance(tree, str):
        yield key, tree
    elif isinstance(tree, dict | list):
        pairs = tree.items() if isinstance(tree, dict) else enumerate(tree, 1)
        for name, value in pairs:
            yield from _branches(value, f"{key}.{name}" if key else str(name))


_WRITER = re.compile(r"process \d+ on (\S+)")
_VERSION = re.compile(r"version|firmware|platform")
_TOLD = re.compile(r"(?:notify|ping)\.(?:url|command)")

PUBLIC = frozenset({"http", "https", "doi", "urn"})
"""Schemes by which documents are cited: a whole domain name is not private there."""


def found_in(passage: Passage, computers: frozenset[str], people: frozenset[str]) -> Iterator[str]:
    """Yield the private data in a passage, each as the object of a sentence.

    computers: names of the known computers. people: names of persons other than the authors.
    """
    text = passage.text
    for kind in (_addresses, _folders, _networks, _messages):
        yield from kind(passage)
    if host := _WRITER.fullmatch(text) if passage.path.endswith("/state/writer") else None:
        yield f"the host name {host[1]}"
    for name in sorted(computers):
        if _word(name, text, re.IGNORECASE):
            yield f"the host name {name}"
    for name in sorted(people):
        if _word(name, text):
            yield f"the name of {name}, who is not among the authors"


def _addresses(passage: Passage) -> Iterator[str]:
    for address in MAIL.findall(passage.text):
        yield f"the e-mail address {address}"


def _folders(passage: Passage) -> Iterator[str]:
    for home in HOME.finditer(passage.text):
        yield f"the home folder of {home[1]} ({home[0]})"
    if ROOT.search(passage.text):
        yield "a path in the home folder of root (/root)"


def _networks(passage: Passage) -> Iterator[str]:
    for url in URL.findall(passage.text):
        if host := _private_host(url):
            yield f"the host name {host}"
    for name in LOCAL_NAME.findall(passage.text):
        yield f"the host name {name}"
    if not _VERSION.search(passage.key):  # four numbers with dots
        for address in (*IPV4.findall(passage.text), *IPV6.findall(passage.text)):
            if is_elsewhere(address):
                yield f"the IP address {address}"


def _messages(passage: Passage) -> Iterator[str]:
    if passage.path == RIG and _TOLD.fullmatch(passage.key):
        secrets = ", ".join(REFERENCE.findall(passage.text))
        yield "whom messages are sent to" + (f", with the secret named {secrets}" * bool(secrets))


def _private_host(url: str) -> str:
    """Return the host of a URL unless it is public, an IP address or this computer."""
    try:
        parts = urlsplit(REFERENCE.sub("", url))
        host = parts.hostname or ""
    except ValueError:
        return ""
    if parts.scheme in NO_HOST or not host or host == "localhost" or address_of(host) is not None:
        return ""
    is_domain = "." in host and not LOCAL_NAME.fullmatch(host)
    return "" if parts.scheme in PUBLIC and is_domain else host


def _word(name: str, text: str, flags: int = 0) -> bool:
    """Return whether a name is in a text, with its case: Max is not the word max."""
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text, flags) is not None


DEVICE = "device"
"""Kind of the events whose source is a device of the rig."""
PEOPLE_OF_A_RECORD = ("operator", "reviewer")
MOST_PLACES = 6


@dataclass(frozen=True, slots=True)
class Finding:
    """Private data. what: as the object of a sentence. places: where it is in the file."""

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
    """Return the private data in tests, in their order.

    computers: names of computers to search for, beside texts that look like one.
    """
    named = frozenset(spelling for author in authors for spelling in author.spellings)
    result: list[Finding] = []
    for test in tests:
        people = frozenset(person for person in people_of(test) if person.casefold() not in named)
        by_what: dict[str, dict[str, None]] = {}
        for passage in passages(test):
            for what in found_in(passage, computers, people):
                by_what.setdefault(what, {})[passage.where] = None
        result += [Finding(test.path.name, what, tuple(at)) for what, at in by_what.items()]
    return result


def people_of(test: PackagedTest) -> frozenset[str]:
    """Return the names of people in a test: its operators, and those of its calibrations."""
    texts = dict(test.texts)
    names = [test.operator, *_operator_of(texts.get(TEST, ""))]
    names += [
        event.source
        for event in test.events
        if event.source not in PROGRAM and event.kind != DEVICE
    ]
    for values in test.calibration.values():
        names += _people_of_record(values)
    return frozenset(name.strip() for name in names) - PROGRAM


def _operator_of(text: str) -> Iterator[str]:
    try:
        metadata = tomllib.loads(text).get("metadata", {})
    except tomllib.TOMLDecodeError:
        return
    if isinstance(metadata, dict):
        yield str(metadata.get("operator", ""))


def _people_of_record(values: Any) -> Iterator[str]:
    """Yield operator and reviewer of a calibration, where a value is its sealed record."""
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
        for branch in tree:
            yield from _named(branch)
