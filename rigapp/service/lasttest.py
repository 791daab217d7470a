"""Which file the last test of a rig went into: an engine that starts with the computer asks."""

from __future__ import annotations

import logging
from pathlib import Path

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.process.private import read_own
from rigapp.schema.loglines import SpecimenWear
from rigapp.schema.wire import json_bytes
from rigapp.service.registry import kept_of
from rigapp.service.resumption import read_past, wear_of
from rigapp.storage import open_test
from rigapp.texts import say

log = logging.getLogger(__name__)


class LastTest(msgspec.Struct, frozen=True):
    """Name the rig file and the test file that was begun with it last.

    specimens: the newest file of each specimen by its name.
    """

    rig: str
    file: str
    specimens: dict[str, str] = {}


def remember(rig: Path, file: Path, specimen: str = "") -> None:
    """Keep that a test of a rig goes into a file; a test is not held up where it cannot be kept."""
    before = _kept(rig)
    specimens = before.specimens if before is not None else {}
    if specimen:
        specimens = {**specimens, specimen: str(file.resolve())}
    last = LastTest(str(rig.resolve()), str(file.resolve()), specimens)
    try:
        with whole_file(kept_of(rig, "last-tests"), mode=0o600) as part:
            part.write_bytes(json_bytes(last))
    except UnusableInput as error:
        log.warning("the name of the last test is not kept: %s", error)


def _kept(rig: Path) -> LastTest | None:
    try:
        return msgspec.json.decode(read_own(kept_of(rig, "last-tests")) or b"", type=LastTest)
    except (UnusableInput, ValueError):
        return None


def last_wear(rig: Path, specimen: str) -> SpecimenWear | None:
    """Return how far a specimen is worn by its last test on a rig; None where that is not known."""
    last = _kept(rig)
    file = last.specimens.get(specimen, "") if last is not None and specimen else ""
    if not file:
        return None
    try:
        with open_test(file) as reader:
            return wear_of(reader)
    except UnusableInput as error:
        log.warning("the wear of %s is not known: %s", specimen, error)
        return None


def cut_off(rig: Path) -> str:
    """Return the sentence of a rig's last test where nobody ended it, empty where all is well."""
    last = _kept(rig)
    if last is None:
        return ""
    try:
        past = read_past(Path(last.file))
    except UnusableInput:
        return ""
    if past.summary["status"] != "interrupted":
        return ""
    reached = past.summary["last_revolution"] or 0
    return say(
        "{}: the computer or the program ended at revolution {} of {} of this test.",
        last.file,
        reached,
        past.planned,
    )
