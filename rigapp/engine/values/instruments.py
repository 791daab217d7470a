"""The instruments of a rig, each with the numbers that turn its signals into N, um ...

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
    """One input as the Blocks carry it: the channel, its row, and signal = scale raw + offset.

    unit: of the signal, by the device.
    """

    channel: Channel
    row: int
    unit: str
    scale: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Counter:
    """The row of the crank encoder's count, and what makes the device sample.

    clock: with the encoder's, pulse_rate is where the rate of its pulses is recorded, fastest_Hz
    how many there can be a second.
    """

    row: int
    scale: float = 1.0
    offset: float = 0.0
    clock: SampleClock = SampleClock.TIME
    pulse_rate: PulseRate | None = None
    fastest_Hz: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class LoadCell:
    """Two bridges in the pin: the joint force F follows from both signals at once.

    With the linear force G = - matrix (signal - zero - tare) it is G + B (F1^2, F1 F2, F2^2).
    matrix: (2, 2) N per signal unit. zero: (2,) signal units; tare: (2,) found with the pin
    unloaded, at tare_angle (rad, None where it was not known). quadratic_terms: B, (2, 3) 1/N, see
    ``corrections``.
    record: name of the calibration record, empty without. pin_weight: N, of the pin outboard of the
    gauges, which is no force of the follower and turns about the cell; pull: (2,) N, what of it
    acts in the plane of the crank, along the slider's way and across it, by the gravity of a test.
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
        """Return the signals (2,) without any force: a tare holds that of the pin at its angle."""
        signals = self.zero + self.tare
        if self.tare_angle is None:
            return signals
        pulled = np.linalg.solve(self.matrix, self.own_weight(self.tare_angle))
        return np.asarray(signals - pulled, np.float64)

    def own_weight(self, angle: float | Array) -> Array:
        """Return how the pin's weight pulls at crank angles (...,), rad: (2, ...) N, crank frame.

        As a force on the pin, which is taken off; the joint force F = -(force on the pin) gains it.
        """
        x, y = self.pull
        sine, cosine = np.sin(angle), np.cos(angle)
        return np.asarray([x * cosine + y * sine, y * cosine - x * sine], np.float64)

    def under(self, gravity_m_s2: Sequence[float]) -> LoadCell:
        """Return this cell in a plane with so much gravity along the slider's way and across it."""
        share = np.asarray(gravity_m_s2, np.float64) / STANDARD_GRAVITY
        return replace(self, pull=self.pin_weight * share)


@dataclass(frozen=True, slots=True, eq=False)
class InputLine:
    """What one input means: value = slope (signal - zero), or a table's value at the signal.

    table: (2, points), rising signals (V) and their values, linear between them and beyond both
    ends; empty without one. uncertainty: expanded, of a value, None where it is not stated. record:
    name of the calibration record, empty without.
    """

    slope: float = 1.0
    zero: float = 0.0
    table: Array = field(default_factory=lambda: np.empty((2, 0)))
    uncertainty: float | None = None
    record: str = ""

    def linear(self, wire: Wire) -> tuple[float, float]:
        """Return gain and bias of what the table is applied to, = gain raw + bias."""
        return self.slope * wire.scale, self.slope * (wire.offset - self.zero)


@dataclass(frozen=True, slots=True, eq=False)
class ProbePair:
    """Two probes: each has its line, together they have run-out map and alignment.

    sensitivity: (2,) um/V. offset: (2,) V. uncertainty_um: expanded, of one position. record: name
    of the calibration record, empty without.
    """

    sensitivity: Array
    offset: Array = field(default_factory=lambda: np.zeros(2))
    correction: ProbeCorrection | None = None
    uncertainty_um: tuple[float, float] | None = None
    record: str = ""

    def lines(self) -> tuple[InputLine, ...]:
        """Return what each of the two inputs means, um."""
        pairs = zip(self.sensitivity.tolist(), self.offset.tolist(), strict=True)
        return tuple(InputLine(slope, zero) for slope, zero in pairs)
