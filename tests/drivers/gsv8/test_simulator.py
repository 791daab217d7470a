"""The simulated GSV-8, byte by byte: replies, limits, memory, counter, frames, faults."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.gsv8.frames import FrameLayout, StreamParser
from rigapp_drivers.gsv8.protocol import (
    Command,
    CounterMode,
    Quadrature,
    f32,
    request,
    u8,
    u16,
    u32,
)
from rigapp_drivers.gsv8.simulator import Gsv8Simulator
from rigapp_drivers.gsv8.simulator.state import HIGHEST_COUNT, LOWEST_COUNT, QuadratureInput
from rigapp_drivers.simulator_api import RigSignals, SimulatedDataSource

GOLDEN_DIALOGUE = [
    ("AA902385", "AA500085"),
    ("AA902585", "AA500085"),
    ("AA91010085", "AA54004873000285"),
    ("AA91010285", "AA5400487B000285"),
    ("AA91010185", "AA54004873000285"),
    ("AA902B85", "AA54000001003885"),
    ("AA901F85", "AA540001330F4085"),
    ("AA92A201FF85", "AA5500010000015E85"),
    ("AA92A3030385", "AA500085"),
    ("AA92A203FF85", "AA550003000F424085"),
    ("AA91140185", "AA54004060000085"),
    ("AA9515034120000085", "AA500085"),
    ("AA91690085", "AA5400000000C985"),
    ("AA956A000000003A85", "AA500085"),
    ("AA91690085", "AA54000000003B85"),
    ("AA956A020000000085", "AA500085"),
    ("AA934A00000585", "AA500085"),
    ("AA91490085", "AA5200000585"),
    ("AA91800185", "AA5200000385"),
    ("AA938101000385", "AA500085"),
    ("AA91800285", "AA52000A0285"),
    ("AA948B447A000085", "AA500085"),
    ("AA908A85", "AA5400447A000085"),
    ("AA91630085", "AA5400463B800085"),
    ("AA948B463B800085", "AA500085"),
    ("AA910C0085", "AA500085"),
    ("AA91350185", "AA500085"),
    ("AA91350085", "AA500085"),
    ("AA91420185", "AA54000000000085"),
    ("AA91430085", "AA560000000000000085"),
    ("AA900085", "AA500085"),
    ("AA90EE85", "AA504085"),
    ("AAB023A685", "AA7000A285"),
    ("AAB023A785", "AA70436C85"),
    ("AA907A85", "AA500085"),
]


def _ask(simulator: Gsv8Simulator, command: int, parameters: bytes = b"") -> bytes:
    return simulator.receive(request(command, parameters), 0.0)


def _status(simulator: Gsv8Simulator, command: int, parameters: bytes = b"") -> int:
    return _ask(simulator, command, parameters)[2]


def _objects(simulator: Gsv8Simulator) -> int:
    return int.from_bytes(_ask(simulator, Command.GET_TX_MAPPING, u8(0))[3:5], "big")


def _highest_rate(simulator: Gsv8Simulator) -> float:
    reply = _ask(simulator, Command.READ_DATA_RATE_RANGE, u8(0))
    return float(struct.unpack(">f", reply[3:7])[0])


def _signals(count: int, value: float = 0.5, turns: float = 0.0, start: float = 0.0) -> RigSignals:
    return RigSignals({1: np.full(count, value)}, start + np.linspace(0.0, turns, count))


def _set_up_counter(simulator: Gsv8Simulator, flags: int = 0x3A, objects: int = 2) -> FrameLayout:
    assert _status(simulator, Command.WRITE_COUNTER_MODE, u8(0) + u32(flags)) == 0
    assert _status(simulator, Command.SET_TX_MAPPING, u8(0) + u16(objects)) == 0
    return FrameLayout(objects)


def _rows(data: bytes, layout: FrameLayout) -> np.ndarray:
    runs = StreamParser(layout).feed(data).runs
    return np.concatenate([run.values for run in runs], axis=1)


def test_golden_dialogue() -> None:
    simulator = Gsv8Simulator()
    protocol: SimulatedDataSource = simulator
    for sent, golden in GOLDEN_DIALOGUE:
        reply = protocol.receive(bytes.fromhex(sent), 0.0).hex().upper()
        assert reply == golden, sent


def test_vendors_checksum_vector() -> None:
    simulator = Gsv8Simulator()
    _ask(simulator, Command.STOP_TRANSMISSION)
    reply = simulator.receive(bytes.fromhex("AAB10108AC85"), 0.0)
    assert reply.hex().upper() == "AA7400C8730002B985"


def test_it_powers_up_streaming_eight_floats_ten_times_a_second() -> None:
    simulator = Gsv8Simulator()
    assert simulator.streaming
    assert simulator.sample_rate_Hz == 10.0
    data = simulator.sample(_signals(3), 0.1)
    assert len(data) == 3 * 36
    assert _rows(data, FrameLayout(8))[0].tolist() == pytest.approx([0.5] * 3, abs=1e-6)


@pytest.mark.parametrize(
    ("command", "parameters", "status"),
    [
        (Command.GET_INTERFACE, b"", 0x5B),
        (Command.GET_INTERFACE, u8(3), 0x56),
        (Command.GET_INTERFACE, u8(0x10), 0x53),
        (Command.READ_USER_SCALE, u8(0), 0x51),
        (Command.READ_USER_SCALE, u8(11), 0x51),
        (Command.WRITE_USER_SCALE, u8(1) + f32(float("nan")), 0x52),
        (Command.SET_INPUT_TYPE, u8(9, 0), 0x51),
        (Command.SET_INPUT_TYPE, u8(1, 7), 0x52),
        (Command.GET_INPUT_TYPE, u8(1, 0x20), 0x52),
        (Command.SET_TX_MAPPING, u8(0) + u16(1), 0x55),
        (Command.SET_TX_MAPPING, u8(0) + u16(9), 0x54),
        (Command.SET_TX_MAPPING, u8(1) + u16(5), 0x51),
        (Command.SET_TX_MODE, u8(1) + u16(0x10), 0x52),
        (Command.SET_TX_MODE, u8(2) + u16(5), 0x76),
        (Command.GET_TX_MODE, u8(3), 0x51),
        (Command.WRITE_DATA_RATE, f32(961.0), 0x52),
        (Command.WRITE_DATA_RATE, f32(16000.0), 0x64),
        (Command.READ_DATA_RATE_RANGE, u8(2), 0x51),
        (Command.WRITE_COUNTER_MODE, u8(0x20) + u32(0), 0x51),
        (Command.WRITE_COUNTER_MODE, u8(0) + u32(1 << 20), 0x53),
        (Command.SET_MODE, u32(1 << 30), 0x53),
        (Command.SET_ZERO, u8(9), 0x51),
        (Command.SET_INJECTION, u8(4), 0x52),
        (Command.GET_LAST_PROTOCOL_ERROR, u8(2), 0x51),
        (Command.GET_LAST_VALUE_ERROR, u8(84), 0x51),
        (Command.READ_INTERFACE_SETTING, u8(5), 0x51),
        (Command.GET_DIO_DIRECTION, u8(5), 0x51),
        (0x10, u8(1, 0), 0x40),
    ],
)
def test_limits_of_commands(command: int, parameters: bytes, status: int) -> None:
    simulator = Gsv8Simulator()
    writes = simulator.eeprom_writes
    assert _status(simulator, command, parameters) == status
    if status:
        assert simulator.eeprom_writes == writes
        assert _ask(simulator, Command.GET_LAST_PROTOCOL_ERROR, u8(0))[3:7] == u32(status)


def test_broken_requests_are_ignored_and_remembered() -> None:
    simulator = Gsv8Simulator()
    assert simulator.receive(bytes.fromhex("00AA902386"), 0.0) == b""
    assert simulator.receive(bytes.fromhex("AA902385"), 0.0) == bytes.fromhex("AA500085")
    assert _ask(simulator, Command.GET_LAST_PROTOCOL_ERROR, u8(1))[3:7] == u32(0x42)
    _ask(simulator, Command.RESET_STATUS)
    assert _ask(simulator, Command.GET_LAST_PROTOCOL_ERROR, u8(1))[3:7] == u32(0)


def test_parameters_that_come_too_late() -> None:
    simulator = Gsv8Simulator()
    assert simulator.receive(bytes.fromhex("AA948B43"), 0.0) == b""
    assert simulator.receive(bytes.fromhex("FA000085"), 0.1) == bytes.fromhex("AA500085")
    assert simulator.receive(bytes.fromhex("AA948B43"), 1.0) == b""
    assert simulator.receive(bytes.fromhex("AA902385"), 1.3).startswith(bytes.fromhex("AA505A85"))


@given(st.binary(max_size=60), st.lists(st.integers(0, 60), max_size=5))
def test_any_bytes_from_the_host_are_borne(data: bytes, cuts: list[int]) -> None:
    simulator = Gsv8Simulator()
    for start, end in zip([0, *sorted(cuts)], [*sorted(cuts), len(data)], strict=True):
        simulator.receive(data[start:end], 0.0)
    simulator.receive(bytes(20), 1.0)
    assert simulator.receive(bytes.fromhex("AA902385"), 9.0).endswith(bytes.fromhex("AA500085"))


def test_memory_counts_its_writes_and_survives_a_power_cut() -> None:
    simulator = Gsv8Simulator()
    _ask(simulator, Command.STOP_TRANSMISSION)
    _ask(simulator, Command.WRITE_DATA_RATE, f32(1000.0))
    _ask(simulator, Command.WRITE_DATA_RATE, f32(1000.0))
    assert simulator.eeprom_writes == 2
    _ask(simulator, Command.GET_INTERFACE, u8(8))
    simulator.inject("reset")
    assert len(simulator.sample(_signals(1), 1.0)) == 36
    assert simulator.sample_rate_Hz == 1000.0


def test_input_type_reloads_scale_and_offset() -> None:
    simulator = Gsv8Simulator()
    _ask(simulator, Command.WRITE_USER_SCALE, u8(1) + f32(99.0))
    _ask(simulator, Command.WRITE_USER_OFFSET, u8(1) + f32(1.0))
    _ask(simulator, Command.SET_INPUT_TYPE, u8(0, 2))
    assert simulator.settings.scales[:8] == [7.0] * 8
    assert simulator.settings.offsets[0] == 0.0


def test_counters_change_the_number_of_objects() -> None:
    simulator = Gsv8Simulator()
    assert _objects(simulator) == 8
    _ask(simulator, Command.WRITE_COUNTER_MODE, u8(0x00) + u32(0x3A))
    _ask(simulator, Command.WRITE_COUNTER_MODE, u8(0x10) + u32(0x3A))
    assert _objects(simulator) == 10
    assert _status(simulator, Command.SET_TX_MAPPING, u8(0) + u16(2)) == 0x55
    assert _status(simulator, Command.SET_TX_MAPPING, u8(0) + u16(3)) == 0
    _ask(simulator, Command.WRITE_COUNTER_MODE, u8(0x10) + u32(0x38))
    assert _objects(simulator) == 2


def test_digital_lines_keep_what_is_written() -> None:
    simulator = Gsv8Simulator()
    _ask(simulator, Command.SET_DIO_DIRECTION, u8(3, 0))
    assert _ask(simulator, Command.GET_DIO_DIRECTION, u8(3))[3] == 0
    _ask(simulator, Command.WRITE_DIO_THRESHOLD, u8(1, 1) + f32(2.5))
    assert _ask(simulator, Command.READ_DIO_THRESHOLD, u8(1, 1))[3:7] == f32(2.5)


def test_highest_rate_follows_format_and_counter() -> None:
    simulator = Gsv8Simulator()
    assert _highest_rate(simulator) == 12000.0
    _ask(simulator, Command.SET_TX_MODE, u8(1) + u16(2))
    assert _highest_rate(simulator) == 24000.0
    _ask(simulator, Command.SET_TX_MODE, u8(1) + u16(1))
    assert _highest_rate(simulator) == 48000.0
    _ask(simulator, Command.WRITE_COUNTER_MODE, u8(0) + u32(0x3A))
    assert _highest_rate(simulator) == 16000.0
    uart = Gsv8Simulator(usb=False, uart_baud_rate=115200)
    _set_up_counter(uart, objects=5)
    assert _ask(uart, Command.READ_DATA_RATE_RANGE, u8(0))[3:7] == f32(480.0)
    fast = Gsv8Simulator(usb=False, uart_baud_rate=460800)
    _set_up_counter(fast, objects=5)
    assert _ask(fast, Command.READ_DATA_RATE_RANGE, u8(0))[3:7] == f32(1920.0)


@pytest.mark.parametrize(("kind", "code"), [(2, "BCF3CF"), (1, "BCF3")])
def test_half_scale_test_value(kind: int, code: str) -> None:
    simulator = Gsv8Simulator()
    _ask(simulator, Command.STOP_TRANSMISSION)
    simulator.sample(_signals(5), 0.0)
    _ask(simulator, Command.SET_INJECTION, u8(1))
    simulator.sample(_signals(5), 0.1)
    frame = _ask(simulator, Command.GET_VALUE)
    assert _rows(frame, FrameLayout(8))[0, 0] == pytest.approx(1.75, rel=1e-6)
    _ask(simulator, Command.SET_TX_MODE, u8(1) + u16(kind))
    frame = _ask(simulator, Command.GET_VALUE).hex().upper()
    assert frame[6 : 6 + len(code)] == code
    _ask(simulator, Command.SET_INJECTION, u8(0))
    simulator.sample(_signals(1), 0.2)
    assert _ask(simulator, Command.GET_VALUE).hex().upper()[6:] != frame[6:]
    _ask(simulator, Command.START_TRANSMISSION)
    assert _ask(simulator, Command.GET_VALUE) == b""


def test_saturation_bit_and_value_error() -> None:
    simulator = Gsv8Simulator()
    values = np.array([3.0, 3.7, -3.7, 0.0])
    data = simulator.sample(RigSignals({2: values}, np.zeros(4)), 61.0)
    assert [data[36 * n + 2] for n in range(4)] == [0xB0, 0xB1, 0xB1, 0xB0]
    assert _rows(data, FrameLayout(8))[1].tolist() == pytest.approx([3.0, 3.675, -3.675, 0.0])
    fault = int.from_bytes(_ask(simulator, Command.GET_LAST_VALUE_ERROR, u8(1))[3:9], "big")
    assert fault >> 45 == 1
    assert fault >> 16 & 0x1FFFFFFF == 1
    assert fault & 0xFFFF == 0x0202
    assert _ask(simulator, Command.GET_LAST_VALUE_ERROR, u8(0))[3] == 1


def test_zero_acts_on_raw_values_before_user_scaling() -> None:
    simulator = Gsv8Simulator()
    simulator.sample(_signals(5, 0.5), 0.0)
    assert _status(simulator, Command.SET_ZERO, u8(1)) == 0
    _ask(simulator, Command.WRITE_USER_SCALE, u8(1) + f32(35.0))
    data = simulator.sample(_signals(5, 0.75), 0.1)
    assert _rows(data, FrameLayout(8))[0, -1] == pytest.approx(2.5, abs=1e-4)
    zero = struct.unpack(">i", _ask(simulator, Command.READ_ZERO, u8(1))[3:7])[0]
    assert zero == round(0.5 / 3.5 * 2**23 / 1.05)


# --- the counter ------------------------------------------------------------------------------


def _edges(turns: list[float], mode: CounterMode, home: int = 0, **faults: Any) -> list[int]:
    counter = QuadratureInput(3600)
    return counter.advance(np.array(turns), mode, home, index=faults.get("index", True)).tolist()


@pytest.mark.parametrize(
    ("quadrature", "turn"), [(Quadrature.X4, 3600), (Quadrature.X2, 1800), (Quadrature.X1, 900)]
)
def test_counts_per_turn(quadrature: Quadrature, turn: int) -> None:
    mode = CounterMode(quadrature=quadrature, use_index=False)
    counts = _edges([0.0, 0.25, 1.0, 2.5], mode)
    assert counts == [0, turn // 4, turn, turn * 5 // 2]
    with_index = CounterMode(quadrature=quadrature)
    assert _edges([0.0, 0.25, 1.0, 2.5], with_index) == [0, turn // 4, 0, turn // 2]


def test_index_loads_the_home_value_in_both_directions() -> None:
    mode = CounterMode()
    assert _edges([0.5, 0.999, 1.0, 1.1], mode, home=100) == [1800, 3596, 100, 460]
    assert _edges([0.1, 0.0, -0.1, -1.0, -1.25], mode) == [360, 0, -360, 0, -900]
    assert _edges([2.5, 1.999, 1.5], mode) == [9000, -4, -1800]


def test_missing_index_lets_the_counter_run_on() -> None:
    assert _edges([0.5, 1.5], CounterMode(), index=False) == [1800, 5400]


@given(st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=80), st.integers(1, 79))
def test_counting_in_pieces_is_counting_at_once(turns: list[float], cut: int) -> None:
    cut = min(cut, len(turns) - 1)
    mode = CounterMode()
    whole = QuadratureInput(3600).advance(np.array(turns), mode, 0, index=True)
    pieces = QuadratureInput(3600)
    first = pieces.advance(np.array(turns[:cut]), mode, 0, index=True)
    second = pieces.advance(np.array(turns[cut:]), mode, 0, index=True)
    assert np.concatenate((first, second)).tolist() == whole.tolist()


def test_wrap_and_saturation_at_the_end_of_the_range() -> None:
    turns = [0.0, (HIGHEST_COUNT + 1) / 3600.0 + 1e-6]
    wrapped = _edges(turns, CounterMode(use_index=False))
    assert wrapped == [0, LOWEST_COUNT]
    held = CounterMode(use_index=False, saturate=True)
    assert _edges([*turns, turns[1] - 1.0], held) == [0, HIGHEST_COUNT, HIGHEST_COUNT - 3600]
    assert _edges([-turn for turn in turns], held)[1] == -HIGHEST_COUNT - 1


@pytest.mark.parametrize(
    ("kind", "value", "change"),
    [("counter_slip", 3, 3), ("counter_slip", -2, -2)],
)
def test_a_slip_lasts_until_the_index(kind: str, value: float, change: int) -> None:
    simulator = Gsv8Simulator()
    layout = _set_up_counter(simulator)
    simulator.sample(_signals(2), 0.0)
    simulator.inject(kind, value=value)
    rows = _rows(simulator.sample(RigSignals({}, np.array([0.25, 0.5, 1.0, 1.5])), 0.1), layout)
    assert rows[1].tolist() == [900 + change, 1800 + change, 0, 1800]


def test_false_and_missing_index_and_stuck_counter() -> None:
    simulator = Gsv8Simulator()
    layout = _set_up_counter(simulator)
    simulator.sample(RigSignals({}, np.array([0.0, 0.25])), 0.0)
    simulator.inject("false_index")
    rows = _rows(simulator.sample(RigSignals({}, np.array([0.5, 1.0])), 0.1), layout)
    assert rows[1].tolist() == [900, 0]
    simulator.inject("missing_index")
    rows = _rows(simulator.sample(RigSignals({}, np.array([1.5, 2.5])), 0.2), layout)
    assert rows[1].tolist() == [1800, 5400]
    simulator.clear("missing_index")
    simulator.inject("stuck_counter")
    rows = _rows(simulator.sample(RigSignals({}, np.array([2.75, 3.5])), 0.3), layout)
    assert rows[1].tolist() == [5400, 5400]


# --- faults -----------------------------------------------------------------------------------


def test_the_test_value_is_there_at_once_and_goes_at_once() -> None:
    simulator = Gsv8Simulator()
    _ask(simulator, Command.STOP_TRANSMISSION)
    simulator.sample(_signals(3, 0.25), 0.0)

    def shown() -> float:
        return float(_rows(_ask(simulator, Command.GET_VALUE), FrameLayout(8))[0, 0])

    assert shown() == pytest.approx(0.25, abs=1e-6)
    _ask(simulator, Command.SET_INJECTION, u8(1))
    assert shown() == pytest.approx(1.75, abs=1e-6), "no sample came since"
    _ask(simulator, Command.SET_INJECTION, u8(0))
    assert shown() == pytest.approx(0.25, abs=1e-6)


def test_an_open_input_floats_to_one_side_and_is_named() -> None:
    simulator = Gsv8Simulator()
    signals = {1: np.full(3, np.inf), 2: np.full(3, -np.inf)}
    rows = _rows(simulator.sample(RigSignals(signals, np.zeros(3)), 0.0), FrameLayout(8))
    assert rows[0].tolist() == pytest.approx([1.05 * 3.5] * 3)
    assert rows[1].tolist() == pytest.approx([-1.05 * 3.5] * 3)
    simulator.sample(RigSignals(signals, np.zeros(3)), 0.1)
    simulator.sample(RigSignals({1: np.zeros(3)}, np.zeros(3)), 0.2)
    counts = _ask(simulator, Command.GET_LAST_VALUE_ERROR, u8(0))[3:5]
    assert counts == bytes((2, 2)), "one saturation, one broken wire, each noted once"
    fault = int.from_bytes(_ask(simulator, Command.GET_LAST_VALUE_ERROR, u8(1))[3:9], "big")
    assert (fault >> 45, fault & 0xFFFF) == (3, 0b1001)


def test_stuck_and_broken_inputs() -> None:
    simulator = Gsv8Simulator()
    simulator.sample(_signals(3, 0.5), 0.0)
    simulator.inject("stuck_input", value=1)
    simulator.inject("sensor_broken", value=2)
    rows = _rows(simulator.sample(_signals(3, 0.9), 0.1), FrameLayout(8))
    assert rows[0].tolist() == pytest.approx([0.5] * 3, abs=1e-6)
    fault = int.from_bytes(_ask(simulator, Command.GET_LAST_VALUE_ERROR, u8(1))[3:9], "big")
    assert fault >> 45 == 3
    assert fault & 0xFFFF == 0b1100
    simulator.clear("stuck_input")
    rows = _rows(simulator.sample(_signals(3, 0.9), 0.2), FrameLayout(8))
    assert rows[0].tolist() == pytest.approx([0.9] * 3, abs=1e-6)


def test_dropped_frames_and_overrun() -> None:
    faults = [{"kind": "dropped_frames", "value": 5}]
    simulator = Gsv8Simulator(faults=faults)
    assert len(simulator.sample(_signals(3), 0.0)) == 0
    assert len(simulator.sample(_signals(3), 0.1)) == 36
    assert _ask(simulator, Command.GET_LAST_PROTOCOL_ERROR, u8(1))[3:7] == u32(0)
    simulator.inject("overrun", value=1)
    assert len(simulator.sample(_signals(3), 0.2)) == 72
    assert _ask(simulator, Command.GET_LAST_PROTOCOL_ERROR, u8(1))[3:7] == u32(0x91)
    _ask(simulator, Command.RESET_STATUS)
    simulator.overrun(0.3)
    assert _ask(simulator, Command.GET_LAST_PROTOCOL_ERROR, u8(1))[3:7] == u32(0x91)


def test_slow_answers_come_with_the_next_samples() -> None:
    simulator = Gsv8Simulator()
    simulator.inject("slow_reply", target=Command.READ_DATA_RATE, count=1, value=0.5)
    assert simulator.receive(request(Command.READ_DATA_RATE), 0.0) == b""
    assert len(simulator.sample(_signals(1), 0.4)) == 36
    data = simulator.sample(_signals(1), 0.6)
    assert data.startswith(bytes.fromhex("AA54004120000085"))
    assert len(data) == 8 + 36


def test_unknown_faults_are_refused() -> None:
    with pytest.raises(ValueError, match="no_such_fault"):
        Gsv8Simulator().inject("no_such_fault")
    with pytest.raises(TypeError):
        Gsv8Simulator(faults=[{"kind": "garbage", "colour": 1}])


def test_high_speed_frames_wait_for_a_whole_frame() -> None:
    simulator = Gsv8Simulator()
    _set_up_counter(simulator, objects=5)
    _ask(simulator, Command.WRITE_DATA_RATE, f32(12000.0))
    _ask(simulator, Command.GET_INTERFACE, u8(2 | 4))
    first = simulator.sample(_signals(4), 0.0)
    assert len(first) == 4 + 15 * 4
    second = simulator.sample(_signals(2), 0.1)
    assert len(second) == 4 + 15 * 4
    rows = _rows(first + second, FrameLayout(5, high_speed=True))
    assert rows.shape == (5, 6)
    _ask(simulator, Command.GET_INTERFACE, u8(0))
    assert len(simulator.sample(_signals(2), 0.2)) == 48
