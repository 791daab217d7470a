"""Recorded tests: resume or end a test, and the last test of a rig."""

from __future__ import annotations

import logging
import re
from pathlib import Path

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import refusal
from rigapp.config.recipe import TestFile
from rigapp.config.toml import toml_text
from rigapp.config.writing import whole_file
from rigapp.process.private import read_own
from rigapp.schema.loglines import SpecimenWear
from rigapp.schema.messages import FinishReason
from rigapp.schema.notices import Finished
from rigapp.schema.wire import json_bytes
from rigapp.service.registry import kept_of
from rigapp.service.resumption import read_past, wear_of
from rigapp.storage import (
    finish_whole_test,
    open_test,
    plausible_until,
    seal_test,
    settle_in_background,
)
from rigapp.texts import say, sentence_of_error

log = logging.getLogger(__name__)


def with_revolutions(test: Document[TestFile], revolutions: int | None) -> Document[TestFile]:
    """Return a test with a new number of revolutions, also in its text; raises UnusableInput."""
    if revolutions is None or revolutions == test.record.run.revolutions:
        return test
    wrong = refusal("run.revolutions", revolutions)
    if wrong:
        raise UnusableInput(wrong + ".")
    text, count = re.subn(
        r"(?m)^(\s*revolutions\s*=\s*)\S+", rf"\g<1>{revolutions}", test.text, count=1
    )
    record = parse_test(text, str(test.path)) if count else test.record
    if record.run.revolutions != revolutions:
        run = msgspec.structs.replace(test.record.run, revolutions=revolutions)
        record = msgspec.structs.replace(test.record, run=run)
        text = toml_text(record)
    return Document(test.path, text, record)


def recorded_test(path: Path) -> Document[TestFile]:
    """Return the test of a recorded file, to resume it; raises UnusableInput."""
    with open_test(path) as reader:
        text = reader.configuration()["test"]
        planned = reader.state("planned_revolutions")
    test = Document(path, text, parse_test(text, say("{} (its test)", path)))
    return with_revolutions(test, planned or None)


def end_whole_test(path: Path) -> Finished | None:
    """End an interrupted file that has all its revolutions; return None for any other."""
    revolutions = finish_whole_test(path)
    if not revolutions:
        return None
    end = complete_test(path)
    assert end is not None
    settle(end)
    return end


def complete_test(path: Path) -> Finished | None:
    """Return the end of a complete test; None for any other."""
    with open_test(path) as reader:
        summary = reader.summary()
    if summary["status"] != "complete":
        return None
    reason = str(summary["reason"] or "")
    return Finished(FinishReason.COMPLETE, reason, "complete", summary["revolutions"], str(path))


def checkpoint(path: Path) -> bytes:
    """Return the twin's checkpoint of an earlier part of the test, or empty bytes."""
    with open_test(path) as reader:
        return reader.checkpoint()


def bushing_state(path: Path) -> tuple[bytes, tuple[ParameterFile, str] | None]:
    """Return the twin's checkpoint of an ended test, and its model and technique.

    The latter are None where the file is unreadable or the checkpoint contains rejected readings.
    """
    with open_test(path) as reader:
        left = reader.checkpoint()
        if plausible_until(reader) is not None:
            return left, None
    try:
        test = recorded_test(path).record
    except UnusableInput:
        return left, None
    return left, (test.model, test.prediction.joint)


SEALED_AT_ONCE = 64 << 20
"""Bytes of data up to which sealing takes less time than starting a process for it."""


def settle(end: Finished) -> None:
    """Compress and seal the file of a complete test; only seal that of a stopped one.

    Long work runs in a separate process that outlives this one.
    """
    path = Path(end.file)
    if not path.is_file():
        return
    try:
        with open_test(path) as reader:
            large = reader.used_bytes(path.stat().st_size) > SEALED_AT_ONCE
        if end.status == "complete" or large:
            settle_in_background(path).leave()
        else:
            seal_test(path)
    except (UnusableInput, OSError) as error:
        log.warning("%s", sentence_of_error(error))


class LastTest(msgspec.Struct, frozen=True):
    """The rig file and the test file that was last started with it.

    specimens: the newest file of each specimen by its name.
    """

    rig: str
    file: str
    specimens: dict[str, str] = {}


def remember(rig: Path, file: Path, specimen: str = "") -> None:
    """Store the file of a rig's test; a failure does not stop the test."""
    before = _last_test(rig)
    specimens = before.specimens if before is not None else {}
    if specimen:
        specimens = {**specimens, specimen: str(file.resolve())}
    last = LastTest(str(rig.resolve()), str(file.resolve()), specimens)
    try:
        with whole_file(kept_of(rig, "last-tests"), mode=0o600) as part:
            part.write_bytes(json_bytes(last))
    except UnusableInput as error:
        log.warning("the name of the last test is not kept: %s", error)


def _last_test(rig: Path) -> LastTest | None:
    try:
        return msgspec.json.decode(read_own(kept_of(rig, "last-tests")) or b"", type=LastTest)
    except (UnusableInput, ValueError):
        return None


def last_wear(rig: Path, specimen: str) -> SpecimenWear | None:
    """Return the wear of a specimen from its last test on a rig, None where unknown."""
    last = _last_test(rig)
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
    """Return a sentence if a rig's last test was cut off, else an empty text."""
    last = _last_test(rig)
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
