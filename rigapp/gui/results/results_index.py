"""Index of the tests of a folder, read in a separate process so that the window does not wait."""

from __future__ import annotations

import logging
import os
import queue
import threading
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from pathlib import Path

from rigapp.presentation.translation import tr
from rigapp.process.children import Child, read_frames
from rigapp.schema.results import TestResult
from rigapp.schema.wire import decode
from rigapp.viewer.tasks import TaskWorker

log = logging.getLogger(__name__)

WAITING = 64
"""Maximum number of results waiting to be shown; the reading process then pauses."""
TAKEN = 32
"""Number of results taken at once: inserting them into a table takes a few milliseconds."""
POLL_S = 0.2
"""Period in which a full queue checks whether its results are still wanted."""

Stamp = tuple[float, int]
Done = Callable[[TestResult], None]


class ResultReader:
    """Read the results of paths in order; they are queued until taken."""

    def __init__(self, paths: Sequence[Path], *, closely: bool = False) -> None:
        options = ["--closely"] if closely else []
        self._process = Child("rigapp.report.results", *options, pipes=True)
        self._results: queue.Queue[TestResult] = queue.Queue(WAITING)
        self._closed = threading.Event()
        self.problem = ""
        self._thread = threading.Thread(
            target=self._read, args=(list(paths),), name="gui-results", daemon=True
        )
        self._thread.start()

    @property
    def done(self) -> bool:
        """Return whether all results were taken, or no more will follow."""
        return not self._thread.is_alive() and self._results.empty()

    def take(self) -> list[TestResult]:
        """Return the available results, at most ``TAKEN``."""
        results: list[TestResult] = []
        while len(results) < TAKEN and not self._results.empty():
            results.append(self._results.get_nowait())
        return results

    def close(self) -> None:
        """End the process and its thread; queued results are dropped."""
        self._closed.set()
        self._process.kill()
        self._thread.join(timeout=2.0)

    def _read(self, paths: list[Path]) -> None:
        process = self._process
        try:
            with suppress(OSError), process.stdin as stdin:
                stdin.write(b"\n".join(os.fsencode(path) for path in paths))
            for frame in read_frames(process.stdout):
                self._put(decode(frame, TestResult))
            self.problem = process.last_words()
        except (OSError, ValueError) as error:
            if not self._closed.is_set():
                log.warning("Results of %d tests are not read: %s", len(paths), error)
        process.close()

    def _put(self, result: TestResult) -> None:
        while not self._closed.is_set():
            try:
                self._results.put(result, timeout=POLL_S)
            except queue.Full:
                continue
            return


class ResultsIndex:
    """The tests of a folder, newest first; a file is read again only when it has changed.

    ``version`` increases with every change. Widgets that show the tests call ``pump`` regularly.
    """

    def __init__(self, folder: Path, worker: TaskWorker) -> None:
        self.folder = folder
        self.problem = ""
        self.version = 0
        self._worker = worker
        self._looking = False
        self._stamps: dict[str, Stamp] = {}
        self._known: dict[str, TestResult] = {}
        self._read: dict[str, Stamp] = {}
        self._reader: ResultReader | None = None
        self._received = 0
        self._documents: list[tuple[ResultReader, Done]] = []

    @property
    def paths(self) -> list[str]:
        """Return the files of the folder, newest first."""
        return list(self._stamps)

    @property
    def reading(self) -> bool:
        """Return whether more results are pending."""
        return self._looking or self._reader is not None or bool(self._documents)

    def result(self, path: str) -> TestResult | None:
        """Return the result of a file, None before it was read."""
        return self._known.get(path)

    @property
    def unread(self) -> list[str]:
        """Return the files that are unread or have changed since, newest first."""
        return [path for path, stamp in self._stamps.items() if self._read.get(path) != stamp]

    def modified(self, path: str) -> float:
        """Return the time of a file's last change."""
        return self._stamps[path][0]

    def look(self) -> None:
        """List the folder on the worker, then read new and changed files."""
        if not self._looking:
            self._looking = self._worker.submit(
                lambda: _stamps(self.folder), self._listed, self._failed
            )

    def ask(self, path: Path, done: Done) -> None:
        """Read one file immediately with its force uncertainty; ``pump`` delivers the result."""
        self._documents.append((ResultReader([path], closely=True), done))

    def pump(self) -> None:
        """Collect the results that have been read."""
        for reader, done in list(self._documents):
            for result in reader.take():
                done(result)
            if reader.done:
                self._documents.remove((reader, done))
        if self._reader is None:
            return
        results = self._reader.take()
        for result in results:
            self._known[result.path] = result
            self._read[result.path] = self._stamps.get(result.path, (0.0, 0))
        self._received += len(results)
        self.version += bool(results)
        if self._reader.done:
            why, self._reader = self._reader.problem, None
            self._read_on(why)

    def close(self) -> None:
        """End all reading."""
        for reader in (self._reader, *(pair[0] for pair in self._documents)):
            if reader is not None:
                reader.close()
        self._reader, self._documents = None, []

    def _listed(self, stamps: dict[str, Stamp]) -> None:
        self._looking = False
        self.problem = ""
        if stamps != self._stamps:
            self._stamps = stamps
            self.version += 1
        if self._reader is None:
            self._received = 1
            self._read_on()

    def _read_on(self, why: str = "") -> None:
        """Read the unread files, unless the last reader returned nothing."""
        left = self.unread
        if left and self._received:
            self._reader, self._received = ResultReader([Path(path) for path in left]), 0
        elif left:
            self.problem = tr("{} tests in {} cannot be read: {}", len(left), self.folder, why)
            self.version += 1

    def _failed(self, error: Exception) -> None:
        self._looking = False
        self.problem = tr("{} cannot be read: {}", self.folder, error)
        self.version += 1


def _stamps(folder: Path) -> dict[str, Stamp]:
    tests = [(entry.stat(), entry.path) for entry in _tests(folder)]
    newest = sorted(tests, key=lambda test: test[0].st_mtime, reverse=True)
    return {path: (about.st_mtime, about.st_size) for about, path in newest}


def _tests(folder: Path) -> Iterable[os.DirEntry[str]]:
    with os.scandir(folder) as entries:
        yield from (entry for entry in entries if entry.name.endswith(".h5") and entry.is_file())
