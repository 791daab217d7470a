"""The registry of running engines: one small JSON file each, in a private folder."""

from __future__ import annotations

import hashlib
import logging
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec
import platformdirs

from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_bytes
from rigapp.process.ending import ending_as_interrupt
from rigapp.process.private import SMALL_BYTES, private_folder, read_own
from rigapp.process.stale_files import process_alive, remove_left_behind
from rigapp.schema.messages import PROTOCOL_VERSION
from rigapp.schema.wire import json_bytes
from rigapp.texts import say

log = logging.getLogger(__name__)

LONGEST_SOCKET_FOLDER = 80
"""Characters: the system allows 107 for the path of a socket, its name included."""

LEFT_BEHIND = (
    r"(?:engine-|starting-|twin-|notifier-)?(?P<pid>\d+)"
    r"(?:\.(?:json|part|commands|snapshots)|-[0-9a-f]+)"
)
"""Entries and sockets in the runtime folder, each with the process id of its owner."""


class EngineEntry(msgspec.Struct, frozen=True):
    """The addresses and the rig of a running engine.

    server_key: public CurveZMQ key (Z85) where viewers must show theirs, else empty.
    """

    pid: int
    commands: str
    snapshots: str
    rig: str
    started: float
    server_key: str = ""
    version: int = PROTOCOL_VERSION


def runtime_folder() -> Path:
    """Return the private folder for sockets and entries, made if missing; raise UnusableInput."""
    named = os.environ.get("RIGAPP_RUNTIME_DIR")
    session = os.environ.get("XDG_RUNTIME_DIR")
    if named:
        folder = Path(named)
    elif session and Path(session).is_dir():
        folder = Path(session) / "rigapp"
    else:
        user = os.getuid() if hasattr(os, "getuid") else os.environ.get("USERNAME", "user")
        folder = Path(tempfile.gettempdir()) / f"rigapp-{user}"
    return private_folder(folder, say("; or name another folder with RIGAPP_RUNTIME_DIR"))


def lasting_folder() -> Path:
    """Return the private folder for files that outlive a restart of the computer: keys.

    The folder that RIGAPP_RUNTIME_DIR names, else the user's folder for data; keys that an earlier
    version made in the runtime folder come along. Raises UnusableInput.
    """
    before = runtime_folder()
    if os.environ.get("RIGAPP_RUNTIME_DIR"):
        return before
    folder = private_folder(platformdirs.user_data_path("rigapp"))
    if (before / "keys").is_dir() and not (folder / "keys").exists():
        shutil.move(before / "keys", folder / "keys")
    return folder


def kept_of(rig: Path, what: str) -> Path:
    """Return the file for data of a rig that outlive a restart.

    Where the user's folder for data cannot be used it is in the runtime folder, which a restart of
    the computer may empty: a test starts all the same. Raises UnusableInput.
    """
    name = hashlib.sha256(str(rig.resolve()).encode()).hexdigest()[:16]
    try:
        folder = private_folder(lasting_folder() / what)
    except UnusableInput as error:
        folder = private_folder(runtime_folder() / what)
        log.warning("%s: kept in %s until the computer is started again", error, folder)
    return folder / f"{name}.json"


def local_endpoints(folder: Path, pid: int) -> tuple[str, str]:
    """Return (commands, snapshots) addresses: Unix sockets, or ports of loopback where none can be.

    A folder with too long a name cannot hold a socket.
    """
    if sys.platform == "win32" or len(str(folder)) > LONGEST_SOCKET_FOLDER:
        return "tcp://127.0.0.1:*", "tcp://127.0.0.1:*"
    return f"ipc://{folder}/{pid}.commands", f"ipc://{folder}/{pid}.snapshots"


def read_entry(path: Path) -> EngineEntry:
    """Return the entry in a file, of an engine elsewhere for example; raise UnusableInput."""
    try:
        return msgspec.json.decode(read_bytes(path, SMALL_BYTES), type=EngineEntry)
    except (OSError, ValueError) as error:
        raise UnusableInput("{}: is not the entry of an engine ‹{}›.", path, error) from error


def announce(entry: EngineEntry) -> Path:
    """Write the entry of this engine, which has started now, and return its path.

    Leftovers of dead engines are removed.
    """
    remove_left_behind(runtime_folder(), LEFT_BEHIND)
    path = _write(f"engine-{entry.pid}.json", entry)
    path.with_name(f"starting-{entry.pid}.json").unlink(missing_ok=True)
    return path


def announce_start(rig: Path, pid: int) -> None:
    """Write that a process will be the engine of a rig, long before it listens."""
    _write(f"starting-{pid}.json", EngineEntry(pid, "", "", str(rig.resolve()), time.time()))


@contextmanager
def starting(rig: Path) -> Iterator[None]:
    """Announce this process as the starting engine of a rig, and withdraw it at the end.

    A termination signal interrupts it until another handler is installed.
    """
    with ending_as_interrupt():
        try:
            announce_start(rig, os.getpid())
            yield
        finally:
            withdraw(os.getpid())


def starting_engine(rig: Path) -> int | None:
    """Return the process that will be the engine of a rig, None when there is none."""
    wanted = str(rig.resolve())
    return next((entry.pid for entry in _entries("starting-*.json") if entry.rig == wanted), None)


def _write(name: str, entry: EngineEntry) -> Path:
    path = runtime_folder() / name
    part = path.with_suffix(".part")
    part.write_bytes(json_bytes(entry))
    part.replace(path)
    return path


def withdraw(pid: int) -> None:
    """Remove the entry and sockets of an engine that has ended."""
    folder = runtime_folder()
    entries = (f"engine-{pid}.json", f"starting-{pid}.json")
    for name in (*entries, f"{pid}.commands", f"{pid}.snapshots"):
        (folder / name).unlink(missing_ok=True)


def other_version(engine: int, viewer: int) -> str:
    """Return that an engine and a viewer use different protocols, as a sentence."""
    return say(
        "This engine speaks version {} of the protocol, the viewer version {}; use the"
        " same rigapp on both sides.",
        engine,
        viewer,
    )


def running_engines() -> list[EngineEntry]:
    """Return the engines that are alive, oldest first; entries of dead ones are removed."""
    return _entries("engine-*.json")


def _entries(names: str) -> list[EngineEntry]:
    result = []
    folder = runtime_folder()
    remove_left_behind(folder, LEFT_BEHIND)
    for path in folder.glob(names):
        # A file of another user, or a link to one, must not lead a viewer to another engine.
        text = read_own(path)
        try:
            entry = msgspec.json.decode(text or b"", type=EngineEntry)
        except ValueError:
            continue
        if process_alive(entry.pid):
            result.append(entry)
    return sorted(result, key=lambda entry: entry.started)
