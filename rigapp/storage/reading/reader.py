"""Read a test file, running, interrupted or finished, in place or compressed."""

from __future__ import annotations

import contextlib
import os
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.columns import PROFILE_ANGLES_DEG
from rigapp.schema.messages import Event
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.reading.resample import Method, resample_channels
from rigapp.storage.reading.streams import Columns, StreamReader
from rigapp.storage.structure.digest import SEAL, settings_digest
from rigapp.storage.structure.events import events_of, first_broken_link, translated
from rigapp.storage.structure.hdf import open_for_reading, refuse_damage
from rigapp.storage.structure.layout import (
    CALIBRATION,
    CHECKPOINT_BYTES,
    CHECKPOINT_SLOTS,
    CONFIGURATION,
    CONFIGURATION_DIGEST,
    END_TIME,
    SCHEMA,
    SCHEMA_ATTRIBUTE,
    START_TIME,
    STATE,
    STATE_FIELDS,
    FileColumn,
    streams_of,
)
from rigapp.texts import say, sentence_of_error


@dataclass(frozen=True, slots=True)
class StoredCycle:
    """One cycle: its revolution and one array of samples for each column.

    why: scheduled, last, before, trigger or after; empty for an unfinished revolution. quality:
    flags as in the revolution's row, 0 where the file has none. table: the channels of the
    file.
    """

    revolution: int
    columns: Columns
    why: str = "scheduled"
    quality: int = 0
    table: ChannelTable = BASE

    def resampled(self, points: int = 360, method: Method = "linear") -> StoredCycle:
        """Return this cycle on a uniform grid of crank angles, without time and raw signals.

        method: linear or band-limited, see ``rigapp.storage.reading.resample``. Raises ValueError.
        """
        even = resample_channels(self.columns, self.table, points, method)
        return replace(self, columns={**even})


def open_test(path: str | os.PathLike[str]) -> TestReader:
    """Open a test file for reading; a running test is not disturbed.

    Raises UnusableInput for a file that is missing, not HDF5, not a test, damaged or from a newer
    version.
    """
    target = Path(path)
    return TestReader(target, _opened(target))


class TestReader(StreamReader):
    """Read one test file; only committed rows count as data."""

    def summary(self) -> dict[str, Any]:
        """Return the summary that ``rigapp info`` shows; its keys are public and stable."""
        revolutions = self.committed()
        first, last = self._first_and_last(revolutions)
        status, reason = self._status(revolutions)
        return {
            "status": status,
            "reason": reason,
            "revolutions": revolutions,
            "first_revolution": first,
            "last_revolution": last,
            "gaps": self.state("gaps"),
            "cycles_saved": self.committed("cycles"),
            "started": self._text(START_TIME),
            "schema": int(self._file.attrs[SCHEMA_ATTRIBUTE]),
        }

    def _first_and_last(self, rows: int) -> tuple[int | None, int | None]:
        """Return the numbers of the first and the last of the first ``rows`` revolutions."""
        if not rows:
            return None, None
        first, last = (int(self.column("revolution", row, row + 1)[0]) for row in (0, rows - 1))
        with refuse_damage(self.path, say("the number of its safe revolutions")):
            if last - first < rows - 1:
                raise ValueError(say("{} revolutions cannot end at number {}", rows, last))
        return first, last

    def state(self, name: str) -> int:
        """Return one number of ``/entry/state``, for example ``planned_revolutions``."""
        return int(self._read(f"{STATE}/{name}"))

    def has_all_revolutions(self) -> bool:
        """Return whether the last revolution of the plan is committed."""
        rows = self.committed()
        planned = self.state("planned_revolutions")
        return rows > 0 and int(self.column("revolution", rows - 1)[0]) >= planned

    def reason_code(self) -> str:
        """Return the code of the reason why the test ended, empty while it is running."""
        return self._state_text("reason_code")

    def metadata(self) -> dict[str, Any]:
        """Return title, people, specimen, times and numbers for the head of a report."""
        names = {
            "title": "/entry/title",
            "operator": "/entry/user/name",
            "specimen": "/entry/sample/name",
            "bushing": "/entry/sample/description",
            "notes": "/entry/experiment_description",
            "rig": "/entry/instrument/name",
            "identifier": "/entry/entry_identifier_uuid",
            "started": START_TIME,
            "ended": END_TIME,
        }
        result: dict[str, Any] = {
            name: self._text(path) if self._holds(path) else "" for name, path in names.items()
        }
        result["simulated"] = bool(self._read("/entry/simulated"))
        result["planned_revolutions"] = self.state("planned_revolutions")
        result["reason_code"] = self.reason_code()
        return result

    def rows(self, first: int = 0) -> Columns:
        """Return the committed rows from row ``first``, one array for each column."""
        return self._table("revolutions", first)

    def cycle_revolutions(self) -> NDArray[np.int64]:
        """Return the numbers of the revolutions with a saved cycle."""
        return self.column("revolution", stream="cycles")

    def cycle_reasons(self) -> list[str]:
        """Return why each saved cycle is kept: scheduled, last, before, trigger or after."""
        if not self.plan.cycle_reason:
            return ["scheduled"] * self.committed("cycles")
        return np.char.decode(self.column("why", stream="cycles"), "ascii", "replace").tolist()

    def cycle_qualities(self) -> NDArray[np.int64]:
        """Return the quality flags of each saved cycle's revolution, 0 where not recorded."""
        if not self.plan.cycle_reason:
            return np.zeros(self.committed("cycles"), dtype=np.int64)
        return self.column("quality", stream="cycles").astype(np.int64)

    def cycle(self, index: int) -> StoredCycle:
        """Return the saved cycle ``index``, negative from the end; raises IndexError."""
        number = self.committed("cycles")
        position = index + number if index < 0 else index
        if not 0 <= position < number:
            raise IndexError(
                say("{}: there is no saved cycle {}, there are {}", self.path, index, number)
            )
        return next(self._ragged("cycles", position, position + 1))

    def cycles(self) -> Iterator[StoredCycle]:
        """Yield the saved cycles in order."""
        yield from self._ragged("cycles", 0, self.committed("cycles"))

    def unfinished(self) -> list[StoredCycle]:
        """Return the partial revolutions at the ends of the test's runs, in order."""
        if "unfinished" not in self._streams:
            return []
        return list(self._ragged("unfinished", 0, self.committed("unfinished")))

    def _ragged(self, stream: str, start: int, stop: int) -> Iterator[StoredCycle]:
        index = self._streams[stream]
        samples = self._streams["samples" if stream == "cycles" else "unfinished_samples"]
        known = {
            field.name: self._rows(index.path(field.name), start, stop).tolist()
            for field in index.fields
        }
        whys = known.get("why", [b"scheduled" if stream == "cycles" else b""] * (stop - start))
        qualities = known.get("quality", [0] * (stop - start))
        table = self.plan.table
        for i, (first, count) in enumerate(zip(known["first"], known["count"], strict=True)):
            yield StoredCycle(
                known["revolution"][i],
                {
                    field.name: self._rows(samples.path(field.name), first, first + count)
                    for field in samples.fields
                },
                whys[i].decode(errors="replace"),
                qualities[i],
                table,
            )

    def predictions(self, first: int = 0) -> Columns:
        """Return the committed rows of the twin's stream, one array for each column."""
        return self._table("prediction", first)

    def curve_revolutions(self) -> NDArray[np.int64]:
        """Return the numbers of the revolutions whose predicted curves are saved."""
        return self.column("curve_revolution", stream="curves")

    def predicted_curve(self, revolution: int) -> Columns | None:
        """Return the predicted curves of a revolution with their ``angle``, None when not saved."""
        places = np.flatnonzero(self.curve_revolutions() == revolution)
        if places.size == 0:
            return None
        row = int(places[-1])
        curves = {
            name: self._rows(f"/entry/prediction/curve_{name}", row, row + 1)[0]
            for name in self.plan.predicted_curves
        }
        return {"angle": self.angles(), **curves}

    def profiles(self) -> Columns:
        """Return the committed worn profiles: ``angle`` (deg) and one array for each column.

        Curves (profiles, angles) in mm, NaN where unknown; empty for files without profiles.
        """
        angle = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)
        fields = self._profile_fields()
        table = {field.name: np.empty((0, *field.shape)) for field in fields.values()}
        if "profiles" in self._streams:
            table = self._table("profiles", 0)
        return {"angle": angle, **{name: table[field.name] for name, field in fields.items()}}

    def _profile_fields(self) -> dict[str, FileColumn]:
        """Return the columns of a worn profile by name, also of files without profiles."""
        stream = streams_of(replace(self.plan, profiles=1))["profiles"]
        return {field.name.removeprefix("profile_"): field for field in stream.fields}

    def checkpoint(self) -> bytes:
        """Return the newest checkpoint of the twin up to the last committed row, else empty."""
        if "checkpoints" not in self._streams:
            return b""
        revolutions = self.committed()
        last = self._first_and_last(revolutions)[1] or 0
        slots = self._table("checkpoints", 0)
        best, result = -1, b""
        for slot in range(CHECKPOINT_SLOTS):
            number, length = (
                int(slots[f"checkpoint_{key}"][slot]) for key in ("revolution", "length")
            )
            if not (0 < length <= CHECKPOINT_BYTES and best < number <= last):
                continue
            state = slots["checkpoint_state"][slot, :length].tobytes()
            if zlib.crc32(state) == int(slots["checkpoint_crc"][slot]):
                best, result = number, state
        return result

    def events(self) -> list[Event]:
        """Return the committed events in order, those of older files in the present form."""
        result = events_of(self._table("events", 0))
        return result if self.plan.event_details else translated(result)

    def first_altered_event(self) -> int | None:
        """Return the first row of the log whose digest does not match, None when all do."""
        return first_broken_link(
            self._table("events", 0), self._text("/entry/entry_identifier_uuid")
        )

    def last_digest(self) -> bytes:
        """Return the digest of the log's last row, empty when there is none."""
        number = self.committed("events")
        return bytes(self._rows("/entry/events/digest", number - 1, number)[0]) if number else b""

    def configuration(self) -> dict[str, Any]:
        """Return the configuration: texts ``rig`` and ``test``, ``parameters``, ``versions``."""
        return self._below(CONFIGURATION)

    def calibration(self) -> dict[str, Any]:
        """Return the calibration records that the test was measured with, nested by name."""
        return self._below(CALIBRATION)

    def settings_confirmed(self) -> bool:
        """Return whether the data fixed before the first row are unchanged."""
        return self.settings_digest() == self._state_text(CONFIGURATION_DIGEST)

    def settings_digest(self) -> str:
        """Return the hexadecimal digest of the data fixed before the first row."""
        with refuse_damage(self.path, CONFIGURATION):
            return settings_digest(self._file, self.plan).decode()

    def ending(self) -> list[str]:
        """Return the stored texts about start, course and end of the test."""
        return [
            *(self._text(f"{STATE}/{name}") for name in STATE_FIELDS),
            self._text(START_TIME),
            self._text(END_TIME),
        ]

    def seal_text(self) -> str:
        """Return the seal in the file, empty where it has none."""
        path = f"{SEAL}/seal"
        return self._text(path) if self._holds(path) else ""

    def angles(self) -> NDArray[np.float64]:
        """Return the crank angles of the predicted curves, deg."""
        return np.asarray(self._read("/entry/prediction/angle"), dtype=np.float64)

    def _status(self, revolutions: int) -> tuple[str, str]:
        stored = self.stored_status()
        reason = self._state_text("reason")
        if stored == "complete":
            return "complete", reason
        if stored in ("stopped", "fault"):
            return "stopped", reason
        if FILES.is_held(self.path, self.writer()):
            return "running", ""
        complete = self.has_all_revolutions()
        safe = (
            say("all {} revolutions are", revolutions)
            if complete
            else say("{} revolutions are", revolutions)
        )
        following = say("ends the test with them") if complete else say("continues after them")
        return (
            "interrupted",
            say(
                "the program that wrote the file ended without closing the test (killed,"
                " crashed or power lost); {} safe, resume {}",
                safe,
                following,
            ),
        )

    def writer(self) -> str:
        """Return the process that writes or wrote the file; ``process N on HOST`` while it does."""
        return self._state_text("writer")


def _opened(path: Path) -> h5py.File:
    if path.is_dir():
        raise UnusableInput("{}: this is a folder, not a test file", path)
    try:
        if path.stat().st_size == 0:
            raise UnusableInput("{}: the file is empty; a copy of the test must be restored", path)
        file = open_for_reading(path)
    except FileNotFoundError as error:
        raise UnusableInput("{}: there is no such file", path) from error
    except OSError as error:
        raise UnusableInput(_refusal(path, sentence_of_error(error))) from error
    with contextlib.ExitStack() as undo:
        undo.callback(file.close)
        _refuse_foreign(path, file)
        undo.pop_all()
    return file


def _refusal(path: Path, message: str) -> str:
    if "truncated" in message:
        return say("{}: the file is cut short, perhaps an unfinished copy; copy it again", path)
    if "signature not found" in message:
        return say("{}: this is not an HDF5 file; give a file that rigapp run wrote", path)
    if "ermission" in message:
        return say("{}: the file may not be read; ask its owner for permission", path)
    return say("{}: the file cannot be opened as HDF5 ‹{}›", path, message)


def _refuse_foreign(path: Path, file: h5py.File) -> None:
    with refuse_damage(path, SCHEMA_ATTRIBUTE):
        schema = file.attrs.get(SCHEMA_ATTRIBUTE)
        schema = None if schema is None else int(schema)
    if schema is None:
        raise UnusableInput(
            "{}: this HDF5 file is not a test; give a file that rigapp run wrote", path
        )
    if schema > SCHEMA:
        raise UnusableInput(
            "{}: the file has schema {} and this version reads up to {}; install a newer rigapp",
            path,
            schema,
            SCHEMA,
        )
