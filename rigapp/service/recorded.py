"""The test that a file records: to go on with it, or to end it where nothing is left to do."""

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
from rigapp.schema.messages import FinishReason
from rigapp.schema.notices import Finished
from rigapp.storage import (
    believed_until,
    finish_whole_test,
    open_test,
    seal_test,
    settle_in_background,
)
from rigapp.texts import say, sentence_of_error

log = logging.getLogger(__name__)


def with_revolutions(test: Document[TestFile], revolutions: int | None) -> Document[TestFile]:
    """Return a test with another number of revolutions, in its text as well; UnusableInput."""
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
    """Return the test that a file records, to go on with it; raise UnusableInput."""
    with open_test(path) as reader:
        text = reader.configuration()["test"]
        planned = reader.state("planned_revolutions")
    test = Document(path, text, parse_test(text, say("{} (its test)", path)))
    return with_revolutions(test, planned or None)


def end_whole_test(path: Path) -> Finished | None:
    """End an interrupted file that has all its revolutions already; None for any other."""
    revolutions = finish_whole_test(path)
    if not revolutions:
        return None
    end = complete_test(path)
    assert end is not None
    settle(end)
    return end


def complete_test(path: Path) -> Finished | None:
    """Return how a test ended that is complete; None for any other."""
    with open_test(path) as reader:
        said = reader.summary()
    if said["status"] != "complete":
        return None
    reason = str(said["reason"] or "")
    return Finished(FinishReason.COMPLETE, reason, "complete", said["revolutions"], str(path))


def checkpoint(path: Path) -> bytes:
    """Return what the twin of an earlier part of the test left in its file, or nothing."""
    with open_test(path) as reader:
        return reader.checkpoint()


def bushing_left(path: Path) -> tuple[bytes, tuple[ParameterFile, str] | None]:
    """Return what the twin of an ended test left of its bushing, and its model and technique.

    The model is None where it cannot be read, or where readings that are not believed are in it.
    """
    with open_test(path) as reader:
        left = reader.checkpoint()
        if believed_until(reader) is not None:
            return left, None
    try:
        test = recorded_test(path).record
    except UnusableInput:
        return left, None
    return left, (test.model, test.prediction.joint)


SEALED_AT_ONCE = 64 << 20
"""Bytes of data whose seal takes less time than to start a process that makes it."""


def settle(end: Finished) -> None:
    """Compress and seal the file of a complete test; only seal that of a stopped one.

    What takes long is done by a process of its own that outlives this one.
    """
    path = Path(end.file)
    if not path.is_file():
        return
    try:
        with open_test(path) as reader:
            much = reader.used_bytes(path.stat().st_size) > SEALED_AT_ONCE
        if end.status == "complete" or much:
            settle_in_background(path).leave()
        else:
            seal_test(path)
    except (UnusableInput, OSError) as error:
        log.warning("%s", sentence_of_error(error))
