"""Write a running test: rows in place, a commit about once a second, a status at the end."""

from __future__ import annotations

import os
import socket
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.schema.messages import Event, PathReport
from rigapp.storage.filesystem.calls import DiskFull, StorageFailed
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.folder import refuse_little_space
from rigapp.storage.filesystem.rescue import PathWatcher
from rigapp.storage.structure.build import PAGE
from rigapp.storage.structure.checksum import load_kernel
from rigapp.storage.structure.events import columns_of, is_requested, rows_of, seed_of
from rigapp.storage.structure.layout import (
    END_TIME,
    STATE,
    FilePlan,
    FileStream,
    planned_rows,
    streams_of,
)
from rigapp.storage.structure.metadata import TestMetadata, iso_time
from rigapp.storage.writing.backlog import Backlog
from rigapp.storage.writing.create import (
    Places,
    create_file,
    fitted_streams,
    lengths_of,
    reserve_stream,
)
from rigapp.storage.writing.records import CycleWriter, PredictionWriter
from rigapp.storage.writing.streams import (
    COUNTERS,
    FINAL_STATUSES,
    Capacity,
    Counts,
    RecordPlacer,
    RowBuffer,
    Scalars,
)
from rigapp.texts import joined, say

ROWS_BUFFERED = 256  # 72 kB in one piece; a commit has fewer
LONG_TEST = 4096  # revolutions; few rigs produce a block of rows a second
STALE_ROWS = 4096  # more than a crash leaves uncounted
EVENTS_KEPT_BACK = 64  # rows reserved for alarms and the end of the test


def create_test(path: str | os.PathLike[str], plan: FilePlan, metadata: TestMetadata) -> TestWriter:
    """Create the file of a test and return its writer.

    The file is complete and its space reserved before it appears under its name. Raises
    UnusableInput for an existing file, a missing or read-only folder, or too little space.
    """
    target = Path(path).absolute()
    disk, places = create_file(target, plan, metadata)
    counts = Counts(planned_revolutions=plan.revolutions)
    reserved = {name: stream.planned for name, stream in streams_of(plan).items()}
    return TestWriter(disk, places, plan, counts, reserved, seed_of(metadata.identifier))


class TestWriter:
    """Write one test file in place.

    ``append_*`` may be called from any thread and never wait for the disk's sync; ``commit`` should
    be called by a separate thread about once a second. The methods for cycles are those of
    ``CycleWriter``, those for the twin of ``PredictionWriter``.
    """

    __test__ = False

    def __init__(
        self,
        disk: Disk,
        places: Places,
        plan: FilePlan,
        counts: Counts,
        reserved: Mapping[str, int],
        digest: bytes,
    ) -> None:
        self.plan = plan
        self.revolutions_committed = counts.revolutions
        self._disk = disk
        self._backlog = Backlog(disk)
        self._places = places
        self._scalars = Scalars(disk, places)
        self._counts = counts
        self._streams = fitted_streams(plan, places)
        self._digest = digest
        self._counters = [name for name, path in COUNTERS.items() if path in places]
        self._written = dict.fromkeys(self._counters, -1)
        lengths = lengths_of(disk.path, self._streams)
        self._rooms = {
            name: Capacity(
                disk,
                stream,
                self._offsets(stream),
                reserved[name],
                lengths.get(name, ()),
                getattr(counts, name, 0),
            )
            for name, stream in self._streams.items()
        }
        self._rows = self._row_buffer("revolutions", counts.revolutions)
        self._records = {
            name: RecordPlacer(
                self._backlog,
                self._streams[name],
                self._offsets(self._streams[name]),
                self._rooms[name],
            )
            for name in self._streams
            if name not in ("revolutions", "prediction")
        }
        self._event_lock = threading.Lock()
        self._count_lock = threading.Lock()
        self._commit_lock = threading.Lock()
        cycles = CycleWriter(self._backlog, self._streams, self._records, counts, self._count_lock)
        self._twin = PredictionWriter(
            plan,
            self._row_buffer("prediction", counts.prediction),
            self._streams,
            self._records,
            counts,
            self._count_lock,
            disk,
            places,
        )
        self.append_cycle, self.hold_cycle = cycles.append, cycles.hold
        self.append_unfinished = cycles.append_unfinished
        self.append_prediction = self._twin.append
        self.append_curves, self.append_profile = (
            self._twin.append_curves,
            self._twin.append_profile,
        )
        self.keep_checkpoint = self._twin.keep_checkpoint
        self._path_watcher = PathWatcher(disk, self._reserve, self._commit_lock)
        self._samples_synced = counts.samples
        self._closed = False
        self._finished = False
        if plan.checksums and plan.revolutions > LONG_TEST:
            load_kernel()  # now rather than at the first block of rows
        self._scalars.put_state(
            "writer", say("process {} on {}", os.getpid(), socket.gethostname())
        )

    @property
    def path(self) -> Path:
        """Return the path of the file; a new one after the file had to be saved elsewhere."""
        return self._disk.path

    @property
    def bytes_written(self) -> int:
        """Return the bytes written to the file since it was opened."""
        return self._disk.bytes_written

    @property
    def revolutions(self) -> int:
        """Return the number of rows appended, committed or not."""
        return self._rows.count

    @property
    def planned_revolutions(self) -> int:
        """Return the planned revolutions of the test, extensions included."""
        return self._counts.planned_revolutions

    @property
    def cycles_refused(self) -> int:
        """Return the number of complete cycles not stored for lack of reserved space."""
        return self._counts.cycles_refused

    def append_row(self, values: NDArray[np.float64] | Sequence[float]) -> None:
        """Append the statistics of one revolution: float64, in the order of the plan's columns.

        Raises DiskFull when the file is full, StorageFailed when writing fails.
        """
        self._disk.refuse_broken()
        if not self._rows.append(values):
            raise DiskFull(
                "{}: the file has room for {} revolutions and is full; begin a new test for more",
                self.path,
                self._rows.count,
            )

    def forget_stale(self) -> None:
        """Remove the checksums of the rows after the last one, which a crash left uncounted.

        New rows overwrite them one by one; an old row between them must not appear confirmed.
        """
        for name in ("revolutions", "cycles"):
            stream = self._streams[name]
            rows = self._rows_of(name) or 0
            if stream.checksum is not None:
                offset = self._places[stream.path(stream.checksum.name)][0]
                number = min(STALE_ROWS, stream.capacity - rows)
                size = stream.checksum.row_bytes
                self._backlog.put_over([(memoryview(bytes(number * size)), offset + rows * size)])

    def append_event(self, event: Event) -> bool:
        """Append an event to the log; False, and counted, when the log is full.

        Events of requests get at most half of the log, so that alarms and the end of the test
        always find space.
        """
        half = self._streams["events"].planned // 2
        return self._append_event(event, half if is_requested(event) else EVENTS_KEPT_BACK)

    def note_gap(self, event: Event) -> None:
        """Count an interruption of the data and log its position."""
        with self._count_lock:
            self._counts.gaps += 1
        self._append_event(event, 0)

    def extend(self, revolutions: int) -> None:
        """Set the planned total to ``revolutions`` and reserve the disk space for them.

        Raises UnusableInput, and changes nothing, when the file or the disk has no space.
        """
        capacity = self._streams["revolutions"].capacity
        if revolutions > capacity:
            raise UnusableInput(
                "{}: the file has room for {} revolutions, not {}; begin a new test for more",
                self.path,
                capacity,
                revolutions,
            )
        wanted = planned_rows(self.plan, revolutions)
        needed = sum(
            max(0, rows - self._rooms[name].reserved) * self._streams[name].row_bytes
            for name, rows in wanted.items()
        )
        refuse_little_space(self.path.parent, self.path, needed, say("the extension"))
        try:
            for name, rows in wanted.items():
                if rows > self._rooms[name].reserved:
                    self._rooms[name].reserve(rows)
        except OSError as error:
            raise UnusableInput(
                "{}: the disk refused the room for {} revolutions ({}); free {:.0f} MB",
                self.path,
                revolutions,
                error.strerror,
                needed / 1000000.0,
            ) from error
        before = self._counts.planned_revolutions
        with self._count_lock:
            self._counts.planned_revolutions = revolutions
        self._append_event(
            Event(
                time.time(), self._rows.count, "extended", "storage",
                say("the test will have {} revolutions", revolutions),
                str(before), str(revolutions),
            ),
            0,
        )  # fmt: skip

    def begin_again(self, event: Event, gap: bool) -> None:
        """Set the status of the file to running again; gap: whether there are data before."""
        with self._count_lock:
            self._counts.resumed += 1
            self._counts.gaps += gap
        self._append_event(event, 0)
        with self._commit_lock:
            self._commit()
            for path in (f"{STATE}/reason_code", f"{STATE}/reason", END_TIME):
                self._scalars.put(path, "")
            self._scalars.put_state("status", "running")
            self._disk.sync()

    def commit(self) -> int:
        """Commit everything appended so far; return the number of committed revolutions.

        Data first, then the counters, each followed by a sync: a committed revolution survives a
        power loss. Appending continues meanwhile. After ``close`` it does nothing.
        """
        with self._commit_lock:
            return self.revolutions_committed if self._closed else self._commit()

    def place(self) -> None:
        """Write the backlog to the file between commits, without a sync.

        Appending then need not write. Raises StorageFailed; after ``close`` it does nothing.
        """
        with self._commit_lock:
            if not self._closed:
                self._backlog.drain()

    def watch_path(self, notice: Callable[[str], object] = lambda _: None) -> PathReport | None:
        """Restore the name of a file that was deleted, moved or replaced; see ``PathWatcher``."""
        with self._path_watcher.looking:
            return None if self._closed else self._path_watcher.look(notice)

    def _reserve(self, disk: Disk) -> None:
        for name, stream in self._streams.items():
            reserve_stream(disk, stream, self._places, 0, self._rooms[name].reserved)

    def finish(self, status: str, reason_code: str, sentence: str) -> None:
        """Commit, and record how the test ended: status complete, stopped or fault."""
        if status not in FINAL_STATUSES:
            raise ValueError(
                say("status {} is not one of {}", repr(status), joined(", ", FINAL_STATUSES))
            )
        with self._commit_lock:
            self._disk.refuse_broken()
            self.forget_stale()
            self._commit()
            for name, room in self._rooms.items():
                room.end(self._rows_of(name) or 0)
            self._scalars.put_state("reason_code", reason_code)
            self._scalars.put_state("reason", sentence)
            self._scalars.put(END_TIME, iso_time(time.time()))
            # The computer's name marks a running writer; a finished file must not disclose it.
            self._scalars.put_state("writer", say("process {}", os.getpid()))
            self._disk.sync()
            self._scalars.put_state("status", status)
            self._disk.sync()
            self._finished = True
        report = self.watch_path()
        if report is not None and not report.saved:
            raise StorageFailed(report.sentence)
        self._give_back()

    def _give_back(self) -> None:
        """Deallocate unused space; resuming the test reserves it again."""
        with self._commit_lock:
            for name, room in self._rooms.items():
                rows = self._rows_of(name)
                if rows is not None:
                    room.give_back(rows)

    def _rows_of(self, stream: str) -> int | None:
        """Return the number of rows of a stream, None where its rows are not counted."""
        if stream == "revolutions":
            return self._rows.count
        if stream == "prediction":
            return self._twin.rows.count
        if stream == "waiting":
            return 0
        with self._count_lock:
            return getattr(self._counts, stream, None)

    def close(self) -> None:
        """Close the file after committing the remaining data, if the disk allows it."""
        with self._path_watcher.looking, self._commit_lock:
            if self._closed:
                return
            try:
                if not self._finished:
                    self._commit()
            finally:
                self._closed = True
                self._disk.close()

    def discard(self) -> None:
        """Close a file without recorded data, and delete it."""
        with self._path_watcher.looking, self._commit_lock:
            if self._closed:
                return
            self._closed = self._finished = True
            try:
                if os.path.samestat(os.fstat(self._disk.fd), os.stat(self.path)):
                    os.unlink(self.path)
            finally:
                self._disk.close()

    def __enter__(self) -> TestWriter:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _commit(self) -> int:
        with self._count_lock:
            now = {
                name: getattr(self._counts, name)
                for name in self._counters
                if name not in ("revolutions", "prediction")
            }
            samples = self._counts.samples
        checkpoint = self._twin.take_checkpoint()
        now["revolutions"] = self._rows.hand_over_pending()
        now["prediction"] = self._twin.rows.hand_over_pending()
        if checkpoint is not None:
            self._twin.place_checkpoint(checkpoint)
        self._backlog.drain()
        for room in self._rooms.values():  # before the counters, which must not exceed the rows
            room.show()
        changed = [name for name in self._counters if now[name] != self._written[name]]
        if changed or checkpoint is not None:
            self._disk.sync()
            for name in changed:
                self._scalars.put(COUNTERS[name], now[name])
            self._disk.sync()
            self._forget_samples(self._samples_synced, samples)
            self._written = now
            self.revolutions_committed = now["revolutions"]
        return self.revolutions_committed

    def _forget_samples(self, first: int, stop: int) -> None:
        """Drop synced samples from the page cache: the test does not read them again."""
        for field in self._streams["samples"].fields:
            offset = self._places[self._streams["samples"].path(field.name)][0]
            start = (offset + first * field.row_bytes) // PAGE * PAGE
            self._disk.forget(start, offset + stop * field.row_bytes - start)
        self._samples_synced = stop

    def _append_event(self, event: Event, kept_back: int) -> bool:
        with self._event_lock:
            fields = self._streams["events"].fields
            rows = rows_of(event, self._digest, fields)
            first = self._counts.events
            if first + len(rows) + kept_back > self._streams["events"].planned:
                with self._count_lock:
                    self._counts.events_refused += 1
                return False
            self._records["events"].place(first, len(rows), columns_of(rows, fields))
            self._digest = rows[-1]["digest"]
            with self._count_lock:
                self._counts.events = first + len(rows)
        return True

    def _row_buffer(self, name: str, count: int) -> RowBuffer:
        stream = self._streams[name]
        return RowBuffer(
            self._backlog, stream, self._offsets(stream), self._rooms[name], count, ROWS_BUFFERED
        )

    def _offsets(self, stream: FileStream) -> dict[str, int]:
        return {field.name: self._places[stream.path(field.name)][0] for field in stream.stored}
