"""Simulate the imaginary Acme SimpleADC at the byte level: lines in, lines out, time passed in."""

from __future__ import annotations

from binascii import crc_hqx

import numpy as np

from rigapp.drivers import RigSignals

NUMBERS = 10_000
LONGEST_LINE = 256


class SimpleAdcSimulator:
    """Answer and stream as the device does; a ``rigapp.drivers.SimulatedDataSource``."""

    def __init__(self) -> None:
        self.sample_rate_Hz = 10.0
        self.streaming = False
        self._line = b""
        self._number = 0

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Take bytes from the host and return the replies that they cause."""
        *lines, self._line = (self._line + data).split(b"\n")
        self._line = self._line[-LONGEST_LINE:]
        return b"".join(self._obey(line.decode("ascii", "replace").strip()) for line in lines)

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Return the lines of these samples, b"" when not streaming."""
        if not self.streaming:
            return b""
        count = signals.shaft_revolutions.size
        zeros = np.zeros(count)
        first, second = (
            np.clip(np.rint(signals.analog.get(number, zeros) * 1e6), -10e6, 10e6).astype(int)
            for number in (1, 2)
        )
        return b"".join(self._sample(*pair) for pair in zip(first, second, strict=True))

    def overrun(self, now_s: float) -> None:
        """Bear lost lines: the numbers of the samples tell them."""

    def _sample(self, first: int, second: int) -> bytes:
        body = b"%d %d %d" % (self._number, first, second)
        self._number = (self._number + 1) % NUMBERS
        return body + b" %04X\n" % crc_hqx(body, 0)

    def _obey(self, line: str) -> bytes:
        command, _, value = line.partition(" ")
        if command == "ID?":
            return b"=Acme SimpleADC 1.0 4711\n"
        if command == "HALT":
            self.streaming = False
            return b"=ok\n"
        if command == "RUN":
            self.streaming, self._number = True, 0
            return b"=ok\n"
        if command == "RATE" and value.replace(".", "", 1).isdigit() and 1 <= float(value) <= 2000:
            self.sample_rate_Hz = float(value)
            return b"=%g\n" % self.sample_rate_Hz
        return b"=error\n" if command else b""
