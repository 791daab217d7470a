"""The numbers and words of a test file that are overwritten in place while the test runs."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp.storage.filesystem.disk import Disk
from rigapp.storage.structure.layout import STATE
from rigapp.storage.writing.create import Places

FINAL_STATUSES = ("complete", "stopped", "fault")


@dataclass(slots=True)
class Counts:
    """Count the rows of each stream, and what was refused."""

    revolutions: int = 0
    cycles: int = 0
    samples: int = 0
    unfinished: int = 0
    unfinished_samples: int = 0
    prediction: int = 0
    curves: int = 0
    profiles: int = 0
    events: int = 0
    gaps: int = 0
    resumed: int = 0
    cycles_refused: int = 0
    events_refused: int = 0
    planned_revolutions: int = 0


COUNTERS = {
    "cycles": "/entry/cycles/committed",
    "unfinished": "/entry/unfinished/committed",
    "curves": "/entry/prediction/committed_curves",
    "profiles": "/entry/prediction/committed_profiles",
    "prediction": "/entry/prediction/committed",
    "events": "/entry/events/committed",
    "gaps": f"{STATE}/gaps",
    "resumed": f"{STATE}/resumed",
    "cycles_refused": f"{STATE}/cycles_refused",
    "events_refused": f"{STATE}/events_refused",
    "planned_revolutions": f"{STATE}/planned_revolutions",
    "revolutions": "/entry/revolutions/committed",
}
"""Counters in the order in which a commit writes them; a file need not have all of them."""


class Scalars:
    """Overwrite scalars in place: int64, and texts of fixed length."""

    def __init__(self, disk: Disk, places: Places) -> None:
        self._disk = disk
        self._places = places

    def put_state(self, name: str, value: int | str) -> None:
        """Overwrite one scalar of ``/entry/state``."""
        self.put(f"{STATE}/{name}", value)

    def put(self, path: str, value: int | str) -> None:
        """Overwrite one scalar; a text too long for its place is cut between characters."""
        offset, length = self._places[path]
        if isinstance(value, int):
            data = value.to_bytes(8, "little", signed=True)
        else:
            data = value.encode()[:length].decode(errors="ignore").encode().ljust(length, b"\0")
        self._disk.write(data, offset)
