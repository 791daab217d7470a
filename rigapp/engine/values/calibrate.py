"""Conversion of raw samples to forces, pin positions and free channels.

The load cell gives force on the pin = matrix (signal - zero) in the crank frame. The joint force F
is that on the follower by the pin: F = -(force on the pin). force_1 is its component along the
crank (e1), force_2 that across it (n1). The weight of the pin outboard of the gauges rotates
relative to the cell and is subtracted at the angle of each sample. Probes: position = sensitivity
(voltage - offset), in the follower frame. A free channel: scale (voltage - offset), or the value of
its table.

Latency. The analog filter delays a channel by ``latency``, the counter has no delay: the value at
the count of sample i is the signal at i + latency * rate, by linear interpolation between two
samples, which cannot cause overshoot or false peaks. At the end of a revolution these are the first
samples of the next one, so a revolution is calibrated after they have arrived; at a break in time
the nearest sample is used, and the revolution is flagged.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.config.channels import channel_table, input_keys
from rigapp.config.consistency import number_faults
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import RigFile
from rigapp.engine.samples.assembler import EncoderSetup, Margins, Revolution, Values
from rigapp.engine.samples.sampleclock import PulseRate
from rigapp.engine.values.corrections import follow, invertible, linearised_forces, probe_correction
from rigapp.engine.values.instruments import Counter, InputLine, LoadCell, ProbePair, Wire
from rigapp.schema.channels import LOAD_CELL, PROBES, ChannelTable, Kind
from rigapp.texts import joined
from rigapp_drivers.api import ChannelSpec, SampleClock, StreamSetup

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Calibration:
    """Calibration of one test, frozen at its start: from raw samples to values.

    wires: the inputs, in the order of ``table.sampled``, which is that of all arrays (inputs,
    samples) here; ``inputs_of`` returns the indices. scalars: calibration of the free inputs, by
    name. index_angle_rad: crank angle at the index. sample_rate_Hz: nominal with the encoder as
    clock.
    """

    table: ChannelTable
    wires: tuple[Wire, ...]
    counter: Counter
    encoder: EncoderSetup
    index_angle_rad: float
    sample_rate_Hz: float
    load_cell: LoadCell
    probes: ProbePair
    scalars: Mapping[str, InputLine]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Return the channels of the inputs, in the order of the arrays."""
        return tuple(wire.channel.name for wire in self.wires)

    def inputs_of(self, instrument: str) -> list[int]:
        """Return the indices of an instrument's inputs in an array."""
        return [i for i, wire in enumerate(self.wires) if wire.channel.instrument == instrument]

    @cached_property
    def rows(self) -> list[int]:
        """Return the rows of the inputs in a Block."""
        return [wire.row for wire in self.wires]

    @cached_property
    def latency_s(self) -> Array:
        """Return the inputs' delays relative to the encoder."""
        return np.array([wire.channel.latency_s for wire in self.wires])

    @cached_property
    def ranges(self) -> Array:
        """Return the inputs' requested measuring ranges, in signal units."""
        return np.array([wire.channel.signal_range or math.inf for wire in self.wires])

    @cached_property
    def lines(self) -> dict[str, InputLine]:
        """Return the calibration of single inputs by channel: uncorrected probes, free channels."""
        probes = zip(self.table.names_of(PROBES), self.probes.lines(), strict=True)
        return {**dict(probes), **self.scalars}

    @property
    def margins(self) -> Margins:
        """Return the neighbouring samples that the latency correction needs."""
        if self.counter.clock is SampleClock.ENCODER:
            most = math.ceil(float(np.abs(self.latency_s).max()) * self.counter.fastest_Hz)
            return Margins(before=most, after=most)
        samples, part = self.shift
        after = np.where(part > 0, samples + 1, samples)
        return Margins(before=max(0, int(-samples.min())), after=max(0, int(after.max())))

    @cached_property
    def shift(self) -> tuple[NDArray[np.int64], Array]:
        """Return latency * rate of the inputs as integer samples and fraction 0 .. 1."""
        samples = np.round(self.latency_s * self.sample_rate_Hz, 9)
        floor = np.floor(samples)
        return floor.astype(np.int64), samples - floor

    def force_gain(self) -> tuple[Array, Array]:
        """Return gain (2, 2) and bias (2,) of the linear joint force, N = gain raw + bias."""
        first, second = self.inputs_of(LOAD_CELL)
        return self.load_cell.linear(self.wires[first], self.wires[second])

    @cached_property
    def own_weight(self) -> Array:
        """Return the correction of the force for the pin's weight, (2, counts of a turn) N.

        (2, 0) if the pin has no weight in the plane of the crank.
        """
        turn = self.encoder.counts_per_revolution if self.load_cell.pull.any() else 0
        return np.ascontiguousarray(self.load_cell.own_weight(self.angles(np.arange(turn))))

    def angles(self, counts: Array | NDArray[np.int64]) -> Array:
        """Return the crank angles (rad) at counts from the index."""
        step = 2 * math.pi / self.encoder.counts_per_revolution
        return np.asarray(self.index_angle_rad + counts * step, np.float64)

    def counts_at(self, angle_rad: float) -> NDArray[np.int64]:
        """Return the count from the index nearest to a crank angle, (1,)."""
        step = 2 * math.pi / self.encoder.counts_per_revolution
        return np.array([round((angle_rad - self.index_angle_rad) / step)], np.int64)

    def engineering(self, raw: Array, counts: NDArray[np.int64] | None = None) -> Array:
        """Return the values (inputs, samples) of raw samples (inputs, samples); probes uncorrected.

        counts: from the index, (samples,); without them the forces include the pin's weight.
        """
        values = np.empty_like(raw)
        pair = self.inputs_of(LOAD_CELL)
        gain, bias = self.force_gain()
        values[pair] = linearised_forces(
            gain @ raw[pair] + bias[:, None], self.load_cell.quadratic_terms
        )
        own = self.own_weight
        if own.size and counts is not None:
            values[pair] += own[:, counts % own.shape[1]]
        for i, wire in enumerate(self.wires):
            line = self.lines.get(wire.channel.name)
            if line is not None:
                slope, zero = line.linear(wire)
                values[i] = slope * raw[i] + zero
                follow(values[i], values.shape[1], line.table)
        return values

    def signals(self, values: Values) -> Array:
        """Return the electrical signals (inputs, samples) of a Block's values."""
        scale, offset = (
            np.array([[getattr(wire, name)] for wire in self.wires]) for name in ("scale", "offset")
        )
        return np.asarray(values[self.rows].astype(np.float64) * scale + offset, np.float64)

    def with_tare(self, tare: Sequence[float], angle: float | None = None) -> Calibration:
        """Return this calibration with another tare of the load cell, in signal units.

        angle: of the crank when it was taken, rad, None if unknown.
        """
        cell = replace(self.load_cell, tare=np.asarray(tare, np.float64), tare_angle=angle)
        return replace(self, load_cell=cell)

    def under(self, gravity_m_s2: Sequence[float]) -> Calibration:
        """Return this calibration for the plane of a test, by gravity in the mechanism's frame."""
        return replace(self, load_cell=self.load_cell.under(gravity_m_s2))


def with_margins(revolution: Revolution, margins: Margins) -> tuple[NDArray[Any], int]:
    """Return the values with full margins, and the index at which the revolution begins.

    A margin missing at a break in time is filled with the nearest sample.
    """
    values, before = revolution.values, revolution.before
    after = values.shape[1] - before - revolution.samples
    missing = (max(0, margins.before - before), max(0, margins.after - after))
    if missing == (0, 0):
        return values, before
    return np.pad(values, ((0, 0), missing), mode="edge"), before + missing[0]


def shifted(revolution: Revolution, calibration: Calibration) -> Array:
    """Return the raw inputs (inputs, samples), corrected for latency."""
    if revolution.ticks is not None:
        return _shifted_by_time(revolution, revolution.ticks, calibration)
    delay, part = calibration.shift
    values, before = with_margins(revolution, calibration.margins)
    n = revolution.samples
    out = np.empty((len(calibration.wires), n))
    for i, row in enumerate(calibration.rows):
        start = before + int(delay[i])
        raw = values[row]
        out[i] = raw[start : start + n]
        if part[i] > 0:
            out[i] += part[i] * (raw[start + 1 : start + 1 + n] - out[i])
    return out


def _shifted_by_time(
    revolution: Revolution, ticks: NDArray[np.int64], calibration: Calibration
) -> Array:
    """Return the same for samples at irregular times; constant beyond the ends."""
    inside = slice(revolution.before, revolution.before + revolution.samples)
    # Differences of integer ticks are exact; the ticks themselves are too large for a float64.
    time = (ticks - ticks[0]).astype(np.float64)
    out = np.empty((len(calibration.wires), revolution.samples))
    for i, row in enumerate(calibration.rows):
        raw, delay = revolution.values[row], calibration.latency_s[i] * revolution.sample_rate_Hz
        out[i] = raw[inside] if delay == 0 else np.interp(time[inside] + delay, time, raw)
    return out


@dataclass(frozen=True, slots=True, eq=False)
class Calibrated:
    """Calibrated revolution, arrays of (samples,).

    angle_rad: crank angle of each sample, from the counts. time_s: device time since the sample
    with index 0. curves: the channels with a value at each sample, by name and in the order of
    ``ChannelTable.curves``, in their own units and frames.
    """

    angle_rad: Array
    time_s: Array
    curves: Mapping[str, Array]

    def __getitem__(self, channel: str) -> Array:
        """Return the values of a channel."""
        return self.curves[channel]


def calibrate(revolution: Revolution, calibration: Calibration) -> Calibrated:
    """Convert a revolution to engineering units."""
    values = calibration.engineering(shifted(revolution, calibration), revolution.counts)
    if calibration.probes.correction is not None:
        pair = calibration.inputs_of(PROBES)
        values[pair] = calibration.probes.correction.apply(revolution.counts, values[pair])
    result = dict(zip(calibration.names, values, strict=True))
    result["force"] = np.hypot(*(result[name] for name in calibration.table.names_of(LOAD_CELL)))
    return Calibrated(
        angle_rad=calibration.angles(revolution.counts),
        time_s=revolution.sample_indices() / revolution.sample_rate_Hz,
        curves={curve.name: result[curve.name] for curve in calibration.table.curves},
    )


class Measured:
    """Revolution of a test with its calibration; converted once, on demand."""

    __slots__ = ("_calibrated", "calibration", "revolution")

    def __init__(self, revolution: Revolution, calibration: Calibration) -> None:
        self.revolution = revolution
        self.calibration = calibration
        self._calibrated: Calibrated | None = None

    @property
    def calibrated(self) -> Calibrated:
        """Return the revolution in engineering units, computed at the first call."""
        result = self._calibrated
        if result is None:
            result = self._calibrated = calibrate(self.revolution, self.calibration)
        return result

    def signals(self) -> dict[str, Array]:
        """Return the signals (samples,) as sent by the device, by channel, and ``count``."""
        revolution, kind = self.revolution, self.calibration
        inside = slice(revolution.before, revolution.before + revolution.samples)
        raw = revolution.values[:, inside]
        result = dict(zip(kind.names, kind.signals(raw), strict=True))
        return {**result, "count": raw[kind.counter.row]}

    def kept(self) -> Measured:
        """Return a copy of the raw samples only, for storage in memory.

        A view would reference the assembler's whole buffer; calibrated values have several times
        the size.
        """
        revolution = self.revolution
        if revolution.values.base is not None:
            revolution = replace(revolution, values=revolution.values.copy())
        return Measured(revolution, self.calibration)


def calibration_of(rig: RigFile, setup: StreamSetup) -> Calibration:
    """Return the calibration of a rig file for the setup of its device; raise UnusableInput."""
    for fault in number_faults(rig):
        raise UnusableInput("rig file: {}", fault)
    table = channel_table(rig)
    keys = {name: key for key, name in input_keys(rig).items()}
    wires = []
    for channel in table.sampled:
        row, spec = _spec(setup, channel.input, keys[channel.input])
        wires.append(Wire(channel, row, spec.unit, spec.scale, spec.offset))
    counter_row, counter = _spec(setup, rig.encoder.input, "encoder.input")
    encoder = _encoder(rig, counter)
    index_angle_rad = math.radians(rig.encoder.index_angle_deg)
    return Calibration(
        table=table,
        wires=tuple(wires),
        counter=Counter(
            row=counter_row,
            scale=counter.scale,
            offset=counter.offset,
            clock=setup.clock,
            pulse_rate=_pulse_rate(rig, setup),
            fastest_Hz=rig.spindle.maximum_speed_rpm / 60.0 * encoder.counts_per_revolution,
        ),
        encoder=encoder,
        index_angle_rad=index_angle_rad,
        sample_rate_Hz=setup.sample_rate_Hz,
        load_cell=_load_cell(rig),
        probes=_probes(rig, encoder.counts_per_revolution, index_angle_rad),
        scalars={
            channel.name: _scalar(rig, channel.name)
            for channel in table.free
            if channel.kind is Kind.SAMPLED
        },
    )


def _encoder(rig: RigFile, counter: ChannelSpec) -> EncoderSetup:
    lines = 4 if rig.encoder.quadrature == "before" else 1
    modulus = 0
    if counter.minimum is not None and counter.maximum is not None:
        modulus = round(counter.maximum - counter.minimum) + 1
    turn = rig.encoder.counts_per_revolution * lines
    if rig.encoder.restarts_at_index and modulus <= 2 * turn:
        modulus = 0
    return EncoderSetup(
        counts_per_revolution=turn,
        direction=rig.encoder.direction,
        restarts_at_index=rig.encoder.restarts_at_index,
        modulus=modulus,
    )


def _load_cell(rig: RigFile) -> LoadCell:
    matrix = np.array(rig.load_cell.matrix_N_per_mV_per_V, np.float64)
    return LoadCell(
        matrix=matrix,
        zero=np.array(rig.load_cell.zero_mV_per_V, np.float64),
        quadratic_terms=_quadratic_terms(rig, matrix),
        record=rig.load_cell.calibration,
        pin_weight=rig.load_cell.pin_weight_N,
    )


def _probes(rig: RigFile, turn: int, index_angle_rad: float) -> ProbePair:
    return ProbePair(
        sensitivity=np.array(rig.probes.sensitivity_um_per_V, np.float64),
        offset=np.array(rig.probes.offset_V, np.float64),
        correction=probe_correction(rig.probes, turn, index_angle_rad),
        uncertainty_um=rig.probes.uncertainty_um,
        record=rig.probes.calibration_name,
    )


def _scalar(rig: RigFile, name: str) -> InputLine:
    section = rig.channels[name]
    line = InputLine(section.scale, section.offset_V)
    if section.table:
        line = InputLine(table=np.ascontiguousarray(np.array(section.table, np.float64).T))
    return replace(line, uncertainty=section.uncertainty, record=section.calibration)


def _pulse_rate(rig: RigFile, setup: StreamSetup) -> PulseRate | None:
    """Return the row of the pulse rate; raise UnusableInput if it is missing but needed."""
    if setup.clock is not SampleClock.ENCODER:
        return None
    for row, spec in enumerate(setup.channels):
        if spec.name == "rate_1":
            return PulseRate(row, spec.scale, spec.offset)
    if rig.simulated_samples:
        raise UnusableInput(
            "rig file: devices.{}.settings.clock = 'encoder' needs the pulse rate"
            " (rate_range_Hz) on a simulated rig, whose time is not that of this"
            " computer",
            rig.encoder.device,
        )
    return None


def _spec(setup: StreamSetup, name: str, key: str) -> tuple[int, ChannelSpec]:
    for row, spec in enumerate(setup.channels):
        if spec.name == name:
            return row, spec
    names = joined(", ", (spec.name for spec in setup.channels))
    raise UnusableInput(
        "rig file: {} = {} is not among what the device sends ({}); correct the key",
        key,
        repr(name),
        names,
    )


def _quadratic_terms(rig: RigFile, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the quadratic terms for joint forces (2, 3), 1/N; raise UnusableInput."""
    cell = rig.load_cell
    if cell.quadratic_mV_per_V_per_N2 is None:
        return np.zeros((2, 3))
    terms = np.ascontiguousarray(matrix @ np.array(cell.quadratic_mV_per_V_per_N2, np.float64))
    largest_N = math.sqrt(2.0) * cell.range_mV_per_V * float(np.linalg.norm(matrix, 2))
    if not invertible(terms, largest_N):
        raise UnusableInput(
            "rig file: load_cell.quadratic_mV_per_V_per_N2: the quadratic terms are so"
            " large that signals within the input range mean two forces; calibrate the"
            " load cell again over the range that is used"
        )
    return terms
