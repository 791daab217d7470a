"""Interface between the simulated rig and a simulated device.

A simulator speaks the byte protocol of its device; it has no clock and no thread. For simulators
and the simulated rig only; no driver imports this.
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
    """Signals at the input terminals of a simulated data acquisition device.

    analog: input number (1-based) -> (samples,) in mV/V (bridges) or V (voltages), load cell,
    probes and the rig file's free channels; infinite if a wire is broken and the open input floats
    to that side.
    shaft_revolutions: (samples,) unwrapped shaft angle in revolutions, float64; the simulator
    derives counts and index from it.
    """

    analog: Mapping[int, NDArray[np.float64]]
    shaft_revolutions: NDArray[np.float64]


class SimulatedDataSource(Protocol):
    """Simulate a data acquisition device at the byte level: bytes and time in, bytes out."""

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host and return the replies."""

    @property
    def sample_rate_Hz(self) -> float:
        """Return the configured sample rate."""

    @property
    def streaming(self) -> bool:
        """Return whether the host has started the stream."""

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Return the bytes sent for these samples (b"" when not streaming)."""

    def overrun(self, now_s: float) -> None:
        """Record that the link dropped old frames because the host did not read."""


class DriveMode(enum.StrEnum):
    """Way in which a drive acts on its motor."""

    VELOCITY = "velocity"
    DUTY = "duty"
    OFF = "off"


@dataclass(frozen=True, slots=True)
class DriveCommand:
    """Output of a drive to the plant: a ramped speed set-point, a duty, or no power."""

    mode: DriveMode
    speed_count_per_s: float = 0.0
    duty: float = 0.0


@dataclass(frozen=True, slots=True)
class MotorState:
    """Motor state as measured by the sensors of the simulated drive."""

    position_count: int
    speed_count_per_s: float
    current_A: float
    supply_V: float = 48.0
    temperature_C: float = 31.5


class SimulatedSlowSource(Protocol):
    """Simulate a slow device at the byte level; quantities: as its driver's."""

    quantities: tuple[str, ...]

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host, if any, and return the replies that are due."""

    def observe(self, values: Mapping[str, float]) -> None:
        """Set the sensors' present values by the driver's quantities (``temperature_C``)."""


class SimulatedDrive(Protocol):
    """Simulate a drive at the byte level.

    ``now_s`` is the time of the wire (time-outs and watchdog run on it); ``elapsed_s`` is the time
    of the plant (ramps run on it). Both are the same in real time.
    """

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host and return the replies."""

    def command(self, elapsed_s: float, now_s: float) -> DriveCommand:
        """Advance ramps by elapsed_s, check the watchdog at now_s, return the motor command."""

    def observe(self, state: MotorState) -> None:
        """Set the motor's present state for later replies."""

    def emit(self, now_s: float) -> bytes:
        """Return unsolicited bytes of the drive (heartbeat, PDO); b"" for most drives."""
