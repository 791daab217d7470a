"""Resume an interrupted test in the same file."""

from __future__ import annotations

import contextlib
import errno
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.schema.messages import Event
from rigapp.storage.filesystem.calls import BINARY
from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.filesystem.folder import hidden_name, refuse_little_space, remove_stale
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.reading.blocks import rows_up_to
from rigapp.storage.reading.reader import StoredCycle, TestReader, open_test
from rigapp.storage.reading.seal import beside
from rigapp.storage.reading.verify import NEWEST_BYTES, find_damage, wrong_rows
from rigapp.storage.structure.checksum import cycle_checksum
from rigapp.storage.structure.events import seed_of
from rigapp.storage.structure.hdf import refuse_damage
from rigapp.storage.structure.layout import WAITING_FIELDS, FilePlan, planned_rows
from rigapp.storage.writing.create import Places, fitted_streams, places_of, reserve_stream
from rigapp.storage.writing.streams import Counts
from rigapp.storage.writing.writer import TestWriter
from rigapp.texts import say

LAST, BEFORE = "last", "before"
"""Reasons to store a cycle without a trigger: the last complete one, or one before the end."""


def left_cycles(reader: TestReader, cycles: int, last: int) -> list[StoredCycle]:
    """Return the confirmed cycles after the first ``cycles`` ones, in order.

    last: the last committed revolution; later ones are measured again. None in older files.
    """
    if not reader.plan.checksums:
        return []
    newest = int(reader.cycle_revolutions()[cycles - 1]) if cycles else 0
    result = {cycle.revolution: cycle for cycle in _waiting(reader)}
    result |= {cycle.revolution: cycle for cycle in _uncounted(reader, cycles)}
    return [result[number] for number in sorted(result) if newest < number <= last]


def _waiting(reader: TestReader) -> Iterator[StoredCycle]:
    """Yield the confirmed waiting cycles of the file, in any order."""
    if not reader.has("waiting"):
        return
    fields = reader.fields("waiting")
    columns, checksums = reader.raw_rows("waiting", 0, reader.plan.waiting_cycles)
    newest = max((int(revolution) for revolution in columns[0]), default=0)
    for slot, checksum in enumerate(checksums):
        values = {field.name: column[slot] for field, column in zip(fields, columns, strict=True)}
        count = int(values["count"])
        samples = {field.name: values[field.name][:count] for field in fields if field.shape}
        if count <= 0 or cycle_checksum(samples.values(), WAITING_FIELDS, values) != checksum:
            continue
        number, why = int(values["revolution"]), bytes(values["why"]).decode("ascii", "replace")
        why = why or (LAST if number == newest else BEFORE)
        yield StoredCycle(number, samples, why, int(values["quality"]), reader.plan.table)


def _uncounted(reader: TestReader, cycles: int) -> Iterator[StoredCycle]:
    """Yield the confirmed cycles that follow the counted ones without a gap."""
    names = [field.name for field in reader.fields("cycles")]
    samples = [field.name for field in reader.fields("samples")]
    first, capacity = reader.first_free_sample(cycles), reader.declared("cycles")
    for index in range(cycles, capacity):
        columns, _ = reader.raw_rows("cycles", index, index + 1)
        row = {name: column[0] for name, column in zip(names, columns, strict=True)}
        if int(row["first"]) != first or wrong_rows(reader, "cycles", index, index + 1).size:
            return
        first += int(row["count"])
        values, _ = reader.raw_rows("samples", int(row["first"]), first)
        yield StoredCycle(
            int(row["revolution"]),
            dict(zip(samples, (np.array(value) for value in values), strict=True)),
            bytes(row.get("why", b"scheduled")).decode("ascii", "replace"),
            int(row.get("quality", 0)),
            reader.plan.table,
        )


def reopen_test(path: str | os.PathLike[str]) -> TestWriter:
    """Open an interrupted or stopped test for writing after its committed rows.

    The gap is counted and logged; the caller sets the flag in the first new row. Raises
    UnusableInput for a complete test, a file that another process writes, a compressed file, and
    too little space.
    """
    target = Path(path).absolute()
    with open_test(target) as reader:
        _refuse_finished(reader)
    writer, last = _writer_at_end(target, _reserve)
    _log_resumption(writer, last)
    with contextlib.suppress(OSError):  # of the earlier end, which no longer holds
        beside(target).unlink(missing_ok=True)
    return writer


def finish_whole_test(path: str | os.PathLike[str]) -> int:
    """End a test that was killed after its last revolution was committed, before its file ended.

    Return its revolutions, 0 when there is nothing to do: revolutions are missing, the test has
    ended, or is being written. Raises UnusableInput as ``reopen_test``.
    """
    target = Path(path).absolute()
    with open_test(target) as reader:
        if reader.summary()["status"] != "interrupted" or not reader.has_all_revolutions():
            return 0
    writer, last = _writer_at_end(target, _as_planned)
    with writer:
        text = say("all {} revolutions were in the file; it was ended after an interruption", last)
        writer.append_event(Event(time.time(), last, "resumed", "storage", text))
        writer.finish("complete", "complete", say("The test is complete: {}.", text))
        return writer.revolutions


def close_test(path: str | os.PathLike[str]) -> int:
    """End an interrupted test without its rig; return its revolutions, 0 where it has ended.

    Its status is complete with all revolutions, else stopped. Raises UnusableInput as
    ``reopen_test``.
    """
    target = Path(path).absolute()
    with open_test(target) as reader:
        if reader.stored_status() != "running":
            return 0
        complete = reader.has_all_revolutions()
    writer, last = _writer_at_end(target, _as_planned)
    with writer:
        text = say("the file was closed after an interruption; the last revolution is {}", last)
        writer.append_event(Event(time.time(), last, "resumed", "storage", text))
        if complete:
            writer.finish("complete", "complete", say("The test is complete: {}.", text))
        else:
            writer.finish("stopped", "operator", text)
        return writer.revolutions


def _writer_at_end(
    path: Path, reserve: Callable[[Disk, FilePlan, Places, int], dict[str, int]]
) -> tuple[TestWriter, int]:
    """Return a writer after the committed rows, and the last revolution; raises UnusableInput."""
    fd = open_exclusively(path)
    with contextlib.ExitStack() as undo:
        undo.callback(close_exclusive, fd)
        with open_test(path) as reader:
            if FILES.is_taken(path, reader.writer()):
                raise _written_elsewhere(path)
            _refuse_finished(reader)
            places = _sound_places(path, reader.plan)
            damage = list(find_damage(reader, NEWEST_BYTES))
            if damage:
                raise UnusableInput(
                    "{}: the file is damaged ‹{}›; recover the intact data with rigapp salvage"
                    " FILE --to NEW.h5, and begin a new test",
                    path,
                    damage[0],
                )
            counts, digest, last = _counts(reader)
            plan = reader.plan
            interrupted = reader.stored_status() == "running"
            left = left_cycles(reader, counts.cycles, last) if interrupted else []
        disk = Disk(fd, path)
        reserved = reserve(disk, plan, places, counts.planned_revolutions)
        writer = TestWriter(disk, places, plan, counts, reserved, digest)
        writer.forget_stale()
        for cycle in left:
            writer.append_cycle(cycle.revolution, cycle.columns, cycle.why, cycle.quality)
        undo.pop_all()
    return writer, last


def _sound_places(path: Path, plan: FilePlan) -> Places:
    """Return the offsets of the datasets; raise UnusableInput where one overlaps another."""
    with refuse_damage(path, say("its structure")):
        places, end = places_of(path), 0
        fitted_streams(plan, places)
        for name, (offset, size) in sorted(places.items(), key=lambda item: item[1]):
            if offset < end:
                raise ValueError(say("{} lies over another dataset", name))
            end = offset + size
        if end > path.stat().st_size:
            raise ValueError(say("a dataset lies beyond its end"))
    return places


def _as_planned(disk: Disk, plan: FilePlan, places: Places, revolutions: int) -> dict[str, int]:
    """Return the planned rows without reserving space: no rows will follow."""
    return {name: stream.planned for name, stream in fitted_streams(plan, places).items()}


def open_exclusively(path: Path) -> int:
    """Open a test file as its only writer and return the locked descriptor.

    Raises UnusableInput when another process writes it, or writing is not permitted.
    """
    fd = _open_for_writing(path)
    try:
        if not FILES.hold(fd):
            raise _written_elsewhere(path)
    except BaseException:
        os.close(fd)
        raise
    try:
        _refuse_replaced(path, fd)
    except BaseException:
        close_exclusive(fd)
        raise
    return fd


def close_exclusive(fd: int) -> None:
    """Close a file that was opened exclusively."""
    FILES.release(fd)
    os.close(fd)


def _written_elsewhere(path: Path) -> UnusableInput:
    return UnusableInput(
        say(
            "{}: another process is writing this test; stop it there before resuming it here",
            path,
        )
    )


def _refuse_finished(reader: TestReader) -> None:
    status = reader.stored_status()
    if status == "complete":
        raise UnusableInput(
            "{}: the test is complete with {} revolutions; begin a new test",
            reader.path,
            reader.committed(),
        )
    if reader.compressed:
        raise UnusableInput(
            "{}: the test was ended ({}) and its file compressed; begin a new test",
            reader.path,
            reader.summary()["reason"],
        )


def _open_for_writing(path: Path) -> int:
    """Open a write-protected file of this user; it is protected again on return.

    If the process is killed, a mark remains by which the next test protects the file.
    """
    remove_stale(path.parent)
    mark = hidden_name(path, "opened")
    try:
        if not os.access(path, os.W_OK):
            with contextlib.suppress(OSError):
                mark.touch()
            path.chmod(0o644)
        try:
            fd = os.open(path, os.O_RDWR | BINARY)
            FILES.protect(fd)
        finally:
            mark.unlink(missing_ok=True)
        return fd
    except OSError as error:
        raise UnusableInput(
            "{}: the file cannot be opened for writing ({}); resume as the user who"
            " began the test, on a disk that can be written",
            path,
            error.strerror,
        ) from error


def _refuse_replaced(path: Path, fd: int) -> None:
    opened, named = os.fstat(fd), path.stat()
    if (opened.st_ino, opened.st_dev) != (named.st_ino, named.st_dev):
        raise UnusableInput("{}: the file was replaced while it was opened; try again", path)


def _counts(reader: TestReader) -> tuple[Counts, bytes, int]:
    """Return the committed counts, the last digest of the log and the last revolution."""
    revolutions = reader.committed()
    last = reader.plan.first_revolution - 1
    if revolutions:
        last = int(reader.column("revolution", revolutions - 1)[0])
    cycles = _rows_up_to(reader.cycle_revolutions(), last)
    counts = Counts(
        revolutions=revolutions,
        cycles=cycles,
        samples=reader.first_free_sample(cycles),
        **_unfinished(reader),
        prediction=rows_up_to(reader, last, "prediction"),
        curves=_rows_up_to(reader.curve_revolutions(), last),
        profiles=_rows_up_to(reader.profiles()["revolution"], last),
        events=reader.committed("events"),
        **{
            name: reader.state(name)
            for name in (
                "gaps", "resumed", "cycles_refused", "events_refused", "planned_revolutions",
            )
        },
    )  # fmt: skip
    digest = reader.last_digest() or seed_of(reader.metadata()["identifier"])
    return counts, digest, last


def _unfinished(reader: TestReader) -> dict[str, int]:
    names = ("unfinished", "unfinished_samples")
    return {name: reader.committed(name) if reader.plan.unfinished_samples else 0 for name in names}


def _rows_up_to(revolutions: NDArray[np.int64], last: int) -> int:
    """Return the number of rows without those at the end of revolutions after ``last``.

    A commit may include a cycle or a prediction but not its revolution, which is then measured
    again.
    """
    kept = np.flatnonzero(revolutions <= last)
    return int(kept[-1]) + 1 if kept.size else 0


def _reserve(disk: Disk, plan: FilePlan, places: Places, revolutions: int) -> dict[str, int]:
    """Reserve the planned rows again: a copy of the file may have lost its reserved space."""
    streams = fitted_streams(plan, places)
    wanted = {name: stream.planned for name, stream in streams.items()}
    for name, rows in planned_rows(plan, revolutions).items():
        wanted[name] = max(wanted[name], rows)
    length = sum(wanted[name] * stream.row_bytes for name, stream in streams.items())
    have = FILES.taken_bytes(disk.fd)
    refuse_little_space(
        disk.path.parent, disk.path, max(0, length - have), say("the rest of the test")
    )
    try:
        for name, stream in streams.items():
            reserve_stream(disk, stream, places, 0, wanted[name])
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
            raise
        raise UnusableInput(
            "{}: the disk refused to reserve the room for the rest of the test ({});"
            " free {:.0f} MB",
            disk.path,
            error.strerror,
            max(0, length - have) / 1000000.0,
        ) from error
    return wanted


def _log_resumption(writer: TestWriter, last: int) -> None:
    gap = writer.revolutions > 0
    text = say("the test was resumed after revolution {}", last)
    kind, level = ("gap", "warning") if gap else ("resumed", "information")
    event = Event(time.time(), last, kind, "storage", text, level=level)
    try:
        writer.begin_again(event, gap)
    except BaseException:
        writer.close()
        raise
