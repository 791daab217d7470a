"""The simulated instrument byte by byte, and its encoder clock against edges found by hand."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.dataq.simulator import COMMANDS, DataqSimulator
from rigapp_drivers.dataq.simulator.terminals import rising_edges
from rigapp_drivers.simulator_api import RigSignals, SimulatedDataSource


def _ask(simulator: DataqSimulator, *lines: bytes, now_s: float = 0.0) -> list[bytes]:
    return [simulator.receive(line, now_s) for line in lines]


def _signals(shaft: Any, **analog: Any) -> RigSignals:
    shaft = np.asarray(shaft, float)
    return RigSignals(
        {int(name[1:]): np.broadcast_to(v, shaft.shape) * 1.0 for name, v in analog.items()}, shaft
    )


def _words(data: bytes) -> list[int]:
    return list(struct.unpack(f"<{len(data) // 2}H", data))


def test_it_is_a_simulated_data_source() -> None:
    source: SimulatedDataSource = DataqSimulator(4108)
    assert not source.streaming
    with pytest.raises(KeyError):
        DataqSimulator(2008)
    with pytest.raises(ValueError, match="must be 'scans' or 'bytes'"):
        DataqSimulator(overrun_drops="frames")


@pytest.mark.parametrize(
    ("line", "reply"),
    [
        (b"info 1\r", b"info 1 4108\r"),
        (b"info 2\r", b"info 2 89\r"),
        (b"info 6\r", b"info 6 5A0C21F700\r"),
        (b"info 9\r\n", b"info 9 60000000\r"),
        (b"info 0 \r", b"info 0 DATAQ\r"),
        (b"slist 0 768\r", b"slist 0 768\r"),
        (b"slist 1 10\r", b"slist 1 10\r"),
        (b"slist 2 10\r", b""),
        (b"slist 0 1536\r", b""),
        (b"slist 0 11\r", b""),
        (b"srate 375\r", b"srate 375\r"),
        (b"srate 374\r", b""),
        (b"dec 513\r", b""),
        (b"deca 40000\r", b"deca 40000\r"),
        (b"filter 0 3\r", b"filter 0 3\r"),
        (b"filter 8 0\r", b""),
        (b"ps 8\r", b""),
        (b"ps 7\r", b"ps 7\r"),
        (b"encode 0\r", b"encode 0\r"),
        (b"stop\r", b"stop\r"),
        (b"reset 1\r", b"reset 1\r"),
        (b"reset 2\r", b""),
        (b"din\r", b"din 0\r"),
        (b"rrate\r", b"rrate 1000\r"),
        (b"start\r", b""),
        (b"start 7\r", b""),
        (b"bogus\r", b""),
        (b"srate x\r", b""),
        (b"\xff\xfe\r", b""),
    ],
)
def test_commands(line: bytes, reply: bytes) -> None:
    assert _ask(DataqSimulator(4108), line) == [reply]


def test_echoes_of_other_firmware() -> None:
    simulator = DataqSimulator(start_echo=True, echo_nuls=2)
    assert _ask(simulator, b"dec 1\r", b"start 2\r", b"dec 1\r", b"stop\r") == [
        b"dec 1\r\0\0",
        b"start 2\r\0\0",
        b"",
        b"stop\r\0\0",
    ]


def test_a_command_may_come_in_pieces() -> None:
    assert _ask(DataqSimulator(), b"in", b"fo 1\rinfo 9", b"\r") == [
        b"",
        b"info 1 2108\r",
        b"info 9 60000000\r",
    ]


def test_scans_of_the_internal_clock() -> None:
    simulator = DataqSimulator(2108, counts_per_revolution=4)
    _ask(simulator, b"slist 0 1\r", b"slist 1 8\r", b"slist 2 10\r", b"slist 3 0\r", b"start\r")
    assert simulator.streaming
    assert simulator.sample_rate_Hz == 1000.0
    data = simulator.sample(_signals([0.2, 0.3, 0.6, 0.6], a1=-10.0, a2=5.0), 0.0)
    assert _words(data) == [
        *(0x4000, 0x0000, 0x8000, 0x8000),
        *(0x4000, 0x4C00, 0x8001, 0x8000),
        *(0x4000, 0x4C00, 0x8002, 0x8000),
        *(0x4000, 0x4C00, 0x8002, 0x8000),
    ]
    assert simulator.receive(b"stop\r", 0.0) == b"stop\r"
    assert simulator.sample(_signals([0.6]), 0.0) == b""


def test_the_low_bits_of_a_di_4108_carry_no_signal() -> None:
    simulator = DataqSimulator(4108)
    _ask(simulator, b"slist 0 1281\r", b"start\r")
    words = _words(simulator.sample(_signals(np.zeros(800), a2=0.1), 0.0))
    assert {word & 0xFFFC for word in words} == {0x4000}
    assert {word & 3 for word in words} == {0, 1, 2, 3}


def test_packets_leave_when_they_are_full() -> None:
    simulator = DataqSimulator()
    _ask(simulator, b"ps 1\r", b"start\r")
    assert simulator.sample(_signals(np.zeros(15)), 0.0) == b""
    assert len(simulator.sample(_signals(np.zeros(2)), 0.0)) == 32
    assert simulator.receive(b"stop\r", 0.0) == b"\0\0stop\r"
    silent = DataqSimulator(stop_sends_rest=False)
    _ask(silent, b"start\r")
    silent.sample(_signals(np.zeros(5)), 0.0)
    assert silent.receive(b"stop\r", 0.0) == b"stop\r"


def test_scans_of_the_encoder_clock_are_interpolated_at_the_edges() -> None:
    simulator = DataqSimulator(counts_per_revolution=8)
    _ask(simulator, b"slist 1 10\r", b"reset 1\r", b"start 2\r")
    simulator.sample(_signals([0.0], a1=0.0), 0.0)
    shaft = np.array([0.1, 0.3, 0.3, 0.55])
    data = simulator.sample(_signals(shaft, a1=8.0 * shaft), 0.0)
    words = _words(data)
    volts = np.array(words[0::2], np.uint16).astype(np.int16) * 10.0 / 32768.0
    assert volts == pytest.approx([1.0, 2.0, 3.0, 4.0], abs=3.1e-4)
    assert words[1::2] == [0x8001, 0x8002, 0x8003, 0x8004]


def test_turning_back_counts_on() -> None:
    simulator = DataqSimulator(counts_per_revolution=1)
    _ask(simulator, b"slist 0 10\r", b"start 2\r")
    simulator.sample(_signals([0.0, 2.25]), 0.0)
    data = simulator.sample(_signals([-0.25, 6.0]), 0.0)
    data += simulator.receive(b"stop\r", 0.0).removesuffix(b"stop\r")
    assert [word ^ 0x8000 for word in _words(data)] == list(range(1, 12))


@given(st.lists(st.floats(-50.0, 50.0), min_size=2, max_size=40))
def test_edges_lie_on_the_shafts_way(way: list[float]) -> None:
    position = np.array(way)
    edges = rising_edges(position)
    assert edges.per_interval.sum() == edges.interval.size
    before, after = position[edges.interval], position[edges.interval + 1]
    at = before + edges.fraction * (after - before)
    assert (edges.fraction >= -1e-9).all()
    assert (edges.fraction <= 1.0 + 1e-9).all()
    phase = np.where(after > before, at, at - 0.5)
    assert np.abs(phase - np.round(phase)).max(initial=0.0) < 1e-9
    turned = np.abs(np.diff(position))
    assert (np.abs(edges.per_interval - turned) <= 1.0).all()


def test_the_counter_counts_while_nobody_scans_and_goes_round() -> None:
    simulator = DataqSimulator(counts_per_revolution=1000)
    _ask(simulator, b"slist 0 10\r")
    simulator.sample(_signals(np.linspace(0.0, 65.5305, 9)), 0.0)
    _ask(simulator, b"start\r")
    data = simulator.sample(_signals(65.5305 + np.arange(8) * 0.002), 0.0)
    assert [word ^ 0x8000 for word in _words(data)] == [65530, 65532, 65534, 0, 2, 4, 6, 8]


def test_too_fast_a_scan_hangs_until_the_power_is_cycled() -> None:
    simulator = DataqSimulator()
    _ask(simulator, b"slist 1 1\r", b"srate 375\r", b"start\r")
    assert simulator.sample(_signals(np.zeros(50)), 0.0) == b""
    assert simulator.receive(b"stop\r", 0.0) == b""
    simulator.inject("reset", value=0.1)
    assert simulator.receive(b"stop\r", 0.05) == b""
    assert simulator.receive(b"stop\r", 0.2) == b"stop\r"
    assert simulator.scan_list == (0,)


@pytest.mark.parametrize(
    ("fault", "data"),
    [
        ({"kind": "dropped_byte"}, bytes(31)),
        ({"kind": "overrun", "value": 3}, bytes(26)),
        ({"kind": "overrun_bytes", "value": 5}, bytes(27)),
        ({"kind": "saturated_input"}, b"\xff\x7f" * 16),
    ],
)
def test_faults_of_the_stream(fault: dict[str, Any], data: bytes) -> None:
    simulator = DataqSimulator(faults=[fault])
    _ask(simulator, b"start\r")
    got = simulator.sample(_signals(np.zeros(16)), 0.0)
    got += simulator.receive(b"stop\r", 0.0).removesuffix(b"stop\r")
    assert got == data


def test_garbage_comes_on_top() -> None:
    simulator = DataqSimulator(faults=[{"kind": "garbage", "value": 16}])
    _ask(simulator, b"start\r")
    data = simulator.sample(_signals(np.zeros(16)), 0.0)
    assert len(data) == 48
    assert data[16:] == bytes(32)


def test_a_stuck_input_holds_until_it_is_cleared() -> None:
    simulator = DataqSimulator()
    _ask(simulator, b"start\r")
    ramp = np.linspace(0.0, 5.0, 8)
    simulator.sample(_signals(np.zeros(8), a1=ramp), 0.0)
    simulator.inject("stuck_input", value=1)
    assert set(_words(simulator.sample(_signals(np.zeros(8), a1=ramp), 0.0))) == {0x4000}
    simulator.clear("stuck_input")
    assert len(set(_words(simulator.sample(_signals(np.zeros(8), a1=ramp), 0.0)))) == 8


def test_faults_of_the_replies_and_the_device() -> None:
    simulator = DataqSimulator()
    dec = COMMANDS.index("dec")
    simulator.inject("no_reply", target=dec, count=1)
    assert _ask(simulator, b"dec 1\r", b"dec 1\r", b"ps 0\r") == [b"", b"dec 1\r", b"ps 0\r"]
    simulator.inject("wrong_echo", target=dec, count=1)
    assert _ask(simulator, b"dec 1\r") == [b"?dec 1\r"]
    simulator.inject("slow_reply", value=0.5, count=1)
    assert _ask(simulator, b"ps 1\r") == [b""]
    assert simulator.receive(b"", 0.4) == b""
    assert simulator.receive(b"", 0.6) == b"ps 1\r"
    simulator.inject("hang")
    assert simulator.receive(b"stop\r", 0.7) == b""
    simulator.clear("hang")
    assert simulator.receive(b"stop\r", 0.8) == b"stop\r"
    with pytest.raises(ValueError, match="nonsense"):
        simulator.inject("nonsense")


def test_srate_may_rewrite_the_packet_size() -> None:
    simulator = DataqSimulator(srate_rewrites_ps=True)
    _ask(simulator, b"ps 2\r", b"srate 6000\r")
    assert simulator.packet_bytes == 2048
    _ask(simulator, b"ps 2\r")
    assert simulator.packet_bytes == 64
