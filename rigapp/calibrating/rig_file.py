"""Write a calibration record's name into a rig file: comments kept, a copy kept, checked first."""

from __future__ import annotations

import os
import time
from pathlib import Path

import msgspec

from rigapp.calibrating.records_in_use import LOAD_CELL, RecordPlace, places_of, with_records
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_rig, read_rig
from rigapp.config.rig import RigFile
from rigapp.config.writing import whole_file


def only_records_differ(one: RigFile, other: RigFile) -> bool:
    """Tell whether two rig files say the same but for the records that they name."""

    def bare(rig: RigFile) -> RigFile:
        for place in places_of(rig):
            names = {place.key: "", f"{place.key}_override": ""}
            rig = place.put(rig, msgspec.structs.replace(place.of(rig), **names))
        return rig

    return bare(one) == bare(other)


def name_record(rig: Path, record: Path, place: RecordPlace = LOAD_CELL) -> Path:
    """Let a place of a rig file name a record; return the copy of the old file.

    The name is relative to the rig file. An override of the place goes: its reason was the former
    record's. Everything else stays, comments included. Nothing is changed when the rig would not be
    usable with the record. Raises UnusableInput.
    """
    import tomlkit

    before = read_rig(rig)
    document = tomlkit.parse(before.text)
    table = document[place.section]
    table[place.key] = os.path.relpath(record.resolve(), rig.resolve().parent)
    table.pop(f"{place.key}_override", None)
    text = tomlkit.dumps(document)
    with_records(Document(rig, text, parse_rig(text, str(rig))))
    copy = _copy(rig, before.text)
    with whole_file(rig) as part:
        part.write_text(text, encoding="utf-8", newline="")
    return copy


def _copy(rig: Path, text: str) -> Path:
    """Write the old text beside the rig file under a name that is free."""
    stamp = time.strftime("%Y%m%d-%H%M%S")
    for count in range(100):
        more = f"-{count}" if count else ""
        copy = rig.with_name(f"{rig.stem}.before-{stamp}{more}{rig.suffix}")
        try:
            with copy.open("x", encoding="utf-8", newline="") as stream:
                stream.write(text)
        except FileExistsError:
            continue
        except OSError as error:
            raise UnusableInput(
                f"{copy}: the copy of the rig file cannot be written ‹{error}›; nothing is changed."
            ) from error
        return copy
    raise UnusableInput(f"{rig}: there are too many copies beside it; remove some.")
