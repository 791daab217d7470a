"""The notifier's state on the disk: reported conditions and waiting messages, private to the user.

One notifier at a time owns the state of a rig: it holds the lock beside the file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

import msgspec
from msgspec.structs import replace

from rigapp.config.notify import NotifySection
from rigapp.config.writing import whole_file
from rigapp.notify.outbox import Outbox
from rigapp.notify.rules import NotificationState
from rigapp.process.locks import taken
from rigapp.schema.wire import decode, encode


class WayState(msgspec.Struct, frozen=True):
    """The state of one channel, and its waiting messages."""

    conditions: NotificationState = msgspec.field(default=NotificationState(), name="book")
    outbox: Outbox = Outbox()


class NotifierState(msgspec.Struct, frozen=True):
    """The state of all channels, by ``identity``; the last processed fact and its run."""

    ways: Mapping[str, WayState] = {}
    run: str = ""
    processed: int = msgspec.field(default=0, name="heard")


def state_file(folder: Path, rig: str) -> Path:
    """Return the file of a rig's state; rig: the path of its file."""
    return folder / f"{hashlib.sha256(rig.encode()).hexdigest()[:16]}.messages"


def identity(way: NotifySection) -> str:
    """Return the key of a channel's state: its address, so that messages never go elsewhere."""
    where = "\0".join((way.name, way.url, *way.command))
    return hashlib.sha256(where.encode()).hexdigest()[:16]


def read_state(file: Path) -> NotifierState:
    """Return the state in a file, a new one without it; an unreadable one is set aside."""
    try:
        return decode(file.read_bytes(), NotifierState)
    except FileNotFoundError:
        return NotifierState()
    except (OSError, ValueError):
        with suppress(OSError):
            file.replace(file.with_suffix(".unreadable"))
        return NotifierState()


def write_state(file: Path, state: NotifierState) -> None:
    """Replace the stored state, mode 0600; raise UnusableInput."""
    with whole_file(file, mode=0o600) as part:
        part.write_bytes(encode(state))


def settled(state: NotifierState) -> NotifierState:
    """Return a state without the last status, which is not worth storing."""
    ways = {
        name: replace(way, conditions=replace(way.conditions, status=None))
        for name, way in state.ways.items()
    }
    return replace(state, ways=ways)


@contextmanager
def owned(file: Path) -> Iterator[bool]:
    """Hold the lock of a state inside it; yields False where another notifier has it."""
    with file.with_suffix(".lock").open("ab") as stream:
        yield taken(stream.fileno())
