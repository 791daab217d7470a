"""Packets and status words, byte for byte, and parsers that bear any bytes."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.roboclaw import protocol
from rigapp_drivers.roboclaw.protocol import (
    NEWER,
    OLDER,
    Command,
    Generation,
    Rejected,
    VelocityPid,
)
from rigapp_drivers.roboclaw.status import describe_status, generation_of

COMMANDS = st.sampled_from(list(Command))
GENERATIONS = st.sampled_from([NEWER, OLDER])


def test_the_crc_has_the_published_check_value() -> None:
    assert protocol.crc16(b"123456789") == 0x31C3


def test_writes_are_built_byte_for_byte(golden_write: dict[str, Any]) -> None:
    packet = protocol.write_packet(0x80, golden_write["command"], *golden_write["values"])
    assert packet == bytes.fromhex(golden_write["bytes"])


def test_replies_are_parsed_and_complete_at_their_last_byte(golden_read: dict[str, Any]) -> None:
    raw = bytes.fromhex(golden_read["reply"])
    command = golden_read["command"]
    assert protocol.missing_bytes(command, raw) == 0
    assert protocol.missing_bytes(command, raw[:-1]) == 1
    if command == Command.VERSION:
        assert protocol.parse_version(0x80, raw) == golden_read["text"]
    else:
        assert protocol.parse_values(0x80, command, raw) == tuple(golden_read["values"])


def test_one_flipped_bit_is_rejected_wherever_it_is(golden_read: dict[str, Any]) -> None:
    raw = bytes.fromhex(golden_read["reply"])
    command = golden_read["command"]
    for bit in range(len(raw) * 8):
        wrong = bytearray(raw)
        wrong[bit // 8] ^= 1 << bit % 8
        parse = (
            protocol.parse_version(0x80, bytes(wrong))
            if command == Command.VERSION
            else protocol.parse_values(0x80, command, bytes(wrong))
        )
        assert isinstance(parse, Rejected)


def test_a_reply_to_another_command_is_rejected() -> None:
    main_voltage = bytes.fromhex("01 E3 C9 86")
    reply = protocol.parse_values(0x80, Command.LOGIC_VOLTAGE, main_voltage)
    assert isinstance(reply, Rejected)
    assert reply.kind == "crc"


@given(COMMANDS, st.binary(max_size=80), GENERATIONS)
def test_any_bytes_give_numbers_or_a_reason(
    command: Command, raw: bytes, generation: Generation
) -> None:
    assert protocol.missing_bytes(command, raw, generation) >= 0
    values = protocol.parse_values(0x80, command, raw, generation)
    text = protocol.parse_version(0x80, raw)
    assert isinstance(values, Rejected | tuple)
    assert isinstance(text, Rejected | str)


@given(COMMANDS, st.data(), GENERATIONS)
def test_reading_what_is_missing_ends(
    command: Command, data: st.DataObject, generation: Generation
) -> None:
    raw = b""
    for _ in range(60):
        missing = protocol.missing_bytes(command, raw, generation)
        if missing == 0:
            break
        raw += data.draw(st.binary(min_size=missing, max_size=missing))
    assert protocol.missing_bytes(command, raw, generation) == 0


@given(st.integers(-(2**31), 2**31 - 1), st.integers(0, 2**32 - 1))
def test_what_is_written_can_be_read_from_the_packet(speed: int, acceleration: int) -> None:
    packet = protocol.write_packet(0x81, Command.RAMP_SPEED_M2, acceleration, speed)
    assert packet[:2] == bytes((0x81, 39))
    assert int.from_bytes(packet[2:6], "big") == acceleration
    assert int.from_bytes(packet[6:10], "big", signed=True) == speed
    assert protocol.crc16(packet) == 0


@pytest.mark.parametrize("values", [(2**31,), (-(2**31) - 1,), (), (1, 2)])
def test_a_value_that_does_not_fit_is_refused(values: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="cannot carry"):
        protocol.write_packet(0x80, Command.SET_SPEED_M1, *values)


def test_a_read_cannot_be_built_as_a_write() -> None:
    with pytest.raises(ValueError, match="not a write"):
        protocol.write_packet(0x80, Command.STATUS)


def test_the_velocity_loop_is_read_as_p_i_d() -> None:
    pid = VelocityPid(1.0, 0.5, 0.25, 44000)
    assert protocol.velocity_pid_of((65536, 32768, 16384, 44000)) == pid


def test_speeds_and_counts_have_their_sign() -> None:
    assert protocol.speed_of((36000, 1)) == -36000
    assert protocol.count_of((-16, 0b011)) == -16


def test_the_older_generation_has_shorter_packets() -> None:
    assert protocol.reply_format(Command.STATUS, OLDER) == ">H"
    assert len(protocol.write_packet(0x80, 74, 1, 0, 0, generation=OLDER)) == 7
    assert len(protocol.write_packet(0x80, 57, 240, 540, generation=OLDER)) == 8


def test_status_words_of_both_generations_name_the_emergency_stop() -> None:
    newer, older = describe_status(0x0001, 32), describe_status(0x0004, 16)
    assert newer.emergency_stop
    assert older.emergency_stop
    assert newer.faults == older.faults == ("emergency stop",)
    assert not describe_status(0x0004, 32).emergency_stop


@pytest.mark.parametrize("bits", [16, 32])
def test_every_status_bit_has_words_and_unknown_errors_are_faults(bits: int) -> None:
    said = set()
    for bit in range(bits):
        words = describe_status(1 << bit, bits)
        (text,) = words.faults + words.warnings
        assert text
        if bits == 32:
            assert bool(words.faults) == (bit < 16)
        said.add((text, bool(words.faults)))
    assert len(said) == bits


def test_a_good_status_is_silent() -> None:
    assert describe_status(0, 32).faults == describe_status(0, 32).warnings == ()


@pytest.mark.parametrize(
    ("text", "width"),
    [
        ("USB Roboclaw 2x30a v4.2.4", 32),
        ("USB Roboclaw 2x60a v4.1.34", 16),
        ("MCP236 2x30A 60VDC v1.0.0", 16),
        ("Roboclaw 2x15a v10.0", 32),
        ("something else", 32),
    ],
)
def test_the_firmware_text_tells_the_generation(text: str, width: int) -> None:
    assert generation_of(text).status_bits == width
