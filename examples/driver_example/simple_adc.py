"""Acquire from an imaginary voltage meter, the Acme SimpleADC: a worked example of a driver.

Commands are ASCII lines: ``ID?``, ``RATE 960``, ``RUN``, ``HALT``; the answer begins with ``=``.
A running device sends a line for each sample: its number (0 to 9999), two voltages in uV, and the
CRC-16 (XMODEM) of what stands before it, for example ``17 1234567 -7654321 6E9E``.
"""

from __future__ import annotations

import contextlib
import threading
import time
from binascii import crc_hqx
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rigapp import drivers
from rigapp.drivers import BytePort, SerialPort

INPUTS = ("analog_1", "analog_2")
RANGE_V = 10.0
NUMBERS = 10_000


def parse(line: bytes) -> tuple[int, int, int] | None:
    """Return number and voltages of a sample's line, None when its CRC is wrong."""
    body, _, check = line.rpartition(b" ")
    if check != b"%04X" % crc_hqx(body, 0):
        return None
    number, first, second = (int(word) for word in body.split())
    return number, first, second


def ask(line: BytePort, command: str, timeout_s: float) -> tuple[str, bytes]:
    """Return the answer to a command and the bytes behind it; raise ReplyTimeout."""
    line.write(f"{command}\n".encode())
    data = b"\n"
    deadline = time.monotonic() + timeout_s
    while (left := deadline - time.monotonic()) > 0.0:
        data += line.read_some(65536, left)
        _, mark, behind = data.partition(b"\n=")
        answer, end, rest = behind.partition(b"\n")
        if mark and end:
            return answer.decode("ascii", "replace").strip(), rest
    raise drivers.ReplyTimeout(line.device, line.port, f"no answer to {command}; check the cable.")


def identify(line: BytePort, timeout_s: float) -> drivers.Identity | None:
    """Return who answers ``ID?``, None when it is no SimpleADC; raise ReplyTimeout."""
    words = ask(line, "ID?", timeout_s)[0].split()
    if words[:2] != ["Acme", "SimpleADC"] or len(words) != 4:
        return None
    return drivers.Identity(words[0], words[1], words[2], words[3], line.port)


def probe(line: BytePort, timeout_s: float) -> drivers.Identity | None:
    """Ask for ``rigapp doctor`` who is there; nothing is set."""
    line.write(b"\n")  # ends what a question for another device has left
    line.read_some(4096, 0.05)
    with contextlib.suppress(drivers.ReplyTimeout):
        return identify(line, timeout_s)
    return None


class SimpleAdc:
    """One SimpleADC on a serial port; implements ``rigapp.drivers.DataSource``."""

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name, self.port, self._settings = name, port, settings
        self._line = SerialPort(name, port, 115200)
        self._turn = threading.Lock()  # one thread at a time reads the port
        self._channels: tuple[drivers.ChannelSpec, ...] = ()
        self._rate_Hz = 0.0
        self._running = False
        self._begin()

    def open(self) -> drivers.Identity:
        """Open the port, halt and identify the device; raise ConnectionFailed, WrongDevice."""
        self._line.open()
        try:
            self._ask("HALT")
            identity = identify(self._line, self._settings["reply_timeout_s"])
            if identity is None:
                raise drivers.WrongDevice(self.name, self.port, "what answers is no SimpleADC.")
        except drivers.ReplyTimeout as error:
            self._line.close()
            raise drivers.ConnectionFailed(self.name, self.port, error.sentence) from error
        except BaseException:
            self._line.close()
            raise
        return identity

    def configure(self, request: drivers.DataRequest) -> drivers.StreamSetup:
        """Set the rate and return what the device read back; raise SettingRefused."""
        self.stop()
        for name, wanted in request.inputs.items():
            if name not in INPUTS or wanted != ("voltage", RANGE_V):
                raise self._refused(f"{name}: there are {' and '.join(INPUTS)}, voltages of 10 V.")
        answer = self._ask(f"RATE {request.sample_rate_Hz:g}")
        if answer != f"{request.sample_rate_Hz:g}":
            raise self._refused(f"the rate {request.sample_rate_Hz:g} is answered by {answer!r}.")
        self._rate_Hz = request.sample_rate_Hz
        self._channels = tuple(
            drivers.ChannelSpec(name, "V", 1e-6, 0.0, -RANGE_V, RANGE_V) for name in request.inputs
        )
        return drivers.StreamSetup(self._channels, self._rate_Hz, {"sample_rate_Hz": answer})

    def start(self) -> None:
        """Start streaming; sample index and block sequence restart at 0."""
        if not self._channels:
            raise self._refused("it was not configured before the start.")
        self._begin()
        self._ask("RUN")
        self._running = True

    def read(self, timeout_s: float) -> drivers.Block | None:
        """Return the next Block, None when none came in time; raise DeviceLost."""
        deadline = time.monotonic() + timeout_s
        enough = max(1.0, self._rate_Hz * self._settings["block_s"])
        while self._running and len(self._samples) < enough:
            left = deadline - time.monotonic()
            if left <= 0.0:
                break
            with self._turn:
                self._take(self._line.read_some(65536, min(left, 0.05)))
        return self._block() if self._samples else None

    def zero(self, inputs: Sequence[str]) -> None:
        """Refuse: the device cannot zero its inputs."""
        raise self._refused("it cannot zero its inputs; the zero belongs to the calibration.")

    def stop(self) -> None:
        """Stop streaming; safe to call twice."""
        if self._running:
            self._running = False
            self._ask("HALT")

    def close(self) -> None:
        """Stop and release the port; never raises; safe to call twice."""
        with contextlib.suppress(drivers.DeviceError):
            self.stop()
        self._line.close()

    def _begin(self) -> None:
        self._rest = b""
        self._samples: list[tuple[int, int, int]] = []  # both voltages, lost before
        self._next = self._sequence = self._first = self._host_time_ns = 0

    def _ask(self, command: str) -> str:
        with self._turn:
            timeout_s = float(self._settings["reply_timeout_s"])
            answer, self._rest = ask(self._line, command, timeout_s)
        return answer

    def _take(self, data: bytes) -> None:
        """Cut lines and check them; what is missing is known by the samples' own numbers."""
        self._host_time_ns = time.monotonic_ns() if data else self._host_time_ns
        *lines, self._rest = (self._rest + data).split(b"\n")
        for sample in filter(None, map(parse, lines)):
            number, first, second = sample
            self._samples.append((first, second, (number - self._next) % NUMBERS))
            self._next = (number + 1) % NUMBERS

    def _block(self) -> drivers.Block:
        """Hand over the samples up to the next gap; a gap is flagged at the sample behind it."""
        gaps = [index for index, sample in enumerate(self._samples) if index and sample[2]]
        end = gaps[0] if gaps else len(self._samples)
        taken, self._samples = np.array(self._samples[:end], np.int32).T, self._samples[end:]
        lost, count = int(taken[2, 0]), taken.shape[1]
        quality = np.zeros(count, np.uint8)
        quality[0] = drivers.Quality.LOST_BEFORE if lost else drivers.Quality.GOOD
        block = drivers.Block(
            device=self.name,
            sequence=self._sequence,
            first_sample=self._first + lost,
            sample_rate_Hz=self._rate_Hz,
            host_time_ns=self._host_time_ns,
            values=taken[[INPUTS.index(spec.name) for spec in self._channels]],
            quality=quality,
            lost_before=lost,
        )
        self._sequence += 1
        self._first += lost + count
        return block

    def _refused(self, sentence: str) -> drivers.SettingRefused:
        return drivers.SettingRefused(self.name, self.port, sentence)


DRIVER = drivers.DriverInfo(
    name="simple_adc",
    title="Acme SimpleADC (imaginary)",
    kind=drivers.DriverKind.DATA_SOURCE,
    factory=SimpleAdc,
    settings={
        "sample_rate_Hz": drivers.SettingSpec(float, 960.0, "Samples per second.", 1.0, 2000.0),
        "block_s": drivers.SettingSpec(float, 0.02, "Time of a block of samples.", 0.001, 1.0),
        "reply_timeout_s": drivers.SettingSpec(
            float, 0.5, "Longest wait for an answer.", 0.05, 10.0
        ),
    },
    simulator="simple_adc_simulator:SimpleAdcSimulator",
    probe=drivers.Probe(probe),
)
