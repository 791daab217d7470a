"""The RoboClaw driver against its simulator over a pty."""

from __future__ import annotations

import contextlib
import math
import threading
import time
from collections.abc import Callable
from typing import Any

import pytest

from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceError,
    DeviceFault,
    DeviceLost,
    ProtocolError,
    ReplyTimeout,
    SettingRefused,
    Spindle,
    WrongDevice,
)
from rigapp_drivers.registry import check_settings, load_driver, load_simulator
from rigapp_drivers.roboclaw.driver import DRIVER, RoboClaw
from rigapp_drivers.roboclaw.protocol import Command, EmergencyStopLock, write_packet
from rigapp_drivers.roboclaw.simulator import RoboClawSimulator
from rigapp_drivers.roboclaw.status import describe_status
from rigapp_drivers.simulator_api import DriveMode

OLDER = "Roboclaw 2x60a v4.1.34"
NEWER = "USB Roboclaw 2x30a v4.2.4"
PATIENT = {"reply_timeout_ms": 400.0}  # a busy host pauses; real time-outs are tested apart


def poke(rig: Any, command: Command, *values: int) -> None:
    """Write to the simulated drive past the wire, as a tool of its maker would."""
    packet = write_packet(0x80, command, *values)
    assert rig.simulator.receive(packet, time.monotonic()) == b"\xff"


def test_the_driver_is_found_by_its_name_and_is_a_spindle() -> None:
    info = load_driver("roboclaw")
    assert info is DRIVER
    assert load_simulator(info) is RoboClawSimulator
    settings = check_settings(info, {"address": 129}, "rig.toml [devices.drive.settings]")
    assert isinstance(info.factory("drive", "none", settings), Spindle)


@pytest.mark.parametrize("address", [128, 135])
@pytest.mark.parametrize("motor", [1, 2])
def test_the_spindle_turns_ramps_and_stops(
    drive_rig: Any, connect: Any, wait_until: Any, address: int, motor: int
) -> None:
    rig = drive_rig(address=address, motor=motor)
    drive = connect(rig, address=address, motor=motor, **PATIENT)
    drive.set_speed(2.0, 40.0)
    wait_until(lambda: rig.last.speed_count_per_s == 7200, "the ramp's end")
    ramp = [command.speed_count_per_s for command in rig.commands]
    assert any(0 < speed < 7200 for speed in ramp)
    status = drive.status()
    assert status.speed_rev_per_s == pytest.approx(2.0)
    assert status.setpoint_rev_per_s == pytest.approx(2.0)
    assert status.current_A == pytest.approx(0.72, abs=0.01)
    assert status.supply_V == pytest.approx(48.0)
    assert status.temperature_C == pytest.approx(31.5)
    assert status.enabled
    assert not status.faults
    assert drive.status().position_count > status.position_count > 0
    drive.set_speed(0.0, 40.0)
    wait_until(lambda: rig.last.speed_count_per_s == 0, "the controlled stop")
    assert rig.last.mode is DriveMode.VELOCITY
    drive.drive_off()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")
    assert not drive.status().enabled


def test_direction_turns_every_sign(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    drive.configure(request_for(direction=-1))
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == -3600, "the drive to turn backward")
    status = drive.status()
    assert status.speed_rev_per_s == pytest.approx(1.0)
    assert status.setpoint_rev_per_s == pytest.approx(1.0)
    wait_until(lambda: drive.status().position_count > 100, "the count to rise")


def test_a_geared_drive_is_set_in_counts_of_its_motor(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    readback = drive.configure(request_for(gear_ratio=4.8))
    assert readback["speed_limit_rev_per_s"] == pytest.approx(44000 / 3600 / 4.8)
    sent = len(rig.wire.received)
    drive.set_speed(1.0, 200.0)
    ramp = write_packet(0x80, Command.RAMP_SPEED_M1, 3456000, 17280)
    assert ramp in bytes(rig.wire.received[sent:])
    wait_until(lambda: rig.last.speed_count_per_s == 17280, "the motor's speed")
    assert drive.status().speed_rev_per_s == pytest.approx(1.0)
    with pytest.raises(SettingRefused, match=r"180\.0 rpm of the crank\) is above.*QPPS"):
        drive.set_speed(3.0, 200.0)


@pytest.mark.parametrize(
    ("firmware", "settings", "bits", "combined"),
    [
        (NEWER, {}, 32, 1),
        (NEWER, {"combined_status": "never"}, 32, 0),
        (OLDER, {}, 16, 0),
        (OLDER, {"status_width": "16"}, 16, 0),
    ],
)
def test_both_generations_tell_the_same(
    drive_rig: Any,
    connect: Any,
    wait_until: Any,
    request_for: Any,
    firmware: str,
    settings: dict[str, Any],
    bits: int,
    combined: int,
) -> None:
    rig = drive_rig(firmware=firmware)
    drive = connect(rig, **PATIENT, **settings)
    readback = drive.configure(request_for())
    assert readback["status_bits"] == bits
    assert readback["combined_status"] == combined
    drive.set_speed(-1.5, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == -5400, "the speed")
    status = drive.status()
    assert status.speed_rev_per_s == pytest.approx(-1.5)
    assert status.supply_V == pytest.approx(48.0)
    assert status.temperature_C == pytest.approx(31.5)
    rig.simulator.inject("emergency_stop")
    wait_until(lambda: drive.status().emergency_stop, "the emergency stop")
    assert drive.status().faults == ("emergency stop",)


@pytest.mark.parametrize(("firmware", "width"), [(NEWER, 16), (OLDER, 32)])
def test_a_firmware_text_that_misleads_is_corrected_by_a_reply(
    drive_rig: Any, firmware: str, width: int
) -> None:
    rig = drive_rig(firmware=firmware, status_width=width)
    drive = RoboClaw("drive", rig.port, PATIENT)
    assert drive.open().details["status_bits"] == str(width)
    drive.close()


def test_the_status_is_one_packet_where_the_drive_can(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    before = len(rig.wire.received)
    drive.status()
    assert bytes(rig.wire.received[before:]) == b"\x80\x49"


def test_the_identity_is_the_firmware_text(drive_rig: Any) -> None:
    drive = RoboClaw("drive", drive_rig().port, PATIENT)
    identity = drive.open()
    assert (identity.maker, identity.model) == ("Basicmicro", "USB Roboclaw 2x30a")
    assert identity.firmware == "v4.2.4"
    drive.close()
    drive.close()


def test_configure_reads_everything_back(drive_rig: Any, connect: Any, request_for: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    readback = drive.configure(request_for(0.77))
    assert readback["watchdog_timeout_s"] == 0.7, "rounded to the safe side"
    assert rig.simulator.serial_timeout_s == pytest.approx(0.7)
    assert readback["speed_limit_count_per_s"] == 44000
    assert readback["velocity_p"] == 1.0
    assert readback["current_limit_A"] == pytest.approx(30.0)
    assert readback["supply_V"] == pytest.approx(48.0)


def test_the_ramp_of_a_power_off_is_made_short_and_told(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig(duty_acceleration=3276)  # 10 s from full duty
    drive = connect(rig, **PATIENT)
    assert drive.configure(request_for())["power_off_ramp"] == "0.05 s"
    drive.set_speed(10.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 36000, "the speed")
    begun = rig.time_s
    drive.drive_off()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")
    assert rig.time_s - begun < 1.0
    keeps = drive_rig(duty_acceleration=3276)
    keeps.simulator.inject("ignored_command", target=int(Command.SET_DUTY_ACCELERATION_M1))
    with pytest.raises(SettingRefused, match=r"a ramp of 10 s; set the default duty accel.*655359"):
        connect(keeps, **PATIENT)
    lacks = drive_rig(unknown_commands=(Command.DUTY_ACCELERATIONS,))
    told = connect(lacks, reply_timeout_ms=50.0).configure(request_for())
    assert told["power_off_ramp"] == "an unknown time"
    assert "how fast it removes the power" in told["advice"]


@pytest.mark.parametrize(
    ("firmware", "mode", "words", "advised"),
    [
        (NEWER, None, "emergency stop, latching", ""),
        (NEWER, 0x01, "emergency stop", ""),
        (NEWER, 0x14, "mode 14", "S3 is not set to emergency stop"),
        (OLDER, 2, "emergency stop", ""),
        (OLDER, 3, "mode 03", "S3 is not set to emergency stop"),
    ],
)
def test_what_the_emergency_stop_input_does_is_read_told_and_judged(
    drive_rig: Any,
    connect: Any,
    request_for: Any,
    firmware: str,
    mode: int | None,
    words: str,
    advised: str,
) -> None:
    told = connect(drive_rig(firmware=firmware, s3_mode=mode), **PATIENT).configure(request_for())
    assert told["input_S3"] == words
    assert told["wiring"] == f"power off in 0.05 s, input S3: {words}"
    assert advised in told.get("advice", "")
    assert bool(told.get("advice")) == bool(advised)


def test_configure_switches_a_motor_off_that_is_found_running(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    poke(rig, Command.SET_SPEED_M1, 3600)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the motor to run by itself")
    connect(rig, **PATIENT)
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")


@pytest.mark.parametrize(
    ("speed", "acceleration", "why"),
    [
        (12.1, 1.0, "726.0 rpm is above"),
        (-12.1, 1.0, "above the rig's maximum"),
        (math.nan, 1.0, "not a number"),
        (math.inf, 1.0, "not a number"),
        (1.0, 0.0, "acceleration"),
        (1.0, -1.0, "acceleration"),
        (1.0, math.nan, "acceleration"),
    ],
)
def test_what_may_not_be_is_refused_before_it_is_sent(
    drive_rig: Any, connect: Any, speed: float, acceleration: float, why: str
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    sent = len(rig.wire.received)
    with pytest.raises(SettingRefused, match=why):
        drive.set_speed(speed, acceleration)
    assert len(rig.wire.received) == sent


def test_a_speed_above_the_drives_own_limit_is_refused(drive_rig: Any, connect: Any) -> None:
    drive = connect(drive_rig(qpps=20000), **PATIENT)
    drive.set_speed(5.0, 1.0)
    with pytest.raises(SettingRefused, match="QPPS"):
        drive.set_speed(6.0, 1.0)


def test_nothing_turns_before_the_watchdog_is_set(drive_rig: Any) -> None:
    drive = RoboClaw("drive", drive_rig().port, PATIENT)
    with pytest.raises(DeviceLost, match="not open"):
        drive.set_speed(1.0, 1.0)
    drive.open()
    with pytest.raises(SettingRefused, match="configure"):
        drive.set_speed(1.0, 1.0)
    drive.close()


@pytest.mark.parametrize("timeout_s", [0.0, 0.05, 25.7, -1.0])
def test_a_watchdog_out_of_range_is_refused(
    drive_rig: Any, connect: Any, request_for: Any, timeout_s: float
) -> None:
    drive = connect(drive_rig(), **PATIENT)
    with pytest.raises(SettingRefused, match=r"0\.1 to 25\.5"):
        drive.configure(request_for(timeout_s))


def test_a_watchdog_that_does_not_hold_is_refused(drive_rig: Any, request_for: Any) -> None:
    class Forgetful(RoboClawSimulator):
        def receive(self, data: bytes, now_s: float) -> bytes:
            reply = super().receive(data, now_s)
            self._registers.memory.timeout = 0
            return reply

    rig = drive_rig()
    rig.wire._respond = Forgetful().receive
    drive = RoboClaw("drive", rig.port, PATIENT)
    drive.open()
    with pytest.raises(SettingRefused, match=r"reads 0\.0 s after 0\.5 s"):
        drive.configure(request_for())
    with pytest.raises(SettingRefused, match="configure"):
        drive.set_speed(1.0, 1.0)
    drive.close()


# --- connection -----------------------------------------------------------------------------------


def test_a_port_without_an_answer_is_named(wire: Any) -> None:
    silent = wire(lambda data, now_s: b"")
    drive = RoboClaw("drive", silent.port, {"reply_timeout_ms": 20.0})
    with pytest.raises(ConnectionFailed, match=r"no RoboClaw answers at address 128.*6 tries"):
        drive.open()
    with pytest.raises(DeviceLost):
        drive.status()


def test_another_device_is_named(wire: Any) -> None:
    other = wire(lambda data, now_s: b"ERROR unknown command\0\r\n")
    drive = RoboClaw("drive", other.port, {"reply_timeout_ms": 50.0})
    with pytest.raises(WrongDevice, match="no RoboClaw"):
        drive.open()


def test_another_address_is_not_answered(drive_rig: Any) -> None:
    drive = RoboClaw("drive", drive_rig(address=129).port, {"reply_timeout_ms": 20.0})
    with pytest.raises(ConnectionFailed, match="address"):
        drive.open()


def test_a_pulled_cable_is_named_and_close_bears_it(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    drive.set_speed(1.0, 10.0)
    rig.wire.unplug()
    with pytest.raises(DeviceLost):
        drive.status()
    drive.close()


def test_close_switches_the_motor_off(drive_rig: Any, connect: Any, wait_until: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    drive.close()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")


# --- watchdog -------------------------------------------------------------------------------------


@pytest.mark.parametrize("firmware", [NEWER, OLDER])
def test_a_silent_host_stops_the_spindle_and_is_told_so(
    drive_rig: Any, connect: Any, wait_until: Any, firmware: str
) -> None:
    rig = drive_rig(firmware=firmware)
    drive = connect(rig, watchdog_s=1.0, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    wait_until(lambda: rig.simulator.watchdog_tripped, "the drive's watchdog")
    wait_until(lambda: rig.last.speed_count_per_s == 0.0, "the stop")
    status = drive.status()
    assert any("watchdog" in fault for fault in status.faults)
    assert status.setpoint_rev_per_s == 0.0
    with pytest.raises(DeviceFault, match="reset the fault"):
        drive.set_speed(0.5, 1000.0)
    drive.reset_fault()
    drive.set_speed(0.5, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 1800, "a new command")
    assert not drive.status().faults


@pytest.mark.parametrize("firmware", [NEWER, OLDER])
def test_a_host_that_was_held_up_believes_the_drive_whether_its_watchdog_has_fired(
    drive_rig: Any,
    connect: Any,
    wait_until: Any,
    monkeypatch: pytest.MonkeyPatch,
    caplog: Any,
    firmware: str,
) -> None:
    rig = drive_rig(firmware=firmware)
    drive = connect(rig, watchdog_s=5.0, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    monkeypatch.setattr(drive._connection, "last_sent_ns", time.monotonic_ns() - 9 * 10**9)
    assert not drive.status().faults
    assert rig.last.speed_count_per_s == 3600
    assert "its watchdog of 5.00 s has not fired" in caplog.text


@pytest.mark.parametrize("settings", [{}, {"torque_constant_Nm_per_A": 0.5}])
def test_the_torque_is_told_where_its_constant_is_known(
    drive_rig: Any, connect: Any, wait_until: Any, settings: dict[str, float]
) -> None:
    drive = connect(rig := drive_rig(), watchdog_s=5.0, **PATIENT, **settings)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    status = drive.status()
    assert status.current_A == pytest.approx(0.36, abs=0.01)
    assert math.isnan(status.torque_Nm) or status.torque_Nm == 0.5 * status.current_A
    assert math.isnan(status.torque_Nm) is (not settings)


def test_a_new_speed_after_a_silence_is_refused_although_no_status_was_read(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=0.3)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.simulator.watchdog_tripped, "the drive's watchdog")
    with pytest.raises(DeviceFault, match=r"watchdog.*reset the fault"):
        drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 0, "the stop")


def test_status_feeds_the_watchdog(drive_rig: Any, connect: Any, wait_until: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=1.0, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    begun = rig.time_s

    def fed_for_longer_than_the_watchdog() -> bool:
        assert not drive.status().faults
        return bool(rig.time_s - begun > 1.5)

    wait_until(fed_for_longer_than_the_watchdog, "the drive's time to pass")
    assert rig.last.speed_count_per_s == 3600
    assert not rig.simulator.watchdog_tripped


# --- faults ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("fault", "value", "told"),
    [
        ("emergency_stop", None, "emergency stop"),
        ("over_current", None, "current error M1"),
        ("under_voltage", 5.5, "main voltage low"),
        ("over_temperature", None, "over-temperature 1"),
        ("driver_fault", None, "driver fault M1"),
        ("status_bits", 0x8000, "main voltage high (until"),
    ],
)
def test_every_state_fault_is_told_in_words(
    drive_rig: Any, connect: Any, wait_until: Any, fault: str, value: float | None, told: str
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    rig.simulator.inject(fault, value=value)
    wait_until(lambda: drive.status().faults != (), "the fault")
    status = drive.status()
    assert any(told in words for words in status.faults), status.faults
    assert not status.enabled
    assert status.emergency_stop == (fault == "emergency_stop")
    if fault != "status_bits":
        wait_until(lambda: rig.last.mode is DriveMode.OFF, "the motor to be off")


def test_an_unknown_error_bit_of_older_firmware_is_a_fault() -> None:
    assert describe_status(1 << 40, 48).faults == ("unknown error bit 40",)


def test_a_latched_emergency_stop_is_reset_after_its_release(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    poke(rig, Command.SET_EMERGENCY_STOP_LOCK, EmergencyStopLock.SOFTWARE)
    drive = connect(rig, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    rig.simulator.inject("emergency_stop")
    wait_until(lambda: drive.status().emergency_stop, "the emergency stop")
    with pytest.raises(DeviceFault, match="release the emergency stop button"):
        drive.reset_fault()
    rig.simulator.clear("emergency_stop")
    assert drive.status().emergency_stop, "it stays latched"
    drive.reset_fault()
    status = drive.status()
    assert not status.emergency_stop
    assert not status.enabled
    assert rig.last.mode is DriveMode.OFF, "it must not start by itself"


def test_a_hardware_locked_stop_asks_for_the_switch(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    poke(rig, Command.SET_EMERGENCY_STOP_LOCK, EmergencyStopLock.HARDWARE)
    drive = connect(rig, **PATIENT)
    rig.simulator.inject("emergency_stop")
    wait_until(lambda: drive.status().emergency_stop, "the emergency stop")
    rig.simulator.clear("emergency_stop")
    with pytest.raises(DeviceFault, match="off and on"):
        drive.reset_fault()


STOP_COMMANDS = (
    Command.RESET_EMERGENCY_STOP,
    Command.SET_EMERGENCY_STOP_LOCK,
    Command.EMERGENCY_STOP_LOCK,
)


def test_a_board_without_a_reset_of_the_stop_says_to_switch_it_off_and_on(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig(unknown_commands=STOP_COMMANDS)
    drive = connect(rig, reply_timeout_ms=50.0)
    rig.simulator.inject("emergency_stop")
    wait_until(lambda: drive.status().emergency_stop, "the emergency stop")
    rig.simulator.clear("emergency_stop")
    with pytest.raises(DeviceFault, match=r"not available.*switch the drive off and on"):
        drive.reset_fault()
    rig.simulator.inject("reset", value=0.0)
    drive.close()
    again = connect(rig, reply_timeout_ms=50.0)
    again.reset_fault()
    assert not again.status().faults


@pytest.mark.parametrize("unknown", [(), STOP_COMMANDS])
def test_nothing_is_asked_of_the_stop_while_it_is_not_reported(
    drive_rig: Any, connect: Any, wait_until: Any, unknown: tuple[Command, ...]
) -> None:
    rig = drive_rig(unknown_commands=unknown)
    drive = connect(rig, watchdog_s=0.5, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.simulator.watchdog_tripped, "the drive's watchdog")
    assert any("watchdog" in fault for fault in drive.status().faults)
    sent = len(rig.wire.received)
    drive.reset_fault()
    assert write_packet(0x80, Command.RESET_EMERGENCY_STOP) not in bytes(rig.wire.received[sent:])
    assert not drive.status().faults


def test_the_watchdogs_fault_goes_although_the_emergency_stop_stays(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=0.5, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.simulator.watchdog_tripped, "the drive's watchdog")
    rig.simulator.inject("emergency_stop")
    wait_until(lambda: len(drive.status().faults) == 2, "both faults")
    with pytest.raises(DeviceFault, match="release the emergency stop button"):
        drive.reset_fault()
    assert drive.status().faults == ("emergency stop",)


def test_a_fault_whose_cause_is_still_there_is_named_by_the_reset(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    rig.simulator.inject("driver_fault")
    wait_until(lambda: drive.status().faults != (), "the fault")
    with pytest.raises(DeviceFault, match="driver fault M1: remove the cause"):
        drive.reset_fault()


def test_firmware_without_a_serial_time_out_has_no_watchdog(
    drive_rig: Any, request_for: Any
) -> None:
    for unknown in ((Command.GET_TIMEOUT,), (Command.GET_TIMEOUT, Command.SET_TIMEOUT)):
        rig = drive_rig(unknown_commands=unknown)
        drive = RoboClaw("drive", rig.port, {"reply_timeout_ms": 50.0})
        drive.open()
        with pytest.raises(SettingRefused, match=r"no watchdog.*GET_TIMEOUT"):
            drive.configure(request_for())
        drive.close()


@pytest.mark.parametrize("settings", [{}, {"combined_status": "never"}])
def test_a_restart_of_the_drive_is_noticed(
    drive_rig: Any, connect: Any, settings: dict[str, Any]
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT, **settings)
    drive.set_speed(1.0, 1000.0)
    drive.status()
    rig.simulator.inject("reset", value=0.0)

    def poll_until_lost() -> None:
        for _ in range(20):
            drive.status()

    with pytest.raises(DeviceLost, match="restart"):
        poll_until_lost()
    with pytest.raises(SettingRefused, match="configure"):
        drive.set_speed(1.0, 1.0)


def test_a_restart_with_a_long_silence_is_a_missing_reply(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, reply_timeout_ms=50.0)
    rig.simulator.inject("reset", value=30.0)
    with pytest.raises(ReplyTimeout, match=r"no reply in 6 tries.*‹COMBINED_STATUS"):
        drive.status()


def test_a_drive_that_may_turn_is_missed_sooner_than_one_at_rest(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=20.0, reply_timeout_ms=50.0)

    def missed_after(tries: int) -> None:
        rig.simulator.inject("no_reply", target=int(Command.COMBINED_STATUS))
        with pytest.raises(ReplyTimeout, match=rf" {tries} tries"):
            drive.status()
        rig.simulator.clear("no_reply")

    missed_after(6)
    drive.set_speed(1.0, 1000.0)
    missed_after(3)
    drive.set_speed(0.0, 1000.0)
    missed_after(3)  # it may still run down
    drive.drive_off()
    missed_after(6)


# --- the link -------------------------------------------------------------------------------------


@pytest.mark.sampled
@pytest.mark.parametrize("turns", [True, False])
@pytest.mark.parametrize("late_s", [0.26, 0.22, 0.28, 0.44])
def test_a_drive_that_is_late_by_the_same_time_again_and_again_is_heard(
    drive_rig: Any, connect: Any, late_s: float, turns: bool
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=20.0, reply_timeout_ms=200.0)
    if turns:
        drive.set_speed(1.0, 1000.0)
    rig.simulator.inject("slow_reply", target=int(Command.COMBINED_STATUS), value=late_s)
    for _ in range(5):
        assert not drive.status().faults


@pytest.mark.sampled
@pytest.mark.parametrize("late_s", [0.12, 0.2, 0.35])
def test_a_line_whose_answers_are_all_late_is_understood_and_named(
    drive_rig: Any, connect: Any, late_s: float, caplog: pytest.LogCaptureFixture
) -> None:
    rig = drive_rig()
    rig.simulator.inject("slow_reply", value=late_s)
    drive = connect(rig, watchdog_s=20.0, reply_timeout_ms=100.0)
    for _ in range(3):
        assert not drive.status().faults
    assert drive.counters()["crc_errors"] == 0, "no answer is taken for a damaged one"
    assert "s late; set reply_timeout_ms to" in caplog.text
    repeated = drive.counters()["retries"]
    if late_s < 0.2:  # two time-outs: while it turns no answer is waited for longer
        drive.set_speed(0.5, 1000.0)
        assert drive.status().setpoint_rev_per_s == pytest.approx(0.5)
    drive.drive_off()
    assert drive.counters()["retries"] == repeated


def test_a_wrong_crc_is_counted_and_repeated(
    drive_rig: Any, connect: Any, caplog: pytest.LogCaptureFixture
) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    rig.simulator.inject("wrong_crc", count=2)
    status = drive.status()
    assert status.crc_errors == drive.counters()["crc_errors"] == 2
    assert drive.counters()["retries"] == 2
    assert not status.warnings, "the line is no warning of the drive"
    assert f"drive on {rig.port}: a packet was repeated: a damaged answer" in caplog.text


def test_only_wrong_crcs_are_an_error_with_what_was_seen(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, **PATIENT)
    rig.simulator.inject("wrong_crc")
    with pytest.raises(
        ProtocolError, match=r"6 tries: a damaged answer ‹CRC .* instead of .*COMBINED_STATUS"
    ):
        drive.status()


def test_a_missing_reply_is_repeated_and_told(
    drive_rig: Any, connect: Any, caplog: pytest.LogCaptureFixture
) -> None:
    rig = drive_rig()
    drive = connect(rig, reply_timeout_ms=100.0)
    rig.simulator.inject("no_reply", count=1)
    assert not drive.status().warnings
    assert "a packet was repeated: missing or short reply" in caplog.text


@pytest.mark.parametrize("fault", ["slow_reply", "duplicated_reply"])
def test_late_and_repeated_replies_do_not_become_wrong_values(
    drive_rig: Any, connect: Any, wait_until: Any, fault: str
) -> None:
    rig = drive_rig()
    drive = connect(rig, reply_timeout_ms=100.0, combined_status="never")
    delay_s = 0.15 if fault == "slow_reply" else None

    def told() -> bool:
        rig.simulator.inject(fault, count=1, value=delay_s)
        status = drive.status()
        assert status.speed_rev_per_s == 0.0
        assert status.supply_V == pytest.approx(48.0)
        assert not status.warnings, "the line is no warning of the drive"
        return bool(drive.counters()["late_bytes"] > 0)

    wait_until(told, "the late bytes to be counted")


@pytest.mark.parametrize("fault", ["wrong_acknowledge", "no_reply", "lost_command"])
@pytest.mark.parametrize("settings", [{}, {"combined_status": "never"}])
def test_a_write_is_obeyed_once_although_its_answer_failed(
    drive_rig: Any,
    connect: Any,
    wait_until: Any,
    caplog: pytest.LogCaptureFixture,
    fault: str,
    settings: dict[str, Any],
) -> None:
    rig = drive_rig()
    drive = connect(rig, reply_timeout_ms=100.0, **settings)
    rig.simulator.inject(fault, count=1, target=int(Command.RAMP_SPEED_M1))
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    assert "a packet was repeated: not acknowledged by FF" in caplog.text


def test_a_command_that_never_arrives_is_an_error(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, reply_timeout_ms=50.0)
    rig.simulator.inject("lost_command", target=int(Command.RAMP_SPEED_M1))
    with pytest.raises(ReplyTimeout, match="RAMP_SPEED_M1"):
        drive.set_speed(1.0, 1000.0)


@pytest.mark.parametrize("lost", [0, 1, 2])
@pytest.mark.parametrize("settings", [{}, {"combined_status": "never"}])
def test_a_late_acknowledgement_is_not_taken_for_that_of_the_power_off(
    drive_rig: Any, connect: Any, wait_until: Any, lost: int, settings: dict[str, Any]
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=20.0, reply_timeout_ms=100.0, **settings)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    rig.simulator.inject("slow_reply", target=int(Command.RAMP_SPEED_M1), value=0.15, count=1)
    rig.simulator.inject("lost_command", target=int(Command.DUTY_M1), count=lost)

    def slow_down() -> None:
        with contextlib.suppress(ReplyTimeout, DeviceFault):
            drive.set_speed(0.9, 1000.0)

    sent = len(rig.wire.received)
    other = threading.Thread(target=slow_down, name="other")
    other.start()
    wait_until(lambda: len(rig.wire.received) > sent, "the ramp to be sent")
    drive.drive_off()
    other.join(10.0)
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "what was confirmed", 1.0)


def test_a_power_off_that_is_acknowledged_and_ignored_is_an_error(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=20.0, **PATIENT)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    rig.simulator.inject("ignored_command", target=int(Command.DUTY_M1))
    with pytest.raises(ProtocolError, match=r"acknowledged, and not in effect.*DUTY_M1"):
        drive.drive_off()
    rig.simulator.clear("ignored_command")
    drive.drive_off()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")


def test_drive_off_ends_the_retries_of_another_call(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=20.0, reply_timeout_ms=1000.0)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 3600, "the speed")
    rig.simulator.inject("no_reply", target=int(Command.COMBINED_STATUS))
    outcome: list[DeviceError] = []

    def poll() -> None:
        try:
            drive.status()
        except DeviceError as error:
            outcome.append(error)

    asked = len(rig.wire.received)
    poller = threading.Thread(target=poll, name="poller")
    poller.start()
    wait_until(lambda: len(rig.wire.received) > asked, "the poll to begin")
    stopper = threading.Thread(target=drive.drive_off, name="stopper")
    stopper.start()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")
    assert poller.is_alive(), "the power is off while the other call still waits"
    poller.join(10.0)
    stopper.join(10.0)
    assert outcome
    assert "1 tries" in str(outcome[0])


def test_many_threads_share_one_link(drive_rig: Any, connect: Any) -> None:
    drive = connect(drive_rig(), **PATIENT)
    failures: list[BaseException] = []

    def use(call: Callable[[], Any]) -> None:
        try:
            for _ in range(20):
                call()
        except BaseException as failure:
            failures.append(failure)

    calls = (drive.status, lambda: drive.set_speed(1.0, 1.0), drive.status)
    threads = [
        threading.Thread(target=use, args=(call,), name=f"user {number}")
        for number, call in enumerate(calls)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(20.0)
    assert not failures
    assert drive.status().crc_errors == 0
