"""Replace the file of an ended test by a trimmed, compressed one, without risk to the data.

The copy is written under a hidden name, closed, synced, read back and compared before it takes the
file's name. If the process is killed, the original stays in place. As a program
(``python -m rigapp.storage FILE``) it runs in the background at the lowest priority.
"""

from __future__ import annotations

import contextlib
import os
import sys
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.process.children import Child
from rigapp.process.priority import lower_priority
from rigapp.schema.wire import json_bytes
from rigapp.storage.filesystem.calls import BINARY, StorageFailed
from rigapp.storage.filesystem.folder import (
    hidden_name,
    refuse_little_space,
    remove_stale,
    short_reason,
)
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.reading.reader import TestReader, open_test
from rigapp.storage.reading.seal import Seal, beside, make_seal, write_beside
from rigapp.storage.reading.verify import find_damage
from rigapp.storage.structure.digest import SEAL
from rigapp.storage.structure.layout import streams_of
from rigapp.storage.upkeep.duplicate import first_difference, open_copy, write_duplicate
from rigapp.storage.upkeep.resume import close_exclusive, open_exclusively
from rigapp.texts import say


def compact_test(path: str | os.PathLike[str]) -> bool:
    """Replace an ended test's file by its verified compressed form; False when it already is.

    Raises UnusableInput when the test has not ended, another process has the file, or the disk has
    no space for the copy; StorageFailed when a checksum finds damage, or the copy differs when read
    back. The original then stays.
    """
    target = Path(path).absolute()
    with open_test(target) as reader:
        _refuse_unended(reader)
        if reader.compressed:
            return False
    fd = open_exclusively(target)
    with contextlib.ExitStack() as undo:
        undo.callback(close_exclusive, fd)
        with open_test(target) as reader:
            _refuse_unended(reader)
            if reader.compressed:
                return False
            copy, seal = _verified_copy(reader)
        undo.callback(lambda: copy.unlink(missing_ok=True))
        copy.chmod(0o444)
        FILES.exchange(fd, copy, target)
        with contextlib.suppress(OSError):  # the seal is in the file as well
            write_beside(target, seal)
        FILES.sync_folder(target.parent)
    return True


def seal_test(path: str | os.PathLike[str]) -> bool:
    """Write the seal of a stopped test beside its file; False where the test is resumed.

    The file is not locked meanwhile: the test can be resumed at once. Raises UnusableInput for a
    test that has not ended, OSError.
    """
    target = Path(path).absolute()
    with open_test(target) as reader:
        _refuse_unended(reader)
        seal = make_seal(reader)
    if not _ended(target):
        return False
    write_beside(target, seal)
    if not _ended(target):  # resumed meanwhile: the seal is out of date
        beside(target).unlink(missing_ok=True)
        return False
    return True


def _ended(path: Path) -> bool:
    with open_test(path) as reader:
        return reader.stored_status() != "running"


def trimmed_copy(path: str | os.PathLike[str], to: Path) -> None:
    """Write a trimmed, compressed copy of a test, which must not be running, to a new file.

    Raises UnusableInput where the test runs or its file is damaged.
    """
    with open_test(Path(path)) as reader:
        if reader.summary()["status"] == "running":
            raise UnusableInput("{}: the test is running; wait for its end", reader.path)
        if damage := next(find_damage(reader), ""):
            raise UnusableInput(
                "{}: the file is damaged ‹{}›; recover the intact data: rigapp salvage FILE --to"
                " NEW.h5",
                reader.path,
                damage,
            )
        write_duplicate(reader.path, to, sizes_of(reader), processors=os.cpu_count() or 1)


def settle_in_background(path: str | os.PathLike[str]) -> Child:
    """Compress and seal an ended test in a separate process at the lowest priority.

    A stopped test is only sealed, since it can be resumed.
    """
    return Child("rigapp.storage", os.fspath(path))


def sizes_of(reader: TestReader) -> dict[str, int]:
    """Return the rows that each dataset of a stream keeps, by path."""
    sizes: dict[str, int] = {}
    for name, stream in streams_of(reader.plan).items():
        rows = reader.committed(name)
        sizes.update({stream.path(field.name): rows for field in stream.stored})
        sizes[stream.path(stream.dimension)] = rows
    return sizes


def _refuse_unended(reader: TestReader) -> None:
    status = reader.summary()["status"]
    if status in ("running", "interrupted"):
        raise UnusableInput(
            "{}: the test is {}; only a test that has ended is compressed", reader.path, status
        )


def _verified_copy(reader: TestReader) -> tuple[Path, Seal]:
    """Write the compressed, sealed copy under a hidden name; return it once it is verified."""
    target = reader.path
    hidden = hidden_name(target, "packed")
    sizes = sizes_of(reader)
    # The new checksums of the copy would hide damage permanently.
    if damage := next(find_damage(reader), ""):
        raise StorageFailed(
            "{}: the file is damaged and is not changed ‹{}›; recover the intact data:"
            " rigapp salvage FILE --to NEW.h5",
            target,
            damage,
        )
    needed = sum(
        reader.committed(name) * stream.row_bytes
        for name, stream in streams_of(reader.plan).items()
    )
    refuse_little_space(target.parent, target, needed, say("the compressed copy"))
    remove_stale(target.parent)
    with contextlib.ExitStack() as undo:
        undo.callback(lambda: hidden.unlink(missing_ok=True))
        try:
            write_duplicate(target, hidden, sizes)
            _sync_file(hidden)
        except (OSError, RuntimeError) as error:
            raise StorageFailed(
                "{}: the compressed copy could not be written ({}); the original is"
                " untouched, free some space",
                target,
                short_reason(error),
            ) from error
        difference = first_difference(target, hidden, sizes)
        if difference:
            raise StorageFailed(
                "{}: the compressed copy differs at {} and was thrown away; the"
                " original is untouched, check the disk",
                target,
                difference,
            )
        seal = make_seal(reader)
        try:
            _put_seal(hidden, seal)
            _sync_file(hidden)
        except (OSError, RuntimeError) as error:
            raise StorageFailed(
                "{}: the seal could not be written ({}); the original is untouched, free some"
                " space",
                target,
                short_reason(error),
            ) from error
        undo.pop_all()
    return hidden, seal


def _put_seal(copy: Path, seal: Seal) -> None:
    with open_copy(copy) as file:
        group = file.create_group(SEAL)
        group.attrs["NX_class"] = "NXcollection"
        group["seal"] = json_bytes(seal).decode()


def _sync_file(path: Path) -> None:
    fd = os.open(path, os.O_RDWR | BINARY)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)


def main() -> int:
    """Compress or seal the file named on the command line; return 0 done, 2 refused, 1 failed."""
    lower_priority(19)
    path = sys.argv[1]
    try:
        with open_test(path) as reader:
            complete = reader.stored_status() == "complete"
        (compact_test if complete else seal_test)(path)
    except UnusableInput as error:
        print(error, file=sys.stderr)
        return 2
    except (StorageFailed, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0
