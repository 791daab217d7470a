"""Contract tests of every spindle with its simulator, including the contract's faults."""

from __future__ import annotations

import contextlib
import re
import threading
import time
from collections.abc import Callable
from dataclasses import replace

import pytest

from rigapp.testing.bench import COUNTS, PATIENCE, WATCHDOG_S, SpindleBench, wait_until
from rigapp.testing.contracts import Contract, ExpectedFault
from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceError,
    DeviceFault,
    DriveStatus,
    SettingRefused,
)

pytestmark = pytest.mark.rigapp_contract

Make = Callable[..., SpindleBench]
SAFE_S = WATCHDOG_S + 1.5
PATIENT_S = 5.0
PROMPT_S = 0.2
"""Time limit for a power-off to be sent, by the drive's clock: it waits for no time-out."""
BORNE = ("nothing", "warning", "log")
"""Kinds of report after which the spindle continues to turn."""


def test_open_configure_turn_stop_close_reopen_twice(spindle: Contract, bench: Make) -> None:
    b = bench(spindle)
    for _ in range(3):
        b.driver.open()
        with pytest.raises(SettingRefused, match="configure the drive first"):
            b.driver.set_speed(1.0, 10.0)
        b.connect(PATIENT_S)
        for speed in (2.0, -1.0):
            b.turn(speed)
            status = b.driver.status()
            assert status.speed_rev_per_s == pytest.approx(speed, abs=0.02)
            assert status.setpoint_rev_per_s == pytest.approx(speed, abs=0.02)
            assert status.enabled
            assert not status.faults
        b.driver.set_speed(0.0, 1000.0)
        wait_until(b.is_safe, "the controlled stop")
        b.turn()
        b.driver.drive_off()
        wait_until(b.is_safe, "the power to be off")
        assert not b.driver.status().enabled
        b.turn()
        b.driver.close()
        b.driver.close()
        wait_until(b.is_safe, "close to stop the motor")
        b.driver = b.make()


@pytest.mark.parametrize("gear_ratio", [4.8, 0.5])
def test_a_gear_is_between_motor_and_crank(
    spindle: Contract, bench: Make, gear_ratio: float
) -> None:
    b = bench(spindle)
    b.connect(PATIENT_S, gear_ratio)
    for speed in (1.5, -1.0):
        b.turn(speed)
        assert b.motor.speed_count_per_s == pytest.approx(speed * COUNTS * gear_ratio, abs=1.0)
        status = b.driver.status()
        assert status.speed_rev_per_s == pytest.approx(speed, abs=0.02)
        assert status.setpoint_rev_per_s == pytest.approx(speed, abs=0.02)
        assert not status.faults
    with pytest.raises(
        SettingRefused, match=r"720\.6 rpm is above the rig's maximum of 720\.0 rpm"
    ):
        b.driver.set_speed(12.01, 10.0)
    begun, moment = b.driver.status().position_count, b.port.time_s
    wait_until(lambda: b.port.time_s > moment + 1.0, "a second of the drive's time")
    turned = abs(b.driver.status().position_count - begun) / (COUNTS * gear_ratio)
    assert turned > 0.9, "its own count is the motor's"
    b.driver.set_speed(0.0, 1000.0)
    wait_until(b.is_safe, "the controlled stop")


def test_a_port_in_use_is_refused_and_the_motor_goes_on(spindle: Contract, bench: Make) -> None:
    b = bench(spindle)
    b.connect(PATIENT_S)
    b.turn()
    second = b.make()
    with pytest.raises(ConnectionFailed, match="in use by another program"):
        second.open()
    second.close()
    assert not b.driver.status().faults
    b.turn(1.0)


def test_close_from_another_thread_stops_the_motor(spindle: Contract, bench: Make) -> None:
    b = bench(spindle)
    b.connect(PATIENT_S)
    b.turn()
    outcome: list[BaseException] = []
    began = threading.Event()

    def poll() -> None:
        try:
            while True:
                b.driver.status()
                began.set()
        except BaseException as error:
            outcome.append(error)

    poller = threading.Thread(target=poll, name="poller", daemon=True)
    poller.start()
    assert began.wait(60.0)
    b.driver.close()
    poller.join(60.0)
    assert not poller.is_alive(), "the poller hangs after close"
    assert isinstance(outcome[0], DeviceError), outcome
    wait_until(b.is_safe, "close to stop the motor")
    b.driver = b.make()
    b.connect(PATIENT_S)
    b.turn()


def test_a_silent_host_stops_the_motor(spindle: Contract, bench: Make) -> None:
    b = bench(spindle)
    b.connect()
    b.turn()
    b.stops_within(SAFE_S, b.port.time_s, "the drive's own watchdog")
    with pytest.raises(DeviceFault, match=r"watchdog.*reset the fault"):
        b.driver.set_speed(1.0, 10.0)
    assert any("watchdog" in words for words in b.driver.status().faults)
    b.driver.reset_fault()
    assert b.is_safe(), "a reset must not start the motor"
    b.turn()


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("kind", ["restart_unseen", "watchdog_lost"])
@pytest.mark.parametrize("call", ["set_speed", "reset_fault"])
def test_a_drive_that_does_not_supervise_the_host_is_not_enabled(
    spindle: Contract, bench: Make, kind: str, call: str
) -> None:
    b = bench(spindle)
    b.connect(PATIENT_S)
    b.turn()
    b.driver.drive_off()
    b.port.start_fault(spindle.fault(kind))
    with pytest.raises(DeviceError):
        b.driver.reset_fault() if call == "reset_fault" else b.driver.set_speed(1.0, 10.0)
    assert b.is_safe()
    b.driver.close()
    b.driver = b.make()
    b.connect()
    b.turn()
    b.stops_within(SAFE_S, b.port.time_s, "the drive's own watchdog")


@pytest.mark.parametrize("call", ["set_speed", "reset_fault"])
def test_a_power_off_waits_for_no_other_call(spindle: Contract, bench: Make, call: str) -> None:
    fault = spindle.fault("slow_command")
    b = bench(spindle, **fault.settings)
    b.connect(PATIENT_S)
    b.turn()
    calls = {
        "set_speed": lambda: b.driver.set_speed(1.0, 1000.0),
        "reset_fault": b.driver.reset_fault,
    }
    b.port.start_fault(fault)
    before = len(b.port.received)
    slow = b.in_background(calls[call])
    wait_until(lambda: len(b.port.received) > before, "the slow call to begin")
    sent, moment = len(b.port.received), b.port.time_s
    off = b.in_background(b.driver.drive_off)
    wait_until(lambda: len(b.port.received) > sent, "the power-off on the wire")
    assert b.port.time_s - moment < PROMPT_S, "a power-off waits for no other call"
    b.stops_within(PROMPT_S, moment, "the power to be off")
    for thread in (slow, off):
        thread.join(60.0)
        assert not thread.is_alive()
    assert b.is_safe(), "what was under way must not turn the motor again"
    b.port.stop_fault(fault)
    b.driver.drive_off()
    b.turn()


def test_a_power_off_without_effect_is_not_confirmed(spindle: Contract, bench: Make) -> None:
    b = bench(spindle)
    b.connect(PATIENT_S)
    b.turn()
    fault = spindle.fault("ignored_command")
    b.port.start_fault(fault)
    with pytest.raises(DeviceError):
        b.driver.drive_off()
    assert not b.is_safe()
    b.port.stop_fault(fault)
    b.driver.drive_off()
    b.stops_within(PROMPT_S, b.port.time_s, "the power to be off")
    b.turn()


@pytest.mark.parametrize("ignored", [1, 2, 4])
def test_what_is_confirmed_late_or_for_another_command_is_no_power_off(
    spindle: Contract, bench: Make, ignored: int
) -> None:
    b = bench(spindle)
    b.connect(PATIENT_S)
    late = replace(spindle.fault("slow_command"), value=0.15, count=ignored)
    for _ in range(3):
        b.turn()
        b.port.start_fault(late)
        b.port.start_fault(replace(spindle.fault("ignored_command"), count=ignored))
        slow = b.in_background(lambda: b.driver.set_speed(1.5, 1000.0))
        with contextlib.suppress(DeviceError):
            b.driver.drive_off()
            b.stops_within(PROMPT_S, b.port.time_s, "what was confirmed")
        slow.join(60.0)
        b.port.stop_fault(late)
        b.port.stop_fault(spindle.fault("ignored_command"))
        b.driver.drive_off()
        b.stops_within(PROMPT_S, b.port.time_s, "what was confirmed")


@pytest.mark.sampled(every=2)
def test_fault_is_told_in_time_and_the_spindle_is_safe(
    spindle_fault: tuple[Contract, ExpectedFault], bench: Make, caplog: pytest.LogCaptureFixture
) -> None:
    spindle, fault = spindle_fault
    b = bench(spindle, **fault.settings)
    b.connect()
    b.turn()
    b.port.start_fault(fault)
    reported, words = _poll_until_reported(b, fault, caplog)
    assert reported in fault.tells, f"{fault.name}: told {reported}: {words}"
    assert re.search(fault.words, words), words
    if reported not in BORNE:
        with contextlib.suppress(DeviceError):
            b.driver.drive_off()
        b.stops_within(SAFE_S, b.port.time_s, "the spindle to be safe")
    b.port.stop_fault(fault)
    if reported in BORNE:
        b.turn(1.0)
    elif reported == "fault":
        _resets(b)
    else:
        b.driver.close()
        _reconnects(b)


def _poll_until_reported(
    b: SpindleBench, fault: ExpectedFault, log: pytest.LogCaptureFixture
) -> tuple[str, str]:
    """Poll as the engine does and check the values; return the kind of the report and its text."""
    patience = 1.0 if "nothing" in fault.tells else PATIENCE
    deadline = b.port.time_s + patience * fault.within_s
    reported = "nothing", ""
    while b.port.time_s < deadline:
        try:
            status = b.driver.status()
        except DeviceError as error:
            return _named(error, b)
        if status.faults:
            assert not status.enabled
            reported = "fault", "; ".join(status.faults)
            if re.search(fault.words, reported[1]):
                return reported
            continue
        _is_true(b, status)
        if "log" in fault.tells and log.text and re.search(fault.words, log.text):
            return "log", log.text
        if status.warnings and "warning" in fault.tells:
            return "warning", "; ".join(status.warnings)
        time.sleep(0.01)
    return reported


def _named(error: DeviceError, b: SpindleBench) -> tuple[str, str]:
    assert str(error).startswith(f"drive on {b.port.url}: ")
    return type(error).__name__, error.sentence


def _is_true(b: SpindleBench, status: DriveStatus) -> None:
    """Compare a status without a fault with the motor."""
    speeds = {0.0, 2.0}
    assert any(abs(status.speed_rev_per_s - speed) < 0.05 for speed in speeds), status
    assert status.setpoint_rev_per_s == pytest.approx(2.0, abs=0.01), status
    assert status.position_count / COUNTS < 1000.0, status


def _resets(b: SpindleBench) -> None:
    """Check that a reset acknowledges the fault, and that only a new speed turns the motor."""

    def is_reset() -> bool:
        try:
            b.driver.reset_fault()
        except DeviceFault:
            return False
        return not b.driver.status().faults

    wait_until(is_reset, "the fault to be reset")
    assert b.is_safe(), "a reset must not start the motor"
    b.turn()


def _reconnects(b: SpindleBench) -> None:
    """Reopen until it succeeds; nothing turns before a command."""
    b.driver = b.make()

    def connected() -> bool:
        try:
            b.connect(PATIENT_S)
        except DeviceError:
            b.driver.close()
            return False
        return True

    wait_until(connected, "the device to be there again")
    assert b.is_safe(), "a connection must not start the motor"
    b.driver.reset_fault()
    b.turn()
