"""Read rig, test and parameter files; every fault is one sentence with file, key and remedy."""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import msgspec

from rigapp.config.consistency import faults
from rigapp.config.errors import UnusableInput, in_words
from rigapp.config.notify import NotifyFile
from rigapp.config.parameters import ParameterFile, to_parameters
from rigapp.config.ranges import keys_of, refusals
from rigapp.config.reading import read_text
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.toml import toml_tree
from rigapp.texts import joined, say, sentence_of_error

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters

SCHEMA = 1
LARGEST_SETTINGS_BYTES = 1 << 20

KINDS: Mapping[type[msgspec.Struct], str] = {
    RigFile: say("rig file"),
    TestFile: say("test file"),
    ParameterFile: say("parameter file"),
}
"""Names of the kinds of files that are used together and have different tables."""

Record = TypeVar("Record", bound=msgspec.Struct)


@dataclass(frozen=True, slots=True)
class Document(Generic[Record]):
    """A configuration file as read: path, text, and record."""

    path: Path
    text: str
    record: Record


@dataclass(frozen=True, slots=True)
class RigRecords:
    """A rig with the numbers of its records. texts: label -> the record as stored, sealed.

    blocking: label -> why the record prevents a start (expired), empty without such records.
    remarks: label -> the record's number and date, and its parts that cannot be verified.
    """

    rig: Document[RigFile]
    texts: Mapping[str, str] = field(default_factory=dict)
    blocking: Mapping[str, str] = field(default_factory=dict)
    remarks: Mapping[str, str] = field(default_factory=dict)


def read_rig(path: Path) -> Document[RigFile]:
    """Read a rig file; raises UnusableInput."""
    return read_document(path, RigFile)


def read_test(path: Path) -> Document[TestFile]:
    """Read a test file; raises UnusableInput."""
    return read_document(path, TestFile)


def parse_notify(text: str, name: str) -> NotifyFile:
    """Read a user's file of notification channels from text; raises UnusableInput."""
    return _record(Path(name), toml_tree(text, name), NotifyFile)


def read_parameter_file(path: Path) -> Document[ParameterFile]:
    """Read a parameter file of the model; raises UnusableInput."""
    return read_document(path, ParameterFile)


def read_parameters(path: Path) -> Parameters:
    """Read a parameter file into the model's records; raises UnusableInput naming file and key."""
    path = Path(path)
    return to_parameters(read_parameter_file(path).record, source=str(path))


def parse_parameters(tree: Mapping[str, Any], name: str) -> Parameters:
    """Return the model's records for the tables of a parameter file; raises UnusableInput."""
    return to_parameters(_record(Path(name), tree, ParameterFile), source=name)


def parse_test(text: str, name: str, *, recorded: bool = False) -> TestFile:
    """Read a test from text; raises UnusableInput.

    recorded: the test has run and is only shown; its ranges are not checked again.
    """
    return _record(Path(name), toml_tree(text, name), TestFile, recorded=recorded)


def validated_test(tree: Mapping[str, Any]) -> tuple[TestFile | None, list[str]]:
    """Return the test from nested tables, None if unusable, and all its faults."""
    try:
        record = _decode(Path("test"), tree, TestFile)
    except UnusableInput as error:
        return None, [sentence_of_error(error)]
    wrong = [*refusals(record), *faults(record)]
    return None if wrong else record, wrong


def parse_rig(text: str, name: str, *, recorded: bool = False) -> RigFile:
    """Read a rig from text, recorded as in ``parse_test``; raises UnusableInput."""
    return _record(Path(name), toml_tree(text, name), RigFile, recorded=recorded)


def read_document(path: Path, record: type[Record]) -> Document[Record]:
    """Read a TOML file as a record that has a ``schema``; raises UnusableInput."""
    text = read_text(path, LARGEST_SETTINGS_BYTES)
    return Document(path, text, _record(path, toml_tree(text, path), record))


def _record(
    path: Path, tree: Mapping[str, Any], kind: type[Record], *, recorded: bool = False
) -> Record:
    record = _decode(path, tree, kind)
    if not recorded:
        for wrong in itertools.chain(refusals(record), faults(record)):
            raise UnusableInput("{}: {}.", path, wrong.rstrip("."))
    return record


def _decode(path: Path, tree: Mapping[str, Any], record: type[Record]) -> Record:
    _check_schema(path, tree)
    for where, key, allowed in _unknown_keys(tree, _known(record)):
        _refuse_another_kind(path, tree, record)
        raise UnusableInput(
            "{}: {}{} is not a known key{}.", path, where, key, _nearest(key, allowed)
        )
    try:
        return msgspec.convert(tree, record)
    except msgspec.ValidationError as error:
        raise UnusableInput("{}: {}.", path, _sentence(error, record)) from error


def _refuse_another_kind(path: Path, tree: Mapping[str, Any], wanted: type[Record]) -> None:
    """Refuse a file with the tables of another kind, as when two files are interchanged."""
    fitting = [kind for kind in KINDS if set(tree) <= set(_known(kind)[""])]
    if fitting and wanted in KINDS and wanted not in fitting:
        raise UnusableInput(
            "{}: this is a {}; a {} belongs here. Check which file goes where.",
            path,
            KINDS[fitting[0]],
            KINDS[wanted],
        )


def _check_schema(path: Path, tree: Mapping[str, Any]) -> None:
    schema = tree.get("schema")
    if schema is None:
        raise UnusableInput("{}: schema is missing; write schema = {} at the top.", path, SCHEMA)
    if isinstance(schema, int) and schema > SCHEMA:
        raise UnusableInput(
            "{}: schema = {} is newer than this program reads ({}); update rigapp.",
            path,
            schema,
            SCHEMA,
        )
    if schema != SCHEMA:
        raise UnusableInput(
            "{}: schema = {} is not readable; write {}.", path, repr(schema), SCHEMA
        )


def _known(kind: type[msgspec.Struct]) -> dict[str, list[str]]:
    """Return the keys of each table of a kind of file, by the path of the table."""
    known: dict[str, list[str]] = {}
    for key in keys_of(kind):
        way = key.path.split(".")
        for depth, name in enumerate(way):
            names = known.setdefault(".".join(way[:depth]), [])
            if name not in names:
                names.append(name)
    return known


def _unknown_keys(
    tree: Any, known: Mapping[str, list[str]], path: str = "", where: str = ""
) -> Iterator[tuple[str, str, list[str]]]:
    """Yield (where, key, allowed keys) of every key that a kind of file does not have."""
    if isinstance(tree, list):
        for index, item in enumerate(tree):
            yield from _unknown_keys(item, known, path, f"{where}{index}.")
    elif isinstance(tree, Mapping) and path in known:
        allowed = known[path]
        for key, value in tree.items():
            name = "*" if allowed == ["*"] else key
            if name in allowed:
                below = f"{path}.{name}" if path else name
                yield from _unknown_keys(value, known, below, f"{where}{key}.")
            else:
                yield where, key, allowed


def _nearest(key: str, allowed: list[str]) -> str:
    stem = key.rsplit("_", 1)[0]
    close = [name for name in allowed if name.rsplit("_", 1)[0] == stem]
    close += difflib.get_close_matches(key, allowed, n=1)
    if close:
        return say("; did you mean {}", close[0])
    return say("; known here: ") + joined(", ", allowed)


def _sentence(error: msgspec.ValidationError, record: type[msgspec.Struct]) -> str:
    where, message = in_words(error)
    if message == "is missing":
        return say("{} is missing", where)
    if message.startswith("invalid enum value"):
        path = re.sub(r"\[\d+]", "", where).replace("[...]", ".*")
        choices = next(key.choices for key in keys_of(record) if key.path == path)
        message = say("{}, allowed are {}", message, joined(", ", choices))
    return say("{}: {}", where, message) if where else message
