"""A line that several Modbus devices share: opened once, asked by one after the other."""

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
"""What the port of a Modbus TCP server begins with: ``tcp:HOST:PORT``."""
_TCP_PORT: Final = "502"  # Modbus messaging on TCP/IP 1.0b, 3.1.3


class Bus:
    """One line and those who use it; who holds ``lock`` may ask.

    questions: of all users, because an answer that is late meets whoever asks next.
    """

    def __init__(self, line: SerialPort | None = None) -> None:
        self.line = line
        self.lock = threading.Lock()
        self.questions: list[OpenQuestions] = []
        self.users: list[SharedPort] = []


_BUSES: Final[dict[str, Bus]] = {}
_joining = threading.Lock()


class SharedPort:
    """One device's part of a line; implements ``rigapp_drivers.api.BytePort``.

    address: of the device on the line, which stands there once.
    The first who opens it opens the line, the last who closes it releases it. A line that broke is
    released for all, so that each of them can open it again.
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
        """Tell whether the port is open."""
        return self in self.bus.users

    def open(self) -> None:
        """Open the line, or join those who have; raise ConnectionFailed, SettingRefused."""
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
        """Return what is there, at most maximum bytes; wait timeout_s for the first one."""
        with self._using() as line:
            return line.read_some(maximum, timeout_s)

    def write(self, data: bytes) -> None:
        """Send all bytes; raise DeviceLost."""
        with self._using() as line:
            line.write(data)

    def drain(self) -> bytes:
        """Read until the line is quiet and return what came."""
        with self._using() as line:
            return line.drain()

    def close(self) -> None:
        """Leave the line, and release it as the last; never raises."""
        with _joining:
            bus, self.bus = self.bus, Bus()
            if self in bus.users:
                bus.users.remove(self)
            if not bus.users:
                self._release(bus)

    @property
    def bytes_received(self) -> int:
        """Return the bytes that came on the whole line."""
        return 0 if self.bus.line is None else self.bus.line.bytes_received

    @property
    def bytes_sent(self) -> int:
        """Return the bytes that were sent on the whole line."""
        return 0 if self.bus.line is None else self.bus.line.bytes_sent

    @contextlib.contextmanager
    def _using(self) -> Iterator[SerialPort]:
        """Hand out the open line; release it for all users when it breaks."""
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
    """Return the port as SerialPort opens it."""
    if not port.startswith(TCP):
        return port
    host, _, number = port.removeprefix(TCP).rpartition(":")
    return f"socket://{host}:{number}" if host else f"socket://{number}:{_TCP_PORT}"


def _key(port: str) -> str:
    """Return what is equal for two names of one port."""
    url = _url(port)
    return url if "://" in url else os.path.realpath(actual_port(url))
