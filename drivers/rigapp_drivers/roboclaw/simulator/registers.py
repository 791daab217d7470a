"""Registers of a simulated RoboClaw: settings, motors, conditions, and replies to commands."""

from __future__ import annotations

import copy
import enum
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Final

from rigapp_drivers.roboclaw.protocol import (
    NVM_KEY,
    Command,
    EmergencyStopLock,
    Generation,
    reply_format,
)
from rigapp_drivers.roboclaw.simulator.axis import Axis, AxisSettings
from rigapp_drivers.simulated import FaultPlan
from rigapp_drivers.simulator_api import DriveMode, MotorState

Numbers = tuple[int, ...]

_LATCHING_MODES: Final = {5: (0x00, 0x81), 3: (0, 1)}
_STOP_MODES: Final = {5: (0x00, 0x01, 0x81), 3: (0, 1, 2)}


class RoboClawFault(enum.StrEnum):
    """Kinds of fault; the comment gives the meaning of ``value``."""

    EMERGENCY_STOP = "emergency_stop"  # the S3 input is active
    OVER_CURRENT = "over_current"  # A, shown as the motor's current
    UNDER_VOLTAGE = "under_voltage"  # V of the main supply
    OVER_TEMPERATURE = "over_temperature"  # degrees C
    DRIVER_FAULT = "driver_fault"
    STATUS_BITS = "status_bits"  # bits set in the status word
    WRONG_CRC = "wrong_crc"
    WRONG_ACKNOWLEDGE = "wrong_acknowledge"  # byte sent instead of FF
    NO_REPLY = "no_reply"
    LOST_COMMAND = "lost_command"  # the packet is neither executed nor answered
    IGNORED_COMMAND = "ignored_command"  # the write is acknowledged but not executed
    FALSE_READBACK = "false_readback"  # the drive always reports a motor without power
    FALSE_STANDSTILL = "false_standstill"  # the drive reports standstill: its encoder is dead
    TURNS_BY_ITSELF = "turns_by_itself"  # speed without a command, counts/s
    SLOW_REPLY = "slow_reply"  # delay in s
    DUPLICATED_REPLY = "duplicated_reply"
    SLOW_COMMAND = "slow_command"  # s until a command is acknowledged; it is executed at once
    RESET = "reset"  # s until the drive replies again
    RESTART_UNSEEN = "restart_unseen"  # immediate, and its clock (command 73) continues
    WATCHDOG_LOST = "watchdog_lost"  # the serial time-out is off


LOGIC_VOLTAGE = 121  # 0.1 V, of a board on 48 V


@dataclass(frozen=True, slots=True)
class _Bits:
    """Status bits of a condition in both firmware generations, for motor 1."""

    newer: int
    older: int
    per_motor: bool = False

    def of(self, status_bits: int, motor: int = 1) -> int:
        bits = self.newer if status_bits == 32 else self.older
        return bits << (motor - 1) if self.per_motor else bits


_EMERGENCY_STOP: Final = _Bits(1 << 0, 1 << 2)
_MAIN_HIGH: Final = _Bits(1 << 3 | 1 << 18, 1 << 5 | 1 << 10)
_MAIN_LOW: Final = _Bits(1 << 14 | 1 << 19, 1 << 11)
_FAULT_BITS: Final[Mapping[RoboClawFault, _Bits]] = {
    RoboClawFault.OVER_TEMPERATURE: _Bits(1 << 1, 1 << 3),
    RoboClawFault.DRIVER_FAULT: _Bits(1 << 6, 1 << 8, per_motor=True),
    RoboClawFault.OVER_CURRENT: _Bits(1 << 12 | 1 << 16, 1 << 0, per_motor=True),
}


@dataclass(slots=True)
class Saved:
    """Settings saved by command 94 and restored by a reset, in raw units."""

    timeout: int = 0
    main_limits: Numbers = (60, 600, 0)
    pin_modes: Numbers = (0x81, 0, 0, 0, 0)
    stop_lock: int = EmergencyStopLock.AUTOMATIC
    axes: tuple[AxisSettings, AxisSettings] = field(
        default_factory=lambda: (AxisSettings(), AxisSettings())
    )


class Registers:
    """Reply to reads and execute writes."""

    def __init__(
        self,
        generation: Generation,
        motor: int,
        saved: Saved,
        unknown: frozenset[int],
        plan: FaultPlan,
    ) -> None:
        self.generation = generation
        self.motor = motor
        self._saved = saved
        self._plan = plan
        self._state = MotorState(0, 0.0, 0.0)
        self._powered_s = 0.0
        self._readers = self._board_readers() | self._motor_readers(0) | self._motor_readers(1)
        self._writers = self._board_writers() | self._motor_writers(0) | self._motor_writers(1)
        for command in unknown:
            self._readers.pop(command, None)
            self._writers.pop(command, None)
        self.power_on()

    def power_on(self, *, clock_runs_on: bool = False) -> None:
        """Restart with the saved settings, the motors off and the counters at 0."""
        self.memory = copy.deepcopy(self._saved)
        self.axes = tuple(Axis(settings=settings) for settings in self.memory.axes)
        self.axes[self.motor - 1].observe(self._state)
        for axis in self.axes:
            axis.set_count(0)
        if not clock_runs_on:
            self._powered_s = self._plan.time_s
        self._stop_latched = False

    def observe(self, state: MotorState) -> None:
        """Set the state of the plant's motor."""
        if self._plan.on(RoboClawFault.FALSE_STANDSTILL):
            count = self._state.position_count
            state = replace(state, speed_count_per_s=0.0, position_count=count)
        self._state = state
        self.axes[self.motor - 1].observe(state)

    def power_off(self) -> bool:
        """Switch both motors off; return whether one was on."""
        was_on = any(axis.mode is not DriveMode.OFF for axis in self.axes)
        for axis in self.axes:
            axis.power_off()
        return was_on

    def halt(self) -> bool:
        """Stop and hold both motors, as on a serial time-out; return whether one was driven."""
        driven = any(axis.driven for axis in self.axes)
        for axis in self.axes:
            axis.halt()
        return driven

    def knows(self, command: int) -> bool:
        """Return whether this drive has a command."""
        return command in self._readers or command in self._writers

    def read(self, command: int) -> bytes:
        """Return the data of a reply, without its CRC."""
        layout = reply_format(command, self.generation)
        assert layout is not None
        return struct.pack(layout, *self._readers[command]())

    def write(self, command: int, values: Numbers) -> None:
        """Execute a write."""
        self._writers[command](values)

    def switch_off_on_faults(self) -> None:
        """Switch the motors off on an emergency stop or a fault condition."""
        modes = self.generation.pin_modes
        pressed = self._plan.on(RoboClawFault.EMERGENCY_STOP)
        if pressed and self.memory.pin_modes[0] in _STOP_MODES[modes]:
            self._stop_latched = True
        elif not pressed and self._releases_itself(modes):
            self._stop_latched = False
        if self._stopping_bits():
            self.power_off()

    def _releases_itself(self, modes: int) -> bool:
        if modes == 3 or Command.SET_EMERGENCY_STOP_LOCK not in self._writers:
            return self.memory.pin_modes[0] not in _LATCHING_MODES[modes]
        return self.memory.stop_lock == EmergencyStopLock.AUTOMATIC

    # --- conditions ------------------------------------------------------------------------------

    def _stopping_bits(self) -> int:
        width = self.generation.status_bits
        bits = _EMERGENCY_STOP.of(width) if self._stop_latched else 0
        for kind, fault_bits in _FAULT_BITS.items():
            if self._plan.on(kind):
                bits |= fault_bits.of(width, self.motor)
        lowest, highest, *_ = self.memory.main_limits
        main = self._main_voltage()
        if main < lowest:
            bits |= _MAIN_LOW.of(width)
        if main > highest:
            bits |= _MAIN_HIGH.of(width)
        return bits

    def _status(self) -> int:
        extra = self._plan.active(RoboClawFault.STATUS_BITS)
        return self._stopping_bits() | int(extra or 0)

    def _main_voltage(self) -> int:
        volts = self._plan.active(RoboClawFault.UNDER_VOLTAGE, default=5.0)
        return round((self._state.supply_V if volts is None else volts) * 10)

    def _temperature(self) -> int:
        hot = self._plan.active(RoboClawFault.OVER_TEMPERATURE, default=105.0)
        return round((self._state.temperature_C if hot is None else hot) * 10)

    def _currents(self) -> Numbers:
        amperes = [axis.current_A for axis in self.axes]
        high = self._plan.active(RoboClawFault.OVER_CURRENT, default=60.0)
        if high is not None:
            amperes[self.motor - 1] = high
        return tuple(max(-32768, min(32767, round(value * 100))) for value in amperes)

    def _pwm(self) -> Numbers:
        no_power = self._plan.on(RoboClawFault.FALSE_READBACK)
        return tuple(0 if no_power else axis.pwm for axis in self.axes)

    def _combined_status(self) -> Numbers:
        first, second = self.axes
        hot = self._temperature()
        errors = (round(axis.setpoint - axis.speed) for axis in self.axes)
        return (
            round((self._plan.time_s - self._powered_s) * 1e3) & 0xFFFFFFFF,
            self._status(),
            *(hot, hot, self._main_voltage(), LOGIC_VOLTAGE),
            *(*self._pwm(), *self._currents()),
            *(first.count, second.count),
            *(round(first.setpoint), round(second.setpoint)),
            *(round(first.speed), round(second.speed)),
            *(max(-32768, min(32767, error)) for error in errors),
            *(0, 0),
        )

    # --- reads -----------------------------------------------------------------------------------

    def _board_readers(self) -> dict[int, Callable[[], Numbers]]:
        def of_axes(value: Callable[[Axis], int]) -> Callable[[], Numbers]:
            return lambda: tuple(value(axis) for axis in self.axes)

        limits = 3 if self.generation.voltage_offset else 2
        return {
            Command.GET_TIMEOUT: lambda: (self.memory.timeout,),
            Command.MAIN_VOLTAGE: lambda: (self._main_voltage(),),
            Command.LOGIC_VOLTAGE: lambda: (LOGIC_VOLTAGE,),
            Command.VOLTAGES: lambda: (self._main_voltage(), LOGIC_VOLTAGE),
            Command.PWM: self._pwm,
            Command.CURRENTS: self._currents,
            Command.MAIN_LIMITS: lambda: self.memory.main_limits[:limits],
            Command.PIN_FUNCTIONS: lambda: self.memory.pin_modes,
            Command.COUNTS: of_axes(lambda axis: axis.count),
            Command.INSTANT_SPEEDS: of_axes(lambda axis: round(axis.speed)),
            Command.AVERAGE_SPEEDS: of_axes(lambda axis: round(axis.speed)),
            Command.TEMPERATURE_1: lambda: (self._temperature(),),
            Command.TEMPERATURE_2: lambda: (self._temperature(),),
            Command.TEMPERATURES: lambda: (self._temperature(), self._temperature()),
            Command.STATUS: lambda: (self._status(),),
            Command.ENCODER_MODES: of_axes(lambda axis: axis.settings.encoder_mode),
            Command.EMERGENCY_STOP_LOCK: lambda: (self.memory.stop_lock,),
            Command.COMBINED_STATUS: self._combined_status,
            Command.DUTY_ACCELERATIONS: of_axes(lambda axis: axis.settings.duty_acceleration),
        }

    def _motor_readers(self, number: int) -> dict[int, Callable[[], Numbers]]:
        def count() -> Numbers:
            return self.axes[number].count, self.axes[number].take_flags()

        def speed() -> Numbers:
            value = round(self.axes[number].speed)
            return abs(value), int(value < 0)

        return {
            Command.COUNT_M1 + number: count,
            Command.SPEED_M1 + number: speed,
            Command.INSTANT_SPEED_M1 + number: speed,
            Command.VELOCITY_PID_M1 + number: lambda: self.axes[number].settings.pid,
            Command.CURRENT_LIMIT_M1 + number: lambda: self.axes[number].settings.current_limit,
        }

    # --- writes ----------------------------------------------------------------------------------

    def _board_writers(self) -> dict[int, Callable[[Numbers], None]]:
        def set_timeout(values: Numbers) -> None:
            (self.memory.timeout,) = values

        def reset_counts(_: Numbers) -> None:
            for axis in self.axes:
                axis.set_count(0)

        def set_main_limits(values: Numbers) -> None:
            self.memory.main_limits = (*values, 0)[:3]

        def set_pin_functions(values: Numbers) -> None:
            self.memory.pin_modes = values

        def save(values: Numbers) -> None:
            if values == (NVM_KEY,):
                self._saved = copy.deepcopy(self.memory)

        def reset_stop(_: Numbers) -> None:
            if self.memory.stop_lock != EmergencyStopLock.HARDWARE:
                self._stop_latched = False  # latched again while the input is active

        def set_stop_lock(values: Numbers) -> None:
            (self.memory.stop_lock,) = values

        return {
            Command.SET_TIMEOUT: set_timeout,
            Command.RESET_COUNTS: reset_counts,
            Command.SET_MAIN_LIMITS: set_main_limits,
            Command.SET_PIN_FUNCTIONS: set_pin_functions,
            Command.SAVE_TO_NVM: save,
            Command.RESET_EMERGENCY_STOP: reset_stop,
            Command.SET_EMERGENCY_STOP_LOCK: set_stop_lock,
        }

    def _motor_writers(self, number: int) -> dict[int, Callable[[Numbers], None]]:
        def set_pid(values: Numbers) -> None:
            d, p, i, qpps = values
            self.axes[number].settings.pid = (p, i, d, qpps)

        def set_current_limit(values: Numbers) -> None:
            maximum, minimum = values
            self.axes[number].settings.current_limit = (maximum, minimum)

        def set_duty_acceleration(values: Numbers) -> None:
            (self.axes[number].settings.duty_acceleration,) = values

        def set_encoder_mode(values: Numbers) -> None:
            (self.axes[number].settings.encoder_mode,) = values

        return {
            Command.SET_COUNT_M1 + number: lambda v: self.axes[number].set_count(v[0]),
            Command.SET_VELOCITY_PID_M1 + number: set_pid,
            Command.DUTY_M1 + number: lambda v: self.axes[number].drive(v[0]),
            Command.SET_DUTY_ACCELERATION_M1 + number: set_duty_acceleration,
            Command.SET_SPEED_M1 + number: lambda v: self.axes[number].run(v[0]),
            Command.RAMP_SPEED_M1 + number: lambda v: self.axes[number].run(v[1], v[0]),
            Command.SET_ENCODER_MODE_M1 + number: set_encoder_mode,
            Command.SET_CURRENT_LIMIT_M1 + number: set_current_limit,
        }
