"""What a test file says of its test, as it is needed to publish it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.report.results import sequence_of
from rigapp.schema.messages import Event
from rigapp.storage import TestReader, export_columns, open_test

STEP_COLUMN = ("step", "1", "number of the step of the test")


@dataclass(frozen=True, slots=True, eq=False)
class PackagedTest:
    """One test that is published.

    folder: where its files stand in the package. state: of the file when it was read. columns:
    name, unit and meaning of each column of its statistics. texts: every text of the file with its
    path, the log left out.
    """

    path: Path
    folder: str
    state: tuple[int, ...]
    compressed: bool
    summary: Mapping[str, Any]
    about: Mapping[str, Any]
    configuration: Mapping[str, Any]
    calibration: Mapping[str, Any]
    columns: tuple[tuple[str, str, str], ...]
    texts: tuple[tuple[str, str], ...]
    events: tuple[Event, ...]

    @property
    def title(self) -> str:
        """Return what the test is called."""
        return str(self.about["title"]) or self.folder

    @property
    def operator(self) -> str:
        """Return who made the test."""
        return str(self.about["operator"])

    @property
    def day(self) -> str:
        """Return the day of its end, as 2026-11-23; of its start where the end is not known."""
        return str(self.about["ended"] or self.summary["started"])[:10]


def packaged_tests(paths: Sequence[Path]) -> tuple[PackagedTest, ...]:
    """Read what is said of tests; raise UnusableInput for one that runs, and for two of a name."""
    found: dict[str, PackagedTest] = {}
    for path in paths:
        one = _read(path)
        other = found.setdefault(one.folder.casefold(), one)
        if other is not one:
            raise UnusableInput(
                f"{path}: {other.path} has the same name; rename one of them, or name it once."
            )
    return tuple(found.values())


def refuse_changed(tests: Sequence[PackagedTest]) -> None:
    """Refuse tests that were resumed, compressed or replaced since they were read."""
    for one in tests:
        if _state(one.path) != one.state:
            raise UnusableInput(
                f"{one.path}: was changed or compressed while it was packed; package it again."
            )


def _state(path: Path) -> tuple[int, ...]:
    try:
        found = path.stat()
    except OSError:
        return ()
    return found.st_ino, found.st_size, found.st_mtime_ns


def _read(path: Path) -> PackagedTest:
    state = _state(path)
    with open_test(path) as reader:
        summary = reader.summary()
        if summary["status"] == "running":
            raise UnusableInput(
                f"{path}: the test is running; package it when it has ended, or stop it first."
            )
        return PackagedTest(
            path=path,
            folder=path.stem,
            state=state,
            compressed=reader.compressed,
            summary=summary,
            about=reader.metadata(),
            configuration=reader.configuration(),
            calibration=reader.calibration(),
            columns=_columns(reader),
            texts=tuple(reader.texts()),
            events=tuple(reader.events()),
        )


def _columns(reader: TestReader) -> tuple[tuple[str, str, str], ...]:
    columns = [
        (name, unit, sentence)
        for name, (_, unit, sentence) in export_columns(reader, cycles=False).items()
    ]
    return (*columns, *([STEP_COLUMN] if sequence_of(reader) is not None else []))
