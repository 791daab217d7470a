"""Golden bytes of the GSV-8: the vendor's own vectors and frames encoded from its layout."""

from __future__ import annotations

import numpy as np
import pytest

from rigapp_drivers.gsv8 import protocol
from rigapp_drivers.gsv8.frames import (
    FrameLayout,
    Response,
    StreamParser,
    encode_frames,
    encode_response,
)
from rigapp_drivers.gsv8.numbers import DataType, decode, encode, scale_of_code
from rigapp_drivers.gsv8.protocol import (
    Command,
    CounterMode,
    crc8,
    crc16,
    crc16_of_rows,
    f32,
    u8,
    u16,
    u32,
)
from rigapp_drivers.gsv8.words import decode_value_fault, encode_value_fault, status_words

SENT_BY_THE_VENDORS_CLIENT = [
    ("AA902385", Command.STOP_TRANSMISSION, b""),
    ("AA902485", Command.START_TRANSMISSION, b""),
    ("AA908A85", Command.READ_DATA_RATE, b""),
    ("AA948B43FA000085", Command.WRITE_DATA_RATE, f32(500.0)),
    ("AA910C0185", Command.SET_ZERO, u8(1)),
]
REQUESTS = [
    *SENT_BY_THE_VENDORS_CLIENT,
    ("AA902585", Command.CLEAR_BUFFER, b""),
    ("AA91010085", Command.GET_INTERFACE, u8(0)),
    ("AA91010185", Command.GET_INTERFACE, u8(1)),
    ("AA902B85", Command.FIRMWARE_VERSION, b""),
    ("AA901F85", Command.GET_SERIAL_NUMBER, b""),
    ("AA92A201FF85", Command.GET_INPUT_TYPE, u8(1, 0xFF)),
    ("AA92A3030385", Command.SET_INPUT_TYPE, u8(3, protocol.InputType.SINGLE_ENDED)),
    ("AA92A203FF85", Command.GET_INPUT_TYPE, u8(3, 0xFF)),
    ("AA91140185", Command.READ_USER_SCALE, u8(1)),
    ("AA9515034120000085", Command.WRITE_USER_SCALE, u8(3) + f32(10.0)),
    ("AA91690085", Command.READ_COUNTER_MODE, u8(protocol.counter_index(0, 0))),
    ("AA956A000000003A85", Command.WRITE_COUNTER_MODE, u8(0) + u32(CounterMode().encode())),
    ("AA956A020000000085", Command.WRITE_COUNTER_MODE, u8(protocol.counter_index(0, 2)) + u32(0)),
    ("AA91490085", Command.GET_TX_MAPPING, u8(0)),
    ("AA934A00000585", Command.SET_TX_MAPPING, u8(0) + u16(5)),
    ("AA91800185", Command.GET_TX_MODE, u8(1)),
    ("AA938101000385", Command.SET_TX_MODE, u8(1) + u16(DataType.FLOAT32)),
    ("AA91800285", Command.GET_TX_MODE, u8(2)),
    ("AA948B463B800085", Command.WRITE_DATA_RATE, f32(12000.0)),
    ("AA91630085", Command.READ_DATA_RATE_RANGE, u8(0)),
    ("AA910C0085", Command.SET_ZERO, u8(0)),
    ("AA91350185", Command.SET_INJECTION, u8(1)),
    ("AA91420185", Command.GET_LAST_PROTOCOL_ERROR, u8(1)),
    ("AA91430085", Command.GET_LAST_VALUE_ERROR, u8(0)),
    ("AA900085", Command.RESET_STATUS, b""),
    ("AA907A85", Command.RELEASE_INTERFACE, b""),
    ("AA90EE85", 0xEE, b""),
]
RESPONSES = [
    ("AA500085", 0x00, ""),
    ("AA504085", 0x40, ""),
    ("AA540048 7B0002 85", 0, "487B0002"),
    ("AA540048 730002 85", 0, "48730002"),
    ("AA540000010038 85", 0, "00010038"),
    ("AA540001330F4085", 0, "01330F40"),
    ("AA5500010000015E85", 0, "010000015E"),
    ("AA550003000F424085", 0, "03000F4240"),
    ("AA5400406000 0085", 0, "40600000"),
    ("AA5400000000C985", 0, "000000C9"),
    ("AA5200000585", 0, "0005"),
    ("AA52000A0285", 0, "0A02"),
    ("AA5400447A000085", 0, "447A0000"),
    ("AA54000000009185", 0, "00000091"),
    ("AA560001000000000085", 0, "010000000000"),
]
ANALOG_AND_COUNTER = np.array([[0.5], [-0.25], [2.5], [-2.5], [1234.0]])
PAYLOAD = "3F000000BE80000040200000C0200000449A4000"
VENDORS_CHECKED_FRAME = (
    "AA37B0C1C7CD383FE6197E3FC0B60BBF497E954022DD1D3FB211533EE6C3723F92653BE76E85"
)


@pytest.mark.parametrize(("golden", "command", "parameters"), REQUESTS)
def test_request_bytes(golden: str, command: int, parameters: bytes) -> None:
    assert protocol.request(command, parameters) == bytes.fromhex(golden)


@pytest.mark.parametrize(("golden", "status", "data"), RESPONSES)
def test_response_bytes_in_both_directions(golden: str, status: int, data: str) -> None:
    response = Response(status, bytes.fromhex(data))
    assert encode_response(response) == bytes.fromhex(golden)
    assert StreamParser().feed(bytes.fromhex(golden)).responses == [response]


@pytest.mark.parametrize(
    ("golden", "command", "parameters"),
    [
        ("AAB10108AC85", Command.GET_INTERFACE, u8(8)),
        ("AAB023A685", Command.STOP_TRANSMISSION, b""),
        ("AAB48B43FA00008F85", Command.WRITE_DATA_RATE, f32(500.0)),
        ("AAB024B385", Command.START_TRANSMISSION, b""),
    ],
)
def test_request_with_checksum(golden: str, command: int, parameters: bytes) -> None:
    assert protocol.request(command, parameters, checksum=True) == bytes.fromhex(golden)


@pytest.mark.parametrize(
    ("golden", "status", "data"),
    [("AA7400C8730002B985", 0, "C8730002"), ("AA7000A285", 0, ""), ("AA70436C85", 0x43, "")],
)
def test_response_with_checksum(golden: str, status: int, data: str) -> None:
    response = Response(status, bytes.fromhex(data))
    assert encode_response(response, checksum=True) == bytes.fromhex(golden)
    assert StreamParser().feed(bytes.fromhex(golden)).responses == [response]


def test_check_values_of_both_checksums() -> None:
    assert crc8(b"123456789") == 0xF4
    assert crc16(b"123456789") == 0x4B37
    rows = np.frombuffer(b"123456789" * 3, dtype=np.uint8).reshape(3, 9)
    assert crc16_of_rows(rows).tolist() == [0x4B37] * 3


def test_vendors_frame_with_checksum() -> None:
    frame = bytes.fromhex(VENDORS_CHECKED_FRAME)
    layout = FrameLayout(objects=8, checksum=True)
    parser = StreamParser(layout)
    (run,) = parser.feed(frame).runs
    assert run.values.shape == (8, 1)
    assert encode_frames(run.values, layout).tobytes() == frame
    assert parser.tally.checksum_failures == 0
    assert crc16(frame[1:-3]) == 0x6EE7


@pytest.mark.parametrize(
    ("golden", "checksum", "saturated"),
    [
        (f"AA14B0{PAYLOAD}85", False, False),
        (f"AA14B1{PAYLOAD}85", False, True),
        (f"AA34B0{PAYLOAD}651C85", True, False),
    ],
)
def test_float_frames(golden: str, checksum: bool, saturated: bool) -> None:
    layout = FrameLayout(objects=5, checksum=checksum)
    frames = encode_frames(ANALOG_AND_COUNTER, layout, np.array([saturated]))
    assert frames.tobytes() == bytes.fromhex(golden)
    (run,) = StreamParser(layout).feed(bytes.fromhex(golden)).runs
    assert run.values.dtype == np.float32
    assert run.values.tolist() == ANALOG_AND_COUNTER.tolist()
    assert run.quality.tolist() == [int(saturated)]


@pytest.mark.parametrize(
    ("golden", "data_type"),
    [
        ("AA13A09E79E8430C319E79E861861885", DataType.INT24),
        ("AA13909E79430C9E79618685", DataType.INT16),
    ],
)
def test_integer_frames(golden: str, data_type: DataType) -> None:
    layout = FrameLayout(objects=4, data_type=data_type)
    (run,) = StreamParser(layout).feed(bytes.fromhex(golden)).runs
    assert run.values.dtype == np.int32
    normalised = run.values * scale_of_code(data_type, 1.0)
    step = scale_of_code(data_type, 1.0)
    assert normalised[:, 0] == pytest.approx([0.25, -0.5, 0.25, -0.25], abs=step)
    assert encode_frames(run.values, layout).tobytes() == bytes.fromhex(golden)


@pytest.mark.parametrize(
    ("x", "int16", "int24"),
    [
        (-1.05, "0000", "000000"),
        (-1.0, "0618", "061862"),
        (0.0, "8000", "800000"),
        (1.0, "F9E7", "F9E79E"),
        (1.05, "FFFF", "FFFFFF"),
    ],
)
def test_vendors_table_of_integers(x: float, int16: str, int24: str) -> None:
    code = np.clip(np.round(x * 2**23 / 1.05), -(2**23), 2**23 - 1).astype(np.int64)
    assert encode(np.array([[code]]), DataType.INT24).tobytes().hex().upper() == int24
    assert encode(np.array([[code >> 8]]), DataType.INT16).tobytes().hex().upper() == int16
    for text, data_type in ((int16, DataType.INT16), (int24, DataType.INT24)):
        payload = np.frombuffer(bytes.fromhex(text), dtype=np.uint8)[None, :]
        value = decode(payload, 1, data_type, offset_binary=True)[0, 0]
        step = scale_of_code(data_type, 1.0)
        assert value * step == pytest.approx(x, abs=1.01 * step)


@pytest.mark.parametrize("data_type", [DataType.INT16, DataType.INT24])
def test_twos_complement_where_the_interface_sends_it(data_type: DataType) -> None:
    codes = np.array([[-5, 0, 7, -(2 ** (data_type.bits - 1))]]).T
    payload = encode(codes, data_type)
    payload[:, :: data_type.width] ^= 0x80
    assert decode(payload, 4, data_type, offset_binary=False)[:, 0].tolist() == codes[:, 0].tolist()


def test_half_scale_code_is_half_of_the_range() -> None:
    value = protocol.HALF_SCALE_CODE * scale_of_code(DataType.INT24, 3.5)
    assert value == pytest.approx(1.75, rel=1e-6)
    payload = encode(np.array([[protocol.HALF_SCALE_CODE]]), DataType.INT24)
    assert payload.tobytes().hex().upper() == "BCF3CF"


def test_float_has_no_step() -> None:
    with pytest.raises(ValueError, match="scaled in the device"):
        scale_of_code(DataType.FLOAT32, 3.5)


def test_counter_mode_of_the_rig() -> None:
    mode = CounterMode()
    assert mode.encode() == 0x3A
    assert protocol.decode_counter_mode(0x3B) == mode
    default = protocol.decode_counter_mode(0xC9)
    assert default == CounterMode(
        on=False, quadrature=protocol.Quadrature.X1, use_index=False, saturate=True, store_last=True
    )
    every = CounterMode(True, protocol.Quadrature.X2, True, True, True, False, True, True)
    assert protocol.decode_counter_mode(every.encode()) == every


def test_interface_replies() -> None:
    reply = protocol.decode_interface(bytes.fromhex("C8730002"))
    assert reply.model == protocol.MODEL_GSV8
    assert reply.data_checksum
    assert (reply.objects, reply.transmitting, reply.data_type) == (8, False, 3)
    assert reply.encode() == bytes.fromhex("C8730002")
    setting = protocol.InterfaceSetting(5, 4, 115200, writable=True)
    assert protocol.decode_interface_setting(setting.encode()) == setting


def test_limits_of_the_frame() -> None:
    with pytest.raises(ValueError, match="15"):
        protocol.request(1, bytes(16))
    with pytest.raises(ValueError, match="14"):
        encode_response(Response(0, bytes(15)))


def test_allowed_rates_divide_the_converter_rate() -> None:
    assert len(protocol.ALLOWED_RATES_HZ) == len(set(protocol.ALLOWED_RATES_HZ)) == 62
    assert all(48000.0 % rate == 0 for rate in protocol.ALLOWED_RATES_HZ)
    assert protocol.neighbours_of_rate(3600.0) == (3200.0, 4000.0)
    assert protocol.neighbours_of_rate(0.5) == (1.0,)
    assert protocol.neighbours_of_rate(99999.0) == (48000.0,)


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (0x75, "another port"),
        (0x64, "data rate is too high"),
        (0xB3, "TEDS"),
        (0xEE, "unknown to this program"),
    ],
)
def test_status_words(code: int, words: str) -> None:
    assert words in status_words(code)
    assert f"{code:02X}" in status_words(code)


@pytest.mark.parametrize(
    ("kind", "flags", "words"),
    [
        (1, 0x0201, "channel 1 above its range, channel 2 below its range"),
        (2, 0x0004, "channel 3"),
        (3, 0b1001, "channel 1 Ud+, channel 2 Ud-"),
        (4, 0xFFFF, "unknown output"),
        (4, 0x0102, "current loop 2 open, driver 1 too hot"),
        (5, 0x8000, "DIO 16"),
        (6, 0x0001, "unknown kind ‹6, flags 0001›"),
        (1, 0, "no channel named"),
    ],
)
def test_value_faults_in_words(kind: int, flags: int, words: str) -> None:
    data = (kind << 45 | 123456 << 16 | flags).to_bytes(6, "big")
    fault = decode_value_fault(data)
    assert fault is not None
    assert words in fault.words
    assert fault.operating_minutes == 123456
    assert encode_value_fault(fault) == data


def test_no_value_fault() -> None:
    assert decode_value_fault(bytes(6)) is None


def test_software_options_in_words() -> None:
    assert protocol.software_options(1 << 11 | 1) == ("ADC", "CANopen")
