"""Change the state of a CiA 402 drive, and read its motion, condition and faults."""

from __future__ import annotations

import logging
import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from rigapp.texts import say
from rigapp_drivers.api import DeviceFault, ReplyTimeout
from rigapp_drivers.cia402.commission import Setup
from rigapp_drivers.cia402.monitor import AxisMotion, NodeMonitor
from rigapp_drivers.cia402.network import CanNode
from rigapp_drivers.cia402.protocol import (
    INTERNAL_LIMIT_BIT,
    SYNC_ID,
    WARNING_BIT,
    Control,
    Nmt,
    NodeState,
    State,
    describe_code,
    state_of,
    step_towards_enabled,
)
from rigapp_drivers.spindles import WATCHDOG_PERIOD, torque_Nm

STEP_S: Final = 1.0  # a state transition takes a few ms, with a brake a few hundred
_POWERLESS: Final = (
    State.NOT_READY,
    State.SWITCH_ON_DISABLED,
    State.READY,
    State.SWITCHED_ON,
    State.FAULT,
)


class DriveControl:
    """Change the state of one drive; every wait ends after ``STEP_S``.

    stop_requests: of the node when the caller began; after a later stop the drive is not enabled.
    """

    def __init__(self, node: CanNode, stop_requests: int | None = None) -> None:
        self._node = node
        self._stop_requests = node.stop_requests if stop_requests is None else stop_requests

    def state(self) -> State | None:
        """Read the present state from the drive."""
        return state_of(self._node.read(0x6041))

    def enable(self) -> None:
        """Step through the state machine to operation enabled, with target velocity 0.

        Raises DeviceFault if the drive is in fault or a stop is requested meanwhile, ReplyTimeout
        if it does not leave a state.
        """
        node = self._node
        node.write(0x60FF, 0)
        state = self.state()
        while state is not State.ENABLED:
            if state in (State.FAULT, State.FAULT_REACTION):
                raise DeviceFault.at(
                    self._node, "the drive is in fault, {}; reset it first.", self.error()
                )
            self.give_way()
            step = step_towards_enabled(state)
            if step is not None:
                node.write(0x6040, step)
            state = self._wait_to_leave(state)

    def give_way(self) -> None:
        """Raise DeviceFault if another thread has requested a stop."""
        if self._node.stop_requests != self._stop_requests:
            raise DeviceFault.at(self._node, "a stop arrived before the speed was set.")

    def _wait_to_leave(self, state: State | None) -> State | None:
        deadline = time.monotonic() + STEP_S
        while (now := self.state()) is state:
            self.give_way()
            if time.monotonic() > deadline:
                raise ReplyTimeout.at(
                    self._node,
                    "the drive stays in state {} on its way to operation enabled; look"
                    " at its safe-torque-off inputs and its supply.",
                    state or say("unknown"),
                )
        return now

    def power_off(self) -> None:
        """Disable the voltage and verify that it is off; raise ReplyTimeout if it is not."""
        node = self._node
        node.write(0x6040, Control.DISABLE_VOLTAGE)
        deadline = time.monotonic() + STEP_S
        while (state := self.state()) not in _POWERLESS:
            if time.monotonic() > deadline:
                raise ReplyTimeout.at(
                    self._node,
                    "the drive stays in state {} after disable voltage; use the emergency stop.",
                    state or say("unknown"),
                )
            node.write(0x6040, Control.DISABLE_VOLTAGE)
        node.write(0x60FF, 0)

    def acknowledge(self, monitor: NodeMonitor) -> None:
        """Set the node operational, switch off, acknowledge; raise DeviceFault on failure."""
        node = self._node
        if monitor.node_state not in (None, NodeState.OPERATIONAL):
            sent_ns = time.monotonic_ns()
            node.command(Nmt.START)
            monitor.wait_for_state(NodeState.OPERATIONAL, sent_ns, STEP_S)
        node.write(0x60FF, 0)
        node.write(0x6040, Control.DISABLE_VOLTAGE)
        node.write(0x6040, Control.FAULT_RESET)
        deadline = time.monotonic() + STEP_S
        while self.state() in (State.FAULT, State.FAULT_REACTION):
            self.give_way()
            if time.monotonic() > deadline:
                raise DeviceFault.at(
                    self._node,
                    "the drive stays in fault, {}; remove its cause first.",
                    self.error(),
                )
        node.write(0x6040, Control.DISABLE_VOLTAGE)

    def error(self) -> str:
        """Return the drive's last error code (603F) in words."""
        return describe_code(self._node.read_if_there(0x603F))


_log = logging.getLogger(__name__)

_IN_TURN: Final = ("supply_V", "temperature_C")
_HEARTBEATS_MISSED: Final = 12  # a delayed host misses some; with the drive off all are missing
_HEARTBEAT_LEAST_S: Final = 2.0
"""Minimum time before a missing heartbeat is a fault. A disconnected drive is detected at once by
its missing replies; this applies to one that replies, and must exceed pauses of this computer."""
_CATCH_UP_S: Final = 0.4
"""Time to receive queued heartbeats after a delay of this process."""


@dataclass(frozen=True, slots=True)
class Condition:
    """Slow readings; NaN if the drive has no object for them."""

    current_A: float = math.nan
    supply_V: float = math.nan
    temperature_C: float = math.nan
    torque_Nm: float = math.nan
    torque_off: bool = False


class Readings:
    """Read one drive by its set-up: PDOs on SYNC if supported, SDOs otherwise."""

    def __init__(
        self,
        node: CanNode,
        monitor: NodeMonitor,
        setup: Setup,
        settings: Mapping[str, Any],
        epos: bool,
    ) -> None:
        self._node = node
        self._monitor = monitor
        self._setup = setup
        self._settings = settings
        self._epos = epos
        self._polls = 0
        self._motions = 0
        self._condition = Condition()
        self.late_pdos = 0

    def motion(self) -> AxisMotion:
        """Return the present motion; late PDOs are counted, logged and replaced by SDOs."""
        node, monitor = self._node, self._monitor
        self._motions += 1
        expected = self._setup.synchronous and monitor.node_state == NodeState.OPERATIONAL
        if expected:
            marks = monitor.marks()
            node.send(SYNC_ID, b"")
            timeout_s = float(self._settings["pdo_timeout_ms"]) * 1e-3
            motion = monitor.wait_for_motion(marks, timeout_s)
            if motion is not None:
                return motion
            self.late_pdos += 1
            _log.warning(
                "%s on %s: speed and position came late after SYNC and were asked for singly",
                node.device,
                node.port,
            )
        return AxisMotion(node.read(0x6041), node.read(0x606C), node.read(0x6064))

    @property
    def supervision_is_due(self) -> bool:
        """Return whether the readback of the supervision settings is due."""
        return self._motions % WATCHDOG_PERIOD == 0

    def condition(self) -> Condition:
        """Read current and torque, and in rotation one of supply, temperature, safe torque off."""
        objects, last, node = self._setup.quantities, self._condition, self._node
        turns = (0, 1, 2) if self._polls == 0 else (self._polls % 3,)
        self._polls += 1
        wanted = {"current_A", "torque_Nm"}
        wanted |= {name for turn, name in enumerate(_IN_TURN) if turn in turns}
        new = {
            name: node.read(*entry) * unit
            for name, (entry, unit) in objects.items()
            if name in wanted
        }
        torque_off = last.torque_off
        if self._epos and 2 in turns:
            inputs = int(self._settings["torque_on_inputs"])
            torque_off = node.read(0x3202, 1) & inputs != inputs
        current = new.get("current_A", math.nan)
        by_current = torque_Nm(current, self._settings)
        self._condition = Condition(
            current,
            new.get("supply_V", last.supply_V),
            new.get("temperature_C", last.temperature_C),
            by_current if math.isfinite(by_current) else new.get("torque_Nm", math.nan),
            torque_off,
        )
        return self._condition

    def faults(self, motion: AxisMotion, condition: Condition, running: bool) -> list[str]:
        """Return the faults that require a stop, in words; running: drive should be enabled."""
        faults = [emergency.words for emergency in self._monitor.active()]
        state = state_of(motion.status_word)
        if state in (State.FAULT, State.FAULT_REACTION):
            faults.append(describe_code(self._node.read_if_there(0x603F)))
        if condition.torque_off:
            faults.append(say("safe torque off is active"))
        faults += self._supervision()
        if running and state is not State.ENABLED:
            faults.append(
                say("the drive has left operation enabled: {}", state or say("unknown state"))
            )
        return faults

    def _supervision(self) -> list[str]:
        monitor = self._monitor
        period_s = int(self._settings["heartbeat_ms"]) * 1e-3
        limit_s = max(_HEARTBEATS_MISSED * period_s, _HEARTBEAT_LEAST_S)
        if not monitor.wait_for_heartbeat(limit_s, _CATCH_UP_S):
            age_s = monitor.heartbeat_age_s()
            state = (
                say("never received") if age_s is None else say("is missing for {:.2f} s", age_s)
            )
            return [say("the drive's heartbeat {}", state)]
        node_state = monitor.node_state
        if node_state not in (NodeState.OPERATIONAL, NodeState.BOOT_UP):
            return [say("the node does not operate any more ‹state {}›", node_state)]
        return []

    def warnings(self, motion: AxisMotion) -> list[str]:
        """Return the warnings for the operator, in words."""
        warnings: list[str] = [
            say("came and ended: {}", e.words) for e in self._monitor.take_passed()
        ]
        if motion.status_word & WARNING_BIT:
            warnings.append(say("the drive warns ‹bit 7 of the status word›"))
        if motion.status_word & INTERNAL_LIMIT_BIT:
            warnings.append(say("an internal limit of the drive is active"))
        return warnings
