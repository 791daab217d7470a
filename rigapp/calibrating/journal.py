"""Journal of a calibration under way: every event is committed before it counts."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.storage import hold_writer_lock
from rigapp.texts import say


class Journal:
    """Append events as JSON lines, each forced to the disk; one writer at a time.

    An incomplete last line was interrupted while written and never confirmed; it is removed
    when the journal is resumed.
    """

    def __init__(self, path: Path) -> None:
        """Open a journal, making it where there is none; raise UnusableInput."""
        self.path = path
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
        except OSError as error:
            raise UnusableInput("{}: the journal cannot be opened ‹{}›.", path, error) from error
        if not hold_writer_lock(self._file):
            os.close(self._file)
            raise UnusableInput(
                "{}: another calibration writes this journal; close it, or name another.", path
            )

    def read(self) -> list[dict[str, Any]]:
        """Return the events so far; raise UnusableInput for an invalid line."""
        with open(self._file, "rb", closefd=False) as stream:
            stream.seek(0)
            data = stream.read()
        complete = data[: data.rfind(b"\n") + 1]
        if len(complete) < len(data):
            os.ftruncate(self._file, len(complete))
        events = []
        for number, line in enumerate(complete.splitlines(), 1):
            try:
                event = json.loads(line)
                if not isinstance(event, dict):
                    raise ValueError(say("no line of a journal"))
            except ValueError as error:
                raise UnusableInput(
                    "{}: line {} is not an event ({}); name another journal.",
                    self.path,
                    number,
                    error,
                ) from error
            events.append(event)
        return events

    def append(self, event: Mapping[str, Any]) -> None:
        """Commit one event to the disk; raise UnusableInput on failure."""
        line = json.dumps(event, ensure_ascii=False, allow_nan=False).encode() + b"\n"
        try:
            written = os.write(self._file, line)
            if written < len(line):
                raise OSError(say("only a part was written ‹{} of {} bytes›", written, len(line)))
            os.fsync(self._file)
        except OSError as error:
            raise UnusableInput(
                "{}: the reading was not saved ‹{}›; make room and record it again.",
                self.path,
                error,
            ) from error

    def close(self) -> None:
        """Close the journal; safe to call twice."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1
