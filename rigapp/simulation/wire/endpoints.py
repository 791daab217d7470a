"""Interface of a simulated device's port, and its implementation by TCP; ``pty`` has another.

An endpoint never blocks. It detects whether a host has the other end open, remains usable when the
host closes and reopens it, and can be unplugged and plugged in like a cable.
"""

from __future__ import annotations

import socket
from typing import Protocol

LOOPBACK = "127.0.0.1"
READ_SIZE = 65536


class Endpoint(Protocol):
    """One port of the simulated rig for a host."""

    @property
    def url(self) -> str:
        """Return the URL for the host; it never changes."""

    def connected(self) -> bool:
        """Return whether a host has the other end open."""

    def waitable(self) -> list[int]:
        """Return the descriptors to wait on."""

    def read(self) -> bytes:
        """Return the bytes written by the host, b"" if none; never blocks."""

    def write(self, data: bytes | memoryview) -> int:
        """Send as many bytes to the host as it accepts; return their number."""

    def unread(self) -> int:
        """Return the number of bytes not yet read by the host, 0 if unknown."""

    def pull(self) -> None:
        """Unplug the device: the host's connection breaks and opening fails."""

    def restore(self) -> None:
        """Plug the device in again under the same URL."""

    def close(self) -> None:
        """Release everything; never raises; safe to call twice."""


class SocketEndpoint:
    """A TCP server on the loopback interface for one host at a time; a second one is refused."""

    def __init__(self) -> None:
        self._port = 0
        self._listener: socket.socket | None = None
        self._connection: socket.socket | None = None
        self.restore()

    @property
    def url(self) -> str:
        return f"socket://{LOOPBACK}:{self._port}"

    def connected(self) -> bool:
        self._accept()
        return self._connection is not None

    def waitable(self) -> list[int]:
        return [s.fileno() for s in (self._listener, self._connection) if s is not None]

    def read(self) -> bytes:
        self._accept()
        parts = []
        while self._connection is not None:
            try:
                part = self._connection.recv(READ_SIZE)
            except BlockingIOError:
                break
            except OSError:
                part = b""
            if not part:
                self._hang_up()
                break
            parts.append(part)
        return b"".join(parts)

    def write(self, data: bytes | memoryview) -> int:
        if self._connection is None:
            return 0
        try:
            return self._connection.send(data)
        except BlockingIOError:
            return 0
        except OSError:
            self._hang_up()
            return 0

    def unread(self) -> int:
        return 0

    def pull(self) -> None:
        self._hang_up()
        if self._listener is not None:
            self._listener.close()
            self._listener = None

    def restore(self) -> None:
        if self._listener is not None:
            return
        listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((LOOPBACK, self._port))
        listener.listen(1)
        listener.setblocking(False)
        self._listener = listener
        self._port = listener.getsockname()[1]

    def close(self) -> None:
        self.pull()

    def _accept(self) -> None:
        while self._listener is not None:
            try:
                connection, _ = self._listener.accept()
            except OSError:
                return
            if self._connection is not None:
                connection.close()
                continue
            connection.setblocking(False)
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            # A small send buffer limits the backlog, and with it the age of the data.
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 8192)
            self._connection = connection

    def _hang_up(self) -> None:
        if self._connection is not None:
            self._connection.close()
            self._connection = None
