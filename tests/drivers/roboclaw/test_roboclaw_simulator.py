"""The simulated RoboClaw against golden packets, without a wire."""

from __future__ import annotations

import struct
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp_drivers.roboclaw import protocol
from rigapp_drivers.roboclaw.protocol import OLDER, Command, EmergencyStopLock, Generation
from rigapp_drivers.roboclaw.simulator import RoboClawFault, RoboClawSimulator
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState

FF = b"\xff"


HELD = DriveCommand(DriveMode.VELOCITY, speed_count_per_s=0.0)
"""A motor that stands and is held."""


def ask(simulator: RoboClawSimulator, command: int, now_s: float = 0.0) -> tuple[int, ...]:
    """Return the numbers of a reply; fail when there is none."""
    generation = simulator.generation
    raw = simulator.receive(bytes((0x80, command)), now_s)
    values = protocol.parse_values(0x80, command, raw, generation)
    assert isinstance(values, tuple), values
    return values


def tell(simulator: RoboClawSimulator, command: int, *values: int, now_s: float = 0.0) -> bytes:
    """Send a write and return the answer."""
    packet = protocol.write_packet(0x80, command, *values, generation=simulator.generation)
    return simulator.receive(packet, now_s)


def test_golden_writes_are_acknowledged_by_ff(golden_write: dict[str, Any]) -> None:
    assert RoboClawSimulator().receive(bytes.fromhex(golden_write["bytes"]), 0.0) == FF


def test_a_write_with_a_wrong_crc_is_not_answered_and_not_obeyed(
    golden_write: dict[str, Any],
) -> None:
    packet = bytearray(bytes.fromhex(golden_write["bytes"]))
    packet[-1] ^= 1
    simulator = RoboClawSimulator()
    assert simulator.receive(bytes(packet), 0.0) == b""
    assert simulator.command(1.0, 0.0).mode is DriveMode.OFF


def test_golden_reads_are_answered_byte_for_byte(golden_read: dict[str, Any]) -> None:
    simulator = RoboClawSimulator()
    if "before" in golden_read:
        assert simulator.receive(bytes.fromhex(golden_read["before"]), 0.0) == FF
    if "fault" in golden_read:
        simulator.inject(golden_read["fault"])
    state = MotorState(0, 0.0, 0.0)
    simulator.observe(state)
    for key, value in golden_read.get("state", {}).items():
        fields = {name: getattr(state, name) for name in MotorState.__dataclass_fields__}
        state = MotorState(**{**fields, key: value})
    simulator.observe(state)
    request = bytes((0x80, golden_read["command"]))
    assert simulator.receive(request, 0.0) == bytes.fromhex(golden_read["reply"])


@pytest.mark.parametrize("command", [c for c in Command if protocol.reply_format(c) is not None])
@pytest.mark.parametrize("generation", ["newer", "older"])
def test_every_read_of_the_table_is_answered(command: Command, generation: str) -> None:
    firmware = "USB Roboclaw 2x30a v4.2.4" if generation == "newer" else "Roboclaw 2x30a v4.1.6"
    simulator = RoboClawSimulator(firmware=firmware, combined_status=True)
    assert ask(simulator, command)


@pytest.mark.parametrize("command", [c for c in Command if protocol.write_format(c) is not None])
def test_every_write_of_the_table_is_acknowledged(command: Command) -> None:
    layout = protocol.write_format(command)
    assert layout is not None
    zeros = struct.unpack(layout, bytes(struct.calcsize(layout)))
    packet = protocol.write_packet(0x80, command, *zeros)
    assert RoboClawSimulator().receive(packet, 0.0) == FF


@pytest.mark.parametrize("motor", [1, 2])
def test_each_motor_obeys_its_own_commands(motor: int) -> None:
    simulator = RoboClawSimulator(motor=motor)
    second = motor - 1
    assert tell(simulator, Command.RAMP_SPEED_M1 + second, 1000, 2000) == FF
    command = simulator.command(0.5, 0.0)
    assert command.mode is DriveMode.VELOCITY
    assert command.speed_count_per_s == pytest.approx(500.0)
    assert simulator.command(5.0, 0.0).speed_count_per_s == pytest.approx(2000.0)
    simulator.observe(MotorState(777, -1999.6, 1.5))
    assert ask(simulator, Command.COUNT_M1 + second) == (777, 2)
    assert ask(simulator, Command.SPEED_M1 + second) == (2000, 1)
    assert ask(simulator, Command.CURRENTS)[second] == 150
    assert ask(simulator, Command.COUNTS)[1 - second] == 0
    assert tell(simulator, Command.DUTY_M1 + second, 0) == FF
    assert simulator.command(0.1, 0.0).mode is DriveMode.OFF


def test_the_other_motor_turns_free() -> None:
    simulator = RoboClawSimulator(motor=1)
    tell(simulator, Command.SET_SPEED_M2, -3000)
    for _ in range(10):
        simulator.command(0.1, 0.0)
    assert ask(simulator, Command.COUNT_M2) == (-3000, 3)
    assert ask(simulator, Command.INSTANT_SPEEDS) == (0, -3000)


def test_the_ramp_to_zero_takes_its_time_and_duty_zero_does_not() -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_SPEED_M1, 3600)
    assert simulator.command(0.0, 0.0).speed_count_per_s == 3600
    tell(simulator, Command.RAMP_SPEED_M1, 1800, 0)
    assert simulator.command(1.0, 0.0).speed_count_per_s == pytest.approx(1800)
    assert simulator.command(1.5, 0.0).speed_count_per_s == 0


def test_a_ramp_starts_at_the_speed_that_the_motor_has() -> None:
    simulator = RoboClawSimulator()
    simulator.observe(MotorState(0, 1000.0, 0.0))
    tell(simulator, Command.RAMP_SPEED_M1, 100, 2000)
    assert simulator.command(1.0, 0.0).speed_count_per_s == pytest.approx(1100)


def test_the_combined_status_has_56_bytes_and_the_right_numbers() -> None:
    simulator = RoboClawSimulator()
    simulator.receive(b"", 10.0)
    tell(simulator, Command.SET_SPEED_M1, 36000, now_s=10.0)
    simulator.command(0.1, 10.0)
    simulator.observe(MotorState(-5, 35990.0, 12.34, supply_V=48.3, temperature_C=31.5))
    raw = simulator.receive(bytes((0x80, 73)), 12.5)
    assert len(raw) == 58
    values = protocol.parse_values(0x80, 73, raw)
    assert isinstance(values, tuple)
    status = protocol.combined_status_of(values)
    assert status.tick == 2500
    assert status.state == 0
    assert (status.main_voltage, status.logic_voltage) == (483, 121)
    assert status.temperatures == (315, 315)
    assert status.currents == (1234, 0)
    assert status.counts == (-5, 0)
    assert status.setpoints == (36000, 0)
    assert status.speeds == (35990, 0)
    assert status.speed_errors == (10, 0)


# --- watchdog, emergency stop, resets -------------------------------------------------------------


def test_silence_longer_than_the_time_out_stops_the_motor_until_a_new_command() -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_TIMEOUT, 5)
    tell(simulator, Command.SET_SPEED_M1, 1000)
    assert simulator.command(0.1, 0.49).mode is DriveMode.VELOCITY
    assert not simulator.watchdog_tripped
    assert simulator.command(0.1, 0.51) == HELD
    assert simulator.watchdog_tripped
    ask(simulator, Command.STATUS, now_s=0.6)
    assert simulator.command(0.1, 0.6) == HELD
    tell(simulator, Command.SET_SPEED_M1, 500, now_s=0.7)
    assert simulator.command(0.1, 0.7).speed_count_per_s == 500


def test_any_bytes_feed_the_watchdog_and_the_plant_time_does_not() -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_TIMEOUT, 5)
    tell(simulator, Command.SET_SPEED_M1, 1000)
    for step in range(1, 10):
        ask(simulator, Command.STATUS, now_s=0.4 * step)
        assert simulator.command(100.0, 0.4 * step).mode is DriveMode.VELOCITY


def test_a_silence_is_noticed_although_nobody_looked_during_it() -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_TIMEOUT, 5)
    tell(simulator, Command.SET_SPEED_M1, 1000)
    ask(simulator, Command.STATUS, now_s=3.0)
    assert simulator.watchdog_tripped
    assert simulator.command(0.1, 3.0) == HELD


@pytest.mark.parametrize("lock", list(EmergencyStopLock))
def test_the_emergency_stop_is_released_as_its_lock_says(lock: EmergencyStopLock) -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_EMERGENCY_STOP_LOCK, lock)
    tell(simulator, Command.SET_SPEED_M1, 1000)
    simulator.inject(RoboClawFault.EMERGENCY_STOP)
    assert simulator.command(0.1, 0.1).mode is DriveMode.OFF
    tell(simulator, Command.SET_SPEED_M1, 1000)
    assert simulator.command(0.1, 0.2).mode is DriveMode.OFF
    tell(simulator, Command.RESET_EMERGENCY_STOP)
    assert ask(simulator, Command.STATUS) == (1,), "reset while the button is pressed"
    simulator.clear(RoboClawFault.EMERGENCY_STOP)
    assert ask(simulator, Command.STATUS) == (int(lock != EmergencyStopLock.AUTOMATIC),)
    tell(simulator, Command.RESET_EMERGENCY_STOP)
    assert ask(simulator, Command.STATUS) == (int(lock == EmergencyStopLock.HARDWARE),)
    assert simulator.command(0.1, 0.3).mode is DriveMode.OFF, "it must not start by itself"


def test_an_input_without_the_stop_function_stops_nothing() -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_PIN_FUNCTIONS, 3, 0, 0, 0, 0)
    simulator.inject(RoboClawFault.EMERGENCY_STOP)
    tell(simulator, Command.SET_SPEED_M1, 1000)
    assert simulator.command(0.1, 0.1).mode is DriveMode.VELOCITY


def test_a_duty_follows_its_ramp_down_to_no_power() -> None:
    simulator = RoboClawSimulator(duty_acceleration=32767)
    tell(simulator, Command.SET_SPEED_M1, 44000)
    simulator.command(0.1, 0.0)
    tell(simulator, Command.DUTY_M1, 0)
    assert simulator.command(0.5, 0.1).duty == pytest.approx(0.5, abs=0.01)
    assert ask(simulator, Command.PWM)[0] == pytest.approx(16384, abs=300)
    assert simulator.command(0.6, 0.2).mode is DriveMode.OFF
    tell(simulator, Command.SET_DUTY_ACCELERATION_M1, 655359)
    assert ask(simulator, Command.DUTY_ACCELERATIONS) == (655359, 32767)


@pytest.mark.parametrize(
    ("fault", "newer", "older"),
    [
        (RoboClawFault.EMERGENCY_STOP, 0x0001, 0x0004),
        (RoboClawFault.OVER_TEMPERATURE, 0x0002, 0x0008),
        (RoboClawFault.DRIVER_FAULT, 0x0040, 0x0100),
        (RoboClawFault.OVER_CURRENT, 0x0001_1000, 0x0001),
        (RoboClawFault.UNDER_VOLTAGE, 0x0008_4000, 0x0800),
    ],
)
def test_state_faults_set_their_bits_and_stop_the_motor(
    fault: RoboClawFault, newer: int, older: int
) -> None:
    for width, bits in ((32, newer), (16, older)):
        simulator = RoboClawSimulator(
            status_width=width, faults=[{"kind": str(fault), "start_s": 1.0, "end_s": 2.0}]
        )
        tell(simulator, Command.SET_SPEED_M1, 1000)
        assert simulator.command(0.1, 0.9).mode is DriveMode.VELOCITY
        assert ask(simulator, Command.STATUS, now_s=1.5) == (bits,)
        assert simulator.command(0.1, 1.5).mode is DriveMode.OFF
        assert ask(simulator, Command.STATUS, now_s=2.5) == (0,)


def test_the_voltage_limits_are_judged_from_the_supply() -> None:
    simulator = RoboClawSimulator()
    tell(simulator, Command.SET_MAIN_LIMITS, 240, 540, 0)
    simulator.observe(MotorState(0, 0.0, 0.0, supply_V=55.0))
    assert ask(simulator, Command.STATUS) == (1 << 3 | 1 << 18,)
    simulator.observe(MotorState(0, 0.0, 0.0, supply_V=20.0))
    assert ask(simulator, Command.STATUS) == (1 << 14 | 1 << 19,)


def test_a_reset_restores_the_saved_settings_and_is_silent_for_a_while() -> None:
    simulator = RoboClawSimulator(faults=[{"kind": "reset", "start_s": 1.0, "value": 0.3}])
    tell(simulator, Command.SET_CURRENT_LIMIT_M1, 2000, 0)
    tell(simulator, Command.SAVE_TO_NVM, protocol.NVM_KEY)
    tell(simulator, Command.SET_TIMEOUT, 5)
    tell(simulator, Command.SET_SPEED_M1, 1000)
    simulator.observe(MotorState(100, 1000.0, 0.0))
    assert ask(simulator, Command.COUNT_M1, now_s=0.4) == (100, 0)
    assert simulator.receive(bytes((0x80, 90)), 1.0) == b""
    assert ask(simulator, Command.GET_TIMEOUT, now_s=1.4) == (0,)
    assert ask(simulator, Command.CURRENT_LIMIT_M1, now_s=1.4) == (2000, 0)
    assert ask(simulator, Command.COUNT_M1, now_s=1.4)[0] == 0
    assert simulator.command(0.1, 1.4).mode is DriveMode.OFF


# --- the wire -------------------------------------------------------------------------------------


def test_a_packet_may_come_in_pieces_but_not_with_a_long_gap() -> None:
    packet = protocol.write_packet(0x80, Command.SET_SPEED_M1, 1000)
    simulator = RoboClawSimulator(inter_byte_timeout_s=0.01)
    assert b"".join(simulator.receive(packet[i : i + 1], 0.009 * i) for i in range(8)) == FF
    assert simulator.receive(packet[:4], 1.0) == b""
    assert simulator.receive(packet[4:], 1.02) == b"", "the gap discards the first half"
    assert simulator.receive(packet, 1.04) == FF


@pytest.mark.parametrize("packet", ["80 C3", "80 FF 12 34", "81 5A", "00 00", "05"])
def test_unknown_commands_and_other_addresses_meet_silence(packet: str) -> None:
    simulator = RoboClawSimulator(inter_byte_timeout_s=0.01)
    assert simulator.receive(bytes.fromhex(packet), 0.0) == b""
    assert ask(simulator, Command.STATUS, now_s=0.1) == (0,)


def test_any_address_is_answered_over_usb() -> None:
    simulator = RoboClawSimulator(any_address=True)
    reply = simulator.receive(bytes((0x85, 24)), 0.0)
    assert protocol.parse_values(0x85, 24, reply) == (480,)


@given(st.lists(st.binary(max_size=40), max_size=10))
def test_any_bytes_are_borne_and_the_drive_answers_again(pieces: list[bytes]) -> None:
    simulator = RoboClawSimulator()
    for number, piece in enumerate(pieces):
        simulator.receive(piece, 0.001 * number)
        simulator.command(0.001, 0.001 * number)
    now_s = 10.0
    assert simulator.receive(bytes((0x80, 25)), now_s) == bytes.fromhex("0079EF74")


def test_variants_of_older_firmware_have_their_lengths() -> None:
    simulator = RoboClawSimulator(firmware="Roboclaw 2x60a v4.1.34")
    assert simulator.generation == OLDER
    assert len(simulator.receive(b"\x80\x5a", 0.0)) == 4
    assert ask(simulator, Command.PIN_FUNCTIONS) == (1, 0, 0)
    assert ask(simulator, Command.MAIN_LIMITS) == (60, 600)
    assert simulator.receive(b"\x80\x49", 0.0) == b"", "no combined status"
    mixed = RoboClawSimulator(pin_modes=3, voltage_offset=False)
    assert mixed.generation == Generation(32, 3, False)


def test_link_faults_strike_as_often_as_told() -> None:
    simulator = RoboClawSimulator(
        faults=[
            {"kind": "wrong_crc", "count": 1, "target": 25},
            {"kind": "no_reply", "count": 1, "target": 82},
            {"kind": "duplicated_reply", "count": 1, "target": 24},
            {"kind": "wrong_acknowledge", "count": 1},
            {"kind": "lost_command", "count": 1, "target": 35},
            {"kind": "slow_reply", "count": 1, "target": 15, "value": 0.2},
        ]
    )
    good = bytes.fromhex("0079EF74")
    assert simulator.receive(b"\x80\x19", 0.0) == good[:-1] + bytes((good[-1] ^ 1,))
    assert simulator.receive(b"\x80\x19", 0.0) == good
    assert simulator.receive(b"\x80\x52", 0.0) == b""
    assert len(simulator.receive(b"\x80\x52", 0.0)) == 4
    assert len(simulator.receive(b"\x80\x18", 0.0)) == 8
    assert len(simulator.receive(b"\x80\x18", 0.0)) == 4
    assert tell(simulator, Command.SET_TIMEOUT, 5) == b"\x7f"
    assert tell(simulator, Command.SET_SPEED_M1, 1000) == b""
    assert simulator.command(0.1, 0.0).mode is DriveMode.OFF
    assert simulator.receive(b"\x80\x0f", 0.0) == b""
    assert simulator.emit(0.1) == b""
    assert simulator.emit(0.2) == bytes.fromhex("057BC1")


@pytest.mark.parametrize("fault", [{"kind": "gremlin"}, {"kind": "reset", "colour": 1}])
def test_unknown_fault_data_is_refused(fault: dict[str, Any]) -> None:
    with pytest.raises((ValueError, TypeError)):
        RoboClawSimulator(faults=[fault])
