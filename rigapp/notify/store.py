"""The notifier's state on the disk: what was told and what waits, whole or not at all, for us only.

One notifier at a time looks after the state of a rig: it holds the lock beside the file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

import msgspec

from rigapp.config.notify import NotifySection
from rigapp.config.writing import whole_file
from rigapp.notify.outbox import Outbox
from rigapp.notify.rules import NotificationState
from rigapp.process.locks import taken
from rigapp.schema.wire import decode, encode


class WayState(msgspec.Struct, frozen=True):
    """What one way was told, and what waits for it."""

    book: NotificationState = NotificationState()
    outbox: Outbox = Outbox()


class NotifierState(msgspec.Struct, frozen=True):
    """The state of all ways, by ``identity``; up to which fact of which run it has come."""

    ways: Mapping[str, WayState] = {}
    run: str = ""
    heard: int = 0


def state_file(folder: Path, rig: str) -> Path:
    """Return where the state of a rig is kept; rig: the path of its file."""
    return folder / f"{hashlib.sha256(rig.encode()).hexdigest()[:16]}.messages"


def identity(way: NotifySection) -> str:
    """Return what a way's state goes by: where it leads. What waits never goes elsewhere."""
    where = "\0".join((way.name, way.url, *way.command))
    return hashlib.sha256(where.encode()).hexdigest()[:16]


def read_state(file: Path) -> NotifierState:
    """Return the state in a file, a fresh one without it; one that is unreadable is set aside."""
    try:
        return decode(file.read_bytes(), NotifierState)
    except FileNotFoundError:
        return NotifierState()
    except (OSError, ValueError):
        with suppress(OSError):
            file.replace(file.with_suffix(".unreadable"))
        return NotifierState()


def write_state(file: Path, state: NotifierState) -> None:
    """Put a state in the place of the former one, mode 0600; raise UnusableInput."""
    with whole_file(file, mode=0o600) as part:
        part.write_bytes(encode(state))


def settled(state: NotifierState) -> NotifierState:
    """Return what of a state is worth keeping: the last status of a rig is not."""
    ways = {
        name: msgspec.structs.replace(way, book=msgspec.structs.replace(way.book, status=None))
        for name, way in state.ways.items()
    }
    return msgspec.structs.replace(state, ways=ways)


@contextmanager
def owned(file: Path) -> Iterator[bool]:
    """Hold the lock of a state while this lasts; False where another notifier has it."""
    with file.with_suffix(".lock").open("ab") as stream:
        yield taken(stream.fileno())
