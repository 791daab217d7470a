"""Basicmicro RoboClaw as a Spindle: packet serial over USB or a UART.

The drive's serial time-out (command 14) is its watchdog: it is set and read back on every
connection, and any packet feeds it, so the period of ``status()`` must be shorter. There is no
command for an emergency stop: that is an input of the drive and a contactor.
"""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Iterator, Mapping
from typing import Any, Final

from rigapp.texts import joined, say
from rigapp_drivers.api import (
    DeviceError,
    DeviceFault,
    DeviceLost,
    DriveRequest,
    DriverInfo,
    DriverKind,
    DriveStatus,
    Identity,
    ProtocolError,
    ReplyTimeout,
    SettingRefused,
    SettingsLost,
    SettingSpec,
    filled,
)
from rigapp_drivers.roboclaw.commission import Setup, check_watchdog, commission, identify
from rigapp_drivers.roboclaw.link import Link
from rigapp_drivers.roboclaw.probe import PROBE
from rigapp_drivers.roboclaw.protocol import (
    BAUD_RATES,
    CURRENT_UNIT_A,
    TEMPERATURE_UNIT_C,
    TIMEOUT_UNIT_S,
    VOLTAGE_UNIT_V,
    Command,
    Decoder,
    EmergencyStopLock,
    combined_status_of,
)
from rigapp_drivers.roboclaw.readings import Readings, StatusReader
from rigapp_drivers.roboclaw.status import StatusWords, describe_status
from rigapp_drivers.spindles import (
    NEEDED,
    QUANTITIES,
    TORQUE_CONSTANT,
    note_survived_silence,
    ramp_steps,
    refuse_request,
    refuse_speed,
    settings_lost,
    silence_message,
    torque_Nm,
)
from rigapp_drivers.transport import SerialPort, byte_counters

SETTINGS: Final[Mapping[str, SettingSpec]] = {
    "address": SettingSpec(int, 128, say("Packet serial address of the drive."), 128, 135),
    "motor": SettingSpec(int, 1, say("Motor output that drives the spindle."), choices=(1, 2)),
    "baud_rate": SettingSpec(
        int, 38400, say("Baud rate of the drive's UART; USB ignores it."), choices=BAUD_RATES
    ),
    "status_width": SettingSpec(
        str,
        "auto",
        say('Bits of the status word; "auto" decides by the firmware and checks it.'),
        choices=("auto", "16", "32"),
    ),
    "combined_status": SettingSpec(
        str,
        "auto",
        say(
            'Read everything in one packet (command 73); "auto" checks once whether the'
            " drive supports it."
        ),
        choices=("auto", "never"),
    ),
    "reply_timeout_ms": SettingSpec(
        float, 100.0, say("Longest wait for a reply, besides its time on the wire."), 20.0, 1000.0
    ),
    "torque_constant_Nm_per_A": TORQUE_CONSTANT,
}


_MAXIMUM_SPEED: Final = 2**31 - 1
_MAXIMUM_ACCELERATION: Final = 2**32 - 1
_PWM_READINGS: Final = 3  # readings over a few ms, in which a starting ramp's duty grows above 0


class RoboClaw:
    """Turn the crank with one motor output of a RoboClaw.

    One lock serialises every call; ``drive_off`` bypasses it to send its packet and then verifies
    the effect.
    """

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._settings = filled(SETTINGS, settings)
        self._motor = int(self._settings["motor"])
        self._lock = threading.RLock()
        self._serial: SerialPort | None = None
        self._connection: Link | None = None
        self._setup: Setup | None = None
        self._target: int | None = None
        self._silence_s = 0.0
        self._reader: StatusReader | None = None

    # --- connection ------------------------------------------------------------------------------

    def open(self) -> Identity:
        """Open the port and identify the drive by its firmware text; no setting is changed.

        Raises ConnectionFailed if nothing answers, WrongDevice if another device does.
        """
        with self._lock:
            self._release()
            serial = SerialPort(self.name, self.port, int(self._settings["baud_rate"]))
            serial.open()
            self._serial = serial
            self._connection = Link(
                serial,
                self.name,
                self.port,
                int(self._settings["address"]),
                int(self._settings["baud_rate"]),
                float(self._settings["reply_timeout_ms"]) * 1e-3,
            )
            try:
                return identify(self._connection, str(self._settings["status_width"]))
            except BaseException:
                self._release()
                raise

    def configure(self, request: DriveRequest) -> Mapping[str, str | float | int]:
        """Switch the motor off, set the serial time-out, and return the values read back.

        Raises SettingRefused if a value cannot be set or is not read back as set.
        """
        with self._lock:
            link = self._link()
            self._setup = None
            refuse_request(self, request, self._settings, check_watchdog)
            self._off(link)
            combined = self._settings["combined_status"] == "auto"
            setup = commission(link, request, self._motor, combined)
            self._silence_s = 0.0
            self._reader = StatusReader(link, self._motor, setup.combined)
            self._setup = setup
            return setup.readback

    def close(self) -> None:
        """Switch the motor off and release the port; never raises; safe to call twice."""
        with self._power_off_first():
            link = self._connection
            if link is not None and self._setup is not None:
                with contextlib.suppress(DeviceError):  # the watchdog stops the drive
                    self._off(link)
            self._release()

    def _release(self) -> None:
        serial, self._serial = self._serial, None
        self._connection = None
        self._setup = None
        self._reader = None
        self._target = None
        if serial is not None:
            serial.close()

    # --- motion ----------------------------------------------------------------------------------

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        """Ramp to a speed in rev/s with the rig's sign; 0 is a controlled stop.

        Raises SettingRefused for a speed that is not allowed or not reachable, DeviceFault after a
        watchdog stop, until ``reset_fault`` or ``configure``.
        """
        stop_requests = self._link().stop_requests
        with self._lock:
            link, setup = self._link(), self._configured()
            speed = self._counts_per_s(speed_rev_per_s, setup)
            step = 1.0 / setup.request.counts_per_crank_revolution
            acceleration = ramp_steps(self, acceleration_rev_per_s2, step, _MAXIMUM_ACCELERATION)
            command = Command.RAMP_SPEED_M1 + self._motor - 1
            self._check_silence(link, setup)
            if speed and self._silence_s:
                raise DeviceFault.at(
                    self,
                    "{}; reset the fault before the next start.",
                    silence_message(self._silence_s),
                )
            if speed and not self._target:
                self._check_watchdog(link, setup)
            self._target = speed
            link.standing = False
            link.write(
                command,
                acceleration,
                speed,
                in_effect=lambda: self._turns_towards(link, setup, speed),
                stop_requests=stop_requests,
            )

    def _counts_per_s(self, speed_rev_per_s: float, setup: Setup) -> int:
        request = setup.request
        refuse_speed(self, speed_rev_per_s, request)
        speed = round(request.direction * speed_rev_per_s * request.counts_per_crank_revolution)
        if abs(speed) > min(setup.qpps, _MAXIMUM_SPEED):
            raise SettingRefused.at(
                self,
                "{} counts/s ({:.1f} rpm of the crank) is above the drive's own limit"
                " ‹QPPS› of {} counts/s; tune the drive's velocity loop.",
                abs(speed),
                speed_rev_per_s * 60,
                setup.qpps,
            )
        return speed

    def _turns_towards(self, link: Link, setup: Setup, speed: int) -> bool:
        """Read the state back after a failed write; repeating the command is safe."""
        if not setup.combined:
            link.read(Command.STATUS)
            return False
        status = combined_status_of(link.read(Command.COMBINED_STATUS))
        return status.setpoints[self._motor - 1] == speed != 0

    def drive_off(self) -> None:
        """Set duty 0, which removes the motor's power at once in any state.

        Raises ReplyTimeout, ProtocolError or DeviceLost if duty 0 is not read back, even if it was
        acknowledged.
        """
        with self._power_off_first():
            self._off(self._link())

    @contextlib.contextmanager
    def _power_off_first(self) -> Iterator[None]:
        """Hold the lock; if another call has it, send duty 0 during that call first."""
        link = self._connection
        if link is not None:
            link.request_stop()
        overtaken = not self._lock.acquire(blocking=False)
        if overtaken:
            if link is not None:
                with contextlib.suppress(DeviceError):  # the confirmed command raises it again
                    link.overtake(Command.DUTY_M1 + self._motor - 1, 0)
            self._lock.acquire()
        try:
            link = self._connection
            if link is not None:
                link.hurry.clear()
                if overtaken:  # its acknowledgement must not be taken for that of the next packet
                    with contextlib.suppress(DeviceError):
                        link.wait_for_quiet()
            yield
        finally:
            self._lock.release()

    def _off(self, link: Link) -> None:
        self._target = None
        command = Command.DUTY_M1 + self._motor - 1
        link.write(command, 0, in_effect=lambda: self._is_off(link), read_back=True)
        link.standing = True

    def _is_off(self, link: Link) -> bool:
        try:
            return not self._still_drives(link, tries=1)
        except (ReplyTimeout, ProtocolError):
            return False

    def reset_fault(self) -> None:
        """Switch the motor off, clear a watchdog stop and release a latched emergency stop.

        The release is sent only if the drive reports the stop: not every drive has that command.
        Raises DeviceFault with the remedy if a fault of the drive persists.
        """
        with self._lock:
            link = self._link()
            self._off(link)
            if self._setup is not None:
                self._check_watchdog(link, self._setup)
            self._silence_s = 0.0
            words = self._words(link)
            if words.emergency_stop:
                remedy = self._release_stop(link)
                words = self._words(link)
        if words.emergency_stop:
            raise DeviceFault.at(self, "the emergency stop stays: {}.", remedy)
        if words.faults:
            faults = joined(", ", words.faults)
            raise DeviceFault.at(self, "{}: remove the cause, then reset again.", faults)

    def _words(self, link: Link) -> StatusWords:
        (state,) = link.read(Command.STATUS)
        return describe_status(state, link.generation.status_bits)

    def _release_stop(self, link: Link) -> str:
        """Send the release of the emergency stop; return the remedy if it stays latched."""
        try:
            link.write(Command.RESET_EMERGENCY_STOP)
            (lock,) = link.read(Command.EMERGENCY_STOP_LOCK)
        except (ReplyTimeout, ProtocolError):
            return say(
                "release the emergency stop button; if it is released, a reset by"
                " command is not available in this drive: switch the drive off and on,"
                " then connect again"
            )
        if lock == EmergencyStopLock.HARDWARE:
            return say("switch the drive off and on")
        return say("release the emergency stop button first")

    # --- reading ---------------------------------------------------------------------------------

    def status(self) -> DriveStatus:
        """Return the state; this feeds the watchdog.

        Speed, count and set-point have the rig's sign. Needs one packet with command 73, else four,
        and one more in every eighth call. Raises SettingsLost after a restart of the drive,
        ReplyTimeout, ProtocolError.
        """
        with self._lock:
            link, setup = self._link(), self._configured()
            self._check_silence(link, setup)
            reader = self._reader
            assert reader is not None
            readings = reader.read()
            if reader.has_restarted(readings):
                self._setup = None
                self._target = None
                raise SettingsLost.at(
                    self, "the drive has restarted and its motor is off; check its supply."
                )
            # No set-point after a restart of the drive, but also at the beginning of a ramp.
            if reader.watchdog_is_due or (self._target and readings.setpoint == 0):
                self._check_watchdog(link, setup)
            return self._drive_status(link, setup.request, readings)

    def counters(self) -> Mapping[str, int]:
        """Return the counters of the line since it was opened; no lock, no communication."""
        serial, link = self._serial, self._connection
        if serial is None or link is None:
            return {}
        return {
            **byte_counters(serial),
            "crc_errors": link.crc_errors,
            "retries": link.retries,
            "late_bytes": link.late_bytes,
        }

    def _drive_status(self, link: Link, request: DriveRequest, read: Readings) -> DriveStatus:
        words = describe_status(read.state, link.generation.status_bits)
        faults = words.faults
        if self._silence_s:
            faults += (silence_message(self._silence_s),)
        target = self._target or 0
        setpoint = target if read.setpoint is None or self._target is None else read.setpoint
        scale = request.direction / request.counts_per_crank_revolution
        return DriveStatus(
            host_time_ns=time.monotonic_ns(),
            speed_rev_per_s=read.speed * scale,
            setpoint_rev_per_s=setpoint * scale,
            position_count=read.count * request.direction,
            current_A=read.current * CURRENT_UNIT_A,
            supply_V=read.main_voltage * VOLTAGE_UNIT_V,
            temperature_C=read.temperature * TEMPERATURE_UNIT_C,
            torque_Nm=torque_Nm(read.current * CURRENT_UNIT_A, self._settings),
            enabled=(self._target is not None or bool(read.pwm)) and not faults,
            emergency_stop=words.emergency_stop,
            faults=faults,
            warnings=words.warnings,
            crc_errors=link.crc_errors,
        )

    def _check_silence(self, link: Link, setup: Setup) -> None:
        """Record a watchdog stop, and switch the motor off.

        The drive's state shows whether it stopped; this computer's clock only triggers the check.
        """
        silence_s = (time.monotonic_ns() - link.last_sent_ns) * 1e-9
        if self._target is None or silence_s <= setup.watchdog_s:
            return
        if self._target == 0 or self._still_drives(link):
            note_survived_silence(self, silence_s, setup.watchdog_s)
            return
        self._off(link)
        self._silence_s = silence_s

    def _still_drives(self, link: Link, tries: int | None = None) -> bool:
        """Return whether the motor has power; a ramp that has just begun may still show duty 0."""
        return any(link.read(Command.PWM, tries)[self._motor - 1] for _ in range(_PWM_READINGS))

    def _check_watchdog(self, link: Link, setup: Setup) -> None:
        """Read the serial time-out; if it differs, remove the power and raise SettingsLost."""
        (units,) = link.read(Command.GET_TIMEOUT)
        if units == setup.watchdog_units:
            return
        with contextlib.suppress(DeviceError):  # the caller's stop raises the error again
            self._off(link)
        self._setup = None
        raise settings_lost(self, units * TIMEOUT_UNIT_S, setup.watchdog_s)

    # --- helpers ---------------------------------------------------------------------------------

    def _link(self) -> Link:
        if self._connection is None:
            raise DeviceLost.at(self, "the drive is not open.")
        return self._connection

    def _configured(self) -> Setup:
        if self._setup is None:
            raise SettingRefused.at(
                self, "the drive's watchdog is not set; configure the drive first."
            )
        return self._setup


DRIVER: Final = DriverInfo(
    name="roboclaw",
    title=say("Basicmicro RoboClaw"),
    kind=DriverKind.SPINDLE,
    factory=RoboClaw,
    settings=SETTINGS,
    simulator="rigapp_drivers.roboclaw.simulator:RoboClawSimulator",
    usb_ids=((0x03EB, 0x2404),),
    probe=PROBE,
    check=check_watchdog,
    quantities=QUANTITIES,
    needed=NEEDED,
    decoder=Decoder,
)
