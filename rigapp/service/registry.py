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
"""Maximum length of the folder: systems allow 107 characters for the complete socket path."""

LEFT_BEHIND = (
    r"(?:engine-|starting-|twin-|notifier-)?(?P<pid>\d+)"
    r"(?:\.(?:json|part|commands|snapshots)|-[0-9a-f]+)"
)
"""Names of entries and sockets in the runtime folder, each with its owner's process id."""


class EngineEntry(msgspec.Struct, frozen=True):
    """The addresses and the rig of a running engine.

    server_key: public CurveZMQ key (Z85) where viewers must authenticate, else empty.
    """

    pid: int
    commands: str
    snapshots: str
    rig: str
    started: float
    server_key: str = ""
    version: int = PROTOCOL_VERSION


def runtime_folder() -> Path:
    """Return the private folder for sockets and entries, created if missing.

    Raises UnusableInput.
    """
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

    The folder in RIGAPP_RUNTIME_DIR, else the user's data folder; keys made by an earlier version
    in the runtime folder are moved to it. Raises UnusableInput.
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

    Without a usable data folder of the user it is in the runtime folder, which a restart of the
    computer may empty, so that a test can start. Raises UnusableInput.
    """
    name = hashlib.sha256(str(rig.resolve()).encode()).hexdigest()[:16]
    try:
        folder = private_folder(lasting_folder() / what)
    except UnusableInput as error:
        folder = private_folder(runtime_folder() / what)
        log.warning("%s: kept in %s until the computer is started again", error, folder)
    return folder / f"{name}.json"


def local_endpoints(folder: Path, pid: int) -> tuple[str, str]:
    """Return (commands, snapshots) addresses: Unix sockets, else loopback ports.

    A folder with too long a path cannot contain a socket.
    """
    if sys.platform == "win32" or len(str(folder)) > LONGEST_SOCKET_FOLDER:
        return "tcp://127.0.0.1:*", "tcp://127.0.0.1:*"
    return f"ipc://{folder}/{pid}.commands", f"ipc://{folder}/{pid}.snapshots"


def read_entry(path: Path) -> EngineEntry:
    """Return the entry in a file, for example of an engine elsewhere; raises UnusableInput."""
    try:
        return msgspec.json.decode(read_bytes(path, SMALL_BYTES), type=EngineEntry)
    except (OSError, ValueError) as error:
        raise UnusableInput("{}: is not the entry of an engine ‹{}›.", path, error) from error


def announce(entry: EngineEntry) -> Path:
    """Write the entry of this newly started engine and return its path.

    Files left by ended engines are removed.
    """
    remove_left_behind(runtime_folder(), LEFT_BEHIND)
    path = _write(f"engine-{entry.pid}.json", entry)
    path.with_name(f"starting-{entry.pid}.json").unlink(missing_ok=True)
    return path


def announce_start(rig: Path, pid: int) -> None:
    """Record that a process will be the engine of a rig, before it listens."""
    _write(f"starting-{pid}.json", EngineEntry(pid, "", "", str(rig.resolve()), time.time()))


@contextmanager
def starting(rig: Path) -> Iterator[None]:
    """Announce this process as the starting engine of a rig, and withdraw the entry on exit.

    A termination signal interrupts the block until another handler is installed.
    """
    with ending_as_interrupt():
        try:
            announce_start(rig, os.getpid())
            yield
        finally:
            withdraw(os.getpid())


def starting_engine(rig: Path) -> int | None:
    """Return the process id of the starting engine of a rig, None without one."""
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
    """Return a sentence about different protocol versions of engine and viewer."""
    return say(
        "This engine speaks version {} of the protocol, the viewer version {}; use the"
        " same rigapp on both sides.",
        engine,
        viewer,
    )


def running_engines() -> list[EngineEntry]:
    """Return the running engines, oldest first; entries of ended ones are removed."""
    return _entries("engine-*.json")


def _entries(names: str) -> list[EngineEntry]:
    result = []
    folder = runtime_folder()
    remove_left_behind(folder, LEFT_BEHIND)
    for path in folder.glob(names):
        # A file of another user, or a link, must not direct a viewer to another engine.
        text = read_own(path)
        try:
            entry = msgspec.json.decode(text or b"", type=EngineEntry)
        except ValueError:
            continue
        if process_alive(entry.pid):
            result.append(entry)
    return sorted(result, key=lambda entry: entry.started)
