"""What may be put into a rig's queue: tests that can be read, and that the rig can do."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rigapp.checks.fit import check_fit
from rigapp.config.loading import read_test
from rigapp.config.rig import RigFile
from rigapp.queue.items import Queue, added
from rigapp.queue.store import QueueStore


def add_tests(store: QueueStore, rig: RigFile, tests: Sequence[Path], folder: Path) -> Queue:
    """Put tests at the end of a queue, and return it; raise UnusableInput, none is added then."""
    for path in tests:
        check_fit(rig, read_test(path))
    paths = [str(path.resolve()) for path in tests]
    return store.change(lambda queue: added(queue, paths, str(folder.resolve())))
