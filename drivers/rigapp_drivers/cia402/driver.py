"""A CiA 402 drive (maxon EPOS4 or another maker's) as a Spindle, over CANopen.

The drive supervises this computer's heartbeat (object 1016) and performs a quick stop when it is
missing. Every call sends one heartbeat, and no thread does, so a program that hangs stops the
spindle.
"""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

from rigapp.texts import say
from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceError,
    DeviceFault,
    DeviceLost,
    DriveRequest,
    DriverInfo,
    DriverKind,
    DriveStatus,
    Identity,
    SettingRefused,
    SettingsLost,
    SettingSpec,
    filled,
)
from rigapp_drivers.cia402.commission import (
    SUPERVISION,
    Commissioning,
    ObjectKey,
    Setup,
    check_watchdog,
)
from rigapp_drivers.cia402.control import Condition, DriveControl, Readings
from rigapp_drivers.cia402.monitor import AxisMotion, NodeMonitor
from rigapp_drivers.cia402.network import TRIES, CanNode, bus_options, identify
from rigapp_drivers.cia402.probe import PROBE
from rigapp_drivers.cia402.protocol import (
    EMERGENCY_BASE,
    HEARTBEAT_BASE,
    RPDO1_BASE,
    Control,
    Emergency,
    Nmt,
    State,
    state_of,
)
from rigapp_drivers.cia402.slcan import Decoder
from rigapp_drivers.spindles import (
    QUANTITIES,
    TORQUE_CONSTANT,
    note_survived_silence,
    ramp_steps,
    refuse_speed,
    settings_lost,
    silence_message,
)

BIT_RATES: Final = (10_000, 20_000, 50_000, 100_000, 125_000, 250_000, 500_000, 750_000, 1_000_000)
INTERFACES: Final = ("slcan", "socketcan", "pcan", "kvaser", "gs_usb")

SETTINGS: Final[Mapping[str, SettingSpec]] = {
    "interface": SettingSpec(
        str, "slcan", say("CAN adapter; the port is its channel."), choices=INTERFACES
    ),
    "bit_rate": SettingSpec(int, 500_000, say("Bit rate of the CAN bus."), choices=BIT_RATES),
    "node_id": SettingSpec(int, 1, say("Node id of the drive."), 1, 127),
    "host_node_id": SettingSpec(
        int, 127, say("Node id under which this computer sends its heartbeat."), 1, 127
    ),
    "heartbeat_ms": SettingSpec(
        int, 100, say("Period of the drive's heartbeat, which is supervised."), 20, 1000
    ),
    "sdo_timeout_ms": SettingSpec(
        float, 200.0, say("Longest wait for the answer to one request."), 20.0, 2000.0
    ),
    "pdo_timeout_ms": SettingSpec(
        float, 100.0, say("Longest wait for speed and position after a SYNC."), 5.0, 2000.0
    ),
    "sleep_after_open_s": SettingSpec(
        float,
        0.1,
        say("Wait after opening an slcan adapter; one that resets needs 2 s."),
        0.0,
        10.0,
    ),
    "objects": SettingSpec(
        str,
        "auto",
        say('Objects to use: "auto" takes the EPOS4\'s own when the maker is maxon.'),
        choices=("auto", "epos4", "generic"),
    ),
    "velocity_unit": SettingSpec(
        str,
        say("as set"),
        say("Unit to set in the drive; milli-rpm is finer, and not every drive has it."),
        choices=(say("as set"), "rpm", "milli-rpm"),
    ),
    "velocity_step_rpm": SettingSpec(
        float,
        0.0,
        say(
            "Step of the drive's speed commands, in rpm of the motor, from its manual, where"
            " the drive does not report it (object 60A9); 0: as reported."
        ),
        0.0,
        1e3,
    ),
    "acceleration_unit_rpm_per_s": SettingSpec(
        float, 1.0, say("Step of the drive's accelerations (assumed; see its manual)."), 1e-6, 1e6
    ),
    "supply_unit_V": SettingSpec(float, 0.1, say("Step of object 2200:1 (assumed)."), 1e-6, 1e3),
    "current_unit_A": SettingSpec(float, 0.001, say("Step of object 30D1:1 (assumed)."), 1e-6, 1e3),
    "temperature_unit_C": SettingSpec(
        float, 0.1, say("Step of object 3201:1 (assumed)."), 1e-6, 1e3
    ),
    "torque_on_inputs": SettingSpec(
        int,
        3,
        say(
            "Bits of object 3202:1 that are set while safe torque off is not active"
            " (assumed); 0 does not check."
        ),
        0,
        255,
    ),
    "torque_constant_Nm_per_A": TORQUE_CONSTANT,
}

_log = logging.getLogger(__name__)

_INT32: Final = 2**31 - 1


class Cia402Drive:
    """Turn the crank with a CiA 402 drive in profile velocity mode.

    One lock serialises every call; ``drive_off`` bypasses it to send its control word and then
    verifies the effect.
    """

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._settings = filled(SETTINGS, settings)
        self._lock = threading.RLock()
        self._node: CanNode | None = None
        self._monitor = NodeMonitor()
        self._setup: Setup | None = None
        self._readings: Readings | None = None
        self._epos = False
        self._target: int | None = None
        self._trip = ""

    # --- connection ------------------------------------------------------------------------------

    def open(self) -> Identity:
        """Open the bus and identify the drive; no setting is changed.

        Raises ConnectionFailed if the bus or the node is missing, WrongDevice if the node is no
        CiA 402 drive.
        """
        with self._lock:
            self._release()
            node_id = int(self._settings["node_id"])
            try:
                options = bus_options(self.port, self._settings)
            except ValueError as error:
                raise ConnectionFailed.at(self, "{}.", error) from error
            timeout_s = float(self._settings["sdo_timeout_ms"]) * 1e-3
            node = CanNode(self.name, self.port, node_id, options, timeout_s)
            self._monitor = monitor = NodeMonitor()
            node.listen(HEARTBEAT_BASE + node_id, monitor.take_heartbeat)
            node.listen(EMERGENCY_BASE + node_id, monitor.take_emergency)
            node.open()
            self._node = node
            try:
                interface, objects = self._settings["interface"], self._settings["objects"]
                identity = identify(node, str(interface), str(objects))
            except BaseException:
                self._release()
                raise
            node.tries = TRIES
            self._epos = identity.details["objects"] == "epos4"
            return identity

    def configure(self, request: DriveRequest) -> Mapping[str, str | float | int]:
        """Switch the motor off, set the supervision in both directions, and read all back.

        Raises SettingRefused if the drive does not accept a value, ReplyTimeout, DeviceLost.
        """
        with self._lock:
            node = self._open_node()
            self._setup = None
            self._target = None
            commissioning = Commissioning(node, self._monitor, self._settings, self._epos)
            setup = commissioning.run(request)
            self._trip = ""
            self._monitor.forget_active()
            self._readings = Readings(node, self._monitor, setup, self._settings, self._epos)
            self._setup = setup
            return setup.readback

    def close(self) -> None:
        """Switch the motor off, end the supervision, release the bus; never raises."""
        with self._power_off_first():
            node = self._node
            if node is not None and self._setup is not None:
                with contextlib.suppress(DeviceError):  # the heartbeat supervision stops the drive
                    DriveControl(node).power_off()
                    node.command(Nmt.PRE_OPERATIONAL)
                    node.write(0x1016, 0, 1)
            self._release()

    def _release(self) -> None:
        node, self._node = self._node, None
        self._setup = None
        self._target = None
        if node is not None:
            node.close()

    # --- motion ----------------------------------------------------------------------------------

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        """Ramp to a speed in rev/s with the rig's sign; 0 is a controlled stop.

        Enables the drive if necessary. Raises SettingRefused for a speed that is not allowed,
        DeviceFault if the drive is in fault or was stopped by a fault that is not reset.
        """
        stop_requests = self._open_node().stop_requests
        with self._lock:
            node, setup = self._open_node(), self._configured()
            target = self._steps(speed_rev_per_s, setup)
            ramp = ramp_steps(self, acceleration_rev_per_s2, setup.acceleration_unit, _INT32)
            self._check_restart(setup)
            self._check_silence(node, setup)
            control = DriveControl(node, stop_requests)
            state = control.state()
            if target == 0 and state is not State.ENABLED:
                return
            if target != 0 and self._trip:
                raise DeviceFault.at(self, "{}; reset the fault before the next start.", self._trip)
            enable = target != 0 and state is not State.ENABLED
            if enable:
                self._check_setup(node, setup.kept, setup)
            for index in setup.ramps:
                node.write(index, ramp)
            if enable:
                control.enable()
            control.give_way()
            self._target = target
            node.write(0x60FF, target)
            node.write(0x6040, Control.ENABLE)

    def _steps(self, speed_rev_per_s: float, setup: Setup) -> int:
        refuse_speed(self, speed_rev_per_s, setup.request)
        steps = round(setup.request.direction * speed_rev_per_s / setup.velocity_unit)
        if abs(steps) > _INT32:
            raise SettingRefused.at(
                self,
                "{:.1f} rpm is above the largest speed command of the drive ‹object 60FF›.",
                speed_rev_per_s * 60,
            )
        return steps

    def drive_off(self) -> None:
        """Remove the motor's power at once (disable voltage); it coasts.

        Raises ReplyTimeout, DeviceLost without a confirmation by the drive.
        """
        with self._power_off_first():
            node = self._open_node()
            self._target = None
            DriveControl(node).power_off()

    @contextlib.contextmanager
    def _power_off_first(self) -> Iterator[None]:
        """Hold the lock; send the control word before acquiring it, if possible.

        Sent as a PDO if the drive accepts one, and also as an SDO during a pending call, as a node
        that is not operational ignores PDOs.
        """
        node, setup = self._node, self._setup
        held = self._lock.acquire(blocking=False)
        if node is not None:
            node.stop_requests += 1
            node.hurry.set()
            with contextlib.suppress(DeviceError):  # the confirmed command raises the error again
                if setup is not None and setup.control_pdo:
                    word = int(Control.DISABLE_VOLTAGE).to_bytes(2, "little")
                    node.send(RPDO1_BASE + node.node_id, word)
                if not held:
                    node.overtake(0x6040, Control.DISABLE_VOLTAGE)
        if not held:
            self._lock.acquire()
        try:
            if self._node is not None:
                self._node.hurry.clear()
            yield
        finally:
            self._lock.release()

    def reset_fault(self) -> None:
        """Switch the motor off and acknowledge faults; raise DeviceFault if one persists.

        Raises SettingsLost if the drive has lost its settings.
        """
        stop_requests = self._open_node().stop_requests
        with self._lock:
            node = self._open_node()
            self._target = None
            DriveControl(node, stop_requests).acknowledge(self._monitor)
            if self._setup is not None:
                self._check_setup(node, self._setup.kept, self._setup)
            self._monitor.forget_active()
            self._trip = ""

    # --- reading ---------------------------------------------------------------------------------

    def status(self) -> DriveStatus:
        """Return the state; this sends a heartbeat to the drive.

        Speed, count and set-point have the rig's sign. Current, supply and temperature are NaN if
        the drive has no object for them. Raises SettingsLost after a restart of the drive,
        ReplyTimeout.
        """
        with self._lock:
            node, setup = self._open_node(), self._configured()
            self._check_restart(setup)
            self._check_silence(node, setup)
            node.beat()
            readings = self._readings
            assert readings is not None
            motion = readings.motion()
            self._check_restart(setup)
            if readings.supervision_is_due or self._left_enabled(motion):
                self._check_setup(node, SUPERVISION, setup)
            condition = readings.condition()
            faults = readings.faults(motion, condition, running=self._target is not None)
            if self._trip:
                faults.insert(0, self._trip)
            elif faults and self._target is not None:
                self._trip = faults[0]
            warnings = readings.warnings(motion)
            return self._drive_status(setup, motion, condition, faults, warnings)

    @property
    def emergencies(self) -> tuple[Emergency, ...]:
        """Return the last 64 emergency messages of the drive, oldest first."""
        return self._monitor.history

    def counters(self) -> Mapping[str, int]:
        """Return the counters of the bus since it was opened; no lock, no communication."""
        node = self._node
        if node is None:
            return {}
        return {
            "frames_received": node.frames_received,
            "frames_sent": node.frames_sent,
            "bad_frames": node.bad_frames,
            "retries": node.retries,
            "late_pdos": 0 if self._readings is None else self._readings.late_pdos,
            "emergencies": self._monitor.emergencies,
        }

    def _drive_status(
        self,
        setup: Setup,
        motion: AxisMotion,
        condition: Condition,
        faults: list[str],
        warnings: list[str],
    ) -> DriveStatus:
        scale = setup.request.direction * setup.velocity_unit
        enabled = state_of(motion.status_word) is State.ENABLED
        return DriveStatus(
            host_time_ns=time.monotonic_ns(),
            speed_rev_per_s=motion.velocity * scale,
            setpoint_rev_per_s=(self._target or 0) * scale,
            position_count=motion.position * setup.request.direction,
            current_A=condition.current_A,
            supply_V=condition.supply_V,
            temperature_C=condition.temperature_C,
            torque_Nm=condition.torque_Nm,
            enabled=enabled and not faults,
            emergency_stop=condition.torque_off,
            faults=tuple(dict.fromkeys(faults)),
            warnings=tuple(dict.fromkeys(warnings)),
            crc_errors=self._open_node().bad_frames,
        )

    def _check_silence(self, node: CanNode, setup: Setup) -> None:
        """Record a stop by the drive's heartbeat supervision, and switch the motor off.

        The drive's state shows whether it stopped; this computer's clock only triggers the check.
        """
        silence_s = (time.monotonic_ns() - node.last_beat_ns) * 1e-9
        if self._target is None or silence_s <= setup.watchdog_s:
            return
        if DriveControl(node).state() is State.ENABLED:
            note_survived_silence(self, silence_s, setup.watchdog_s)
            return
        self._target = None
        self._trip = silence_message(silence_s)
        node.write(0x6040, Control.QUICK_STOP)

    def _left_enabled(self, motion: AxisMotion) -> bool:
        """Return whether the drive is no longer enabled, for example after an unnoticed restart."""
        return self._target is not None and state_of(motion.status_word) is not State.ENABLED

    def _check_setup(self, node: CanNode, objects: Iterable[ObjectKey], setup: Setup) -> None:
        """Read back settings; if one differs, remove the power and raise SettingsLost.

        A restart may lose only some of them, and its only message, the boot-up, may be lost.
        """
        for index, subindex in objects:
            expected = setup.kept.get((index, subindex))  # None: the drive has no such object
            if expected is None or (readback := node.read(index, subindex)) == expected:
                continue
            _log.warning(
                "%s on %s: object %04X:%d reads %d after %d was set",
                self.name,
                self.port,
                index,
                subindex,
                readback,
                expected,
            )
            self._setup = None
            self._target = None
            with contextlib.suppress(DeviceError):  # the caller's stop raises the error again
                DriveControl(node).power_off()
            watchdog_s = (node.read(0x1016, 1) & 0xFFFF) * 1e-3
            raise settings_lost(self, watchdog_s, setup.watchdog_s)

    def _check_restart(self, setup: Setup) -> None:
        if self._monitor.boot_ups != setup.boot_ups:
            self._setup = None
            self._target = None
            raise SettingsLost.at(
                self,
                "the drive has restarted (boot-up message) and its motor is off; check its supply.",
            )

    # --- helpers ---------------------------------------------------------------------------------

    def _open_node(self) -> CanNode:
        if self._node is None:
            raise DeviceLost.at(self, "the drive is not open.")
        return self._node

    def _configured(self) -> Setup:
        if self._setup is None:
            raise SettingRefused.at(
                self, "the drive is not supervised yet; configure the drive first."
            )
        return self._setup


DRIVER: Final = DriverInfo(
    name="cia402",
    title=say("maxon EPOS4 or another CiA 402 drive (CANopen)"),
    kind=DriverKind.SPINDLE,
    factory=Cia402Drive,
    settings=SETTINGS,
    simulator="rigapp_drivers.cia402.simulator:Cia402Simulator",
    probe=PROBE,
    check=check_watchdog,
    quantities=QUANTITIES,
    decoder=Decoder,
    protocol="slcan",
)
