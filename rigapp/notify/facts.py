"""The messages between engine and notifier: facts of the rig, and remarks on deliveries.

No record here holds a secret: the engine and the notifier never have one.
"""

from __future__ import annotations

import msgspec

from rigapp.config.notify import NotifySection, PingSection
from rigapp.schema.messages import Status
from rigapp.schema.notices import AlarmChanged, Finished, StateChanged


class Heartbeat(msgspec.Struct, frozen=True, tag_field="event", tag="sign"):
    """The engine runs, with this status."""

    status: Status


class Farewell(msgspec.Struct, frozen=True, tag_field="event", tag="farewell"):
    """The engine ends in order."""


class DiskSeen(msgspec.Struct, frozen=True, tag_field="event", tag="disk"):
    """The free disk space for the test's file."""

    folder: str
    free_bytes: int


class Silence(msgspec.Struct, frozen=True, tag_field="event", tag="silence"):
    """The engine has sent no heartbeat. gone: its process has ended."""

    silent_s: float
    gone: bool


Observation = StateChanged | AlarmChanged | Finished | Heartbeat | Farewell | DiskSeen | Silence


class Fact(msgspec.Struct, frozen=True):
    """An observation and its time (UTC s); number: counted within a run of the engine."""

    at: float
    seen: Observation
    number: int = 0


class NotifierSetup(msgspec.Struct, frozen=True):
    """The notifier's channels, the folder of its state, and the run of the engine.

    rig: the path of its file, name: in messages.
    """

    rig: str
    ways: tuple[NotifySection, ...]
    ping: PingSection | None
    folder: str
    secrets: str
    run: str
    name: str


class NotifierAnswer(msgspec.Struct, frozen=True):
    """The number of the last processed fact, and remarks on deliveries for the log.

    wrong: why somebody may get no message, empty while all is well; None when unchanged.
    """

    processed: int = 0
    remarks: tuple[str, ...] = ()
    wrong: str | None = None
