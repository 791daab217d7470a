"""A CiA 402 drive (maxon EPOS4 or another maker's) as a Spindle, over CANopen.

The drive supervises this computer's heartbeat (object 1016) and stops quickly when it is missing.
No thread sends that heartbeat: every call sends one, so a program that hangs stops the spindle.
"""

from __future__ import annotations

import contextlib
import math
import threading
import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from drivers.api import (
    ConnectionFailed,
    DeviceError,
    DeviceFault,
    DeviceLost,
    DriveRequest,
    DriverInfo,
    DriverKind,
    DriveStatus,
    Identity,
    ReplyTimeout,
    SettingRefused,
    WrongDevice,
)
from drivers.cia402.monitor import Motion, NodeMonitor
from drivers.cia402.protocol import (
    EMERGENCY_BASE,
    HEARTBEAT_BASE,
    INTERNAL_LIMIT_BIT,
    PROFILE_402,
    RPDO1_BASE,
    SYNC_ID,
    VENDOR_MAXON,
    WARNING_BIT,
    Control,
    Emergency,
    Nmt,
    NodeState,
    State,
    describe_code,
    state_of,
    step_towards_enabled,
)
from drivers.cia402.settings import SETTINGS, bus_options

if TYPE_CHECKING:
    from drivers.cia402.commission import Setup
    from drivers.cia402.network import CanNode

_FIRST_TRIES: Final = 3
_STEP_S: Final = 1.0
_HEARTBEATS_MISSED: Final = 3
_HEARTBEAT_LEAST_S: Final = 0.5
_CATCH_UP_S: Final = 0.1
_ROUNDING: Final = 0.01
_INT32: Final = 2**31 - 1
_POWERLESS: Final = (
    State.NOT_READY,
    State.SWITCH_ON_DISABLED,
    State.READY,
    State.SWITCHED_ON,
    State.FAULT,
)


class Cia402Drive:
    """Turn the crank with a CiA 402 drive in profile velocity mode.

    Every call is serialised by one lock. ``drive_off`` and ``quick_stop`` first send their control
    word as a PDO, without waiting for the lock, and then confirm it.
    """

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._settings = {key: settings.get(key, spec.default) for key, spec in SETTINGS.items()}
        self._lock = threading.RLock()
        self._node: CanNode | None = None
        self._monitor = NodeMonitor()
        self._setup: Setup | None = None
        self._epos = False
        self._target: int | None = None
        self._trip = ""
        self._rounding = ""
        self._polls = 0
        self._slow = [math.nan, math.nan]
        self._torque_off = False

    # --- connection ------------------------------------------------------------------------------

    def open(self) -> Identity:
        """Open the bus and identify the drive; nothing is set.

        Raises ConnectionFailed when the bus or the node is not there, WrongDevice when the node is
        no CiA 402 drive.
        """
        from drivers.cia402.network import CanNode

        with self._lock:
            self._release()
            node_id = int(self._settings["node_id"])
            try:
                options = bus_options(self.port, self._settings)
            except ValueError as error:
                raise ConnectionFailed(self.name, self.port, f"{error}.") from error
            timeout_s = float(self._settings["sdo_timeout_ms"]) * 1e-3
            node = CanNode(self.name, self.port, node_id, options, timeout_s)
            self._monitor = monitor = NodeMonitor()
            node.listen(HEARTBEAT_BASE + node_id, monitor.take_heartbeat)
            node.listen(EMERGENCY_BASE + node_id, monitor.take_emergency)
            node.open()
            self._node = node
            try:
                return self._identify(node)
            except BaseException:
                self._release()
                raise

    def _identify(self, node: CanNode) -> Identity:
        try:
            device_type = self._wake(node)
        except ReplyTimeout as error:
            raise ConnectionFailed(self.name, self.port, error.sentence) from error
        if device_type & 0xFFFF != PROFILE_402:
            raise WrongDevice(
                self.name,
                self.port,
                f"node {node.node_id} is no CiA 402 drive (device type {device_type:08X}).",
            )
        vendor, product, revision, serial = (node.read_if_there(0x1018, sub) for sub in range(1, 5))
        chosen = self._settings["objects"]
        self._epos = chosen == "epos4" or (chosen == "auto" and vendor == VENDOR_MAXON)
        return Identity(
            maker="maxon" if vendor == VENDOR_MAXON else f"vendor {vendor or 0:08X}",
            model=node.read_text(0x1008) or f"product {product or 0:08X}",
            firmware=f"{(revision or 0) >> 16:04X}",
            serial_number=f"{serial:08X}" if serial else "",
            port=self.port,
            details={
                "node_id": str(node.node_id),
                "interface": str(self._settings["interface"]),
                "objects": "epos4" if self._epos else "generic",
            },
        )

    def _wake(self, node: CanNode) -> int:
        """Return the device type; a stopped node, or one that finds the bit rate, needs a push."""
        try:
            return node.read(0x1000, tries=_FIRST_TRIES)
        except ReplyTimeout:
            node.command(Nmt.PRE_OPERATIONAL)
            return node.read(0x1000, tries=_FIRST_TRIES)

    def configure(self, request: DriveRequest) -> Mapping[str, str | float | int]:
        """Switch the motor off, set the supervision in both directions, and read all back.

        Raises SettingRefused when the drive does not take a value, ReplyTimeout, DeviceLost.
        """
        from drivers.cia402.commission import Commissioning

        with self._lock:
            node = self._open_node()
            self._setup = None
            self._target = None
            commissioning = Commissioning(node, self._monitor, self._settings, self._epos)
            setup = commissioning.run(request)
            self._trip = self._rounding = ""
            self._polls = 0
            self._monitor.forget_active()
            self._setup = setup
            return setup.readback

    def close(self) -> None:
        """Switch the motor off, end the supervision, release the bus; never raises."""
        node = self._node
        if node is not None:
            node.hurry.set()
        with self._lock:
            node = self._node
            if node is not None and self._setup is not None:
                node.hurry.clear()
                with contextlib.suppress(DeviceError):  # the drive's supervision stops it anyway
                    self._off(node)
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
        """Ramp to a speed in rev/s, signed as the rig; 0 is the controlled stop.

        Enables the drive when it is not. Raises SettingRefused for a speed that may not be,
        DeviceFault when the drive is in fault or was stopped by a fault that nobody has reset.
        """
        with self._lock:
            node, setup = self._open_node(), self._configured()
            target = self._steps(speed_rev_per_s, setup)
            ramp = self._ramp_steps(acceleration_rev_per_s2, setup)
            self._judge_restart(setup)
            state = self._state(node)
            if target == 0 and state is not State.ENABLED:
                return
            if target != 0 and self._trip:
                raise DeviceFault(
                    self.name, self.port, f"{self._trip}; reset the fault before the next start."
                )
            node.write(0x6083, ramp)
            node.write(0x6084, ramp)
            if target != 0 and state is not State.ENABLED:
                self._enable(node)
            self._give_way(node)
            self._target = target
            node.write(0x60FF, target)
            node.write(0x6040, Control.ENABLE)

    def _steps(self, speed_rev_per_s: float, setup: Setup) -> int:
        if not math.isfinite(speed_rev_per_s):
            raise self._refused(f"a speed of {speed_rev_per_s} is not a number.")
        limit = setup.request.maximum_speed_rev_per_s
        if abs(speed_rev_per_s) > limit * (1 + 1e-9):
            raise self._refused(
                f"{speed_rev_per_s * 60:.1f} rpm is above the rig's maximum of "
                f"{limit * 60:.1f} rpm."
            )
        steps = round(setup.request.direction * speed_rev_per_s / setup.velocity_unit)
        if abs(steps) > _INT32:
            raise self._refused(f"{speed_rev_per_s * 60:.1f} rpm does not fit into object 60FF.")
        real = setup.request.direction * steps * setup.velocity_unit
        self._rounding = ""
        if abs(real - speed_rev_per_s) > _ROUNDING * abs(speed_rev_per_s):
            self._rounding = (
                f"the drive's whole steps make {real * 60:.2f} rpm of {speed_rev_per_s * 60:.2f} "
                "rpm; choose a finer velocity_unit"
            )
        return steps

    def _ramp_steps(self, acceleration_rev_per_s2: float, setup: Setup) -> int:
        ramp = acceleration_rev_per_s2 / setup.acceleration_unit
        if not (math.isfinite(ramp) and ramp > 0):
            raise self._refused(
                f"an acceleration of {acceleration_rev_per_s2:g} rev/s2 is not possible."
            )
        return min(max(1, round(ramp)), _INT32)

    def _enable(self, node: CanNode) -> None:
        """Go step by step to operation enabled, with target velocity 0."""
        node.write(0x60FF, 0)
        state = self._state(node)
        while state is not State.ENABLED:
            if state in (State.FAULT, State.FAULT_REACTION):
                raise DeviceFault(
                    self.name,
                    self.port,
                    f"the drive is in fault, {describe_code(node.read(0x603F))}; reset it first.",
                )
            self._give_way(node)
            step = step_towards_enabled(state)
            if step is not None:
                node.write(0x6040, step)
            state = self._wait_to_leave(node, state, "on its way to operation enabled")

    def _give_way(self, node: CanNode) -> None:
        if node.hurry.is_set():
            raise DeviceFault(self.name, self.port, "a stop came before the speed was set.")

    def _wait_to_leave(self, node: CanNode, state: State | None, why: str) -> State | None:
        deadline = time.monotonic() + _STEP_S
        while (now := self._state(node)) is state:
            if node.hurry.is_set() or time.monotonic() > deadline:
                raise ReplyTimeout(
                    self.name,
                    self.port,
                    f"the drive stays in state {state or 'unknown'} for {_STEP_S:g} s {why}; look "
                    "at its safe-torque-off inputs and its supply.",
                )
        return now

    def quick_stop(self) -> None:
        """Stop with the drive's own quick-stop deceleration; the next start needs a reset."""
        self._command_at_once(Control.QUICK_STOP)
        with self._lock:
            node = self._open_node()
            node.hurry.clear()
            self._target = None
            self._trip = self._trip or "the drive was stopped quickly"
            node.write(0x6040, Control.QUICK_STOP)

    def drive_off(self) -> None:
        """Take the power off the motor at once (disable voltage); it coasts.

        Raises ReplyTimeout, DeviceLost when the drive did not confirm it.
        """
        self._command_at_once(Control.DISABLE_VOLTAGE)
        with self._lock:
            node = self._open_node()
            node.hurry.clear()
            self._off(node)

    def _command_at_once(self, control: Control) -> None:
        """Send a control word by PDO past the lock, and end the retries of a call under way."""
        node, setup = self._node, self._setup
        if node is None:
            return
        node.hurry.set()
        if setup is not None and setup.control_pdo:
            with contextlib.suppress(DeviceError):  # the confirmed command meets the error again
                node.send(RPDO1_BASE + node.node_id, int(control).to_bytes(2, "little"))

    def _off(self, node: CanNode) -> None:
        self._target = None
        node.write(0x6040, Control.DISABLE_VOLTAGE)
        deadline = time.monotonic() + _STEP_S
        while (state := self._state(node)) not in _POWERLESS:
            if time.monotonic() > deadline:
                raise ReplyTimeout(
                    self.name,
                    self.port,
                    f"the drive stays in state {state or 'unknown'} after disable voltage; use the "
                    "emergency stop.",
                )
        node.write(0x60FF, 0)

    def reset_fault(self) -> None:
        """Switch the motor off and acknowledge faults; raise DeviceFault when one stays."""
        with self._lock:
            node = self._open_node()
            self._target = None
            if self._setup is not None and self._monitor.node_state != NodeState.OPERATIONAL:
                sent_ns = time.monotonic_ns()
                node.command(Nmt.START)
                self._monitor.wait_for_state(NodeState.OPERATIONAL, sent_ns, _STEP_S)
            node.write(0x60FF, 0)
            node.write(0x6040, Control.DISABLE_VOLTAGE)
            node.write(0x6040, Control.FAULT_RESET)
            deadline = time.monotonic() + _STEP_S
            while self._state(node) in (State.FAULT, State.FAULT_REACTION):
                if time.monotonic() > deadline:
                    raise DeviceFault(
                        self.name,
                        self.port,
                        f"the drive stays in fault, {describe_code(node.read(0x603F))}; remove its "
                        "cause first.",
                    )
            node.write(0x6040, Control.DISABLE_VOLTAGE)
            self._monitor.forget_active()
            self._trip = ""

    # --- reading ---------------------------------------------------------------------------------

    def status(self) -> DriveStatus:
        """Read the state; feeds the drive's supervision of this computer.

        Speed, count and set-point are signed as the rig. Current, supply and temperature are NaN
        where the drive has no object for them. Raises DeviceLost when the drive has restarted,
        ReplyTimeout.
        """
        with self._lock:
            node, setup = self._open_node(), self._configured()
            self._judge_restart(setup)
            silence = self._judge_silence(node, setup)
            node.beat()
            motion, late = self._motion(node, setup)
            self._judge_restart(setup)
            current = self._read_slow(node, setup)
            faults = [silence] if silence else []
            faults += self._faults(node, motion)
            if faults and self._target is not None:
                self._trip = faults[0]
            return self._drive_status(setup, motion, current, faults, self._warnings(motion, late))

    @property
    def emergencies(self) -> tuple[Emergency, ...]:
        """Return the last 64 emergency messages of the drive, oldest first."""
        return self._monitor.history

    def _drive_status(
        self,
        setup: Setup,
        motion: Motion,
        current_A: float,
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
            current_A=current_A,
            supply_V=self._slow[0],
            temperature_C=self._slow[1],
            enabled=enabled and not faults,
            emergency_stop=self._torque_off,
            faults=tuple(dict.fromkeys(faults)),
            warnings=tuple(dict.fromkeys(warnings)),
            crc_errors=self._open_node().bad_frames,
        )

    def _motion(self, node: CanNode, setup: Setup) -> tuple[Motion, bool]:
        """Return the present motion and whether its PDOs were late."""
        operational = self._monitor.node_state == NodeState.OPERATIONAL
        if setup.synchronous and operational:
            marks = self._monitor.marks()
            node.send(SYNC_ID, b"")
            timeout_s = float(self._settings["pdo_timeout_ms"]) * 1e-3
            motion = self._monitor.wait_for_motion(marks, timeout_s)
            if motion is not None:
                return motion, False
        motion = Motion(node.read(0x6041), node.read(0x606C), node.read(0x6064))
        return motion, setup.synchronous and operational

    def _read_slow(self, node: CanNode, setup: Setup) -> float:
        """Read the current, and in turn supply, temperature and safe torque off."""
        if not setup.epos:
            return math.nan
        turns = (0, 1, 2) if self._polls == 0 else (self._polls % 3,)
        for turn in turns:
            if turn == 0:
                self._slow[0] = node.read(0x2200, 1) * float(self._settings["supply_unit_V"])
            elif turn == 1:
                self._slow[1] = node.read(0x3201, 1) * float(self._settings["temperature_unit_C"])
            else:
                wanted = int(self._settings["torque_on_inputs"])
                self._torque_off = node.read(0x3202, 1) & wanted != wanted
        self._polls += 1
        return node.read(0x30D1, 1) * float(self._settings["current_unit_A"])

    def _faults(self, node: CanNode, motion: Motion) -> list[str]:
        faults = [emergency.words for emergency in self._monitor.active()]
        state = state_of(motion.status_word)
        if state in (State.FAULT, State.FAULT_REACTION):
            faults.append(describe_code(node.read(0x603F)))
        if self._torque_off:
            faults.append("safe torque off is active")
        faults += self._supervision_faults()
        if self._target is not None and state is not State.ENABLED:
            faults.append(f"the drive has left operation enabled: {state or 'unknown state'}")
        if self._trip and self._target is None:
            faults.append(self._trip)
        return faults

    def _supervision_faults(self) -> list[str]:
        period_s = int(self._settings["heartbeat_ms"]) * 1e-3
        limit_s = max(_HEARTBEATS_MISSED * period_s, _HEARTBEAT_LEAST_S)
        age_s = self._monitor.heartbeat_age_s()
        # This process may have been held up itself: let the receiver catch up before judging.
        if not self._monitor.wait_for_heartbeat(limit_s, _CATCH_UP_S):
            return [f"the drive's heartbeat is missing for {age_s or math.nan:.2f} s"]
        node_state = self._monitor.node_state
        if node_state not in (NodeState.OPERATIONAL, NodeState.BOOT_UP):
            return [f"the node has left OPERATIONAL (state {node_state})"]
        return []

    def _warnings(self, motion: Motion, late: bool) -> list[str]:
        warnings = [f"came and went: {e.words}" for e in self._monitor.take_passed()]
        if late:
            warnings.append("speed and position came late after SYNC and were asked for singly")
        if motion.status_word & WARNING_BIT:
            warnings.append("the drive warns (bit 7 of the status word)")
        if motion.status_word & INTERNAL_LIMIT_BIT:
            warnings.append("an internal limit of the drive is active")
        if self._rounding:
            warnings.append(self._rounding)
        return warnings

    def _judge_silence(self, node: CanNode, setup: Setup) -> str:
        """Take note that the drive's supervision has fired, and make the stop certain."""
        silence_s = (time.monotonic_ns() - node.last_beat_ns) * 1e-9
        if self._target is None or silence_s <= setup.watchdog_s:
            return ""
        self._off(node)
        self._trip = (
            f"watchdog: the host was silent for {silence_s:.2f} s and the drive has stopped the "
            "motor"
        )
        return self._trip

    def _judge_restart(self, setup: Setup) -> None:
        if self._monitor.boot_ups != setup.boot_ups:
            self._setup = None
            self._target = None
            raise DeviceLost(
                self.name,
                self.port,
                "the drive has restarted (boot-up message) and its motor is off; check its supply.",
            )

    # --- helpers ---------------------------------------------------------------------------------

    def _state(self, node: CanNode) -> State | None:
        return state_of(node.read(0x6041))

    def _open_node(self) -> CanNode:
        if self._node is None:
            raise DeviceLost(self.name, self.port, "the drive is not open.")
        return self._node

    def _configured(self) -> Setup:
        if self._setup is None:
            raise self._refused("the drive is not supervised yet; configure the drive first.")
        return self._setup

    def _refused(self, sentence: str) -> SettingRefused:
        return SettingRefused(self.name, self.port, sentence)


DRIVER: Final = DriverInfo(
    name="cia402",
    title="maxon EPOS4 or another CiA 402 drive (CANopen)",
    kind=DriverKind.SPINDLE,
    factory=Cia402Drive,
    settings=SETTINGS,
    simulator="drivers.cia402.simulator:Cia402Simulator",
)
