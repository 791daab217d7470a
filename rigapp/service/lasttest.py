"""Which file the last test of a rig went into: an engine that starts with the computer asks."""

from __future__ import annotations

import logging
from pathlib import Path

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.process.private import read_own
from rigapp.service.registry import kept_of
from rigapp.service.resumption import read_past

log = logging.getLogger(__name__)


class LastTest(msgspec.Struct, frozen=True):
    """Name the rig file and the test file that was begun with it last."""

    rig: str
    file: str


def remember(rig: Path, file: Path) -> None:
    """Keep that a test of a rig goes into a file; a test is not held up where it cannot be kept."""
    last = LastTest(str(rig.resolve()), str(file.resolve()))
    try:
        with whole_file(kept_of(rig, "last-tests"), mode=0o600) as part:
            part.write_bytes(msgspec.json.encode(last))
    except UnusableInput as error:
        log.warning("the name of the last test is not kept: %s", error)


def cut_off(rig: Path) -> str:
    """Return the sentence of a rig's last test where nobody ended it, empty where all is well."""
    try:
        last = msgspec.json.decode(read_own(kept_of(rig, "last-tests")) or b"", type=LastTest)
        past = read_past(Path(last.file))
    except (UnusableInput, ValueError):
        return ""
    if past.summary["status"] != "interrupted":
        return ""
    reached = past.summary["last_revolution"] or 0
    return (
        f"{last.file}: the computer or the program ended at revolution {reached} of {past.planned}"
        " of this test."
    )
