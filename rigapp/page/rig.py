"""Observe one engine: attach, reattach after a loss, send no request."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from rigapp.config.loading import read_rig
from rigapp.schema.messages import Reply, Snapshot
from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.launch import find_engine
from rigapp.service.registry import EngineEntry, read_entry, running_engines
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.news import News
from rigapp.viewer.recording import load_history
from rigapp.viewer.showntest import ShownTest
from rigapp.viewer.tasks import TaskWorker

DISK_EVERY_S = 10.0
"""A disk fills in hours; while a query hangs no second one is made."""

KEPT_ROWS = 1 << 10
"""Newest rows held unreduced: a page draws 150 buckets of a test, and its newest values."""

Find = Callable[[], EngineEntry]
"""Return the entry of the running engine; raise EngineUnreachable or UnusableInput."""


@dataclass(frozen=True, slots=True)
class DiskSpace:
    """The disk of a test's file, bytes."""

    free: int
    total: int


class Observer:
    """Receive an engine's snapshots; every request is refused locally."""

    operator = ""

    def __init__(self, entry: EngineEntry) -> None:
        """Attach; raise EngineUnreachable for another version, UnusableInput without a key."""
        self._client = Client(entry)

    def poll(self) -> Snapshot | None:
        """Return what is new since the last poll, or None; never waits."""
        return self._client.poll()

    def request(
        self, verb: str, arguments: dict[str, Any] | None = None, timeout_s: float = 0.0
    ) -> Reply:
        """Refuse: nothing is sent to the engine."""
        return Reply(ok=False, sentence=f"The page only looks on: {verb} is not asked for.")

    def close(self) -> None:
        """Detach; the engine continues."""
        self._client.close()


def engine_named(path: Path) -> tuple[str, Find]:
    """Return the name and the finder of the engine of a rig file, or of an entry file (.json).

    Raises UnusableInput when the file cannot be read.
    """
    if path.suffix == ".json":
        entry = read_entry(path)
        return Path(entry.rig).stem, partial(read_entry, path)
    return read_rig(path).record.name, partial(_running, path)


def engines_here() -> dict[str, tuple[str, Find]]:
    """Return by rig file the name and the finder of every engine that runs on this computer.

    ``RIGAPP_ENGINE`` names one that runs elsewhere.
    """
    elsewhere = os.environ.get("RIGAPP_ENGINE")
    entries = [read_entry(Path(elsewhere))] if elsewhere else running_engines()
    rigs = {entry.rig: Path(entry.rig) for entry in entries}
    return {key: (rig.stem, partial(_running, rig)) for key, rig in rigs.items()}


def _running(rig: Path) -> EngineEntry:
    entry = find_engine(rig)
    if entry is None:
        raise EngineUnreachable(f"no engine runs for {rig.name}")
    return entry


class WatchedRig:
    """The connection to one engine and its newest state; one thread calls every method."""

    def __init__(self, identity: str, name: str, find: Find) -> None:
        """Begin to search the engine; identity: of its place on the page, name: until found."""
        self.identity = identity
        self._name = name
        self._find = find
        self._connection = EngineConnection(self._attach)
        history = partial(load_history, kept=KEPT_ROWS)
        self._shown = ShownTest(history, kept=KEPT_ROWS)
        self._disk_worker = TaskWorker("page-disk", bound=1)
        self._disk_at = 0.0
        self._engine_pid = 0
        self._local = False
        self.disk: DiskSpace | None = None
        self.restarts = 0
        self.restarted_at = 0.0

    def pump(self) -> bool:
        """Process new messages; return whether another test is shown than before."""
        snapshot = self._connection.pump()
        changed = snapshot is not None and self._shown.take(snapshot)
        if snapshot is not None:
            self._look_for_restart(snapshot.status.engine.pid)
        self._shown.deliver()
        self._shown.follow_log()
        self._look_at_disk()
        return changed

    @property
    def name(self) -> str:
        """Return the engine's name of the rig, else the name known before."""
        status = self._connection.status
        return (status.rig.name if status is not None else "") or self._name

    @property
    def line(self) -> tuple[str, str]:
        """Return the state of the connection, and why, in words."""
        return self._connection.state.value, self._connection.reason

    @property
    def problem(self) -> str:
        """Return what prevents reading the test's file, empty where nothing does."""
        return self._shown.problem or self._shown.log_problem

    @property
    def local_pid(self) -> int:
        """Return the process of an engine of this computer, 0 for one elsewhere."""
        return self._engine_pid if self._local else 0

    def news(self) -> News:
        """Return the newest of everything."""
        connection, shown = self._connection, self._shown
        return News(
            status=connection.status,
            data=shown.data,
            recipe=shown.recipe,
            path=shown.path,
            events=shown.events,
            log_problem=shown.log_problem,
            silence_s=connection.silence_s(),
            data_age_s=connection.data_age_s(),
            trip=shown.trip,
        )

    def close(self) -> None:
        """Detach from the engine, which continues."""
        self._connection.close()
        self._shown.close()
        self._disk_worker.close()

    def _attach(self) -> Observer:
        entry = self._find()
        self._local = any(engine.pid == entry.pid for engine in running_engines())
        return Observer(entry)

    def _look_for_restart(self, pid: int) -> None:
        if self._engine_pid not in (0, pid):
            self.restarts += 1
            self.restarted_at = time.time()
        self._engine_pid = pid

    def _look_at_disk(self) -> None:
        self._disk_worker.deliver()
        path, now = self._shown.path, time.monotonic()
        if path is None or not self._local or now - self._disk_at < DISK_EVERY_S:
            return
        if self._disk_worker.submit(
            lambda: shutil.disk_usage(path.parent), self._disk_known, lambda _: self._no_disk()
        ):
            self._disk_at = now

    def _disk_known(self, usage: Any) -> None:
        self.disk = DiskSpace(usage.free, usage.total)

    def _no_disk(self) -> None:
        self.disk = None
