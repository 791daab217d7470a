"""What the simulated rig sees of a simulated device, and what each of them gives the other.

A simulator speaks the bytes of its device; it has no clock and no thread of its own. Simulators and
the simulated rig only; no driver imports this.
"""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class RigSignals:
    """Feed a simulated data acquisition device: what its input terminals see.

    analog: input number (1-based) -> (samples,) in mV/V (bridges) or V (voltages), load cell,
    probes and the rig file's free channels alike; infinite where a wire is broken and the open
    input floats to that side.
    shaft_revolutions: (samples,) unwrapped shaft angle in revolutions, float64; the simulator makes
    counts and index of it.
    """

    analog: Mapping[int, NDArray[np.float64]]
    shaft_revolutions: NDArray[np.float64]


class SimulatedDataSource(Protocol):
    """Simulate a data acquisition device at the byte level: bytes and time in, bytes out."""

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Take bytes from the host and return the replies that they cause."""

    @property
    def sample_rate_Hz(self) -> float:
        """Return the configured sample rate."""

    @property
    def streaming(self) -> bool:
        """Tell whether the host has started the stream."""

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Return the bytes that these samples cause on the wire (b"" when not streaming)."""

    def overrun(self, now_s: float) -> None:
        """Take note that the link dropped old frames because the host did not read."""


class DriveMode(enum.StrEnum):
    """Tell how a drive acts on its motor."""

    VELOCITY = "velocity"
    DUTY = "duty"
    OFF = "off"


@dataclass(frozen=True, slots=True)
class DriveCommand:
    """Tell the plant what the drive wants: a ramped speed set-point, a duty, or nothing."""

    mode: DriveMode
    speed_count_per_s: float = 0.0
    duty: float = 0.0


@dataclass(frozen=True, slots=True)
class MotorState:
    """Tell the simulated drive what its sensors see."""

    position_count: int
    speed_count_per_s: float
    current_A: float
    supply_V: float = 48.0
    temperature_C: float = 31.5


class SimulatedSlowSource(Protocol):
    """Simulate a slow device at the byte level; quantities: those that it tells, as its driver."""

    quantities: tuple[str, ...]

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Take bytes from the host, or none; return the replies that are due."""

    def observe(self, values: Mapping[str, float]) -> None:
        """Take what its sensors see now, by the driver's quantities (``temperature_C``)."""


class SimulatedDrive(Protocol):
    """Simulate a drive at the byte level.

    ``now_s`` is the time of the wire (time-outs and watchdog run on it); ``elapsed_s`` is the time
    of the plant (ramps run on it). Both are the same in real time.
    """

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Take bytes from the host and return the replies that they cause."""

    def command(self, elapsed_s: float, now_s: float) -> DriveCommand:
        """Advance ramps by elapsed_s, judge the watchdog at now_s, return what drives the motor."""

    def observe(self, state: MotorState) -> None:
        """Take the motor's present state for later replies."""

    def emit(self, now_s: float) -> bytes:
        """Return bytes that the drive sends by itself (heartbeat, PDO); b"" for most."""
