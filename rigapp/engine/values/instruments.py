"""Instruments of a rig with the constants of their calibration.

A signal is the data source's value of one input: signal = scale raw + offset, in mV/V or V.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.sampleclock import PulseRate
from rigapp.engine.values.corrections import ProbeCorrection
from rigapp.schema.channels import Channel
from rigapp_calibration.load_cell.weights import STANDARD_GRAVITY
from rigapp_drivers.api import SampleClock

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Wire:
    """Input in the Blocks: its channel, its row, and signal = scale raw + offset.

    unit: of the signal, from the device.
    """

    channel: Channel
    row: int
    unit: str
    scale: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Counter:
    """Row of the crank encoder's count, and the sample clock of the device.

    clock: with that of the encoder, pulse_rate is the row of the rate of its pulses, fastest_Hz
    their highest rate.
    """

    row: int
    scale: float = 1.0
    offset: float = 0.0
    clock: SampleClock = SampleClock.TIME
    pulse_rate: PulseRate | None = None
    fastest_Hz: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class LoadCell:
    """Load cell: two bridges in the pin, from whose signals the joint force F follows.

    With the linear force G = - matrix (signal - zero - tare) it is G + B (F1^2, F1 F2, F2^2).
    matrix: (2, 2) N per signal unit. zero: (2,) signal units; tare: (2,) measured with the pin
    unloaded, at tare_angle (rad, None if unknown). quadratic_terms: B, (2, 3) 1/N, see
    ``corrections``. record: name of the calibration record, or empty. pin_weight: N, of the pin
    outboard of the gauges, which is not a force of the follower and rotates relative to the cell;
    pull: (2,) N, its components in the plane of the crank, along the slider's way and across it, by
    the gravity of a test.
    """

    matrix: Array
    zero: Array = field(default_factory=lambda: np.zeros(2))
    tare: Array = field(default_factory=lambda: np.zeros(2))
    quadratic_terms: Array = field(default_factory=lambda: np.zeros((2, 3)))
    record: str = ""
    pin_weight: float = 0.0
    pull: Array = field(default_factory=lambda: np.zeros(2))
    tare_angle: float | None = None

    def linear(self, first: Wire, second: Wire) -> tuple[Array, Array]:
        """Return gain (2, 2) and bias (2,) of the linear joint force, N = gain raw + bias."""
        scale, offset = (
            np.array([getattr(wire, name) for wire in (first, second)])
            for name in ("scale", "offset")
        )
        return -self.matrix * scale, -self.matrix @ (offset - self.at_rest)

    @property
    def at_rest(self) -> Array:
        """Return the signals (2,) without force; a tare includes the pin's weight at its angle."""
        signals = self.zero + self.tare
        if self.tare_angle is None:
            return signals
        weight_signal = np.linalg.solve(self.matrix, self.own_weight(self.tare_angle))
        return np.asarray(signals - weight_signal, np.float64)

    def own_weight(self, angle: float | Array) -> Array:
        """Return the pin's weight at crank angles (...,), rad: (2, ...) N, crank frame.

        As a force on the pin, from which it is subtracted; it is added to the joint force
        F = -(force on the pin).
        """
        x, y = self.pull
        sine, cosine = np.sin(angle), np.cos(angle)
        return np.asarray([x * cosine + y * sine, y * cosine - x * sine], np.float64)

    def under(self, gravity_m_s2: Sequence[float]) -> LoadCell:
        """Return this cell for a plane with gravity along the slider's way and across it."""
        share = np.asarray(gravity_m_s2, np.float64) / STANDARD_GRAVITY
        return replace(self, pull=self.pin_weight * share)


@dataclass(frozen=True, slots=True, eq=False)
class InputLine:
    """Calibration of one input: value = slope (signal - zero), or a table's value at the signal.

    table: (2, points), increasing signals (V) and their values, linear between them and beyond both
    ends; empty without one. uncertainty: expanded, of a value, None if not stated. record: name of
    the calibration record, or empty.
    """

    slope: float = 1.0
    zero: float = 0.0
    table: Array = field(default_factory=lambda: np.empty((2, 0)))
    uncertainty: float | None = None
    record: str = ""

    def linear(self, wire: Wire) -> tuple[float, float]:
        """Return gain and bias of the value (with a table: of its signal) = gain raw + bias."""
        return self.slope * wire.scale, self.slope * (wire.offset - self.zero)


@dataclass(frozen=True, slots=True, eq=False)
class ProbePair:
    """Two probes: a line each, and a common run-out map and alignment.

    sensitivity: (2,) um/V. offset: (2,) V. uncertainty_um: expanded, of one position. record: name
    of the calibration record, or empty.
    """

    sensitivity: Array
    offset: Array = field(default_factory=lambda: np.zeros(2))
    correction: ProbeCorrection | None = None
    uncertainty_um: tuple[float, float] | None = None
    record: str = ""

    def lines(self) -> tuple[InputLine, ...]:
        """Return the calibration of each of the two inputs, um."""
        pairs = zip(self.sensitivity.tolist(), self.offset.tolist(), strict=True)
        return tuple(InputLine(slope, zero) for slope, zero in pairs)
