"""Receive the messages of viewers, and end the connection of one that takes memory without a bound.

libzmq holds the parts of a message until its last one has come, and bounds neither their number nor
their sum: ``MAXMSGSIZE`` bounds one part, ``RCVHWM`` counts whole messages. A program that speaks
ZMTP by itself and never ends its message filled 500 MB in 0.8 s. So the growth of the process is
watched, and connections are ended at the level of the operating system: libzmq frees what they
held, and a viewer that was ended beside them connects again by itself.
"""

from __future__ import annotations

import logging
import math
import socket as os_socket
from collections.abc import Iterable
from contextlib import suppress

import psutil
import zmq
from zmq.utils.monitor import recv_monitor_message

from rigapp.process.memory import give_back

GROWTH_BYTES = 100_000_000
"""An engine grows by 15 MB from its start to a running test, and stays there."""
PARTS = 8
"""Of a message, at most; a request has two or three, and each takes 1 us to receive."""
SETTLE_S = 1.0  # libzmq frees the parts in a thread of its own

log = logging.getLogger(__name__)
Socket = zmq.Socket[bytes]


class Connections:
    """Know the connections of some sockets; all calls belong to the thread that serves them."""

    def __init__(self, sockets: Iterable[Socket]) -> None:
        """Begin to watch; the sockets are not bound yet."""
        events = zmq.EVENT_ACCEPTED | zmq.EVENT_DISCONNECTED
        self._monitors = [one.get_monitor_socket(events) for one in sockets]
        self._handles: set[int] = set()
        self._process = psutil.Process()
        self._usual = self._process.memory_info().rss
        self._settled_s = math.inf

    def receive(self, socket: Socket) -> list[bytes]:
        """Return sender and body of the next message, nothing of one that is not to be answered.

        A message of too many parts is ignored, and its sender's connection ended while it goes on
        to send. Raises zmq.Again where none waits.
        """
        first = frame = socket.recv(zmq.NOBLOCK, copy=False)
        parts = 1
        while frame.more:
            frame = socket.recv(copy=False)
            parts += 1
        if parts <= PARTS:
            return [first.bytes, frame.bytes]
        self._note()
        handle = int(frame.get(zmq.SRCFD))
        if _sends(handle):  # its sender still: another's connection may have the handle by now
            log.warning("a message of %d parts: its sender's connection is ended", parts)
            self._end({handle})
        return []

    def bound_memory(self, now_s: float, *, busy: bool) -> None:
        """End connections when the process has grown: those that send now, else all of them.

        busy: a request is under way: it may need the memory, and waits for its reply.
        """
        self._note()
        used = self._process.memory_info().rss
        if used > self._usual + GROWTH_BYTES:
            give_back()
            used = self._process.memory_info().rss
        self._usual = min(self._usual, used)
        if used < self._usual + GROWTH_BYTES:
            self._settled_s = math.inf
            return
        guilty = {one for one in self._handles if _sends(one)}
        if not guilty and not busy:
            if now_s > self._settled_s:  # it was none of them that has taken the memory
                self._usual, self._settled_s = used, math.inf
                return
            guilty = set() if self._settled_s < math.inf else set(self._handles)
            self._settled_s = min(self._settled_s, now_s + SETTLE_S)
        if guilty:
            log.warning("grown to %.0f MB: %d connections are ended", used / 1e6, len(guilty))
        self._end(guilty)

    def _note(self) -> None:
        """Take note of the connections that have begun and ended."""
        for monitor in self._monitors:
            while monitor.poll(0):
                event = recv_monitor_message(monitor)
                if event["event"] == zmq.EVENT_ACCEPTED:
                    self._handles.add(event["value"])
                else:
                    self._handles.discard(event["value"])

    def _end(self, handles: set[int]) -> None:
        for handle in handles & self._handles:
            with suppress(OSError):
                connection = os_socket.socket(fileno=handle)
                try:
                    connection.shutdown(os_socket.SHUT_RDWR)
                finally:
                    connection.detach()  # libzmq closes it


def _sends(handle: int) -> bool:
    """Tell whether a connection has sent what was not read yet; that of a viewer rarely has."""
    try:
        connection = os_socket.socket(fileno=handle)
    except OSError:
        return False
    try:
        return bool(connection.recv(1, os_socket.MSG_PEEK))
    except OSError:
        return False
    finally:
        connection.detach()
