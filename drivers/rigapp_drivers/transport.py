"""Serial transport by URL: a device path, a pty, COM port or ``socket://host:port``.

Always opened with ``serial_for_url``. One thread reads; writes may come from another thread.
Every failure after opening is a ``DeviceLost`` with its cause.
"""

from __future__ import annotations

import contextlib
import errno
import os
import select
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import serial

from rigapp.texts import say, sentence_of_error
from rigapp_drivers.api import (
    BytePort,
    ConnectionFailed,
    DeviceLost,
    Identity,
    PortForbidden,
    PortInUse,
)
from rigapp_drivers.wire.ports import RECORDED, PortNotFound, actual_port
from rigapp_drivers.wire.recorder import recorders_of

_PORT_ERRORS: tuple[type[Exception], ...] = (OSError, ValueError)
"""Exceptions of a port; pyserial's SerialException is an OSError."""
if sys.platform != "win32":
    with contextlib.suppress(ImportError):
        import termios

        _PORT_ERRORS += (termios.error,)
_NOT_ABLE: tuple[type[Exception], ...] = (AttributeError, NotImplementedError, *_PORT_ERRORS)
"""Exceptions of a port without a file descriptor or without a low-latency mode."""
_PARITIES = {"none": "N", "even": "E", "odd": "O"}
_SLICE_S = 0.1  # period at which a waiting reader checks whether the port was closed
_DRAIN_QUIET_S = 0.02  # longer than a USB adapter buffers bytes (16 ms)
_DRAIN_LIMIT_S = 2.0  # maximum wait for a device that keeps streaming


class SerialPort:
    """Communicate with one device over a serial port, opened exclusively; 8 data bits.

    One thread reads, any thread writes or closes. ``low_latency``: whether the adapter accepted
    the low-latency mode (FTDI on Linux); a pty, a socket and CDC devices have none.
    ``bytes_received`` and ``bytes_sent`` count from the last ``open``.
    """

    def __init__(
        self,
        device: str,
        port: str,
        baud_rate: int,
        *,
        write_timeout_s: float = 2.0,
        parity: str = "none",
        stop_bits: int = 1,
    ) -> None:
        self.device = device
        self.port = port
        self.baud_rate = baud_rate
        self.write_timeout_s = write_timeout_s
        self.frame = (baud_rate, parity, stop_bits)
        self.low_latency = False
        self.bytes_received = 0
        self.bytes_sent = 0
        self._serial: Any = None
        self._selectable = False
        self._closing = False
        self._reading = threading.Lock()
        self._writing = threading.Lock()

    @property
    def is_open(self) -> bool:
        """Return whether the port is open."""
        return self._serial is not None

    def open(self) -> None:
        """Open the port exclusively and clear its input; raise ConnectionFailed."""
        if self._serial is not None:
            return
        try:
            actual = actual_port(self.port)
            opened = serial.serial_for_url(
                actual,
                baudrate=self.baud_rate,
                timeout=0,
                write_timeout=self.write_timeout_s,
                exclusive=True,
                parity=_PARITIES[self.frame[1]],
                stopbits=self.frame[2],
            )
        except PortNotFound as error:
            raise ConnectionFailed.at(self, sentence_of_error(error)) from error
        except _PORT_ERRORS as error:
            kind, sentence = _why_not_opened(error, actual)
            raise kind.at(self, sentence) from error
        self.low_latency = _set_low_latency(opened)
        self._selectable = _can_select(opened)
        self._closing = False
        self.bytes_received = self.bytes_sent = 0
        self._serial = opened

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return the available bytes, at most maximum; wait up to timeout_s for the first.

        b"" on time-out. Raises DeviceLost.
        """
        deadline = time.monotonic() + timeout_s
        with self._reading:
            while True:
                # Check once more after the time-out: a busy computer may have delayed this thread
                # for longer than the device took.
                left = deadline - time.monotonic()
                wait = min(_SLICE_S, max(0.0, left))
                opened = self._usable(say("reading"))
                try:
                    if self._selectable:
                        data = _read_selectable(opened, maximum, wait)
                    else:
                        data = _read_counting(opened, maximum, wait)
                except _PORT_ERRORS as error:
                    raise self._lost(error, "reading") from error
                self.bytes_received += len(data)
                for recorder in recorders_of(self.device, self.port):
                    recorder.received(data)
                if data or left <= 0.0:
                    return data

    def write(self, data: bytes) -> None:
        """Send all bytes within the write time-out; raise DeviceLost."""
        with self._writing:
            opened = self._usable(say("writing"))
            for recorder in recorders_of(self.device, self.port):
                recorder.sent(data)
            try:
                sent = opened.write(data)
            except _PORT_ERRORS as error:
                raise self._lost(error, "writing") from error
            self.bytes_sent += len(data) if sent is None else sent
        if sent is not None and sent != len(data):
            raise DeviceLost.at(
                self, "a request was not sent completely ‹{} of {} bytes›.", sent, len(data)
            )

    def drain(self) -> bytes:
        """Read until the line is quiet for 20 ms, at most 2 s, and return the bytes."""
        deadline = time.monotonic() + _DRAIN_LIMIT_S
        parts = []
        while time.monotonic() < deadline:
            part = self.read_some(65536, _DRAIN_QUIET_S)
            if not part:
                break
            parts.append(part)
        return b"".join(parts)

    def close(self) -> None:
        """Release the port; never raises; safe to call twice and from another thread."""
        self._closing = True
        opened, self._serial = self._serial, None
        if opened is None:
            return
        # Do not close a descriptor while a thread uses it: the system may reuse its number at
        # once. Both holders release it soon, or the port is stuck anyway.
        held = [
            lock
            for lock, patience_s in (
                (self._reading, 5 * _SLICE_S),
                (self._writing, self.write_timeout_s + _SLICE_S),
            )
            if lock.acquire(timeout=patience_s)
        ]
        try:
            _close_quietly(opened)
        finally:
            for lock in held:
                lock.release()
            for recorder in recorders_of(self.device, self.port):
                recorder.close()

    def _usable(self, doing: str) -> Any:
        opened = self._serial
        if opened is None:
            why = say("was closed") if self._closing else say("is not open")
            raise DeviceLost.at(self, "the port {} ({}).", why, doing)
        return opened

    def _lost(self, error: Exception, doing: str) -> DeviceLost:
        return DeviceLost.at(self, _why_lost(error, doing))


def byte_counters(line: BytePort) -> dict[str, int]:
    """Return the byte counters of a port by their ``LineCounters`` names, if it has any."""
    names = ("bytes_received", "bytes_sent")
    return {name: getattr(line, name) for name in names if hasattr(line, name)}


def opened(line: BytePort, identify: Callable[[], Identity]) -> Identity:
    """Open a line and identify the device; close it again on failure."""
    line.open()
    try:
        return identify()
    except BaseException:
        line.close()
        raise


def _read_selectable(opened: Any, maximum: int, wait_s: float) -> bytes:
    """Read a tty, pty or socket: with time-out 0 pyserial returns the available bytes at once."""
    if not select.select([opened.fileno()], [], [], wait_s)[0]:
        return b""
    data = bytes(opened.read(maximum))
    # A pty or tty returns one kernel buffer (4095 bytes) at a time; more may be waiting.
    while data and len(data) < maximum:
        try:
            more = opened.read(maximum - len(data))
        except _PORT_ERRORS:
            break  # return the bytes before the failure; the next call raises the error again
        if not more:
            break
        data += more
    return data


def _read_counting(opened: Any, maximum: int, wait_s: float) -> bytes:
    """Read a port without a file descriptor (COM ports, ``loop://``, ``rfc2217://``)."""
    waiting = opened.in_waiting
    timeout_s = 0 if waiting else wait_s
    if opened.timeout != timeout_s:
        opened.timeout = timeout_s
    data = bytes(opened.read(min(max(waiting, 1), maximum)))
    waiting = opened.in_waiting if data else 0
    if waiting and len(data) < maximum:
        data += bytes(opened.read(min(waiting, maximum - len(data))))
    return data


def _can_select(opened: Any) -> bool:
    try:
        select.select([opened.fileno()], [], [], 0)
    except _NOT_ABLE:  # io.UnsupportedOperation is an OSError
        return False
    return True


def _set_low_latency(opened: Any) -> bool:
    try:
        opened.set_low_latency_mode(True)
    except _NOT_ABLE:
        # pyserial raises this if the system or the kind of port has no such mode.
        return False
    return True


def _close_quietly(opened: Any) -> None:
    peer = getattr(opened, "_socket", None)
    with contextlib.suppress(Exception):
        opened.close()
    # pyserial leaves the socket open if the peer closed first.
    if peer is not None:
        with contextlib.suppress(OSError):
            peer.close()


def _why_not_opened(error: Exception, port: str) -> tuple[type[ConnectionFailed], str]:
    """Return the error class and the sentence for a port that cannot be opened."""
    number = getattr(error, "errno", None)
    text = sentence_of_error(error)
    if number in (errno.EAGAIN, errno.EBUSY) or "exclusively lock" in text:
        holder = holder_of(port)
        if holder:
            words = say("the port is in use by another program, {}; close it.", holder)
            return PortInUse, words
        return PortInUse, say("the port is in use by another program; close that program.")
    if number in (errno.EACCES, errno.EPERM):
        return PortForbidden, say(
            "this user may not open the port; add the user to the group that owns it"
            " (often dialout or uucp) and log in again."
        )
    if port.startswith(RECORDED):
        return ConnectionFailed, say("{} The recording is not played.", text)
    if port.startswith("socket://"):
        words = say("no connection ‹{}›; check host, port number and that the server runs.", text)
        return ConnectionFailed, words
    if number in (errno.ENOENT, errno.ENXIO, errno.ENODEV):
        words = say("there is no such port; check the cable, the power and the port's name.")
        return ConnectionFailed, words
    words = say("the port cannot be opened ‹{}›; check the port's name in the rig file.", text)
    return ConnectionFailed, words


def holder_of(port: str) -> str:
    """Return the name and PID of a process that has a port open, "" if none is visible.

    Only root sees the processes of other users.
    """
    real = os.path.realpath(port)
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if any(os.readlink(opened) == real for opened in (process / "fd").iterdir()):
                name = (process / "comm").read_text("utf-8", "replace").strip()
                return say("{} ‹process {}›", name, process.name)
    return ""


def _why_lost(error: Exception, doing: str) -> str:
    if isinstance(error, serial.SerialTimeoutException):
        return say(
            "the device takes no more data (write time-out); check the cable and switch"
            " the device off and on."
        )
    return say("the connection broke while {} ‹{}›; check cable and power.", doing, error)
