"""A line whose answers come late, once and always: right values, or the sentence on the time-out.

The devices here are a few lines of their own, written from the protocols and not from the drivers:
each question gets its answer after its delay, in the order of asking, as a gateway gives them.
"""

from __future__ import annotations

import struct
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any, Final

import pytest

from rigapp_drivers.api import DeviceError, SlowRequest
from rigapp_drivers.cia402.network import CanNode
from rigapp_drivers.dataq.link import Link as DataqLink
from rigapp_drivers.dataq.protocol import Info, line
from rigapp_drivers.gsv8.link import Link as Gsv8Link
from rigapp_drivers.gsv8.protocol import Command
from rigapp_drivers.gsv8.registers import Registers, scale
from rigapp_drivers.modbus_sensor.driver import ModbusSensor
from rigapp_drivers.modbus_sensor.registers import OWN
from rigapp_drivers.transport import SerialPort

TIMEOUT_S: Final = 0.1
DELAYS: Final = (0.05, 0.5, 0.95, 1.05, 1.25, 1.5, 1.75, 2.0)
"""In time-outs."""
NAMED_DELAYS: Final = [
    pytest.param(one, marks=() if one in (0.95, 1.25, 3.2) else pytest.mark.long)
    for one in (*DELAYS, 3.2)
]
"""For lines whose answers name their question, where there is less to go wrong."""
OIL, AIR = 715, 220


class LateLine:
    """Answer each question after a delay in s, one after the other.

    answer: of one question, None while it is not whole. delay_s: of the n-th question.
    """

    def __init__(
        self, answer: Callable[[bytes], bytes | None], delay_s: Callable[[int], float]
    ) -> None:
        self.questions: list[bytes] = []
        self._answer, self._delay_s = answer, delay_s
        self._due: deque[tuple[float, bytes]] = deque()
        self._rest = b""
        self._lock = threading.Lock()

    def respond(self, data: bytes, now_s: float) -> bytes:
        """Take bytes of the host."""
        with self._lock:
            self._rest += data
            answer = self._answer(self._rest)
            if answer is not None:
                delay_s = self._delay_s(len(self.questions))
                self.questions.append(self._rest)
                self._rest = b""
                self._due.append((time.monotonic() + delay_s, answer))
        return b""

    def produce(self, now_s: float) -> bytes:
        """Give what is due, in the order of asking."""
        with self._lock:
            parts = []
            while self._due and self._due[0][0] <= time.monotonic():
                parts.append(self._due.popleft()[1])
        return b"".join(parts)


def crc(data: bytes) -> bytes:
    """Return the checksum of Modbus RTU, bit by bit."""
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return struct.pack("<H", value)


def modbus(question: bytes) -> bytes | None:
    """Answer the read of one register: 10 is the oil's temperature, 40 the air's."""
    if len(question) < 8:
        return None
    device, function, address, count = struct.unpack(">BBHH", question[:6])
    value = {10: OIL, 40: AIR}.get(address, 0)
    body = struct.pack(">BBB", device, function, 2 * count) + struct.pack(">H", value)
    return body + crc(body)


def gsv8(question: bytes) -> bytes | None:
    """Answer the scale of a channel (14) by its number, a write (15) by "done"."""
    if len(question) < 4 or question[-1] != 0x85:
        return None
    if question[2] == 0x14:
        return b"\xaa\x54\x00" + struct.pack(">f", float(question[3])) + b"\x85"
    return b"\xaa\x50\x00\x85"


def slcan(question: bytes) -> bytes | None:
    """Answer the commands of an adapter, and SDOs: what is read is the object's own number."""
    if not question.endswith(b"\r"):
        return None
    answers = b""
    for frame in question.decode("ascii").split("\r")[:-1]:
        if not frame.startswith("t601"):
            answers += b"z\r" if frame.startswith("t") else b"\r"
            continue
        data = bytes.fromhex(frame[5:])
        if data[0] == 0x80:
            continue
        reads = data[0] >> 5 == 2
        reply = bytes((0x43 if reads else 0x60,)) + data[1:4]
        reply += struct.pack("<HBx", *struct.unpack("<HB", data[1:4])) if reads else bytes(4)
        answers += b"t5818" + reply.hex().upper().encode() + b"\r"
    return answers


def dataq(question: bytes) -> bytes | None:
    """Answer a query by its number and ten times that, every other command by its echo."""
    if not question.endswith(b"\r"):
        return None
    lines = question.decode("ascii").split("\r")[:-1]
    answers = (
        f"{line} {10 * int(line.split()[1])}" if line.startswith("info") else line for line in lines
    )
    return "".join(f"{line}\r\0" for line in answers).encode()


def once(delay_s: float, number: int) -> Callable[[int], float]:
    """Return delays of which only that of one question is long."""
    return lambda asked: delay_s if asked == number else 0.0


def always(delay_s: float, number: int) -> Callable[[int], float]:
    """Return the same delay for each question."""
    return lambda asked: delay_s


KINDS: Final = (once, always)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("delay", DELAYS)
def test_modbus_never_gives_the_value_of_another_register(
    wire: Any, delay: float, kind: Callable[[float, int], Callable[[int], float]]
) -> None:
    line = LateLine(modbus, kind(delay * TIMEOUT_S, 5))
    registers = [
        {"quantity": name, "address": address, "function": 4}
        for name, address in (("oil_C", 10), ("air_C", 40))
    ]
    settings = {"preset": OWN, "registers": registers, "reply_timeout_s": TIMEOUT_S}
    sensor = ModbusSensor("oil", wire(line.respond, line.produce).port, settings)
    right, sentences = 0, list[str]()
    try:
        sensor.open()
        for name, value in (("oil_C", OIL), ("air_C", AIR)) * 5:
            sensor.configure(SlowRequest((name,), timeout_s=0.5))
            try:
                assert sensor.read() == {name: value}
                right += 1
            except DeviceError as error:
                sentences.append(error.sentence)
    finally:
        sensor.close()
    assert all("reply_timeout_s" in one for one in sentences)
    assert right >= 9


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("delay", DELAYS)
def test_gsv8_never_takes_the_answer_to_another_question_and_writes_once(
    wire: Any, delay: float, kind: Callable[[float, int], Callable[[int], float]]
) -> None:
    line = LateLine(gsv8, kind(delay * TIMEOUT_S, 3))
    port = SerialPort("daq", wire(line.respond, line.produce).port, 115200)
    port.open()
    link = Gsv8Link(port, TIMEOUT_S)
    try:
        for channel in (1, 2, 3, 4, 5, 6):
            data = link.command(Command.READ_USER_SCALE, bytes((channel,)), reply=4)
            assert struct.unpack(">f", data) == (channel,)
            if channel % 2:
                Registers(link, (1, 56)).set(scale(channel), 1.0)
    finally:
        port.close()
    writes = [one for one in line.questions if one[2] == 0x15]
    assert len(writes) == 3


@pytest.mark.sampled(every=2)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("delay", NAMED_DELAYS)
def test_canopen_never_gives_the_value_of_another_object(
    wire: Any, delay: float, kind: Callable[[float, int], Callable[[int], float]]
) -> None:
    begun = [False]

    def delay_s(number: int) -> float:
        return kind(delay * TIMEOUT_S, 8)(number) if begun[0] else 0.0

    late = LateLine(slcan, delay_s)
    options = {
        "interface": "slcan",
        "channel": wire(late.respond, late.produce).port,
        "bitrate": 500_000,
        "sleep_after_open": 0.0,
        "timeout": 0.01,
    }
    node = CanNode("drive", str(options["channel"]), 1, options, TIMEOUT_S)
    right, sentences = 0, list[str]()
    try:
        node.open()
        node.tries = 3
        begun[0] = True
        for index, subindex in ((0x6041, 0), (0x606C, 0), (0x6064, 0), (0x1016, 1)) * 3:
            try:
                assert node.read(index, subindex) & 0xFFFF == index
                node.write(0x60FF, 7)
                right += 1
            except DeviceError as error:
                sentences.append(error.sentence)
    finally:
        node.close()
    assert right >= 11 or (kind is always and delay > 1.9)
    assert all("set sdo_timeout_ms to" in one for one in sentences[1:])


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("delay", NAMED_DELAYS)
def test_dataq_never_takes_the_answer_to_another_command(
    wire: Any, delay: float, kind: Callable[[float, int], Callable[[int], float]]
) -> None:
    late = LateLine(dataq, kind(delay * TIMEOUT_S, 2))
    port = SerialPort("daq", wire(late.respond, late.produce).port, 115200)
    port.open()
    link = DataqLink(port, TIMEOUT_S, 0.0)
    right, sentences = 0, list[str]()
    try:
        for info in (Info.MODEL, Info.FIRMWARE, Info.SERIAL_NUMBER, Info.MASTER_CLOCK) * 3:
            try:
                assert link.query(info) == str(10 * info)
                link.set(line("srate", int(info)))
                right += 1
            except DeviceError as error:
                sentences.append(error.sentence)
    finally:
        port.close()
    assert right >= 11 or delay > 3.0
    assert all("set reply_timeout_s to" in one for one in sentences[1:])
