"""Find a running engine of a rig, or start one that outlives its window.

``RIGAPP_ENGINE`` names the entry file of an engine elsewhere, copied from its runtime folder; it
has priority over all engines of this computer.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rigapp.process.children import Child
from rigapp.process.locks import taken
from rigapp.process.stale_files import process_alive
from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.registry import (
    EngineEntry,
    announce_start,
    read_entry,
    running_engines,
    runtime_folder,
    starting_engine,
)
from rigapp.texts import say

START_S = 180.0  # imports and compilation on a busy computer with a slow disk
HELLO_S = 10.0  # far longer than the answer of a running engine
POLL_S = 0.05  # not noticeable


def find_engine(rig: Path) -> EngineEntry | None:
    """Return the newest running engine of this rig, None without one.

    With ``RIGAPP_ENGINE`` the engine that it names; raises UnusableInput for an invalid entry.
    """
    elsewhere = os.environ.get("RIGAPP_ENGINE")
    if elsewhere:
        return read_entry(Path(elsewhere))
    wanted = str(rig.resolve())
    result = [entry for entry in running_engines() if entry.rig == wanted]
    return result[-1] if result else None


def attach(rig: Path, operator: str = "") -> Client:
    """Return a client of the rig's engine, starting one when none runs and none is starting.

    Raises EngineUnreachable, with the last lines of the engine's log, when it fails to start, does
    not answer, or has another version of the protocol.
    """
    client = Client(_engine_of(rig), operator)
    try:
        client.hello(HELLO_S)
    except EngineUnreachable:
        client.close()
        raise
    return client


def _engine_of(rig: Path) -> EngineEntry:
    """Return the rig's engine; wait for one that is starting, start one when there is none."""
    log: Path | None = None
    with _one_at_a_time():
        entry = find_engine(rig)
        if entry is not None:
            return entry
        pid = starting_engine(rig)
        if pid is None:
            pid, log = _start(rig)
    deadline = time.monotonic() + START_S
    while time.monotonic() < deadline:
        entry = find_engine(rig)
        if entry is not None:
            return entry
        if not process_alive(pid):
            raise EngineUnreachable("The engine for {} ended at once: {}", rig, _last_words(log))
        time.sleep(POLL_S)
    raise EngineUnreachable(
        "The engine for {} is still starting after {:g} s ‹process {}›; wait for it{}.",
        rig,
        START_S,
        pid,
        say(", or see {}", log) if log is not None else "",
    )


def _start(rig: Path) -> tuple[int, Path]:
    """Start an engine and announce it under the lock; return its process id and log."""
    log = runtime_folder() / f"engine-{time.strftime('%Y%m%d-%H%M%S')}.log"
    engine = Child("rigapp", "engine", rig, log=log)
    engine.leave()
    announce_start(rig, engine.pid)
    return engine.pid, log


def _last_words(log: Path | None) -> str:
    if log is None:
        return say("it was started by another program")
    words = log.read_text(errors="replace").strip().splitlines()
    return words[-1] if words else say("no message")


@contextmanager
def _one_at_a_time() -> Iterator[None]:
    """Lock search and start of an engine against other processes; raises EngineUnreachable."""
    path = runtime_folder() / "launch.lock"
    deadline = time.monotonic() + HELLO_S
    with path.open("wb") as file:
        while not taken(file.fileno()):
            if time.monotonic() > deadline:
                raise EngineUnreachable(
                    "{}: another window has been starting an engine for {:g} s; try again.",
                    path,
                    HELLO_S,
                )
            time.sleep(POLL_S)
        yield
