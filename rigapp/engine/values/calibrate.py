"""Turn raw samples into forces and pin positions with the calibration frozen at the start.

The load cell gives force on the pin = matrix (signal - zero) in the crank frame. The joint force F
is the one on the follower by the pin: F = -(force on the pin). force_1 is its component along the
crank (e1), force_2 the one across it (n1). Probes: position = sensitivity (voltage - offset), in
the follower frame.

Latency. The analog filter delays a channel by ``latency``, the counter has no delay: the value that
belongs to the count of sample i is the signal at i + latency * rate. It is interpolated linearly
between its two neighbours, which can neither overshoot nor invent a peak. The neighbours beyond the
end of a revolution are the first samples of the next one, so a revolution is calibrated when these
have arrived; across a break in time the nearest sample is held, and the revolution is flagged.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drivers.api import ChannelSpec, SampleClock, StreamSetup
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import RigFile
from rigapp.engine.samples.assembler import EncoderSetup, Margins, Revolution, Values
from rigapp.engine.samples.sampleclock import PulseRate
from rigapp.engine.values.bend import invertible, straight
from rigapp.engine.values.probes import ProbeCorrection, probe_correction

ANALOG = ("force_1", "force_2", "probe_1", "probe_2")
"""What the four analog inputs carry, in the order of every four-row array here."""

LARGEST_CONDITION = 1e6


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """Hold what turns the raw samples of one test into N and um.

    rows: row in the Block of the four analog inputs (``ANALOG``) and of the counter. scale,
    offset: (4,) electrical signal = scale raw + offset. matrix: (2, 2) N per signal unit. bend:
    (2, 3) 1/N, the quadratic terms of the cell (``bend``). zero: (2,) signal units; tare: (2,)
    further zero found with the pin unloaded. sensitivity: (2,) um/V. probe_offset: (2,) V.
    latency_s: (4,). index_angle_rad: crank angle at the index.
    clock: what makes the device sample; with the encoder's, sample_rate_Hz is nominal, fastest_Hz
    the most pulses a second, and pulse_rate tells where their rate is recorded. correction: run-out
    map and alignment of the probes, None without. probe_uncertainty_um: expanded, of one position.
    ranges: (4,) signal units, the measuring range that was asked for.
    """

    rows: tuple[int, int, int, int]
    counter_row: int
    encoder: EncoderSetup
    index_angle_rad: float
    sample_rate_Hz: float
    scale: NDArray[np.float64]
    offset: NDArray[np.float64]
    matrix: NDArray[np.float64]
    zero: NDArray[np.float64]
    sensitivity: NDArray[np.float64]
    probe_offset: NDArray[np.float64]
    latency_s: NDArray[np.float64]
    units: tuple[str, str, str, str] = ("mV/V", "mV/V", "V", "V")
    tare: NDArray[np.float64] = field(default_factory=lambda: np.zeros(2))
    bend: NDArray[np.float64] = field(default_factory=lambda: np.zeros((2, 3)))
    counter_scale: float = 1.0
    counter_offset: float = 0.0
    names: tuple[str, str] = ("", "")
    clock: SampleClock = SampleClock.TIME
    pulse_rate: PulseRate | None = None
    fastest_Hz: float = 0.0
    correction: ProbeCorrection | None = None
    probe_uncertainty_um: tuple[float, float] | None = None
    ranges: NDArray[np.float64] = field(default_factory=lambda: np.full(4, np.inf))

    @property
    def margins(self) -> Margins:
        """Return the neighbouring samples that the latency correction needs."""
        if self.clock is SampleClock.ENCODER:
            most = math.ceil(float(np.abs(self.latency_s).max()) * self.fastest_Hz)
            return Margins(before=most, after=most)
        whole, part = self.shift
        after = np.where(part > 0, whole + 1, whole)
        return Margins(before=max(0, int(-whole.min())), after=max(0, int(after.max())))

    @property
    def shift(self) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Return latency * rate as whole samples (4,) and the fraction 0 .. 1 (4,)."""
        samples = np.round(self.latency_s * self.sample_rate_Hz, 9)
        whole = np.floor(samples)
        return whole.astype(np.int64), samples - whole

    def gains(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return gain (4, 4) and bias (4,): ``ANALOG`` in N and um = gain raw + bias.

        The forces are the linear ones where the cell has quadratic terms (``bend``).
        """
        gain, bias = np.zeros((4, 4)), np.zeros(4)
        force = -self.matrix
        gain[:2, :2] = force * self.scale[:2]
        bias[:2] = force @ (self.offset[:2] - self.zero - self.tare)
        gain[2, 2], gain[3, 3] = self.sensitivity * self.scale[2:]
        bias[2:] = self.sensitivity * (self.offset[2:] - self.probe_offset)
        return gain, bias

    def engineering(self, raw: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return ``ANALOG`` (4, samples) in N and um of raw samples (4, samples)."""
        gain, bias = self.gains()
        values = np.asarray(gain @ raw + bias[:, None], np.float64)
        if self.bend.any():
            values[:2] = straight(values[:2], self.bend)
        return values

    def signals(self, values: Values) -> NDArray[np.float64]:
        """Return the electrical signals (4, samples) of a Block's values."""
        raw = values[list(self.rows)].astype(np.float64)
        return np.asarray(raw * self.scale[:, None] + self.offset[:, None], np.float64)

    def with_tare(self, tare: Sequence[float]) -> Calibration:
        """Return this calibration with another tare, in signal units."""
        return replace(self, tare=np.asarray(tare, np.float64))


def with_margins(revolution: Revolution, margins: Margins) -> tuple[NDArray[Any], int]:
    """Return the values with full margins, and where the revolution begins in them.

    Where a margin is missing, because time is broken there, the nearest sample is held.
    """
    values, before = revolution.values, revolution.before
    after = values.shape[1] - before - revolution.samples
    missing = (max(0, margins.before - before), max(0, margins.after - after))
    if missing == (0, 0):
        return values, before
    return np.pad(values, ((0, 0), missing), mode="edge"), before + missing[0]


def shifted(revolution: Revolution, calibration: Calibration) -> NDArray[np.float64]:
    """Return the four raw analog channels (4, samples), latency corrected."""
    if revolution.ticks is not None:
        return _shifted_by_time(revolution, revolution.ticks, calibration)
    whole, part = calibration.shift
    values, before = with_margins(revolution, calibration.margins)
    n = revolution.samples
    out = np.empty((4, n))
    for i, row in enumerate(calibration.rows):
        start = before + int(whole[i])
        raw = values[row]
        out[i] = raw[start : start + n]
        if part[i] > 0:
            out[i] += part[i] * (raw[start + 1 : start + 1 + n] - out[i])
    return out


def _shifted_by_time(
    revolution: Revolution, ticks: NDArray[np.int64], calibration: Calibration
) -> NDArray[np.float64]:
    """Return the same for samples that come at no fixed times; at the ends the last is held."""
    inside = slice(revolution.before, revolution.before + revolution.samples)
    # Differences of whole ticks are exact; the ticks themselves are too large for a float64.
    time = (ticks - ticks[0]).astype(np.float64)
    out = np.empty((4, revolution.samples))
    for i, row in enumerate(calibration.rows):
        raw, delay = revolution.values[row], calibration.latency_s[i] * revolution.sample_rate_Hz
        out[i] = raw[inside] if delay == 0 else np.interp(time[inside] + delay, time, raw)
    return out


@dataclass(frozen=True, slots=True, eq=False)
class Calibrated:
    """Carry a calibrated revolution, arrays of (samples,).

    angle_rad: crank angle of each sample, from the whole counts. time_s: device time since the
    sample with index 0. Forces in N in the crank frame, probes in um in the follower frame.
    """

    angle_rad: NDArray[np.float64]
    time_s: NDArray[np.float64]
    force_1: NDArray[np.float64]
    force_2: NDArray[np.float64]
    force: NDArray[np.float64]
    probe_1: NDArray[np.float64]
    probe_2: NDArray[np.float64]


def calibrate(revolution: Revolution, calibration: Calibration) -> Calibrated:
    """Return the revolution in engineering units."""
    values = calibration.engineering(shifted(revolution, calibration))
    if calibration.correction is not None:
        values[2:] = calibration.correction.apply(revolution.counts, values[2:])
    turn = calibration.encoder.counts_per_revolution
    return Calibrated(
        angle_rad=np.asarray(
            calibration.index_angle_rad + revolution.counts * (2 * math.pi / turn), np.float64
        ),
        time_s=revolution.sample_indices() / revolution.sample_rate_Hz,
        force_1=values[0],
        force_2=values[1],
        force=np.hypot(values[0], values[1]),
        probe_1=values[2],
        probe_2=values[3],
    )


def analog_inputs(rig: RigFile) -> tuple[str, str, str, str]:
    """Return the device's names of the inputs that carry ``ANALOG``."""
    cell, probes = rig.load_cell, rig.probes
    return cell.input_1, cell.input_2, probes.input_1, probes.input_2


def calibration_of(rig: RigFile, setup: StreamSetup) -> Calibration:
    """Freeze the calibration of a rig file for a device set up so; raise UnusableInput."""
    names = analog_inputs(rig)
    keys = ("load_cell.input_1", "load_cell.input_2", "probes.input_1", "probes.input_2")
    specs = [_spec(setup, name, key) for name, key in zip(names, keys, strict=True)]
    counter_row, counter = _spec(setup, rig.encoder.input, "encoder.input")
    matrix = np.array(rig.load_cell.matrix_N_per_mV_per_V, np.float64)
    _check_matrix(matrix)
    bend = _bend(rig, matrix)
    sensitivity = np.array(rig.probes.sensitivity_um_per_V, np.float64)
    latency = np.array((*rig.load_cell.latency_ms, *rig.probes.latency_ms), np.float64) / 1e3
    zero = np.array(rig.load_cell.zero_mV_per_V, np.float64)
    probe_offset = np.array(rig.probes.offset_V, np.float64)
    for key, array in (
        ("load_cell.zero_mV_per_V", zero),
        ("probes.sensitivity_um_per_V", sensitivity),
        ("probes.offset_V", probe_offset),
        ("latency_ms", latency),
    ):
        if not np.isfinite(array).all():
            raise UnusableInput(f"rig file: {key} holds a value that is not a number; correct it")
    if (sensitivity == 0).any():
        raise UnusableInput("rig file: probes.sensitivity_um_per_V holds 0; calibrate the probes")
    if (abs(latency) > 0.1).any():
        raise UnusableInput("rig file: latency_ms must lie between -100 and 100 ms; correct it")
    lines = 4 if rig.encoder.quadrature == "before" else 1
    modulus = 0
    if counter.minimum is not None and counter.maximum is not None:
        modulus = round(counter.maximum - counter.minimum) + 1
    turn = rig.encoder.counts_per_revolution * lines
    if rig.encoder.restarts_at_index and modulus <= 2 * turn:
        modulus = 0
    return Calibration(
        rows=(specs[0][0], specs[1][0], specs[2][0], specs[3][0]),
        counter_row=counter_row,
        encoder=EncoderSetup(
            counts_per_revolution=turn,
            direction=rig.encoder.direction,
            restarts_at_index=rig.encoder.restarts_at_index,
            modulus=modulus,
        ),
        index_angle_rad=math.radians(rig.encoder.index_angle_deg),
        sample_rate_Hz=setup.sample_rate_Hz,
        scale=np.array([spec.scale for _, spec in specs]),
        offset=np.array([spec.offset for _, spec in specs]),
        matrix=matrix,
        bend=bend,
        zero=zero,
        sensitivity=sensitivity,
        probe_offset=probe_offset,
        latency_s=latency,
        units=(specs[0][1].unit, specs[1][1].unit, specs[2][1].unit, specs[3][1].unit),
        counter_scale=counter.scale,
        counter_offset=counter.offset,
        names=(rig.load_cell.calibration, rig.probes.calibration_name),
        clock=setup.clock,
        pulse_rate=_pulse_rate(rig, setup),
        fastest_Hz=rig.spindle.maximum_speed_rpm / 60.0 * turn,
        correction=probe_correction(rig.probes, turn, math.radians(rig.encoder.index_angle_deg)),
        probe_uncertainty_um=rig.probes.uncertainty_um,
        ranges=np.repeat((rig.load_cell.range_mV_per_V, rig.probes.range_V), 2),
    )


def _pulse_rate(rig: RigFile, setup: StreamSetup) -> PulseRate | None:
    """Return where the pulse rate is recorded; raise UnusableInput where only it tells the time."""
    if setup.clock is not SampleClock.ENCODER:
        return None
    for row, spec in enumerate(setup.channels):
        if spec.name == "rate_1":
            return PulseRate(row, spec.scale, spec.offset)
    if rig.simulation is not None:
        raise UnusableInput(
            f"rig file: devices.{rig.encoder.device}.settings.clock = 'encoder' needs the pulse "
            "rate (rate_range_Hz) on a simulated rig, whose time is not that of this computer"
        )
    return None


def _spec(setup: StreamSetup, name: str, key: str) -> tuple[int, ChannelSpec]:
    for row, spec in enumerate(setup.channels):
        if spec.name == name:
            return row, spec
    sent = ", ".join(spec.name for spec in setup.channels)
    raise UnusableInput(
        f"rig file: {key} = {name!r} is not among what the device sends ({sent}); correct the key"
    )


def _check_matrix(matrix: NDArray[np.float64]) -> None:
    key = "rig file: load_cell.matrix_N_per_mV_per_V"
    if not np.isfinite(matrix).all():
        raise UnusableInput(f"{key} holds a value that is not a number; calibrate the load cell")
    if np.linalg.cond(matrix) > LARGEST_CONDITION:
        raise UnusableInput(
            f"{key} is singular: its two bridges would show the same force; calibrate the load cell"
        )


def _bend(rig: RigFile, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the quadratic terms for joint forces (2, 3), 1/N; raise UnusableInput."""
    cell = rig.load_cell
    if cell.quadratic_mV_per_V_per_N2 is None:
        return np.zeros((2, 3))
    bend = np.ascontiguousarray(matrix @ np.array(cell.quadratic_mV_per_V_per_N2, np.float64))
    key = "rig file: load_cell.quadratic_mV_per_V_per_N2"
    if not np.isfinite(bend).all():
        raise UnusableInput(f"{key} holds a value that is not a number; calibrate the load cell")
    reach = math.sqrt(2.0) * cell.range_mV_per_V * float(np.linalg.norm(matrix, 2))
    if not invertible(bend, reach):
        raise UnusableInput(
            f"{key}: the quadratic terms are so large that signals within the input range mean"
            " two forces; calibrate the load cell again over the range that is used"
        )
    return bend
