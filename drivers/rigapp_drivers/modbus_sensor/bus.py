"""A line shared by several Modbus devices: opened once, used by one driver at a time."""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Iterator
from typing import Final

from rigapp_drivers.api import ConnectionFailed, DeviceLost, SettingRefused
from rigapp_drivers.exchange import OpenQuestions
from rigapp_drivers.transport import SerialPort
from rigapp_drivers.wire.ports import actual_port

TCP: Final = "tcp:"
"""Prefix of the port of a Modbus TCP server: ``tcp:HOST:PORT``."""
_TCP_PORT: Final = "502"  # Modbus messaging on TCP/IP 1.0b, 3.1.3


class Bus:
    """One line and its users; the holder of ``lock`` may send requests.

    questions: of all users, because a late reply may be read by the next user.
    """

    def __init__(self, line: SerialPort | None = None) -> None:
        self.line = line
        self.lock = threading.Lock()
        self.questions: list[OpenQuestions] = []
        self.users: list[SharedPort] = []


_BUSES: Final[dict[str, Bus]] = {}
_joining = threading.Lock()


class SharedPort:
    """One device's access to a line; implements ``rigapp_drivers.api.BytePort``.

    address: of the device, unique on the line.
    The first user opens the line, the last one releases it. After a failure the line is released
    for all users, so that each can open it again.
    """

    def __init__(
        self,
        device: str,
        port: str,
        baud_rate: int,
        parity: str,
        stop_bits: int,
        address: int,
    ) -> None:
        self.device = device
        self.port = port
        self.bus = Bus()
        self._frame = (baud_rate, parity, stop_bits)
        self._address = address

    @property
    def is_open(self) -> bool:
        """Return whether the port is open."""
        return self in self.bus.users

    def open(self) -> None:
        """Open the line or share the open one; raise ConnectionFailed, SettingRefused."""
        if self.is_open:
            return
        baud_rate, parity, stop_bits = self._frame
        key = _key(self.port)
        with _joining:
            bus = _BUSES.get(key)
            if bus is None:
                port = _url(self.port)
                line = SerialPort(self.device, port, baud_rate, parity=parity, stop_bits=stop_bits)
                line.open()
                bus = _BUSES[key] = Bus(line)
            elif bus.line is not None and bus.line.frame != self._frame:
                raise SettingRefused.at(
                    self,
                    "it shares this port with {}; give both the same baud_rate, parity and"
                    " stop_bits.",
                    bus.users[0].device,
                )
            for other in bus.users:
                if other._address == self._address:
                    raise ConnectionFailed.at(
                        self,
                        "address {} on this port is in use by another program or device, {}; give"
                        " each device its own address.",
                        self._address,
                        other.device,
                    )
            bus.users.append(self)
            self.bus = bus

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return the available bytes, at most maximum; wait up to timeout_s for the first."""
        with self._using() as line:
            return line.read_some(maximum, timeout_s)

    def write(self, data: bytes) -> None:
        """Send all bytes; raise DeviceLost."""
        with self._using() as line:
            line.write(data)

    def drain(self) -> bytes:
        """Read until the line is quiet and return the bytes."""
        with self._using() as line:
            return line.drain()

    def close(self) -> None:
        """Leave the line; the last user releases it; never raises."""
        with _joining:
            bus, self.bus = self.bus, Bus()
            if self in bus.users:
                bus.users.remove(self)
            if not bus.users:
                self._release(bus)

    @property
    def bytes_received(self) -> int:
        """Return the number of bytes received on the whole line."""
        return 0 if self.bus.line is None else self.bus.line.bytes_received

    @property
    def bytes_sent(self) -> int:
        """Return the number of bytes sent on the whole line."""
        return 0 if self.bus.line is None else self.bus.line.bytes_sent

    @contextlib.contextmanager
    def _using(self) -> Iterator[SerialPort]:
        """Yield the open line; release it for all users on failure."""
        if self.bus.line is None:
            raise DeviceLost.at(self, "the port is not open.")
        try:
            yield self.bus.line
        except DeviceLost as error:
            with _joining:
                self._release(self.bus)
            raise DeviceLost.at(self, error.sentence) from error

    def _release(self, bus: Bus) -> None:
        if bus.line is not None:
            bus.line.close()
        for key in [key for key, other in _BUSES.items() if other is bus]:
            del _BUSES[key]


def _url(port: str) -> str:
    """Return the URL of the port for SerialPort."""
    if not port.startswith(TCP):
        return port
    host, _, number = port.removeprefix(TCP).rpartition(":")
    return f"socket://{host}:{number}" if host else f"socket://{number}:{_TCP_PORT}"


def _key(port: str) -> str:
    """Return a key that is equal for all names of one port."""
    url = _url(port)
    return url if "://" in url else os.path.realpath(actual_port(url))
