"""Write a test as fast as it goes and say what is safe, until somebody kills the process.

Writers are forks of one process that has loaded everything: a kill hits a real process, and a
hundred of them cost no hundred starts of Python.
"""

from __future__ import annotations

import multiprocessing
import sys
import threading
from collections.abc import Iterator
from multiprocessing.connection import Connection
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from patience import PATIENCE_S
from storage_samples import METADATA, PLAN, write

from rigapp.storage import TestWriter, create_test, reopen_test

LOADED = ["pytest", "rigapp.storage"]
"""What takes its time to load; modules beside this one are not found before the fork."""

READY = -1
"""What a writer says when its file is there; then the revolutions that are safe."""


class Writer:
    """A writer in a process of its own. ends: it ends the test again and again."""

    def __init__(self, path: Path, ends: bool) -> None:
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(LOADED)
        self._heard, said = context.Pipe(duplex=False)
        self.process = context.Process(target=_work, args=(said, path, ends), daemon=True)
        self.process.start()
        said.close()
        assert self._heard.poll(PATIENCE_S), "no word of the writer"
        assert self._heard.recv() == READY

    def kill(self) -> list[int]:
        """Kill it at once; return what it said is safe, to the last whole word."""
        self.process.kill()
        self.process.join(PATIENCE_S)
        assert self.process.exitcode == -9
        self.process.close()
        with self._heard:
            return list(self._words())

    def _words(self) -> Iterator[int]:
        while True:
            try:
                yield self._heard.recv()
            except (EOFError, OSError):
                return


def _work(said: Connection, path: Path, ends: bool) -> None:
    writer = reopen_test(path) if path.exists() else create_test(path, PLAN, METADATA)
    said.send(READY)
    if ends:
        _end_again_and_again(said, path, writer)
    threading.Thread(target=_commit_often, args=(said, writer), daemon=True).start()
    pause = threading.Event()
    for revolution in range(writer.revolutions + 1, 1500):
        write(writer, revolution, revolution)
        pause.wait(0.0002)
    pause.wait(60.0)


def _commit_often(said: Connection, writer: TestWriter) -> None:
    """Commit and announce, again and again."""
    announced = -1
    while True:
        safe = writer.commit()
        if safe != announced:
            said.send(safe)
            announced = safe


def _end_again_and_again(said: Connection, path: Path, writer: TestWriter) -> None:
    """End the test, which gives its spare room back, and take it up again, until it is full."""
    while True:
        rows = writer.revolutions
        write(writer, rows + 1, min(rows + 3, PLAN.revolutions))
        writer.finish("stopped", "operator", "enough")
        said.send(writer.revolutions)
        writer.close()
        writer = reopen_test(path)
