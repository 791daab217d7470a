"""The tests of a package and their files: descriptions, names and contents."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.report.results import sequence_of, step_numbers
from rigapp.schema.messages import Event
from rigapp.schema.wire import json_bytes
from rigapp.storage import TestReader, export_columns, export_test, open_test, trimmed_copy

STEP_COLUMN = ("step", "1", "number of the step of the test")


@dataclass(frozen=True, slots=True, eq=False)
class PackagedTest:
    """One test that is published.

    folder: of its files in the package. state: of the file when it was read. columns:
    name, unit and meaning of each column of its statistics. texts: every text of the file with its
    path, without the log.
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
        """Return the title of the test."""
        return str(self.about["title"]) or self.folder

    @property
    def operator(self) -> str:
        """Return the operator of the test."""
        return str(self.about["operator"])

    @property
    def day(self) -> str:
        """Return the day of its end, as 2026-11-23; of its start where the end is not known."""
        return str(self.about["ended"] or self.summary["started"])[:10]


def packaged_tests(paths: Sequence[Path]) -> tuple[PackagedTest, ...]:
    """Read the facts of tests; raise UnusableInput for a running one, and for two of a name."""
    result: dict[str, PackagedTest] = {}
    for path in paths:
        test = _read(path)
        other = result.setdefault(test.folder.casefold(), test)
        if other is not test:
            raise UnusableInput(
                f"{path}: {other.path} has the same name; rename one of them, or name it once."
            )
    return tuple(result.values())


def refuse_changed(tests: Sequence[PackagedTest]) -> None:
    """Refuse tests that were resumed, compressed or replaced since they were read."""
    for test in tests:
        if _state(test.path) != test.state:
            raise UnusableInput(
                f"{test.path}: was changed or compressed while it was packed; package it again."
            )


def _state(path: Path) -> tuple[int, ...]:
    try:
        result = path.stat()
    except OSError:
        return ()
    return result.st_ino, result.st_size, result.st_mtime_ns


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


HDF5, HTML, CSV = "application/x-hdf5", "text/html", "text/csv"
JSON, TOML, TEXT, YAML = "application/json", "application/toml", "text/plain", "application/yaml"
RECORD = "record_"
"""Prefix of a sealed record's name in the group ``/entry/calibration``."""
AT_A_TIME = 1 << 20

Progress = Callable[[int], None]


@dataclass(frozen=True, slots=True)
class PackedFile:
    """One file of a package.

    path: in the package. source: its bytes. about: what it is. media: its media type. packed:
    whether its bytes are compressed already.
    """

    path: str
    source: Path
    about: str
    media: str
    packed: bool = False

    @property
    def size(self) -> int:
        """Return its bytes."""
        return self.source.stat().st_size

    def digest(self, progress: Progress) -> str:
        """Return the SHA-256 of its bytes in hexadecimal."""
        result = hashlib.sha256()
        for part in self.parts():
            result.update(part)
            progress(len(part))
        return result.hexdigest()

    def parts(self) -> Iterator[bytes]:
        """Yield its bytes in small pieces."""
        with self.source.open("rb") as stream:
            while part := stream.read(AT_A_TIME):
                yield part


def files_of(test: PackagedTest, work: Path) -> Iterator[PackedFile]:
    """Yield the files of a test; generated ones are written into the folder ``work``."""
    folder = work / test.folder
    folder.mkdir()
    about = "the test as it was recorded: NeXus/HDF5, see docs/file-format.md of rigapp"
    table = folder / "statistics.csv"
    with ThreadPoolExecutor(1, "trimmed copy") as pool:
        # Other processors compress it while this one makes the table.
        copied = pool.submit(_whole, test, folder)
        report = _report(test.path)
        _export(test.path, table)
        source = copied.result()
    yield PackedFile(f"{test.folder}/{test.path.name}", source, about, HDF5, packed=True)
    make = partial(_made, folder)
    shown = "the report of the test, for a browser: figures, log, calibration, settings"
    yield make("report.html", shown, HTML, report)
    statistics = "one line a revolution; README.txt explains the columns"
    yield PackedFile(f"{test.folder}/statistics.csv", table, statistics, CSV)
    for name, about in (("rig", "what hung on which port"), ("test", "how the test was to run")):
        text = str(test.configuration.get(name, ""))
        if text:
            yield make(f"{name}.toml", f"the {name} file as given: {about}", TOML, text.encode())
    numbers = "the calibration with which the test was measured, as in the test's file"
    yield make("calibration.json", numbers, JSON, _json(test.calibration))
    for name, record in _records(test.calibration):
        sealed = "a calibration record with its readings; rigapp calibrate verify fits them again"
        yield make(f"{name}.json", sealed, JSON, record.encode())
    versions = test.configuration.get("versions", {})
    yield make("versions.json", "versions of what wrote the test's file", JSON, _json(versions))


def _whole(test: PackagedTest, folder: Path) -> Path:
    """Return the file of a test that goes into its package."""
    if test.compressed:
        return test.path
    # A file written in place has rows beyond the committed ones, which others would take for data.
    trimmed_copy(test.path, folder / test.path.name)
    return folder / test.path.name


def text_file(work: Path, path: str, about: str, media: str, text: str) -> PackedFile:
    """Write a text file of the package, and return it."""
    source = work / path
    source.write_text(text, encoding="utf-8")
    return PackedFile(path, source, about, media)


def _made(folder: Path, name: str, about: str, media: str, data: bytes) -> PackedFile:
    source = folder / name
    source.write_bytes(data)
    return PackedFile(f"{folder.name}/{name}", source, about, media)


def _report(path: Path) -> bytes:
    from rigapp.report.page.document import as_html
    from rigapp.report.testreport import report_of

    return as_html(report_of(path))


def _export(path: Path, table: Path) -> None:
    with open_test(path) as reader:
        sequence = sequence_of(reader)
    steps = partial(step_numbers, sequence) if sequence is not None else None
    export_test(path, table, steps=steps)


def _records(calibration: Any) -> Iterator[tuple[str, str]]:
    """Yield the sealed records of a test with their names, as they were given."""
    for name, values in sorted(calibration.items()):
        if name.startswith(RECORD) and isinstance(values, dict) and "record" in values:
            yield name, str(values["record"])


def _json(value: Any) -> bytes:
    """Return a value as JSON, its keys in order; NaN and infinity become null."""
    return msgspec.json.format(json_bytes(value, order="deterministic"), indent=1) + b"\n"
