"""Stored rows of a study, in an append-only file, so that a killed study can be resumed."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.schema.wire import json_bytes
from rigapp.storage import hold_writer_lock
from rigapp.study.folder import IDENTITY, ROWS
from rigapp.study.points import StudyRow


class StudyIdentity(msgspec.Struct, frozen=True):
    """The identity of a folder's rows: texts of study and parameters, and the program's version."""

    study: str
    parameters: str
    version: str


class StudyJournal:
    """Append rows, each committed to the disk; one process at a time."""

    def __init__(self, folder: Path, identity: StudyIdentity) -> None:
        """Continue a folder, or begin it; raise UnusableInput for another study's."""
        self.folder = folder
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._file = (folder / ROWS).open("ab+")
        except OSError as error:
            raise UnusableInput(
                "--to {}: cannot be written ({}).", folder, error.strerror
            ) from error
        try:
            if not hold_writer_lock(self._file.fileno()):
                raise UnusableInput("--to {}: another process works on this study.", folder)
            self._require_same(identity)
            self.rows = self._read()
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> StudyJournal:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._file.close()

    def append(self, rows: Iterable[StudyRow]) -> None:
        """Write rows; they are on the disk on return."""
        lines = b"".join(json_bytes(row) + b"\n" for row in rows)
        self._file.write(lines)
        self._file.flush()
        os.fsync(self._file.fileno())

    def _require_same(self, identity: StudyIdentity) -> None:
        path = self.folder / IDENTITY
        if not path.exists():
            with whole_file(path) as part:
                part.write_bytes(msgspec.json.format(json_bytes(identity), indent=1))
            return
        try:
            known = msgspec.json.decode(path.read_bytes(), type=StudyIdentity)
        except (msgspec.DecodeError, OSError) as error:
            raise UnusableInput("{}: cannot be read ‹{}›.", path, error) from error
        if (known.study, known.parameters) != (identity.study, identity.parameters):
            raise UnusableInput(
                "--to {}: holds another study, or another parameter file; give a new folder.",
                self.folder,
            )
        if known.version != identity.version:
            raise UnusableInput(
                (
                    "--to {}: was begun by rigapp {}; continue with that version, or give a new"
                    " folder."
                ),
                self.folder,
                known.version,
            )

    def _read(self) -> dict[int, StudyRow]:
        """Return the complete rows; an incomplete last one is removed."""
        self._file.seek(0)
        data = self._file.read()
        end = data.rfind(b"\n") + 1
        results = {}
        for line in data[:end].splitlines():
            try:
                row = msgspec.json.decode(line, type=StudyRow)
            except msgspec.DecodeError as error:
                raise UnusableInput("{}: is damaged ‹{}›.", self.folder / ROWS, error) from error
            results[row.number] = row
        self._file.truncate(end)
        self._file.seek(end)
        return results
