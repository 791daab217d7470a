"""Milestones of a run, for a program that follows it; ``--progress json`` writes them as such."""

from __future__ import annotations

from typing import Protocol

import msgspec

from rigapp.schema.messages import Alarm, FinishReason, RunState


class Committed(msgspec.Struct, frozen=True, tag_field="event", tag="committed"):
    """So many revolutions are safe in the file."""

    revolutions: int


class StateChanged(msgspec.Struct, frozen=True, tag_field="event", tag="state", omit_defaults=True):
    """The run is in another state. resting: between two steps, and it goes on by itself."""

    state: RunState
    reason: str
    resting: bool = False


class AlarmChanged(msgspec.Struct, frozen=True, tag_field="event", tag="alarm"):
    """An alarm was raised, or changed."""

    alarm: Alarm


class Finished(msgspec.Struct, frozen=True, tag_field="event", tag="finished"):
    """The test has ended and its file is closed. revolutions: rows safe in the file."""

    reason: FinishReason
    sentence: str
    status: str
    revolutions: int
    file: str


Notice = Committed | StateChanged | AlarmChanged | Finished


class Notices(Protocol):
    """Give the milestones of a run, as the engine's publisher does."""

    def get(self, timeout_s: float) -> Notice | None:
        """Return the oldest, None when none came in time."""
