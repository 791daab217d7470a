"""Let connections in, bounded before a byte is read: what has not greeted yet counts as well.

The server counts a connection when its protocol begins, which over TLS is after the handshake. A
stranger who connects and says nothing would take one descriptor after the other until the page has
none left, for its engines neither. Here the oldest that has not greeted makes room for the newest:
who does greet is through within a moment, whoever else waits.
"""

from __future__ import annotations

import errno
import gc
import os
import socket
import struct
import sys
from typing import Any

MOST_CONNECTIONS = 128
"""Each holds at most SEND_BYTES twice; the system allows 1024 open files by default."""
MOST_GREETING = 64
"""In the handshake, each for some 50 ms: as many telephones come back after a power cut."""
ENDS_HELD = 64
"""Ended connections whose memory waits. What a handshake that fails leaves refers to itself, some
70 kB of which Python counts a hundred small objects: its own searches come after thousands."""
SHARE = 4
"""One part of the open files that the system allows is for connections, the others for engines."""


def reset(line: Any) -> None:
    """Let a connection end at once; else the system keeps what was not taken, for minutes."""
    line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))


class Gate(socket.socket):
    """A listening socket that accepts no more than it may; ``dropped`` counts those let go."""

    def __init__(self, listening: socket.socket) -> None:
        """Take over a socket that listens."""
        super().__init__(listening.family, listening.type, fileno=listening.detach())
        self.dropped = 0
        allowed = _allowed_files()
        self.most = min(MOST_CONNECTIONS, allowed // SHARE)
        self._most_greeting = min(MOST_GREETING, allowed // (2 * SHARE))
        self._greeting: dict[int, Guest] = {}
        self._ends = self._in_a_row = 0
        self._spare = os.open(os.devnull, os.O_RDONLY)

    def accept(self) -> tuple[socket.socket, Any]:
        """Return the next connection; raise ConnectionAbortedError where there is no room.

        After some, raise BlockingIOError as if there were no more: asyncio would accept all that
        wait, two thousand, before it looks at the first.
        """
        self._in_a_row += 1
        if self._in_a_row > self._most_greeting:
            self._in_a_row = 0
            raise BlockingIOError
        try:
            descriptor, peer = self._accept()  # type: ignore[attr-defined]
        except OSError as error:
            if error.errno in (errno.EMFILE, errno.ENFILE):
                self._turn_away()
                raise ConnectionAbortedError from error
            raise
        guest = Guest(self, descriptor)
        self._greeting[descriptor] = guest
        if len(self._greeting) > self._most_greeting:
            self.dropped += 1
            oldest = next(iter(self._greeting.values()))
            del self._greeting[oldest.fileno()]
            oldest.let_go()
        return guest, peer

    def greeted(self, descriptor: int) -> None:
        """Take note that the protocol of a connection has begun: it has limits of its own."""
        self._greeting.pop(descriptor, None)

    def gone(self, guest: Guest) -> None:
        """Take note that a connection is closed."""
        if self._greeting.get(guest.fileno()) is guest:
            del self._greeting[guest.fileno()]
        self._ends += 1
        if self._ends >= ENDS_HELD:
            self._ends = self._in_a_row = 0
            gc.collect()

    def close(self) -> None:
        """Accept no more."""
        if self._spare >= 0:
            os.close(self._spare)
            self._spare = -1
        super().close()

    def _turn_away(self) -> None:
        """Accept one by the descriptor that is kept for it, and close it; else it would wait."""
        self.dropped += 1
        os.close(self._spare)
        try:
            descriptor, _ = self._accept()  # type: ignore[attr-defined]
            os.close(descriptor)
        except OSError:
            pass
        finally:
            self._spare = os.open(os.devnull, os.O_RDONLY)


class Guest(socket.socket):
    """An accepted connection that tells the gate when it is closed."""

    def __init__(self, gate: Gate, descriptor: int) -> None:
        super().__init__(gate.family, gate.type, gate.proto, fileno=descriptor)
        self._gate = gate

    def close(self) -> None:
        """Close, and give the place back."""
        self._gate.gone(self)
        super().close()

    def let_go(self) -> None:
        """End a connection that others read from: they see its end and close it."""
        reset(self)
        self.shutdown(socket.SHUT_RDWR)


def _allowed_files() -> int:
    """Return how many files the system lets this process open."""
    if sys.platform == "win32":
        return 8192
    import resource

    return resource.getrlimit(resource.RLIMIT_NOFILE)[0]
