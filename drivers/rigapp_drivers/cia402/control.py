"""Walk a drive through the CiA 402 state machine by writing object 6040 and reading 6041."""

from __future__ import annotations

import time
from typing import Final

from rigapp.texts import say
from rigapp_drivers.api import DeviceFault, ReplyTimeout
from rigapp_drivers.cia402.monitor import NodeMonitor
from rigapp_drivers.cia402.network import CanNode
from rigapp_drivers.cia402.protocol import (
    Control,
    Nmt,
    NodeState,
    State,
    describe_code,
    state_of,
    step_towards_enabled,
)

STEP_S: Final = 1.0  # a step of the state machine takes some ms, with a brake some hundred
_POWERLESS: Final = (
    State.NOT_READY,
    State.SWITCH_ON_DISABLED,
    State.READY,
    State.SWITCHED_ON,
    State.FAULT,
)


class DriveControl:
    """Change the state of one drive; every wait ends after ``STEP_S``.

    stop_requests: of the node when the caller began; a stop since then forbids to enable.
    """

    def __init__(self, node: CanNode, stop_requests: int | None = None) -> None:
        self._node = node
        self._stop_requests = node.stop_requests if stop_requests is None else stop_requests

    def state(self) -> State | None:
        """Return the present state, asked from the drive."""
        return state_of(self._node.read(0x6041))

    def enable(self) -> None:
        """Go step by step to operation enabled, with target velocity 0.

        Raises DeviceFault when the drive is in fault or a stop comes in between, ReplyTimeout when
        it stays in a state.
        """
        node = self._node
        node.write(0x60FF, 0)
        state = self.state()
        while state is not State.ENABLED:
            if state in (State.FAULT, State.FAULT_REACTION):
                raise self._fault(say("the drive is in fault, {}; reset it first.", self.error()))
            self.give_way()
            step = step_towards_enabled(state)
            if step is not None:
                node.write(0x6040, step)
            state = self._wait_to_leave(state)

    def give_way(self) -> None:
        """Raise DeviceFault when another thread wants to stop."""
        if self._node.stop_requests != self._stop_requests:
            raise self._fault(say("a stop came before the speed was set."))

    def _wait_to_leave(self, state: State | None) -> State | None:
        deadline = time.monotonic() + STEP_S
        while (now := self.state()) is state:
            self.give_way()
            if time.monotonic() > deadline:
                raise self._stuck(
                    say(
                        "the drive stays in state {} on its way to operation enabled; look"
                        " at its safe-torque-off inputs and its supply.",
                        state or say("unknown"),
                    )
                )
        return now

    def power_off(self) -> None:
        """Disable the voltage and see that it is off; raise ReplyTimeout when it is not."""
        node = self._node
        node.write(0x6040, Control.DISABLE_VOLTAGE)
        deadline = time.monotonic() + STEP_S
        while (state := self.state()) not in _POWERLESS:
            if time.monotonic() > deadline:
                raise self._stuck(
                    say(
                        "the drive stays in state {} after disable voltage; use the"
                        " emergency stop.",
                        state or say("unknown"),
                    )
                )
            node.write(0x6040, Control.DISABLE_VOLTAGE)
        node.write(0x60FF, 0)

    def acknowledge(self, monitor: NodeMonitor) -> None:
        """Make the node operational, switch off and acknowledge; raise DeviceFault if in vain."""
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
                raise self._fault(
                    say("the drive stays in fault, {}; remove its cause first.", self.error())
                )
        node.write(0x6040, Control.DISABLE_VOLTAGE)

    def error(self) -> str:
        """Return the drive's last error code (603F) in words."""
        return describe_code(self._node.read_if_there(0x603F))

    def _fault(self, sentence: str) -> DeviceFault:
        return DeviceFault.at(self._node, sentence)

    def _stuck(self, sentence: str) -> ReplyTimeout:
        return ReplyTimeout.at(self._node, sentence)
