"""Milestones of a run for a supervising program; ``--progress json`` writes them."""

from __future__ import annotations

from typing import Protocol

import msgspec

from rigapp.schema.messages import Alarm, FinishReason, RunState


class Committed(msgspec.Struct, frozen=True, tag_field="event", tag="committed"):
    """Revolutions that are committed to the file."""

    revolutions: int


class StateChanged(msgspec.Struct, frozen=True, tag_field="event", tag="state", omit_defaults=True):
    """The run is in another state. resting: between two steps, resumes by itself."""

    state: RunState
    reason: str
    resting: bool = False


class AlarmChanged(msgspec.Struct, frozen=True, tag_field="event", tag="alarm"):
    """An alarm was raised, or changed."""

    alarm: Alarm


class Finished(msgspec.Struct, frozen=True, tag_field="event", tag="finished"):
    """The test has ended and its file is closed. revolutions: committed rows."""

    reason: FinishReason
    sentence: str
    status: str
    revolutions: int
    file: str


Notice = Committed | StateChanged | AlarmChanged | Finished


class Notices(Protocol):
    """Source of the milestones of a run, such as the engine's publisher."""

    def get(self, timeout_s: float) -> Notice | None:
        """Return the oldest, None on time-out."""
