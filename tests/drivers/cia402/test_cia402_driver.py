"""The CiA 402 driver against its simulator over slcan on a pty."""

from __future__ import annotations

import math
import socket
import threading
import time
from collections.abc import Callable
from typing import Any

import can
import pytest

from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceFault,
    DeviceLost,
    ReplyTimeout,
    SettingRefused,
    SettingsLost,
    Spindle,
    WrongDevice,
)
from rigapp_drivers.cia402.driver import DRIVER, SETTINGS, Cia402Drive
from rigapp_drivers.cia402.network import bus_options
from rigapp_drivers.cia402.protocol import RPM, State, state_of
from rigapp_drivers.cia402.simulator import Cia402Simulator
from rigapp_drivers.cia402.slcan import Frame, encode_frame
from rigapp_drivers.registry import check_settings, load_driver, load_simulator
from rigapp_drivers.simulator_api import DriveMode

QUICK = {"sleep_after_open_s": 0.0}


def state(rig: Any) -> State | None:
    """Return the state of the simulated drive."""
    return state_of(rig.simulator.node.axis.status_word())


def test_the_driver_is_found_by_its_name_and_is_a_spindle() -> None:
    info = load_driver("cia402")
    assert info is DRIVER
    assert load_simulator(info) is Cia402Simulator
    settings = check_settings(info, {"node_id": 5}, "rig.toml [devices.drive.settings]")
    assert isinstance(info.factory("drive", "none", settings), Spindle)


def test_every_interface_has_its_arguments() -> None:
    defaults = {key: spec.default for key, spec in SETTINGS.items()}
    for interface in SETTINGS["interface"].choices:
        options = bus_options("0", {**defaults, "interface": interface})
        assert options["interface"] == interface
        assert options["bitrate"] == 500_000
    assert bus_options("can0", {**defaults, "interface": "socketcan"})["channel"] == "can0"
    assert bus_options("1", {**defaults, "interface": "kvaser"})["channel"] == 1
    with pytest.raises(ValueError, match="a number"):
        bus_options("can0", {**defaults, "interface": "kvaser"})


@pytest.mark.parametrize("node_id", [1, 5])
def test_the_spindle_turns_ramps_and_stops(
    drive_rig: Any, connect: Any, wait_until: Any, node_id: int
) -> None:
    rig = drive_rig(node_id=node_id)
    drive = connect(rig, node_id=node_id)
    assert state(rig) is State.SWITCH_ON_DISABLED
    drive.set_speed(2.0, 40.0)
    wait_until(lambda: rig.speed_rpm == 120, "the ramp's end")
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
    assert not status.warnings
    assert not status.emergency_stop
    assert drive.status().position_count > status.position_count > 0
    drive.set_speed(0.0, 40.0)
    wait_until(lambda: rig.last.speed_count_per_s == 0, "the controlled stop")
    assert state(rig) is State.ENABLED
    drive.drive_off()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")
    assert not drive.status().enabled
    drive.set_speed(0.0, 40.0)
    assert state(rig) is State.SWITCH_ON_DISABLED, "a stop does not switch the power on"


def test_direction_turns_every_sign(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    drive.configure(request_for(direction=-1))
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == -60, "the drive to turn backward")
    status = drive.status()
    assert status.speed_rev_per_s == pytest.approx(1.0)
    assert status.setpoint_rev_per_s == pytest.approx(1.0)
    wait_until(lambda: drive.status().position_count > 100, "the count to rise")


def test_a_geared_drive_is_set_in_turns_of_its_motor(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    readback = drive.configure(request_for(gear_ratio=4.8))
    objects = rig.simulator.node.objects
    assert objects.number(0x607F) == 3456, "12 rev/s of the crank"
    assert readback["maximum_speed_rev_per_s"] == pytest.approx(12.0)
    assert readback["gear_ratio"] == 4.8
    drive.set_speed(1.0, 2.0)
    assert objects.number(0x60FF) == 288
    assert objects.number(0x6083) == objects.number(0x6084) == 576
    wait_until(lambda: rig.speed_rpm == 288, "the motor's speed")
    assert drive.status().speed_rev_per_s == pytest.approx(1.0)


def test_an_old_target_does_not_turn_the_motor_when_it_is_enabled(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    drive.set_speed(5.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 300, "the speed")
    drive.drive_off()
    seen = len(rig.commands)
    drive.set_speed(0.5, 1000.0)
    wait_until(lambda: rig.speed_rpm == 30, "the new speed")
    assert max(command.speed_count_per_s for command in rig.commands[seen + 3 :]) <= 1800


def test_the_identity_names_maker_and_device(drive_rig: Any) -> None:
    drive = Cia402Drive("drive", drive_rig(device_name="EPOS4 70/15").port, QUICK)
    identity = drive.open()
    assert (identity.maker, identity.model) == ("maxon", "EPOS4 70/15")
    assert identity.firmware == "0170"
    assert identity.serial_number == "12345678"
    drive.close()
    drive.close()


def test_configure_sets_both_supervisions_and_reads_back(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=1.5, heartbeat_ms=50)
    objects = rig.simulator.node.objects
    assert objects.number(0x1016, 1) == 0x007F_05DC
    assert objects.number(0x1017) == 50
    assert objects.number(0x6007) == 3
    assert objects.number(0x607F) == 720, "the rig's maximum is the drive's own limit"
    readback = drive._setup.readback
    assert readback["watchdog_timeout_s"] == 1.5
    assert readback["velocity_unit"] == "00B44700"
    assert readback["synchronous_pdo"] == readback["control_pdo"] == 1
    assert readback["quick_stop_option"] == 6


def test_a_foreign_drive_tells_current_torque_and_voltage_by_its_profile(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig(vendor=0x1234)
    drive = connect(rig)
    assert drive.configure(request_for())["quantities"] == "current_A, torque_Nm, supply_V"
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    status = drive.status()
    assert status.speed_rev_per_s == pytest.approx(1.0)
    assert status.current_A == pytest.approx(0.36, abs=0.012), "30 per mille of 12 A"
    assert status.torque_Nm == pytest.approx(0.018, abs=0.0006), "30 per mille of 600 mNm"
    assert status.supply_V == pytest.approx(48.0)
    assert math.isnan(status.temperature_C)


FOREIGN = {
    0x6007: ("", "pull the cable at a low speed"),
    0x603F: ("", ""),
    0x605A: ("", ""),
    0x6061: ("", ""),
    0x6076: ("", ""),
    0x6077: ("", ""),
    0x6078: ("", ""),
    0x6079: ("", ""),
    0x607F: ("", "rigapp alone keeps it"),
    0x6080: ("", ""),
    0x6083: ("", "ramps up or down by its own setting, not by the test file's; change the ramp"),
    0x6084: ("", "‹no object 6084›"),
    0x6085: ("", ""),
    0x6086: ("", ""),
    0x6502: ("", ""),
    0x1005: ("", ""),
    0x1008: ("", ""),
    0x1018: ("", ""),
    0x1029: ("", ""),
    0x1400: ("", ""),
    0x1600: ("", ""),
    0x1802: ("", ""),
    0x1A03: ("", ""),
    0x60A9: ("give velocity_step_rpm from its manual", ""),
    0x1016: ("it lacks the monitor of this computer ‹object 1016:1›", ""),
    0x1017: ("it lacks its heartbeat", ""),
    0x6040: ("it lacks commands", ""),
    0x6041: ("it lacks its state", ""),
    0x6060: ("it lacks its mode", ""),
    0x6064: ("it lacks its position", ""),
    0x606C: ("it lacks its speed", ""),
    0x60FF: ("it lacks the speed to turn at", ""),
}
"""Object that the drive lacks -> how the set-up ends, or what it advises."""


@pytest.mark.sampled(every=4)
@pytest.mark.parametrize("lacking", FOREIGN, ids=hex)
def test_a_foreign_drive_turns_without_what_is_optional(
    drive_rig: Any, wait_until: Any, request_for: Any, lacking: int
) -> None:
    rig = drive_rig(vendor=0x1234, lacking=(lacking,))
    drive = Cia402Drive("drive", rig.port, QUICK)
    refused, advised = FOREIGN[lacking]
    try:
        drive.open()
        if refused:
            with pytest.raises(SettingRefused, match=refused):
                drive.configure(request_for())
            return
        assert advised in str(drive.configure(request_for()).get("advice", ""))
        drive.set_speed(1.0, 1000.0)
        wait_until(lambda: rig.speed_rpm == 60, "the speed")
        assert not drive.status().faults
        rig.simulator.inject("emergency", value=0x2310)
        wait_until(lambda: bool(drive.status().faults), "the fault")
        wait_until(lambda: state(rig) is State.FAULT, "the end of the fault's reaction")
        drive.reset_fault()
        drive.set_speed(0.5, 1000.0)
        wait_until(lambda: rig.speed_rpm == 30, "the speed after the fault")
        for _ in range(9):
            drive.status()
        drive.drive_off()
        assert not drive.status().enabled
    finally:
        drive.close()


def test_a_drive_without_a_velocity_unit_turns_by_the_step_of_the_rig_file(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig(vendor=0x1234, lacking=(0x60A9,))
    drive = connect(rig, velocity_step_rpm=1.0)
    told = drive.configure(request_for())
    assert told["velocity_step_rev_per_s"] == pytest.approx(1 / 60)
    assert told["velocity_unit"] == "not there"
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    drive.close()
    other = Cia402Drive("drive", drive_rig(vendor=0x1234).port, {**QUICK, "velocity_step_rpm": 0.1})
    other.open()
    try:
        with pytest.raises(SettingRefused, match=r"steps of 1 rpm .*, the rig file says .* = 0.1:"):
            other.configure(request_for())
    finally:
        other.close()


def test_a_byte_that_is_no_ascii_on_slcan_ends_no_test(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    drive.set_speed(1.0, 1000.0)
    for noise in (b"\xff", b"t70\x8115\r", b"\xe9\xe9\r\r"):
        rig.wire.send(noise)
        wait_until(lambda: rig.speed_rpm == 60, "the speed")
        assert not drive.status().faults
    wait_until(lambda: drive.counters()["bad_frames"] >= 3, "the noise to be counted")
    assert drive.status().speed_rev_per_s == pytest.approx(1.0)


def test_any_adapter_of_python_can_carries_a_drive_its_faults_and_its_silence(
    wait_until: Any, request_for: Any
) -> None:
    simulator = Cia402Simulator(vendor=0x1234, node_id=7)
    adapter = can.Bus("bench", interface="virtual")
    ended = threading.Event()

    def serve() -> None:
        node = simulator.node
        while not ended.is_set():
            message = adapter.recv(0.002)
            now_s = time.monotonic()
            if message is not None:
                node.take(Frame(message.arbitration_id, bytes(message.data)), now_s)
            node.tick(now_s)
            node.advance(0.002)
            for frame in node.collect(now_s):
                sent = can.Message(
                    arbitration_id=frame.identifier, data=frame.data, is_extended_id=False
                )
                adapter.send(sent)

    bus = threading.Thread(target=serve, daemon=True)
    bus.start()
    drive = Cia402Drive("drive", "bench", {"interface": "virtual", "node_id": 7})
    try:
        assert drive.open().details["objects"] == "generic"
        drive.configure(request_for())
        drive.set_speed(1.0, 1000.0)
        wait_until(lambda: abs(drive.status().speed_rev_per_s - 1.0) < 1e-9, "the speed")
        simulator.node.emergency(0x2310, time.monotonic())
        wait_until(lambda: bool(drive.status().faults), "the fault")
        drive.reset_fault()
        assert not drive.status().faults
        simulator.node.objects.set(0x1017, 0)
        with pytest.raises(SettingsLost, match="has lost its settings"):
            wait_until(lambda: bool(drive.status().faults), "the silence")
    finally:
        drive.close()
        ended.set()
        bus.join()
        adapter.shutdown()


def test_milli_rpm_makes_slow_speeds_exact_and_whole_rpm_are_told_at_the_set_up(
    drive_rig: Any, connect: Any, wait_until: Any, request_for: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    told = drive.configure(request_for())
    assert "in steps of 1 rpm of the crank, so a speed below 50 rpm" in told["advice"]
    drive.set_speed(0.5083, 1000.0)
    assert not drive.status().warnings
    drive.close()
    fine = connect(rig, velocity_unit="milli-rpm")
    assert "advice" not in fine.configure(request_for())
    fine.set_speed(0.5083, 1000.0)
    wait_until(lambda: abs(rig.speed_rpm - 30.498) < 1e-6, "the exact speed")
    status = fine.status()
    assert status.speed_rev_per_s == pytest.approx(0.5083, rel=1e-4)
    assert not status.warnings


def test_an_unknown_velocity_unit_is_refused(drive_rig: Any, request_for: Any) -> None:
    rig = drive_rig()
    rig.simulator.node.objects.entries[0x60A9, 0].read = lambda: 0x0041_0300
    drive = Cia402Drive("drive", rig.port, QUICK)
    drive.open()
    with pytest.raises(SettingRefused, match=r"the unit of its speed.*‹object 60A9 is 00410300"):
        drive.configure(request_for())
    with pytest.raises(SettingRefused, match="configure"):
        drive.set_speed(1.0, 1.0)
    drive.close()


def test_a_wrong_encoder_resolution_is_refused(drive_rig: Any, request_for: Any) -> None:
    drive = Cia402Drive("drive", drive_rig(counts_per_revolution=2000).port, QUICK)
    drive.open()
    with pytest.raises(SettingRefused, match=r"2000 counts per revolution.*3600"):
        drive.configure(request_for())
    drive.close()


@pytest.mark.parametrize(
    ("abort_index", "named"),
    [(0x1016, "1016:1"), (0x6007, "6007:0"), (0x6060, "6060:0"), (0x1017, "1017:0")],
)
def test_a_drive_that_refuses_its_supervision_is_refused(
    drive_rig: Any, request_for: Any, abort_index: int, named: str
) -> None:
    rig = drive_rig(faults=[{"kind": "sdo_abort", "target": abort_index, "value": 0x0800_0022}])
    drive = Cia402Drive("drive", rig.port, QUICK)
    drive.open()
    with pytest.raises(SettingRefused, match=named):
        drive.configure(request_for())
    drive.close()


@pytest.mark.parametrize(
    ("speed", "acceleration", "why"),
    [
        (12.1, 1.0, "726.0 rpm is above"),
        (math.nan, 1.0, "not a number"),
        (-math.inf, 1.0, "not a number"),
        (1.0, 0.0, "acceleration"),
        (1.0, math.nan, "acceleration"),
    ],
)
def test_what_may_not_be_is_refused(
    drive_rig: Any, connect: Any, speed: float, acceleration: float, why: str
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    with pytest.raises(SettingRefused, match=why):
        drive.set_speed(speed, acceleration)
    assert state(rig) is State.SWITCH_ON_DISABLED


# --- connection -----------------------------------------------------------------------------------


def test_a_lost_first_request_is_repeated(drive_rig: Any) -> None:
    rig = drive_rig(faults=[{"kind": "no_sdo_reply", "count": 2}])
    drive = Cia402Drive("drive", rig.port, {**QUICK, "sdo_timeout_ms": 50.0})
    assert drive.open().maker == "maxon"
    drive.close()


def test_a_stopped_node_is_woken(drive_rig: Any) -> None:
    rig = drive_rig()
    rig.simulator.receive(b"S6\rO\rt0002020", time.monotonic())
    rig.simulator.receive(b"1\rC\r", time.monotonic())
    drive = Cia402Drive("drive", rig.port, {**QUICK, "sdo_timeout_ms": 50.0})
    assert drive.open().maker == "maxon"
    drive.close()


def test_a_missing_node_and_a_wrong_bit_rate_are_named(drive_rig: Any) -> None:
    rig = drive_rig()
    for wrong in ({"node_id": 9}, {"bit_rate": 250_000}):
        settings = {**QUICK, "sdo_timeout_ms": 20.0, **wrong}
        drive = Cia402Drive("drive", rig.port, settings)
        with pytest.raises(ConnectionFailed, match=r"did not answer.*bit rate ‹object 1000:0›"):
            drive.open()
        with pytest.raises(DeviceLost, match="not open"):
            drive.status()


def test_another_kind_of_node_is_named(drive_rig: Any) -> None:
    rig = drive_rig()
    rig.simulator.node.objects.set(0x1000, 0x0003_0191)
    drive = Cia402Drive("drive", rig.port, QUICK)
    with pytest.raises(WrongDevice, match="00030191"):
        drive.open()


def test_a_channel_that_is_not_there_is_named() -> None:
    drive = Cia402Drive("drive", "/dev/does-not-exist", QUICK)
    with pytest.raises(ConnectionFailed, match="slcan cannot be opened"):
        drive.open()


def test_a_pulled_adapter_is_named_and_close_bears_it(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig)
    drive.set_speed(1.0, 10.0)
    rig.wire.unplug()
    with pytest.raises(DeviceLost, match="adapter"):
        drive.status()
    drive.close()


def test_the_drive_is_reached_through_a_socket(request_for: Any) -> None:
    simulator = Cia402Simulator()
    server = socket.create_server(("127.0.0.1", 0))
    stopping = threading.Event()

    def serve() -> None:
        connection, _ = server.accept()
        connection.settimeout(0.002)
        with connection:
            while not stopping.is_set():
                try:
                    data = connection.recv(4096)
                except TimeoutError:
                    data = b""
                else:
                    if not data:
                        return
                now_s = time.monotonic()
                connection.sendall(simulator.receive(data, now_s))
                simulator.command(0.0, now_s)

    thread = threading.Thread(target=serve, name="socket server")
    thread.start()
    drive = Cia402Drive("drive", f"socket://127.0.0.1:{server.getsockname()[1]}", QUICK)
    try:
        assert drive.open().maker == "maxon"
        drive.configure(request_for())
        assert not drive.status().faults
    finally:
        drive.close()
        stopping.set()
        thread.join(5.0)
        server.close()


def test_close_leaves_the_drive_without_power_and_without_an_error(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=0.2)
    drive.set_speed(1.0, 1000.0)
    drive.close()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")
    seen = rig.simulator.node
    end = rig.time_s + 0.4
    wait_until(lambda: rig.time_s > end, "the supervision's time to be over")
    assert seen.objects.number(0x603F) == 0
    again = connect(rig)
    assert not again.status().faults


# --- supervision ----------------------------------------------------------------------------------


def test_a_silent_host_makes_the_drive_stop_quickly_and_is_told_so(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=1.0)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    wait_until(lambda: rig.simulator.node.objects.number(0x603F) == 0x8130, "error 8130")
    wait_until(lambda: rig.speed_rpm == 0, "the quick stop")
    assert state(rig) is State.QUICK_STOP
    wait_until(lambda: drive.emergencies != (), "the emergency message")
    status = drive.status()
    assert any("watchdog: the host was silent" in fault for fault in status.faults)
    assert any("8130" in fault for fault in status.faults)
    assert not status.enabled
    with pytest.raises(DeviceFault, match="reset the fault"):
        drive.set_speed(0.5, 1000.0)
    drive.reset_fault()
    assert not drive.status().faults
    drive.set_speed(0.5, 1000.0)
    wait_until(lambda: rig.speed_rpm == 30, "the next start")


def test_a_host_that_was_held_up_believes_the_drive_whether_its_supervision_has_fired(
    drive_rig: Any, connect: Any, wait_until: Any, monkeypatch: pytest.MonkeyPatch, caplog: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=5.0)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    monkeypatch.setattr(drive._node, "last_beat_ns", time.monotonic_ns() - 9 * 10**9)
    assert not drive.status().faults
    assert rig.speed_rpm == 60
    assert "its watchdog of 5.00 s has not fired" in caplog.text


def test_a_new_speed_after_a_silence_is_refused_although_no_status_was_read(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=0.3)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.simulator.node.objects.number(0x603F) == 0x8130, "error 8130")
    with pytest.raises(DeviceFault, match=r"watchdog.*reset the fault"):
        drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.last.speed_count_per_s == 0, "the stop")


def test_status_feeds_the_supervision(drive_rig: Any, connect: Any, wait_until: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, watchdog_s=1.0)
    drive.set_speed(1.0, 1000.0)
    begun = rig.time_s

    def fed_for_longer_than_the_supervision() -> bool:
        assert not drive.status().faults
        return bool(rig.time_s - begun > 1.5)

    wait_until(fed_for_longer_than_the_supervision, "the drive's time to pass")
    assert rig.speed_rpm == 60
    assert rig.simulator.node.objects.number(0x603F) == 0


def test_a_missing_heartbeat_of_the_drive_is_told(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, heartbeat_ms=20)
    drive.set_speed(1.0, 1000.0)
    assert not drive.status().faults
    rig.simulator.inject("lost_heartbeat")
    wait_until(lambda: drive.status().faults != (), "the missing heartbeat")
    assert any("heartbeat is missing" in fault for fault in drive.status().faults)
    drive.drive_off()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")


def test_a_silent_node_is_a_missing_reply(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig, sdo_timeout_ms=50.0, pdo_timeout_ms=20.0)
    rig.simulator.inject("silent_node")
    with pytest.raises(ReplyTimeout, match="did not answer"):
        drive.status()


def test_bus_off_is_told_by_silence_and_afterwards_by_its_message(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, sdo_timeout_ms=50.0, pdo_timeout_ms=20.0)
    drive.set_speed(1.0, 1000.0)
    rig.simulator.inject("bus_off")
    with pytest.raises(ReplyTimeout):
        drive.status()
    rig.simulator.clear("bus_off")
    wait_until(lambda: drive.emergencies != (), "the emergency message")
    assert any("bus off" in fault for fault in drive.status().faults)


def test_a_restart_in_the_middle_of_a_test_is_noticed(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig, sdo_timeout_ms=50.0)
    drive.set_speed(1.0, 1000.0)
    drive.status()
    rig.simulator.inject("boot_up", value=0.0)
    wait_until(lambda: drive._monitor.boot_ups > 0, "the boot-up message")
    with pytest.raises(DeviceLost, match="has restarted"):
        drive.status()
    with pytest.raises(SettingRefused, match="configure"):
        drive.set_speed(1.0, 1.0)


@pytest.mark.parametrize("lost", [0x60A9, 0x607F, 0x6061])
def test_a_setting_that_was_lost_since_is_found_before_the_motor_is_enabled(
    drive_rig: Any, connect: Any, lost: int
) -> None:
    rig = drive_rig()
    drive = connect(rig, velocity_unit="milli-rpm")
    rig.simulator.node.objects.set(lost, 1 if lost != 0x60A9 else RPM)
    with pytest.raises(DeviceLost, match="speed unit, limits or heartbeat"):
        drive.set_speed(1.0, 1000.0)
    assert rig.last.mode is DriveMode.OFF


def test_a_node_that_leaves_operational_is_told(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    rig.simulator.node.take(_frame(0x000, "80 01"), 0.0)
    wait_until(lambda: drive.status().faults != (), "the other state")
    assert any("does not operate any more" in fault for fault in drive.status().faults)
    drive.reset_fault()
    assert not drive.status().faults


def _frame(identifier: int, data: str) -> Frame:
    return Frame(identifier, bytes.fromhex(data))


# --- faults ---------------------------------------------------------------------------------------


@pytest.mark.sampled
@pytest.mark.parametrize("code", [0x2310, 0x3220, 0x7320, 0x8611, 0xFF0B, 0x2345])
def test_a_fault_during_a_run_is_told_in_words_and_reset(
    drive_rig: Any, connect: Any, wait_until: Any, code: int
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    rig.simulator.inject("emergency", value=code)
    wait_until(lambda: drive.status().faults != (), "the fault")
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the fault reaction")
    status = drive.status()
    assert any(f"error {code:04X}" in fault for fault in status.faults), status.faults
    assert not status.enabled
    assert drive.emergencies[-1].code == code
    with pytest.raises(DeviceFault, match=f"{code:04X}"):
        drive.set_speed(1.0, 1.0)
    drive.reset_fault()
    assert not drive.status().faults
    assert rig.last.mode is DriveMode.OFF, "it must not start by itself"
    drive.set_speed(0.5, 1000.0)
    wait_until(lambda: rig.speed_rpm == 30, "the next start")


def test_a_fault_that_was_there_before_is_told_at_the_start(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig(faults=[{"kind": "emergency", "value": 0x3210}])
    drive = connect(rig)
    assert any("error 3210" in fault for fault in drive.status().faults)
    with pytest.raises(DeviceFault, match="3210"):
        drive.set_speed(1.0, 1.0)


def test_safe_torque_off_is_an_emergency_stop(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    drive.set_speed(1.0, 1000.0)
    rig.simulator.inject("torque_off")
    wait_until(lambda: drive.status().emergency_stop, "the emergency stop")
    assert any("has left operation enabled" in fault for fault in drive.status().faults)
    drive.drive_off()
    with pytest.raises(DeviceFault):
        drive.set_speed(1.0, 1.0)
    rig.simulator.clear("torque_off")
    wait_until(lambda: not drive.status().emergency_stop, "the release")
    drive.reset_fault()
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the next start")


@pytest.mark.parametrize("fault", ["late_tpdo", "no_tpdo"])
def test_late_and_missing_pdos_are_told_and_replaced(
    drive_rig: Any,
    connect: Any,
    wait_until: Any,
    caplog: pytest.LogCaptureFixture,
    fault: str,
) -> None:
    rig = drive_rig()
    drive = connect(rig, pdo_timeout_ms=20.0)
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    rig.simulator.inject(fault)
    status = drive.status()
    assert "late after SYNC" in caplog.text
    assert drive.counters()["late_pdos"] > 0
    assert not status.warnings, "the bus is no warning of the drive"
    assert status.speed_rev_per_s == pytest.approx(1.0)
    rig.simulator.clear(fault)

    def in_time() -> bool:
        before = drive.counters()["late_pdos"]
        return not drive.status().faults and drive.counters()["late_pdos"] == before

    wait_until(in_time, "the PDOs to be in time again")


def test_an_abort_in_a_run_names_the_object(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig)
    rig.simulator.inject("sdo_abort", target=0x6083, value=0x0609_0030)
    with pytest.raises(SettingRefused, match=r"node 1 refused.*‹object 6083:0: .*06090030"):
        drive.set_speed(1.0, 1.0)


def test_a_garbled_line_does_not_end_the_reception(drive_rig: Any, connect: Any) -> None:
    rig = drive_rig()
    drive = connect(rig)
    rig.simulator.inject("garbled_line", count=3)
    for _ in range(3):
        assert not drive.status().faults
    assert drive.status().crc_errors > 0


def test_an_emergency_that_came_and_went_is_told_once(
    drive_rig: Any, connect: Any, wait_until: Any
) -> None:
    rig = drive_rig()
    drive = connect(rig)
    for data in ("20 81 10 00 00 00 00 00", "00 00 00 00 00 00 00 00"):
        rig.wire.send(encode_frame(_frame(0x081, data)))
    wait_until(lambda: len(drive.emergencies) >= 1, "the messages")
    wait_until(lambda: drive.emergencies[-1].code == 0, "the end message")
    assert any("came and ended: " in w and "error 8120" in w for w in drive.status().warnings)
    assert not drive.status().warnings


# --- stopping -------------------------------------------------------------------------------------


@pytest.mark.parametrize("control_pdo", [True, False])
def test_drive_off_does_not_wait_for_another_call(
    drive_rig: Any, connect: Any, wait_until: Any, control_pdo: bool
) -> None:
    rig = drive_rig()
    if not control_pdo:
        rig.simulator.inject("sdo_abort", target=0x1600)
    drive = connect(rig, watchdog_s=20.0, sdo_timeout_ms=2000.0)
    assert drive._setup.control_pdo is control_pdo
    drive.set_speed(1.0, 1000.0)
    wait_until(lambda: rig.speed_rpm == 60, "the speed")
    drive.status()
    rig.simulator.inject("no_sdo_reply", count=2)
    outcome: list[ReplyTimeout] = []

    def poll() -> None:
        try:
            drive.status()
        except ReplyTimeout as error:
            outcome.append(error)

    asked = len(rig.wire.received)
    poller = threading.Thread(target=poll, name="poller")
    poller.start()
    wait_until(lambda: len(rig.wire.received) > asked + 20, "the poll to begin")
    stopper = threading.Thread(target=drive.drive_off, name="stopper")
    stopper.start()
    wait_until(lambda: rig.last.mode is DriveMode.OFF, "the power to be off")
    assert poller.is_alive(), "the power is off while the other call still waits"
    poller.join(10.0)
    stopper.join(10.0)
    assert outcome
    assert "1 tries" in str(outcome[0])


def test_many_threads_share_one_node(drive_rig: Any, connect: Any) -> None:
    drive = connect(drive_rig())
    failures: list[BaseException] = []

    def use(call: Callable[[], Any]) -> None:
        try:
            for _ in range(15):
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
    assert not drive.status().faults
