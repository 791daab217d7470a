"""Port of a simulated device as a pty with a permanent name, on POSIX systems."""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import select
import struct
import sys
import termios
import time
import tty
from collections.abc import Callable
from pathlib import Path

from rigapp.simulation.wire.endpoints import READ_SIZE

assert sys.platform != "win32"

_GAUGE_S = 0.05  # maximum delay until a disconnected host is noticed


class PtyEndpoint:
    """A pty behind a symbolic link, whose name persists when the cable is pulled.

    The device side holds only the master: the kernel then reports a hang-up exactly while no host
    has the slave open. Counting the bytes in the slave requires an open descriptor of it, which is
    held for 50 ms at a time, so that a disconnected host is noticed within that time.
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
                part = os.read(self._master, READ_SIZE)
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
        """Drop bytes not read by a disconnected host: the next one must not receive them."""
        try:
            slave = os.open(self._slave_name, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        except OSError:
            return
        try:
            with contextlib.suppress(BlockingIOError, OSError):
                while os.read(slave, READ_SIZE):
                    pass
        finally:
            os.close(slave)


def _hung_up(descriptor: int) -> bool:
    poll = select.poll()
    poll.register(descriptor, 0)
    return any(event & (select.POLLHUP | select.POLLNVAL) for _, event in poll.poll(0))
