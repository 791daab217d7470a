"""Verify, close and salvage test files."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.storage import (
    StorageFailed,
    broken_seals,
    close_test,
    compact_test,
    found_damage,
    open_test,
    salvage_test,
    seal_words,
)
from rigapp.texts import say, sentence_of_error

NAMES = {
    "revolutions": say("revolutions"),
    "cycles": say("whole cycles"),
    "unfinished": say("unfinished revolutions"),
    "prediction": say("predicted rows"),
    "curves": say("predicted curves"),
    "profiles": say("worn profiles"),
    "events": say("rows of the log"),
}


def verify_file(path: Path, *, as_json: bool) -> int:
    """Check a file by its checksums and say which part differs; return 1 where one does."""
    with open_test(path) as reader:
        checksums, compressed = reader.plan.checksums, reader.compressed
        damage = list(found_damage(reader))
        try:
            damage += broken_seals(reader)
            sealed = seal_words(reader)
        except UnusableInput as error:
            damage.append(sentence_of_error(error))
            sealed = ""
    if as_json:
        print(json.dumps({"checksums": checksums, "damage": damage, "seal": sealed}))
    elif damage:
        for one in damage:
            print(one)
        print(say("Salvage the rest: rigapp salvage {} --to NEW.h5", path))
    elif checksums:
        print(say("{}: rows, cycles, log and configuration are as they were written.", path))
        print(sealed)
    else:
        what = (
            say("what was compressed can be read") if compressed else say("only the log is checked")
        )
        print(
            say(
                "{}: this file is of an older version, in which rows cannot be proved; {}.",
                path,
                what,
            )
        )
    return 1 if damage else 0


def close_file(path: Path) -> int:
    """End a file whose writer is gone, and trim it; return the exit status."""
    close_test(path)
    try:
        trimmed = compact_test(path)
    except StorageFailed as error:
        print(f"rigapp: {error}", file=sys.stderr)
        return 1
    with open_test(path) as reader:
        revolutions = reader.committed()
        status = reader.stored_status()
    if not trimmed:
        raise UnusableInput("{}: the test has ended and its file is trimmed already", path)
    print(say("{}: {} with {} revolutions; the file is trimmed.", path, status, revolutions))
    return 0


def salvage_file(path: Path, to: Path) -> int:
    """Write what checksums confirm into a new file and say what is lost; return the status."""
    found = salvage_test(path, to)
    print(say("{}: salvaged from {}.", to, path))
    for name, rows in found.kept.items():
        if rows or found.lost[name]:
            print(say("{}: {} kept, {} lost", NAMES[name], rows, found.lost[name]))
    for one in found.missing:
        print(say("Lost: {}", one))
    for sentence in found.damage:
        print(sentence)
    return 0
