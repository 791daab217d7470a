"""The newest of everything for every page: a slot a fragment, newest wins, nothing queues up.

A page holds only which version of each slot it has been sent. While it does not read, what is new
takes the place of what it has not seen; so a page costs the same whether it reads or not.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping

MOST_SLOTS = 200
"""Three a rig, and as many rigs as a page holds, leave room to spare."""


class Hub:
    """Hold the newest frames; used from the server's event loop alone."""

    def __init__(self) -> None:
        self._slots: dict[str, tuple[int, bytes]] = {}
        self._version = 0
        self._changed = asyncio.Event()
        self._closed = False
        self.readers = 0

    def publish(self, frames: Mapping[str, bytes]) -> None:
        """Take frames by the names of their slots; what is as before is no news."""
        for name, frame in frames.items():
            known = self._slots.get(name)
            if known is None and len(self._slots) >= MOST_SLOTS:
                continue
            if known is not None and known[1] == frame:
                continue
            self._version += 1
            self._slots[name] = (self._version, frame)
        self._wake()

    def close(self) -> None:
        """Let every page end."""
        self._closed = True
        self._wake()

    async def frames(self) -> AsyncIterator[bytes]:
        """Yield what is new for one page, all of it at once, until the hub is closed."""
        seen = 0
        self.readers += 1
        try:
            while not self._closed:
                changed = self._changed
                fresh = sorted(slot for slot in self._slots.values() if slot[0] > seen)
                if fresh:
                    seen = fresh[-1][0]
                    yield b"".join(frame for _, frame in fresh)
                else:
                    await changed.wait()
        finally:
            self.readers -= 1

    def _wake(self) -> None:
        self._changed.set()
        self._changed = asyncio.Event()
