"""What the engine's side tells the notifier of the rig, and what is said about the deliveries.

No record here holds a secret: the engine and the notifier never know one.
"""

from __future__ import annotations

import msgspec

from rigapp.config.notify import NotifySection, PingSection
from rigapp.schema.messages import Status
from rigapp.schema.notices import AlarmChanged, Finished, StateChanged


class Heartbeat(msgspec.Struct, frozen=True, tag_field="event", tag="sign"):
    """The engine lives, and this is its status."""

    status: Status


class Farewell(msgspec.Struct, frozen=True, tag_field="event", tag="farewell"):
    """The engine ends as it should."""


class DiskSeen(msgspec.Struct, frozen=True, tag_field="event", tag="disk"):
    """So much is free where the test's file is."""

    folder: str
    free_bytes: int


class Silence(msgspec.Struct, frozen=True, tag_field="event", tag="silence"):
    """The engine has sent no heartbeat. gone: its process is there no more."""

    silent_s: float
    gone: bool


Observation = StateChanged | AlarmChanged | Finished | Heartbeat | Farewell | DiskSeen | Silence


class Fact(msgspec.Struct, frozen=True):
    """Something that was seen, and when (UTC s); number: counted within a run of the engine."""

    at: float
    seen: Observation
    number: int = 0


class NotifierSetup(msgspec.Struct, frozen=True):
    """Tell the notifier its ways, where its state is kept, and which run of an engine this is.

    rig: the path of its file, name: as its messages call it.
    """

    rig: str
    ways: tuple[NotifySection, ...]
    ping: PingSection | None
    folder: str
    secrets: str
    run: str
    name: str


class NotifierAnswer(msgspec.Struct, frozen=True):
    """Say how far facts are heard, and what the log should say of deliveries.

    wrong: why somebody may not be told, empty while all is well; None when that has not changed.
    """

    heard: int = 0
    said: tuple[str, ...] = ()
    wrong: str | None = None
