"""The terminals of a simulated DATAQ instrument: signals in, 16-bit words out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_drivers.dataq.protocol import (
    ANALOG_CHANNELS,
    COUNTER_SPAN,
    RATE_RANGES_HZ,
    Function,
    Model,
)
from rigapp_drivers.simulator_api import RigSignals

Floats = NDArray[np.float64]
_LINE_A = (2, 3, 6)  # rate, counter and scan clock
_QUARTER = 0.25
_RAILS_V = 1000.0


@dataclass(frozen=True, slots=True)
class Readings:
    """Converted signals: analog (8, scans) in V, counts, pulse rate in Hz, digital lines."""

    analog: Floats
    counts: NDArray[np.int64]
    rate_Hz: Floats
    lines: NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Pulses:
    """Rising edges of encoder line A: the interval between samples, and the fraction within it.

    position: in encoder lines. forward: direction of the shaft at the edge.
    """

    interval: NDArray[np.int64]
    fraction: Floats
    per_interval: NDArray[np.int64]
    position: Floats
    forward: NDArray[np.bool_]


def rising_edges(position: Floats) -> Pulses:
    """Return the rising edges along a position in encoder lines, linear between its points.

    Line A is high in the first half of every line: forward it rises at whole numbers, backward
    midway between them.
    """
    before, after = position[:-1], position[1:]
    up, down = np.floor(before), np.floor(before - 0.5)
    forward = np.maximum(0.0, np.floor(after) - up)
    backward = np.maximum(0.0, down - np.floor(after - 0.5))
    per_interval = (forward + backward).astype(np.int64)
    interval = np.repeat(np.arange(before.size), per_interval)
    ends = np.cumsum(per_interval)
    order = np.arange(interval.size) - np.repeat(ends - per_interval, per_interval)
    ahead = forward[interval] > 0.0
    edges = np.where(ahead, up[interval] + 1.0 + order, down[interval] + 0.5 - order)
    travel = after - before
    fraction = (edges - before[interval]) / travel[interval]
    return Pulses(interval, fraction, per_interval, edges, ahead)


class Terminals:
    """Track the shaft and the voltages from call to call; counts also without scanning.

    lines: of the encoder. line_b, line_z: digital inputs wired to its lines B and Z. Line B rises a
    quarter of a line after A; Z is high for one line, from a quarter of a line before a turn.
    """

    def __init__(self, lines: int, *, line_b: int | None = None, line_z: int | None = None) -> None:
        self._line_b, self._line_z = line_b, line_z
        self.count = 0
        self.stuck_counter = False
        self.saturated: int | None = None
        self.stuck: int | None = None
        self._lines = lines
        self._position: float | None = None
        self._voltages = np.zeros(ANALOG_CHANNELS)
        self._held: dict[int, float] = {}

    def read(self, signals: RigSignals, sample_rate_Hz: float, *, by_encoder: bool) -> Readings:
        """Return the readings of the scans that are due: one per sample or per rising edge."""
        shaft = signals.shaft_revolutions * self._lines
        if self._position is None:
            self._position = float(shaft[0])
        position = np.concatenate(([self._position], shaft))
        voltages = self._faulty(self._inputs(signals))
        pulses = rising_edges(position)
        rate = np.abs(np.diff(position)) * sample_rate_Hz
        first, total = self.count, int(pulses.per_interval.sum())
        if by_encoder:
            at, fraction = pulses.interval, pulses.fraction
            analog = voltages[:, at] * (1.0 - fraction) + voltages[:, at + 1] * fraction
            counts = first + 1 + np.arange(total)
            rate = rate[at]
            # A scan is taken just after the edge, where A is high in both directions.
            states = self._states(pulses.position + np.where(pulses.forward, 1e-6, -1e-6))
        else:
            analog = voltages[:, 1:]
            counts = first + np.cumsum(pulses.per_interval)
            states = self._states(shaft)
        if self.stuck_counter:
            counts = np.full_like(counts, first)
        else:
            self.count = first + total
        self._position = float(shaft[-1])
        self._voltages = voltages[:, -1]
        return Readings(analog, counts, rate, states)

    def _states(self, position: Floats) -> NDArray[np.int64]:
        """Return the states of the digital lines at positions in encoder lines, as bits."""
        line_a = np.mod(position, 1.0) < 0.5
        states = sum(line_a.astype(np.int64) << line for line in _LINE_A)
        if self._line_b is not None:
            line_b = np.mod(position - _QUARTER, 1.0) < 0.5
            states |= line_b.astype(np.int64) << self._line_b
        if self._line_z is not None:
            line_z = np.mod(position + _QUARTER, self._lines) < 1.0
            states |= line_z.astype(np.int64) << self._line_z
        return np.asarray(states, np.int64)

    def _inputs(self, signals: RigSignals) -> Floats:
        """Return (8, 1 + samples) in V, beginning with the last sample of the previous call."""
        voltages = np.zeros((ANALOG_CHANNELS, 1 + signals.shaft_revolutions.size))
        voltages[:, 0] = self._voltages
        for number, values in signals.analog.items():
            voltages[number - 1, 1:] = np.clip(values, -_RAILS_V, _RAILS_V)
        return voltages

    def _faulty(self, voltages: Floats) -> Floats:
        if self.saturated is not None:
            voltages[self.saturated - 1] = 100.0
        if self.stuck is None:
            self._held.clear()
        else:
            row = voltages[self.stuck - 1]
            row[:] = self._held.setdefault(self.stuck, float(row[0]))
        return voltages


def words_of(
    readings: Readings, scan_list: Sequence[int], model: Model, rng: np.random.Generator
) -> NDArray[np.uint16]:
    """Return the words of the scans, (scans, entries); insignificant low bits are random."""
    scans = readings.counts.size
    words = np.empty((scans, len(scan_list)), np.uint16)
    for column, entry in enumerate(scan_list):
        function, code = entry & 0xF, entry >> 8
        if function < ANALOG_CHANNELS:
            words[:, column] = _converted(readings.analog[function], model, code, rng)
        elif function == Function.COUNTER:
            words[:, column] = (readings.counts % COUNTER_SPAN) ^ 0x8000
        elif function == Function.RATE:
            steps = np.round(readings.rate_Hz / RATE_RANGES_HZ[code - 1] * 65535.0)
            words[:, column] = np.minimum(steps, 65535.0).astype(np.int64) ^ 0x8000
        else:
            words[:, column] = readings.lines << 8
    return words


def _converted(
    voltages: Floats, model: Model, code: int, rng: np.random.Generator
) -> NDArray[np.int64]:
    steps = np.round(voltages / model.ranges_V[code] * 32768.0)
    numbers = np.clip(steps, -32768, 32767).astype(np.int64) & model.mask
    spare = 0xFFFF ^ model.mask
    if spare:
        numbers |= rng.integers(0, spare + 1, numbers.size)
    return numbers & 0xFFFF


def known_word(word: int, model: Model) -> bool:
    """Return whether a scan-list word is valid for a model."""
    function, code = word & 0xF, word >> 8
    if word & 0xF0:
        return False
    if function < ANALOG_CHANNELS:
        return code < len(model.ranges_V)
    if function == Function.RATE:
        return 1 <= code <= len(RATE_RANGES_HZ)
    return function in (Function.DIGITAL, Function.COUNTER) and code == 0
