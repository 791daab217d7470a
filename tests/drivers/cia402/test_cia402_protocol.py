"""Numbers to meaning, and parsers that bear any bytes."""

from __future__ import annotations

from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.cia402 import protocol
from rigapp_drivers.cia402.monitor import HISTORY, NodeMonitor
from rigapp_drivers.cia402.protocol import Control, State
from rigapp_drivers.cia402.slcan import (
    LONGEST_LINE,
    Frame,
    SlcanAdapter,
    decode_frame,
    encode_frame,
)


@pytest.mark.parametrize(
    ("word", "state"),
    [
        (0x0000, State.NOT_READY),
        (0x0250, State.SWITCH_ON_DISABLED),
        (0x0231, State.READY),
        (0x0233, State.SWITCHED_ON),
        (0x1637, State.ENABLED),
        (0x0217, State.QUICK_STOP),
        (0x021F, State.FAULT_REACTION),
        (0x0218, State.FAULT),
        (0x0238, State.FAULT),
        (0x0003, None),
    ],
)
def test_the_status_word_tells_the_state(word: int, state: State | None) -> None:
    assert protocol.state_of(word) is state


@given(st.integers(0, 0xFFFF))
def test_every_status_word_has_at_most_one_state(word: int) -> None:
    states = [s for mask, value, s in protocol._STATES if word & mask == value]
    assert len(states) <= 1
    assert protocol.state_of(word) is (states[0] if states else None)


def test_the_way_to_operation_enabled() -> None:
    step = protocol.step_towards_enabled
    assert step(State.SWITCH_ON_DISABLED) is Control.SHUTDOWN
    assert step(State.READY) is Control.SWITCH_ON
    assert step(State.SWITCHED_ON) is Control.ENABLE
    assert step(State.QUICK_STOP) is Control.DISABLE_VOLTAGE
    for state in (State.ENABLED, State.FAULT, State.FAULT_REACTION, State.NOT_READY, None):
        assert step(state) is None


@pytest.mark.parametrize(
    ("unit", "rev_per_s"),
    [
        (0x00B4_4700, 1 / 60),
        (0xFDB4_4700, 1e-3 / 60),
        (0x00B4_0300, 1.0),
        (0xFFB4_0300, 0.1),
        (0x01B4_4700, 10 / 60),
        (0x0000_0000, None),
        (0x00B4_4800, None),
        (0x0041_0300, None),
        (0x00B4_4701, None),
    ],
)
def test_the_velocity_unit_is_read_and_never_assumed(unit: int, rev_per_s: float | None) -> None:
    found = protocol.velocity_unit_rev_per_s(unit)
    assert found == (None if rev_per_s is None else pytest.approx(rev_per_s))


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (0x2310, "over-current ‹EPOS1, error 2310›"),
        (0x8130, "heartbeat of the host lost ‹EPOS1, error 8130›"),
        (0xFF05, "Hall sensor or encoder ‹EPOS1, error FF05›"),
        (0x2345, "current ‹error 2345›"),
        (0xA000, "unknown error ‹error A000›"),
    ],
)
def test_error_codes_have_words_and_always_their_number(code: int, words: str) -> None:
    assert protocol.describe_code(code) == words


@given(st.binary(max_size=12))
def test_any_frame_is_borne(data: bytes) -> None:
    monitor = NodeMonitor()
    for take in (
        monitor.take_heartbeat,
        monitor.take_emergency,
        monitor.take_status,
        partial(monitor.take_value, "velocity"),
        partial(monitor.take_value, "position"),
    ):
        take(data, 1)
    assert (protocol.parse_emergency(data, 1) is None) == (len(data) < 3)
    assert (protocol.parse_status_and_value(data) is None) == (len(data) != 6)


def test_the_emergency_history_is_bounded_and_an_end_is_an_end() -> None:
    monitor = NodeMonitor()
    for number in range(HISTORY + 10):
        monitor.take_emergency(bytes((number, 0x10, 0x01, 0, 0, 0, 0, 0)), number)
    assert len(monitor.history) == HISTORY
    assert monitor.history[0].host_time_ns == 10
    assert len(monitor.active()) == HISTORY + 10
    monitor.take_emergency(bytes(8), 99)
    assert monitor.active() == ()
    assert monitor.history[-1].words == "errors are gone"
    assert len(monitor.take_passed()) > 0
    assert monitor.take_passed() == ()


FRAMES = st.one_of(
    st.builds(Frame, st.integers(0, 0x7FF), st.binary(max_size=8)),
    st.builds(Frame, st.integers(0, 2**29 - 1), st.binary(max_size=8), st.just(True)),
    st.builds(
        Frame,
        st.integers(0, 0x7FF),
        st.just(b""),
        st.just(False),
        st.just(True),
        st.integers(0, 8),
    ),
)


@given(FRAMES)
def test_frames_survive_the_text_form(frame: Frame) -> None:
    line = encode_frame(frame)
    assert line.endswith(b"\r")
    assert decode_frame(line[:-1].decode()) == frame


def test_the_text_form_is_lawicels() -> None:
    assert encode_frame(Frame(0x205, b"\x06\x00")) == b"t20520600\r"
    assert encode_frame(Frame(0x12345678, b"\xab", extended=True)) == b"T123456781AB\r"


@given(st.lists(st.binary(max_size=30), max_size=8))
def test_any_lines_are_borne_and_the_adapter_works_again(pieces: list[bytes]) -> None:
    adapter = SlcanAdapter()
    for piece in pieces:
        adapter.receive(piece)
    adapter.receive(b"x" * (LONGEST_LINE + 1))
    frames, answers = adapter.receive(b"\rO\rt20520600\r")
    assert frames == [Frame(0x205, b"\x06\x00")]
    assert answers.endswith(b"z\r")


def test_the_adapter_bears_the_opening_of_python_can() -> None:
    adapter = SlcanAdapter()
    assert adapter.receive(b"t20520600\r") == ([], b"\a")
    assert adapter.receive(b"C\rS6\r\rO\rO\r") == ([], b"\r\r\r\r\r")
    assert adapter.bit_rate == 500_000
    assert adapter.receive(b"V\rN\r") == ([], b"V1013\rNA123\r")
    assert adapter.receive(b"t2052")[0] == []
    assert adapter.receive(b"0600\r")[0] == [Frame(0x205, b"\x06\x00")]
    assert adapter.receive(b"t205206\r") == ([], b"\a")
    assert adapter.receive(b"L\rt20520600\r") == ([], b"\r\a")
    assert adapter.receive(b"C\r") == ([], b"\r")
    assert not adapter.is_open
