"""Find a running engine of a rig, or start one that outlives its window.

``RIGAPP_ENGINE`` names the entry file of an engine elsewhere, copied from its runtime folder; it
comes before every engine of this computer.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.registry import EngineEntry, read_entry, running_engines, runtime_folder

START_S = 60.0
HELLO_S = 10.0


def find_engine(rig: Path) -> EngineEntry | None:
    """Return the newest running engine that holds this rig, None when there is none.

    With ``RIGAPP_ENGINE`` the engine that it names; raises UnusableInput when that is no entry.
    """
    elsewhere = os.environ.get("RIGAPP_ENGINE")
    if elsewhere:
        return read_entry(Path(elsewhere))
    wanted = str(rig.resolve())
    found = [entry for entry in running_engines() if entry.rig == wanted]
    return found[-1] if found else None


def attach(rig: Path, operator: str = "") -> Client:
    """Return a client of the rig's engine, starting one when none runs.

    Raises EngineUnreachable with the engine's own last words when it does not come up, when it
    does not answer, or when it speaks another version of the protocol.
    """
    client = Client(find_engine(rig) or _start(rig), operator)
    try:
        client.hello(HELLO_S)
    except EngineUnreachable:
        client.close()
        raise
    return client


def _start(rig: Path) -> EngineEntry:
    log = runtime_folder() / f"engine-{time.strftime('%Y%m%d-%H%M%S')}.log"
    with log.open("wb") as stream:
        process = subprocess.Popen(
            [sys.executable, "-m", "rigapp", "engine", str(rig)],
            stdin=subprocess.DEVNULL,
            stdout=stream,
            stderr=stream,
            start_new_session=True,
        )
    deadline = time.monotonic() + START_S
    while time.monotonic() < deadline:
        entry = find_engine(rig)
        if entry is not None:
            return entry
        if process.poll() is not None:
            words = log.read_text(errors="replace").strip().splitlines()
            raise EngineUnreachable(
                f"The engine for {rig} ended at once: {words[-1] if words else 'no message'}"
            )
        time.sleep(0.05)
    raise EngineUnreachable(
        f"The engine for {rig} did not come up within {START_S:g} s; see {log}."
    )
