"""Replies with flipped bits, lost, added and swapped bytes: no wrong value is called a good one.

Each first reply to a question is spoiled, the next is right. Where a protocol has a check, damage
that its kind must find is never let through, and other damage as seldom as chance allows; where it
has none, the figure is the share that a driver cannot see.
"""

from __future__ import annotations

import random
import struct
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import Any, Final

import pytest

import rigapp_drivers.dataq.link
import rigapp_drivers.exchange
import rigapp_drivers.gsv8.link
import rigapp_drivers.modbus_sensor.link
import rigapp_drivers.roboclaw.link
from rigapp_drivers.api import DeviceError
from rigapp_drivers.cia402.network import CanNode
from rigapp_drivers.cia402.slcan import Frame, decode_frame, encode_frame
from rigapp_drivers.gsv8.frames import Response, encode_response
from rigapp_drivers.gsv8.protocol import Command as Gsv8Command
from rigapp_drivers.modbus_sensor.link import ModbusLink
from rigapp_drivers.roboclaw.link import Link as RoboClawLink
from rigapp_drivers.roboclaw.protocol import Command, crc16

VALUE: Final = 12345


class Clock:
    """A time that passes only while somebody waits for bytes that do not come."""

    def __init__(self) -> None:
        self.now_s = 1000.0

    def monotonic(self) -> float:
        """Return the time."""
        return self.now_s

    def monotonic_ns(self) -> int:
        """Return the time in ns."""
        return int(self.now_s * 1e9)

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        self.now_s += seconds


class SpoiltLine:
    """Answer each question by ``reply``; the first answer after ``spoil`` is damaged."""

    device, port, is_open = "device", "line", True

    def __init__(self, clock: Clock, reply: Callable[[bytes], bytes]) -> None:
        self.spoil: Callable[[bytes], bytes] | None = None
        self.clock, self._reply, self._waiting = clock, reply, b""

    def write(self, data: bytes) -> None:
        """Take a question."""
        answer, spoil = self._reply(data), self.spoil
        self.spoil = None
        self._waiting += answer if spoil is None else spoil(answer)

    def read_some(self, maximum: int, timeout_s: float) -> bytes:
        """Return what is there, or let the whole time-out pass."""
        data, self._waiting = self._waiting[:maximum], self._waiting[maximum:]
        if not data:
            self.clock.now_s += max(timeout_s, 1e-4)
        return data

    def drain(self) -> bytes:
        """Return what is there."""
        return self.read_some(1 << 16, 0.01)


def flip(rng: random.Random, data: bytes) -> bytes:
    """Flip one to three bits: every checksum of 8 bits and more finds that."""
    value = int.from_bytes(data, "big")
    for place in rng.sample(range(8 * len(data)), rng.randint(1, 3)):
        value ^= 1 << place
    return value.to_bytes(len(data), "big")


def tear(rng: random.Random, data: bytes) -> bytes:
    """Lose, add, swap or replace bytes, or cut the reply short."""
    place = rng.randrange(len(data))
    kind = rng.randrange(5)
    if kind == 0:
        return data[:place] + data[place + 1 :]
    if kind == 1:
        return data[:place] + bytes((rng.randrange(256),)) + data[place:]
    if kind == 2:
        return data[:place] + data[place : place + 2][::-1] + data[place + 2 :]
    if kind == 3:
        return data[:place] + rng.randbytes(min(3, len(data) - place)) + data[place + 3 :]
    return data[:place]


@dataclass(frozen=True, slots=True)
class Case:
    """One protocol: ask(line) -> value, which is VALUE where all is well.

    missed: the share of flipped, and of torn replies whose wrong value may be called good.
    """

    ask: Callable[[Any], Any]
    reply: Callable[[bytes], bytes]
    missed: tuple[float, float]


def modbus(question: bytes) -> bytes:
    """Answer a read of one input register."""
    body = struct.pack(">BBBH", question[0], question[1], 2, VALUE)
    return body + struct.pack("<H", modbus_crc(body))


def modbus_crc(data: bytes) -> int:
    """Return the checksum of Modbus RTU."""
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value


def roboclaw(question: bytes) -> bytes:
    """Answer a read of the main battery's voltage."""
    body = struct.pack(">H", VALUE)
    return body + struct.pack(">H", crc16(question[:2] + body))


def gsv8(checksum: bool) -> Callable[[bytes], bytes]:
    """Answer the read of a scale."""
    response = Response(0, struct.pack(">f", float(VALUE)))
    return lambda question: encode_response(response, checksum=checksum)


def ask_gsv8(checksum: bool) -> Callable[[Any], Callable[[], Any]]:
    """Read a scale."""

    def make(line: Any) -> Callable[[], Any]:
        link = rigapp_drivers.gsv8.link.Link(line, 0.1)
        link.checksum = checksum
        return lambda: struct.unpack(
            ">f", link.command(Gsv8Command.READ_USER_SCALE, b"\1", reply=4)
        )[0]

    return make


def dataq(question: bytes) -> bytes:
    """Answer a query."""
    return question.rstrip(b"\r") + f" {VALUE}\r\0".encode()


def ask_dataq(line: Any) -> Callable[[], Any]:
    """Read the model's number."""
    link = rigapp_drivers.dataq.link.Link(line, 0.1, 0.0)
    return lambda: int(link.query(rigapp_drivers.dataq.link.Info.MODEL))


def ask_modbus(line: Any) -> Callable[[], Any]:
    """Read a register."""
    link = ModbusLink(line, 1, 19200, 0.1)
    return lambda: link.read(4, 10, 1, line.clock.now_s + 5.0)[0]


def ask_roboclaw(line: Any) -> Callable[[], Any]:
    """Read the main battery's voltage."""
    link = RoboClawLink(line, "device", "line", 0x80, 115200, 0.1)
    return lambda: link.read(Command.MAIN_VOLTAGE)[0]


class Node(CanNode):
    """A node whose SDO requests go over a line as an slcan adapter's lines, there and back."""

    def __init__(self, line: Any) -> None:
        super().__init__("device", "line", 1, {"interface": "slcan"}, 1e-4)
        self.tries = 2
        self._line = line

    def send(self, identifier: int, data: bytes) -> None:
        """Send a frame, and deliver what comes."""
        self._line.write(encode_frame(Frame(identifier, bytes(data))))
        for text in self._line.read_some(1 << 10, 0.0).decode("latin-1").split("\r"):
            frame = decode_frame(text)
            if frame is not None and frame.identifier == 0x581 and not frame.extended:
                self._takers[0x581](frame.data, 0)

    def _check(self) -> None:
        """Do without a bus."""


def canopen(question: bytes) -> bytes:
    """Answer the read of an object; an abort gets no answer."""
    frame = decode_frame(question.decode("ascii").rstrip("\r"))
    assert frame is not None
    if frame.data[0] == 0x80:
        return b"\r"
    return encode_frame(Frame(0x581, b"\x43" + frame.data[1:4] + struct.pack("<I", VALUE)))


def ask_canopen(line: Any) -> Callable[[], Any]:
    """Read the motor's rated current."""
    node = Node(line)
    return lambda: node.read(0x6075)


CASES: Final = {
    "modbus": Case(ask_modbus, modbus, (0.0, 1e-4)),
    "roboclaw": Case(ask_roboclaw, roboclaw, (0.0, 1e-4)),
    "gsv8, checksum": Case(ask_gsv8(True), gsv8(True), (0.0, 0.02)),
    "gsv8": Case(ask_gsv8(False), gsv8(False), (0.9, 0.6)),
    "canopen, slcan": Case(ask_canopen, canopen, (0.3, 0.2)),
    "dataq": Case(ask_dataq, dataq, (0.6, 0.6)),
}
MODULES: Final[tuple[ModuleType, ...]] = (
    rigapp_drivers.dataq.link,
    rigapp_drivers.exchange,
    rigapp_drivers.gsv8.link,
    rigapp_drivers.modbus_sensor.link,
    rigapp_drivers.roboclaw.link,
)


@pytest.mark.sampled(every=2)
@pytest.mark.parametrize(
    "count", [1500, pytest.param(1_000_000, marks=[pytest.mark.soak, pytest.mark.timeout(3600)])]
)
@pytest.mark.parametrize("name", CASES)
def test_a_spoilt_reply_gives_the_value_of_the_next_or_an_error(
    name: str, count: int, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level("ERROR")
    case, clock, rng = CASES[name], Clock(), random.Random(count)
    for module in MODULES:
        monkeypatch.setattr(module, "time", clock)
    for damage, most in zip((flip, tear), case.missed, strict=True):
        line = SpoiltLine(clock, case.reply)
        ask = case.ask(line)
        wrong = 0
        for _ in range(count // 2):
            line.spoil = lambda answer, damage=damage: damage(rng, answer)
            try:
                wrong += ask() != VALUE
            except (DeviceError, ValueError):
                line.drain()
            clock.now_s += 10.0
        print(f"{name}, {damage.__name__}: {wrong} of {count // 2} wrong values called good")
        assert wrong <= most * count / 2, damage.__name__
