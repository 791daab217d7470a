"""One motor output of a simulated RoboClaw: ramps, duty, encoder counter."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from rigapp_drivers.roboclaw.protocol import MAXIMUM_DUTY, MAXIMUM_DUTY_ACCELERATION
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState

_INT32 = 1 << 32


@dataclass(slots=True)
class AxisSettings:
    """Settings of a motor in the drive's non-volatile memory, in raw units."""

    pid: tuple[int, int, int, int] = (0x10000, 0x8000, 0x4000, 44000)  # P, I, D, QPPS
    current_limit: tuple[int, int] = (3000, 0)
    encoder_mode: int = 0
    duty_acceleration: int = MAXIMUM_DUTY_ACCELERATION


@dataclass(slots=True)
class Axis:
    """Convert commands to a ramped set-point or a duty, and the plant's state to readings.

    Without a plant (``observed`` False) the motor follows its set-point exactly.
    """

    settings: AxisSettings = field(default_factory=AxisSettings)
    mode: DriveMode = DriveMode.OFF
    target: float = 0.0
    setpoint: float = 0.0
    acceleration: float = math.inf
    duty: float = 0.0
    duty_target: int = 0
    position: float = 0.0
    speed: float = 0.0
    current_A: float = 0.0
    offset: int = 0
    flags: int = 0
    observed: bool = False

    @property
    def qpps(self) -> int:
        """Return the speed in counts/s that the velocity loop assigns to full duty."""
        return self.settings.pid[3]

    def run(self, speed: int, acceleration: float = math.inf) -> None:
        """Set a velocity in counts/s with a ramp in counts/s2, starting at the actual speed."""
        if self.mode is not DriveMode.VELOCITY:
            self.setpoint = self.speed
        self.mode = DriveMode.VELOCITY
        self.target = float(max(-self.qpps, min(self.qpps, speed)))
        self.acceleration = acceleration
        if math.isinf(acceleration):
            self.setpoint = self.target

    def drive(self, duty: int) -> None:
        """Set a duty, +-32767, which is reached by a ramp; 0 removes the power."""
        self.duty_target = max(-MAXIMUM_DUTY, min(MAXIMUM_DUTY, duty))
        self.duty = float(self.pwm)
        self.mode = DriveMode.DUTY
        self.target = self.setpoint = 0.0
        if self.settings.duty_acceleration >= MAXIMUM_DUTY_ACCELERATION:
            self._ramp_duty(math.inf)

    def _ramp_duty(self, step: float) -> None:
        self.duty += max(-step, min(step, self.duty_target - self.duty))
        if self.duty == self.duty_target == 0:
            self.power_off()

    def power_off(self) -> None:
        """Clear every command."""
        self.mode = DriveMode.OFF
        self.duty = 0.0
        self.target = self.setpoint = 0.0

    @property
    def driven(self) -> bool:
        """Return whether a motion is commanded."""
        moving = self.target != 0.0 or self.setpoint != 0.0
        return self.mode is DriveMode.DUTY or (self.mode is DriveMode.VELOCITY and moving)

    def halt(self) -> None:
        """Stop at once and hold: without power the spring would make the motor swing."""
        if self.mode is not DriveMode.OFF:
            self.mode = DriveMode.VELOCITY
            self.duty = 0.0
            self.target = self.setpoint = 0.0

    def advance(self, elapsed_s: float) -> None:
        """Move the set-point along its ramp, and the motor with it if there is no plant."""
        if self.mode is DriveMode.VELOCITY:
            step = self.acceleration * elapsed_s if elapsed_s > 0 else 0.0
            gap = self.target - self.setpoint
            self.setpoint += max(-step, min(step, gap))
        elif self.mode is DriveMode.DUTY:
            self._ramp_duty(self.settings.duty_acceleration * elapsed_s)
        if not self.observed:
            self.speed = self.setpoint
            self._move_to(self.position + self.speed * elapsed_s)

    def observe(self, state: MotorState) -> None:
        """Set the plant's state."""
        self.observed = True
        self.speed = state.speed_count_per_s
        self.current_A = state.current_A
        self._move_to(float(state.position_count))

    def command(self) -> DriveCommand:
        """Return the motor command."""
        if self.mode is DriveMode.VELOCITY:
            return DriveCommand(self.mode, speed_count_per_s=self.setpoint)
        if self.mode is DriveMode.DUTY:
            return DriveCommand(self.mode, duty=self.duty / MAXIMUM_DUTY)
        return DriveCommand(DriveMode.OFF)

    @property
    def count(self) -> int:
        """Return the encoder counter: 32 bits, two's complement."""
        raw = (math.floor(self.position) + self.offset) % _INT32
        return raw - _INT32 if raw >= _INT32 // 2 else raw

    def set_count(self, count: int) -> None:
        """Set the encoder counter."""
        self.offset = count - math.floor(self.position)
        self.flags = 0

    def take_flags(self) -> int:
        """Return bit 0 underflow, bit 1 reverse, bit 2 overflow; the wrap bits are cleared."""
        flags, self.flags = self.flags, 0
        return flags | (2 if self.speed < 0 else 0)

    @property
    def pwm(self) -> int:
        """Return the reported output, +-32767."""
        if self.mode is DriveMode.VELOCITY and self.qpps:
            return round(max(-1.0, min(1.0, self.setpoint / self.qpps)) * MAXIMUM_DUTY)
        return round(self.duty)

    def _move_to(self, position: float) -> None:
        """Set the position, and record a wrap of the unsigned counter."""
        before = math.floor(self.position) + self.offset
        after = math.floor(position) + self.offset
        if before // _INT32 > after // _INT32:
            self.flags |= 1
        elif before // _INT32 < after // _INT32:
            self.flags |= 4
        self.position = position
