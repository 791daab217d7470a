"""One connection of a browser, bounded: in number, in time for a request, in time for an answer.

uvicorn bounds the size of a request's head. Here a connection that sends no whole request in
``REQUEST_S`` is dropped, and one that does not take what it was sent within ``READ_S``: the page
that is behind it fetches the newest when it comes back.
"""

from __future__ import annotations

import asyncio
import socket
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from rigapp.page.gate import Gate, reset

REQUEST_S = 10.0  # a telephone at the edge of its network takes three
READ_S = 15.0  # a screen that was locked for a moment goes on where it was
LOOK_S = 1.0
SEND_BYTES = 1 << 17
"""The system keeps so much that is sent and not taken: two rigs' plots."""


class BoundedConnection(H11Protocol):
    """A connection that holds nothing for longer than it may."""

    def __init__(self, gate: Gate, **given: Any) -> None:
        super().__init__(**given)
        self._gate = gate
        self._look_again: asyncio.TimerHandle | None = None
        self.asked_at = self._taken_at = self.loop.time()

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin; where there are too many, the one that has been silent for longest ends."""
        super().connection_made(transport)
        line = transport.get_extra_info("socket")
        line.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BYTES)
        self._gate.greeted(line.fileno())
        self._look()
        if len(self.connections) > self._gate.most:
            # The newest is among them; who has asked for something stays.
            silent = [
                one
                for one in self.connections
                if isinstance(one, BoundedConnection)
                and one.cycle is None
                and not one.transport.is_closing()
            ]
            min(silent, key=lambda one: one.asked_at).drop()

    def connection_lost(self, exc: Exception | None) -> None:
        """End."""
        if self._look_again is not None:
            self._look_again.cancel()
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        """Answer what cannot be read; in the middle of another answer only the end is left."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            super().send_400_response(msg)
        else:
            self.transport.close()

    def _look(self) -> None:
        """Drop the connection when it takes too long to ask, or to take the answer."""
        now = self.loop.time()
        if self.cycle is not None and not self.cycle.response_complete:
            self.asked_at = now
        if self.transport.get_write_buffer_size() == 0:
            self._taken_at = now
        if now - self.asked_at > REQUEST_S or now - self._taken_at > READ_S:
            self.drop()
        else:
            self._look_again = self.loop.call_later(LOOK_S, self._look)

    def drop(self) -> None:
        """Let the connection end."""
        self._gate.dropped += 1
        reset(self.transport.get_extra_info("socket"))
        self.transport.abort()
