"""The Modbus transmitter: bytes of the specification, registers as numbers, few questions."""

from __future__ import annotations

import math
from typing import Any

import msgspec
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rigapp_drivers.api import ReplyTimeout, SettingRefused, SlowRequest, WrongDevice
from rigapp_drivers.modbus_sensor.driver import DRIVER, ModbusSensor
from rigapp_drivers.modbus_sensor.link import decode_reply, encode_request
from rigapp_drivers.modbus_sensor.registers import OWN, PRESETS, Register, questions, registers_of
from rigapp_drivers.modbus_sensor.simulator import ModbusSensorSimulator, crc16

REGISTERS: list[dict[str, Any]] = [
    {"quantity": "oil_temperature_C", "function": 3, "address": 10, "type": "i32", "scale": 1e-3},
    {"quantity": "oil_pressure_kPa", "function": 3, "address": 12, "type": "f32"},
    {"quantity": "flow_l_per_min", "function": 3, "address": 20, "type": "u16", "offset": -5.0},
    {"quantity": "level_mm", "address": 0, "scale": 0.5, "invalid": -32768},
]


def framed(body: str) -> bytes:
    """Return hexadecimal bytes with their checksum, low byte first."""
    data = bytes.fromhex(body)
    return data + crc16(data).to_bytes(2, "little")


def test_the_checksum_is_that_of_the_serial_line_specification() -> None:
    assert crc16(bytes.fromhex("0207")) == 0x1241  # its appendix B
    assert crc16(b"123456789") == 0x4B37


@pytest.mark.parametrize(
    ("function", "address", "count", "request_hex", "reply_hex", "words"),
    [  # the examples of the application protocol, 6.3 and 6.4, at address 17
        (3, 0x6B, 3, "1103006B0003", "110306022B00000064", (0x22B, 0, 0x64)),
        (4, 8, 1, "110400080001", "110402000A", (10,)),
    ],
)
def test_requests_and_replies_are_those_of_the_specification(
    function: int, address: int, count: int, request_hex: str, reply_hex: str, words: Any
) -> None:
    assert encode_request(17, function, address, count) == framed(request_hex)
    reply = decode_reply(framed(reply_hex), 17, function, count)
    assert reply is not None
    assert reply.words == words


def test_what_is_no_answer_is_told_as_that() -> None:
    good = framed("110402000A")
    assert decode_reply(good[:-1], 17, 4, 1) is None
    spoiled = bytes((good[0], good[1], good[2], good[3], good[4] ^ 1, *good[5:]))
    for data, device, count, words in (
        (spoiled, 17, 1, "checksum"),
        (good, 18, 1, "device 17"),
        (good, 17, 2, "1 words to function 4 instead of 2"),
    ):
        reply = decode_reply(data, device, 4, count)
        assert reply is not None
        assert words in reply.wrong
    refused = decode_reply(framed("118402"), 17, 4, 1)
    assert refused is not None
    assert refused.exception == "a refusal ‹exception 2, illegal data address›"


@given(st.binary(max_size=20), st.integers(0, 300))
@example(framed("110402000A"), 7)
def test_no_bytes_upset_the_simulator_and_spoiled_ones_get_no_answer(data: bytes, bit: int) -> None:
    simulator = ModbusSensorSimulator(address=17, preset=OWN, registers=REGISTERS)
    simulator.receive(data, 0.0)
    request = bytearray(encode_request(17, 4, 0, 1))
    assert simulator.receive(bytes(request), 1.0)
    request[bit // 8 % len(request)] ^= 1 << bit % 8
    assert simulator.receive(bytes(request), 2.0) == b""


@pytest.mark.parametrize(
    ("request_hex", "reply_hex"),
    [("010100010002", "018101"), ("010400010003", "018402"), ("010400010000", "018403")],
    ids=["illegal function", "illegal address", "illegal count"],
)
def test_the_simulator_refuses_by_exceptions(request_hex: str, reply_hex: str) -> None:
    assert ModbusSensorSimulator().receive(framed(request_hex), 0.0) == framed(reply_hex)


def test_the_usual_transmitter_tells_tenths() -> None:
    simulator = ModbusSensorSimulator()
    simulator.observe({"temperature_C": -12.34, "humidity_percent": 55.5})
    reply = simulator.receive(bytes.fromhex("010400010002200B"), 0.0)
    assert reply == framed("010404FF85022B")
    (question,) = questions(PRESETS["SHT20"])
    told = question.values((0xFF85, 0x022B))
    assert told == pytest.approx({"temperature_C": -12.3, "humidity_percent": 55.5})


@pytest.mark.parametrize("kind", ["i16", "u16", "i32", "f32"])
@pytest.mark.parametrize("words", ["high first", "low first"])
def test_a_register_gives_back_what_it_was_given(kind: Any, words: Any) -> None:
    one = Register(
        quantity="x_V", address=0, type=kind, scale=0.25, offset=1.0, words=words, invalid=9
    )
    assert one.value(one.encode(101.25)) == 101.25
    assert math.isnan(one.value(one.encode(1.0 + 9 * 0.25)))


def test_neighbours_share_a_request_and_others_do_not() -> None:
    asked = questions(registers_of({"preset": OWN, "registers": REGISTERS}))
    assert [(one.function, one.address, one.count) for one in asked] == [
        (3, 10, 4),
        (3, 20, 1),
        (4, 0, 1),
    ]


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"preset": OWN, "registers": []}, "at least one entry"),
        ({"preset": "SHT20", "registers": REGISTERS}, "take them out"),
        ({"preset": OWN, "registers": [{"address": 1}]}, "entry 1: .*quantity"),
        ({"preset": OWN, "registers": [{**REGISTERS[0], "adress": 1}]}, "entry 1: .*adress"),
        ({"preset": OWN, "registers": [{**REGISTERS[0], "function": 6}]}, "entry 1: .*function"),
        ({"preset": OWN, "registers": [{**REGISTERS[0], "scale": 0.0}]}, "scale = 0"),
        ({"preset": OWN, "registers": [REGISTERS[0], REGISTERS[0]]}, "twice"),
        ({}, "the device does not report oil_C; its settings give temperature_C, humidity"),
    ],
)
def test_registers_that_are_none_are_refused_before_a_port_is_opened(
    settings: dict[str, Any], words: str
) -> None:
    assert DRIVER.check is not None
    with pytest.raises(ValueError, match=words):
        DRIVER.check(SlowRequest(("oil_C",), settings=settings))


def sensor(wire: Any, settings: dict[str, Any], **options: Any) -> tuple[Any, ModbusSensor]:
    """Return a simulated transmitter and a driver on its wire."""
    simulator = ModbusSensorSimulator(**options)
    port = wire(simulator.receive, lambda now_s: simulator.receive(b"", now_s)).port
    return simulator, ModbusSensor("climate", port, settings)


def test_own_registers_are_read_in_few_requests(wire: Any) -> None:
    own = {"preset": OWN, "registers": REGISTERS, "address": 17}
    simulator, driver = sensor(wire, own, **own)
    values = {
        "oil_temperature_C": 61.234,
        "oil_pressure_kPa": 250.5,
        "flow_l_per_min": 7.0,
        "level_mm": -3.5,
    }
    simulator.observe(values)
    try:
        driver.open()
        assert driver.read() == pytest.approx(values)
        told = driver.configure(SlowRequest(("level_mm",)))
        assert told["level_mm"] == "function 4, address 0, i16, scale 0.5"
        assert driver.read() == {"level_mm": -3.5}
        simulator.inject("sensor_broken")
        assert math.isnan(driver.read()["level_mm"])
        with pytest.raises(SettingRefused, match="the device does not report wind_m_per_s"):
            driver.configure(SlowRequest(("wind_m_per_s",)))
    finally:
        driver.close()


def test_a_register_that_the_device_lacks_makes_it_another_device(wire: Any) -> None:
    _, driver = sensor(wire, {"preset": OWN, "registers": REGISTERS})
    with pytest.raises(
        WrongDevice, match=r"exception 2, illegal data address›; check the settings"
    ):
        driver.open()
    driver.close()


def test_a_read_ends_within_the_time_that_was_asked_for(wire: Any) -> None:
    simulator, driver = sensor(wire, {"reply_timeout_s": 5.0})
    try:
        driver.open()
        driver.configure(SlowRequest(("temperature_C",), timeout_s=0.2))
        simulator.inject("no_reply")
        with pytest.raises(ReplyTimeout, match="no answer from the device at Modbus address 1"):
            driver.read()
        assert driver.counters()["retries"] == 0
    finally:
        driver.close()


def test_a_late_answer_is_never_taken_for_that_to_the_next_question(wire: Any) -> None:
    own = {"preset": OWN, "registers": REGISTERS, "reply_timeout_s": 0.5}
    simulator, driver = sensor(wire, own, preset=OWN, registers=REGISTERS)
    simulator.observe({"flow_l_per_min": 7.0, "level_mm": 3.0})
    try:
        driver.open()
        for slow, asked, value in ((3, "flow_l_per_min", 7.0), (4, "level_mm", 3.0)):
            simulator.inject("slow_reply", value=0.7, target=slow, count=1)
            driver.configure(SlowRequest((asked,)))
            assert driver.read() == {asked: value}
    finally:
        driver.close()


def test_a_register_is_plain_data() -> None:
    assert msgspec.convert(REGISTERS[3], Register) == Register(
        quantity="level_mm", address=0, scale=0.5, invalid=-32768
    )
