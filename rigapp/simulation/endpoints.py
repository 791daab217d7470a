"""Where the host finds a simulated device: a pty under a lasting name, or a TCP socket.

An endpoint never blocks. It knows whether a host has the other end open, survives the host's
closing and opening again, and can be taken away and put back like a cable.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import select
import socket
import struct
import termios
import time
import tty
from collections.abc import Callable
from pathlib import Path
from typing import Protocol

LOOPBACK = "127.0.0.1"
_READ_SIZE = 65536
_GAUGE_S = 0.05  # a host that has gone is noticed in this time


class Endpoint(Protocol):
    """Offer one port of the simulated rig to a host."""

    @property
    def url(self) -> str:
        """Return what the host opens; the same for the endpoint's whole life."""

    def connected(self) -> bool:
        """Tell whether a host has the other end open."""

    def waitable(self) -> list[int]:
        """Return the descriptors whose readability means that something happened."""

    def read(self) -> bytes:
        """Return what the host has written, b"" when nothing; never blocks."""

    def write(self, data: bytes | memoryview) -> int:
        """Give bytes to the host, as many as go; return how many went."""

    def unread(self) -> int:
        """Return the bytes that the host has not yet read, where that can be known, else 0."""

    def pull(self) -> None:
        """Take the device away: the host's connection breaks and opening fails."""

    def restore(self) -> None:
        """Put the device back under the same URL."""

    def close(self) -> None:
        """Release everything; never raises; safe to call twice."""


class PtyEndpoint:
    """A pty behind a symbolic link, whose name outlives a pulled cable.

    The device side holds only the master: the kernel then reports a hang-up exactly while no host
    has the slave open. For the bytes that wait in the slave a descriptor of one's own is needed; it
    is held 50 ms at a time, so that a host that has gone is noticed in that time.
    """

    def __init__(self, link: Path, clock: Callable[[], float] = time.monotonic) -> None:
        self._link = link
        self._clock = clock
        self._master = -1
        self._slave_name = ""
        self._gauge = -1
        self._gauge_until = 0.0
        self._was_connected = False
        self.restore()

    @property
    def url(self) -> str:
        return str(self._link)

    def connected(self) -> bool:
        if self._master < 0:
            return False
        if self._gauge >= 0:
            if self._clock() < self._gauge_until:
                return True
            self._drop_gauge()
        connected = not _hung_up(self._master)
        if self._was_connected and not connected:
            self._forget_unread()
        self._was_connected = connected
        return connected

    def waitable(self) -> list[int]:
        return [self._master] if self.connected() else []

    def read(self) -> bytes:
        parts = []
        while self._master >= 0:
            try:
                part = os.read(self._master, _READ_SIZE)
            except BlockingIOError:
                break
            except OSError as error:
                if error.errno != errno.EIO:
                    raise
                break
            if not part:
                break
            parts.append(part)
        return b"".join(parts)

    def write(self, data: bytes | memoryview) -> int:
        if self._master < 0:
            return 0
        try:
            return os.write(self._master, data)
        except BlockingIOError:
            return 0
        except OSError as error:
            if error.errno != errno.EIO:
                raise
            return 0

    def unread(self) -> int:
        if not self.connected():
            return 0
        if self._gauge < 0:
            try:
                self._gauge = os.open(self._slave_name, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
            except OSError:
                return 0
            self._gauge_until = self._clock() + _GAUGE_S
        answer = fcntl.ioctl(self._gauge, termios.FIONREAD, b"\0\0\0\0")
        return int(struct.unpack("i", answer)[0])

    def pull(self) -> None:
        self._drop_gauge()
        self._link.unlink(missing_ok=True)
        if self._master >= 0:
            os.close(self._master)
            self._master = -1
        self._was_connected = False

    def restore(self) -> None:
        if self._master >= 0:
            return
        master, slave = os.openpty()
        try:
            tty.setraw(master)
            tty.setraw(slave)
            self._slave_name = os.ttyname(slave)
        finally:
            os.close(slave)
        os.set_blocking(master, False)
        self._master = master
        fresh = self._link.with_name(self._link.name + ".new")
        fresh.unlink(missing_ok=True)
        fresh.symlink_to(self._slave_name)
        fresh.replace(self._link)

    def close(self) -> None:
        with contextlib.suppress(OSError):
            self.pull()

    def _drop_gauge(self) -> None:
        if self._gauge >= 0:
            os.close(self._gauge)
            self._gauge = -1

    def _forget_unread(self) -> None:
        """Drop what the host that has gone did not read: the next one must not get it."""
        try:
            slave = os.open(self._slave_name, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        except OSError:
            return
        try:
            with contextlib.suppress(BlockingIOError, OSError):
                while os.read(slave, _READ_SIZE):
                    pass
        finally:
            os.close(slave)


class SocketEndpoint:
    """A TCP server on the loopback for one host at a time; a second one is turned away."""

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
                part = self._connection.recv(_READ_SIZE)
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
            # A small send buffer keeps the backlog, and with it the age of what is read, small.
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 8192)
            self._connection = connection

    def _hang_up(self) -> None:
        if self._connection is not None:
            self._connection.close()
            self._connection = None


def _hung_up(descriptor: int) -> bool:
    poll = select.poll()
    poll.register(descriptor, 0)
    return any(event & (select.POLLHUP | select.POLLNVAL) for _, event in poll.poll(0))
