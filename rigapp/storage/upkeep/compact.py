"""Turn the file of an ended test into a trimmed, compressed one, without ever risking the data.

The copy is written under a hidden name, closed, synced, read back and compared; only then it takes
the file's name. Whatever kills this on the way leaves the original in place. As a program
(``python -m rigapp.storage FILE``) it runs beside everything else at the lowest priority.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.process.children import start_module
from rigapp.process.priority import give_way
from rigapp.storage.filesystem.calls import BINARY
from rigapp.storage.filesystem.errors import StorageFailed
from rigapp.storage.filesystem.folder import (
    hidden_name,
    refuse_little_space,
    remove_stale,
    short_reason,
)
from rigapp.storage.filesystem.system import FILES
from rigapp.storage.reading.reader import TestReader, open_test
from rigapp.storage.structure.layout import streams_of
from rigapp.storage.upkeep.duplicate import first_difference, write_duplicate
from rigapp.storage.upkeep.resume import let_go, open_exclusively


def compact_test(path: str | os.PathLike[str]) -> bool:
    """Replace an ended test's file by its verified compressed form; False when it already is.

    Raises UnusableInput when the test has not ended, another process has the file, or the disk has
    no room for the copy; StorageFailed when the copy does not read back the same. The original
    stays then.
    """
    target = Path(path).absolute()
    with open_test(target) as reader:
        _refuse_unended(reader)
        if reader.compressed:
            return False
    fd = open_exclusively(target)
    with contextlib.ExitStack() as undo:
        undo.callback(let_go, fd)
        with open_test(target) as reader:
            _refuse_unended(reader)
            if reader.compressed:
                return False
            copy = _verified_copy(reader)
        undo.callback(lambda: copy.unlink(missing_ok=True))
        copy.chmod(0o444)
        FILES.exchange(fd, copy, target)
        FILES.sync_folder(target.parent)
    return True


def compact_in_background(path: str | os.PathLike[str]) -> subprocess.Popen[bytes]:
    """Start ``compact_test`` in a process of its own, at the lowest priority; return it."""
    return start_module("rigapp.storage", os.fspath(path))


def sizes_of(reader: TestReader) -> dict[str, int]:
    """Return the rows that each dataset of a stream keeps, by path."""
    sizes: dict[str, int] = {}
    for name, stream in streams_of(reader.plan).items():
        rows = reader.committed(name)
        sizes.update({stream.path(one.name): rows for one in stream.fields})
        sizes[stream.path(stream.dimension)] = rows
    return sizes


def _refuse_unended(reader: TestReader) -> None:
    status = reader.summary()["status"]
    if status in ("running", "interrupted"):
        raise UnusableInput(
            f"{reader.path}: the test is {status}; only a test that has ended is compressed"
        )


def _verified_copy(reader: TestReader) -> Path:
    """Write the compressed copy under a hidden name; return it when it reads back the same."""
    target = reader.path
    hidden = hidden_name(target, "packed")
    sizes = sizes_of(reader)
    needed = sum(
        reader.committed(name) * stream.row_bytes
        for name, stream in streams_of(reader.plan).items()
    )
    refuse_little_space(target.parent, target, needed, "the compressed copy")
    remove_stale(target.parent)
    with contextlib.ExitStack() as undo:
        undo.callback(lambda: hidden.unlink(missing_ok=True))
        try:
            write_duplicate(target, hidden, sizes)
            _sync_file(hidden)
        except (OSError, RuntimeError) as error:
            raise StorageFailed(
                f"{target}: the compressed copy could not be written ({short_reason(error)}); "
                "the original is untouched, free some space"
            ) from error
        difference = first_difference(target, hidden, sizes)
        if difference:
            raise StorageFailed(
                f"{target}: the compressed copy differs at {difference} and was thrown away; "
                "the original is untouched, check the disk"
            )
        undo.pop_all()
    return hidden


def _sync_file(path: Path) -> None:
    fd = os.open(path, os.O_RDWR | BINARY)
    try:
        os.fsync(fd)
    finally:
        os.close(fd)


def main() -> int:
    """Compress the file named on the command line; exit status 0 done, 2 refused, 1 failed."""
    give_way(19)
    try:
        compact_test(sys.argv[1])
    except UnusableInput as error:
        print(error, file=sys.stderr)
        return 2
    except (StorageFailed, OSError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0
