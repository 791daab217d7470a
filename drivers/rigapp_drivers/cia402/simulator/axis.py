"""The drive of a simulated CiA 402 node: state machine, velocity ramps, status word."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from rigapp_drivers.cia402.protocol import (
    INTERNAL_LIMIT_BIT,
    PROFILE_VELOCITY,
    STANDSTILL_BIT,
    TARGET_REACHED_BIT,
    State,
    velocity_unit_rev_per_s,
)
from rigapp_drivers.cia402.simulator.objects import Abort, AbortTransfer, Dictionary
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState

_BITS: Final = {
    State.NOT_READY: 0x00,
    State.SWITCH_ON_DISABLED: 0x40,
    State.READY: 0x21,
    State.SWITCHED_ON: 0x23,
    State.ENABLED: 0x27,
    State.QUICK_STOP: 0x07,
    State.FAULT_REACTION: 0x0F,
    State.FAULT: 0x08,
}
_POWERED: Final = (State.ENABLED, State.QUICK_STOP, State.FAULT_REACTION)
_VOLTAGE_BIT: Final = 1 << 4
_REMOTE_BIT: Final = 1 << 9
_STANDSTILL_REV_PER_S: Final = 0.01  # 0.6 rpm: below, the drive reports standstill
_WINDOW: Final = 0.02  # relative; within it the drive reports the target as reached
_MODES: Final = (1, 3, 6, 8, 9, 10)


class Axis402:
    """Execute control words, ramp a set-point in rev/s, and update the object dictionary.

    acknowledge is called for a rising fault-reset bit; it returns whether the fault can be reset.
    """

    def __init__(
        self,
        objects: Dictionary,
        counts_per_revolution: int,
        acknowledge: Callable[[], bool],
    ) -> None:
        self.state = State.SWITCH_ON_DISABLED
        self.setpoint = 0.0
        self.torque_off = False
        self._objects = objects
        self._counts = counts_per_revolution
        self._acknowledge = acknowledge
        self._after_stop: State | None = None
        self._control = 0
        self._position = 0.0
        self._speed = 0.0
        self._observed = False
        objects.entries[0x6040, 0].written = self.control
        objects.entries[0x6041, 0].read = self.status_word
        objects.entries[0x6060, 0].written = self._set_mode
        objects.entries[0x60A9, 0].written = self._set_unit
        objects.entries[0x6064, 0].read = lambda: _int32(int(self._position))
        objects.entries[0x606B, 0].read = lambda: round(self.setpoint / self._unit)
        objects.entries[0x606C, 0].read = lambda: round(self._speed / self._unit)
        if (0x30D3, 1) in objects.entries:
            objects.entries[0x30D3, 1].read = lambda: round(self._speed / self._unit)

    # --- commands --------------------------------------------------------------------------------

    def control(self, word: int) -> None:
        """Execute a control word (6040)."""
        rising_reset = word & 0x80 and not self._control & 0x80
        self._control = word
        if rising_reset and self._acknowledge() and self.state is State.FAULT:
            self.state = State.SWITCH_ON_DISABLED
        if self.state in (State.FAULT, State.FAULT_REACTION, State.NOT_READY) or rising_reset:
            return
        if not word & 0x02:
            self._disable_voltage()
        elif not word & 0x04:
            self._quick_stop()
        elif not word & 0x01:
            self._shut_down()
        elif not word & 0x08:
            self._switch_on()
        else:
            self._enable()

    def _disable_voltage(self) -> None:
        self.power_off(State.SWITCH_ON_DISABLED)

    def _quick_stop(self) -> None:
        if self.state is State.ENABLED:
            self.stop_by_option(self._objects.number(0x605A))
        elif self.state is not State.QUICK_STOP:
            self.power_off(State.SWITCH_ON_DISABLED)

    def _shut_down(self) -> None:
        if self.state in (State.SWITCH_ON_DISABLED, State.SWITCHED_ON, State.ENABLED):
            self.power_off(State.READY)

    def _switch_on(self) -> None:
        if self.state is State.READY and not self.torque_off:
            self.state = State.SWITCHED_ON
        elif self.state is State.ENABLED:
            if self._objects.number(0x605C) == 1:
                self._after_stop = State.SWITCHED_ON
            else:
                self.power_off(State.SWITCHED_ON)

    def _enable(self) -> None:
        stopped = self.state is State.QUICK_STOP and self._objects.number(0x605A) in (5, 6, 7, 8)
        if self.state in (State.READY, State.SWITCHED_ON) or stopped:
            if self.torque_off:
                return
            self.state = State.ENABLED
            self.setpoint = self._speed
        self._after_stop = None

    def stop_by_option(self, option: int) -> None:
        """Execute a quick-stop option code (605A)."""
        if option == 0:
            self.power_off(State.SWITCH_ON_DISABLED)
            return
        self.state = State.QUICK_STOP
        self._after_stop = State.SWITCH_ON_DISABLED if option in (1, 2, 3, 4) else None

    def fail(self) -> None:
        """Enter the fault reaction (605E), or fault at once if the motor has no power."""
        if self.state in _POWERED and self._objects.number(0x605E) != 0:
            self.state = State.FAULT_REACTION
            self._after_stop = State.FAULT
        elif self.state is not State.FAULT:
            self.power_off(State.FAULT)

    @property
    def powered(self) -> bool:
        """Return whether the motor has power."""
        return self.state in _POWERED

    def turn_by_itself(self, rpm: float) -> None:
        """Turn without a command."""
        self._objects.set(0x6061, PROFILE_VELOCITY)
        self._objects.set(0x60FF, round(rpm / 60.0 / self._unit))
        self.state, self._after_stop = State.ENABLED, None

    def power_off(self, state: State) -> None:
        """Remove the motor's power and enter a state without power."""
        self.state = state
        self.setpoint = 0.0
        self._after_stop = None

    def set_torque_off(self, active: bool) -> None:
        """Set the state of the safe-torque-off inputs."""
        self.torque_off = active
        if active and self.state not in (State.FAULT, State.SWITCH_ON_DISABLED, State.NOT_READY):
            self.power_off(State.SWITCH_ON_DISABLED)

    def _set_mode(self, mode: int) -> None:
        if mode not in _MODES:
            raise AbortTransfer(Abort.VALUE)
        self._objects.set(0x6061, mode)

    def _set_unit(self, unit: int) -> None:
        if velocity_unit_rev_per_s(unit) is None:
            raise AbortTransfer(Abort.VALUE)
        if self.state in _POWERED:
            raise AbortTransfer(Abort.STATE)

    # --- motion ----------------------------------------------------------------------------------

    def advance(self, elapsed_s: float) -> None:
        """Move the set-point along its ramp, and the motor with it if there is no plant."""
        if self.state in _POWERED:
            self._ramp(elapsed_s)
            if self.setpoint == 0.0 and self._after_stop is not None:
                self.power_off(self._after_stop)
        if not self._observed:
            self._speed = self.setpoint
            self._position += self._speed * self._counts * elapsed_s

    def _ramp(self, elapsed_s: float) -> None:
        goal, _ = self._goal()
        if self.state is State.ENABLED:
            faster = abs(goal) > abs(self.setpoint)
            rate = self._objects.number(0x6083 if faster else 0x6084)
        else:
            rate = self._objects.number(0x6085)
        step = rate / 60.0 * max(0.0, elapsed_s)
        self.setpoint += max(-step, min(step, goal - self.setpoint))

    def _goal(self) -> tuple[float, bool]:
        """Return the target speed of the ramp, and whether it is limited."""
        running = self.state is State.ENABLED and self._after_stop is None
        if not running or self._halted or self._objects.number(0x6061) != PROFILE_VELOCITY:
            return 0.0, False
        target = self._objects.number(0x60FF)
        limit = self._objects.number(0x607F)
        return max(-limit, min(limit, target)) * self._unit, abs(target) > limit

    @property
    def _halted(self) -> bool:
        return bool(self._control & 0x100)

    @property
    def _unit(self) -> float:
        """Return rev/s per step; whole rpm for a manufacturer's unit that 60A9 cannot express."""
        return velocity_unit_rev_per_s(self._objects.number(0x60A9)) or 1.0 / 60.0

    def observe(self, state: MotorState) -> None:
        """Set the plant's state."""
        self._observed = True
        self._speed = state.speed_count_per_s / self._counts
        self._position = float(state.position_count)

    def command(self) -> DriveCommand:
        """Return the motor command."""
        if self.state in _POWERED:
            return DriveCommand(DriveMode.VELOCITY, speed_count_per_s=self.setpoint * self._counts)
        return DriveCommand(DriveMode.OFF)

    def status_word(self, *, no_power: bool = False) -> int:
        """Return the status word (6041); no_power: that of a drive without power."""
        goal, limited = self._goal()
        state = State.SWITCH_ON_DISABLED if no_power else self.state
        word = _BITS[state] | _VOLTAGE_BIT | _REMOTE_BIT
        if limited:
            word |= INTERNAL_LIMIT_BIT
        if self._objects.number(0x6061) == PROFILE_VELOCITY:
            window = max(abs(goal) * _WINDOW, _STANDSTILL_REV_PER_S)
            if self.state in _POWERED and abs(self._speed - goal) <= window:
                word |= TARGET_REACHED_BIT
            if abs(self._speed) < _STANDSTILL_REV_PER_S:
                word |= STANDSTILL_BIT
        return word


def _int32(value: int) -> int:
    return (value + (1 << 31)) % (1 << 32) - (1 << 31)
